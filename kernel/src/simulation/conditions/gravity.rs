//! Gravity: a number of the acceleration.

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::model::{CycleSettings, Vector};
use crate::simulation::context::{Condition, NodalConditions};
use crate::simulation::step_view::StepView;
use std::sync::Arc;

struct Gravity(Vector);

/// Gravity.
pub(super) const GRAVITY: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = settings.gravity != [0.0; 3];
        list.choose("stage", "gravity", acts, "it is not zero", "it is zero");
    },
    make: Some(of),
    planes: false,
};

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    let acts = settings.gravity != [0.0; 3];
    acts.then(|| Ok(Arc::new(Gravity(settings.gravity)) as _))
}

impl Condition for Gravity {
    fn prescribe(&self, _: &StepView<'_>, nodal: &mut NodalConditions) {
        nodal.gravity = self.0;
    }
}
