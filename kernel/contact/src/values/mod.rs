//! Contacts of a model, as checked values.

mod contact;
mod handle;
mod mortar;
mod surface;

pub use contact::{Contact, ContactNormal};
pub use handle::{BoundaryHandle, ContactHandle, SurfaceHandle};
pub use mortar::{
    BodyBoundary, Enforcement, Mortar, MortarContact, RigidFacets, RigidLine, Vertices,
};
pub use surface::RigidSurface;

use proctor_kernel::model::{History, Shape};

/// All contacts of a model.
#[derive(Clone, Debug, Default)]
pub struct ContactValues {
    /// Pairs of bodies in contact on the grid.
    pub contacts: Vec<Contact>,
    /// Distance at which pairs touch \[cells\]: see [`PairValues::distance`].
    pub distance: Option<f64>,
    /// Mortar contact, with the boundaries and rigid lines that it needs.
    pub mortar: Mortar,
    /// Rigid surfaces.
    pub surfaces: Vec<RigidSurface>,
}

impl ContactValues {
    /// Values of contact on the grid.
    #[must_use]
    pub fn pairs(&self) -> PairValues {
        let mortar = self.mortar.contacts.iter();
        PairValues {
            contacts: self.contacts.clone(),
            distance: self.distance,
            in_mortar: mortar.map(|c| [c.master, c.slave]).collect(),
        }
    }
}

/// Pairs of bodies in contact on the grid.
#[derive(Clone, Debug, Default)]
pub struct PairValues {
    /// The pairs.
    pub contacts: Vec<Contact>,
    /// Distance at which pairs touch \[cells\]; 0 for any. `None`: the sum of the half-lengths of the particles of both bodies.
    pub distance: Option<f64>,
    /// Identifiers of the two ends of each mortar contact.
    pub in_mortar: Vec<[i64; 2]>,
}

/// A body of a model before it is filled with particles, for the words of a plan.
#[derive(Clone, Copy, Debug)]
pub struct PlannedBody<'a> {
    /// Identifier.
    pub id: i64,
    /// Shape.
    pub shape: &'a Shape,
    /// Prescribed velocity, where there is one.
    pub motion: Option<&'a History>,
}
