//! Particles of a body that can reach a node which a partner reaches too, until the next sort. Normals and distances
//! are sought at such nodes alone, so no other particle is asked.

use super::Pair;
use super::broad::BodyReach;
use proctor_kernel::grid::{ActiveRows, GHOSTS_BELOW, GridShape};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::StepView;
use proctor_kernel::sorting::rows_of_some;
use proctor_kernel::weights::base_node;
use std::ops::Range;

/// First and last node along each axis that both bodies of a pair can reach.
type SharedNodes = [(f64, f64); 3];

/// The particles of a body near its partners.
#[derive(Clone, Debug, Default)]
pub struct Interface {
    /// Particles in their order, each range with the layer of particles that it is in.
    pub runs: Vec<(usize, Range<usize>)>,
    /// Rows that these particles can reach.
    pub rows: ActiveRows,
    /// Nodes that the body shares with each partner, during the search.
    shared: Vec<SharedNodes>,
}

impl Interface {
    /// Finds the interface of a body with its partners of near pairs, in place of what it was.
    pub fn find(
        &mut self,
        body: usize,
        pairs: &[Pair],
        near: &[bool],
        (view, reach): (&StepView<'_>, &mut BodyReach<'_>),
    ) {
        let (shape, stencil) = (&view.grid.shape, view.stencil);
        let Self { runs, rows, shared } = self;
        let own = pairs.iter().zip(near).filter(|(pair, near)| {
            **near && !pair.by_shape && (pair.master == body || pair.slave == body)
        });
        shared.clear();
        shared.extend(own.map(|(pair, _)| -> SharedNodes {
            std::array::from_fn(|axis| {
                if axis >= shape.axes {
                    return (0.0, 0.0);
                }
                let [a, b] = [pair.master, pair.slave].map(|body| reach.of(body, axis));
                (a.0.max(b.0), a.1.min(b.1))
            })
        }));
        let set = &view.particles[body];
        runs.clear();
        for layer in 0..set.layers.len() - 1 {
            for p in set.in_layers(layer..layer + 1) {
                if !shared
                    .iter()
                    .any(|s| reaches(set, layer, p, s, shape, stencil))
                {
                    continue;
                }
                match runs.last_mut() {
                    Some((of, run)) if *of == layer && run.end == p => run.end = p + 1,
                    _ => runs.push((layer, p..p + 1)),
                }
            }
        }
        let particles = runs.iter().flat_map(|(_, run)| run.clone());
        rows_of_some(set, particles, shape, stencil, rows);
    }

    /// The runs in some layers of particles.
    pub fn in_layers(&self, layers: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let own = self.runs.iter().filter(move |(of, _)| layers.contains(of));
        own.map(|(_, run)| run.clone())
    }
}

/// True if a particle can reach some of the nodes before the next sort: it may cross one cell until then.
fn reaches(
    set: &ParticleSet,
    layer: usize,
    p: usize,
    nodes: &SharedNodes,
    shape: &GridShape,
    stencil: usize,
) -> bool {
    (0..shape.axes).all(|axis| {
        let base = if axis == 0 {
            layer as f64 - GHOSTS_BELOW as f64
        } else {
            let x = set.columns[Layout::POSITION + axis][p];
            base_node(x * (1.0 / shape.cell[axis]), stencil)
        };
        base - 1.0 <= nodes[axis].1 && base + stencil as f64 >= nodes[axis].0
    })
}
