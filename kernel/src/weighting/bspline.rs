//! B-splines.

use super::Kind;
use crate::scene::Weighting;
use crate::weights::Family;

/// The quadratic one, which is GIMP with domains of one cell.
pub(super) const QUADRATIC: Kind = Kind {
    weighting: Weighting::QuadraticBSpline,
    word: "quadratic_bspline",
    update: None,
    name: "B-spline",
    plan: "quadratic B-spline, 3 nodes per axis",
    family: Family::Gimp,
    half_length: Some(0.5),
};
