//! The grid as the cycle uses it: nodes, active rows, and slabs of planes that threads own.

use crate::grid::{ActiveRows, GridShape, Line, Nodes};
use crate::particles::{ParticleSet, rows_of, sort_sets};
use crate::stage::solve::Planes;
use crate::team::Team;
use std::ops::Range;
use std::sync::Arc;

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
    /// Who shares the slabs.
    pub team: Arc<Team>,
}

impl Field {
    /// A grid without particles.
    #[must_use]
    pub fn new(shape: GridShape, team: Team) -> Self {
        let nodes = Nodes::new(shape.nodes.iter().product());
        let slabs = std::iter::once(0..shape.nodes[0]).collect();
        Self {
            nodes,
            rows: ActiveRows::default(),
            slabs,
            shape,
            team: Arc::new(team),
        }
    }

    /// Sorts the particles and cuts the planes into slabs of about equal numbers of particles.
    pub fn sort(&mut self, sets: &mut [ParticleSet], stencil: usize) {
        self.rows = sort_sets(sets, &self.shape, stencil, &self.team);
        self.cut(sets);
    }

    /// Takes up sets in the order in which they are, after a restart.
    pub fn resume(&mut self, sets: &[ParticleSet], stencil: usize) {
        self.rows = self.rows_of(sets, stencil);
        self.cut(sets);
    }

    /// Rows in use of particles that are not to be sorted now.
    #[must_use]
    pub fn rows_of(&self, sets: &[ParticleSet], stencil: usize) -> ActiveRows {
        rows_of(sets, &self.shape, stencil, &self.team)
    }

    /// Cuts the planes into slabs of about equal numbers of particles.
    fn cut(&mut self, sets: &[ParticleSet]) {
        let threads = self.team.count();
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

    /// Calls `act` for every slab, shared out among the team, and returns the results in order.
    pub fn visit<R: Send>(&mut self, act: impl Fn(Planes<'_>) -> R + Send + Sync) -> Vec<R> {
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
        self.team.map(parts, act)
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
