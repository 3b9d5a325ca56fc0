//! Special functions that the standard library lacks: error function, trigonometry in half turns, Gauss points.

use std::f64::consts::{FRAC_2_SQRT_PI, PI};

use libm::{cos, exp, sin};

/// Beyond this argument the continued fraction of `erfc` needs fewer terms than the power series.
const SERIES_LIMIT: f64 = 2.0;

/// `exp(-x^2) * sum_n 2^n x^(2n) / (2n+1)!!`, started at the term `first`.
///
/// All terms are positive, so nothing cancels.
/// With `first = 0` it is `erf(x) sqrt(pi) / (2 x)`; the sum from 1 on is that minus `exp(-x^2)`.
fn scaled_erf_series(x: f64, first: u32) -> f64 {
    let x2 = x * x;
    let mut term = 1.0;
    let mut sum = if first == 0 { 1.0 } else { 0.0 };
    for n in 1..200_u32 {
        term *= 2.0 * x2 / f64::from(2 * n + 1);
        sum += term;
        if term < 1e-17 * sum {
            break;
        }
    }
    sum * exp(-x2)
}

/// Complementary error function, `erfc(x) = 1 - erf(x)`; absolute error below 1e-15, and relative error below
/// 1e-14 for `x >= 2`.
///
/// Power series (Abramowitz and Stegun 7.1.6) below 2, continued fraction (7.1.14) above.
#[must_use]
pub fn erfc(x: f64) -> f64 {
    if x < SERIES_LIMIT {
        return 1.0 - erf(x);
    }
    // The fraction converges like exp(-2 x sqrt(2 n)); 200 / x^2 levels reach round-off.
    let levels = 4 + (200.0 / (x * x)) as u32;
    let mut tail = x;
    for level in (1..=levels).rev() {
        tail = x + 0.5 * f64::from(level) / tail;
    }
    exp(-x * x) * 0.5 * FRAC_2_SQRT_PI / tail
}

/// Error function, `erf(x) = 2/sqrt(pi) * integral of exp(-t^2) from 0 to x`; absolute error below 1e-15.
#[must_use]
pub fn erf(x: f64) -> f64 {
    if x.abs() < SERIES_LIMIT {
        FRAC_2_SQRT_PI * x * scaled_erf_series(x, 0)
    } else {
        (1.0 - erfc(x.abs())).copysign(x)
    }
}

/// `erf(x) / x`, smooth through `x = 0` where it is `2/sqrt(pi)`.
#[must_use]
pub fn erf_over_x(x: f64) -> f64 {
    if x.abs() < SERIES_LIMIT {
        FRAC_2_SQRT_PI * scaled_erf_series(x, 0)
    } else {
        erf(x) / x
    }
}

/// `(erf(x) - 2/sqrt(pi) x exp(-x^2)) / x^3`, smooth through `x = 0` where it is `4/(3 sqrt(pi))`.
///
/// It is the field (up to scale) of a Gaussian charge divided by the distance.
#[must_use]
pub fn gaussian_field_over_x(x: f64) -> f64 {
    if x.abs() < SERIES_LIMIT {
        // The series starts at x^2, so its first term is taken out by hand and zero stays harmless.
        if x.abs() < 1e-6 {
            return FRAC_2_SQRT_PI * 2.0 / 3.0;
        }
        FRAC_2_SQRT_PI * scaled_erf_series(x, 1) / (x * x)
    } else {
        (erf(x) - FRAC_2_SQRT_PI * x * exp(-x * x)) / (x * x * x)
    }
}

/// `cos(pi t)`, exact (0, 1, -1) at multiples of a half, so that modes which vanish by symmetry vanish exactly.
#[must_use]
pub fn cos_pi(t: f64) -> f64 {
    let r = (t - 2.0 * (0.5 * t).round()).abs();
    if r <= 0.25 {
        cos(PI * r)
    } else if r < 0.75 {
        sin(PI * (0.5 - r))
    } else {
        -cos(PI * (1.0 - r))
    }
}

/// `sin(pi t)`, exact at multiples of a half.
#[must_use]
pub fn sin_pi(t: f64) -> f64 {
    cos_pi(t - 0.5)
}

/// `sin(pi t) / (pi t)`, 1 at `t = 0`.
#[must_use]
pub fn sinc_pi(t: f64) -> f64 {
    if t == 0.0 { 1.0 } else { sin_pi(t) / (PI * t) }
}

/// Gauss-Legendre points and weights on (-1, 1): exact for polynomials up to degree `2 count - 1`.
///
/// Newton iteration on the Legendre polynomial from the Chebyshev guess.
#[must_use]
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    (0..count)
        .map(|i| {
            let mut x = cos_pi((i as f64 + 0.75) / (count as f64 + 0.5));
            let mut slope = 1.0;
            for _ in 0..100 {
                let (mut p, mut p_before) = (1.0, 0.0);
                for n in 0..count {
                    let n = n as f64;
                    let p_next = ((2.0 * n + 1.0) * x * p - n * p_before) / (n + 1.0);
                    p_before = p;
                    p = p_next;
                }
                slope = count as f64 * (x * p - p_before) / (x * x - 1.0);
                let dx = p / slope;
                x -= dx;
                if dx.abs() < 1e-15 {
                    break;
                }
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}
