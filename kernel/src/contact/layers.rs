//! Layers of the grid: a velocity field of one body, beside the common field of all others.
//!
//! A layer has nodes of its own on the shape of the grid, and rows in use of its own. Its memory is that of the nodes
//! which its body touches; the rest is never committed. It is cut into the same slabs as the common field, so that
//! whoever owns a slab owns all fields of its nodes.

use super::Pair;
use super::interface::Interface;
use crate::grid::{ActiveRows, Line, Nodes};
use crate::particles::ParticleSet;
use crate::simulation::field::{Field, split};
use crate::stage::solve::Planes;

/// The velocity field of one body.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Index of the body.
    pub body: usize,
    /// Values of the nodes, as in the common field.
    pub nodes: Nodes,
    /// A second line per node: what a method of contact knows of the body's surface there.
    pub surface: Nodes,
    /// Rows in use, as of the last sort.
    pub rows: ActiveRows,
    /// Particles that can reach a node of a partner.
    pub interface: Interface,
}

/// All layers, in order of the identifier of the body.
#[derive(Clone, Debug, Default)]
pub struct Layers {
    /// The layers.
    pub list: Vec<Layer>,
}

/// The part of a layer that one visit owns.
pub struct LayerPlanes<'a> {
    /// Index of the body.
    pub body: usize,
    /// Nodes.
    pub planes: Planes<'a>,
    /// Second lines of the nodes.
    pub surface: &'a mut [Line],
    /// Particles that can reach a node of a partner.
    pub interface: &'a Interface,
}

/// All fields of the planes that one visit owns.
pub struct SlabFields<'a> {
    /// Number of the slab.
    pub slab: usize,
    /// Field of the bodies without a layer.
    pub common: Planes<'a>,
    /// Layers, in order of the identifier of the body.
    pub layers: Vec<LayerPlanes<'a>>,
}

/// Whether two fields share their velocity where they meet: all but the layers of a pair. Fields are known by their
/// number, 0 the common one, then the layers, whose bodies are `bodies`; row by row.
#[must_use]
pub fn joined(bodies: &[usize], pairs: &[Pair]) -> Vec<bool> {
    let count = bodies.len() + 1;
    let mut joined = vec![true; count * count];
    for pair in pairs {
        let number = |body| bodies.iter().position(|b| *b == body);
        if let (Some(m), Some(s)) = (number(pair.master), number(pair.slave)) {
            joined[(m + 1) * count + s + 1] = false;
            joined[(s + 1) * count + m + 1] = false;
        }
    }
    joined
}

impl Layers {
    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Nodes of the layer of a body.
    #[must_use]
    pub fn nodes_of(&self, body: usize) -> Option<&[Line]> {
        self.list
            .iter()
            .find(|layer| layer.body == body)
            .map(|layer| layer.nodes.lines())
    }

    /// Has layers for exactly these bodies of near pairs (indices in order of the identifier), with rows for where their
    /// particles are now.
    pub fn set(
        &mut self,
        bodies: &[usize],
        pairs: &[Pair],
        near: &[bool],
        sets: &[ParticleSet],
        field: &Field,
        stencil: usize,
    ) {
        let count = field.shape.nodes.iter().product();
        let mut old = std::mem::take(&mut self.list);
        for &body in bodies {
            let rows = field.rows_of(&sets[body..=body], stencil);
            let interface = Interface::new(body, pairs, near, sets, &field.shape, stencil);
            let layer = match old.iter().position(|layer| layer.body == body) {
                Some(at) => Layer {
                    rows,
                    interface,
                    ..old.swap_remove(at)
                },
                None => Layer {
                    body,
                    nodes: Nodes::new(count),
                    surface: Nodes::new(count),
                    rows,
                    interface,
                },
            };
            self.list.push(layer);
        }
    }

    /// Calls `act` for every slab with all its fields, shared out among the team, and returns the results in order.
    pub fn visit<R: Send>(
        &mut self,
        field: &mut Field,
        act: impl Fn(SlabFields<'_>) -> R + Send + Sync,
    ) -> Vec<R> {
        let Field {
            shape,
            nodes,
            rows,
            slabs,
            team,
        } = field;
        let (shape, rows, slabs) = (&*shape, &*rows, &*slabs);
        let per_plane = shape.plane_nodes();
        let planes = |rows, slab: usize, nodes| Planes {
            shape,
            rows,
            range: slabs[slab].clone(),
            nodes,
        };
        let mut parts: Vec<SlabFields<'_>> = split(nodes, slabs, per_plane)
            .into_iter()
            .enumerate()
            .map(|(slab, nodes)| SlabFields {
                slab,
                common: planes(rows, slab, nodes),
                layers: vec![],
            })
            .collect();
        for layer in &mut self.list {
            let own = split(&mut layer.nodes, slabs, per_plane);
            let surfaces = split(&mut layer.surface, slabs, per_plane);
            for (slab, (nodes, surface)) in own.into_iter().zip(surfaces).enumerate() {
                parts[slab].layers.push(LayerPlanes {
                    body: layer.body,
                    planes: planes(&layer.rows, slab, nodes),
                    surface,
                    interface: &layer.interface,
                });
            }
        }
        team.map(parts, act)
    }
}
