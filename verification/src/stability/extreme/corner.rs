//! Falls onto corners, and what a fall with contact must keep.

use super::prelude::*;
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::RigidLine;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme::of("corner-fall", corner_fall)
        .with("free fall of a cube onto a ridge, and of a square onto its own corner")
        .must("momentum is that of weight and contact, nothing pulls, nothing passes, no growth of energy"),];

/// Falls with contact along an axis, and what the worst of several must keep.
pub(super) struct Falls {
    /// The axis of the fall.
    up: usize,
    pushed: Gate,
    lost: Gate,
    pull: Gate,
    sideways: Gate,
    grown: Gate,
    /// Deepest penetration of a particle into a rigid surface \[m\].
    pub depth: f64,
}

impl Falls {
    /// Falls of that name, none yet.
    pub(super) fn named(name: &str, up: usize) -> Self {
        Self {
            up,
            pushed: gate(format!("{name}: impulse of contact over the momentum of the fall"))
                .at_least(1.0)
                .because("a stopped body has got at least the momentum that it fell with"),
            lost: gate(format!("{name}: momentum that neither weight nor contact gave"))
                .at_most(ROUND_OFF)
                .because(ONLY_ROUND_OFF),
            pull: gate(format!("{name}: pull over push"))
                .at_most(ROUND_OFF)
                .because("contact never pulls"),
            sideways: gate(format!("{name}: impulse sideways over that upwards"))
                .at_most(1e-5)
                .because("the scene is its own mirror image; sweeps of contact end at 1e-6 of the change of the first one"),
            grown: gate(format!("{name}: energy over what start and weight gave"))
                .at_most(GROWN)
                .because(NO_GROWTH),
            depth: 0.0,
        }
    }

    /// Runs a fall; `force` is that of contact on the body in a step \[N\].
    pub(super) fn watch(
        &mut self,
        scene: &Scene,
        time: f64,
        force: impl Fn(&Simulation) -> Vector,
    ) -> Result<(), RowFault> {
        let up = self.up;
        let mut simulation = start(scene, &options())?;
        let (mass, before) = (simulation.mass(), simulation.momentum());
        let begin = energy(&simulation);
        let from = simulation.center(0).position[up];
        let (mut impulse, mut kicks, mut dt_before) = ([0.0; 3], 0.0, 0.0);
        let (mut pull, mut push) = (0.0_f64, 0.0_f64);
        run_to(&mut simulation, time, |s, info| {
            // Velocities are half a step behind positions.
            let kick = 0.5 * (dt_before + info.dt);
            dt_before = info.dt;
            kicks += kick;
            let now = force(s);
            for axis in 0..3 {
                impulse[axis] += now[axis] * kick;
            }
            push = push.max(now[up]);
            pull = pull.max(-now[up]);
            let exact: Vector =
                std::array::from_fn(|k| before[k] + impulse[k] + mass * scene.gravity[k] * kicks);
            let surface = scene.surfaces.first();
            let gaps = surface.into_iter().flat_map(|_| 0..s.particles());
            for (gap, _) in gaps.filter_map(|p| s.surface_gap(0, 0, p, 1.0)) {
                self.depth = worst(self.depth, -gap);
            }
            let lost = apart(&s.momentum(), &exact) / momentum_scale(s);
            self.lost.see(lost);
            let fallen = from - s.center(0).position[up];
            let given = begin - mass * scene.gravity[up] * fallen;
            self.grown.see(energy(s) / given.max(begin));
        })?;
        for axis in (0..3).filter(|axis| *axis != up) {
            self.sideways.see((impulse[axis] / impulse[up]).abs());
        }
        self.pull.see(pull / push);
        self.pushed.see(impulse[up] / before[up].abs());
        Ok(())
    }

    /// The condition that must hold.
    pub(super) fn gates(self) -> [Gate; 5] {
        [self.pushed, self.lost, self.pull, self.sideways, self.grown]
    }
}

/// An elastic cube that falls at a speed onto a rigid surface without friction; the weight is a thousandth of a cell per
/// square second.
pub(super) fn onto_surface(
    cells: [usize; 3],
    [p1, p2]: [Vector; 2],
    corners: &[[Vector; 3]],
    penalty_stiffness: Option<f64>,
) -> Result<Scene, RowFault> {
    let mut scene = open_space(cells).with_gravity([0.0, 0.0, -1e-3]);
    scene.body(cuboid(p1, p2), elastic(1.0, 0.3), 1.0).velocity = [0.0, 0.0, -0.05];
    let surface = Surface::new(corners).map_err(|error| RowFault(error.to_string()))?;
    scene.surfaces = vec![RigidSurface {
        name: String::from("surface"),
        surface: Arc::new(surface),
        friction: 0.0,
        distance_threshold: 1.0,
        penalty_stiffness,
        motion: None,
    }];
    Ok(scene)
}

/// Mortar contact without friction of a slave with a master.
pub(super) fn mortar_pair(
    [master, slave]: [i64; 2],
    critical_gap: f64,
    stiffness: f64,
    enforcement: Enforcement,
) -> MortarContact {
    MortarContact {
        name: String::from("contact"),
        id: 1,
        master,
        slave,
        friction: 0.0,
        critical_gap,
        normal_stiffness: stiffness,
        tangential_stiffness: stiffness,
        enforcement,
        detection: Detection::Mortar,
    }
}

/// The boundary of a body, with a vertex every half cell.
pub(super) fn boundary(body: i64) -> BodyBoundary {
    BodyBoundary {
        body,
        vertices: Vertices::Spacing(0.5),
        follow: FollowMode::Spin,
    }
}

/// A cube that falls on a ridge of two triangles' width below its middle.
fn ridge() -> Result<Scene, RowFault> {
    const MIDDLE: f64 = 4.0;
    let cube = [[MIDDLE - 1.0, 3.0, 3.1], [MIDDLE + 1.0, 5.0, 5.1]];
    let (a, b) = ([MIDDLE, 0.5, 2.8], [MIDDLE, 7.5, 2.8]);
    let [left, right] = [0.5, 7.5].map(|x| [[x, 0.5, 0.6], [x, 7.5, 0.6]]);
    let corners = [
        [a, b, left[0]],
        [b, left[1], left[0]],
        [a, right[0], b],
        [right[0], right[1], b],
    ];
    onto_surface([8, 8, 9], cube, &corners, None)
}

/// A square that falls on its own corner onto a rigid line.
fn own_corner() -> Scene {
    let points = [[6.0, 4.2], [8.0, 6.2], [6.0, 8.2], [4.0, 6.2]];
    let points = points.map(|[x, y]| [x, y, 0.0]).to_vec();
    let square = Shape::Polygon { points };
    let mut scene = alone([12, 12], square, elastic(1.0, 0.3)).with_gravity([0.0, -1e-3]);
    scene.bodies[0].velocity = [0.0, -0.05, 0.0];
    // The material is on the left of a line, so it lies below one that runs to the left.
    scene.mortar.lines = vec![RigidLine {
        name: String::from("ground"),
        id: 9,
        chains: vec![Chain {
            points: vec![Point::new(11.0, 4.0), Point::new(1.0, 4.0)],
            side: BoundarySide::Open,
        }],
        motion: None,
    }];
    scene.mortar.boundaries = vec![boundary(1)];
    scene.mortar.contacts = vec![mortar_pair([9, 1], 0.15, 10.0, Enforcement::Barrier)];
    scene
}

fn corner_fall() -> RowVerdict {
    let mut cube = Falls::named("cube on a ridge", 2);
    for scheme in SCHEMES {
        let pushed = |s: &Simulation| s.surface_force(0).map(|f| -f);
        cube.watch(&ridge()?.with_scheme(scheme), 30.0, pushed)?;
    }
    let mut square = Falls::named("square on its corner", 1);
    // Mortar contact is refused with USF.
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let pushed = |s: &Simulation| s.mortar_force(1).unwrap_or([f64::NAN; 3]);
        square.watch(&own_corner().with_scheme(scheme), 40.0, pushed)?;
    }
    Ok(Finding::of(cube.gates()).and(square.gates()))
}
