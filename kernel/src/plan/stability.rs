//! The largest stable time step of each method.

use crate::scene::{StressScheme, TransferKind, Weighting};

/// Share of the critical step that an automatic step takes.
pub const AUTOMATIC_SHARE: f64 = 0.8;

/// Largest stable C = (c + |v|) dt / min(h) of a scheme, weighting function and transfer.
///
/// Measured: blocks of 3^d cells with 1, 2 and 4 particles per cell and axis, twelve offsets on the grid, velocity
/// noise, 400 steps without growth, two and three dimensions; corners of a body are lighter than its edges and
/// lower the bounds of one dimension. The numbers are the smallest over all of these:
///
/// | | USL | USF, MUSL with FLIP | USF, MUSL with APIC, TPIC |
/// |---|---|---|---|
/// | GIMP | 0.44 | 1.3 | 0.65 |
/// | quadratic B-spline | 0.55 | 1.3 | 0.8 |
/// | linear | none | 0.7 | none |
///
/// The second mapping of USF and MUSL keeps light nodes at the edge of a body calm because the particles hardly feel
/// them; an affine velocity feels them through its gradient and carries them back. GIMP bounds of the first and last
/// column fall like sqrt(`l_p`) below four particles per cell: an almost empty node carries w² = c²/(h `l_p`). Linear
/// functions have no bound in these columns, because a node that only the edge of a body reaches is as light as one
/// likes; 0.7 holds where no node is nearly empty.
///
/// `half_length` is the smallest half-length of a particle domain in cells.
#[must_use]
pub fn stability_number(
    weighting: Weighting,
    scheme: StressScheme,
    transfer: TransferKind,
    half_length: f64,
) -> f64 {
    let small = (8.0 * half_length).sqrt().min(1.0);
    let light_nodes_act = scheme == StressScheme::Usl;
    let affine = transfer != TransferKind::Flip;
    match weighting {
        Weighting::Linear => 0.7,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) if light_nodes_act => 0.44 * small,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) if affine => 0.65 * small,
        Weighting::QuadraticBSpline if light_nodes_act => 0.55,
        Weighting::QuadraticBSpline if affine => 0.8,
        _ => 1.3,
    }
}

/// Whether [`stability_number`] holds for every body. It does not where the bound is `none` in its table: linear
/// functions with USL or an affine transfer, which a nearly empty node can make unstable at any step.
#[must_use]
pub fn has_safe_step(weighting: Weighting, scheme: StressScheme, transfer: TransferKind) -> bool {
    weighting != Weighting::Linear
        || (scheme != StressScheme::Usl && transfer == TransferKind::Flip)
}
