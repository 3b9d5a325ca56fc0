//! The parts of a step that mortar contact adds.

use super::gradients::NodalGradients;
use super::surface::{Carrier, Patch, mass_of, nodes_of_patch};
use crate::mortar::Point;
use crate::mortar::bound::NodalStiffness;
use crate::mortar::motion::{Follow, vertex_velocity};
use crate::mortar::weights::VertexWeights;
use crate::simulation::acting::Acting;
use crate::simulation::contact::{all, number_of, shared_loads};
use crate::simulation::error::{StepError, StepErrorKind};
use crate::simulation::passes::{Sums, bodies_onto, total, trial};
use crate::simulation::{Simulation, history_value};
use crate::stage::p2g::Carry;
use crate::stage::solve::{EmptyNode, Forces, PlaneSums};

impl Simulation {
    /// Gives each body with a boundary its layer, after a sort.
    pub(crate) fn set_mortar_layers(&mut self) {
        let mut bodies: Vec<usize> = self.mortar.bodies().collect();
        bodies.sort_by_key(|&i| self.bodies[i].id);
        for &i in &bodies {
            self.bodies[i].in_layer = true;
        }
        self.contact
            .layers
            .set(&bodies, &self.sets, &self.field, self.stencil);
    }

    /// The first part of a step with mortar contact: mapping, weights, gaps and forces, and the time step that they
    /// allow.
    pub(in crate::simulation) fn meet_boundaries(&mut self) -> Result<(), StepError> {
        if !self.mortar.acts() {
            return Ok(());
        }
        let acting = self.acting(self.clock.dt_before);
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::All,
        );
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
                        planes.velocities();
                    }
                    groups
                });
        self.mortar.groups = groups.into_iter().sum();
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
        Ok(())
    }

    /// Augmented weights of the vertices of all bodies.
    fn weigh_vertices(&mut self) -> Result<(), StepError> {
        let shape = &self.field.shape;
        let mut lost = None;
        for surface in &mut self.mortar.surfaces {
            let Carrier::Body { index, .. } = surface.carrier else {
                continue;
            };
            let Some(layer) = self.contact.layers.list.iter().find(|l| l.body == index) else {
                continue;
            };
            let mapping = &self.bodies[index].mapping;
            let half_length = mapping.half_length[0].min(mapping.half_length[1]).min(0.5);
            surface.patches.clear();
            for (vertex, x) in surface.boundary.points.iter().enumerate() {
                let xi = Point::new(x.x * mapping.inverse_cell[0], x.y * mapping.inverse_cell[1]);
                let raw = VertexWeights::new(mapping.family, &xi, half_length);
                let nodes = nodes_of_patch(raw.base, shape);
                let masses = std::array::from_fn(|k| {
                    nodes[k].map_or(0.0, |n| mass_of(n, shape, &layer.rows, layer.nodes.lines()))
                });
                if let Ok(weights) = raw.augmented(&masses) {
                    surface.patches.push(Patch {
                        weights,
                        masses,
                        nodes: nodes.map(Option::unwrap_or_default),
                    });
                } else {
                    lost = lost.or(Some((surface.id, vertex, *x)));
                    break;
                }
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

    /// Stops where a pair approached by more than half the critical gap in the last step, and may do so again, or is
    /// deeper in each other than the critical gap.
    fn judge_pair(&self, p: usize) -> Result<(), StepError> {
        let pair = &self.mortar.pairs[p];
        let (slave, master) = (
            &self.mortar.surfaces[pair.slave],
            &self.mortar.surfaces[pair.master],
        );
        let error = |vertex: usize, approach: f64| {
            self.error(StepErrorKind::Tunnelling {
                bodies: [master.id, slave.id],
                position: Some(self.in_scene(&slave.boundary.points[vertex])),
                approach,
                distance: 0.5 * pair.critical_gap,
            })
        };
        if let Some((vertex, approach)) = pair.forces.largest_approach()
            && approach > 0.5 * pair.critical_gap
        {
            return Err(error(vertex, approach));
        }
        if let Some((vertex, gap)) = pair.forces.smallest_gap()
            && gap < -pair.critical_gap
        {
            return Err(self.error(StepErrorKind::Penetration {
                bodies: [master.id, slave.id],
                position: self.in_scene(&slave.boundary.points[vertex]),
                gap,
            }));
        }
        Ok(())
    }

    /// Time step that the stiffness of all contacts allows \[s\].
    fn contact_time_step(&self) -> f64 {
        let mut most = f64::INFINITY;
        for (s, surface) in self.mortar.surfaces.iter().enumerate() {
            let mut nodes = NodalStiffness::default();
            for pair in &self.mortar.pairs {
                for (of, stiffness) in [
                    (pair.slave, &pair.forces.slave_stiffness),
                    (pair.master, &pair.forces.master_stiffness),
                ] {
                    if of != s {
                        continue;
                    }
                    for (patch, k) in surface.patches.iter().zip(stiffness) {
                        nodes.add(&patch.weights, &patch.masses, *k);
                    }
                }
            }
            most = most.min(nodes.time_step());
        }
        most
    }

    /// The second part: forces of the contacts to the nodes, equation of motion; the number of vertices under pressure.
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
                        let nodes_driven = if number == 0 { &acting.driven[..] } else { &[] };
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

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    pub(in crate::simulation) fn move_vertices(&mut self, drift: f64, half_step: f64) {
        let shape = &self.field.shape;
        let cell = Point::new(shape.cell[0], shape.cell[1]);
        for surface in &mut self.mortar.surfaces {
            match &surface.carrier {
                Carrier::Prescribed(motion) => {
                    let v = motion
                        .as_ref()
                        .map_or([0.0; 3], |m| history_value(m, half_step));
                    surface.moved.fill(Point::new(v[0], v[1]) * drift);
                }
                Carrier::Body { index, follow } => {
                    let Some(lines) = self.contact.layers.nodes_of(*index) else {
                        continue;
                    };
                    let gradients = if *follow == Follow::Velocity {
                        NodalGradients::none()
                    } else {
                        NodalGradients::new(
                            &surface.patches,
                            &self.sets[*index],
                            &self.bodies[*index],
                            shape,
                            lines,
                            self.stencil,
                        )
                    };
                    for (moved, patch) in surface.moved.iter_mut().zip(&surface.patches) {
                        let velocities = std::array::from_fn(|k| {
                            let line = &lines[patch.nodes[k]];
                            Point::new(line[1], line[2])
                        });
                        let around = std::array::from_fn(|k| gradients.at(patch.nodes[k]));
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
