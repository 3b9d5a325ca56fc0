//! Input that no scene may have, numbers that go wrong on the way, and scenes of nothing.

use std::sync::Arc;

use proctor_kernel::memory::Memory;
use proctor_kernel::scene::{
    BoxLoad, Contact, ContactNormal, Damping, History, Outside, PointLoad, Scene, Shape, TimeStep,
    Traction,
};
use proctor_kernel::simulation::{
    BodyForce, InitialState, Options, SetupError, StartError, StepErrorKind,
};

use super::runs::{block, first_error, from, methods, open, options, soft, start, steps, with};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::{AT_REST, cuboid, elastic_law};
use proctor_kernel::scene::{Dimension, ParticleSeed};

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "not-finite-input",
        what: "NaN and both infinities in every number of a scene, one at a time",
        required: "refused with the name and the index of the field",
        cause: None,
        judge: not_finite_input,
    },
    Extreme {
        name: "not-finite-state",
        what: "a velocity, a stress, a deformation or a force becomes NaN or infinite",
        required: "the run stops in the same step, and goes on from the state before",
        cause: None,
        judge: not_finite_state,
    },
    Extreme {
        name: "impossible-constants",
        what: "E = 0, rho = 0, nu = 0.5, nu = -1, a volume of 0, and all of them negative",
        required: "refused with the name of the constant",
        cause: None,
        judge: impossible_constants,
    },
    Extreme {
        name: "no-particles",
        what: "no body, an empty list of particles, a body without extent, a body all of which has left",
        required: "refused with a reason; what has left is booked, and the empty run goes on",
        cause: None,
        judge: no_particles,
    },
    Extreme {
        name: "empty-mesh",
        what: "1e8 cells for four particles, in memory that does not hold them and in a mesh of 1e6",
        required: "refused with how much there is; what fits runs, and the body falls as it must",
        cause: None,
        judge: empty_mesh,
    },
];

/// A sound scene with something in every list.
fn full() -> Scene {
    let mut scene = block([12, 12], [2.0, 2.0], [4.0, 4.0], soft());
    let mut other = scene.bodies[0].clone();
    other.id = 2;
    other.shape = cuboid([6.0, 2.0, 0.0], [8.0, 4.0, 0.0]);
    other.motion = Some(History {
        times: vec![0.0],
        values: vec![[0.1, 0.0, 0.0]],
    });
    let mut disc = scene.bodies[0].clone();
    disc.id = 3;
    disc.shape = Shape::disc([3.0, 8.0], 1.0);
    scene.bodies.extend([other, disc]);
    scene.contacts = vec![Contact {
        name: "contact".to_owned(),
        id: 1,
        friction: 0.3,
        master: 1,
        slave: 2,
        normal: ContactNormal::Collinear,
    }];
    scene.point_loads = vec![PointLoad {
        position: [3.0, 3.0, 0.0],
        force: [0.1, 0.0, 0.0],
    }];
    scene.tractions = vec![Traction {
        p1: [2.0, 4.0, 0.0],
        p2: [4.0, 4.0, 0.0],
        traction: [0.0, 0.1, 0.0],
    }];
    scene.box_loads = vec![BoxLoad {
        p1: [2.0, 2.0, 0.0],
        p2: [3.0, 3.0, 0.0],
        force: [0.1, 0.0, 0.0],
    }];
    scene
}

/// A field by its path, and how a value gets there.
type Entry = (&'static str, fn(&mut Scene, f64));

/// What a finite number must be in.
const NUMBERS: &[Entry] = &[
    ("time", |s, x| s.time = x),
    ("gravity[1]", |s, x| s.gravity[1] = x),
    ("time_step", |s, x| {
        s.time_step = TimeStep::Fixed {
            dt: x,
            allow_unstable: false,
        };
    }),
    ("critical_time_step_multiplier", |s, x| {
        s.time_step = TimeStep::Multiplier {
            multiplier: x,
            allow_unstable: false,
        };
    }),
    ("pic_fraction", |s, x| s.transfer.pic_fraction = x),
    ("damping.alpha", |s, x| {
        s.damping = Damping::Local { alpha: x }
    }),
    ("damping.alpha", |s, x| {
        s.damping = Damping::Viscous { alpha: x }
    }),
    ("mesh.origin[0]", |s, x| s.mesh.origin[0] = x),
    ("mesh.cells_dimension[1]", |s, x| s.mesh.cell[1] = x),
    ("materials[0].density", |s, x| s.materials[0].density = x),
    ("materials[0].young", |s, x| {
        s.materials[0].law = elastic_law(x, 0.3)
    }),
    ("materials[0].poisson", |s, x| {
        s.materials[0].law = elastic_law(1.0, x)
    }),
    ("bodies[0].initial_velocity[1]", |s, x| {
        s.bodies[0].velocity[1] = x
    }),
    ("bodies[0].point_p1[0]", |s, x| {
        s.bodies[0].shape = cuboid([x, 2.0, 0.0], [4.0, 4.0, 0.0]);
    }),
    ("bodies[1].prescribed_velocity[0][1]", |s, x| {
        if let Some(motion) = &mut s.bodies[1].motion {
            motion.values[0][1] = x;
        }
    }),
    ("bodies[1].prescribed_velocity[0]", |s, x| {
        if let Some(motion) = &mut s.bodies[1].motion {
            motion.times[0] = x;
        }
    }),
    ("bodies[2].center[1]", |s, x| {
        s.bodies[2].shape = Shape::disc([3.0, x], 1.0)
    }),
    ("bodies[2].radius", |s, x| {
        s.bodies[2].shape = Shape::disc([3.0, 8.0], x)
    }),
    ("bodies[2].particles[1][0]", |s, x| {
        s.bodies[2].shape = listed([x, 8.0, 0.0], 0.1)
    }),
    ("bodies[2].particles[1]", |s, x| {
        s.bodies[2].shape = listed([3.0, 8.0, 0.0], x)
    }),
    ("nodal_point_load[0][0][1]", |s, x| {
        s.point_loads[0].position[1] = x
    }),
    ("nodal_point_load[0][1][0]", |s, x| {
        s.point_loads[0].force[0] = x
    }),
    ("traction[0].point_p1[0]", |s, x| s.tractions[0].p1[0] = x),
    ("traction[0].traction[1]", |s, x| {
        s.tractions[0].traction[1] = x
    }),
    ("box_load[0].force[0]", |s, x| s.box_loads[0].force[0] = x),
    ("box_load[0].point_p2[1]", |s, x| s.box_loads[0].p2[1] = x),
    (
        "contact_manager.real_distance_correction_coefficient",
        |s, x| {
            s.contact_distance = Some(x);
        },
    ),
];

/// Two particles, the second as it is given.
fn listed(position: [f64; 3], volume: f64) -> Shape {
    let first = ParticleSeed {
        position: [2.0, 8.0, 0.0],
        volume: 0.1,
    };
    Shape::Particles(Arc::new(vec![first, ParticleSeed { position, volume }]))
}

/// That a scene is refused by its check with this path; adds the message.
fn refused_for(scene: &Scene, path: &str, refusals: &mut Vec<String>) -> Result<(), Unexpected> {
    match scene.simulate(&options()) {
        Err(StartError::Scene(error)) => match error.problems.iter().find(|p| p.path == path) {
            Some(problem) => {
                refusals.push(problem.to_string());
                Ok(())
            }
            None => Err(Unexpected(format!("a fault in {path} is called {error}"))),
        },
        Err(StartError::Setup(error)) => Err(Unexpected(format!(
            "a fault in {path} was only found when the run was set up: {error}"
        ))),
        Ok(_) => Err(Unexpected(format!("a fault in {path} was not refused"))),
    }
}

fn not_finite_input() -> Result<Finding, Unexpected> {
    // What is refused must be the number, and nothing else of the scene.
    start("the scene without a fault", &full(), &options())?;
    let mut finding = Finding::default();
    for (path, put) in NUMBERS {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut scene = full();
            put(&mut scene, value);
            refused_for(&scene, path, &mut finding.refusals)?;
        }
    }
    // Infinite friction is contact that never slips.
    for value in [f64::NAN, f64::NEG_INFINITY] {
        let mut scene = full();
        scene.contacts[0].friction = value;
        refused_for(&scene, "contact[0].friction", &mut finding.refusals)?;
    }
    Ok(finding)
}

fn impossible_constants() -> Result<Finding, Unexpected> {
    const FAULTS: &[(&str, fn(&mut Scene, f64), &[f64])] = &[
        (
            "materials[0].young",
            |s, x| s.materials[0].law = elastic_law(x, 0.3),
            &[0.0, -0.0, -1.0],
        ),
        (
            "materials[0].poisson",
            |s, x| s.materials[0].law = elastic_law(1.0, x),
            &[0.5, -1.0, 0.6, -2.0],
        ),
        (
            "materials[0].density",
            |s, x| s.materials[0].density = x,
            &[0.0, -0.0, -1.0],
        ),
        (
            "bodies[2].particles[1]",
            |s, x| s.bodies[2].shape = listed([3.0, 8.0, 0.0], x),
            &[0.0, -0.0, -1.0],
        ),
        (
            "bodies[2].radius",
            |s, x| s.bodies[2].shape = Shape::disc([3.0, 8.0], x),
            &[0.0, -0.0, -1.0],
        ),
        (
            "mesh.cells_dimension[0]",
            |s, x| s.mesh.cell[0] = x,
            &[0.0, -0.0, -1.0],
        ),
        ("time", |s, x| s.time = x, &[0.0, -0.0, -1.0]),
    ];
    let mut finding = Finding::default();
    for (path, put, values) in FAULTS {
        for &value in *values {
            let mut scene = full();
            put(&mut scene, value);
            refused_for(&scene, path, &mut finding.refusals)?;
        }
    }
    Ok(finding)
}

/// What goes wrong at the start of one particle.
const FAULTS: [fn(&mut InitialState, f64); 3] = [
    |state, x| state.velocity[1] = x,
    |state, x| state.stress[0] = x,
    |state, x| state.deformation[0][0] = x,
];

/// A place of a particle of the block below \[m\].
const FAULTY: [f64; 2] = [3.75, 3.25];

fn not_finite_state() -> Result<Finding, Unexpected> {
    let mut refusals = vec![];
    let mut late = 0;
    for method in methods() {
        let scene = with(&block([8, 8], [2.5, 2.5], [5.5, 5.5], soft()), method);
        for put in FAULTS {
            for value in [f64::NAN, f64::INFINITY] {
                let initial = move |x: &[f64; 3]| {
                    let mut state = AT_REST;
                    if x[..2] == FAULTY {
                        put(&mut state, value);
                    }
                    state
                };
                let started = scene.simulate(&from(Arc::new(initial)));
                let mut simulation = match started {
                    Ok(simulation) => simulation,
                    Err(error) => {
                        refusals.push(format!("{method}: {error}"));
                        continue;
                    }
                };
                let Some(error) = first_error(&mut simulation, 1) else {
                    late += 1;
                    continue;
                };
                match error.kind {
                    StepErrorKind::NotFinite(_)
                    | StepErrorKind::Law { .. }
                    | StepErrorKind::Inverted(_)
                    | StepErrorKind::TimeStands { .. } => {
                        refusals.push(format!("{method}: {error}"))
                    }
                    _ => {
                        return Err(Unexpected(format!(
                            "{method}: a value {value} is called {error}"
                        )));
                    }
                }
            }
        }
        goes_on_from_before(method, &scene, &mut late, &mut refusals)?;
    }
    let reason =
        "what is not finite spreads to all neighbours in a step, so that the step must be the last";
    Ok(Finding {
        gates: vec![Gate::at_most(
            "values that are not finite and did not stop the run in their step".to_owned(),
            f64::from(late),
            0.0,
            reason,
        )],
        refusals,
    })
}

/// A force that becomes NaN stops the run in that step, and the state saved before goes on without it to the same bits.
fn goes_on_from_before(
    method: crate::settings::Method,
    scene: &Scene,
    late: &mut u32,
    refusals: &mut Vec<String>,
) -> Result<(), Unexpected> {
    let what = method.to_string();
    let force = |sick: bool| -> BodyForce {
        Arc::new(move |_, x, t| {
            let broken = sick && t > 0.5 && x[0] > 4.0;
            [if broken { f64::NAN } else { 0.01 }, 0.0, 0.0]
        })
    };
    let with_force = |sick: bool| Options {
        body_force: Some(force(sick)),
        ..options()
    };
    let mut sick = start(&what, scene, &with_force(true))?;
    let mut good = sick.save();
    let error = loop {
        if sick.steps() > 1000 {
            return Err(Unexpected(format!(
                "{what}: a force that is not a number went unseen"
            )));
        }
        match sick.step(super::runs::NEVER) {
            Ok(_) => good = sick.save(),
            Err(error) => break error,
        }
    };
    // The force is evaluated at the beginning of a step.
    *late += u32::from(good.state.clock.time <= 0.5 || error.time != good.state.clock.time);
    match error.kind {
        StepErrorKind::NotFinite(_) => refusals.push(format!("{what}: {error}")),
        _ => {
            return Err(Unexpected(format!(
                "{what}: a force that is not a number is called {error}"
            )));
        }
    }
    let mut healed = start(&what, scene, &with_force(false))?;
    healed
        .restore(good)
        .map_err(|e| super::runs::unexpected(&what, e))?;
    steps(&what, &mut healed, 10)?;
    let mut whole = start(&what, scene, &with_force(false))?;
    steps(&what, &mut whole, healed.steps())?;
    if whole.state_hash() != healed.state_hash() {
        return Err(Unexpected(format!(
            "{what}: the state before the fault does not go on as if there had been none"
        )));
    }
    Ok(())
}

fn no_particles() -> Result<Finding, Unexpected> {
    let mut finding = Finding::default();
    let none = Scene {
        bodies: vec![],
        contacts: vec![],
        ..full()
    };
    refused_for(&none, "bodies", &mut finding.refusals)?;
    let mut empty = full();
    empty.bodies[2].shape = Shape::Particles(Arc::new(vec![]));
    refused_for(&empty, "bodies[2].particles", &mut finding.refusals)?;
    // A disc that holds no centre of a sub-cell.
    let mut small = block([8, 8], [2.0, 2.0], [4.0, 4.0], soft());
    small.bodies[0].shape = Shape::disc([3.0, 3.0], 1e-6);
    match small.simulate(&options()) {
        Err(StartError::Setup(SetupError::Body { body, reason })) => {
            finding.refusals.push(format!("{body}: {reason}"));
        }
        Err(error) => {
            return Err(Unexpected(format!(
                "a body without particles is called {error}"
            )));
        }
        Ok(_) => return Err(Unexpected("a body without particles was taken".to_owned())),
    }
    // A body that flies out, particle by particle.
    let (mut off, mut ran) = (0.0_f64, 0);
    for method in methods() {
        let what = method.to_string();
        let mut scene = with(&block([8, 8], [5.0, 3.0], [7.0, 5.0], soft()), method);
        scene.outside = Outside::Remove;
        scene.bodies[0].velocity = [1.0, 0.0, 0.0];
        let mut simulation = start(&what, &scene, &options())?;
        let mass = simulation.mass();
        super::runs::to_time(&what, &mut simulation, 4.0)?;
        let removed: f64 = simulation
            .events()
            .iter()
            .filter_map(|event| match &event.kind {
                proctor_kernel::simulation::EventKind::Removed(at) => Some(at.mass),
                _ => None,
            })
            .sum();
        off = off.max((removed + simulation.mass() - mass).abs() / mass);
        if simulation.particles() == 0 {
            super::runs::to_time(&what, &mut simulation, 5.0)?;
            ran += 1;
        }
    }
    finding.gates = vec![
        Gate::at_most(
            "mass that is neither left nor booked, over all".to_owned(),
            off,
            1e-15,
            "sixteen masses of a quarter are summed without round-off",
        ),
        Gate::at_least(
            "methods with which a run goes on without particles".to_owned(),
            f64::from(ran),
            methods().len() as f64,
            "the body needs 3 s to leave at 1 m/s, and 4 s are run",
        ),
    ];
    Ok(finding)
}

fn empty_mesh() -> Result<Finding, Unexpected> {
    let small = |cells: usize| {
        let mut scene = open(Dimension::Two, [cells, cells, 1], soft());
        let middle = 0.5 * cells as f64;
        let shape = cuboid([middle, middle, 0.0], [middle + 1.0, middle + 1.0, 0.0]);
        scene.bodies = vec![super::runs::filled(Dimension::Two, 1, shape)];
        scene.gravity = [0.0, -0.01, 0.0];
        scene
    };
    let mut finding = Finding::default();
    let limited = Options {
        memory: Some(Memory::of(1 << 30)),
        ..options()
    };
    match small(10_000).simulate(&limited) {
        Err(StartError::Setup(SetupError::Memory { path, error }))
            if path == "mesh.cells_number" =>
        {
            finding.refusals.push(format!("{path}: {error}"));
        }
        Err(error) => return Err(Unexpected(format!("1e8 cells in 1 GiB are called {error}"))),
        Ok(_) => return Err(Unexpected("1e8 cells were taken into 1 GiB".to_owned())),
    }
    let scene = small(1000);
    let mut simulation = start("1e6 cells", &scene, &options())?;
    let (_, before, _) = simulation.center(0);
    steps("1e6 cells", &mut simulation, 100)?;
    let (_, after, _) = simulation.center(0);
    let t = simulation.time();
    let off = (after[1] - before[1] + 0.005 * t * t).abs();
    finding.gates = vec![
        Gate::at_most(
            "four particles in 1e6 cells, height after a fall [m]".to_owned(),
            off,
            1e-11,
            "the fall is exact; 100 steps at a height of 500 m, whose last digit is 1.1e-13 m",
        ),
        Gate::at_most(
            "nodes in use".to_owned(),
            simulation.nodes_active() as f64,
            64.0,
            "two cells with three nodes per axis and a cell of travel on each side are no more than eight nodes per axis",
        ),
    ];
    Ok(finding)
}
