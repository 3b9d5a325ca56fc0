//! Laws of any type.

use super::{Law, Strain};
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// A law of any type. Clones share it.
#[derive(Clone)]
pub struct AnyLaw(Arc<dyn Strain>);

impl<M: Law> From<M> for AnyLaw {
    fn from(law: M) -> Self {
        law.into_any()
    }
}

impl Deref for AnyLaw {
    type Target = dyn Strain;

    fn deref(&self) -> &(dyn Strain + 'static) {
        &*self.0
    }
}

impl AnyLaw {
    /// A law of a type. Its stages are compiled where this stands: see [`Law::into_any`].
    pub fn new<M: Law>(law: M) -> Self {
        Self(Arc::new(law))
    }

    /// True for a fluid: its pressure follows from its volume, and no shear stress lasts.
    #[must_use]
    pub fn is_fluid(&self) -> bool {
        self.initial_volume_ratio(-self.young()) != 1.0
    }

    /// The same where strain gathers in a band that is narrower than a cell of this size \[m\]: see [`Law::in_cells`].
    #[must_use]
    pub fn in_cells(&self, cell: f64) -> Option<Self> {
        self.0.in_cells(cell).map(Self)
    }

    /// The law of bodies with a pressure at the start: see [`Law::pressed`].
    #[must_use]
    pub fn pressed(&self) -> Option<Self> {
        self.0.pressed().map(Self)
    }

    /// Velocity that strains particles.
    pub(super) fn into_strain(self) -> Arc<dyn Strain> {
        self.0
    }

    /// The law itself, if it is one of this type.
    #[must_use]
    pub fn downcast<M: Law>(&self) -> Option<&M> {
        let law: &dyn std::any::Any = &*self.0;
        law.downcast_ref()
    }
}

impl fmt::Debug for AnyLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl PartialEq for AnyLaw {
    fn eq(&self, other: &Self) -> bool {
        self.0.equals(&*other.0)
    }
}
