//! MLS-MPM (Hu et al. 2018): APIC whose affine velocity is the velocity gradient, and whose forces have the same weights.

use super::TransferType;
use crate::model::TransferKind;
use crate::stage::g2p::Affine;

pub(super) const MLS: TransferType = TransferType {
    transfer: TransferKind::Mls,
    word: "MLS",
    affine: Affine::Tpic,
    least_squares: true,
    // As with APIC.
    pic_fraction: 1.0,
};
