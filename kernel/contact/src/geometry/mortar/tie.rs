//! Affine weights that tie a point to the particles around it.

use super::PointIn;
use nalgebra::SMatrix;

/// Weights w_p of points X_p that reproduce every affine field at X_v: sum_p w_p = 1 and sum_p w_p X_p = X_v, so that
/// sum_p w_p x_p is where X_v goes in any translation, rotation and uniform strain that takes X_p to x_p. What it is off by
/// else is of second order in `support`.
///
/// They are those of a moving least squares fit (Lancaster and Salkauskas 1981) with quadratic B-splines as weights,
/// which reach 3/2 of `support` along each axis \[m\]. `None` where the points do not span all directions: where their
/// places vary by less than a share `least` of the square of the support, for a slope to be known. Two rows of particles
/// beside a straight side have 0.06 with a support of 3/2 of the distance between them, one row has none.
#[must_use]
pub fn affine_weights<const D: usize>(
    points: &[PointIn<D>],
    at: &PointIn<D>,
    support: &PointIn<D>,
    least: f64,
) -> Option<Vec<f64>> {
    let from = |point: &PointIn<D>| (point - at).component_div(support);
    let near = |r: &PointIn<D>| r.iter().map(|r| spline(*r)).product::<f64>();
    let mut sum = 0.0;
    let mut mean = PointIn::<D>::zeros();
    for r in points.iter().map(from) {
        let b = near(&r);
        sum += b;
        mean += b * r;
    }
    if sum <= 0.0 {
        return None;
    }
    mean /= sum;
    let mut variance = SMatrix::<f64, D, D>::zeros();
    for r in points.iter().map(from) {
        let off = r - mean;
        variance += near(&r) / sum * off * off.transpose();
    }
    let factor = variance.cholesky()?;
    // The pivots: how places vary along an axis beside what follows from the axes before.
    let varies = |axis: usize| factor.l_dirty()[(axis, axis)].powi(2) >= least;
    if !(0..D).all(varies) {
        return None;
    }
    let slope = factor.solve(&mean);
    let weight = |r: PointIn<D>| near(&r) / sum * (1.0 - slope.dot(&(r - mean)));
    Some(points.iter().map(from).map(weight).collect())
}

/// The quadratic B-spline.
fn spline(r: f64) -> f64 {
    let r = r.abs();
    if r < 0.5 {
        0.75 - r * r
    } else if r < 1.5 {
        0.5 * (1.5 - r) * (1.5 - r)
    } else {
        0.0
    }
}
