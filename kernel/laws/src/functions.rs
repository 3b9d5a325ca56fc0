//! Functions of lanes from plus, times, divide and comparison alone, so that they have the same bits everywhere.

use proctor_kernel::lanes::Lanes;

/// 1/n! from n = 0.
const INVERSE_FACTORIALS: [f64; 23] = inverse_factorials();

const fn inverse_factorials() -> [f64; 23] {
    let mut all = [1.0; 23];
    // Factorials up to 22! are whole numbers of f64, so that each quotient is rounded once.
    let (mut factorial, mut n) = (1.0, 1);
    while n < 23 {
        factorial *= n as f64;
        all[n] = 1.0 / factorial;
        n += 1;
    }
    all
}

/// Largest argument of [`exp`] in magnitude.
const LARGEST_EXPONENT: f64 = 708.0;

/// e^x within two units in the last place. Arguments beyond ±708 count as that number; NaN stays NaN.
#[inline(always)]
pub fn exp<L: Lanes>(x: L) -> L {
    // x = n ln 2 + r with |r| <= ln 2 / 2; ln 2 in two parts, of which the first has so few bits that n times it is exact.
    const HIGH: f64 = 0.693_147_180_369_123_8;
    const LOW: f64 = 1.908_214_929_270_587_7e-10;
    const TERMS: usize = 14;
    // The second operand is taken where a comparison is false, and so a NaN is.
    let x = L::splat(LARGEST_EXPONENT).min(L::splat(-LARGEST_EXPONENT).max(x));
    let n = x
        .mul_add(L::splat(std::f64::consts::LOG2_E), L::splat(0.5))
        .floor();
    let r = n.mul_add(L::splat(-LOW), n.mul_add(L::splat(-HIGH), x));
    let mut sum = L::splat(INVERSE_FACTORIALS[TERMS - 1]);
    for i in (0..TERMS - 1).rev() {
        sum = sum.mul_add(r, L::splat(INVERSE_FACTORIALS[i]));
    }
    sum * n.power_of_two()
}

/// Sine and cosine of an angle from 0 to a quarter turn \[rad\], within two units in the last place of 1.
#[inline(always)]
pub fn sine_and_cosine<L: Lanes>(angle: L) -> (L, L) {
    // Terms of even order, and those of odd order divided by the angle; the last are those of order 22 and 21.
    let square = -(angle * angle);
    let mut cosine = L::splat(INVERSE_FACTORIALS[22]);
    let mut sine = L::splat(INVERSE_FACTORIALS[21]);
    for half in (0..11).rev() {
        cosine = cosine.mul_add(square, L::splat(INVERSE_FACTORIALS[2 * half]));
        if half < 10 {
            sine = sine.mul_add(square, L::splat(INVERSE_FACTORIALS[2 * half + 1]));
        }
    }
    (sine * angle, cosine)
}

/// Natural logarithm within two units in the last place. 0 and less give that of the smallest positive number of full
/// precision, infinity that of the largest number; NaN stays NaN.
#[inline(always)]
pub fn ln<L: Lanes>(x: L) -> L {
    // ln 2 in two parts, of which the first has so few bits that n times it is exact.
    const HIGH: f64 = 0.693_147_180_369_123_8;
    const LOW: f64 = 1.908_214_929_270_587_7e-10;
    const TERMS: usize = 11;
    let (zero, one, half) = (L::splat(0.0), L::splat(1.0), L::splat(0.5));
    // The second operand is taken where a comparison is false, and so a NaN is.
    let x = L::splat(f64::MAX).min(L::splat(f64::MIN_POSITIVE).max(x));
    // x = 2^n m with m from 1 to 2, and then from sqrt(1/2) to sqrt(2).
    let (mut m, mut n) = x.mantissa_and_exponent();
    let is_high = L::splat(std::f64::consts::SQRT_2).lt(m);
    m = m * L::select(is_high, half, one);
    n = n + L::select(is_high, one, zero);
    // ln m = 2 artanh z with z = (m - 1)/(m + 1), |z| < 0.172: z (2 + 2 z²/3 + 2 z⁴/5 + ...).
    let z = (m - one) / (m + one);
    let square = z * z;
    let mut sum = L::splat(2.0 / (2 * TERMS + 1) as f64);
    for i in (1..TERMS).rev() {
        sum = sum.mul_add(square, L::splat(2.0 / (2 * i + 1) as f64));
    }
    // m - 1 is exact near 1, where it is the larger part: ln m = (m - 1) - z ((m - 1) - z² sum).
    let excess = m - one;
    let rest = z * (excess - square * sum);
    let ln = n.mul_add(L::splat(HIGH), excess - (rest - n * L::splat(LOW)));
    L::select(x.eq(x), ln, x)
}
