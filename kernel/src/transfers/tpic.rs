//! TPIC: particles carry the velocity gradient beside the mean velocity around them.

use super::Kind;
use crate::scene::TransferKind;
use crate::stage::g2p::Affine;

pub(super) const TPIC: Kind = Kind {
    transfer: TransferKind::Tpic,
    word: "TPIC",
    affine: Affine::Tpic,
    // As with APIC.
    pic_fraction: 1.0,
};
