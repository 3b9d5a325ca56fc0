//! Box loads of a restart that changes them: other forces on the same particles.

use crate::output::{Checkpoint, CheckpointError};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_scene::Vector;
use std::collections::HashMap;

/// Gives the particles of a body that was filled its columns of a checkpoint, which have these names. The forces of box loads stay
/// those with which it was filled, particle by particle. Returns by how much the sum of force times position changes \[J\], where the
/// mesh has moved by `shift` \[m\].
///
/// # Errors
/// A checkpoint that lacks a column.
pub(super) fn take(
    checkpoint: &Checkpoint,
    (body, names): (usize, &str),
    set: &mut ParticleSet,
    id: &[u64],
    shift: Vector,
) -> Result<f64, CheckpointError> {
    let saved = |name: &str| {
        let place = names.lines().position(|own| own == name);
        place.map(|c| checkpoint.array::<f64>(&format!("set{body}/column{c}"), id.len()))
    };
    let place: HashMap<u64, usize> = (set.id.iter().copied()).zip(0..).collect();
    let axes = set.layout.axes;
    let mut columns = Vec::with_capacity(set.columns.len());
    for (c, name) in set.layout.names().iter().enumerate() {
        let is_force = (set.layout.force).is_some_and(|first| (first..first + axes).contains(&c));
        columns.push(if is_force {
            let filled = |id: &u64| place.get(id).map_or(0.0, |p| set.columns[c][*p]);
            id.iter().map(filled).collect()
        } else {
            let missing = || CheckpointError::MissingSection {
                name: format!("set{body}/{name}"),
            };
            saved(name).ok_or_else(missing)??.to_vec()
        });
    }
    set.columns = columns;
    let mut change = 0.0;
    for axis in 0..axes {
        let x = &set.columns[Layout::POSITION + axis];
        let new = set.layout.force.map(|first| &set.columns[first + axis]);
        let old = saved(&format!("force {}", axis + 1)).transpose()?;
        for (p, x) in x.iter().enumerate() {
            let [new, old] = [new.map(|f| f[p]), old.map(|f| f[p])].map(|f| f.unwrap_or(0.0));
            change += (new - old) * (x + shift[axis]);
        }
    }
    Ok(change)
}
