//! APIC (Jiang et al. 2015): particles carry `B_p D_p^-1 (x_I - x_p)` beside the mean velocity around them.

use super::TransferType;
use crate::model::TransferKind;
use crate::stage::g2p::Affine;

pub(super) const APIC: TransferType = TransferType {
    transfer: TransferKind::Apic,
    word: "APIC",
    affine: Affine::Apic,
    least_squares: false,
    // What FLIP keeps in the velocity of the particle is carried in the affine part.
    pic_fraction: 1.0,
};
