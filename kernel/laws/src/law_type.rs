//! Types of laws that scene files name.

use proctor_kernel::laws::{AnyLaw, Constant, Curve, Law, Rows};

/// One of several words that a law may be given; the first is the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Key in scene files.
    pub key: &'static str,
    /// Words.
    pub words: &'static [&'static str],
    /// Meaning of the choice.
    pub meaning: &'static str,
    /// Message for the key where another law, `{law}`, stands.
    pub elsewhere: &'static str,
}

/// A law that scene files name.
pub trait Readable: Law {
    /// The word of scene files.
    const NAME: &'static str;
    /// Purpose, in a few words.
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
    /// Purpose, in a few words.
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
