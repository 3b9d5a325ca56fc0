//! The passes of a step where bodies have velocity fields of their own, and what contact tells of itself.

mod sums;

use super::acting::Acting;
use super::error::{Overlapping, SetupError, StepError, StepErrorKind};
use super::passes::{BodiesOnto, Mapped, Sums, at_half_step_after, bodies_onto, total, trial};
use super::{BodyRun, Simulation};
use crate::contact::layers::{LayerPlanes, SlabFields};
use crate::contact::meeting::{Bodies, Done, Meetings, On, States, Tunnelling};
use crate::contact::overlap::overlap;
use crate::contact::{Pair, State, broad, surface};
use crate::particles::ParticleSet;
use crate::plan::Plan;
use crate::scene::{Contact, Scene, Vector};
use crate::stage::p2g::Carry;
use crate::stage::solve::{EmptyNode, Forces, PlaneSums, Planes, Wall};
use sums::add_sums;
pub(super) use sums::{number_of, shared_loads};

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
    pub(super) fn refuse_leaps(&self, dt: f64) -> Result<(), StepError> {
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

    /// After a sort: which pairs are near, and layers for their bodies.
    pub(super) fn find_near_pairs(&mut self) {
        let (shape, stencil) = (&self.field.shape, self.stencil);
        let near = broad::near(&self.contact.pairs, &self.sets, shape, stencil);
        self.set_near_pairs(near);
    }

    /// Takes up which pairs are near.
    pub(crate) fn set_near_pairs(&mut self, near: Vec<bool>) {
        let contact = &mut self.contact;
        contact.near = near;
        for body in &mut self.bodies {
            body.in_layer = false;
        }
        for (pair, _) in contact.pairs.iter().zip(&contact.near).filter(|(_, n)| **n) {
            self.bodies[pair.master].in_layer = true;
            self.bodies[pair.slave].in_layer = true;
        }
        let mut bodies: Vec<usize> = (0..self.bodies.len())
            .filter(|&i| self.bodies[i].in_layer)
            .collect();
        bodies.sort_by_key(|&i| self.bodies[i].id);
        contact.layers.set(
            &bodies,
            &contact.pairs,
            &contact.near,
            &self.sets,
            &self.field,
            self.stencil,
        );
    }

    /// As [`Simulation::map_to_nodes`] where bodies have layers: trial velocities of all fields, then contact.
    pub(super) fn map_to_layers(
        &mut self,
        acting: &Acting,
        dt: f64,
    ) -> Result<(usize, usize), StepError> {
        let plan = &self.plan;
        let alone = self.surfaces.is_none();
        let driven = driven(&self.bodies);
        let prescribed = prescribed(&self.bodies, acting);
        let mapping = bodies_onto(
            plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::All,
        );
        let only_mass = mapping.with(plan, Carry::Momentum);
        let gradient = mapping.with(plan, Carry::MassGradient);
        let forces = Forces {
            gravity: self.scene.gravity,
            loads: &self.loads,
            local_damping: plan.local_damping,
            kick: acting.kick,
        };
        let contact = &mut self.contact;
        let bodies = bodies(
            &contact.pairs,
            &contact.near,
            &self.sets,
            &driven,
            acting,
            self.stencil,
        );
        let results = contact.layers.visit(&mut self.field, |mut fields| {
            let mut groups = clear_and_map(&mut fields, &mapping, |body| {
                if driven[body] { &only_mass } else { &mapping }
            });
            for planes in all(&mut fields) {
                planes.fold(&acting.walls, true, true);
                planes.velocities();
            }
            groups += map_gradients(&mut fields, &gradient, &acting.walls);
            let loads = shared_loads(&fields, forces.loads, &driven)?;
            let mut sums = vec![PlaneSums::default(); fields.common.range.len()];
            for (number, own) in loads.iter().enumerate() {
                let forces = Forces {
                    loads: own,
                    ..forces
                };
                match number.checked_sub(1).map(|i| &mut fields.layers[i]) {
                    None => trial(
                        &mut fields.common,
                        acting,
                        &acting.driven,
                        &forces,
                        &mut sums,
                    )?,
                    Some(layer) if driven[layer.body] => {
                        prescribe(layer, &prescribed[layer.body], &acting.walls);
                    }
                    Some(layer) => trial(&mut layer.planes, acting, &[], &forces, &mut sums)?,
                }
            }
            let mut meetings = Meetings::find(&mut fields, &bodies);
            let kick = acting.kick;
            let damping = plan.local_damping;
            let done = meetings.act(&mut fields, &bodies, On::Trial { kick, dt, damping });
            if damping.is_some() {
                // Contact does not know what the planes hold, and damps it too.
                for planes in all(&mut fields) {
                    planes.constrain(&acting.walls, true);
                }
            }
            for (sums, power) in sums.iter_mut().zip(&done.power) {
                sums.power += power;
            }
            for planes in all(&mut fields) {
                planes.unfold(&acting.walls, true);
            }
            // Surfaces still change the velocities, and take the sums after it.
            if alone {
                add_sums(
                    &mut fields,
                    &loads,
                    &forces,
                    &driven,
                    plan.measure,
                    &mut sums,
                );
            }
            Ok((Sums { sums, groups }, meetings, done))
        });
        let (mut sums, mut meetings, mut done) = (vec![], vec![], vec![]);
        for result in results {
            let (of_slab, met, did) =
                result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?;
            sums.push(of_slab);
            meetings.push(met);
            done.push(did);
        }
        self.contact.meetings = meetings;
        let Mapped { total, groups } = total(sums);
        self.ledger.sums = total;
        self.keep_forces(&done)?;
        Ok((groups, done.iter().map(|d| d.nodes).sum()))
    }

    /// As [`Simulation::remap`] where bodies have layers.
    pub(super) fn remap_layers(&mut self, acting: &Acting) {
        self.map_again(acting, Carry::Remap, |fields, second| {
            for planes in all(fields) {
                planes.clear_upper();
            }
            second.mapping.run(&mut fields.common);
            for layer in &mut fields.layers {
                if second.bodies.driven[layer.body] {
                    for_masses(&mut layer.planes, |line| {
                        line[4..7].copy_from_slice(&second.prescribed[layer.body][1]);
                    });
                } else {
                    second.mapping.map(layer.body, &mut layer.planes);
                    layer.planes.fold_remapped(&second.still);
                    layer.planes.remapped_velocities();
                }
            }
            fields.common.fold_remapped(&second.still);
            fields.common.remapped_velocities();
            fields.common.drive_remapped(&acting.driven);
            // Contact keeps to the planes once the fields do; the ghosts are filled after it.
            for planes in all(fields) {
                planes.constrain_remapped(&second.still);
            }
            let mut meetings = second.meetings[fields.slab].clone();
            meetings.act(fields, &second.bodies, On::Remapped);
            for planes in all(fields) {
                planes.constrain_remapped(&second.still);
            }
        });
    }

    /// As [`Simulation::map_momentum`] where bodies have layers.
    pub(super) fn map_momentum_to_layers(&mut self, acting: &Acting) {
        let before = self.contact.meetings.iter().flat_map(Meetings::states);
        let states: States = before.collect();
        self.map_again(acting, Carry::Momentum, |fields, second| {
            clear_and_map(fields, &second.mapping, |_| &second.mapping);
            for planes in all(fields) {
                planes.fold(&second.still, true, false);
                planes.velocities();
            }
            let gradient = second.mapping.with(second.plan, Carry::MassGradient);
            map_gradients(fields, &gradient, &second.still);
            fields.common.drive(&acting.driven, false);
            fields.common.constrain(&second.still, false);
            for layer in &mut fields.layers {
                if second.bodies.driven[layer.body] {
                    prescribe(layer, &second.prescribed[layer.body], &second.still);
                } else {
                    layer.planes.constrain(&second.still, false);
                }
            }
            let mut meetings = Meetings::find(fields, &second.bodies);
            meetings.recall(&states);
            meetings.act(fields, &second.bodies, On::Mapped);
            for planes in all(fields) {
                planes.unfold(&second.still, false);
            }
        });
    }

    /// Visits all slabs for the second mapping of a step, that of the velocities after the kick.
    fn map_again(
        &mut self,
        acting: &Acting,
        carry: Carry,
        act: impl Fn(&mut SlabFields<'_>, &Second<'_>) + Send + Sync,
    ) {
        let driven = driven(&self.bodies);
        let contact = &mut self.contact;
        let second = Second {
            plan: &self.plan,
            mapping: bodies_onto(
                &self.plan,
                &self.sets,
                &self.bodies,
                self.lanes,
                self.stencil,
                carry,
            ),
            bodies: bodies(
                &contact.pairs,
                &contact.near,
                &self.sets,
                &driven,
                acting,
                self.stencil,
            ),
            prescribed: prescribed(&self.bodies, acting),
            still: at_half_step_after(&acting.walls),
            meetings: &contact.meetings,
        };
        contact.layers.visit(&mut self.field, |mut fields| {
            act(&mut fields, &second);
        });
    }

    /// Adds up the forces of all slabs in order of their planes, and stops where bodies would pass through each other.
    fn keep_forces(&mut self, done: &[Done]) -> Result<(), StepError> {
        let pairs = self.contact.pairs.len();
        self.contact.forces.fill([0.0; 3]);
        for of_plane in done.iter().flat_map(|d| d.forces.chunks_exact(pairs)) {
            for (sum, force) in self.contact.forces.iter_mut().zip(of_plane) {
                for axis in 0..3 {
                    sum[axis] += force[axis];
                }
            }
        }
        let worst = done.iter().filter_map(|d| d.tunnelling).reduce(|a, b| {
            if b.approach * a.distance > a.approach * b.distance {
                b
            } else {
                a
            }
        });
        worst.map_or(Ok(()), |at| Err(self.tunnelling(at)))
    }

    fn tunnelling(&self, at: Tunnelling) -> StepError {
        let pair = &self.contact.pairs[at.pair];
        let local = self.field.shape.position(self.field.shape.index(at.at));
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

    /// Number of velocity fields beside the common one: bodies that are near a partner of contact.
    #[must_use]
    pub fn contact_layers(&self) -> usize {
        self.contact.layers.list.len()
    }
}

/// What the second mapping of a step knows beside the fields.
struct Second<'a> {
    plan: &'a Plan,
    mapping: BodiesOnto<'a>,
    bodies: Bodies<'a>,
    /// Velocities of driven bodies half a step before and after \[m/s\].
    prescribed: Vec<[Vector; 2]>,
    /// Walls with the velocity half a step after alone.
    still: Vec<Wall>,
    /// Where bodies met in the first mapping.
    meetings: &'a [Meetings],
}

/// Whether the motion of each body is prescribed.
fn driven(bodies: &[BodyRun]) -> Vec<bool> {
    bodies.iter().map(|b| b.motion.is_some()).collect()
}

/// Prescribed velocity of each body half a step before and after \[m/s\]; zero for the others.
fn prescribed(bodies: &[BodyRun], acting: &Acting) -> Vec<[Vector; 2]> {
    bodies
        .iter()
        .map(|body| {
            body.motion.as_ref().map_or([[0.0; 3]; 2], |motion| {
                acting.half_steps.map(|t| super::history_value(motion, t))
            })
        })
        .collect()
}

fn bodies<'a>(
    pairs: &'a [Pair],
    near: &'a [bool],
    sets: &'a [ParticleSet],
    driven: &'a [bool],
    acting: &'a Acting,
    stencil: usize,
) -> Bodies<'a> {
    Bodies {
        pairs,
        near,
        sets,
        driven,
        walls: &acting.walls,
        stencil,
    }
}

/// The fields of a slab, common one first.
pub(super) fn all<'f, 'a>(
    fields: &'f mut SlabFields<'a>,
) -> impl Iterator<Item = &'f mut Planes<'a>> {
    std::iter::once(&mut fields.common).chain(fields.layers.iter_mut().map(|l| &mut l.planes))
}

/// Clears all fields and maps the bodies onto theirs; the number of groups.
fn clear_and_map<'m>(
    fields: &mut SlabFields<'_>,
    common: &BodiesOnto<'m>,
    of: impl Fn(usize) -> &'m BodiesOnto<'m>,
) -> usize {
    for planes in all(fields) {
        planes.clear();
    }
    let mut groups = common.run(&mut fields.common);
    for layer in &mut fields.layers {
        groups += of(layer.body).map(layer.body, &mut layer.planes);
    }
    groups
}

/// Mass gradients of all layers, folded; no groups are counted, since the first mapping did.
fn map_gradients(fields: &mut SlabFields<'_>, gradient: &BodiesOnto<'_>, walls: &[Wall]) -> usize {
    for layer in &mut fields.layers {
        let mut planes = Planes {
            shape: layer.planes.shape,
            rows: &layer.interface.rows,
            range: layer.planes.range.clone(),
            nodes: layer.surface,
        };
        planes.clear();
        gradient.map_interface(layer.body, layer.interface, &mut planes);
        surface::fold_gradient(&mut planes, walls);
    }
    0
}

/// Gives the nodes of a driven body its velocity.
fn prescribe(layer: &mut LayerPlanes<'_>, [before, after]: &[Vector; 2], walls: &[Wall]) {
    for_masses(&mut layer.planes, |line| {
        for axis in 0..3 {
            line[1 + axis] = after[axis];
            line[4 + axis] = after[axis] - before[axis];
        }
    });
    layer.planes.constrain(walls, true);
}

/// Calls `act` for every node in use that has mass.
fn for_masses(planes: &mut Planes<'_>, act: impl Fn(&mut crate::grid::Line)) {
    planes.for_rows(|row| row.iter_mut().filter(|line| line[0] > 0.0).for_each(&act));
}
