//! Kinds of velocity transfer: what a scene chooses one by, what it is called, and what it carries.
//!
//! Each stands in one list, under the file that it is in.

use crate::model::{Transfer, TransferKind};
use crate::stage::g2p::Affine;

/// A kind of transfer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransferType {
    /// Kind by which a scene chooses it.
    pub transfer: TransferKind,
    /// Its word in scene files, which is its name in tables too.
    pub word: &'static str,
    /// The affine velocity that it carries.
    pub affine: Affine,
    /// True where gradients are those of a linear field that is fitted to the nodes by weighted least squares,
    /// sum_I S_Ip v_I (x_I - x_p) `D_p^-1`, in the place of sum_I v_I grad S_Ip; forces likewise.
    pub least_squares: bool,
    /// Its usual share of PIC, 0 to 1.
    pub pic_fraction: f64,
}

/// Kinds by the file that they are in.
macro_rules! list {
    ($($file:ident: $kind:ident,)*) => {
        $(mod $file;)*

        /// All kinds.
        pub const ALL: &[TransferType] = &[$($file::$kind),*];
    };
}

list! {
    flip: FLIP,
    apic: APIC,
    tpic: TPIC,
    mls: MLS,
}

impl TransferKind {
    /// Its entry in the list.
    ///
    /// # Panics
    /// Never: a test asks for each.
    #[must_use]
    pub fn kind(self) -> &'static TransferType {
        let found = ALL.iter().find(|kind| kind.transfer == self);
        found.expect("every transfer is in the list")
    }
}

impl Transfer {
    /// A transfer with its usual share of PIC.
    #[must_use]
    pub fn new(kind: TransferKind) -> Self {
        let pic_fraction = kind.kind().pic_fraction;
        Self { kind, pic_fraction }
    }
}
