//! Mortar contact between boundaries of bodies and rigid lines (2D) or surfaces (3D).

use crate::geometry::mortar::boundary::Chain;
use crate::geometry::mortar::motion::FollowMode;
use crate::geometry::mortar::points::Detection;
use crate::geometry::surface::Surface;
use proctor_kernel::model::History;
use std::sync::Arc;

/// Everything that mortar contact adds to a scene.
#[derive(Clone, Debug, Default)]
pub struct Mortar {
    /// Boundaries of bodies.
    pub boundaries: Vec<BodyBoundary>,
    /// Rigid lines, which have no particles (2D).
    pub lines: Vec<RigidLine>,
    /// Rigid surfaces, which have no particles (3D).
    pub facets: Vec<RigidFacets>,
    /// Pairs.
    pub contacts: Vec<MortarContact>,
}

/// The boundary of a body: vertices without mass that follow it.
#[derive(Clone, Debug)]
pub struct BodyBoundary {
    /// Identifier of the body.
    pub body: i64,
    /// Vertices at the start.
    pub vertices: Vertices,
    /// The way in which they follow.
    pub follow: FollowMode,
}

/// Vertices of a boundary. In three dimensions triangles that lie in planes of the mesh that are not free are left out:
/// nothing can touch them.
#[derive(Clone, Debug)]
pub enum Vertices {
    /// Vertices on the shape of the body, no further apart than this length \[m\].
    Spacing(f64),
    /// Polylines, in the coordinates of the scene (2D).
    Given(Vec<Chain>),
    /// Triangles around the body, in the coordinates of the scene (3D).
    Surface(Arc<Surface>),
}

/// A rigid polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidLine {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier; no body may have it.
    pub id: i64,
    /// Vertices at the start, in the coordinates of the scene; the material is on the left.
    pub chains: Vec<Chain>,
    /// Prescribed velocity; at rest without.
    pub motion: Option<History>,
}

/// A rigid surface of triangles in mortar contact.
#[derive(Clone, Debug)]
pub struct RigidFacets {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier; no body may have it.
    pub id: i64,
    /// The triangles at the start, in the coordinates of the scene; bodies touch the side to which their normals point.
    pub surface: Arc<Surface>,
    /// Prescribed velocity, a translation; at rest without.
    pub motion: Option<History>,
}

/// A pair in mortar contact (Liang et al. 2024).
#[derive(Clone, Debug, PartialEq)]
pub struct MortarContact {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Identifier of the master, a body, a rigid line or a rigid surface.
    pub master: i64,
    /// Identifier of the slave, a body, a rigid line or a rigid surface. Gaps and pressures belong to its vertices; take the smooth or
    /// the finer one.
    pub slave: i64,
    /// Coefficient of Coulomb friction, 0 or greater.
    pub friction: f64,
    /// Gap at which contact begins, g_c \[m\].
    pub critical_gap: f64,
    /// Stiffness of the normal law, kappa \[Pa/m\].
    pub normal_stiffness: f64,
    /// Stiffness of the tangential spring, kappa_t \[Pa/m\]; used with friction only.
    pub tangential_stiffness: f64,
    /// Barrier or penalty.
    pub enforcement: Enforcement,
    /// Mortar segments, or the slave's vertices one by one.
    pub detection: Detection,
}

/// Enforcement of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Enforcement {
    /// Barrier below the critical gap.
    #[default]
    Barrier,
    /// Pressure proportional to penetration.
    Penalty,
}
