//! Handles: the names by which a program addresses bodies.

/// A body of a scene, by its place among the bodies; the identifier that a scene file gives it is another number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyHandle(usize);

impl BodyHandle {
    /// Place among the bodies of the scene.
    #[must_use]
    pub fn place(self) -> usize {
        self.0
    }
}

impl From<usize> for BodyHandle {
    fn from(place: usize) -> Self {
        Self(place)
    }
}
