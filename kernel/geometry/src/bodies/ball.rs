//! Spheres, discs and rings.

use super::FilledBody;
use super::error::FillError;
use super::lattice::Lattice;
use crate::shape::Vector;
use std::f64::consts::PI;
use std::ops::Range;

/// Particles of the points between two radii \[m\] about a centre in the coordinates of the scene; `inner`
/// zero is a full sphere or disc.
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill(
    lattice: &Lattice,
    center: Vector,
    inner: f64,
    outer: f64,
) -> Result<FilledBody, FillError> {
    FillError::require_positive("outer radius", None, outer)?;
    FillError::require_finite("inner radius", None, inner)?;
    if inner < 0.0 {
        return Err(FillError::NotPositive {
            quantity: "inner radius",
            index: None,
            value: inner,
        });
    }
    let c = lattice.relative(center);
    let last = lattice.last();
    let volume = volume(lattice.axes, inner, outer);

    // Strictly inside, by the tolerance: a centre on the surface is outside whatever its round-off.
    let tolerance = lattice.distance_tolerance();
    let least = if inner > 0.0 { inner + tolerance } else { -1.0 };
    let most = (outer - tolerance).max(0.0);
    // The roots only narrow the search; this margin pays for their round-off.
    let margin = 0.01 * lattice.smallest_spacing();

    let mut bounds = c.map(|x| [x - outer, x + outer]);
    if lattice.begins_on_axis && c[0] == 0.0 {
        // Half of the disc is revolved.
        bounds[0][0] = 0.0;
    }
    lattice.sweep(&bounds, volume, |row, runs| {
        let mut row_square = 0.0;
        for axis in 0..last {
            row_square += (lattice.centre(axis, row[axis]) - c[axis]).powi(2);
        }
        let Some(half) = half_chord(outer + margin, row_square) else {
            return;
        };
        let inside = |k: i64| {
            let square = row_square + (lattice.centre(last, k) - c[last]).powi(2);
            square < most * most && (least < 0.0 || square > least * least)
        };
        let hole = if inner > margin {
            half_chord(inner - margin, row_square)
        } else {
            None
        };
        let chord = lattice.between(last, c[last] - half, c[last] + half);
        if let Some(hole) = hole {
            let gap = lattice.between(last, c[last] - hole, c[last] + hole);
            runs_where(chord.start..gap.start, inside, runs);
            runs_where(gap.end..chord.end, inside, runs);
        } else {
            runs_where(chord, inside, runs);
        }
    })
}

/// Volume of a sphere, or area of a disc or ring \[m³\].
pub(super) fn volume(axes: usize, inner: f64, outer: f64) -> f64 {
    if axes == 2 {
        // (R - r)(R + r), because R² - r² loses the digits of a thin ring.
        PI * (outer - inner) * (outer + inner)
    } else {
        4.0 / 3.0 * PI * outer.powi(3)
    }
}

/// Half the length of the chord at a squared distance from the centre \[m\].
fn half_chord(radius: f64, square: f64) -> Option<f64> {
    let rest = radius * radius - square;
    (rest > 0.0).then(|| rest.sqrt())
}

/// Appends the runs of consecutive indices that pass the test.
pub(super) fn runs_where(
    candidates: Range<i64>,
    inside: impl Fn(i64) -> bool,
    runs: &mut Vec<Range<i64>>,
) {
    let mut start = None;
    for k in candidates.clone() {
        match (inside(k), start) {
            (true, None) => start = Some(k),
            (false, Some(first)) => {
                runs.push(first..k);
                start = None;
            }
            _ => {}
        }
    }
    if let Some(first) = start {
        runs.push(first..candidates.end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_the_maximal_stretches() {
        let mut runs = Vec::new();
        runs_where(-2..7, |k| k != 0 && k != 1 && k != 4, &mut runs);
        assert_eq!(runs, [-2..0, 2..4, 5..7]);
    }

    #[test]
    fn chord_of_a_3_4_5_triangle() {
        assert_eq!(half_chord(5.0, 9.0), Some(4.0));
        assert_eq!(half_chord(5.0, 25.0), None);
    }
}
