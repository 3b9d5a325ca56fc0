//! The largest stable time step of each method.

mod table;

use crate::model::{StressScheme, TransferKind, Weighting};

/// Share of the critical step that an automatic step takes.
pub const AUTOMATIC_SHARE: f64 = 0.8;

/// Half-lengths of [`table::GIMP`] \[cells\].
const HALF_LENGTHS: [f64; 3] = [0.5, 0.25, 0.125];

/// Largest stable C = (c + |v|) dt / min(h) of a scheme, weighting function and transfer.
///
/// The table is made by `proctor stability --table`, from the linear part of the kernel's own step and from runs with noise:
/// blocks of one to three cells, plates, rods and single particles at nineteen places on the mesh, one, two and four
/// particles per cell and axis, two and three dimensions. With its numbers bodies that are more than a cell thick are stable,
/// and with 0.8 of them, which an automatic step takes, every body is.
///
/// The second mapping of USF and MUSL keeps light nodes at the edge of a body calm because the particles hardly feel
/// them; an affine velocity feels them through its gradient and carries them back. GIMP bounds of USL and of affine transfers
/// fall like sqrt(`l_p`) below four particles per cell: an almost empty node carries w² = c²/(h `l_p`). The others fall
/// towards those of linear functions. Linear functions have no bound with USL or an affine transfer, because a node that
/// only the edge of a body reaches is as light as one likes; their number there holds where no node is nearly empty.
///
/// `half_length` is the smallest half-length of a particle domain in cells.
#[must_use]
pub fn stability_number(
    weighting: Weighting,
    scheme: StressScheme,
    transfer: TransferKind,
    half_length: f64,
) -> f64 {
    let s = match scheme {
        StressScheme::Usl => 0,
        StressScheme::Usf => 1,
        StressScheme::Musl => 2,
    };
    // Accepted with B-splines alone, so that the other functions need none of their own.
    if transfer == TransferKind::Mls {
        return table::LEAST_SQUARES[s];
    }
    let t = match transfer {
        TransferKind::Flip => 0,
        TransferKind::Apic => 1,
        TransferKind::Tpic | TransferKind::Mls => 2,
    };
    match weighting {
        Weighting::Linear => table::LINEAR[s][t],
        Weighting::QuadraticBSpline => table::B_SPLINE[s][t],
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) => {
            let row = &table::GIMP[s][t];
            let light_nodes_act = scheme == StressScheme::Usl || transfer != TransferKind::Flip;
            let [.., last] = HALF_LENGTHS;
            if half_length >= last {
                between(row, half_length)
            } else if light_nodes_act {
                row[2] * (half_length / last).sqrt()
            } else {
                let share = (half_length / last).max(0.0);
                table::LINEAR[s][t] + share * (row[2] - table::LINEAR[s][t])
            }
        }
    }
}

/// A number between those of the table. They rise ever more slowly with the half-length, so that the line between two of them
/// is on the safe side.
fn between(row: &[f64; 3], half_length: f64) -> f64 {
    let (upper, lower) = if half_length >= HALF_LENGTHS[1] {
        (0, 1)
    } else {
        (1, 2)
    };
    let width = HALF_LENGTHS[upper] - HALF_LENGTHS[lower];
    let share = ((half_length - HALF_LENGTHS[lower]) / width).min(1.0);
    row[lower] + share * (row[upper] - row[lower])
}

/// True if [`stability_number`] holds for every body. It does not for linear functions with USL or an affine transfer, which a
/// nearly empty node can make unstable at any step.
#[must_use]
pub fn has_safe_step(weighting: Weighting, scheme: StressScheme, transfer: TransferKind) -> bool {
    weighting != Weighting::Linear
        || (scheme != StressScheme::Usl && transfer == TransferKind::Flip)
}
