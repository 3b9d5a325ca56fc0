//! A state in a checkpoint of which each rank reads its part.

use super::state::{column_section, id_section};
use crate::output::checkpoint::CheckpointFile;
use crate::output::{Checkpoint, CheckpointError};
use proctor_kernel::ranks::Ranks;
use proctor_scene::simulation::Simulation;
use std::path::Path;

/// A checkpoint of which each rank reads its part.
pub(super) struct SharedState(CheckpointFile);

impl SharedState {
    /// Opens a checkpoint, and compares its checksum together with the other ranks.
    ///
    /// # Errors
    /// As [`Checkpoint::read`].
    pub(super) fn open(path: &Path, ranks: &dyn Ranks) -> Result<Self, CheckpointError> {
        let file = CheckpointFile::open(path)?;
        file.verify(ranks)?;
        Ok(Self(file))
    }

    /// The sections that each rank has as a whole.
    ///
    /// # Errors
    /// As [`CheckpointFile::sections`].
    pub(super) fn short_sections(&self) -> Result<Checkpoint, CheckpointError> {
        self.0.sections(|name| {
            let of_set = name
                .strip_prefix("set")
                .and_then(|name| name.split_once('/'));
            let is_long = |part: &str| part == "id" || part.starts_with("column");
            !of_set.is_some_and(|(_, part)| is_long(part))
        })
    }

    /// Adds the particles that this rank will hold to its checkpoint, and cuts the planes of the simulation for them.
    ///
    /// # Errors
    /// As [`CheckpointFile::part`].
    pub(super) fn read_part(
        &self,
        simulation: &mut Simulation,
        checkpoint: &mut Checkpoint,
    ) -> Result<(), CheckpointError> {
        let stencil = checkpoint.array::<u64>("counters", 4)?[1] as usize;
        let columns: Vec<usize> = simulation
            .sets()
            .iter()
            .map(|set| set.columns.len())
            .collect();
        let mut starts = vec![];
        for (set, of_simulation) in simulation.sets().iter().enumerate() {
            let name = format!("set{set}/layers");
            let layers = checkpoint.array::<u64>(&name, of_simulation.layers.len())?;
            starts.push(layers.to_vec());
        }
        let planes = starts.first().map_or(0, |starts| starts.len() - 1);
        let count = |layer: usize| {
            let of_set = |starts: &Vec<u64>| starts[layer + 1].saturating_sub(starts[layer]);
            starts.iter().map(of_set).sum()
        };
        let counts: Vec<u64> = (0..planes).map(count).collect();
        let Some(held) = simulation.cut_for_restore(&counts, stencil) else {
            return Ok(());
        };
        for (set, starts) in starts.iter().enumerate() {
            let [first, end] = [held.start, held.end].map(|layer| starts[layer.min(planes)]);
            let part = |name: &str| self.0.part(name, first..end.max(first));
            checkpoint.sections.push(part(&id_section(set))?);
            for column in 0..columns[set] {
                let name = column_section(set, column);
                checkpoint.sections.push(part(&name)?);
            }
            let here = starts
                .iter()
                .map(|start| (*start).clamp(first, end.max(first)) - first);
            let here = here.collect();
            checkpoint.replace::<u64>(&format!("set{set}/layers"), here);
        }
        Ok(())
    }
}
