//! The parts of a step that mortar contact adds.

use super::boundaries::Hosts;
use super::surface::Mirrors;
use crate::scene::PlaneCondition;
use crate::simulation::Simulation;
use crate::simulation::acting::Acting;
use crate::simulation::contact::{all, number_of, shared_loads};
use crate::simulation::error::StepError;
use crate::simulation::passes::{
    Sums, at_half_step_after, bodies_onto, settle_remapped, total, trial,
};
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
        let groups = self.contact.layers.visit(&mut self.field, |mut fields| {
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
        let time = self.clock.time;
        let mut state = std::mem::take(&mut self.mortar);
        let met = state.meet(&self.hosts(), time);
        self.mortar = state;
        met.map_err(|kind| self.error(kind))
    }

    /// What boundaries need to know of the bodies that carry them.
    fn hosts(&self) -> Hosts<'_> {
        let mesh = &self.scene.mesh;
        Hosts {
            shape: &self.field.shape,
            layers: &self.contact.layers,
            sets: &self.sets,
            bodies: &self.bodies,
            stencil: self.stencil,
            mirrors: Mirrors {
                planes: mesh
                    .planes
                    .map(|sides| sides.map(|condition| condition != PlaneCondition::Free)),
                cells: mesh.cells,
            },
            origin: self.origin(),
        }
    }

    /// Refuses a step in which a gap would close too far at the speed that it closes with now.
    pub(in crate::simulation) fn refuse_fast_closing(&self, dt: f64) -> Result<(), StepError> {
        let (state, origin) = (&self.mortar, self.origin());
        let in_space = || state.space.closing_too_fast(dt, &origin);
        let found = state.plane.closing_too_fast(dt, &origin).or_else(in_space);
        found.map_or(Ok(()), |kind| Err(self.error(kind)))
    }

    /// The third part: forces of the contacts to the nodes, equation of motion; the number of vertices under pressure.
    pub(in crate::simulation) fn solve_with_mortar(
        &mut self,
        acting: &Acting,
    ) -> Result<usize, StepError> {
        self.mortar.plane.load_nodes(&mut self.contact.layers);
        self.mortar.space.load_nodes(&mut self.contact.layers);
        let forces = Forces {
            gravity: self.scene.gravity,
            loads: &self.loads,
            local_damping: self.plan.local_damping,
            kick: acting.kick,
        };
        let measure = self.plan.measure;
        let driven = vec![false; self.bodies.len()];
        let results = self.contact.layers.visit(&mut self.field, |mut fields| {
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
        let half_step = acting.half_steps[1];
        self.ledger.sums.power += self.mortar.plane.power_of_prescribed(half_step)
            + self.mortar.space.power_of_prescribed(half_step);
        self.groups.count(self.mortar.groups);
        Ok(self.mortar.vertices_under_pressure())
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
        self.contact.layers.visit(&mut self.field, |mut fields| {
            for planes in all(&mut fields) {
                planes.clear_upper();
            }
            mapping.run(&mut fields.common);
            for layer in &mut fields.layers {
                mapping.map(layer.body, &mut layer.planes);
            }
            settle_remapped(&mut fields.common, &still, &acting.driven);
            for layer in &mut fields.layers {
                settle_remapped(&mut layer.planes, &still, &acting.held);
            }
        });
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    pub(in crate::simulation) fn move_vertices(&mut self, drift: f64, half_step: f64) {
        let mut state = std::mem::take(&mut self.mortar);
        let hosts = self.hosts();
        state.plane.advance(&hosts, drift, half_step);
        state.space.advance(&hosts, drift, half_step);
        self.mortar = state;
    }
}
