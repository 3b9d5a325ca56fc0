//! Contact on the grid in the cycle, and what it tells of itself.

mod on_slab;

use super::error::{Overlapping, SetupError, StepError, StepErrorKind};
use super::fields::Grid;
use super::{BodyRun, Simulation};
use crate::contact::meeting::Tunnelling;
use crate::contact::overlap::overlap;
use crate::contact::{Pair, State, broad};
use crate::particles::ParticleSet;
use crate::scene::{Contact, Scene, Vector};

impl State {
    /// The pairs of a scene. Two bodies whose motion is prescribed cannot act on each other.
    pub(super) fn new(scene: &Scene, bodies: &[BodyRun]) -> Self {
        let index = |id: i64| bodies.iter().position(|b| b.id == id);
        let mut pairs: Vec<Pair> = scene
            .contacts
            .iter()
            .filter_map(|contact| {
                let (master, slave) = (index(contact.master)?, index(contact.slave)?);
                let both = bodies[master].motion.is_some() && bodies[slave].motion.is_some();
                (!both).then(|| pair(scene, bodies, contact, master, slave))
            })
            .collect();
        pairs.sort_by_key(|pair| {
            let (a, b) = (bodies[pair.master].id, bodies[pair.slave].id);
            (a.min(b), a.max(b))
        });
        let count = pairs.len();
        Self {
            pairs,
            near: vec![false; count],
            forces: vec![[0.0; 3]; count],
            ..Self::default()
        }
    }

    /// Indices of the bodies of near pairs, in no order.
    pub(super) fn near_bodies(&self) -> Vec<usize> {
        let near = self.pairs.iter().zip(&self.near).filter(|(_, near)| **near);
        near.flat_map(|(pair, _)| [pair.master, pair.slave])
            .collect()
    }

    /// Has surfaces for these bodies of near pairs, in order of the identifier.
    pub(super) fn set_faces(
        &mut self,
        bodies: &[usize],
        sets: &[ParticleSet],
        grid: &Grid,
        stencil: usize,
    ) {
        self.faces
            .set(bodies, &self.pairs, &self.near, sets, grid, stencil);
    }
}

fn pair(scene: &Scene, bodies: &[BodyRun], contact: &Contact, master: usize, slave: usize) -> Pair {
    let of_particles: Vector = std::array::from_fn(|axis| {
        bodies[master].particle_half_length[axis] + bodies[slave].particle_half_length[axis]
    });
    let distance = match scene.contact_distance {
        Some(lambda) if lambda > 0.0 => scene.mesh.cell.map(|h| lambda * h),
        _ => of_particles,
    };
    Pair {
        id: contact.id,
        master,
        slave,
        friction: contact.friction,
        normal: contact.normal,
        distance,
        corrects_distance: scene.contact_distance != Some(0.0),
    }
}

impl Simulation {
    /// Refuses bodies of a pair that overlap at the start.
    pub(super) fn refuse_overlap(&self) -> Result<(), SetupError> {
        let half_lengths: Vec<Vector> =
            self.bodies.iter().map(|b| b.particle_half_length).collect();
        let origin = self.origin();
        let all: Vec<Overlapping> = self
            .contact
            .pairs
            .iter()
            .zip(&self.contact.near)
            .filter(|(_, near)| **near)
            .filter_map(|(pair, _)| {
                let found = overlap(pair, &self.sets, &half_lengths)?;
                let name = self.scene.contacts.iter().find(|c| c.id == pair.id);
                Some(Overlapping {
                    contact: name.map_or_else(String::new, |c| c.name.clone()),
                    bodies: [self.bodies[pair.master].id, self.bodies[pair.slave].id],
                    depth: found.depth,
                    position: std::array::from_fn(|axis| found.at[axis] + origin[axis]),
                })
            })
            .collect();
        if all.is_empty() {
            return Ok(());
        }
        Err(SetupError::Overlap(all))
    }

    /// Refuses a step in which the bodies of a pair could approach by more than a cell: they could pass through each
    /// other without sharing a node. Only a scene that allows unstable steps gets there.
    pub(super) fn refuse_leaps_of_pairs(&self, dt: f64) -> Result<(), StepError> {
        let h = self.scene.mesh.cell[..self.plan.axes]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        for pair in &self.contact.pairs {
            let approach = [pair.master, pair.slave]
                .map(|body| self.bodies[body].found.speed_squared.sqrt() * dt)
                .iter()
                .sum::<f64>();
            if approach > h * (1.0 + 1e-9) {
                return Err(self.error(StepErrorKind::Tunnelling {
                    bodies: [self.bodies[pair.master].id, self.bodies[pair.slave].id],
                    position: None,
                    approach,
                    distance: h,
                }));
            }
        }
        Ok(())
    }

    /// After a sort: which pairs are near.
    pub(super) fn find_near_pairs(&mut self) {
        let (shape, stencil) = (&self.grid.shape, self.stencil);
        self.contact.near = broad::near(&self.contact.pairs, &self.sets, shape, stencil);
    }

    /// Adds up the forces of all slabs in order of their planes, and stops where bodies would pass through each other; the
    /// number of nodes where a force acts.
    pub(super) fn gather_contact(&mut self) -> Result<usize, StepError> {
        if self.contact.faces.list.is_empty() {
            self.contact.met.clear();
        }
        let contact = &mut self.contact;
        let pairs = contact.pairs.len();
        contact.forces.fill([0.0; 3]);
        let mut nodes = 0;
        let mut worst: Option<Tunnelling> = None;
        for met in &contact.met {
            for of_plane in met.done.forces.chunks_exact(pairs) {
                for (sum, force) in contact.forces.iter_mut().zip(of_plane) {
                    for axis in 0..3 {
                        sum[axis] += force[axis];
                    }
                }
            }
            nodes += met.done.nodes;
            if let Some(at) = met.done.tunnelling {
                let worse =
                    worst.is_none_or(|w| at.approach * w.distance > w.approach * at.distance);
                worst = if worse { Some(at) } else { worst };
            }
        }
        worst.map_or(Ok(nodes), |at| Err(self.tunnelling(at)))
    }

    fn tunnelling(&self, at: Tunnelling) -> StepError {
        let pair = &self.contact.pairs[at.pair];
        let local = self.grid.shape.position(self.grid.shape.index(at.at));
        self.error(StepErrorKind::Tunnelling {
            bodies: [self.bodies[pair.master].id, self.bodies[pair.slave].id],
            position: Some(std::array::from_fn(|axis| {
                local[axis] + self.origin()[axis]
            })),
            approach: at.approach,
            distance: at.distance,
        })
    }

    /// Contact force on a body in the last step \[N\]: the sum over its pairs and the rigid surfaces. On the two bodies
    /// of a pair that have no other it is the same number with opposite signs.
    #[must_use]
    pub fn contact_force(&self, set: usize) -> Vector {
        let mut sum = self.mortar_force(self.bodies[set].id).unwrap_or_default();
        for surface in 0..self.scene.surfaces.len() {
            let force = self.surface_force_on(surface, set);
            sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
        }
        for (pair, force) in self.contact.pairs.iter().zip(&self.contact.forces) {
            for axis in 0..3 {
                if pair.slave == set {
                    sum[axis] += force[axis];
                } else if pair.master == set {
                    sum[axis] -= force[axis];
                }
            }
        }
        sum
    }

    /// Whether a body is in a pair that can touch, or there are rigid surfaces.
    #[must_use]
    pub fn has_contact(&self, set: usize) -> bool {
        let pairs = &self.contact.pairs;
        self.surfaces.is_some()
            || pairs.iter().any(|p| p.master == set || p.slave == set)
            || self.mortar_force(self.bodies[set].id).is_some()
    }

    /// Number of velocity fields beside that of the phase: bodies with a boundary, or near a partner of contact.
    #[must_use]
    pub fn contact_layers(&self) -> usize {
        self.grid.fields.len() - 1
    }
}
