//! The cube root of lanes from plus, times, divide and comparison alone, so that it has the same bits everywhere.

use super::Lanes;

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
