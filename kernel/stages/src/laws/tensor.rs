//! Matrices in lanes, and the kinematics of one step.
//!
//! `g` is the velocity gradient times the time step, G = dt L. The relative deformation gradient of the step is
//! f = 1 + G where L was evaluated on the positions at the beginning of the step (USL, MUSL: x_n+1 = x_n +
//! dt v), and f = (1 - G)^-1 where it was evaluated at its end (USF: x_n-1 = x_n - dt v). With these a rigid
//! rotation of the particles gives a rigid rotation of F and of the stress whatever the step, and det F follows
//! the volume that the particles span.

use crate::lanes::Lanes;

/// A matrix of lanes; the leading 2x2 block in two dimensions.
pub type Matrix<L> = [[L; 3]; 3];

/// Configuration of a gradient: the positions at the beginning or the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// f = 1 + G.
    Beginning,
    /// f = (1 - G)^-1.
    End,
}

/// Determinant of 1 + s G.
#[inline(always)]
pub(crate) fn determinant_of_one_plus<L: Lanes, const D: usize>(g: &Matrix<L>, s: f64) -> L {
    determinant::<L, D>(&one_plus::<L, D>(g, s))
}

/// 1 + s G.
#[inline(always)]
pub fn one_plus<L: Lanes, const D: usize>(g: &Matrix<L>, s: f64) -> Matrix<L> {
    let (one, s) = (L::splat(1.0), L::splat(s));
    let mut m = *g;
    for i in 0..D {
        for j in 0..D {
            m[i][j] = if i == j {
                s.mul_add(g[i][j], one)
            } else {
                s * g[i][j]
            };
        }
    }
    m
}

/// Determinant of the leading D x D block.
#[inline(always)]
pub fn determinant<L: Lanes, const D: usize>(m: &Matrix<L>) -> L {
    if D == 2 {
        m[0][0] * m[1][1] - m[0][1] * m[1][0]
    } else {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    }
}

/// Inverse of the leading D x D block.
#[inline(always)]
pub fn inverse<L: Lanes, const D: usize>(m: &Matrix<L>) -> Matrix<L> {
    let r = L::splat(1.0) / determinant::<L, D>(m);
    let mut out = *m;
    if D == 2 {
        out[0][0] = m[1][1] * r;
        out[0][1] = -(m[0][1] * r);
        out[1][0] = -(m[1][0] * r);
        out[1][1] = m[0][0] * r;
    } else {
        for i in 0..3 {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            for j in 0..3 {
                let (c, d) = ((j + 1) % 3, (j + 2) % 3);
                // Cyclic indices give the sign of the cofactor.
                out[j][i] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) * r;
            }
        }
    }
    out
}

/// Product of the leading D x D blocks.
#[inline(always)]
pub fn product<L: Lanes, const D: usize>(a: &Matrix<L>, b: &Matrix<L>) -> Matrix<L> {
    let mut out = *a;
    for i in 0..D {
        for j in 0..D {
            let mut sum = a[i][0] * b[0][j];
            for k in 1..D {
                sum = a[i][k].mul_add(b[k][j], sum);
            }
            out[i][j] = sum;
        }
    }
    out
}

/// Relative deformation gradient of the step.
#[inline(always)]
pub fn relative_deformation<L: Lanes, const D: usize>(
    g: &Matrix<L>,
    at: Configuration,
) -> Matrix<L> {
    match at {
        Configuration::Beginning => one_plus::<L, D>(g, 1.0),
        Configuration::End => inverse::<L, D>(&one_plus::<L, D>(g, -1.0)),
    }
}

/// Ratio of volumes over the step, det f.
#[inline(always)]
pub fn volume_ratio<L: Lanes, const D: usize>(g: &Matrix<L>, at: Configuration) -> L {
    match at {
        Configuration::Beginning => determinant_of_one_plus::<L, D>(g, 1.0),
        Configuration::End => L::splat(1.0) / determinant_of_one_plus::<L, D>(g, -1.0),
    }
}

/// Rotation R of the polar decomposition F = R U = V R; the leading block, and 1 beyond it.
#[inline(always)]
fn polar_rotation<L: Lanes, const D: usize>(f: &Matrix<L>) -> Matrix<L> {
    let (one, zero) = (L::splat(1.0), L::splat(0.0));
    let half = L::splat(0.5);
    if D == 2 {
        let (c, s) = (f[0][0] + f[1][1], f[1][0] - f[0][1]);
        let r = one / (c * c + s * s).sqrt();
        let (c, s) = (c * r, s * r);
        [[c, -s, zero], [s, c, zero], [zero, zero, one]]
    } else {
        // Newton's iteration R <- (R + R^-T)/2 (Higham 1986); nine steps reach round-off for stretches up to
        // about 10.
        let mut r = *f;
        for _ in 0..9 {
            let inverse = inverse::<L, 3>(&r);
            for i in 0..3 {
                for j in 0..3 {
                    r[i][j] = half * (r[i][j] + inverse[j][i]);
                }
            }
        }
        // `r` was updated row by row from an inverse taken before, so no entry is used twice.
        r
    }
}

/// Diagonal of the right stretch tensor U = R^T F, along the axes that the particle had at the start.
#[inline(always)]
pub fn stretch_diagonal<L: Lanes, const D: usize>(f: &Matrix<L>) -> [L; 3] {
    let r = polar_rotation::<L, D>(f);
    let mut u = [L::splat(1.0); 3];
    for i in 0..D {
        u[i] = r[0][i] * f[0][i] + r[1][i] * f[1][i];
        if D == 3 {
            u[i] = u[i] + r[2][i] * f[2][i];
        }
    }
    u
}

/// Diagonal of the left stretch tensor V = F R^T, along the axes of space: the one that a domain along these axes
/// follows when a stretched particle turns.
#[inline(always)]
pub fn left_stretch_diagonal<L: Lanes, const D: usize>(f: &Matrix<L>) -> [L; 3] {
    let r = polar_rotation::<L, D>(f);
    let mut v = [L::splat(1.0); 3];
    for i in 0..D {
        v[i] = f[i][0] * r[i][0] + f[i][1] * r[i][1];
        if D == 3 {
            v[i] = v[i] + f[i][2] * r[i][2];
        }
    }
    v
}
