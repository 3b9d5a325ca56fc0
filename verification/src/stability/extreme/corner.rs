//! Falls onto corners, and what a fall with contact must keep.

use std::sync::Arc;

use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    BodyBoundary, Enforcement, MortarContact, RigidLine, RigidSurface, Scene, Shape, StressScheme,
    Vector, Vertices,
};

use super::trial::{
    GROWN, NO_GROWTH, ONLY_ROUND_OFF, ROUND_OFF, apart, elastic, energy, momentum_scale, open,
    open_space, run_to, start, worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme {
    name: "corner-fall",
    what: "free fall of a cube onto a ridge, and of a square onto its own corner",
    required: "momentum is what weight and contact gave, nothing pulls, nothing passes, no growth of energy",
    cause: None,
    judge: corner_fall,
}];

/// What was found of a fall with contact.
#[derive(Default)]
pub(super) struct Fall {
    /// Momentum that neither weight nor contact gave, over that of all particles.
    lost: f64,
    /// Sideways impulse over upward impulse.
    sideways: f64,
    /// Largest pull over the largest push.
    pull: f64,
    /// Energy over that at the start, with the work of the weight.
    grown: f64,
    /// Deepest penetration of a particle into a rigid surface \[m\].
    pub depth: f64,
    /// Impulse upwards over the momentum of the fall: whether anything was touched.
    pushed: f64,
}

/// Runs a fall along the axis `up`; `force` is that of contact on the body in a step \[N\].
pub(super) fn watch_fall(
    scene: &Scene,
    up: usize,
    time: f64,
    force: impl Fn(&Simulation) -> Vector,
) -> Result<Fall, Unexpected> {
    let mut simulation = start(scene, None)?;
    let (mass, before) = (simulation.mass(), simulation.momentum());
    let begin = energy(&simulation);
    let from = simulation.center(0).position[up];
    let mut found = Fall::default();
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
        for p in 0..s.particles() {
            if let Some((gap, _)) = scene
                .surfaces
                .first()
                .and_then(|_| s.surface_gap(0, 0, p, 1.0))
            {
                found.depth = worst(found.depth, -gap);
            }
        }
        let lost = apart(&s.momentum(), &exact) / momentum_scale(s);
        found.lost = worst(found.lost, lost);
        let fallen = from - s.center(0).position[up];
        let given = begin - mass * scene.gravity[up] * fallen;
        found.grown = worst(found.grown, energy(s) / given.max(begin));
    })?;
    let sideways = (0..3).filter(|axis| *axis != up);
    found.sideways = sideways
        .map(|axis| (impulse[axis] / impulse[up]).abs())
        .fold(0.0, worst);
    found.pull = pull / push;
    found.pushed = impulse[up] / before[up].abs();
    Ok(found)
}

/// Gates that falls must keep, on the worst of several.
pub(super) fn fair(name: &str, falls: &[&Fall]) -> [Gate; 5] {
    let most = |of: fn(&Fall) -> f64| falls.iter().map(|fall| of(fall)).fold(0.0, worst);
    let least = falls.iter().map(|fall| fall.pushed);
    [
        Gate::at_least(
            format!("{name}: impulse of contact over the momentum of the fall"),
            least.fold(f64::INFINITY, f64::min),
            1.0,
            "what is stopped has got at least the momentum that it fell with",
        ),
        Gate::at_most(
            format!("{name}: momentum that neither weight nor contact gave"),
            most(|fall| fall.lost),
            ROUND_OFF,
            ONLY_ROUND_OFF,
        ),
        Gate::at_most(
            format!("{name}: pull over push"),
            most(|fall| fall.pull),
            ROUND_OFF,
            "contact never pulls",
        ),
        Gate::at_most(
            format!("{name}: impulse sideways over that upwards"),
            most(|fall| fall.sideways),
            1e-5,
            "the scene is its own mirror image; sweeps of contact end at 1e-6 of what the first one changes",
        ),
        Gate::at_most(
            format!("{name}: energy over what start and weight gave"),
            most(|fall| fall.grown),
            GROWN,
            NO_GROWTH,
        ),
    ]
}

/// A cube that falls on a ridge of two triangles' width below its middle.
fn onto_ridge(scheme: StressScheme) -> Result<Fall, Unexpected> {
    const MIDDLE: f64 = 4.0;
    let mut scene = open_space([8, 8, 9]).with_gravity([0.0, 0.0, -1e-3]);
    scene.scheme = scheme;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    let cube = Shape::Cuboid {
        p1: [MIDDLE - 1.0, 3.0, 3.1],
        p2: [MIDDLE + 1.0, 5.0, 5.1],
    };
    scene.add_body(cube, material).velocity = [0.0, 0.0, -0.05];
    let (a, b) = ([MIDDLE, 0.5, 2.8], [MIDDLE, 7.5, 2.8]);
    let (left, right) = (
        [[0.5, 0.5, 0.6], [0.5, 7.5, 0.6]],
        [[7.5, 0.5, 0.6], [7.5, 7.5, 0.6]],
    );
    let corners = [
        [a, b, left[0]],
        [b, left[1], left[0]],
        [a, right[0], b],
        [right[0], right[1], b],
    ];
    let surface = Surface::new(&corners.map(|t| t.map(Into::into)))
        .map_err(|error| Unexpected(error.to_string()))?;
    scene.surfaces = vec![RigidSurface {
        name: String::from("ridge"),
        surface: Arc::new(surface),
        friction: 0.0,
        distance_threshold: 1.0,
        penalty_stiffness: None,
        motion: None,
    }];
    watch_fall(&scene, 2, 30.0, |s| s.surface_force(0).map(|f| -f))
}

/// A square that falls on its own corner onto a rigid line.
fn onto_own_corner(scheme: StressScheme) -> Result<Fall, Unexpected> {
    const CENTER: [f64; 2] = [6.0, 6.2];
    const HALF: f64 = 2.0;
    let mut scene = open([12, 12]).with_gravity([0.0, -1e-3, 0.0]);
    scene.scheme = scheme;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    let points = [[0.0, -HALF], [HALF, 0.0], [0.0, HALF], [-HALF, 0.0]]
        .map(|[x, y]| [CENTER[0] + x, CENTER[1] + y, 0.0]);
    let square = Shape::Polygon {
        points: points.to_vec(),
    };
    let mut body = scene.add_body(square, material);
    body.velocity = [0.0, -0.05, 0.0];
    let id = body.id;
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
    scene.mortar.boundaries = vec![BodyBoundary {
        body: id,
        vertices: Vertices::Spacing(0.5),
        follow: FollowMode::Spin,
    }];
    scene.mortar.contacts = vec![MortarContact {
        name: String::from("contact"),
        id: 1,
        master: 9,
        slave: id,
        friction: 0.0,
        critical_gap: 0.15,
        normal_stiffness: 10.0,
        tangential_stiffness: 10.0,
        enforcement: Enforcement::Barrier,
        detection: Detection::Mortar,
    }];
    watch_fall(&scene, 1, 40.0, |s| {
        s.mortar_force(id).unwrap_or([f64::NAN; 3])
    })
}

fn corner_fall() -> Result<Finding, Unexpected> {
    let (ridge, corner) = ("cube on a ridge", "square on its corner");
    let mut falls = vec![];
    for scheme in SCHEMES {
        falls.push((ridge, onto_ridge(scheme)?));
    }
    // Mortar contact is refused with USF.
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        falls.push((corner, onto_own_corner(scheme)?));
    }
    let mut gates = vec![];
    for name in [ridge, corner] {
        let own = falls.iter().filter(|(own, _)| *own == name);
        gates.extend(fair(name, &own.map(|(_, fall)| fall).collect::<Vec<_>>()));
    }
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
