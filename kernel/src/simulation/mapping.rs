//! The mapping of particles to the nodes of their velocity fields.

use crate::fields::{Owner, Slab, SlabField};
use crate::grid::{GHOSTS_BELOW, GridShape, NodeBlock};
use crate::lanes::SelectedLanes;
use crate::layout::Layout;
use crate::model::Vector;
use crate::particles::ParticleSet;
use crate::plan::Plan;
use crate::simulation::values::BodyRun;
use crate::stage::g2p::Affine;
use crate::stage::p2g::{self, Carry, P2g, P2gFn, WaterCarry, WaterP2g};
use crate::stage::solve::Planes;
use crate::weights::{
    Family, axis_weights_at, base_node, mean_of_hat, reached, round_off_weight, spline_touching,
};
use std::ops::{Deref, Range};

/// P2G of the quantities that `carry` names. Borrows the particles alone, so that the nodes can be written meanwhile.
pub(super) fn particle_to_grid<'a>(
    (plan, lanes): (&'a Plan, SelectedLanes),
    bodies: &'a [BodyRun],
    (sets, stencil): (&'a [ParticleSet], usize),
    own_field: &'a [bool],
    carry: Carry,
) -> ParticleToGrid<'a> {
    let family = plan.family;
    let nodes = family.stage_nodes(stencil);
    let carries_force = matches!(carry, Carry::All | Carry::Force);
    let instance = |carry| P2gInstance {
        carry,
        call: p2g::instance(
            plan.axes,
            plan.axisymmetric,
            nodes,
            plan.full_mapping,
            carry,
        ),
        leaves_parts: p2g::leaves_parts(plan.axes, plan.full_mapping, carry),
    };
    ParticleToGrid {
        sets,
        bodies,
        own_field,
        lanes,
        stencil,
        family,
        affine: plan.affine != Affine::Leave,
        first_radius: (plan.axisymmetric && !bodies.is_empty())
            .then(|| bodies[0].mapping.first_radius),
        has_hoop: plan.axisymmetric && !plan.full_mapping && carry == Carry::All,
        free: instance(carry),
        driven: instance(Carry::Momentum),
        water: if carry == Carry::Remap {
            WaterCarry::Remap
        } else {
            WaterCarry::All {
                averaged: plan.cell_average,
            }
        },
        gradient: instance(Carry::MassGradient),
        mean_stress: (plan.cell_average && carries_force)
            .then(|| [false, true].map(|averaged| instance(Carry::MeanStress { averaged }))),
    }
}

/// The quantities that a mapping carries, with the compiled stage that carries them.
#[derive(Clone, Copy)]
struct P2gInstance {
    carry: Carry,
    call: P2gFn,
    /// True if it leaves nodes in two parts.
    leaves_parts: bool,
}

/// P2G: the mapping of bodies onto one slab after the other.
pub(super) struct ParticleToGrid<'a> {
    /// Particles.
    pub(super) sets: &'a [ParticleSet],
    /// Their bodies.
    pub(super) bodies: &'a [BodyRun],
    /// True for each of them that has a field of its own.
    own_field: &'a [bool],
    lanes: SelectedLanes,
    /// Nodes per axis of the stencil.
    pub(super) stencil: usize,
    /// Weighting functions.
    pub(super) family: Family,
    /// True if momentum has an affine part.
    affine: bool,
    /// Radius of the lower edge of the mesh \[m\], where the scene is axisymmetric.
    first_radius: Option<f64>,
    /// True if the force of the hoop stress lies in a lane of its own.
    has_hoop: bool,
    /// Mapping of bodies that move freely.
    free: P2gInstance,
    /// Mapping of bodies with a field of their own whose motion is prescribed: their mass alone counts.
    driven: P2gInstance,
    /// Quantities of the water in their pores.
    water: WaterCarry,
    /// Mapping of the mass gradient of some particles.
    gradient: P2gInstance,
    /// Correction of the force by the mean stress of bodies that move freely, where their strain is a mean over cells.
    mean_stress: Option<[P2gInstance; 2]>,
}

impl ParticleToGrid<'_> {
    /// Clears all fields of a slab and maps each body onto its own; returns the number of groups in the layers of
    /// particles that the slab owns.
    pub(super) fn run(&self, slab: &mut Slab<'_>) -> usize {
        let mut groups = 0;
        for field in &mut slab.fields {
            field.planes.clear();
            groups += self.run_field(field);
        }
        groups
    }

    /// Number of groups of the particles of a block of planes and rows, where rows are cut.
    pub(super) fn groups_of_rows(&self, block: &NodeBlock, shape: &GridShape) -> usize {
        let nodes = self.family.stage_nodes(self.stencil);
        let mut groups = 0;
        for (index, (set, body)) in self.sets.iter().zip(self.bodies).enumerate() {
            if body.motion.is_some() && !self.own_field[index] {
                continue;
            }
            for own in set.in_block(block, shape).ranges() {
                let layer = set.layers.partition_point(|start| *start <= own.start) - 1;
                let layer = set.in_layers(layer..layer + 1);
                let by = (set.layout.axes, nodes);
                groups += p2g::groups_from(&set.columns, &body.mapping, by, layer, own);
            }
        }
        groups
    }

    /// Rate of viscous damping of all bodies of a field \[1/s\]; `None` where they differ or momentum has an affine part:
    /// what it takes is not known at the nodes then.
    pub(super) fn viscous_rate(&self, owner: Owner) -> Option<f64> {
        let own = self.own_field.iter().enumerate();
        let bodies = own.filter(|&(index, own)| match owner {
            Owner::Body(body) => body == index,
            Owner::Phase => !own && self.bodies[index].motion.is_none(),
            Owner::Water => false,
        });
        let mut rates = bodies.map(|(index, _)| self.bodies[index].viscous_rate);
        let first = rates.next()?;
        (!self.affine && rates.all(|rate| rate == first)).then_some(first)
    }

    /// Maps the bodies of one field.
    pub(super) fn run_field(&self, field: &mut SlabField<'_>) -> usize {
        let planes = &mut field.planes;
        let groups = match field.owner {
            Owner::Water => {
                self.map_water(planes);
                return 0;
            }
            Owner::Body(body) => self.map(body, planes),
            Owner::Phase => {
                let mut groups = 0;
                for (index, body) in self.bodies.iter().enumerate() {
                    if body.motion.is_none() && !self.own_field[index] {
                        groups += self.map(index, planes);
                    }
                }
                groups
            }
        };
        if self.has_hoop {
            planes.join_with_hoop();
        } else if self.free.leaves_parts {
            planes.join();
        }
        groups
    }

    /// Maps the water of all bodies.
    fn map_water(&self, planes: &mut Planes<'_>) {
        for (index, body) in self.bodies.iter().enumerate() {
            let Some(water) = &body.water else { continue };
            let set = &self.sets[index];
            let call = WaterP2g {
                columns: &set.columns,
                layout: &set.layout,
                mapping: &body.mapping,
                layers: &mut self.layers_of(index, planes),
                planes: planes.range.clone(),
                nodes: planes.nodes,
                carry: self.water,
                water,
            };
            call.run(self.lanes, set.layout.axes, self.stencil);
        }
    }

    /// Particles of each layer of a body that reaches planes, and whether the planes have the layer. Where rows are cut, nobody has
    /// a layer: see [`ParticleToGrid::groups_of_rows`].
    fn layers_of<'s>(
        &'s self,
        index: usize,
        planes: &Planes<'_>,
    ) -> impl Iterator<Item = (Range<usize>, bool)> + use<'s> {
        let set = &self.sets[index];
        let (onto, owned) = (self.layers_onto(planes), planes.range.clone());
        let counts = !planes.rows.is_cut();
        let layers = onto.start..onto.end.min(set.layers.len() - 1);
        layers
            .map(move |layer| {
                let particles = set.in_layers(layer..layer + 1);
                (particles, counts && owned.contains(&layer))
            })
            .filter(|(particles, _)| !particles.is_empty())
    }

    /// Maps one body.
    fn map(&self, index: usize, planes: &mut Planes<'_>) -> usize {
        if self.bodies[index].motion.is_some() {
            return self.map_runs(
                index,
                &mut self.layers_of(index, planes),
                planes,
                self.driven,
            );
        }
        for carrier in self.mean_stress.iter().flatten() {
            self.map_runs(index, &mut self.layers_of(index, planes), planes, *carrier);
        }
        self.map_runs(index, &mut self.layers_of(index, planes), planes, self.free)
    }

    /// Maps the mass gradient of some particles of one body.
    pub(super) fn map_gradient(
        &self,
        index: usize,
        runs: &mut dyn Iterator<Item = Range<usize>>,
        planes: &mut Planes<'_>,
    ) {
        self.map_runs(
            index,
            &mut runs.map(|run| (run, false)),
            planes,
            self.gradient,
        );
        if self.gradient.leaves_parts {
            planes.join();
        }
        if let Some(first) = self.first_radius {
            planes.multiply_by_radius(first);
        }
    }

    /// Layers of particles that reach planes. A particle may have left its layer by one cell since the last sort.
    pub(super) fn layers_onto(&self, planes: &Planes<'_>) -> Range<usize> {
        planes.range.start.saturating_sub(self.stencil)..planes.range.end + 1
    }

    fn map_runs(
        &self,
        index: usize,
        layers: &mut dyn Iterator<Item = (Range<usize>, bool)>,
        planes: &mut Planes<'_>,
        P2gInstance { carry, call, .. }: P2gInstance,
    ) -> usize {
        let (set, body) = (&self.sets[index], &self.bodies[index]);
        let layout = Layout {
            affine: set.layout.affine.filter(|_| self.affine),
            ..set.layout
        };
        call(
            self.lanes,
            P2g {
                columns: &set.columns,
                layout: &layout,
                mapping: &body.mapping,
                layers,
                planes: planes.range.clone(),
                nodes: planes.nodes,
                carry,
                viscous_rate: body.viscous_rate,
            },
        )
    }
}

/// Nodes that one particle reaches by more than round-off, increasing, with their weights.
pub struct NodeWeights {
    entries: [(usize, f64); Self::MOST],
    count: usize,
}

impl NodeWeights {
    /// Nodes of the widest stencil in space.
    pub const MOST: usize = 64;
}

impl Deref for NodeWeights {
    type Target = [(usize, f64)];

    #[inline]
    fn deref(&self) -> &[(usize, f64)] {
        &self.entries[..self.count]
    }
}

/// Weights of the centre of a particle, of nodes that it reaches by more than round-off.
#[must_use]
pub fn node_weights(
    set: &ParticleSet,
    body: &BodyRun,
    shape: &GridShape,
    stencil: usize,
    p: usize,
) -> NodeWeights {
    weights_of(set, body, shape, stencil, p, |_, xi, l| {
        let family = body.mapping.family;
        reached(
            axis_weights_of(family, stencil, xi, l),
            round_off_weight(family),
        )
    })
}

/// Weights along one axis at the nodes of a stencil of three or four.
fn axis_weights_of(family: Family, stencil: usize, xi: f64, l: f64) -> [f64; 4] {
    if stencil == 3 {
        let (_, [u, v, w], _) = axis_weights_at::<3>(family, xi, l);
        [u, v, w, 0.0]
    } else {
        axis_weights_at::<4>(family, xi, l).1
    }
}

/// The same where the particle touches something, at the point that is off its centre by `offset` \[m\]; `half` is half of the
/// length of the particle itself along each axis \[m\].
///
/// A traction on a body gives a node its weight there, as the stress behind it does: the sum of V grad `S_Ip` over a row of
/// particles is the weight where the row ends. That weight is the mean over the part of the domain around the point that has
/// the point in its middle: on a face nothing but the point. A domain that is longer than the particle, as that of the
/// B-spline, is as many domains side by side. All nodes are nodes of the particle. Without a domain it is the particle.
#[must_use]
pub fn node_weights_touching(
    set: &ParticleSet,
    body: &BodyRun,
    shape: &GridShape,
    stencil: usize,
    p: usize,
    [offset, half]: [&Vector; 2],
) -> NodeWeights {
    if body.mapping.family == Family::Hat {
        return weights_of(set, body, shape, stencil, p, |_, xi, l| {
            axis_weights_of(Family::Hat, stencil, xi, l)
        });
    }
    weights_of(set, body, shape, stencil, p, |axis, xi, l| {
        let cells = |length: &Vector| length[axis] * body.mapping.inverse_cell[axis];
        let ratio = l / cells(half);
        // A whole number is rounded without a call of the C library.
        let parts = ((ratio + 0.5) as usize).max(1);
        let mut weights = [0.0; 4];
        if parts == 1 {
            let off = cells(offset).clamp(-l, l);
            let at = xi - base_node(xi, stencil) + off;
            for n in 0..stencil {
                weights[n] = mean_of_hat(at - n as f64, l - off.abs());
            }
            return weights;
        }
        if (ratio - parts as f64).abs() > WHOLE {
            let [a, b, c] =
                spline_touching(xi - base_node(xi, stencil), cells(half), cells(offset));
            return [a, b, c, 0.0];
        }
        let share = 1.0 / parts as f64;
        let l_part = l * share;
        let off = cells(offset).clamp(-l_part, l_part);
        let at = xi - base_node(xi, stencil) + off;
        let middle = 0.5 * (parts as f64 - 1.0);
        for part in 0..parts {
            let place = at + 2.0 * l_part * (part as f64 - middle);
            for n in 0..stencil {
                weights[n] += share * mean_of_hat(place - n as f64, l_part - off.abs());
            }
        }
        weights
    })
}

/// Round-off of the length of a B-spline over that of a particle, which counts as a whole number.
const WHOLE: f64 = 1e-9;

/// Products of the weights along the axes, which `along` gives for an axis, the position of the particle and the half-length
/// of its domain in cells.
fn weights_of(
    set: &ParticleSet,
    body: &BodyRun,
    shape: &GridShape,
    stencil: usize,
    p: usize,
    along: impl Fn(usize, f64, f64) -> [f64; 4],
) -> NodeWeights {
    let axes = shape.axes;
    let x = set.position(p);
    let mut base = [0; 3];
    let mut weights = [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.0; 4]];
    for axis in 0..axes {
        let xi = x[axis] * body.mapping.inverse_cell[axis];
        let l = body
            .mapping
            .half_length_column
            .map_or(body.mapping.half_length[axis], |column| {
                set.columns[column + axis][p]
            });
        let direction = shape.direction(axis);
        base[direction] = (base_node(xi, stencil) + GHOSTS_BELOW as f64) as usize;
        weights[direction] = along(axis, xi, l);
    }
    let reached = |direction: usize| {
        let of: &[f64; 4] = &weights[direction];
        let reached = of[..stencil].iter().enumerate().filter(|(_, w)| **w > 0.0);
        reached.map(move |(n, w)| (base[direction] + n, *w))
    };
    let mut nodes = NodeWeights {
        entries: [(0, 0.0); NodeWeights::MOST],
        count: 0,
    };
    for (i, u) in reached(0) {
        for (j, v) in reached(1) {
            for (k, w) in reached(2) {
                nodes.entries[nodes.count] = (shape.index([i, j, k]), u * v * w);
                nodes.count += 1;
            }
        }
    }
    nodes
}
