//! Bodies and their shapes.

use crate::values::InitialStress;
use proctor_kernel::model::{History, Shape, Vector};

/// A body: one material, one set of particles.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Index into [`Scene::materials`](super::Scene::materials).
    pub material: usize,
    /// Shape.
    pub shape: Shape,
    /// Particles per cell and axis; the third is 1 in two dimensions.
    pub particles_per_cell: [usize; 3],
    /// Initial velocity \[m/s\].
    pub velocity: Vector,
    /// Prescribed velocity: the body moves so whatever acts on it.
    pub motion: Option<History>,
    /// Stress at the start.
    pub initial_stress: InitialStress,
}

impl Body {
    /// Most particles per cell and axis. More than a few tell nothing that smaller cells would not tell better.
    pub const MOST_PARTICLES: usize = 100;
}
