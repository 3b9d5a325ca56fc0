//! Numbers that no scene may have: in its input, and those that go wrong at the start or on the way.

use super::prelude::*;
use crate::cases::traction;
use proctor_scene::simulation::BodyHandle;
use proctor_scene::{BoxLoad, PointLoad};

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("not-finite-input", not_finite_input)
        .with("NaN and both infinities in every number of a scene, one at a time")
        .must("refused with the name and the index of the field"),
    Extreme::of("impossible-constants", impossible_constants)
        .with("E = 0, rho = 0, nu = 0.5, nu = -1, a volume of 0, and all of them negative")
        .must("refused with the name of the constant"),
    Extreme::of("not-finite-state", not_finite_state)
        .with("a velocity, a stress, a deformation or a force becomes NaN or infinite")
        .must("the run stops in the same step, and goes on from the state before"),
];

/// A sound scene with something in every list.
pub fn full() -> Scene {
    let mut scene = block([12, 12], [2.0, 2.0], [4.0, 4.0], soft());
    scene.materials[0].name = String::from("elastic");
    scene.time = 1.0;
    scene.add_body(rectangle([6.0, 2.0], [8.0, 4.0]), 0).motion = Some([0.1, 0.0, 0.0].into());
    scene.add_body(Shape::disc([3.0, 8.0], 1.0), 0);
    scene.add_contact([0, 1].map(BodyHandle::from), 0.3);
    scene.point_loads = vec![PointLoad {
        position: [3.0, 3.0, 0.0],
        force: [0.1, 0.0, 0.0],
    }];
    scene.tractions = traction([2.0, 4.0, 0.0], [4.0, 4.0, 0.0], [0.0, 0.1, 0.0]);
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
    "bodies[1].prescribed_velocity[0][1]": |s, x| s.bodies[1].motion = Some([0.1, x, 0.0].into());
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

/// Friction of a contact.
const FRICTION: Entry = Entry("contact[0].friction", |s, x| s.contacts[0].friction = x);
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
        ..[0.1, 0.0, 0.0].into()
    }
}

/// Two particles, the second as it is given.
fn second(position: Vector, volume: f64) -> Shape {
    listed([([2.0, 8.0, 0.0], 0.1), (position, volume)])
}

/// The message of a scene that its check refuses with this path.
pub fn refused_for(path: &str, scene: &Scene) -> Result<String> {
    let what = format!("a fault in {path}");
    refused(what, scene, &options(), |error| match error {
        StartError::Scene(error) => {
            let problem = error.problems.iter().find(|problem| problem.path == path);
            problem.map(ToString::to_string)
        }
        StartError::Setup(_) => None,
    })
}

impl Entry {
    /// Messages of the sound scene with each of some numbers put into it.
    fn refused(&self, values: &[f64]) -> Result<Vec<String>> {
        let Self(path, put) = self;
        let refuse = |value: &f64| {
            let mut scene = full();
            put(&mut scene, *value);
            refused_for(path, &scene)
        };
        values.iter().map(refuse).collect()
    }
}

fn not_finite_input() -> RowVerdict {
    // What is refused must be the number, and nothing else of the scene.
    start(&full(), &options())?;
    let mut refusals = vec![];
    for entry in NUMBERS {
        refusals.extend(entry.refused(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY])?);
    }
    // Infinite friction is contact that never slips.
    refusals.extend(FRICTION.refused(&[f64::NAN, f64::NEG_INFINITY])?);
    Ok(Finding::default().refusing(refusals))
}

fn impossible_constants() -> RowVerdict {
    let mut refusals = vec![];
    for (path, values) in IMPOSSIBLE {
        let entries = NUMBERS.iter().chain([&EDGE]);
        for entry in entries.filter(|entry| entry.0 == *path) {
            refusals.extend(entry.refused(values)?);
        }
    }
    Ok(Finding::default().refusing(refusals))
}

/// Faults at the start of one particle.
const FAULTS: [fn(&mut InitialState, f64); 3] = [
    |state, x| state.velocity[1] = x,
    |state, x| state.stress[0] = x,
    |state, x| state.deformation[0][0] = x,
];

fn not_finite_state() -> RowVerdict {
    let mut late = gate("values that are not finite and did not stop the run in their step")
        .none("a value that is not finite reaches all neighbours in one step, so that the step must be the last");
    let mut refusals = vec![];
    for method in methods() {
        let scene = with(&block([8, 8], [2.5, 2.5], [5.5, 5.5], soft()), method);
        for put in FAULTS {
            for value in [f64::NAN, f64::INFINITY] {
                let sick = from(move |x| {
                    let mut state = AT_REST;
                    // The place of one particle.
                    if x[..2] == [3.75, 3.25] {
                        put(&mut state, value);
                    }
                    state
                });
                let Err(error) = start(&scene, &sick)?.step(NEVER) else {
                    late.count(true);
                    continue;
                };
                match error.kind {
                    // An infinite speed allows no step at all.
                    StepErrorKind::NotFinite(_) | StepErrorKind::TimeStands { .. } => {
                        refusals.push(format!("{method}: {error}"));
                    }
                    _ => return Err(unexpected(format!("{method}: a value {value}"), error)),
                }
            }
        }
        refusals.push(goes_on_from_before(&scene, &mut late)?);
    }
    Ok(Finding::of([late]).refusing(refusals))
}

/// The message of a force that becomes NaN, which stops the run in that step; the state saved before goes on without it to
/// the same bits.
fn goes_on_from_before(scene: &Scene, late: &mut Gate) -> Result<String> {
    let what = method(scene);
    let run = |sick: bool| {
        let mut options = options();
        options.body_force = Some(Arc::new(move |_, x, t| {
            let broken = sick && t > 0.5 && x[0] > 4.0;
            [if broken { f64::NAN } else { 0.01 }, 0.0, 0.0]
        }));
        start(scene, &options)
    };
    let mut sick = run(true)?;
    let mut good = sick.save();
    let error = stopped(&mut sick, 1000, |s| good = s.save())?;
    // The force is evaluated at the beginning of a step.
    late.count(good.state.clock.time <= 0.5 || error.time != good.state.clock.time);
    if !matches!(error.kind, StepErrorKind::NotFinite(_)) {
        return Err(unexpected(what + ": a force that is not a number", error));
    }
    let mut healed = run(false)?;
    healed.restore(good).map_err(|e| unexpected(&what, e))?;
    steps(&mut healed, 10)?;
    let mut whole = run(false)?;
    steps(&mut whole, healed.steps())?;
    if whole.state_hash() != healed.state_hash() {
        let fault = "the state before the fault does not go on as if there had been none";
        return Err(unexpected(what, fault));
    }
    Ok(format!("{what}: {error}"))
}
