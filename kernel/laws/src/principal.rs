//! Principal values and directions of symmetric tensors in lanes, from plus, times, divide and square root alone.
//!
//! The value that lies apart from the other two is found first, by a polynomial in the place of cos(acos(r)/3) and one step
//! of Newton's method; its direction is a cross product; the other two follow from a rotation in the plane across it. So
//! values and directions are exact to round-off also where two values are equal, as in every triaxial and oedometric
//! state, where the trigonometric form loses half of the digits.

use super::tensor::{VOIGT, components};
use proctor_kernel::lanes::Lanes;

/// A symmetric tensor as the sum of its principal values times the squares n n^T of their directions.
#[derive(Clone, Copy, Debug)]
pub struct Spectrum<L> {
    /// Principal values, the largest first.
    pub values: [L; 3],
    /// n n^T of each, ordered as a law is given a stress: xx, yy, zz, yz, xz, xy in space and xx, yy, zz, xy in the plane.
    pub squares: [[L; 6]; 3],
}

impl<L: Lanes> Spectrum<L> {
    /// The tensor that has these directions and other values.
    #[inline(always)]
    #[must_use]
    pub fn with<const D: usize>(&self, values: &[L; 3]) -> [L; 6] {
        let mut out = [L::splat(0.0); 6];
        for slot in 0..components(D) {
            let sum = values[0] * self.squares[0][slot];
            let sum = values[1].mul_add(self.squares[1][slot], sum);
            out[slot] = values[2].mul_add(self.squares[2][slot], sum);
        }
        out
    }
}

/// Principal values and directions of a tensor, ordered as a law is given a stress.
#[inline(always)]
pub fn spectrum<L: Lanes, const D: usize>(s: &[L; 6]) -> Spectrum<L> {
    if D == 2 { in_plane(s) } else { in_space(s) }
}

/// The largest magnitude of the first `count` components; 1 where all are zero.
#[inline(always)]
fn scale_of<L: Lanes>(s: &[L; 6], count: usize) -> L {
    let zero = L::splat(0.0);
    let mut scale = zero;
    for entry in &s[..count] {
        scale = scale.max(entry.abs());
    }
    L::select(zero.lt(scale), scale, L::splat(1.0))
}

/// cos and sin of twice the angle of the larger value in a plane, and half the difference of both values, of half the
/// difference of the diagonal entries and the entry beside the diagonal.
#[inline(always)]
fn double_angle<L: Lanes>(half_difference: L, beside: L) -> (L, L, L) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let radius = half_difference
        .mul_add(half_difference, beside * beside)
        .sqrt();
    let round = radius.eq(zero);
    let inverse = one / L::select(round, one, radius);
    let cos = L::select(round, one, half_difference * inverse);
    let sin = L::select(round, zero, beside * inverse);
    (cos, sin, radius)
}

#[inline(always)]
fn in_plane<L: Lanes>(s: &[L; 6]) -> Spectrum<L> {
    let (zero, one, half) = (L::splat(0.0), L::splat(1.0), L::splat(0.5));
    let scale = scale_of(s, 4);
    let inverse = one / scale;
    let (xx, yy, xy) = (s[0] * inverse, s[1] * inverse, s[3] * inverse);
    let mean = half * (xx + yy);
    let (cos, sin, radius) = double_angle(half * (xx - yy), xy);
    let beside = half * sin;
    let along = [
        half + half * cos,
        half - half * cos,
        zero,
        beside,
        zero,
        zero,
    ];
    let across = [
        half - half * cos,
        half + half * cos,
        zero,
        -beside,
        zero,
        zero,
    ];
    let normal = [zero, zero, one, zero, zero, zero];
    let (most, least) = ((mean + radius) * scale, (mean - radius) * scale);
    // The value across the plane comes before, between or behind the other two.
    let (before, behind) = (most.lt(s[2]), s[2].lt(least));
    let mut squares = [along, normal, across];
    for slot in 0..4 {
        squares[0][slot] = L::select(before, normal[slot], along[slot]);
        squares[2][slot] = L::select(behind, normal[slot], across[slot]);
        squares[1][slot] = L::select(
            before,
            along[slot],
            L::select(behind, across[slot], normal[slot]),
        );
    }
    Spectrum {
        values: [
            L::select(before, s[2], most),
            L::select(before, most, L::select(behind, least, s[2])),
            L::select(behind, s[2], least),
        ],
        squares,
    }
}

/// cos(acos(r)/3) for r from 0 to 1 as a polynomial in 2 r - 1: analytic there, for its root lies at r = -1. Within 1e-15.
const COSINE_OF_THIRD: [f64; 17] = [
    0.939_692_620_785_908_3,
    0.065_821_807_272_443_38,
    -0.006_431_413_987_654_575,
    0.001_106_654_956_141_135_5,
    -2.336_452_796_658_349_4e-4,
    5.491_441_440_809_568_5e-5,
    -1.379_127_581_073_717_3e-5,
    3.623_315_824_898_691e-6,
    -9.835_504_935_349_355e-7,
    2.735_905_669_869_242_4e-7,
    -7.760_977_052_478_498e-8,
    2.253_581_468_393_558_6e-8,
    -6.593_775_319_539_05e-9,
    1.763_565_217_530_344_3e-9,
    -5.160_232_982_070_494e-10,
    2.590_156_856_360_555_3e-10,
    -8.057_775_073_018_45e-11,
];

#[inline(always)]
fn in_space<L: Lanes>(s: &[L; 6]) -> Spectrum<L> {
    let (zero, one, half) = (L::splat(0.0), L::splat(1.0), L::splat(0.5));
    let third = L::splat(1.0 / 3.0);
    let whole = scale_of(s, 6);
    let inverse = one / whole;
    let t = scaled(s, inverse);
    let mean = (t[0] + t[1] + t[2]) * third;
    // The deviator has a scale of its own: under a great pressure it is small.
    let deviator = [t[0] - mean, t[1] - mean, t[2] - mean, t[3], t[4], t[5]];
    let own = scale_of(&deviator, 6);
    let b = scaled(&deviator, one / own);
    let [xx, yy, zz, yz, xz, xy] = b;
    let j2 = half * (xx * xx + yy * yy + zz * zz) + (yz * yz + xz * xz + xy * xy);
    let det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);

    // Which end lies apart; there the tensor is turned over so that it is the largest.
    let lowest = det.lt(zero);
    let sign = L::select(lowest, -one, one);
    let det = det.abs();
    let q2 = j2 * third;
    let q = q2.sqrt();
    let tiny = L::splat(1e-300);
    let r = (det / (L::splat(2.0) * q2 * q).max(tiny)).min(one);
    let x = r + r - one;
    let mut cosine = L::splat(COSINE_OF_THIRD[16]);
    for i in (0..16).rev() {
        cosine = cosine.mul_add(x, L::splat(COSINE_OF_THIRD[i]));
    }
    let apart = (q + q) * cosine;
    // l³ - 3 q² l - det = 0, whose slope is at least 6 q² here.
    let square = apart * apart;
    let three = L::splat(3.0);
    let miss = (square - three * q2) * apart - det;
    let apart = apart - miss / (three * (square - q2)).max(tiny);

    let n = direction(&b, sign * apart);
    // The other two in the plane across it: two directions there, and the tensor in them.
    let first = across(&n);
    let second = cross(&n, &first);
    let image = [
        xx * first[0] + xy * first[1] + xz * first[2],
        xy * first[0] + yy * first[1] + yz * first[2],
        xz * first[0] + yz * first[1] + zz * first[2],
    ];
    let image_of_second = [
        xx * second[0] + xy * second[1] + xz * second[2],
        xy * second[0] + yy * second[1] + yz * second[2],
        xz * second[0] + yz * second[1] + zz * second[2],
    ];
    let (p, m, o) = (
        dot(&image, &first),
        dot(&image_of_second, &second),
        dot(&image, &second),
    );
    let (cos, sin, radius) = double_angle(half * (p - m), o);
    let middle = half * (p + m);
    // n n^T of the larger one, (1 + cos)/2 u u + sin/2 (u v + v u) + (1 - cos)/2 v v, and what is left for the other.
    let mut squares = [[zero; 6]; 3];
    for (slot, (i, j)) in VOIGT.into_iter().enumerate() {
        let uu = first[i] * first[j];
        let vv = second[i] * second[j];
        let uv = half * (first[i] * second[j] + first[j] * second[i]);
        let sum = half * (uu + vv);
        let turned = half * cos * (uu - vv) + sin * uv;
        let of_apart = n[i] * n[j];
        let (more, less) = (sum + turned, sum - turned);
        squares[0][slot] = L::select(lowest, more, of_apart);
        squares[1][slot] = L::select(lowest, less, more);
        squares[2][slot] = L::select(lowest, of_apart, less);
    }
    let apart = sign * apart;
    let (more, less) = (middle + radius, middle - radius);
    let values = [
        L::select(lowest, more, apart),
        L::select(lowest, less, more),
        L::select(lowest, apart, less),
    ];
    Spectrum {
        values: [
            values[0].mul_add(own, mean) * whole,
            values[1].mul_add(own, mean) * whole,
            values[2].mul_add(own, mean) * whole,
        ],
        squares,
    }
}

#[inline(always)]
fn scaled<L: Lanes>(s: &[L; 6], by: L) -> [L; 6] {
    let mut out = *s;
    for entry in &mut out {
        *entry = *entry * by;
    }
    out
}

#[inline(always)]
fn dot<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> L {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Direction of a value of the tensor `b` that lies apart from the others: the longest cross product of two rows of
/// b - value; x where all are zero, which is so where b is.
#[inline(always)]
fn direction<L: Lanes>(b: &[L; 6], value: L) -> [L; 3] {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let rows = [
        [b[0] - value, b[5], b[4]],
        [b[5], b[1] - value, b[3]],
        [b[4], b[3], b[2] - value],
    ];
    let mut longest = cross(&rows[0], &rows[1]);
    let mut square = dot(&longest, &longest);
    for (i, j) in [(1, 2), (2, 0)] {
        let other = cross(&rows[i], &rows[j]);
        let other_square = dot(&other, &other);
        let longer = square.lt(other_square);
        for axis in 0..3 {
            longest[axis] = L::select(longer, other[axis], longest[axis]);
        }
        square = L::select(longer, other_square, square);
    }
    // The tensor has a largest entry of 1, so that a cross product this short is that of a zero tensor.
    let none = square.lt(L::splat(1e-30));
    let inverse = one / L::select(none, one, square).sqrt();
    [
        L::select(none, one, longest[0] * inverse),
        L::select(none, zero, longest[1] * inverse),
        L::select(none, zero, longest[2] * inverse),
    ]
}

/// A direction across `n`.
#[inline(always)]
fn across<L: Lanes>(n: &[L; 3]) -> [L; 3] {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    // Across x or y, whichever is less along n: the other two entries are not both small.
    let along_y = n[0].abs().lt(n[1].abs());
    let (a, b) = (L::select(along_y, n[1], n[0]), n[2]);
    let inverse = one / (a * a + b * b).sqrt();
    let (a, b) = (a * inverse, b * inverse);
    [
        L::select(along_y, zero, -b),
        L::select(along_y, b, zero),
        L::select(along_y, -a, a),
    ]
}
