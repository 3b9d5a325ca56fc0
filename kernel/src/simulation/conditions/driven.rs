//! Bodies that move as prescribed.
//!
//! In the common field they take all nodes along that their particles reach. One with a velocity field of its own has no
//! equation of motion there: its nodes move as it does.

use super::{ConditionResult, ConditionType};
use crate::fields::Owner;
use crate::grid::GridShape;
use crate::layout::Layout;
use crate::model::CycleSettings;
use crate::particles::ParticleSet;
use crate::simulation::context::{Condition, FieldNodes, NodalConditions};
use crate::simulation::mapping::node_weights;
use crate::simulation::monitor::measure::kinetic_energy_of;
use crate::simulation::step_view::StepView;
use crate::simulation::values::{BodyRun, StepError, StepInfo};
use crate::simulation::{Cycle, history_value};
use crate::stage::g2p::FaultKind;
use crate::stage::solve::DrivenNode;
use std::sync::Arc;

struct DrivenBodies;

/// Driven bodies.
pub(super) const DRIVEN_BODIES: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = settings.drives_bodies;
        list.choose(
            "stage",
            "driven bodies",
            acts,
            "a body has a prescribed velocity",
            "no body has a prescribed velocity",
        );
    },
    make: Some(of),
    planes: false,
};

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    settings
        .drives_bodies
        .then(|| Ok(Arc::new(DrivenBodies) as _))
}

impl Condition for DrivenBodies {
    /// Where two driven bodies share a node the later body decides, whatever the order of particles, and a held node
    /// stands still.
    fn prescribe(&self, view: &StepView<'_>, nodal: &mut NodalConditions) {
        let (mut driven, mut nodes) = (
            std::mem::take(&mut nodal.driven),
            std::mem::take(&mut nodal.nodes),
        );
        let mut bodies = 0;
        let (sets, grid) = (view.particles, view.grid);
        for (index, body) in view.bodies.iter().enumerate() {
            if let (Some(motion), false) = (&body.motion, grid.own_field(index).is_some()) {
                let [before, after] = nodal.half_steps.map(|t| history_value(motion, t));
                nodes_of(&sets[index], body, &grid.shape, view.stencil, &mut nodes);
                if bodies > 0 {
                    driven.retain(|d| nodes.binary_search(&d.node).is_err());
                }
                bodies += 1;
                driven.extend(nodes.iter().map(|&node| DrivenNode {
                    node,
                    before,
                    after,
                }));
            }
        }
        if bodies > 1 {
            driven.sort_unstable_by_key(|d| d.node);
        }
        if !nodal.held.is_empty() {
            let is_held = |d: &DrivenNode| nodal.held.binary_search_by_key(&d.node, |h| h.node);
            driven.retain(|d| is_held(d).is_err());
        }
        (nodal.driven, nodal.nodes) = (driven, nodes);
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        self.remap(field);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        if field.owner() == Owner::Phase {
            let context = field.context;
            field.drive(&context.nodal.driven);
        }
    }
}

impl Cycle {
    /// Bodies with a prescribed velocity move by it. Who moves them does the work that speeds them up, and bears their
    /// weight.
    pub(in crate::simulation) fn move_driven_bodies(
        &mut self,
        info: &StepInfo,
        mesh_shift: &[f64; 3],
    ) -> Result<(), StepError> {
        let half = self.state.clock.time + 0.5 * info.dt;
        let mesh = self.model.settings.mesh.clone();
        let (mut travel, mut work) = (0.0_f64, 0.0);
        let mut faults: Vec<(usize, usize, FaultKind)> = vec![];
        for index in 0..self.state.sets.len() {
            let Some(motion) = &self.model.bodies[index].motion else {
                continue;
            };
            let v = history_value(motion, half);
            let axes = self.state.sets[index].layout.axes;
            let [before, loads @ ..] = self.kinetic_energy_and_loads(index);
            let set = &mut self.state.sets[index];
            for axis in 0..axes {
                work -= loads[axis] * v[axis] * info.dt;
                let shift = v[axis] * info.dt - mesh_shift[axis];
                let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
                for (p, x) in set.columns[Layout::POSITION + axis].iter_mut().enumerate() {
                    *x += shift;
                    let inside = (0.0..=extent).contains(x);
                    if !inside && faults.last().is_none_or(|&(i, ..)| i != index) {
                        faults.push((index, p, FaultKind::Outside));
                    }
                }
                set.columns[Layout::velocity(axes) + axis].fill(v[axis]);
                travel = travel.max((shift / mesh.cell[axis]).abs());
            }
            let [after, ..] = self.kinetic_energy_and_loads(index);
            work += after - before;
        }
        self.state.ledger.external_work += work;
        self.state.travel += travel;
        self.judge_together(&faults)
    }

    /// Kinetic energy of a body \[J\], and its dead load along each axis \[N\].
    fn kinetic_energy_and_loads(&self, index: usize) -> [f64; 4] {
        let gravity = self.model.settings.gravity;
        let of_body = |other: usize| other == index;
        let [kinetic, mass, forces @ ..] = self.sums_by_body(of_body, |index, p| {
            let set = &self.state.sets[index];
            let force = set.layout.force;
            let [x, y, z] = force.map_or([0.0; 3], |first| set.vector(first, p));
            [
                kinetic_energy_of(set, p),
                set.columns[Layout::MASS][p],
                x,
                y,
                z,
            ]
        });
        let [x, y, z] = std::array::from_fn(|axis| gravity[axis] * mass + forces[axis]);
        [kinetic, x, y, z]
    }
}

/// Nodes that any particle of a driven body reaches by more than round-off, each once, increasing, in place of those before.
fn nodes_of(
    set: &ParticleSet,
    body: &BodyRun,
    shape: &GridShape,
    stencil: usize,
    nodes: &mut Vec<usize>,
) {
    nodes.clear();
    for p in 0..set.len() {
        nodes.extend(
            node_weights(set, body, shape, stencil, p)
                .iter()
                .map(|(node, _)| node),
        );
    }
    nodes.sort_unstable();
    nodes.dedup();
}
