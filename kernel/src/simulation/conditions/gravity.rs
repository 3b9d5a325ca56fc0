//! Gravity: a number of the acceleration.

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::scene::{Scene, Vector};
use crate::simulation::context::{Condition, NodalConditions};
use crate::simulation::step_view::StepView;
use std::sync::Arc;

struct Gravity(Vector);

/// Gravity.
pub(super) const GRAVITY: ConditionType = ConditionType {
    plan_entries: |scene, list| {
        let acts = scene.gravity != [0.0; 3];
        list.choose("stage", "gravity", acts, "it is not zero", "it is zero");
    },
    make: Some(of),
    planes: false,
};

fn of(scene: &Scene, _: &GridShape) -> Option<ConditionResult> {
    let acts = scene.gravity != [0.0; 3];
    acts.then(|| Ok(Arc::new(Gravity(scene.gravity)) as _))
}

impl Condition for Gravity {
    fn prescribe(&self, _: &StepView<'_>, nodal: &mut NodalConditions) {
        nodal.gravity = self.0;
    }
}
