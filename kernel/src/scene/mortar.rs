//! Mortar contact between boundaries of bodies and rigid lines (2D) or surfaces (3D).

use super::{Body, History, Scene};
use crate::mortar::boundary::Chain;
use crate::mortar::motion::FollowMode;
use crate::mortar::points::Detection;
use crate::surface::Surface;
use std::f64::consts::PI;
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
    /// Where the vertices are at the start.
    pub vertices: Vertices,
    /// How they follow.
    pub follow: FollowMode,
}

/// Vertices of a boundary. In three dimensions triangles that lie in planes of the mesh that are not free are left out:
/// nothing can touch them.
#[derive(Clone, Debug)]
pub enum Vertices {
    /// On the shape of the body, no further apart than this length \[m\].
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

/// How contact is enforced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Enforcement {
    /// Barrier below the critical gap.
    #[default]
    Barrier,
    /// Pressure proportional to penetration.
    Penalty,
}

/// Largest part of its way by which a round body may lag behind it with the default of the tangential stiffness.
pub const MOST_CREEP: f64 = 5e-3;

impl Scene {
    /// By how much the tangential spring of a mortar contact lets a round body lag behind the way that it rolls, over the
    /// way, at most; `None` where none of its bodies is round and free to move.
    ///
    /// Traction grows by kappa_t xi over the contact of 2 b, so that a force of 2 b² kappa_t xi creeps by xi. Hertz gives
    /// b² = 4 N R/(pi E*), friction is mu N at most, and E* no more than 4 E/3: xi <= pi mu E/(6 R kappa_t).
    #[must_use]
    pub fn rolling_creep(&self, contact: &MortarContact) -> Option<f64> {
        let round = self.ends(contact).filter_map(|body| {
            let young = self.materials.get(body.material)?.law.young();
            Some(young / body.shape.radius()?)
        });
        let stiffest = round.max_by(f64::total_cmp)?;
        Some(creep(contact.friction, stiffest) / contact.tangential_stiffness)
    }

    /// The tangential stiffness with which round bodies as large as those of a contact creep by no more than [`MOST_CREEP`]
    /// \[Pa/m\]; `None` where none of its bodies is free to move.
    #[must_use]
    pub fn usual_tangential_stiffness(&self, contact: &MortarContact) -> Option<f64> {
        let bodies = self.ends(contact).filter_map(|body| {
            let young = self.materials.get(body.material)?.law.young();
            Some(young / body.shape.half_size(self.dimension))
        });
        let stiffest = bodies.max_by(f64::total_cmp)?;
        Some(creep(contact.friction, stiffest) / MOST_CREEP)
    }

    /// Young's modulus of the softest body of a mortar contact \[Pa\]; `None` where none of its bodies is free to move.
    #[must_use]
    pub fn softest(&self, contact: &MortarContact) -> Option<f64> {
        let young = |body: &Body| Some(self.materials.get(body.material)?.law.young());
        self.ends(contact).filter_map(young).min_by(f64::total_cmp)
    }

    /// The bodies of a contact that are free to move.
    fn ends(&self, contact: &MortarContact) -> impl Iterator<Item = &Body> {
        let ends = [contact.master, contact.slave];
        let bodies = self.bodies.iter();
        bodies.filter(move |body| ends.contains(&body.id) && body.motion.is_none())
    }
}

/// Creep times tangential stiffness \[Pa/m\] of friction and Young's modulus over radius \[Pa/m\].
fn creep(friction: f64, young_over_radius: f64) -> f64 {
    PI / 6.0 * friction * young_over_radius
}
