//! Functions of lanes from plus, times, divide and comparison alone, so that they have the same bits everywhere.

use super::Lanes;

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
pub(crate) const LARGEST_EXPONENT: f64 = 708.0;

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

/// 2^512, 2^256, ... 2^1.
const POWERS: [f64; 10] = {
    let mut all = [2.0; 10];
    let mut i = 9;
    while i > 0 {
        all[i - 1] = all[i] * all[i];
        i -= 1;
    }
    all
};

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

/// Cube root, rounded as the exact one is but for a number in 2^50 or so, of which the exact root lies next to the middle of
/// two numbers; zero, infinity and NaN stay what they are.
#[inline(always)]
pub fn cbrt<L: Lanes>(x: L) -> L {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let size = x.abs();
    // |x| = 8^n m with m from 1 to 8, bit by bit of |n|.
    let (mut m, mut scale) = (size, one);
    for (cube, root) in CUBES.into_iter().zip(&POWERS[1..]) {
        let is_less = m.lt(L::splat(cube));
        m = m * L::select(is_less, one, L::splat(1.0 / cube));
        scale = scale * L::select(is_less, one, L::splat(*root));
        let is_small = m.lt(L::splat(8.0 / cube));
        m = m * L::select(is_small, L::splat(cube), one);
        scale = scale * L::select(is_small, L::splat(1.0 / *root), one);
    }
    // m^(5/16) differs by a factor of at most 8^(1/48), and by 2.2 % from its mean. Twice Halley's y (y³ + 2 m)/(2 y³ + m),
    // which leaves 2/3 of the third power of an error: 7e-6, and then round-off.
    let fourth = m.sqrt().sqrt();
    let mut y = fourth * fourth.sqrt().sqrt() * L::splat(HALF_OF_THE_WAY);
    for _ in 0..2 {
        let cube = y * y * y;
        y = y * ((cube + m + m) / (cube + cube + m));
    }
    // Newton's step from y³ in twice as many digits.
    let square = y * y;
    let of_square = y.mul_add(y, -square);
    let cube = square * y;
    let of_cube = of_square.mul_add(y, square.mul_add(y, -cube));
    let missed = (m - cube) - of_cube;
    let root = (y + missed / (L::splat(3.0) * square)) * scale;
    let root = L::select(x.lt(zero), -root, root);
    let is_number = zero.lt(size);
    let is_finite = size.lt(L::splat(f64::INFINITY));
    L::select(is_number, L::select(is_finite, root, x), x)
}

/// 8^(1/96).
const HALF_OF_THE_WAY: f64 = 1.021_897_148_654_116_6;

/// 8^256, 8^128, ... 8^1.
const CUBES: [f64; 9] = {
    let mut all = [8.0; 9];
    let mut i = 8;
    while i > 0 {
        all[i - 1] = all[i] * all[i];
        i -= 1;
    }
    all
};
