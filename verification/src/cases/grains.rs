//! Do soft grains that a plate compacts push back as a packing does?
//!
//! Source: Liang et al. 2024, section 4.6: sixteen soft grains, some of them concave, in a container of 10 m x 13 m under a
//! rigid plate that comes down at 0.1 m/s; E = 60 kPa, nu = 0.32, 500 kg/m³, no gravity; h = 0.2 m, 4 x 4 particles per
//! cell, segments of about 0.1 m; a PIC share of 0.1, viscous damping of 0.1; g_c = 0.085 m, kappa = 7e4 Pa/m,
//! kappa_t = 1e5 Pa/m, friction 0.2 between grains and plate; walls and floor without friction. The printed way of the
//! plate, 0.49 m, does not belong to the printed times of up to 49 s: 4.9 m does.
//!
//! The paper's shapes are not published. Here r(theta) is a circle with three waves of random amplitude and phase, from
//! the seed below, scaled into its part of the container, as large as the paper's 26 916 particles of 0.0025 m² make
//! them; four rows of them then leave 2.7 m free, where the paper's packing reaches the floor after 3 m.
//!
//! No exact solution: what must hold whatever the shapes is judged. In no step is a vertex of a grain inside another one,
//! or beyond plate, floor or walls; momentum is the impulse of plate, floor and walls less that of the damping; at the
//! end the plate carries what floor and damping take, but for what is left of the momentum; the grains never hold more
//! energy than the plate gave them.
//!
//! Shown, and not judged, since neither the paper's text nor theory has a figure for these shapes: how near grains come to
//! each other, where the floor is first loaded, how much steeper the plate's force rises at the end than in the first
//! half (two phases, says the paper), and how far the plate is pushed sideways. Of the plate's force the damping, eq. 20,
//! takes 4.4 kN for every row of grains that moves with it, of 38 kN at the end. `proctor verify grains`.

use super::prelude::*;
use watch::{
    BALANCE, BEYOND, FLOOR_SHARE, GAINED, INSIDE, LARGEST, LOADED, MOMENTUM, PHASES, SIDEWAYS,
    SMALLEST, Watch,
};

pub mod apart;
mod shapes;
mod watch;

pub use shapes::outlines;

/// The part of the container that belongs to a grain \[m\].
const PART: [f64; 2] = [2.5, 3.25];
const YOUNG: f64 = 6e4;
const POISSON: f64 = 0.32;
const DENSITY: f64 = 500.0;
const GAP: f64 = 0.085;
const KAPPA: f64 = 7e4;
const KAPPA_T: f64 = 1e5;
const FRICTION: f64 = 0.2;
const DAMPING: f64 = 0.1;
const SPEED: f64 = 0.1; // Speed of the plate [m/s]
/// Way of the plate over the height of the container.
const WAY: f64 = 4.9 / 13.0;
const PLATE: i64 = 101;
const FLOOR: i64 = 102;
const WALLS: [i64; 2] = [103, 104];

const WRONG_DAMPING: Wrong = Wrong::factor("damping", 1.5).breaks_only(|gate| {
    gate.contains("unaccounted momentum") || gate.contains("force of plate minus")
});

/// The compacted grains.
pub static GRAINS: Case = Case::new("grains", "Do soft grains that a plate compacts push back as a packing does?")
    .ladder(Ladder::sizes(&[("four", &[0.3125])], &[("sixteen", &[0.2])]))
    .scene(scene)
    .run(compare)
    .gates_of_rungs(&[
    value(INSIDE).at_most(0.0, "grains do not penetrate each other"),
    value(BEYOND).at_most(0.0, "nor the planes that hold them"),
    value(MOMENTUM).at_most(
        1e-10,
        "forces on grains and walls are the same vectors; round-off of some thousand steps",
    ),
    value(BALANCE).at_most(
        0.02,
        "in a tenth of the run the grains can lose no more momentum than they have at the plate's speed",
    ),
    value(GAINED).at_most(
        1e-3,
        "contact adds no energy; work and velocities are half a step of some thousand apart",
    ),
])
.line_of_each(line)
    .wrong_references(&[WRONG_DAMPING])
    .no_study("nothing exact is known of a pile of grains but balances, which hold to round-off whatever the settings")
    .no_guest(NO_GUEST);

/// Grains per side of the packing.
fn side(rung: &Rung) -> usize {
    if rung.variant == "four" { 2 } else { 4 }
}

/// A rigid line between two points, with vertices no more than a quarter of a metre apart.
fn straight(id: i64, name: &str, ends: [[f64; 2]; 2], motion: Option<History>) -> RigidLine {
    let [a, b] = ends.map(Point::from);
    let count = ((b - a).norm() / 0.25).ceil() as usize;
    let points = (0..=count).map(|k| a + (b - a) * (k as f64 / count as f64));
    open_line(name, id, points, motion)
}

/// Quantities without an exact value.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    Some(format!(
        "{}: largest force on the plate {:.4e} N, sideways {:.1} % of it; the floor is loaded after {:.2} m and takes {:.1} % of \
         the plate's force at the end, the damping the rest; slopes of the plate's force {:.2} : 1; distances down to {:.3} of \
         the critical gap",
        rung.label,
        run.value(LARGEST),
        100.0 * run.value(SIDEWAYS),
        run.value(LOADED),
        100.0 * run.value(FLOOR_SHARE),
        run.value(PHASES),
        run.value(SMALLEST),
    ))
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let side = side(rung);
    let per_cell = if side == 2 { 3 } else { 4 };
    let [width, height] = PART.map(|part| part * side as f64);
    let margin = 2.0 * h;
    let cells = |length: f64| ((length + 2.0 * margin) / h).ceil() as usize;
    let mut mesh = Mesh::new(
        Dimension::Two,
        [-margin, -margin, 0.0],
        [h, h, 1.0],
        [cells(width), cells(height), 1],
    );
    mesh.planes[..2].fill([PlaneCondition::Free; 2]);
    let mut scene = plane_scene(&rung.label, mesh, WAY * height / SPEED);
    scene.weighting = PAPER.weighting;
    scene.scheme = PAPER.scheme;
    scene.transfer.kind = PAPER.transfer;
    scene.transfer.pic_fraction = 0.1;
    scene.damping = Damping::Viscous { alpha: DAMPING };
    scene.materials = elastic(DENSITY, YOUNG, POISSON);
    let down = Some([0.0, -SPEED, 0.0].into());
    let (right, top) = (width + 1.0, height + 1.0);
    scene.mortar.lines = vec![
        straight(PLATE, "plate", [[-1.0, height], [right, height]], down),
        straight(FLOOR, "floor", [[right, 0.0], [-1.0, 0.0]], None),
        straight(WALLS[0], "left wall", [[0.0, -1.0], [0.0, top]], None),
        straight(WALLS[1], "right wall", [[width, top], [width, -1.0]], None),
    ];
    for (k, outline) in outlines(side).into_iter().enumerate() {
        let id = k as i64 + 1;
        let shape = Shape::Polygon {
            points: outline.iter().map(|p| [p[0], p[1], 0.0]).collect(),
        };
        scene.bodies.push(Body {
            particles_per_cell: [per_cell, per_cell, 1],
            ..body(format!("grain {id}"), id, shape)
        });
        let chain = Chain {
            points: outline.into_iter().map(Point::from).collect(),
            side: BoundarySide::Outer,
        };
        let vertices = Vertices::Given(vec![chain]);
        scene.mortar.boundaries.push(boundary(id, vertices));
        let masters = (1..id).chain([PLATE, FLOOR, WALLS[0], WALLS[1]]);
        for master in masters {
            let smooth = master == FLOOR || WALLS.contains(&master);
            scene.mortar.contacts.push(MortarContact {
                id: scene.mortar.contacts.len() as i64 + 1,
                friction: if smooth { 0.0 } else { FRICTION },
                tangential_stiffness: KAPPA_T,
                ..barrier(format!("grain {id} and {master}"), [master, id], GAP, KAPPA)
            });
        }
    }
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (simulation, observer) = (run.simulation, run.observer);
    let damping = run.reference.of(&WRONG_DAMPING) * DAMPING;
    let rate = damping * (YOUNG / DENSITY).sqrt() / run.rung.cell;
    let watch = Watch::run(simulation, rate, &mut |share| observer.progress(share))?;
    let force = watch.samples.iter();
    let curve = Curve::new(
        format!("{}: force on the plate", run.rung.label),
        ["way of the plate in m", "F_y in N"],
        force.map(|s| CurvePoint::new(s.way, -s.plate[1], f64::NAN)),
    );
    Ok(Measurements {
        quantities: watch.quantities(simulation),
        drawings: watch.drawings,
        curve: Some(curve),
    })
}
