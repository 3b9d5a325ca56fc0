//! Nodes in boxes that stand still.

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::model::CycleSettings;
use crate::simulation::context::{Condition, FieldNodes, NodalConditions};
use crate::simulation::step_view::StepView;
use crate::stage::solve::DrivenNode;
use std::sync::Arc;

struct HeldNodes(Arc<[DrivenNode]>);

/// Held nodes.
pub(super) const HELD_NODES: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = !settings.held_boxes.is_empty();
        list.choose(
            "stage",
            "held nodes",
            acts,
            "nodes in a box stand still",
            "no box is held",
        );
    },
    make: Some(of),
    planes: false,
};

fn of(settings: &CycleSettings, shape: &GridShape) -> Option<ConditionResult> {
    let nodes = nodes(settings, shape);
    (!nodes.is_empty()).then(|| Ok(Arc::new(HeldNodes(nodes.into())) as _))
}

impl Condition for HeldNodes {
    fn prescribe(&self, _: &StepView<'_>, nodal: &mut NodalConditions) {
        nodal.held = Arc::clone(&self.0);
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        field.drive(&self.0);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        field.drive(&self.0);
    }
}

/// Nodes that stand still, increasing, each once.
fn nodes(settings: &CycleSettings, shape: &GridShape) -> Vec<DrivenNode> {
    let mut nodes = vec![];
    for held in &settings.held_boxes {
        let along: [Vec<usize>; 3] = std::array::from_fn(|axis| {
            if axis < shape.axes {
                held.nodes_along(&settings.mesh, axis).collect()
            } else {
                vec![0]
            }
        });
        for &x in &along[0] {
            for &y in &along[1] {
                for &z in &along[2] {
                    nodes.push(shape.index(shape.mesh_node([x, y, z])));
                }
            }
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    nodes
        .into_iter()
        .map(|node| DrivenNode {
            node,
            before: [0.0; 3],
            after: [0.0; 3],
        })
        .collect()
}
