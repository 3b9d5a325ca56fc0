//! Handles: the names by which a program addresses contacts, rigid surfaces and boundaries.

use proctor_kernel::simulation::{BodyHandle, Cycle};

/// A contact on the grid or by mortar, by its identifier in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContactHandle(i64);

impl ContactHandle {
    /// Identifier in the scene.
    #[must_use]
    pub fn id(self) -> i64 {
        self.0
    }
}

impl From<i64> for ContactHandle {
    fn from(id: i64) -> Self {
        Self(id)
    }
}

/// A rigid surface, by its place in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SurfaceHandle(usize);

impl SurfaceHandle {
    /// Place among the rigid surfaces of the scene.
    #[must_use]
    pub fn place(self) -> usize {
        self.0
    }
}

impl From<usize> for SurfaceHandle {
    fn from(place: usize) -> Self {
        Self(place)
    }
}

/// A boundary of mortar contact: that of a body, or a rigid line or surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BoundaryHandle {
    /// The boundary of a body.
    Body(BodyHandle),
    /// The boundary with this identifier: that of a body, a rigid line or a rigid surface.
    Id(i64),
}

impl BoundaryHandle {
    /// Identifier in the scene.
    #[must_use]
    pub fn id(self, cycle: &Cycle) -> i64 {
        match self {
            Self::Body(body) => cycle.body(body).id,
            Self::Id(id) => id,
        }
    }
}

impl From<BodyHandle> for BoundaryHandle {
    fn from(body: BodyHandle) -> Self {
        Self::Body(body)
    }
}

impl From<i64> for BoundaryHandle {
    fn from(id: i64) -> Self {
        Self::Id(id)
    }
}
