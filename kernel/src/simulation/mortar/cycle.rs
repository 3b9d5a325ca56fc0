//! The parts of a step that mortar contact adds.

use super::MortarState;
use super::gradients::NodalGradients;
use super::surface::{Carrier, Patch, mass_of, nodes_of_patch, velocity_of};
use crate::mortar::Point;
use crate::mortar::bound::{Closing, allowed_approach};
use crate::mortar::motion::{Follow, vertex_velocity};
use crate::mortar::weights::VertexWeights;
use crate::simulation::Simulation;
use crate::simulation::acting::Acting;
use crate::simulation::contact::{all, number_of, shared_loads};
use crate::simulation::error::{StepError, StepErrorKind};
use crate::simulation::passes::{Sums, at_half_step_after, bodies_onto, total, trial};
use crate::stage::p2g::Carry;
use crate::stage::solve::{EmptyNode, Forces, PlaneSums};
use nalgebra::Matrix2;

impl Simulation {
    /// Gives each body with a boundary its layer, after a sort.
    pub(crate) fn set_mortar_layers(&mut self) {
        let mut bodies: Vec<usize> = self.mortar.bodies().collect();
        bodies.sort_by_key(|&i| self.bodies[i].id);
        for &i in &bodies {
            self.bodies[i].in_layer = true;
        }
        // Contact on the grid has no pair among them.
        self.contact
            .layers
            .set(&bodies, &[], &[], &self.sets, &self.field, self.stencil);
    }

    /// The first part of a step with boundaries: mapping to the nodes, each body to its layer.
    pub(in crate::simulation) fn map_to_boundaries(&mut self) {
        let acting = self.acting(self.clock.dt_before);
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            if self.plan.spin {
                Carry::AllAndSpin
            } else {
                Carry::All
            },
        );
        let spin = self.plan.spin;
        let groups =
            self.contact
                .layers
                .visit(&mut self.field, self.pool.as_ref(), |mut fields| {
                    let mut groups = 0;
                    for planes in all(&mut fields) {
                        planes.clear();
                    }
                    groups += mapping.run(&mut fields.common);
                    for layer in &mut fields.layers {
                        groups += mapping.map(layer.body, &mut layer.planes);
                    }
                    for planes in all(&mut fields) {
                        planes.fold(&acting.walls, true, true);
                        if spin {
                            planes.fold_spins(&acting.walls);
                        }
                        planes.velocities();
                    }
                    groups
                });
        self.mortar.groups = groups.into_iter().sum();
    }

    /// The second part: weights of the vertices, gaps and forces, and the time step that they allow.
    pub(in crate::simulation) fn meet_boundaries(&mut self) -> Result<(), StepError> {
        self.weigh_vertices()?;
        for surface in &mut self.mortar.surfaces {
            surface.force.fill(Point::zeros());
        }
        for p in 0..self.mortar.pairs.len() {
            self.mortar.meet(p);
            self.judge_pair(p)?;
            let pair = &self.mortar.pairs[p];
            for (surface, forces) in [
                (pair.slave, &pair.forces.slave),
                (pair.master, &pair.forces.master),
            ] {
                let own = &mut self.mortar.surfaces[surface].force;
                for (sum, f) in own.iter_mut().zip(forces) {
                    *sum += f;
                }
            }
        }
        self.mortar.time_step = self.contact_time_step();
        let pairs = self.mortar.pairs.iter();
        self.mortar.closing_step = pairs
            .map(|pair| pair.closing.time_step())
            .fold(f64::INFINITY, f64::min);
        Ok(())
    }

    /// Augmented weights of the vertices of all bodies; velocities of all vertices.
    fn weigh_vertices(&mut self) -> Result<(), StepError> {
        let shape = &self.field.shape;
        let time = self.clock.time;
        let mut lost = None;
        for surface in &mut self.mortar.surfaces {
            let (index, follow) = match &surface.carrier {
                Carrier::Body { index, follow } => (*index, *follow),
                Carrier::Prescribed(motion) => {
                    let v = velocity_of(motion.as_ref(), time);
                    surface.velocity.fill(v);
                    continue;
                }
            };
            let Some(layer) = self.contact.layers.list.iter().find(|l| l.body == index) else {
                continue;
            };
            let lines = layer.nodes.lines();
            let mapping = &self.bodies[index].mapping;
            let half_length = mapping.half_length[0].min(mapping.half_length[1]).min(0.5);
            surface.patches.clear();
            for (vertex, x) in surface.boundary.points.iter().enumerate() {
                let xi = Point::new(x.x * mapping.inverse_cell[0], x.y * mapping.inverse_cell[1]);
                let raw = VertexWeights::new(mapping.family, &xi, half_length);
                let nodes = nodes_of_patch(raw.base, shape);
                let masses = std::array::from_fn(|k| {
                    nodes[k].map_or(0.0, |n| mass_of(n, shape, &layer.rows, lines))
                });
                let weights = if follow == Follow::Unaugmented {
                    Ok(raw.on_mass(&masses))
                } else {
                    raw.augmented(&masses)
                };
                let Ok(weights) = weights else {
                    lost = lost.or(Some((surface.id, vertex, *x)));
                    break;
                };
                let mut patch = Patch {
                    weights,
                    masses,
                    nodes: nodes.map(Option::unwrap_or_default),
                    spins: [0.0; 9],
                };
                let mut v = Point::zeros();
                for k in 0..9 {
                    let w = patch.weights.weights[k];
                    if w > 0.0 {
                        let line = &lines[patch.nodes[k]];
                        v += w * Point::new(line[1], line[2]);
                        patch.spins[k] = line[7] / line[0];
                    }
                }
                surface.velocity[vertex] = v;
                surface.patches.push(patch);
            }
        }
        match lost {
            None => Ok(()),
            Some((body, vertex, x)) => Err(self.error(StepErrorKind::VertexLost {
                body,
                vertex,
                position: self.in_scene(&x),
            })),
        }
    }

    /// Stops where the boundaries of a pair may have passed each other in the last step, or one came into the other by
    /// more than half the critical gap, or is deeper in it than the critical gap.
    fn judge_pair(&self, p: usize) -> Result<(), StepError> {
        let pair = &self.mortar.pairs[p];
        let (slave, master) = (
            &self.mortar.surfaces[pair.slave],
            &self.mortar.surfaces[pair.master],
        );
        let bodies = [master.id, slave.id];
        let missed = |vertex: Option<usize>, approach: f64, allowed: f64| {
            let at = |v: usize| (v, self.in_scene(&slave.boundary.points[v]));
            Err(self.error(StepErrorKind::ClosingTooFast {
                bodies,
                vertex: vertex.map(at),
                approach,
                allowed,
            }))
        };
        let allowed = allowed_approach(pair.law.search.reach, pair.critical_gap);
        let approach = slave.farthest() + master.farthest();
        if approach > allowed {
            return missed(None, approach, allowed);
        }
        // Bodies speed up within a step. What is still apart has not been missed.
        let allowed = 0.5 * pair.critical_gap;
        for (k, vertex) in pair.forces.vertices.iter().enumerate() {
            if let Some(v) = vertex
                && v.gap < 0.0
                && v.approach > allowed
            {
                return missed(Some(k), v.approach, allowed);
            }
        }
        if let Some((vertex, gap)) = pair.forces.smallest_gap()
            && gap < -pair.critical_gap
        {
            return Err(self.error(StepErrorKind::Penetration {
                bodies,
                vertex,
                position: self.in_scene(&slave.boundary.points[vertex]),
                gap,
            }));
        }
        Ok(())
    }

    /// Refuses a step in which a gap would close too far at the speed that it closes with now.
    pub(in crate::simulation) fn refuse_fast_closing(&self, dt: f64) -> Result<(), StepError> {
        for pair in &self.mortar.pairs {
            let Closing {
                vertex,
                speed,
                allowed,
            } = pair.closing;
            // Round-off must not refuse a step that was chosen to be exactly this long.
            if speed * dt > allowed * (1.0 + 1e-9) {
                let [slave, master] = [pair.slave, pair.master].map(|s| &self.mortar.surfaces[s]);
                let at = |v: usize| (v, self.in_scene(&slave.boundary.points[v]));
                return Err(self.error(StepErrorKind::ClosingTooFast {
                    bodies: [master.id, slave.id],
                    vertex: vertex.map(at),
                    approach: speed * dt,
                    allowed,
                }));
            }
        }
        Ok(())
    }

    /// Time step that the stiffness of all contacts allows \[s\].
    fn contact_time_step(&mut self) -> f64 {
        let MortarState {
            surfaces,
            pairs,
            stiffness: nodes,
            ..
        } = &mut self.mortar;
        let mut most = f64::INFINITY;
        for (s, surface) in surfaces.iter().enumerate() {
            nodes.clear();
            for pair in &*pairs {
                for (of, stiffness) in [
                    (pair.slave, &pair.forces.slave_stiffness),
                    (pair.master, &pair.forces.master_stiffness),
                ] {
                    if of != s {
                        continue;
                    }
                    for (patch, k) in surface.patches.iter().zip(stiffness) {
                        nodes.add(&patch.nodes, &patch.weights.weights, &patch.masses, *k);
                    }
                }
            }
            most = most.min(nodes.time_step());
        }
        most
    }

    /// The third part: forces of the contacts to the nodes, equation of motion; the number of vertices under pressure.
    pub(in crate::simulation) fn solve_with_mortar(
        &mut self,
        acting: &Acting,
    ) -> Result<usize, StepError> {
        for surface in &self.mortar.surfaces {
            let Carrier::Body { index, .. } = surface.carrier else {
                continue;
            };
            let layers = &mut self.contact.layers.list;
            let Some(layer) = layers.iter_mut().find(|l| l.body == index) else {
                continue;
            };
            let lines = layer.nodes.lines_mut();
            for (patch, force) in surface.patches.iter().zip(&surface.force) {
                if *force == Point::zeros() {
                    continue;
                }
                for k in 0..9 {
                    let w = patch.weights.weights[k];
                    if w > 0.0 {
                        let line = &mut lines[patch.nodes[k]];
                        line[4] += w * force.x;
                        line[5] += w * force.y;
                    }
                }
            }
        }
        let forces = Forces {
            gravity: self.scene.gravity,
            loads: &self.loads,
            local_damping: self.plan.local_damping,
            kick: acting.kick,
        };
        let measure = self.plan.measure;
        let driven = vec![false; self.bodies.len()];
        let results =
            self.contact
                .layers
                .visit(&mut self.field, self.pool.as_ref(), |mut fields| {
                    let loads = shared_loads(&fields, forces.loads, &driven)?;
                    let mut sums = vec![PlaneSums::default(); fields.common.range.len()];
                    for (number, own) in loads.iter().enumerate() {
                        let forces = Forces {
                            loads: own,
                            ..forces
                        };
                        let nodes_driven = if number == 0 {
                            &acting.driven
                        } else {
                            &acting.held
                        };
                        let planes = number_of(&mut fields, number);
                        trial(planes, acting, nodes_driven, &forces, &mut sums)?;
                        planes.unfold(&acting.walls, true);
                        planes.add_sums(&forces, measure, &mut sums);
                    }
                    Ok(Sums { sums, groups: 0 })
                });
        let mut sums = vec![];
        for result in results {
            sums.push(result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?);
        }
        self.ledger.sums = total(sums).total;
        self.groups.count(self.mortar.groups);
        let vertices = self.mortar.pairs.iter().flat_map(|p| &p.forces.vertices);
        Ok(vertices
            .flatten()
            .filter(|vertex| vertex.pressure > 0.0)
            .count())
    }

    /// The second mapping of MUSL. Contact acts through forces, which the particles already have.
    pub(in crate::simulation) fn remap_with_mortar(&mut self, acting: &Acting) {
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::Remap,
        );
        let still = at_half_step_after(&acting.walls);
        self.contact
            .layers
            .visit(&mut self.field, self.pool.as_ref(), |mut fields| {
                for planes in all(&mut fields) {
                    planes.clear_upper();
                }
                mapping.run(&mut fields.common);
                for layer in &mut fields.layers {
                    mapping.map(layer.body, &mut layer.planes);
                }
                for planes in all(&mut fields) {
                    planes.fold_remapped(&still);
                    planes.remapped_velocities();
                }
                fields.common.drive_remapped(&acting.driven);
                for layer in &mut fields.layers {
                    layer.planes.drive_remapped(&acting.held);
                }
                for planes in all(&mut fields) {
                    planes.constrain_remapped(&still);
                }
            });
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    pub(in crate::simulation) fn move_vertices(&mut self, drift: f64, half_step: f64) {
        let shape = &self.field.shape;
        let cell = Point::new(shape.cell[0], shape.cell[1]);
        for surface in &mut self.mortar.surfaces {
            match &surface.carrier {
                Carrier::Prescribed(motion) => {
                    let v = velocity_of(motion.as_ref(), half_step);
                    surface.moved.fill(v * drift);
                }
                Carrier::Body { index, follow } => {
                    let Some(lines) = self.contact.layers.nodes_of(*index) else {
                        continue;
                    };
                    let gradients = (*follow == Follow::Gradient).then(|| {
                        NodalGradients::new(
                            &surface.patches,
                            &self.sets[*index],
                            &self.bodies[*index],
                            shape,
                            lines,
                            self.stencil,
                        )
                    });
                    for (moved, patch) in surface.moved.iter_mut().zip(&surface.patches) {
                        let velocities = std::array::from_fn(|k| {
                            let line = &lines[patch.nodes[k]];
                            Point::new(line[1], line[2])
                        });
                        let around = std::array::from_fn(|k| match &gradients {
                            Some(gradients) => gradients.at(patch.nodes[k]),
                            None => Matrix2::new(0.0, -patch.spins[k], patch.spins[k], 0.0),
                        });
                        let v =
                            vertex_velocity(&patch.weights, &velocities, &around, *follow, &cell);
                        *moved = v * drift;
                    }
                }
            }
            for (x, moved) in surface.boundary.points.iter_mut().zip(&surface.moved) {
                *x += moved;
            }
        }
    }
}
