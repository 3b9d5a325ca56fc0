//! Interpolated values of the particles that are strained together.

use crate::lanes::Lanes;
use crate::laws::{BLOCK, Gradients};

/// The widest group of lanes: the last of a block may begin one particle before its end.
const MOST_LANES: usize = 8;

/// One value of each particle.
pub(super) type Column = [f64; BLOCK + MOST_LANES];

/// Interpolated values.
pub(super) struct InterpolatedValues {
    /// sum S v, per component \[m/s\].
    pub velocity: [Column; 3],
    /// sum S dv, per component \[m/s\].
    pub increment: [Column; 3],
    /// C_p of APIC, component D a + b \[1/s\].
    pub affine: [Column; 9],
    /// sum v (x) grad S \[1/s\].
    pub gradient: Gradients,
}

impl InterpolatedValues {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = [0.0; BLOCK + MOST_LANES];
        Self {
            velocity: [zero; 3],
            increment: [zero; 3],
            affine: [zero; 9],
            gradient: Gradients::zero(),
        }
    }
}

/// The values of a group that begins at particle `at <= BLOCK`.
#[inline(always)]
pub(super) fn group<L: Lanes>(column: &Column, at: usize) -> L {
    let at = at.min(BLOCK);
    L::load(&column[at..at + MOST_LANES])
}

/// Keeps the values of a group that begins at particle `at <= BLOCK`; the next group writes over those of lanes without a
/// particle.
#[inline(always)]
pub(super) fn keep<L: Lanes>(value: L, column: &mut Column, at: usize) {
    let at = at.min(BLOCK);
    value.store(&mut column[at..at + MOST_LANES]);
}
