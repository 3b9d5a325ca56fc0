//! The nodes as a frame.

use super::frames::FramePart;
use crate::output::{Array, ArrayData, Frame};
use proctor_scene::NodalField;
use proctor_scene::simulation::{NodeValues, Simulation};

/// The fields of the nodes with mass of this process that the scene asks for, as the last step left them; no nodes before the
/// first.
pub(super) fn frame(simulation: &Simulation) -> FramePart {
    let nodes = simulation.node_values();
    let mut fields = simulation.scene().results.nodal_fields.clone();
    fields.sort_unstable();
    fields.dedup();
    FramePart {
        // Field by field: the common one, then those of bodies in order of the identifier; each in order of the nodes.
        places: nodes
            .iter()
            .map(|n| {
                let [kind, body] = n
                    .body
                    .map_or([0, 0], |id| [1, id.cast_unsigned() ^ (1 << 63)]);
                [kind, body, n.node as u64]
            })
            .collect(),
        frame: Frame {
            time: simulation.time(),
            step: simulation.steps(),
            points: nodes.iter().map(|n| n.position).collect(),
            arrays: fields.into_iter().map(|f| array(&nodes, f)).collect(),
            lines: vec![],
        },
    }
}

fn array(nodes: &[NodeValues], field: NodalField) -> Array {
    let scalar = |of: fn(&NodeValues) -> f64| ArrayData::Scalar(nodes.iter().map(of).collect());
    let vector =
        |of: fn(&NodeValues) -> [f64; 3]| ArrayData::Vector(nodes.iter().map(of).collect());
    match field {
        NodalField::Mass => Array::new("Mass", scalar(|n| n.mass)),
        NodalField::Velocity => Array::new("Velocity", vector(|n| n.velocity)),
        NodalField::Body => Array::new(
            "Body Id",
            ArrayData::Integer(nodes.iter().map(|n| n.body.unwrap_or(i64::MIN)).collect()),
        ),
        NodalField::ContactForce => Array::new("Contact Force", vector(|n| n.contact_force)),
        NodalField::ContactGap => Array::new("Contact Gap", scalar(|n| n.contact_gap)),
    }
}
