//! Laws of any type, and types of laws that scene files name.

use super::{Choice, Constant, Curve, Law, Rows, Strain};
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// A law of any type. Clones share it.
#[derive(Clone)]
pub struct AnyLaw(Arc<dyn Strain>);

impl<M: Law> From<M> for AnyLaw {
    fn from(law: M) -> Self {
        Self(Arc::new(law))
    }
}

impl Deref for AnyLaw {
    type Target = dyn Strain;

    fn deref(&self) -> &(dyn Strain + 'static) {
        &*self.0
    }
}

impl AnyLaw {
    /// Whether it is a fluid: its pressure follows from its volume, and no shear stress lasts.
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

/// A law that scene files name.
pub trait Readable: Law {
    /// The word of scene files.
    const NAME: &'static str;
    /// What it is for, in a few words.
    const MEANING: &'static str;
    /// Words that it may be given.
    const CHOICES: &'static [Choice] = &[];

    /// The law of these values of [`Law::CONSTANTS`] and of these words of [`Readable::CHOICES`], by number.
    fn read(values: &[f64], choices: &[usize]) -> Self;

    /// The same with rows of [`Law::CURVES`].
    #[must_use]
    fn with_curves(self, _curves: &[Rows]) -> Self
    where
        Self: Sized,
    {
        self
    }
}

/// A type of law, as it stands in a list.
#[derive(Clone, Copy, Debug)]
pub struct LawType {
    /// The word of scene files.
    pub name: &'static str,
    /// What it is for, in a few words.
    pub meaning: &'static str,
    /// Numbers that it needs.
    pub constants: &'static [Constant],
    /// Words that it may be given.
    pub choices: &'static [Choice],
    /// Curves that it may be given.
    pub curves: &'static [Curve],
    /// Makes one; see [`Readable::read`] and [`Readable::with_curves`].
    pub read: fn(&[f64], &[usize], &[Rows]) -> AnyLaw,
}

impl LawType {
    /// The kind of a type.
    #[must_use]
    pub const fn of<M: Readable>() -> Self {
        Self {
            name: M::NAME,
            meaning: M::MEANING,
            constants: M::CONSTANTS,
            choices: M::CHOICES,
            curves: M::CURVES,
            read: |values, choices, curves| M::read(values, choices).with_curves(curves).into(),
        }
    }
}
