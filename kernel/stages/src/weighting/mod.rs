//! Kinds of weighting functions: what a scene chooses one by, what it is called, and which functions it takes.
//!
//! Each stands in one list, under the file that it is in. The functions themselves are in [`crate::weights`].

use crate::model::{DomainUpdate, Weighting};
use crate::weights::Family;

/// A kind of weighting function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightingType {
    /// Weighting by which a scene chooses it.
    pub weighting: Weighting,
    /// Its word in scene files.
    pub word: &'static str,
    /// The word of its domain update in scene files, where it has one.
    pub update: Option<&'static str>,
    /// Its name in tables.
    pub name: &'static str,
    /// Words of the plan.
    pub plan: &'static str,
    /// Functions that it takes.
    pub family: Family,
    /// Half-length of a particle domain in cells where it is the same for all particles whatever their volume.
    pub half_length: Option<f64>,
}

/// Kinds by the file that they are in, the default first of those with the same word.
macro_rules! list {
    ($($file:ident: [$($kind:ident),*],)*) => {
        $(mod $file;)*

        /// All kinds.
        pub const ALL: &[WeightingType] = &[$($($file::$kind),*),*];
    };
}

list! {
    linear: [LINEAR],
    gimp: [UNIFORM, BY_DETERMINANT, BY_STRETCH, BY_LEFT_STRETCH],
    bspline: [QUADRATIC],
}

impl Weighting {
    /// Its entry in the list.
    ///
    /// # Panics
    /// Never: a test asks for each.
    #[must_use]
    pub fn kind(self) -> &'static WeightingType {
        let found = ALL.iter().find(|kind| kind.weighting == self);
        found.expect("every weighting function is in the list")
    }

    /// Domain update, for families whose particle domains follow the deformation.
    #[must_use]
    pub fn domain_update(self) -> Option<DomainUpdate> {
        match self {
            Self::ContiguousGimp(update) => Some(update),
            _ => None,
        }
    }
}
