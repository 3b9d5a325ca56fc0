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

use super::mirrors::Mirrors;
use super::reach::{Reach, Reaches, StencilNode, base_of, scaled, stencil_nodes, stencil_rows};
use super::surface::Patch;
use crate::grid::{GridShape, Line};
use crate::lanes::Selected;
use crate::layout::Layout;
use crate::mortar::PointIn;
use crate::mortar::motion::Follow;
use crate::particles::ParticleSet;
use crate::simulation::BodyRun;
use crate::team::{OfItem, Team};
use nalgebra::SMatrix;
use std::array;
use std::ops::Range;

/// Fewest particles that are worth handing to another thread.
const LEAST_SHARE: usize = 1 << 8;
/// Most nodes that a particle reaches.
const MOST_NODES: usize = 64;

/// The particles that reach the nodes of a boundary, as of the last mapping.
#[derive(Clone, Debug)]
pub(super) struct Around<const D: usize> {
    /// Those of the simulation.
    lanes: Selected,
    /// Place of each node of the grid in `hosts`, plus one; zero for nodes that no vertex hangs on.
    slots: Vec<u32>,
    hosts: Vec<Host<D>>,
    /// Particles near the boundary, as numbered in their set, and what they have on their stencils.
    particles: Vec<usize>,
    reaches: Vec<Reach<D>>,
    /// What they give to hosts, by as many of them as a thread takes at once.
    given: Vec<Given>,
    /// Nodes of the stencil, and the first of each of its rows.
    stencil: Vec<StencilNode<D>>,
    rows: Vec<StencilNode<D>>,
    /// Bases from which a particle reaches a host, and a list of them.
    is_near: Vec<bool>,
    near: Vec<usize>,
    /// The parts that vertices follow of the velocity gradients at hosts \[1/s\].
    gradients: Vec<SMatrix<f64, D, D>>,
    lists: Lists<D>,
}

/// Lists that are filled again in each step.
#[derive(Clone, Debug, Default)]
struct Lists<const D: usize> {
    /// Whether each particle is near.
    reaches: Vec<bool>,
    of_particles: Vec<Columns<D>>,
    of_hosts: Vec<Columns<D>>,
    moments: Vec<SMatrix<f64, D, D>>,
    /// Hosts whose moment is not zero.
    is_turned: Vec<bool>,
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

/// What a particle, or its image beyond a plane of symmetry, gives to a host.
#[derive(Clone, Copy, Debug, Default)]
struct Share {
    host: u32,
    /// A bit for each axis in which it is an image.
    image: u32,
    /// S_kp m_p \[kg\].
    mass: f64,
}

/// What some particles give to hosts, one particle after the other.
#[derive(Clone, Debug, Default)]
struct Given {
    shares: Vec<Share>,
    /// Where that of each particle begins, and that of the last ends.
    starts: Vec<usize>,
}

/// Columns of a matrix, each half a line: a vector and lanes that mean nothing.
type Columns<const D: usize> = [[f64; 4]; D];

/// A matrix beyond planes of symmetry from that on this side, or the other way round.
#[inline(always)]
fn reflected<const D: usize>(columns: &Columns<D>, image: u32) -> Columns<D> {
    let sign = |axis: usize| if image >> axis & 1 == 1 { -1.0 } else { 1.0 };
    let mut reflected = *columns;
    for (j, column) in reflected.iter_mut().enumerate() {
        for i in 0..D {
            column[i] *= sign(i) * sign(j);
        }
    }
    reflected
}

/// A matrix in columns.
fn in_columns<const D: usize>(matrix: &SMatrix<f64, D, D>) -> Columns<D> {
    array::from_fn(|j| array::from_fn(|i| if i < D { matrix[(i, j)] } else { 0.0 }))
}

/// Columns as a matrix.
fn as_matrix<const D: usize>(columns: &Columns<D>) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| columns[j][i])
}

impl<const D: usize> Default for Around<D> {
    fn default() -> Self {
        Self {
            lanes: Selected::plain(),
            slots: vec![],
            hosts: vec![],
            particles: vec![],
            reaches: vec![],
            given: vec![],
            stencil: vec![],
            rows: vec![],
            is_near: vec![],
            near: vec![],
            gradients: vec![],
            lists: Lists::default(),
        }
    }
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
        (lanes, team): (Selected, &Team),
    ) {
        self.lanes = lanes;
        if self.rows.len() * stencil != self.stencil.len() || self.stencil.is_empty() {
            self.stencil = stencil_nodes(stencil, shape);
            self.rows = stencil_rows(stencil, shape);
        }
        self.find_hosts(patches, shape, mirrors, stencil);
        let bases = shape.bases();
        let mapping = &body.mapping;
        let is_near = &self.is_near;
        let reaches = |p: usize| {
            let base = base_of(&scaled::<D>(set, p, mapping), stencil, shape);
            is_near[place(base, bases)]
        };
        team.fill(0..set.len(), OfItem::Small, reaches, &false, &mut self.lists.reaches);
        // Written over where the one before was none: which are near is hard to foresee, and a branch on it would cost more.
        self.particles.resize(set.len(), 0);
        let mut count = 0;
        for (p, &reaches) in self.lists.reaches.iter().enumerate() {
            self.particles[count] = p;
            count += usize::from(reaches);
        }
        self.particles.truncate(count);
        self.reaches.resize(self.particles.len(), Reach::NOWHERE);
        let share = self.share_of_thread(team);
        let mut given = std::mem::take(&mut self.given);
        let mut reaches = std::mem::take(&mut self.reaches);
        let parts = self.particles.len().div_ceil(share);
        given.resize_with(given.len().max(parts), Given::default);
        for given in &mut given {
            given.clear();
        }
        let parts = self.particles.chunks(share).zip(reaches.chunks_mut(share));
        team.each(parts.zip(&mut given), |((particles, found), given)| {
            lanes.run(Reaches {
                particles,
                set,
                mapping,
                shape,
                mirrors,
                stencil,
                found,
            });
            // Never emptied: for each particle that would cost more than to find what it gives.
            let mut room = [Share::default(); MOST_NODES];
            for (&p, reach) in particles.iter().zip(&*found) {
                let m_p = set.columns[Layout::MASS][p];
                given.add(self, reach, m_p, (shape, mirrors), &mut room);
            }
        });
        for share in given.iter().flat_map(|given| &given.shares) {
            self.hosts[share.host as usize].mass += share.mass;
        }
        (self.given, self.reaches) = (given, reaches);
    }

    /// What each particle gives to hosts.
    fn shares(&self) -> impl Iterator<Item = &[Share]> {
        self.given.iter().flat_map(|given| {
            let starts = given.starts.windows(2);
            starts.map(|range| &given.shares[range[0]..range[1]])
        })
    }

    /// How many particles a thread takes at once.
    fn share_of_thread(&self, team: &Team) -> usize {
        self.particles
            .len()
            .div_ceil(team.count())
            .max(LEAST_SHARE)
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

    /// Finds the parts that vertices follow of the velocity gradients at the nodes that they hang on, from the velocities of all
    /// nodes (eq. 28 for the whole gradient).
    pub(super) fn find_gradients(&mut self, lines: &[Line], follow: Follow, team: &Team) {
        let mut lists = std::mem::take(&mut self.lists);
        let Lists {
            of_particles,
            of_hosts,
            ..
        } = &mut lists;
        // Each particle by whatever thread; the sums by one, in the order of the particles.
        of_particles.resize(self.particles.len(), [[0.0; 4]; D]);
        let share = self.share_of_thread(team);
        let parts = self.reaches.chunks(share);
        let parts = parts.zip(of_particles.chunks_mut(share));
        team.each(parts, |(reaches, gradients)| {
            self.lanes.run(gradient::OfParticles {
                reaches,
                rows: &self.rows,
                row_length: self.stencil.len() / self.rows.len(),
                lines,
                gradients,
            });
        });
        of_hosts.clear();
        of_hosts.resize(self.hosts.len(), [[0.0; 4]; D]);
        self.lanes.run(gradient::Gathered {
            around: self,
            of_particles,
            of_hosts,
        });
        let found = self.hosts.iter().zip(&*of_hosts);
        self.gradients.clear();
        self.gradients.extend(
            found.map(|(host, columns)| follow.part(&host.per_mass(as_matrix(columns)))),
        );
        self.lists = lists;
    }

    /// What was found at a node \[1/s\]; zero where no vertex hangs on it.
    pub(super) fn gradient_at(&self, node: usize) -> SMatrix<f64, D, D> {
        match self.slots.get(node) {
            Some(&slot) if slot > 0 => self.gradients[slot as usize - 1],
            _ => SMatrix::zeros(),
        }
    }

    /// Adds to the forces on the nodes what turns and stretches the body: the transpose of [`Around::find_gradients`] and of
    /// what vertices take of them. `forces` are those on the vertices \[N\].
    pub(super) fn load<const N: usize>(
        &mut self,
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
        let mut lists = std::mem::take(&mut self.lists);
        let Lists {
            of_hosts,
            moments,
            is_turned,
            ..
        } = &mut lists;
        moments.clear();
        moments.resize(self.hosts.len(), SMatrix::zeros());
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
        let all = moments.iter().zip(&self.hosts);
        of_hosts.clear();
        of_hosts.extend(
            all.map(|(moment, host)| in_columns(&host.per_mass(follow.part(moment)))),
        );
        is_turned.clear();
        is_turned.extend(of_hosts.iter().map(|m| *m != [[0.0; 4]; D]));
        self.lanes.run(moment::Spread {
            around: self,
            moments: of_hosts,
            is_turned,
            lines,
            shape,
            mirrors,
        });
        self.lists = lists;
    }
}

impl Given {
    fn clear(&mut self) {
        self.shares.clear();
        self.starts.clear();
        self.starts.push(0);
    }

    /// Adds what a particle gives to the hosts that it reaches; `room` is written over.
    fn add<const D: usize>(
        &mut self,
        around: &Around<D>,
        reach: &Reach<D>,
        m_p: f64,
        (shape, mirrors): (&GridShape, &Mirrors),
        room: &mut [Share; MOST_NODES],
    ) {
        // Written over where the one before was none, as above.
        let mut count = 0;
        let mut give = |weight: f64, inside: usize, image: u32| {
            let slot = around.slots[inside];
            room[count] = Share {
                host: slot.wrapping_sub(1),
                image,
                mass: weight * m_p,
            };
            count += usize::from(slot > 0) & usize::from(weight != 0.0);
        };
        if reach.mirrored {
            for node in &around.stencil {
                let (inside, sides) = reach.inside(node, shape, mirrors);
                let in_axis = |axis: usize| u32::from(sides[axis] < 0.0) << axis;
                give(reach.weight(node), inside, (0..D).map(in_axis).sum());
            }
        } else {
            let row_length = around.stencil.len() / around.rows.len();
            let along = &reach.along_row().0[..row_length];
            for row in &around.rows {
                let (across, _) = reach.across_row(row);
                let first = reach.node(row);
                for (k, w) in along.iter().enumerate() {
                    give(across * w, first + k, 0);
                }
            }
        }
        self.shares.extend_from_slice(&room[..count]);
        self.starts.push(self.shares.len());
    }
}

impl<const D: usize> Host<D> {
    /// A sum over the particles around it as a mean, without what images cancel.
    fn per_mass(&self, sum: SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
        if self.mass > 0.0 {
            sum.component_mul(&self.kept) / self.mass
        } else {
            SMatrix::zeros()
        }
    }
}

/// Place of a base among all bases.
fn place(base: [usize; 3], bases: [usize; 3]) -> usize {
    (base[0] * bases[1] + base[1]) * bases[2] + base[2]
}
