//! Contact between bodies.

/// A pair of bodies that may touch, slide and part (contact manual, section 1).
///
/// Two bodies without a pair stick where they share a node, as in MPM without contact.
///
/// A body whose motion is prescribed from the start acts with its shape: on particles of the partner, at the points where
/// they touch it, and along the normal of the shape. One that is filled from a list of particles has none, and acts at the
/// nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Coefficient of Coulomb friction, 0 or greater; infinity for contact that never slips.
    pub friction: f64,
    /// Identifier of the master body.
    pub master: i64,
    /// Identifier of the slave body.
    pub slave: i64,
    /// Choice of the normal.
    pub normal: ContactNormal,
}

/// Normal of a pair at a node, from the gradient of the nodal mass of its bodies; of a driven body its shape has the normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactNormal {
    /// Outward normal of the master, for a master that is stiffer, flat or convex (contact manual, eq. 4).
    Master,
    /// Inward normal of the slave.
    Slave,
    /// Mean of the two (contact manual, eq. 3).
    Collinear,
}
