//! A base that moves one plane of the mesh, and the mesh with it along the normal of that plane.

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::model::{CycleSettings, PlaneCondition, Vector};
use crate::simulation::Cycle;
use crate::simulation::context::{Condition, NodalConditions};
use crate::simulation::step_view::StepView;
use crate::simulation::values::{Event, EventKind, StepInfo};
use crate::stage::solve::Wall;
use std::sync::Arc;

/// The plane that moves.
struct MovingBase {
    axis: usize,
    side: usize,
}

/// A moving base.
pub(super) const MOVING_BASE: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = settings.base_motion.is_some();
        list.choose(
            "stage",
            "base motion",
            acts,
            "a record moves a plane, and the mesh with it along its normal",
            "no active record",
        );
    },
    make: Some(of),
    planes: true,
};

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    let base = settings.base_motion.as_ref()?;
    Some(Ok(Arc::new(MovingBase {
        axis: base.axis,
        side: base.side,
    })))
}

impl Condition for MovingBase {
    /// The plane is fixed to the base; the others move with the mesh.
    fn prescribe(&self, view: &StepView<'_>, nodal: &mut NodalConditions) {
        let Some(base) = view.base else {
            return;
        };
        let [before, after] = nodal.half_steps.map(|time| base.at(time));
        for wall in &mut nodal.walls {
            wall.before = mesh_part(view.settings, before);
            wall.after = mesh_part(view.settings, after);
        }
        let own = Wall {
            axis: self.axis,
            side: self.side,
            prescribed: PlaneCondition::Fixed.prescribed(self.axis),
            extrapolates: false,
            before,
            after,
        };
        let place = |wall: &Wall| (wall.axis, wall.side);
        match nodal.walls.binary_search_by_key(&place(&own), place) {
            Ok(at) => nodal.walls[at] = own,
            Err(at) => nodal.walls.insert(at, own),
        }
    }
}

impl Cycle {
    /// Velocity of the mesh in the middle of the step \[m/s\].
    pub(in crate::simulation) fn mesh_velocity(&self, info: &StepInfo) -> Vector {
        let middle = self.state.clock.time + 0.5 * info.dt;
        let base = self.model.base.as_ref();
        base.map_or([0.0; 3], |base| {
            mesh_part(&self.model.settings, base.at(middle))
        })
    }

    /// Notes the end of a record of the base, if it lies in this step.
    pub(in crate::simulation) fn note_end_of_record(&mut self, info: &StepInfo) {
        if let Some(base) = &self.model.base
            && self.state.clock.time < base.end()
            && info.time >= base.end()
        {
            self.state.events.push(Event {
                step: info.step,
                time: info.time,
                kind: EventKind::RecordEnded,
            });
        }
    }
}

/// The part of a velocity of the base that the mesh takes part in: that along the normal of the base, so that
/// the base stays on its plane of nodes however far it moves, and the plane opposite moves with it.
fn mesh_part(settings: &CycleSettings, v: Vector) -> Vector {
    let normal = settings.base_motion.as_ref().map(|base| base.axis);
    std::array::from_fn(|axis| if Some(axis) == normal { v[axis] } else { 0.0 })
}
