//! The part of the Ewald split that is summed over the mirror images of the load.
//!
//! Each image acts on the half-space as a load minus the same load smoothed over about the split length, so
//! its displacement dies out within twelve lengths. With `x, y` from the image, depth `d`,
//! `R^2 = x^2 + y^2 + d^2`, `r^2 = x^2 + y^2`, `s = 1/(2 eta)`, the short parts of the modes' building blocks are
//! * `e^(-kd)/k`: `erfc(sR)/(2 pi R)`;
//! * its gradient: `(x, y, d) g/(2 pi)` with `g = erfc(sR)/R^3 + 2 s/sqrt(pi) exp(-s^2 R^2)/R^2`;
//! * `kx e^(-kd)/k^2`: `x/(2 pi r^2) [exp(-s^2 r^2) erfc(s d) - d/R erfc(sR)]`.
//!
//! For a patch the singular parts are integrated in closed form (Love 1929) and the smooth rest by Gauss points.

use std::f64::consts::{FRAC_2_SQRT_PI, TAU};

use libm::{asinh, atan, exp, hypot, log};

use super::BoxProblem;
use super::mode::Medium;
use crate::exact::special::{erf_over_x, erfc, gauss_legendre, gaussian_field_over_x};

/// Images farther than this many split lengths do not count: `erfc(6)` is 2e-17.
const REACH: f64 = 12.0;

/// Integrals of the three building blocks over an image, times 2 pi.
#[derive(Debug, Clone, Copy, Default)]
struct Blocks {
    /// Sum of `1/R`.
    potential: f64,
    /// Sum of the gradient along `x, y, d`.
    gradient: [f64; 3],
    /// Sum of `(x, y)/(R (R + d))`.
    lateral: [f64; 2],
}

impl Blocks {
    fn add(&mut self, factor: f64, other: &Self) {
        self.potential += factor * other.potential;
        for axis in 0..3 {
            self.gradient[axis] += factor * other.gradient[axis];
        }
        for axis in 0..2 {
            self.lateral[axis] += factor * other.lateral[axis];
        }
    }
}

/// The images of the load, seen from one depth.
pub(super) struct Images<'a> {
    problem: &'a BoxProblem,
    medium: &'a Medium,
    depth: f64,
    /// `s = 1/(2 eta)`, 1/m.
    sharpness: f64,
    reach: f64,
    /// Gauss points and weights on (-1, 1); none for a point load.
    gauss: Vec<(f64, f64)>,
}

impl<'a> Images<'a> {
    /// Images for the split length `eta` (m), at the height `z` (m).
    pub fn new(problem: &'a BoxProblem, medium: &'a Medium, z: f64, eta: f64) -> Self {
        let sharpness = 0.5 / eta;
        // The integrand is a Gaussian of width 1/s: its Gauss rule needs about eight points per width, and ten more.
        let gauss = problem
            .patch
            .map(|w| gauss_legendre(10 + (8.0 * w * sharpness) as usize))
            .unwrap_or_default();
        Self {
            problem,
            medium,
            depth: problem.height - z,
            sharpness,
            reach: REACH * eta,
            gauss,
        }
    }

    /// Displacement (m) at `[x, y]` (m) from all images within reach.
    pub fn displacement(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let half = 0.5 * self.problem.patch.unwrap_or(0.0);
        let reach = self.reach + half;
        let mut total = Blocks::default();
        for dx in offsets(x, self.problem.position[0], self.problem.a, reach) {
            for dy in offsets(y, self.problem.position[1], self.problem.b, reach) {
                let blocks = match self.problem.patch {
                    None => self.point(dx, dy),
                    Some(width) => self.patch(dx, dy, width),
                };
                total.add(1.0, &blocks);
            }
        }
        let compliance = self.problem.load / (2.0 * self.medium.shear * TAU);
        let (d, nu) = (self.depth, self.medium.poisson);
        let lateral =
            |axis: usize| d * total.gradient[axis] - (1.0 - 2.0 * nu) * total.lateral[axis];
        [
            compliance * lateral(0),
            compliance * lateral(1),
            -compliance * (2.0 * (1.0 - nu) * total.potential + d * total.gradient[2]),
        ]
    }

    /// Blocks of a unit point load at the offset `(x, y)`.
    fn point(&self, x: f64, y: f64) -> Blocks {
        let (d, s) = (self.depth, self.sharpness);
        let r2 = x * x + y * y;
        let big_r = (r2 + d * d).sqrt();
        let tail = erfc(s * big_r);
        let g =
            tail / big_r.powi(3) + FRAC_2_SQRT_PI * s * exp(-(s * big_r).powi(2)) / (big_r * big_r);
        let l = (exp(-s * s * r2) * erfc(s * d) - d / big_r * tail) / r2;
        // Straight below the load the lateral parts vanish by symmetry; at the surface so does d times the gradient.
        let along = |factor: f64, c: f64| if c == 0.0 { 0.0 } else { factor * c };
        Blocks {
            potential: tail / big_r,
            gradient: [along(g, x), along(g, y), along(g, d)],
            lateral: [along(l, x), along(l, y)],
        }
    }

    /// Blocks of a unit load spread over a square whose centre lies at the offset `(x, y)`.
    fn patch(&self, x: f64, y: f64, width: f64) -> Blocks {
        let half = 0.5 * width;
        let per_area = 1.0 / (width * width);
        let mut sum = Blocks::default();
        for (sign_x, cx) in [(1.0, x + half), (-1.0, x - half)] {
            for (sign_y, cy) in [(1.0, y + half), (-1.0, y - half)] {
                sum.add(sign_x * sign_y * per_area, &self.corner(cx, cy));
            }
        }
        for &(xi, weight_x) in &self.gauss {
            for &(eta, weight_y) in &self.gauss {
                // The weights sum to 4 over the square, which has the area 4 in its own coordinates.
                let weight = 0.25 * weight_x * weight_y;
                sum.add(-weight, &self.smooth(x + half * xi, y + half * eta));
            }
        }
        sum
    }

    /// Antiderivatives over x and y of the singular blocks `1/R`, `(x, y, d)/R^3`, `(x, y)/(R (R + d))`.
    fn corner(&self, x: f64, y: f64) -> Blocks {
        let d = self.depth;
        let big_r = (x * x + y * y + d * d).sqrt();
        // Each is zero in the limit where its denominator is.
        let ratio = |p: f64, q: f64| if q == 0.0 { 0.0 } else { p / q };
        let asinh_y = asinh(ratio(y, hypot(x, d)));
        let asinh_x = asinh(ratio(x, hypot(y, d)));
        let angle = atan(ratio(x * y, d * big_r));
        let strip = |p: f64, q: f64, asinh_q: f64| {
            let log = if q == 0.0 { 0.0 } else { q * log(big_r + d) };
            log + d * asinh_q + p * (atan(ratio(q, p)) - atan(ratio(q * d, p * big_r)))
        };
        Blocks {
            potential: x * asinh_y + y * asinh_x - d * angle,
            gradient: [-asinh_y, -asinh_x, angle],
            lateral: [strip(x, y, asinh_y), strip(y, x, asinh_x)],
        }
    }

    /// The singular blocks minus the short ones: what the smoothed point load does.
    fn smooth(&self, x: f64, y: f64) -> Blocks {
        let (d, s) = (self.depth, self.sharpness);
        let r2 = x * x + y * y;
        let big_r = (r2 + d * d).sqrt();
        let potential = s * erf_over_x(s * big_r);
        let g = s.powi(3) * gaussian_field_over_x(s * big_r);
        let l = if r2 == 0.0 {
            0.0
        } else {
            (1.0 - exp(-s * s * r2) * erfc(s * d) - d * potential) / r2
        };
        Blocks {
            potential,
            gradient: [g * x, g * y, g * d],
            lateral: [l * x, l * y],
        }
    }
}

/// Offsets of `x` from the images `±at + 2 i side` within `reach`.
fn offsets(x: f64, at: f64, side: f64, reach: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for base in [x - at, x + at] {
        let first = ((base - reach) / (2.0 * side)).ceil() as i64;
        let last = ((base + reach) / (2.0 * side)).floor() as i64;
        found.extend((first..=last).map(|i| base - 2.0 * side * i as f64));
    }
    found
}
