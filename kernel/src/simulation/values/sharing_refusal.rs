//! Refusal to share a simulation among ranks.

use std::fmt;

/// Refusal to share a simulation among ranks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SharingRefusal {
    /// A part of the scene needs more than its surroundings.
    Part {
        /// The part.
        part: &'static str,
    },
    /// There are too few planes and rows for so many ranks.
    TooMany {
        /// Ranks.
        ranks: usize,
        /// Most ranks that there is room for, up to this number.
        most: usize,
    },
    /// Another rank cannot set its part up; it has the error.
    OtherRank {
        /// Its number, from 0.
        rank: usize,
    },
}

impl fmt::Display for SharingRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Part { part } => write!(
                f,
                "ranks do not share a scene with {part} yet; accepted: one process with threads (`--threads`)"
            ),
            Self::TooMany { ranks, most } => write!(
                f,
                "{ranks} ranks are too many for the planes and rows of this mesh; accepted: at most {most}"
            ),
            Self::OtherRank { rank } => write!(f, "rank {rank} cannot set its part up"),
        }
    }
}

impl std::error::Error for SharingRefusal {}
