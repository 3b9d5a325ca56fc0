//! The particles around the vertices of a boundary: through them a vertex feels how its body turns and stretches, and the
//! force on a vertex turns and stretches the body (eq. 28, and its transpose).
//!
//! A vertex moves with v_v = sum_k S_kv (v_k + G_k (x_v - x_k)), and G_k = sum_p S_kp m_p L_p / sum_p S_kp m_p is made of
//! the velocities of all nodes that the particles p reach, L_p = sum_I v_I grad S_Ip. For the work of a force f_v to be
//! the same at the vertex and at the nodes, node I must take S_Iv f_v + sum_p M_p grad S_Ip with
//! M_p = m_p sum_k S_kp / m_k sum_v S_kv f_v (x_v - x_k)^T. The second sum has no resultant; its couple moves the line of
//! action of the force to the vertex, from which the weights alone leave it a tenth of a cell away.

use super::mirrors::Mirrors;
use super::surface::{Patch, velocity_at};
use crate::grid::{GHOSTS_BELOW, GridShape, Line};
use crate::layout::Layout;
use crate::mortar::PointIn;
use crate::mortar::motion::Follow;
use crate::particles::ParticleSet;
use crate::simulation::BodyRun;
use crate::team::Team;
use crate::weights::{axis_weights_at, base_offset};
use nalgebra::SMatrix;
use std::array;
use std::ops::Range;

/// The particles that reach the nodes of a boundary, as of the last mapping.
#[derive(Clone, Debug)]
pub(super) struct Around<const D: usize> {
    /// Place of each node of the grid in `hosts`, plus one; zero for nodes that no vertex hangs on.
    slots: Vec<u32>,
    hosts: Vec<Host<D>>,
    particles: Vec<Near<D>>,
    shares: Vec<Share<D>>,
    /// Nodes of the stencil.
    stencil: Vec<StencilNode<D>>,
    /// Bases from which a particle reaches a host, and a list of them.
    is_near: Vec<bool>,
    near: Vec<usize>,
}

/// A node of the stencil of a particle.
#[derive(Clone, Copy, Debug)]
struct StencilNode<const D: usize> {
    /// Place along each axis, counted from the base.
    at: [usize; D],
    /// Index in the grid less that of the base.
    offset: usize,
}

/// A node that a vertex hangs on.
#[derive(Clone, Copy, Debug)]
struct Host<const D: usize> {
    node: usize,
    /// Mass of the particles around it and of their images \[kg\].
    mass: f64,
    /// 1 for the entries of its gradient that images do not cancel.
    kept: SMatrix<f64, D, D>,
}

/// A particle near a boundary.
#[derive(Clone, Debug)]
struct Near<const D: usize> {
    /// Index of its base in the grid.
    base: usize,
    /// Whether it reaches a ghost, so that it has an image.
    mirrored: bool,
    /// Weights along each axis, and their slopes \[1/m\].
    axes: [([f64; 4], [f64; 4]); D],
    /// What it gives to hosts.
    shares: Range<usize>,
}

/// What a particle, or its image beyond a plane of symmetry, gives to a host.
#[derive(Clone, Copy, Debug)]
struct Share<const D: usize> {
    host: usize,
    /// S_kp m_p \[kg\].
    mass: f64,
    /// -1 along axes in which it is an image.
    sides: PointIn<D>,
}

impl<const D: usize> Default for Around<D> {
    fn default() -> Self {
        Self {
            slots: vec![],
            hosts: vec![],
            particles: vec![],
            shares: vec![],
            stencil: vec![],
            is_near: vec![],
            near: vec![],
        }
    }
}

/// Velocity gradients at the nodes that vertices hang on (eq. 28 for the whole gradient).
pub(super) struct NodalGradients<'a, const D: usize> {
    slots: &'a [u32],
    gradients: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> NodalGradients<'_, D> {
    /// That of a node \[1/s\]; zero where no vertex hangs on it.
    pub(super) fn at(&self, node: usize) -> SMatrix<f64, D, D> {
        match self.slots.get(node) {
            Some(&slot) if slot > 0 => self.gradients[slot as usize - 1],
            _ => SMatrix::zeros(),
        }
    }
}

impl<const D: usize> Near<D> {
    /// Index of a node of the stencil in the grid, ghost or not.
    fn node(&self, node: &StencilNode<D>) -> usize {
        self.base + node.offset
    }

    /// The node that has its velocity, with -1 for each axis along which it is its mirror image.
    fn inside(
        &self,
        node: &StencilNode<D>,
        shape: &GridShape,
        mirrors: &Mirrors,
    ) -> (usize, PointIn<D>) {
        let node = self.node(node);
        if !self.mirrored {
            return (node, PointIn::repeat(1.0));
        }
        let (at, sides) = mirrors.inside(shape, shape.indices(node));
        (shape.index(at), sides)
    }

    /// Weight on a node of the stencil.
    fn weight(&self, StencilNode { at, .. }: &StencilNode<D>) -> f64 {
        (1..D).fold(self.axes[0].0[at[0]], |w, axis| {
            w * self.axes[axis].0[at[axis]]
        })
    }

    /// Its gradient \[1/m\].
    fn slope(&self, StencilNode { at, .. }: &StencilNode<D>) -> PointIn<D> {
        PointIn::from_fn(|direction, _| {
            let of = |axis: usize| {
                let (w, g) = &self.axes[axis];
                if axis == direction {
                    g[at[axis]]
                } else {
                    w[at[axis]]
                }
            };
            (1..D).fold(of(0), |product, axis| product * of(axis))
        })
    }
}

/// Nodes of a stencil with so many nodes per axis, the last axis fastest.
fn stencil_nodes<const D: usize>(stencil: usize, shape: &GridShape) -> Vec<StencilNode<D>> {
    let node = |k: usize| {
        let at: [usize; D] =
            array::from_fn(|axis| k / stencil.pow((D - 1 - axis) as u32) % stencil);
        let mut storage = [0; 3];
        for axis in 0..D {
            storage[shape.direction(axis)] = at[axis];
        }
        let offset = shape.index(storage);
        StencilNode { at, offset }
    };
    (0..stencil.pow(D as u32)).map(node).collect()
}

/// A gradient beyond planes of symmetry from that on this side, or the other way round.
fn reflected<const D: usize>(
    gradient: &SMatrix<f64, D, D>,
    sides: &PointIn<D>,
) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| sides[i] * sides[j] * gradient[(i, j)])
}

impl<const D: usize> Around<D> {
    /// Finds the particles that reach a node of a patch, by their base, and what they give to it.
    pub(super) fn find<const N: usize>(
        &mut self,
        patches: &[Patch<D, N>],
        (set, body): (&ParticleSet, &BodyRun),
        shape: &GridShape,
        mirrors: &Mirrors,
        stencil: usize,
        team: &Team,
    ) {
        self.stencil = stencil_nodes(stencil, shape);
        self.find_hosts(patches, shape, mirrors, stencil);
        let bases = shape.bases();
        let mapping = &body.mapping;
        let offset = base_offset(stencil);
        let scaled = |p: usize| -> [f64; D] {
            array::from_fn(|axis| {
                set.columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis]
            })
        };
        let base_of = |xi: &[f64; D]| {
            let mut base = [0; 3];
            for axis in 0..D {
                base[shape.direction(axis)] =
                    ((xi[axis] - offset).floor() + GHOSTS_BELOW as f64) as usize;
            }
            base
        };
        let is_near = &self.is_near;
        let reaches: Vec<bool> = team.collect(0..set.len(), |p| {
            is_near[place(base_of(&scaled(p)), bases)]
        });
        let found: Vec<usize> = (0..set.len()).filter(|&p| reaches[p]).collect();
        self.particles = team.search(0..found.len(), |i| {
            let p = found[i];
            let xi = scaled(p);
            let base = base_of(&xi);
            Near {
                base: shape.index(base),
                mirrored: mirrors.reached_from::<D>(shape, base, stencil),
                axes: array::from_fn(|axis| {
                    let l = mapping
                        .half_length_column
                        .map_or(mapping.half_length[axis], |c| set.columns[c + axis][p]);
                    let (w, g) = if stencil == 3 {
                        let (_, w, g) = axis_weights_at::<3>(mapping.family, xi[axis], l);
                        ([w[0], w[1], w[2], 0.0], [g[0], g[1], g[2], 0.0])
                    } else {
                        let (_, w, g) = axis_weights_at::<4>(mapping.family, xi[axis], l);
                        (w, g)
                    };
                    (w, g.map(|g| g * mapping.inverse_cell[axis]))
                }),
                shares: 0..0,
            }
        });
        self.share(&found, set, shape, mirrors);
    }

    /// The nodes that vertices hang on, and the bases from which particles reach them.
    fn find_hosts<const N: usize>(
        &mut self,
        patches: &[Patch<D, N>],
        shape: &GridShape,
        mirrors: &Mirrors,
        stencil: usize,
    ) {
        let bases = shape.bases();
        self.slots.resize(shape.nodes.iter().product(), 0);
        self.is_near.resize(bases.iter().product(), false);
        for host in self.hosts.drain(..) {
            self.slots[host.node] = 0;
        }
        for base in self.near.drain(..) {
            self.is_near[base] = false;
        }
        for patch in patches {
            for k in 0..N {
                let node = patch.nodes[k];
                if patch.weights.weights[k] <= 0.0 || self.slots[node] > 0 {
                    continue;
                }
                let at = shape.indices(node);
                let along: [Range<usize>; 3] = array::from_fn(|direction| {
                    // An image reaches a node from ghosts that its particle reaches, whose base is among these too.
                    at[direction].saturating_sub(stencil - 1)
                        ..(at[direction] + 1).min(bases[direction])
                });
                for i in along[0].clone() {
                    for j in along[1].clone() {
                        for k in along[2].clone() {
                            let base = place([i, j, k], bases);
                            if !self.is_near[base] {
                                self.is_near[base] = true;
                                self.near.push(base);
                            }
                        }
                    }
                }
                self.hosts.push(Host {
                    node,
                    mass: 0.0,
                    kept: mirrors.kept(shape, at),
                });
                self.slots[node] = self.hosts.len() as u32;
            }
        }
    }

    /// What each particle gives to hosts, one after the other.
    fn share(
        &mut self,
        found: &[usize],
        set: &ParticleSet,
        shape: &GridShape,
        mirrors: &Mirrors,
    ) {
        self.shares.clear();
        for (&p, particle) in found.iter().zip(&mut self.particles) {
            let first = self.shares.len();
            let m_p = set.columns[Layout::MASS][p];
            for node in &self.stencil {
                let weight = particle.weight(node);
                if weight == 0.0 {
                    continue;
                }
                let (inside, sides) = particle.inside(node, shape, mirrors);
                let slot = self.slots[inside];
                if slot > 0 {
                    let host = slot as usize - 1;
                    self.hosts[host].mass += weight * m_p;
                    self.shares.push(Share {
                        host,
                        mass: weight * m_p,
                        sides,
                    });
                }
            }
            particle.shares = first..self.shares.len();
        }
    }

    /// Velocity gradients at the nodes that vertices hang on, from the velocities of all nodes.
    pub(super) fn gradients(
        &self,
        lines: &[Line],
        team: &Team,
    ) -> NodalGradients<'_, D> {
        let gradient_of = |i: usize| {
            let particle = &self.particles[i];
            let mut gradient = SMatrix::<f64, D, D>::zeros();
            for node in &self.stencil {
                let v = velocity_at(&lines[particle.node(node)]);
                gradient += v * particle.slope(node).transpose();
            }
            gradient
        };
        // Each particle by whatever thread; the sums by one, in the order of the particles.
        let found = team.search(0..self.particles.len(), gradient_of);
        let mut gradients = vec![SMatrix::zeros(); self.hosts.len()];
        for (particle, gradient) in self.particles.iter().zip(&found) {
            for share in &self.shares[particle.shares.clone()] {
                gradients[share.host] += reflected(gradient, &share.sides) * share.mass;
            }
        }
        for (gradient, host) in gradients.iter_mut().zip(&self.hosts) {
            *gradient = if host.mass > 0.0 {
                gradient.component_mul(&host.kept) / host.mass
            } else {
                SMatrix::zeros()
            };
        }
        NodalGradients {
            slots: &self.slots,
            gradients,
        }
    }

    /// Adds to the forces on the nodes what turns and stretches the body: the transpose of [`Around::gradients`] and of
    /// what vertices take of them. `forces` are those on the vertices \[N\].
    pub(super) fn load<const N: usize>(
        &self,
        lines: &mut [Line],
        patches: &[Patch<D, N>],
        forces: &[PointIn<D>],
        follow: Follow,
        shape: &GridShape,
        mirrors: &Mirrors,
    ) {
        if forces.iter().flatten().all(|f| *f == 0.0) {
            return;
        }
        let cell = PointIn::from_fn(|axis, _| shape.cell[axis]);
        let mut moments = vec![SMatrix::<f64, D, D>::zeros(); self.hosts.len()];
        for (patch, force) in patches.iter().zip(forces) {
            if force.iter().all(|f| *f == 0.0) {
                continue;
            }
            for k in 0..N {
                let w = patch.weights.weights[k];
                let slot = self.slots[patch.nodes[k]];
                if w > 0.0 && slot > 0 {
                    let distance = patch.weights.offset(k).component_mul(&cell);
                    moments[slot as usize - 1] += force * distance.transpose() * w;
                }
            }
        }
        for (moment, host) in moments.iter_mut().zip(&self.hosts) {
            *moment = if host.mass > 0.0 {
                follow.part(moment).component_mul(&host.kept) / host.mass
            } else {
                SMatrix::zeros()
            };
        }
        let none = SMatrix::<f64, D, D>::zeros();
        for particle in &self.particles {
            let shares = &self.shares[particle.shares.clone()];
            if shares.iter().all(|share| moments[share.host] == none) {
                continue;
            }
            let moment = shares.iter().fold(none, |sum, share| {
                sum + reflected(&moments[share.host], &share.sides) * share.mass
            });
            for node in &self.stencil {
                let mut force = moment * particle.slope(node);
                if particle.mirrored {
                    let at = shape.indices(particle.node(node));
                    force.component_mul_assign(&mirrors.prescribed(shape, at));
                }
                let (inside, _) = particle.inside(node, shape, mirrors);
                for axis in 0..D {
                    lines[inside][4 + axis] += force[axis];
                }
            }
        }
    }
}

/// Place of a base among all bases.
fn place(base: [usize; 3], bases: [usize; 3]) -> usize {
    (base[0] * bases[1] + base[1]) * bases[2] + base[2]
}
