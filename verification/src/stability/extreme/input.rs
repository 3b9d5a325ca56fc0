//! Input that no scene may have.

use super::prelude::*;
use proctor_scene::{BoxLoad, History, PointLoad, Traction};

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("not-finite-input", not_finite_input)
        .with("NaN and both infinities in every number of a scene, one at a time")
        .must("refused with the name and the index of the field"),
    Extreme::of("impossible-constants", impossible_constants)
        .with("E = 0, rho = 0, nu = 0.5, nu = -1, a volume of 0, and all of them negative")
        .must("refused with the name of the constant"),
];

/// A sound scene with something in every list.
pub fn full() -> Scene {
    let mut scene = block([12, 12], [2.0, 2.0], [4.0, 4.0], soft());
    scene.materials[0].name = String::from("elastic");
    scene.time = 1.0;
    scene.add_body(rectangle([6.0, 2.0], [8.0, 4.0]), 0).motion = Some(always([0.1, 0.0, 0.0]));
    scene.add_body(Shape::disc([3.0, 8.0], 1.0), 0);
    scene.contacts = vec![collinear(1, 1, 2, 0.3)];
    scene.point_loads = vec![PointLoad {
        position: [3.0, 3.0, 0.0],
        force: [0.1, 0.0, 0.0],
    }];
    scene.tractions = vec![Traction {
        p1: [2.0, 4.0, 0.0],
        p2: [4.0, 4.0, 0.0],
        traction: [0.0, 0.1, 0.0].into(),
    }];
    scene.box_loads = vec![BoxLoad {
        p1: [2.0, 2.0, 0.0],
        p2: [3.0, 3.0, 0.0],
        force: [0.1, 0.0, 0.0],
    }];
    scene
}

/// A field by its path, and how a value gets there.
struct Entry(&'static str, fn(&mut Scene, f64));

/// Names of fields, and where they lie in a scene.
macro_rules! entries {
    ($($path:literal: |$s:ident, $x:ident| $put:expr;)+) => {
        &[$(Entry($path, |$s, $x| { $put; })),+]
    };
}

/// Range of each number that is finite.
const NUMBERS: &[Entry] = entries! {
    "time": |s, x| s.time = x;
    "gravity[1]": |s, x| s.gravity[1] = x;
    "time_step": |s, x| s.time_step = fixed(x);
    "critical_time_step_multiplier": |s, x| s.time_step = multiple(x);
    "pic_fraction": |s, x| s.transfer.pic_fraction = x;
    "damping.alpha": |s, x| s.damping = Damping::Local { alpha: x };
    "damping.alpha": |s, x| s.damping = Damping::Viscous { alpha: x };
    "mesh.origin[0]": |s, x| s.mesh.origin[0] = x;
    "mesh.cells_dimension[1]": |s, x| s.mesh.cell[1] = x;
    "materials[0].density": |s, x| s.materials[0].density = x;
    "materials[0].young": |s, x| s.materials[0].law = elastic(x, 0.3);
    "materials[0].poisson": |s, x| s.materials[0].law = elastic(1.0, x);
    "bodies[0].initial_velocity[1]": |s, x| s.bodies[0].velocity[1] = x;
    "bodies[0].point_p1[0]": |s, x| s.bodies[0].shape = rectangle([x, 2.0], [4.0, 4.0]);
    "bodies[1].prescribed_velocity[0][1]": |s, x| s.bodies[1].motion = Some(always([0.1, x, 0.0]));
    "bodies[1].prescribed_velocity[0]": |s, x| s.bodies[1].motion = Some(from_then_on(x));
    "bodies[2].center[1]": |s, x| s.bodies[2].shape = Shape::disc([3.0, x], 1.0);
    "bodies[2].radius": |s, x| s.bodies[2].shape = Shape::disc([3.0, 8.0], x);
    "bodies[2].particles[1][0]": |s, x| s.bodies[2].shape = second([x, 8.0, 0.0], 0.1);
    "bodies[2].particles[1]": |s, x| s.bodies[2].shape = second([3.0, 8.0, 0.0], x);
    "nodal_point_load[0][0][1]": |s, x| s.point_loads[0].position[1] = x;
    "nodal_point_load[0][1][0]": |s, x| s.point_loads[0].force[0] = x;
    "traction[0].point_p1[0]": |s, x| s.tractions[0].p1[0] = x;
    "traction[0].traction[1]": |s, x| s.tractions[0].traction.values[0][1] = x;
    "box_load[0].force[0]": |s, x| s.box_loads[0].force[0] = x;
    "box_load[0].point_p2[1]": |s, x| s.box_loads[0].p2[1] = x;
    "contact_manager.real_distance_correction_coefficient": |s, x| s.contact_distance = Some(x);
};

/// An edge of a cell.
const EDGE: Entry = Entry("mesh.cells_dimension[0]", |s, x| s.mesh.cell[0] = x);

/// A value that no constant but Poisson's ratio may have.
const NOT_POSITIVE: &[f64] = &[0.0, -0.0, -1.0];

/// Fields with their impossible values.
const IMPOSSIBLE: &[(&str, &[f64])] = &[
    ("materials[0].young", NOT_POSITIVE),
    ("materials[0].poisson", &[0.5, -1.0, 0.6, -2.0]),
    ("materials[0].density", NOT_POSITIVE),
    ("bodies[2].particles[1]", NOT_POSITIVE),
    ("bodies[2].radius", NOT_POSITIVE),
    ("mesh.cells_dimension[0]", NOT_POSITIVE),
    ("time", NOT_POSITIVE),
];

/// The velocity of the second body from a time on \[s\].
fn from_then_on(time: f64) -> History {
    History {
        times: vec![time],
        ..always([0.1, 0.0, 0.0])
    }
}

/// Two particles, the second as it is given.
fn second(position: Vector, volume: f64) -> Shape {
    listed([([2.0, 8.0, 0.0], 0.1), (position, volume)])
}

/// The message of a scene that its check refuses with this path.
///
/// # Errors
/// A scene that is taken, or refused for something else.
pub fn refused_for(path: &str, scene: &Scene) -> Result<String, RowFault> {
    let what = format!("a fault in {path}");
    match scene.simulate(&options()) {
        Err(StartError::Scene(error)) => match error.problems.iter().find(|p| p.path == path) {
            Some(problem) => Ok(problem.to_string()),
            None => Err(unexpected(what, format!("is called {error}"))),
        },
        Err(StartError::Setup(error)) => Err(unexpected(
            what,
            format!("was only found when the run was set up: {error}"),
        )),
        Ok(_) => Err(unexpected(what, "was not refused")),
    }
}

/// The message of the sound scene with a number put into it.
fn refused_with(path: &str, put: impl Fn(&mut Scene)) -> Result<String, RowFault> {
    let mut scene = full();
    put(&mut scene);
    refused_for(path, &scene)
}

fn not_finite_input() -> RowVerdict {
    // What is refused must be the number, and nothing else of the scene.
    start(&full(), &options())?;
    let mut refusals = vec![];
    for Entry(path, put) in NUMBERS {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            refusals.push(refused_with(path, |scene| put(scene, value))?);
        }
    }
    // Infinite friction is contact that never slips.
    for value in [f64::NAN, f64::NEG_INFINITY] {
        let put = |scene: &mut Scene| scene.contacts[0].friction = value;
        refusals.push(refused_with("contact[0].friction", put)?);
    }
    Ok(Finding::default().refusing(refusals))
}

fn impossible_constants() -> RowVerdict {
    let mut refusals = vec![];
    for (path, values) in IMPOSSIBLE {
        let entries = NUMBERS.iter().chain([&EDGE]);
        for Entry(_, put) in entries.filter(|entry| entry.0 == *path) {
            for &value in *values {
                refusals.push(refused_with(path, |scene| put(scene, value))?);
            }
        }
    }
    Ok(Finding::default().refusing(refusals))
}
