//! Damping. Local damping is a number of the acceleration; viscous damping acts while forces are mapped (`stage/p2g`), and
//! only what it takes is summed here; of kinetic damping only the plan speaks.

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::model::{CycleSettings, Damping};
use crate::simulation::context::{Condition, FieldNodes, NodalConditions};
use crate::simulation::step_view::StepView;
use std::sync::Arc;

struct LocalDamping(f64);

struct ViscousDamping;

const NOT_ZERO: &str = "its factor is not zero";
const ZERO: &str = "not asked for, or its factor is zero";

/// Kinetic damping, which acts on all particles at once (`relaxation.rs`).
pub(super) const KINETIC_DAMPING: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = settings.damping == Damping::Kinetic;
        let why = "asked for: velocities are set to zero at each peak of kinetic energy";
        list.choose("stage", "kinetic damping", acts, why, "not asked for");
    },
    make: None,
    planes: false,
};

/// Viscous damping, which acts while forces are mapped (`stage/p2g`).
pub(super) const VISCOUS_DAMPING: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = matches!(settings.damping, Damping::Viscous { alpha } if alpha != 0.0);
        list.choose("stage", "viscous damping", acts, NOT_ZERO, ZERO);
    },
    make: Some(|settings, _| {
        let acts = matches!(settings.damping, Damping::Viscous { alpha } if alpha != 0.0);
        acts.then(|| Ok(Arc::new(ViscousDamping) as _))
    }),
    planes: false,
};

/// Local damping.
pub(super) const LOCAL_DAMPING: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = matches!(settings.damping, Damping::Local { alpha } if alpha != 0.0);
        list.choose("stage", "local damping", acts, NOT_ZERO, ZERO);
    },
    make: Some(of),
    planes: false,
};

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    match settings.damping {
        Damping::Local { alpha } if alpha != 0.0 => Some(Ok(Arc::new(LocalDamping(alpha)))),
        _ => None,
    }
}

impl Condition for ViscousDamping {
    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        if let Some(rate) = field.context.mapping.viscous_rate(field.owner()) {
            let (planes, context, sums) = field.parts();
            planes.add_viscous(rate, context.nodal.kick, &context.walls, sums);
        }
    }
}

impl Condition for LocalDamping {
    fn prescribe(&self, _: &StepView<'_>, nodal: &mut NodalConditions) {
        nodal.local_damping = Some(self.0);
    }
}
