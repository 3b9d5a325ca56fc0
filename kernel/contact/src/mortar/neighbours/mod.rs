//! The particles around the vertices of a boundary: through them a vertex feels how its body turns and stretches, and the
//! force on a vertex turns and stretches the body (eq. 28, and its transpose).
//!
//! A vertex moves with v_v = sum_k S_kv (v_k + G_k (x_v - x_k)), and G_k = sum_p S_kp m_p L_p / sum_p S_kp m_p is made of
//! the velocities of all nodes that the particles p reach, L_p = sum_I v_I grad S_Ip. For the work of a force f_v to be
//! the same at the vertex and at the nodes, node I must take S_Iv f_v + sum_p M_p grad S_Ip with
//! M_p = m_p sum_k S_kp / m_k sum_v S_kv f_v (x_v - x_k)^T. The second sum has no resultant; its couple moves the line of
//! action of the force to the vertex, from which the weights alone leave it a tenth of a cell away.

mod gradient;
mod moment;
mod near_bases;

use super::mirrors::Mirrors;
use super::patch::Patch;
use super::stencil_reach::{
    StencilNode, StencilReach, StencilReaches, stencil_nodes, stencil_rows,
};
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::motion::FollowMode;
use nalgebra::SMatrix;
use near_bases::{Bases, NearBases};
use proctor_geometry::team::{ItemCost, Team};
use proctor_kernel::grid::{GridShape, Line};
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::BodyRun;
use std::array;

/// Fewest particles that are worth handing to another thread.
const LEAST_SHARE: usize = 1 << 8;

/// The particles that reach the nodes of a boundary, as of the last mapping.
#[derive(Clone, Debug)]
pub(super) struct NeighbourParticles<const D: usize> {
    /// Lanes of the simulation.
    lanes: SelectedLanes,
    /// Place of each node of the grid in `hosts`, plus one; zero for nodes that no vertex hangs on.
    slots: Vec<u32>,
    hosts: Vec<HostNode<D>>,
    /// Particles near the boundary, as numbered in their set, what they have on their stencils, and their masses \[kg\].
    particles: Vec<usize>,
    reaches: Vec<StencilReach<D>>,
    masses: Vec<f64>,
    /// Nodes of the stencil, and the first of each of its rows.
    stencil: Vec<StencilNode<D>>,
    rows: Vec<StencilNode<D>>,
    /// Bases from which a particle reaches a host, and one whose moment is not zero.
    near: Bases,
    turned: Bases,
    /// The parts that vertices follow of the velocity gradients at hosts \[1/s\].
    gradients: Vec<SMatrix<f64, D, D>>,
    lists: NeighbourLists<D>,
}

/// Lists that are filled again in each step.
#[derive(Clone, Debug, Default)]
struct NeighbourLists<const D: usize> {
    /// True if each particle is near.
    reaches: Vec<bool>,
    of_particles: Vec<HalfLineColumns<D>>,
    /// Moments of the hosts, and before them none, for nodes that are no host.
    moments: Vec<HalfLineColumns<D>>,
}

/// Sums at the nodes of the grid, for one body after the other. Those at nodes that no vertex hangs on mean nothing, and
/// are not set to zero.
pub(super) type NodeSums<const D: usize> = Vec<HalfLineColumns<D>>;

/// A node that a vertex hangs on.
#[derive(Clone, Copy, Debug)]
struct HostNode<const D: usize> {
    node: usize,
    /// Mass of the particles around it and of their images \[kg\].
    mass: f64,
    /// 1 for the entries of its gradient that images do not cancel.
    kept: SMatrix<f64, D, D>,
}

/// Columns of a matrix, each half a line: a vector and lanes that mean nothing.
pub(super) type HalfLineColumns<const D: usize> = [[f64; 4]; D];

/// A matrix beyond planes of symmetry from that on this side, or the other way round; `sides` is -1 along axes in which it
/// is an image.
#[inline(always)]
fn reflected<const D: usize>(
    columns: &HalfLineColumns<D>,
    sides: &PointIn<D>,
) -> HalfLineColumns<D> {
    let mut reflected = *columns;
    for j in 0..D {
        for i in 0..D {
            reflected[j][i] *= sides[i] * sides[j];
        }
    }
    reflected
}

/// A matrix in columns.
fn in_columns<const D: usize>(matrix: &SMatrix<f64, D, D>) -> HalfLineColumns<D> {
    array::from_fn(|j| array::from_fn(|i| if i < D { matrix[(i, j)] } else { 0.0 }))
}

/// Columns as a matrix.
fn as_matrix<const D: usize>(columns: &HalfLineColumns<D>) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| columns[j][i])
}

impl<const D: usize> Default for NeighbourParticles<D> {
    fn default() -> Self {
        Self {
            lanes: SelectedLanes::plain(),
            slots: vec![],
            hosts: vec![],
            particles: vec![],
            reaches: vec![],
            masses: vec![],
            stencil: vec![],
            rows: vec![],
            near: Bases::default(),
            turned: Bases::default(),
            gradients: vec![],
            lists: NeighbourLists::default(),
        }
    }
}

impl<const D: usize> NeighbourParticles<D> {
    /// Finds the particles that reach a node of a patch, by their base, and their weights.
    pub(super) fn find<const N: usize>(
        &mut self,
        patches: &[Patch<D, N>],
        (set, body): (&ParticleSet, &BodyRun),
        shape: &GridShape,
        mirrors: &Mirrors,
        stencil: usize,
        (lanes, team): (SelectedLanes, &Team),
    ) {
        self.lanes = lanes;
        if self.rows.len() * stencil != self.stencil.len() || self.stencil.is_empty() {
            self.stencil = stencil_nodes(stencil, shape);
            self.rows = stencil_rows(stencil, shape);
        }
        self.find_hosts(patches, shape, mirrors, stencil);
        let mapping = &body.mapping;
        let reaches = &mut self.lists.reaches;
        reaches.resize(set.len(), false);
        let share = team.share(set.len(), ItemCost::Small);
        team.each(reaches.chunks_mut(share).enumerate(), |(part, found)| {
            lanes.run(NearBases::<D> {
                first: part * share,
                set,
                mapping,
                shape,
                stencil,
                bases: &self.near,
                found,
            });
        });
        // Written over where the one before was none: which are near is hard to foresee, and a branch on it would cost more.
        self.particles.resize(set.len(), 0);
        let mut count = 0;
        for (p, &reaches) in self.lists.reaches.iter().enumerate() {
            self.particles[count] = p;
            count += usize::from(reaches);
        }
        self.particles.truncate(count);
        self.reaches.resize(count, StencilReach::NOWHERE);
        let share = self.share_of_thread(team);
        let parts = self.particles.chunks(share);
        let parts = parts.zip(self.reaches.chunks_mut(share));
        team.each(parts, |(particles, found)| {
            lanes.run(StencilReaches {
                particles,
                set,
                mapping,
                shape,
                mirrors,
                stencil,
                found,
            });
        });
        let all = &set.columns[Layout::MASS];
        self.masses.clear();
        self.masses.extend(self.particles.iter().map(|&p| all[p]));
    }

    /// Number of particles that a thread takes at once.
    fn share_of_thread(&self, team: &Team) -> usize {
        self.particles.len().div_ceil(team.count()).max(LEAST_SHARE)
    }

    /// The nodes that vertices hang on, and the bases from which particles reach them.
    fn find_hosts<const N: usize>(
        &mut self,
        patches: &[Patch<D, N>],
        shape: &GridShape,
        mirrors: &Mirrors,
        stencil: usize,
    ) {
        self.slots.resize(shape.nodes.iter().product(), 0);
        for host in self.hosts.drain(..) {
            self.slots[host.node] = 0;
        }
        self.near.clear(shape);
        for patch in patches {
            for k in 0..N {
                let node = patch.nodes[k];
                if patch.weights.weights[k] <= 0.0 || self.slots[node] > 0 {
                    continue;
                }
                let at = shape.indices(node);
                self.near.add(at, stencil, shape);
                self.hosts.push(HostNode {
                    node,
                    // That of the body, what it gave to ghosts included.
                    mass: patch.masses[k],
                    kept: mirrors.kept(shape, at),
                });
                self.slots[node] = self.hosts.len() as u32;
            }
        }
    }

    /// Finds the parts that vertices follow of the velocity gradients at the nodes that they hang on, from the velocities of all
    /// nodes (eq. 28 for the whole gradient).
    pub(super) fn find_gradients(
        &mut self,
        lines: &[Line],
        follow: FollowMode,
        (shape, mirrors): (&GridShape, &Mirrors),
        team: &Team,
        sums: &mut NodeSums<D>,
    ) {
        let mut of_particles = std::mem::take(&mut self.lists.of_particles);
        of_particles.resize(self.particles.len(), [[0.0; 4]; D]);
        let share = self.share_of_thread(team);
        let parts = self.reaches.chunks(share).zip(self.masses.chunks(share));
        let parts = parts.zip(of_particles.chunks_mut(share));
        team.each(parts, |((reaches, masses), gradients)| {
            self.lanes.run(gradient::ParticleGradients {
                reaches,
                masses,
                rows: &self.rows,
                row_length: self.stencil.len() / self.rows.len(),
                lines,
                gradients,
            });
        });
        if sums.len() != self.slots.len() {
            *sums = vec![[[0.0; 4]; D]; self.slots.len()];
        }
        for host in &self.hosts {
            sums[host.node] = [[0.0; 4]; D];
        }
        team.each(self.parts(sums, shape, team), |(first, sums)| {
            self.lanes.run(gradient::GradientSums {
                around: self,
                of_particles: &of_particles,
                first,
                sums,
                shape,
                mirrors,
            });
        });
        let part = |host: &HostNode<D>| follow.part(&host.per_mass(as_matrix(&sums[host.node])));
        self.gradients.clear();
        self.gradients.extend(self.hosts.iter().map(part));
        self.lists.of_particles = of_particles;
    }

    /// Divides the nodes of the grid among threads, plane by plane, so that each has about as many of the particles: the first
    /// node of each part, and its nodes.
    fn parts<'a, T>(
        &self,
        nodes: &'a mut [T],
        shape: &GridShape,
        team: &Team,
    ) -> impl Iterator<Item = (usize, &'a mut [T])> {
        let count = self
            .particles
            .len()
            .div_ceil(self.share_of_thread(team))
            .max(1);
        let (all, plane) = (nodes.len(), shape.plane_nodes());
        let (mut first, mut rest) = (0, nodes);
        (1..=count).map(move |part| {
            let reach = self.reaches.get(part * self.reaches.len() / count);
            // Of the planes that it reaches about half lie on either side.
            let end = reach.map_or(all, |reach| (reach.base() / plane + 2) * plane);
            let end = end.clamp(first, all);
            let (own, after) = std::mem::take(&mut rest).split_at_mut(end - first);
            rest = after;
            (std::mem::replace(&mut first, end), own)
        })
    }

    /// Result at a node \[1/s\]; zero where no vertex hangs on it.
    pub(super) fn gradient_at(&self, node: usize) -> SMatrix<f64, D, D> {
        match self.slots.get(node) {
            Some(&slot) if slot > 0 => self.gradients[slot as usize - 1],
            _ => SMatrix::zeros(),
        }
    }

    /// Adds to the forces on the nodes what turns and stretches the body: the transpose of [`NeighbourParticles::find_gradients`] and of
    /// what vertices take of them. `forces` are those on the vertices \[N\].
    pub(super) fn load<const N: usize>(
        &mut self,
        lines: &mut [Line],
        patches: &[Patch<D, N>],
        forces: &[PointIn<D>],
        follow: FollowMode,
        (shape, mirrors): (&GridShape, &Mirrors),
        team: &Team,
    ) {
        if forces.iter().flatten().all(|f| *f == 0.0) {
            return;
        }
        let mut lists = std::mem::take(&mut self.lists);
        self.find_moments(&mut lists.moments, patches, forces, follow, shape);
        let NeighbourLists {
            of_particles,
            moments,
            ..
        } = &mut lists;
        of_particles.resize(self.particles.len(), [[0.0; 4]; D]);
        let share = self.share_of_thread(team);
        let parts = self.reaches.chunks(share).zip(self.masses.chunks(share));
        let parts = parts.zip(of_particles.chunks_mut(share));
        team.each(parts, |((reaches, masses), found)| {
            self.lanes.run(moment::ParticleMoments {
                around: self,
                reaches,
                masses,
                moments,
                found,
                shape,
                mirrors,
            });
        });
        team.each(self.parts(lines, shape, team), |(first, lines)| {
            self.lanes.run(moment::MomentSpread {
                around: self,
                of_particles,
                first,
                lines,
                shape,
                mirrors,
            });
        });
        self.lists = lists;
    }

    /// Moments per mass at the hosts \[N m/kg\], and from where particles reach those that are not zero.
    fn find_moments<const N: usize>(
        &mut self,
        moments: &mut Vec<HalfLineColumns<D>>,
        patches: &[Patch<D, N>],
        forces: &[PointIn<D>],
        follow: FollowMode,
        shape: &GridShape,
    ) {
        let cell = PointIn::<D>::from_fn(|axis, _| shape.cell[axis]);
        moments.clear();
        moments.resize(self.hosts.len() + 1, [[0.0; 4]; D]);
        for (patch, force) in patches.iter().zip(forces) {
            if force.iter().all(|f| *f == 0.0) {
                continue;
            }
            for (node, distance) in patch.carried(&cell) {
                let slot = self.slots[node];
                if slot > 0 {
                    let moment = force * distance.transpose();
                    let sum = &mut moments[slot as usize];
                    *sum = in_columns(&(as_matrix(sum) + moment));
                }
            }
        }
        self.turned.clear(shape);
        let stencil = self.stencil.len() / self.rows.len();
        for (moment, host) in moments[1..].iter_mut().zip(&self.hosts) {
            *moment = in_columns(&host.per_mass(follow.part(&as_matrix(moment))));
            if *moment != [[0.0; 4]; D] {
                self.turned.add(shape.indices(host.node), stencil, shape);
            }
        }
    }
}

impl<const D: usize> HostNode<D> {
    /// A sum over the particles around it as a mean, without what images cancel.
    fn per_mass(&self, sum: SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
        if self.mass > 0.0 {
            sum.component_mul(&self.kept) / self.mass
        } else {
            SMatrix::zeros()
        }
    }
}
