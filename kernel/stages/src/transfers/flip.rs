//! FLIP: particles keep their velocity and take the change at the nodes.

use super::TransferType;
use crate::model::TransferKind;
use crate::stage::g2p::Affine;

pub(super) const FLIP: TransferType = TransferType {
    transfer: TransferKind::Flip,
    word: "FLIP",
    affine: Affine::Leave,
    least_squares: false,
    pic_fraction: 0.0,
};
