//! Input that no scene may have.

use std::sync::Arc;

use proctor_scene::simulation::StartError;
use proctor_scene::{
    BoxLoad, Contact, ContactNormal, Damping, History, ParticleSeed, PointLoad, Scene, Shape,
    TimeStep, Traction,
};

use super::runs::{block, options, soft, start};
use super::{Extreme, Finding, Unexpected};
use crate::cases::{cuboid, elastic_law};

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "not-finite-input",
        what: "NaN and both infinities in every number of a scene, one at a time",
        required: "refused with the name and the index of the field",
        cause: None,
        judge: not_finite_input,
    },
    Extreme {
        name: "impossible-constants",
        what: "E = 0, rho = 0, nu = 0.5, nu = -1, a volume of 0, and all of them negative",
        required: "refused with the name of the constant",
        cause: None,
        judge: impossible_constants,
    },
];

/// A sound scene with something in every list.
pub fn full() -> Scene {
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
        s.materials[0].law = elastic_law(x, 0.3);
    }),
    ("materials[0].poisson", |s, x| {
        s.materials[0].law = elastic_law(1.0, x);
    }),
    ("bodies[0].initial_velocity[1]", |s, x| {
        s.bodies[0].velocity[1] = x;
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
        s.bodies[2].shape = Shape::disc([3.0, x], 1.0);
    }),
    ("bodies[2].radius", |s, x| {
        s.bodies[2].shape = Shape::disc([3.0, 8.0], x);
    }),
    ("bodies[2].particles[1][0]", |s, x| {
        s.bodies[2].shape = listed([x, 8.0, 0.0], 0.1);
    }),
    ("bodies[2].particles[1]", |s, x| {
        s.bodies[2].shape = listed([3.0, 8.0, 0.0], x);
    }),
    ("nodal_point_load[0][0][1]", |s, x| {
        s.point_loads[0].position[1] = x;
    }),
    ("nodal_point_load[0][1][0]", |s, x| {
        s.point_loads[0].force[0] = x;
    }),
    ("traction[0].point_p1[0]", |s, x| s.tractions[0].p1[0] = x),
    ("traction[0].traction[1]", |s, x| {
        s.tractions[0].traction.values[0][1] = x;
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
///
/// # Errors
/// A scene that is taken, or refused for something else.
pub fn refused_for(
    scene: &Scene,
    path: &str,
    refusals: &mut Vec<String>,
) -> Result<(), Unexpected> {
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

/// Impossible values of a field.
const IMPOSSIBLE: &[(Entry, &[f64])] = &[
    (
        ("materials[0].young", |s, x| {
            s.materials[0].law = elastic_law(x, 0.3);
        }),
        &[0.0, -0.0, -1.0],
    ),
    (
        ("materials[0].poisson", |s, x| {
            s.materials[0].law = elastic_law(1.0, x);
        }),
        &[0.5, -1.0, 0.6, -2.0],
    ),
    (
        ("materials[0].density", |s, x| s.materials[0].density = x),
        &[0.0, -0.0, -1.0],
    ),
    (
        ("bodies[2].particles[1]", |s, x| {
            s.bodies[2].shape = listed([3.0, 8.0, 0.0], x);
        }),
        &[0.0, -0.0, -1.0],
    ),
    (
        ("bodies[2].radius", |s, x| {
            s.bodies[2].shape = Shape::disc([3.0, 8.0], x);
        }),
        &[0.0, -0.0, -1.0],
    ),
    (
        ("mesh.cells_dimension[0]", |s, x| s.mesh.cell[0] = x),
        &[0.0, -0.0, -1.0],
    ),
    (("time", |s, x| s.time = x), &[0.0, -0.0, -1.0]),
];

fn impossible_constants() -> Result<Finding, Unexpected> {
    let mut finding = Finding::default();
    for ((path, put), values) in IMPOSSIBLE {
        for &value in *values {
            let mut scene = full();
            put(&mut scene, value);
            refused_for(&scene, path, &mut finding.refusals)?;
        }
    }
    Ok(finding)
}
