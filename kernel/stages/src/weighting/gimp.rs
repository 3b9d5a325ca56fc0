//! GIMP: the hat averaged over the domain of the particle.

use super::WeightingType;
use crate::model::{DomainUpdate, Weighting};
use crate::weights::Family;

/// Domains keep their size.
pub(super) const UNIFORM: WeightingType = WeightingType {
    weighting: Weighting::UniformGimp,
    word: "uGIMP",
    update: None,
    name: "uGIMP",
    plan: "uGIMP, 3 nodes per axis",
    family: Family::Gimp,
    half_length: None,
};

/// Domains keep their shape and follow the volume.
pub(super) const BY_DETERMINANT: WeightingType = WeightingType {
    weighting: Weighting::ContiguousGimp(DomainUpdate::Determinant),
    word: "cpGIMP",
    update: Some("determinant"),
    name: "cpGIMP-det",
    plan: "cpGIMP, domain by det F; 3 nodes per axis, 4 once a half-length exceeds h/2",
    ..UNIFORM
};

/// Domains follow the right stretch.
pub(super) const BY_STRETCH: WeightingType = WeightingType {
    weighting: Weighting::ContiguousGimp(DomainUpdate::Stretch),
    word: "cpGIMP",
    update: Some("stretch"),
    name: "cpGIMP",
    plan: "cpGIMP, domain by U_ii; 3 nodes per axis, 4 once a half-length exceeds h/2",
    ..UNIFORM
};

/// Domains follow the left stretch.
pub(super) const BY_LEFT_STRETCH: WeightingType = WeightingType {
    weighting: Weighting::ContiguousGimp(DomainUpdate::LeftStretch),
    word: "cpGIMP",
    update: Some("left_stretch"),
    name: "cpGIMP-V",
    plan: "cpGIMP, domain by V_ii; 3 nodes per axis, 4 once a half-length exceeds h/2",
    ..UNIFORM
};
