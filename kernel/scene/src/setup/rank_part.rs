//! Parts of the bodies that ranks fill: each a range along the first axis, so that none has them all.

use super::{Options, memory_budget};
use crate::values::Scene;
use proctor_geometry::bodies::{FilledSlice, MemoryRoom, fill_within};
use proctor_geometry::memory::Memory;
use proctor_kernel::model::Shape;
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::{SetupError, SharingRefusal};
use std::sync::Arc;

/// No first coordinate: bodies are counted, and none of their particles is made.
const NOWHERE: [f64; 2] = [f64::INFINITY; 2];
/// Planes of nodes that a rank holds beside those of its part.
const PLANES_BESIDE: f64 = 10.0;

/// The part of the bodies that this rank fills.
pub(super) struct RankPart {
    pub(super) ranks: Arc<dyn Ranks>,
    /// First coordinates of its particles, relative to the origin of the mesh, the end excluded \[m\].
    pub(super) range: [f64; 2],
}

impl RankPart {
    /// The part of this rank; `None` where it fills the whole: without ranks, and where particles are given one by one, or begin as
    /// another run left them.
    ///
    /// # Errors
    /// A body that cannot be filled.
    pub(super) fn of(scene: &Scene, options: &Options) -> Result<Option<Self>, SetupError> {
        let several = options.ranks.as_ref().filter(|ranks| ranks.count() > 1);
        let is_list = |shape: &Shape| matches!(shape, Shape::Particles(_));
        let listed = scene.bodies.iter().any(|body| is_list(&body.shape));
        let Some(ranks) = several.filter(|_| !listed && options.start.is_none()) else {
            return Ok(None);
        };
        let mut slices = vec![];
        for body in &scene.bodies {
            let room = MemoryRoom {
                memory: options.memory.unwrap_or_else(Memory::of_machine),
                per_particle: 0.0,
            };
            let mesh = (&scene.mesh, scene.dimension);
            let counted = fill_within(&body.shape, body.particles_per_cell, mesh, NOWHERE, &room);
            slices.extend(counted.map_err(memory_budget::of_body(body))?.slices);
        }
        Ok(Some(Self {
            range: range_of(ranks.rank(), ranks.count(), slices),
            ranks: Arc::clone(ranks),
        }))
    }

    /// About the share of the nodes that this rank holds.
    pub(super) fn share_of_nodes(&self, planes: usize) -> f64 {
        (1.0 / self.ranks.count() as f64 + PLANES_BESIDE / planes as f64).min(1.0)
    }

    /// A sum to which each rank in turn adds its terms, so that it is formed in the order of one process.
    pub(super) fn in_turn(&self, mut sum: f64, add: impl Fn(f64) -> f64) -> f64 {
        for rank in 0..self.ranks.count() {
            if rank == self.ranks.rank() {
                sum = add(sum);
            }
            let all = self.ranks.all_gather(&[sum.to_bits()]);
            sum = all[rank].first().map_or(sum, |bits| f64::from_bits(*bits));
        }
        sum
    }

    /// A result that each rank has: the own error where there is one, else that another rank has one.
    ///
    /// # Errors
    /// Those.
    pub(super) fn agree<T>(
        part: Option<&Self>,
        here: Result<T, SetupError>,
    ) -> Result<T, SetupError> {
        let failed = part.and_then(|part| part.ranks.first_with(here.is_err()));
        let here = here?;
        match failed {
            None => Ok(here),
            Some(rank) => Err(SetupError::Ranks(SharingRefusal::OtherRank { rank })),
        }
    }
}

/// The range of a rank, by the slices of all bodies: about as many particles as in those of the others.
fn range_of(rank: usize, ranks: usize, mut slices: Vec<FilledSlice>) -> [f64; 2] {
    slices.sort_by(|a, b| a.x.total_cmp(&b.x));
    let total: u64 = slices.iter().map(|slice| slice.count).sum();
    let begin = |rank: usize| {
        let wanted = (u128::from(total) * rank as u128 / ranks as u128) as u64;
        let mut before = 0;
        let first = slices.iter().find(|slice| {
            let is_first = before >= wanted;
            before += slice.count;
            is_first
        });
        first.map_or(f64::INFINITY, |slice| slice.x)
    };
    [rank, rank + 1].map(|rank| match rank {
        0 => f64::NEG_INFINITY,
        _ if rank == ranks => f64::INFINITY,
        _ => begin(rank),
    })
}
