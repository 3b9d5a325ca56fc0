//! FLIP: particles keep their velocity and take the change at the nodes.

use super::Kind;
use crate::scene::TransferKind;
use crate::stage::g2p::Affine;

pub(super) const FLIP: Kind = Kind {
    transfer: TransferKind::Flip,
    word: "FLIP",
    affine: Affine::Leave,
    pic_fraction: 0.0,
};
