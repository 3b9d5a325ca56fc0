//! B-splines.

use super::WeightingType;
use crate::model::Weighting;
use crate::weights::Family;

/// The quadratic one, which is GIMP with domains of one cell.
pub(super) const QUADRATIC: WeightingType = WeightingType {
    weighting: Weighting::QuadraticBSpline,
    word: "quadratic_bspline",
    update: None,
    name: "B-spline",
    plan: "quadratic B-spline, 3 nodes per axis",
    family: Family::Gimp,
    half_length: Some(0.5),
};
