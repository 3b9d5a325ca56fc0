//! Circular cylinders of any direction.

use super::FilledBody;
use super::ball::runs_where;
use super::error::FillError;
use super::lattice::Lattice;
use crate::shape::Vector;
use std::f64::consts::PI;

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a + s b
fn add(a: Vector, s: f64, b: Vector) -> Vector {
    std::array::from_fn(|axis| a[axis] + s * b[axis])
}

/// Sine of the angle below which a line is parallel to a face or to the axis. Over a mesh of 1e6 cells it is
/// then off by 1e-6 h at most, far within the margin of the search.
const PARALLEL: f64 = 1e-12;

/// The part of the line w + t `e_z` (w from the first end face) in the closed cylinder of unit direction `u`.
fn chord(w: Vector, u: Vector, length: f64, radius: f64) -> Option<[f64; 2]> {
    let s = dot(w, u);
    let mut t = [f64::NEG_INFINITY, f64::INFINITY];
    if u[2].abs() > PARALLEL {
        let (a, b) = (-s / u[2], (length - s) / u[2]);
        t = [a.min(b), a.max(b)];
    } else if s < 0.0 || s > length {
        return None;
    }
    let q = add(w, -s, u);
    // e_z - u_z u, with 1 - u_z² = u_x² + u_y² kept from cancelling near the axis.
    let e = [-u[2] * u[0], -u[2] * u[1], u[0] * u[0] + u[1] * u[1]];
    let (a, b, c) = (dot(e, e), dot(q, e), dot(q, q) - radius * radius);
    if a > PARALLEL * PARALLEL {
        let square = b * b - a * c;
        if square < 0.0 {
            return None;
        }
        let root = square.sqrt();
        t = [t[0].max((-b - root) / a), t[1].min((-b + root) / a)];
    } else if c > 0.0 {
        return None;
    }
    (t[0] < t[1]).then_some(t)
}

/// Volume of the cylinder \[m³\].
pub(super) fn volume(p1: &Vector, p2: &Vector, radius: f64) -> f64 {
    let along = add(*p2, -1.0, *p1);
    PI * radius * radius * dot(along, along).sqrt()
}

/// Particles of the cylinder between the centres `p1` and `p2` of its end faces, in the coordinates of the
/// scene \[m\].
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill(
    lattice: &Lattice,
    p1: Vector,
    p2: Vector,
    radius: f64,
) -> Result<FilledBody, FillError> {
    FillError::require_positive("radius", None, radius)?;
    let (p1, p2) = (lattice.relative(p1), lattice.relative(p2));
    let axis_vector = add(p2, -1.0, p1);
    let length = dot(axis_vector, axis_vector).sqrt();
    FillError::require_positive("length of the cylinder", None, length)?;
    let u = axis_vector.map(|a| a / length);
    let volume = volume(&p1, &p2, radius);
    let bounds = std::array::from_fn(|axis| {
        // A disc with the normal u reaches r sqrt(1 - u_i²) along axis i.
        let reach = radius * (1.0 - u[axis] * u[axis]).max(0.0).sqrt();
        [
            p1[axis].min(p2[axis]) - reach,
            p1[axis].max(p2[axis]) + reach,
        ]
    });

    let tolerance = lattice.distance_tolerance();
    let most = (radius - tolerance).max(0.0);
    let margin = 0.01 * lattice.smallest_spacing();
    let shifted = add(p1, -margin, u);
    lattice.sweep(&bounds, volume, |[i, j], runs| {
        let (x, y) = (lattice.centre(0, i), lattice.centre(1, j));
        // The chord of a cylinder larger by the margin only narrows the search.
        let w = [x - shifted[0], y - shifted[1], 0.0 - shifted[2]];
        let Some([lower, upper]) = chord(w, u, length + 2.0 * margin, radius + margin) else {
            return;
        };
        let inside = |k: i64| {
            let w = add([x, y, lattice.centre(2, k)], -1.0, p1);
            let s = dot(w, u);
            // Not |w|² - s², which loses the digits of a long thin cylinder.
            let q = add(w, -s, u);
            tolerance < s && s < length - tolerance && dot(q, q) < most * most
        };
        runs_where(lattice.between(2, lower, upper), inside, runs);
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chord_across_along_and_beside() {
        let x = [1.0, 0.0, 0.0];
        let z = [0.0, 0.0, 1.0];
        // Cylinder along x: the line at y = 3 crosses a circle of radius 5 at z = -4 and 4.
        assert_eq!(chord([1.0, 3.0, 0.0], x, 2.0, 5.0), Some([-4.0, 4.0]));
        assert_eq!(chord([3.0, 3.0, 0.0], x, 2.0, 5.0), None);
        assert_eq!(chord([1.0, 6.0, 0.0], x, 2.0, 5.0), None);
        // Along z: from face to face, or not at all.
        assert_eq!(chord([3.0, 3.0, 0.0], z, 2.0, 5.0), Some([0.0, 2.0]));
        assert_eq!(chord([4.0, 4.0, 0.0], z, 2.0, 5.0), None);
    }
}
