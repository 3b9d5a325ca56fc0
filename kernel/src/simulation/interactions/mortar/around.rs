//! The particles around the vertices of a boundary: through them a vertex feels how its body turns and stretches, and the
//! force on a vertex turns and stretches the body (eq. 28, and its transpose).
//!
//! A vertex moves with v_v = sum_k S_kv (v_k + G_k (x_v - x_k)), and G_k = sum_p S_kp m_p L_p / sum_p S_kp m_p is made of
//! the velocities of all nodes that the particles p reach, L_p = sum_I v_I grad S_Ip. For the work of a force f_v to be
//! the same at the vertex and at the nodes, node I must take S_Iv f_v + sum_p M_p grad S_Ip with
//! M_p = m_p sum_k S_kp / m_k sum_v S_kv f_v (x_v - x_k)^T. The second sum has no resultant; its couple moves the line of
//! action of the force to the vertex, from which the weights alone leave it a tenth of a cell away.

use super::mirrors::Mirrors;
use super::reach::{Reach, StencilNode, base_of, scaled, stencil_nodes};
use super::surface::{Patch, velocity_at};
use crate::grid::{GridShape, Line};
use crate::layout::Layout;
use crate::mortar::PointIn;
use crate::mortar::motion::Follow;
use crate::particles::ParticleSet;
use crate::simulation::BodyRun;
use crate::team::Team;
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
    reach: Reach<D>,
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
        let is_near = &self.is_near;
        let reaches: Vec<bool> = team.collect(0..set.len(), |p| {
            let base = base_of(&scaled::<D>(set, p, mapping), stencil, shape);
            is_near[place(base, bases)]
        });
        let found: Vec<usize> = (0..set.len()).filter(|&p| reaches[p]).collect();
        self.particles = team.search(0..found.len(), |i| Near {
            reach: Reach::of((set, found[i]), mapping, shape, mirrors, stencil),
            shares: 0..0,
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
                let weight = particle.reach.weight(node);
                if weight == 0.0 {
                    continue;
                }
                let (inside, sides) = particle.reach.inside(node, shape, mirrors);
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
                let v = velocity_at(&lines[particle.reach.node(node)]);
                gradient += v * particle.reach.slope(node).transpose();
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
                let mut force = moment * particle.reach.slope(node);
                if particle.reach.mirrored {
                    force.component_mul_assign(&particle.reach.prescribed(node, shape, mirrors));
                }
                let (inside, _) = particle.reach.inside(node, shape, mirrors);
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
