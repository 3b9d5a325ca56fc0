//! Bodies known by intervals of height above points of the plan: ground between sheets, and the inside of a closed surface.

use super::FilledBody;
use super::error::FillError;
use super::lattice::Lattice;
use crate::enclosed::EnclosedRegion;
use crate::shape::Vector;
use crate::sheet::PlanPoint;
use crate::stratum::Stratum;

/// Particles of a stratum in the coordinates of the scene \[m\], in a mesh that begins at `origin`.
///
/// The particles of all parts of a body have the same volume, with which they sum to the exact volume of the body. Parts that
/// differ in it would push on each other with the stress at their interface. A centre on an interface is in the upper part.
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill_stratum(
    lattice: &Lattice,
    stratum: &Stratum,
    origin: &Vector,
) -> Result<FilledBody, FillError> {
    let stratum = stratum.relative_to(origin);
    let whole = stratum.whole();
    let tolerance = lattice.distance_tolerance();
    let mut of_whole = vec![];
    let above = |at: PlanPoint, intervals: &mut Vec<[f64; 2]>| {
        whole.intervals(at, &mut of_whole);
        stratum.intervals(at, intervals);
        let is_end = |x: f64| of_whole.iter().any(|[low, _]| *low == x);
        for [low, _] in intervals {
            if !is_end(*low) {
                *low -= 2.0 * tolerance;
            }
        }
        of_whole.clear();
    };
    let mut filled = fill(lattice, &stratum.bounds(), stratum.volume(), above)?;
    let all = |at: PlanPoint, intervals: &mut Vec<[f64; 2]>| whole.intervals(at, intervals);
    let count = fill(lattice, &whole.bounds(), whole.volume(), all)?.whole_count();
    let each = whole.volume() / count as f64;
    filled.volume.fill(each);
    filled.exact_volume = each * filled.whole_count() as f64;
    Ok(filled)
}

/// Particles inside a closed surface in the coordinates of the scene \[m\], in a mesh that begins at `origin`.
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill_enclosed(
    lattice: &Lattice,
    body: &EnclosedRegion,
    origin: &Vector,
) -> Result<FilledBody, FillError> {
    let body = body.relative_to(origin);
    fill(lattice, &body.bounds(), body.volume(), |at, intervals| {
        body.intervals(at, intervals);
    })
}

fn fill(
    lattice: &Lattice,
    [low, high]: &[Vector; 2],
    volume: f64,
    mut above: impl FnMut(PlanPoint, &mut Vec<[f64; 2]>),
) -> Result<FilledBody, FillError> {
    let bounds = std::array::from_fn(|axis| [low[axis], high[axis]]);
    let last = lattice.last();
    let tolerance = lattice.distance_tolerance();
    let mut intervals = vec![];
    lattice.sweep(&bounds, volume, |[i, j], runs| {
        // In two dimensions in the middle of the unit thickness.
        let across = if lattice.axes == 2 {
            0.5
        } else {
            lattice.centre(1, j)
        };
        above([lattice.centre(0, i), across], &mut intervals);
        runs.extend(
            (intervals.drain(..))
                .map(|[low, high]| lattice.between(last, low + tolerance, high - tolerance)),
        );
    })
}
