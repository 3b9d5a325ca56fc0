//! Mortar contact between boundaries of bodies and rigid lines (2D).

use super::History;
use crate::mortar::boundary::Chain;
use crate::mortar::motion::Follow;
use crate::mortar::segments::Detection;

/// Everything that mortar contact adds to a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mortar {
    /// Boundaries of bodies.
    pub boundaries: Vec<BodyBoundary>,
    /// Rigid lines, which have no particles.
    pub lines: Vec<RigidLine>,
    /// Pairs.
    pub contacts: Vec<MortarContact>,
}

/// The boundary of a body: vertices without mass that follow it.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyBoundary {
    /// Identifier of the body.
    pub body: i64,
    /// Where the vertices are at the start.
    pub vertices: Vertices,
    /// How they follow.
    pub follow: Follow,
}

/// Vertices of a boundary.
#[derive(Clone, Debug, PartialEq)]
pub enum Vertices {
    /// Along the shape of the body, no further apart than this length \[m\].
    Spacing(f64),
    /// Given, in the coordinates of the scene.
    Given(Vec<Chain>),
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

/// A pair in mortar contact (Liang et al. 2024).
#[derive(Clone, Debug, PartialEq)]
pub struct MortarContact {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Identifier of the master, a body or a rigid line.
    pub master: i64,
    /// Identifier of the slave, a body or a rigid line. Gaps and pressures belong to its vertices; take the smooth or
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
