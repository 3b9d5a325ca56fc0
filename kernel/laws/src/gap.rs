//! The gap of a material that has parted: the volume by which it opened where it bore no more tension.
//!
//! A stress beyond the end of the yield surface on the side of tension returns to it, and the volume that grows meanwhile is
//! that of a gap, not of flow along the surface. Compression closes the gap first, under no pressure: until then the material
//! carries no more than the tension of that end and what shear is left to it there. Dilation in shear opens no gap.

use super::tensor::components;
use super::tensor::{deviator, second_invariant};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Volume strain of the gap that is open.
pub const GAP: Variable = Variable::scalar("gap", "");

/// The end of a yield surface on the side of tension.
#[derive(Clone, Copy, Debug)]
pub struct TensionApex<L> {
    /// Largest mean stress \[Pa\].
    pub tension: L,
    /// Largest `sqrt(J_2)` under it \[Pa\].
    pub radius: L,
}

/// Part of a gap that closes under a trial stress, and the trial stress with it.
#[inline(always)]
pub(super) fn close<L: Lanes>(stress: &mut [L; 6], gap: L, bulk: f64) -> L {
    let zero = L::splat(0.0);
    let mean = (stress[0] + stress[1] + stress[2]) * L::splat(1.0 / 3.0);
    let closed = gap.min((-mean * L::splat(1.0 / bulk)).max(zero));
    let closes = zero.lt(closed);
    let pressure = L::splat(bulk) * closed;
    for entry in &mut stress[..3] {
        *entry = L::select(closes, *entry + pressure, *entry);
    }
    closed
}

/// The stress of a material whose gap stays open, for a trial stress: a tension up to that of the tip and the shear there.
#[inline(always)]
pub(super) fn carried<L: Lanes, const D: usize>(trial: &[L; 6], tip: &TensionApex<L>) -> [L; 6] {
    let zero = L::splat(0.0);
    let (mean, s) = deviator::<L, D>(trial);
    let radius = second_invariant::<L, D>(&s).sqrt();
    let mean = tip.tension.min(mean.max(zero));
    let ratio = L::select(zero.lt(radius), tip.radius.min(radius) / radius, zero);
    let mut out = *trial;
    for slot in 0..components(D) {
        out[slot] = if slot < 3 {
            s[slot].mul_add(ratio, mean)
        } else {
            s[slot] * ratio
        };
    }
    out
}
