//! Rigid surfaces.

use crate::geometry::surface::Surface;
use proctor_kernel::model::History;
use std::sync::Arc;

/// A rigid surface that bodies touch from the side to which its normals point.
#[derive(Clone, Debug)]
pub struct RigidSurface {
    /// Name for messages; for a file, the file as the scene names it.
    pub name: String,
    /// The triangles, in the coordinates of the scene at the start.
    pub surface: Arc<Surface>,
    /// Coefficient of Coulomb friction, 0 or greater.
    pub friction: f64,
    /// Gap between a particle and the surface below which contact is looked for, and at the same time the longest
    /// way that a particle may approach the surface in one step \[m\].
    pub distance_threshold: f64,
    /// Stiffness of a force that pushes a particle out again, per particle and per metre of its penetration
    /// \[N/m\]. In one step it pushes no further than out, however stiff it is.
    pub penalty_stiffness: Option<f64>,
    /// Prescribed velocity \[m/s\], a translation; `None` where the surface stands.
    pub motion: Option<History>,
}

impl RigidSurface {
    /// True where a motion is prescribed that is not rest.
    #[must_use]
    pub fn moves(&self) -> bool {
        let motion = self.motion.as_ref();
        motion.is_some_and(|motion| !motion.is_zero())
    }
}
