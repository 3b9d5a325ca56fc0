//! Errors of a triangulated surface.

use super::Point;
use std::fmt;

/// A surface cannot be used. Triangles are counted from 1, as in files.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceError {
    /// The fault. By itself it says what was found, and with the error around it also what is accepted.
    pub kind: SurfaceErrorKind,
}

/// Fault of a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfaceErrorKind {
    /// There is no triangle.
    Empty,
    /// More triangles than can be numbered.
    TooMany {
        /// Their number.
        triangles: usize,
    },
    /// A coordinate that is not a finite number.
    NotFinite {
        /// Triangle.
        triangle: usize,
        /// Its corners \[m\].
        corners: [Point; 3],
    },
    /// A triangle without area: two corners are one, or all lie on a line.
    Degenerate {
        /// Triangle.
        triangle: usize,
        /// Its corners \[m\].
        corners: [Point; 3],
    },
    /// Two neighbours whose normals point to different sides.
    Orientation {
        /// The two triangles.
        triangles: [usize; 2],
        /// Ends of their common edge \[m\].
        edge: [Point; 2],
    },
    /// An edge of more than two triangles, or a triangle that is there twice.
    NonManifold {
        /// The triangles.
        triangles: Vec<usize>,
        /// Ends of the edge \[m\].
        edge: [Point; 2],
    },
    /// Edges of one triangle only where a closed surface is asked for.
    Open {
        /// Their number.
        edges: usize,
        /// The triangle with the first of them.
        triangle: usize,
        /// Ends of the first of them \[m\].
        edge: [Point; 2],
    },
}

impl SurfaceErrorKind {
    /// The values that are accepted instead.
    #[must_use]
    pub fn accepted(&self) -> &'static str {
        match self {
            Self::Empty => "a surface of at least one triangle",
            Self::TooMany { .. } => "at most 2^31 triangles",
            Self::NotFinite { .. } => "finite coordinates [m]",
            Self::Degenerate { .. } => "triangles with an area",
            Self::Orientation { .. } => {
                "neighbours that run through their common edge in opposite directions"
            }
            Self::NonManifold { .. } => "edges of at most two triangles, each triangle once",
            Self::Open { .. } => "a closed surface: every edge belongs to two triangles",
        }
    }
}

/// A point as `(x, y, z)`.
struct PointText<'a>(&'a Point);

impl fmt::Display for PointText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0;
        write!(f, "({x}, {y}, {z})")
    }
}

fn edge_words(f: &mut fmt::Formatter<'_>, [a, b]: &[Point; 2]) -> fmt::Result {
    write!(f, "from {} to {} m", PointText(a), PointText(b))
}

impl fmt::Display for SurfaceErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "no triangle"),
            Self::TooMany { triangles } => write!(f, "{triangles} triangles"),
            Self::NotFinite {
                triangle,
                corners: [a, b, c],
            } => write!(
                f,
                "triangle {triangle} with corners {}, {}, {}",
                PointText(a),
                PointText(b),
                PointText(c)
            ),
            Self::Degenerate {
                triangle,
                corners: [a, b, c],
            } => write!(
                f,
                "triangle {triangle} without area, corners {}, {}, {} m",
                PointText(a),
                PointText(b),
                PointText(c)
            ),
            Self::Orientation {
                triangles: [i, j],
                edge,
            } => {
                write!(
                    f,
                    "triangles {i} and {j} turned against each other at the edge "
                )?;
                edge_words(f, edge)
            }
            Self::NonManifold { triangles, edge } => {
                write!(
                    f,
                    "{} triangles, {triangles:?}, at the edge ",
                    triangles.len()
                )?;
                edge_words(f, edge)
            }
            Self::Open {
                edges,
                triangle,
                edge,
            } => {
                write!(f, "{edges} open edges, the first at triangle {triangle} ")?;
                edge_words(f, edge)
            }
        }
    }
}

impl fmt::Display for SurfaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}; accepted: {}", self.kind, self.kind.accepted())
    }
}

impl std::error::Error for SurfaceError {}

impl From<SurfaceErrorKind> for SurfaceError {
    fn from(kind: SurfaceErrorKind) -> Self {
        Self { kind }
    }
}
