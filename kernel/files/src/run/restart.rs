//! Changes of a restart: gravity and local damping may be others than before, and the run goes on with its displacements and its
//! balance of energy.

use super::changeable::{local, values};
use super::{RunError, state};
use crate::output::Checkpoint;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Damping, Scene};
use std::path::Path;

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
