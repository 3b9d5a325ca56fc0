//! TPIC: particles carry the velocity gradient beside the mean velocity around them.

use super::TransferType;
use crate::model::TransferKind;
use crate::stage::g2p::Affine;

pub(super) const TPIC: TransferType = TransferType {
    transfer: TransferKind::Tpic,
    word: "TPIC",
    affine: Affine::Tpic,
    least_squares: false,
    // As with APIC.
    pic_fraction: 1.0,
};
