//! The start of a scene from the state of another run.

use super::RunError;
use super::state::{save, text};
use crate::output::{Checkpoint, CheckpointError};
use proctor_kernel::stage::g2p::ParticleMaxima;
use proctor_scene::simulation::{Simulation, StartBody, StartState};
use proctor_scene::{Scene, StateFile};
use std::path::Path;

/// Name of a checkpoint in the folder of a run.
const CHECKPOINT: &str = "checkpoint.bin";

/// The bodies of a run as a checkpoint has them; `None` where the scene begins from no other run.
pub(super) fn read(scene: &Scene) -> Result<Option<StartState>, RunError> {
    let Some(StateFile {
        file,
        keeps_velocity,
    }) = &scene.initial_state
    else {
        return Ok(None);
    };
    let file = if file.is_dir() {
        &file.join(CHECKPOINT)
    } else {
        file
    };
    let checkpoint = Checkpoint::read(file)?;
    Ok(Some(bodies(&checkpoint, file, *keeps_velocity)?))
}

/// The bodies of a simulation as they are now, with a name for messages.
pub(super) fn of(
    simulation: &Simulation,
    name: &str,
    keeps_velocity: bool,
) -> Result<StartState, CheckpointError> {
    bodies(
        &save(simulation).checkpoint,
        Path::new(name),
        keeps_velocity,
    )
}

fn bodies(
    checkpoint: &Checkpoint,
    file: &Path,
    keeps_velocity: bool,
) -> Result<StartState, CheckpointError> {
    let mesh = checkpoint.array::<f64>("mesh", 6)?;
    let numbers = checkpoint.array::<f64>("numbers", 18)?;
    let count = checkpoint.values::<i64>("bodies")?.len();
    let mut bodies = Vec::with_capacity(count);
    for (i, id) in checkpoint.values::<i64>("bodies")?.iter().enumerate() {
        let particles = checkpoint.values::<u64>(&format!("set{i}/id"))?.to_vec();
        let names = text(checkpoint.values::<u64>(&format!("set{i}/names"))?);
        let mut columns = vec![];
        for (c, name) in names.lines().enumerate() {
            let values = checkpoint.array::<f64>(&format!("set{i}/column{c}"), particles.len())?;
            columns.push((name.to_owned(), values.to_vec()));
        }
        let found = checkpoint.array::<f64>(&format!("set{i}/found"), 5)?;
        bodies.push(StartBody {
            id: *id,
            particles,
            columns,
            maxima: ParticleMaxima {
                speed_squared: found[0],
                wave_speed_squared: found[1],
                travel: 0.0,
                half_length: found[3],
                increment_squared: found[4],
                fault: None,
            },
        });
    }
    Ok(StartState {
        source: file.display().to_string(),
        // The mesh may have moved with its base.
        origin: std::array::from_fn(|axis| mesh[axis] + numbers[11 + axis]),
        cell: [mesh[3], mesh[4], mesh[5]],
        bodies,
        keeps_velocity,
    })
}
