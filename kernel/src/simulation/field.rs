//! The grid as the cycle uses it: nodes, active rows, and slabs of planes that threads own.

use crate::grid::{ActiveRows, GridShape, Line, Nodes};
#[cfg(feature = "frames")]
use crate::particles::rows_of;
use crate::particles::{ParticleSet, sort_sets};
use crate::stage::solve::Planes;
use rayon::ThreadPool;
use rayon::prelude::*;
use std::ops::Range;

/// Fewest planes of a slab: a slab repeats the weights of the layers at its ends.
const THINNEST_SLAB: usize = 8;
/// Slabs per thread, so that an uneven share can move to an idle thread.
const SLABS_PER_THREAD: usize = 3;

/// Nodes with what is in use and who owns it.
#[derive(Debug)]
pub struct Field {
    /// Shape.
    pub shape: GridShape,
    /// Values.
    pub nodes: Nodes,
    /// Rows in use, as of the last sort.
    pub rows: ActiveRows,
    /// Planes of each slab; together all planes.
    pub slabs: Vec<Range<usize>>,
}

impl Field {
    /// A grid without particles.
    #[must_use]
    pub fn new(shape: GridShape) -> Self {
        let nodes = Nodes::new(shape.nodes.iter().product());
        let slabs = std::iter::once(0..shape.nodes[0]).collect();
        Self {
            nodes,
            rows: ActiveRows::default(),
            slabs,
            shape,
        }
    }

    /// Sorts the particles and cuts the planes into slabs of about equal numbers of particles.
    pub fn sort(&mut self, sets: &mut [ParticleSet], stencil: usize, threads: usize) {
        self.rows = sort_sets(sets, &self.shape, stencil);
        self.cut(sets, threads);
    }

    /// Takes up sets in the order in which they are, after a restart.
    #[cfg(feature = "frames")]
    pub fn resume(&mut self, sets: &[ParticleSet], stencil: usize, threads: usize) {
        self.rows = rows_of(sets, &self.shape, stencil);
        self.cut(sets, threads);
    }

    /// Cuts the planes into slabs of about equal numbers of particles.
    fn cut(&mut self, sets: &[ParticleSet], threads: usize) {
        let planes = self.shape.nodes[0];
        let most = (threads * SLABS_PER_THREAD)
            .min(planes / THINNEST_SLAB)
            .max(1);
        self.slabs.clear();
        if threads == 1 || most == 1 {
            self.slabs.push(0..planes);
            return;
        }
        let per_layer = |layer: usize| -> usize {
            sets.iter()
                .map(|set| set.in_layers(layer..layer + 1).len())
                .sum()
        };
        let total: usize = sets.iter().map(ParticleSet::len).sum();
        let share = total.div_ceil(most).max(1);
        let (mut start, mut sum) = (0, 0);
        for plane in 0..planes {
            sum += per_layer(plane);
            let thick = plane + 1 - start >= THINNEST_SLAB && planes - plane > THINNEST_SLAB;
            if thick && sum >= share {
                self.slabs.push(start..plane + 1);
                start = plane + 1;
                sum = 0;
            }
        }
        self.slabs.push(start..planes);
    }

    /// Calls `act` for every slab, in parallel where there is a pool, and returns the results in order.
    pub fn visit<R: Send>(
        &mut self,
        pool: Option<&ThreadPool>,
        act: impl Fn(Planes<'_>) -> R + Send + Sync,
    ) -> Vec<R> {
        let per_plane = self.shape.plane_nodes();
        let (shape, rows) = (&self.shape, &self.rows);
        let parts: Vec<Planes<'_>> = split(&mut self.nodes, &self.slabs, per_plane)
            .into_iter()
            .zip(&self.slabs)
            .map(|(nodes, slab)| Planes {
                shape,
                rows,
                range: slab.clone(),
                nodes,
            })
            .collect();
        match pool {
            Some(pool) => pool.install(|| parts.into_par_iter().with_max_len(1).map(act).collect()),
            None => parts.into_iter().map(act).collect(),
        }
    }
}

/// The nodes of each slab.
pub fn split<'a>(
    nodes: &'a mut Nodes,
    slabs: &[Range<usize>],
    per_plane: usize,
) -> Vec<&'a mut [Line]> {
    let mut rest = nodes.lines_mut();
    let mut parts = Vec::with_capacity(slabs.len());
    for slab in slabs {
        let (own, tail) = rest.split_at_mut(slab.len() * per_plane);
        parts.push(own);
        rest = tail;
    }
    parts
}
