//! Memory estimate of a scene, made before anything is allocated.

use super::memory_budget::{expected, nodes, reached};
use crate::plan::{PlanOptions, plan};
use crate::values::Scene;
use proctor_kernel::grid::{GridShape, Line};

/// The memory estimate of a scene, made before anything is allocated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemoryEstimate {
    /// Particles of all bodies, from their volumes.
    pub particles: f64,
    /// Nodes, those around the mesh included.
    pub nodes: f64,
    /// Bytes that the particles need, and the nodes that they reach at the start.
    pub bytes: f64,
}

/// Counts what a scene that was checked asks for.
#[must_use]
pub fn estimate_memory(scene: &Scene) -> MemoryEstimate {
    let plan = plan(scene, PlanOptions::default());
    let shape = GridShape::new(&scene.mesh, scene.dimension);
    let bodies = expected(scene, &plan);
    MemoryEstimate {
        particles: bodies.iter().map(|(count, _)| count).sum(),
        nodes: nodes(&shape),
        bytes: reached(scene, &shape) * size_of::<Line>() as f64
            + bodies.iter().map(|(_, bytes)| bytes).sum::<f64>(),
    }
}
