//! Matrices and symmetric tensors in lanes: those of the kernel, and what laws alone need.

pub use proctor_kernel::laws::tensor::{
    Configuration, Matrix, determinant, inverse, left_stretch_diagonal, one_plus, product,
    relative_deformation, stretch_diagonal, volume_ratio,
};

use proctor_kernel::lanes::Lanes;

/// Inner product of the first D entries.
#[inline(always)]
pub fn inner<L: Lanes, const D: usize>(a: &[L; 3], b: &[L; 3]) -> L {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum = a[k].mul_add(b[k], sum);
    }
    sum
}

/// Axes of the components of a symmetric tensor in space, in the order of storage.
pub const VOIGT: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// R s R^T with the rotation R = (1 - W/2)^-1 (1 + W/2) of the spin increment W = skew(g).
/// `s` is ordered as a law is given it.
#[inline(always)]
pub fn rotate<L: Lanes, const D: usize>(g: &Matrix<L>, s: &[L; 6]) -> [L; 6] {
    let (half, quarter) = (L::splat(0.5), L::splat(0.25));
    let one = L::splat(1.0);
    let mut out = *s;
    if D == 2 {
        // tan(angle/2) = w/2 with w = W_21.
        let w = half * (g[1][0] - g[0][1]);
        let t2 = quarter * w * w;
        let r = one / (one + t2);
        let (cos, sin) = ((one - t2) * r, w * r);
        let (cc, ss, cs) = (cos * cos, sin * sin, cos * sin);
        let two_cs_xy = (cs + cs) * s[3];
        out[0] = cc * s[0] + ss * s[1] - two_cs_xy;
        out[1] = ss * s[0] + cc * s[1] + two_cs_xy;
        out[3] = cs * (s[0] - s[1]) + (cc - ss) * s[3];
    } else {
        // Axial vector of W; R = 1 + (W + W²/2)/(1 + |w|²/4).
        let w = [
            half * (g[2][1] - g[1][2]),
            half * (g[0][2] - g[2][0]),
            half * (g[1][0] - g[0][1]),
        ];
        let w2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
        let a = one / (one + quarter * w2);
        let b = half * a;
        let c = one - b * w2;
        let r = [
            [
                b * w[0] * w[0] + c,
                b * w[0] * w[1] - a * w[2],
                b * w[0] * w[2] + a * w[1],
            ],
            [
                b * w[1] * w[0] + a * w[2],
                b * w[1] * w[1] + c,
                b * w[1] * w[2] - a * w[0],
            ],
            [
                b * w[2] * w[0] - a * w[1],
                b * w[2] * w[1] + a * w[0],
                b * w[2] * w[2] + c,
            ],
        ];
        let m = [[s[0], s[5], s[4]], [s[5], s[1], s[3]], [s[4], s[3], s[2]]];
        let rm = product::<L, 3>(&r, &m);
        for (slot, (i, j)) in VOIGT.into_iter().enumerate() {
            out[slot] = rm[i][0] * r[j][0] + rm[i][1] * r[j][1] + rm[i][2] * r[j][2];
        }
    }
    out
}

/// Mean stress and deviator of a stress, ordered as a law is given it.
#[inline(always)]
#[must_use]
pub fn deviator<L: Lanes, const D: usize>(s: &[L; 6]) -> (L, [L; 6]) {
    let mean = (s[0] + s[1] + s[2]) * L::splat(1.0 / 3.0);
    let mut deviator = *s;
    for entry in &mut deviator[..3] {
        *entry = *entry - mean;
    }
    (mean, deviator)
}

/// The second invariant of a deviator, s : s / 2.
#[inline(always)]
#[must_use]
pub fn second_invariant<L: Lanes, const D: usize>(s: &[L; 6]) -> L {
    let half = L::splat(0.5);
    let mut sum = half * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    for entry in &s[3..components(D)] {
        sum = entry.mul_add(*entry, sum);
    }
    sum
}

/// Number of components of a symmetric tensor in the plane, where zz is one of them, and in space.
#[inline(always)]
#[must_use]
pub const fn components(axes: usize) -> usize {
    if axes == 2 { 4 } else { 6 }
}
