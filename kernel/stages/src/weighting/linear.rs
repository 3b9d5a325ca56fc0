//! Linear functions.

use super::WeightingType;
use crate::model::Weighting;
use crate::weights::Family;

/// The hat at the position of the particle.
pub(super) const LINEAR: WeightingType = WeightingType {
    weighting: Weighting::Linear,
    word: "linear",
    update: None,
    name: "linear",
    plan: "linear, 2 nodes per axis, 3 for a particle that lies on a node",
    family: Family::Hat,
    // A hat has no domain; the number only enters the stability bound, which ignores it for hats.
    half_length: Some(0.25),
};
