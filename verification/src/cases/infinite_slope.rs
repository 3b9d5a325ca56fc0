//! Does water that seeps along an endless slope drag on its soil with its weight, and press as much as it is deep?
//!
//! Source: Taylor 1948; Skempton and DeLory 1957, `exact/seepage_slope.rs`. In the coordinates of the slope gravity has a
//! part along it. Water stands up to the surface and flows along it: its pressure is that of its depth, the skeleton bears
//! the buoyant weight across the slope and the whole weight along it. Sides are antisymmetric, and so bear the stress that
//! stands along the slope at the start; beyond them water stands as high as within.
//!
//! Expected: exact on every mesh in the middle, once the water has begun to flow, in k/(n g), which shakes the slope by
//! 0.03 % of its shear stress at the base. At the lowest and highest node of a side a level has the pressure of the node,
//! not of its half cell: some percent off within two cells. Nothing damps what shakes, so that the flux swings about the exact one.
//! Particles beside the base keep the velocity of the skeleton that the base takes from its nodes: their flux is that of the nodes and
//! h/(2 H) of the velocity at the base. `proctor verify infinite-slope`.

use super::prelude::*;
use crate::exact::seepage_slope::SeepageSlope;
use proctor_scene::PlanePressure;

const LENGTH: f64 = 4.0; // Length of the slope [m]
const SLOPE: f64 = 0.25; // Tangent of the slope
const GRAVITY: f64 = 10.0; // Gravity [m/s²]
const CONDUCTIVITY: f64 = 1e-4; // Hydraulic conductivity [m/s]
const AT_REST_RATIO: f64 = 0.5; // Effective stress along the slope over that across it
const END: f64 = 0.2; // 8000 times in which the water begins to flow, ten ways of a shear wave through the layer [s]
const FLUX: &str = "flux of the water";
const ACROSS: &str = "max(effective stress across the slope)";
const SHEAR: &str = "max(shear stress)";
const PRESSURE: &str = "max(p)";
const WRONG_CONDUCTIVITY: Wrong =
    Wrong::factor("conductivity", 1.03).breaks_only(|gate| gate.contains(FLUX));
const WRONG_WEIGHT: Wrong =
    Wrong::factor("weight", 1.03).breaks_only(|gate| gate.contains("stress"));

/// The slope along which water seeps.
pub static INFINITE_SLOPE: Case = Case::new(
    "infinite-slope",
    "Does water that seeps along an endless slope drag on its soil with its weight, and press as much as it is deep?",
)
.ladder(Ladder::cells("slope", "H/h", HEIGHT, &[16], &[8, 16, 32]))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.options(|_, _, options| {
    starting(options, |x| {
        let (slope, depth) = (exact(), HEIGHT - x[1]);
        let across = slope.effective_stress(depth);
        InitialState {
            stress: [AT_REST_RATIO * across, across, 0.0, 0.0, 0.0, slope.shear_stress(depth)],
            ..AT_REST
        }
    })
})
.compare(compare)
.gates_of_rungs(&[
    error(FLUX).at_most(1e-2, "one percent"),
    error(ACROSS).at_most(1e-2, "one percent"),
    error(SHEAR).at_most(1e-2, "one percent: the water that begins to flow shakes a thirtieth of it"),
    error(PRESSURE).at_most(1e-2, "one percent"),
])
.wrong_references(&[WRONG_CONDUCTIVITY, WRONG_WEIGHT])
.no_study("it is exact on every mesh")
.no_guest("no other solver of the protocol knows pore water");

/// The exact slope.
fn exact() -> SeepageSlope {
    SeepageSlope {
        angle: libm::atan(SLOPE),
        depth: HEIGHT,
        density: exact_column(CONDUCTIVITY).saturated_density(),
        density_water: WATER,
        gravity: GRAVITY,
    }
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let water = pore_water(POROSITY, CONDUCTIVITY);
    let mut scene = wet_column("infinite_slope", h, settings, water, END);
    let slope = exact();
    let [along, across] = [libm::sin(slope.angle), libm::cos(slope.angle)];
    scene.gravity = [GRAVITY * along, -GRAVITY * across, 0.0];
    scene.mesh.cells[0] = cells(LENGTH, h);
    scene.mesh.planes[0] = [PlaneCondition::Antisymmetric; 2];
    scene.mesh.planes[1][0] = PlaneCondition::Fixed;
    scene.water_planes[0] = [PlaneCondition::Free; 2];
    let level = || Some(PlanePressure::Level(History::from([HEIGHT, 0.0, 0.0])));
    scene.water_pressures[0] = [level(), level()];
    // Each row of particles has the pressure of its middle.
    let rows = settings.particles_per_cell * cells(HEIGHT, h);
    for row in 0..rows {
        let [low, high] = [row, row + 1].map(|row| HEIGHT * row as f64 / rows as f64);
        let depth = HEIGHT - 0.5 * (low + high);
        scene.initial_pressures.push(InitialPressure::Box {
            p1: [0.0, low, 0.0],
            p2: [LENGTH, high, 0.0],
            pressure: slope.pressure(depth),
        });
    }
    scene.bodies = vec![body("slope", 1, rectangle([0.0; 2], [LENGTH, HEIGHT]))];
    settings.applied(scene)
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let simulation = &*run.simulation;
    let (h, reference) = (run.rung.cell, run.reference);
    let (weight, slope) = (reference.of(&WRONG_WEIGHT), exact());
    let stress = |depth: f64| {
        [slope.effective_stress(depth), slope.shear_stress(depth)].map(|stress| weight * stress)
    };
    let set = &simulation.sets()[0];
    let count = cells(HEIGHT, h);
    let mut sums = vec![([0.0; 3], 0.0); count];
    let mut flux = 0.0;
    // Means over the two columns of cells in the middle.
    let middle = (0..set.len()).filter(|p| (set.position(*p)[0] - 0.5 * LENGTH).abs() < h);
    for p in middle {
        let cell = ((set.position(p)[1] / h) as usize).min(count - 1);
        let stress = set.stress(p);
        let values = [stress[1], stress[5], pore_pressure(simulation, 0, p)];
        for (sum, value) in sums[cell].0.iter_mut().zip(values) {
            *sum += value;
        }
        sums[cell].1 += 1.0;
        let Some(first) = set.layout.water else {
            continue;
        };
        flux += POROSITY * (set.vector(first, p)[0] - set.velocity(p)[0]);
    }
    let mut off = [0.0_f64; 3];
    let mut points = vec![];
    let mut particles = 0.0;
    for (cell, (sum, own)) in sums.into_iter().enumerate() {
        let depth = HEIGHT - (cell as f64 + 0.5) * h;
        let [across, shear] = stress(depth);
        let found = sum.map(|sum| sum / own);
        for (off, (found, exact)) in
            (off.iter_mut()).zip(
                found
                    .into_iter()
                    .zip([across, shear, slope.pressure(depth)]),
            )
        {
            *off = off.max((found - exact).abs());
        }
        points.push(CurvePoint::new(depth, found[2], slope.pressure(depth)));
        particles += own;
    }
    let conductivity = CONDUCTIVITY * GRAVITY / CONDUCTIVITY_GRAVITY;
    let exact = reference.of(&WRONG_CONDUCTIVITY) * slope.flux(conductivity);
    let [across, shear] = stress(HEIGHT);
    let curve = Curve::new(
        format!(
            "pore pressure in the middle of the slope, {}",
            run.rung.label
        ),
        ["depth (m)", "pressure (Pa)"],
        points,
    );
    Ok(Measurements::of([
        Quantity::compared(FLUX, flux / particles, exact, "m/s"),
        ratio(ACROSS, Some(off[0] / across.abs())),
        ratio(SHEAR, Some(off[1] / shear.abs())),
        ratio(PRESSURE, Some(off[2] / slope.pressure(HEIGHT))),
    ])
    .drawn(curve))
}
