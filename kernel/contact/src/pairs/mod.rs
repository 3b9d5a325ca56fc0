//! Slave-master contact on the grid (contact manual v0.1, section 1).
//!
//! Each body that is near a partner has a velocity field of its own. Bodies that are not stay in that of the phase, as in
//! a scene without contact.
//!
//! - [`broad`]: which pairs are near, at each sort, by boxes of nodes.
//! - [`interface`]: the particles that partners can share a node with; no other is asked for normals and distances.
//! - [`surface`]: normals from mass gradients, and the distance of the bodies along them.
//! - [`separation`]: the plane that separates the particles of two bodies, where their gradients disagree.
//! - [`overlap`]: bodies that overlap at the start.
//! - [`coulomb`]: impulses at one node: impenetrability and Coulomb friction, for any number of bodies.
//!
//! Read as in the manual but for two points. The distance is measured along the normal of the pair, which carries the
//! impulse, between the particles that reach farthest along it near the node; the particles nearest to the node, as
//! printed, lie in the second layer of a body where its surface runs through the middle of a cell. And where the mass
//! gradients of a pair are not opposite, the normal is that of the plane that separates its particles, unless that of the
//! gradients separates them as well ([`separation`]).
//!
//! **Bodies without a pair** share one velocity where they share a node, as in MPM without contact, also where one
//! or both of them have a field of their own. **Three and more bodies at a node**: bodies without a pair are joined
//! first; between what remains the impulses of all pairs act at once and are iterated until none changes
//! ([`coulomb`]). Both are formed in order of the identifiers of the bodies, whatever the order in the scene.

use crate::values::ContactNormal;
use proctor_kernel::model::Vector;

pub mod broad;
pub mod coulomb;
pub mod interface;
pub mod overlap;
pub mod separation;
pub mod surface;
mod tunnelling;

pub use tunnelling::Tunnelling;

/// A pair of bodies in contact, as the cycle sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Identifier of the contact in the scene.
    pub id: i64,
    /// Index of the master body.
    pub master: usize,
    /// Index of the slave body.
    pub slave: usize,
    /// Coefficient of friction.
    pub friction: f64,
    /// Choice of the normal.
    pub normal: ContactNormal,
    /// Distance of particles at which the bodies touch, for a normal along each axis \[m\].
    pub distance: Vector,
    /// True if that distance is a condition for contact.
    pub corrects_distance: bool,
    /// True if one of the bodies is driven and its shape known: then that shape acts, not the nodes where both bodies are.
    pub by_shape: bool,
    /// No contact is given for the two, so that the driven body holds what touches it.
    pub bonded: bool,
}

impl Pair {
    /// Distance of particles at which the bodies touch, for a normal \[m\]: an ellipsoid through the values along
    /// the axes.
    #[must_use]
    pub fn distance_along(&self, normal: &Vector) -> f64 {
        (0..3)
            .map(|axis| (normal[axis] * self.distance[axis]).powi(2))
            .sum::<f64>()
            .sqrt()
    }
}
