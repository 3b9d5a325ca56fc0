//! The boundary planes of the mesh, free of stress, sliding, fixed or antisymmetric.
//!
//! What lies beyond them is known to the mapping too, which folds it back ([`Planes::fold`](crate::stage::solve::Planes)).

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::model::{CycleSettings, PlaneCondition};
use crate::simulation::context::{Condition, FieldNodes, NodalConditions, Remap};
use crate::simulation::step_view::StepView;
use crate::stage::solve::Wall;
use std::sync::Arc;

/// The planes that are not free.
struct Walls(Vec<Wall>);

/// Boundary planes.
pub(super) const PLANES: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        for (axis, letter) in ["X", "Y", "Z"]
            .iter()
            .enumerate()
            .take(settings.dimension.axes())
        {
            for (side, end) in ["0", "n"].iter().enumerate() {
                let condition = settings.mesh.planes[axis][side];
                let base = settings.base_motion.as_ref();
                let moving = base.is_some_and(|b| b.axis == axis && b.side == side);
                let acts = moving || condition != PlaneCondition::Free;
                let why = if moving {
                    "its velocity is prescribed"
                } else {
                    condition.word()
                };
                list.choose("stage", &format!("plane {letter}{end}"), acts, why, "free");
            }
        }
    },
    make: Some(of),
    planes: true,
};

fn of(settings: &CycleSettings, shape: &GridShape) -> Option<ConditionResult> {
    let mut walls = vec![];
    for axis in 0..shape.axes {
        for side in 0..2 {
            let condition = settings.mesh.planes[axis][side];
            if condition != PlaneCondition::Free {
                walls.push(Wall {
                    axis,
                    side,
                    prescribed: condition.prescribed(axis),
                    extrapolates: condition == PlaneCondition::Absorbing,
                    before: [0.0; 3],
                    after: [0.0; 3],
                });
            }
        }
    }
    let act = !walls.is_empty() || settings.base_motion.is_some();
    act.then(|| Ok(Arc::new(Walls(walls)) as _))
}

impl Condition for Walls {
    fn prescribe(&self, _: &StepView<'_>, nodal: &mut NodalConditions) {
        nodal.walls.extend(self.0.iter().copied());
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        let (planes, context, sums) = field.parts();
        planes.add_power_of_walls(&context.walls, context.nodal.kick, sums);
        planes.constrain(&context.walls, true);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        let (planes, context, _) = field.parts();
        match context.remap {
            Some(Remap::OldPositions) => planes.constrain_remapped(&context.walls),
            _ => planes.constrain(&context.walls, false),
        }
    }
}
