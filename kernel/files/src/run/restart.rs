//! Changes of a restart: gravity and local damping may be others than before, and the run goes on with its displacements and its
//! balance of energy.

use super::{RunError, state};
use crate::output::{Checkpoint, CheckpointError};
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Damping, Scene, Vector};
use std::path::Path;

/// Sections of gravity \[m/s²\], and of the factor of local damping.
const GRAVITY: &str = "restart/gravity";
const LOCAL_DAMPING: &str = "restart/local-damping";

/// The scene without what a restart may change and a checkpoint keeps.
pub(super) fn without(scene: &Scene) -> Scene {
    Scene {
        gravity: [0.0; 3],
        damping: match scene.damping {
            Damping::Local { .. } => Damping::None,
            other => other,
        },
        ..scene.clone()
    }
}

/// Keeps it in a checkpoint.
pub(super) fn save(scene: &Scene, checkpoint: &mut Checkpoint) {
    checkpoint.push::<f64>(GRAVITY, scene.gravity.to_vec());
    let factor = local(scene.damping).unwrap_or(0.0);
    checkpoint.push::<f64>(LOCAL_DAMPING, vec![factor]);
}

fn local(damping: Damping) -> Option<f64> {
    match damping {
        Damping::Local { alpha } if alpha != 0.0 => Some(alpha),
        _ => None,
    }
}

/// A simulation that goes on from a checkpoint, and in words what it changes.
///
/// # Errors
/// A checkpoint that cannot be read, or that is one of another scene.
pub(super) fn restarted(
    scene: &Scene,
    options: &Options,
    path: &Path,
) -> Result<(Simulation, Vec<String>), RunError> {
    let checkpoint = Checkpoint::read(path)?;
    checkpoint.check_fingerprint(state::fingerprint(scene))?;
    let was = values(&checkpoint)?;
    let (gravity, alpha) = (scene.gravity, local(scene.damping));
    let mut before = scene.clone();
    before.gravity = was.0;
    if was.1 != alpha {
        before.damping = was
            .1
            .map_or(Damping::None, |alpha| Damping::Local { alpha });
    }
    let mut simulation = Simulation::new(&before, options)?;
    state::restore(&mut simulation, &checkpoint)?;
    let mut changes = vec![];
    if was.0 != gravity {
        simulation.set_gravity(gravity)?;
        let axes = scene.dimension.axes();
        let [old, new] = [was.0, gravity].map(|g| format!("{:?}", &g[..axes]));
        changes.push(format!("gravity {new} m/s², {old} m/s² until then"));
    }
    if was.1 != alpha {
        simulation.set_local_damping(alpha)?;
        let [old, new] = [was.1, alpha].map(|factor| factor.unwrap_or(0.0));
        changes.push(format!("local damping {new}, {old} until then"));
    }
    Ok((simulation, changes))
}

/// Gravity and the factor of local damping of a checkpoint.
fn values(checkpoint: &Checkpoint) -> Result<(Vector, Option<f64>), CheckpointError> {
    let gravity = checkpoint.array::<f64>(GRAVITY, 3)?;
    let factor = checkpoint.array::<f64>(LOCAL_DAMPING, 1)?[0];
    let gravity = std::array::from_fn(|axis| gravity[axis]);
    Ok((gravity, Some(factor).filter(|factor| *factor != 0.0)))
}
