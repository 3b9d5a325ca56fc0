//! The boundaries of mortar contact as a frame.

use crate::output::{Array, ArrayData, Frame};
use proctor_scene::simulation::{BoundaryMesh, BoundaryVertex, Simulation};

/// The vertices of all boundaries and rigid lines, joined by their segments. What contact does to them is that of the
/// last step, found where they were at its beginning.
pub(super) fn frame(simulation: &Simulation) -> Frame {
    let BoundaryMesh { vertices, edges } = simulation.boundaries();
    let scalar =
        |of: fn(&BoundaryVertex) -> f64| ArrayData::Scalar(vertices.iter().map(of).collect());
    let integer =
        |of: fn(&BoundaryVertex) -> i64| ArrayData::Integer(vertices.iter().map(of).collect());
    let vector =
        |of: fn(&BoundaryVertex) -> [f64; 3]| ArrayData::Vector(vertices.iter().map(of).collect());
    Frame {
        time: simulation.time(),
        step: simulation.steps(),
        points: vertices.iter().map(|v| v.position).collect(),
        arrays: vec![
            Array::new("Body Id", integer(|v| v.id)),
            Array::new("Vertex Id", integer(|v| v.vertex)),
            Array::new("Displacement", vector(|v| v.displacement)),
            Array::new("Contact Pressure", scalar(|v| v.pressure)),
            Array::new("Contact Gap", scalar(|v| v.gap)),
            Array::new("Contact Traction", vector(|v| v.traction)),
            Array::new("Contact Force", vector(|v| v.force)),
        ],
        lines: edges.iter().map(|edge| edge.map(|k| k as i64)).collect(),
    }
}
