//! Stress and deformation update of one particle, in lanes.
//!
//! `g` is the velocity gradient times the time step, G = dt L. The relative deformation gradient of the step is
//! f = 1 + G where L was evaluated on the positions at the beginning of the step (USL, MUSL: x_n+1 = x_n +
//! dt v), and f = (1 - G)^-1 where it was evaluated at its end (USF: x_n-1 = x_n - dt v). With these a rigid
//! rotation of the particles gives a rigid rotation of F and of the stress whatever the step, and det F follows
//! the volume that the particles span.

use crate::lanes::{Backend, Kernel, Lanes, Selected};
use crate::scene::{Law, ObjectiveRate};

/// A matrix of lanes; the leading 2x2 block in two dimensions.
pub type Matrix<L> = [[L; 3]; 3];

/// Constants of a law that the update needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Which update.
    pub kind: Kind,
    /// First Lamé parameter \[Pa\].
    pub lambda: f64,
    /// Shear modulus \[Pa\].
    pub shear: f64,
    /// Initial density \[kg/m³\].
    pub density: f64,
}

/// Kinds of update.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Hypoelastic with the Hughes-Winget rotation.
    HughesWinget,
    /// Hypoelastic with the forward Jaumann rate.
    JaumannForward,
    /// Compressible neo-Hookean.
    NeoHookean,
}

impl Parameters {
    /// Constants of a material.
    #[must_use]
    pub fn new(law: Law, density: f64) -> Self {
        let kind = match law {
            Law::LinearElastic {
                rate: ObjectiveRate::HughesWinget,
                ..
            } => Kind::HughesWinget,
            Law::LinearElastic {
                rate: ObjectiveRate::JaumannForward,
                ..
            } => Kind::JaumannForward,
            Law::NeoHookean { .. } => Kind::NeoHookean,
        };
        Self {
            kind,
            lambda: law.lambda(),
            shear: law.shear(),
            density,
        }
    }

    /// P-wave speed at rest, sqrt((lambda + 2 G)/rho_0) \[m/s\].
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        ((self.lambda + 2.0 * self.shear) / self.density).sqrt()
    }

    /// [`neo_hookean_speed_squared`] of one deformation gradient \[m²/s²\].
    #[must_use]
    pub fn wave_speed_squared(&self, f: &[[f64; 3]; 3]) -> f64 {
        struct One<'a>(&'a Parameters, &'a [[f64; 3]; 3]);
        impl Kernel for One<'_> {
            type Output = f64;
            #[inline(always)]
            fn run<B: Backend>(self) -> f64 {
                // Not `map`, which the compiler may leave as a call, and with it each `splat`.
                let mut f = [[B::Native::splat(0.0); 3]; 3];
                for (row, given) in f.iter_mut().zip(self.1) {
                    for (value, given) in row.iter_mut().zip(given) {
                        *value = B::Native::splat(*given);
                    }
                }
                let mut all = [0.0; 8];
                neo_hookean_speed_squared::<B::Native, 3>(
                    self.0,
                    &f,
                    determinant::<B::Native, 3>(&f),
                )
                .store(&mut all);
                all[0]
            }
        }
        Selected::any().run(One(self, f))
    }

    /// Strain energy density of a stress state of the hypoelastic laws, sigma : C^-1 : sigma / 2 \[J/m³\];
    /// stress xx, yy, zz, yz, xz, xy.
    #[must_use]
    pub fn energy_density_of_stress(&self, s: &[f64; 6]) -> f64 {
        let trace = s[0] + s[1] + s[2];
        let square = s[0] * s[0]
            + s[1] * s[1]
            + s[2] * s[2]
            + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
        let bulk3 = 3.0 * self.lambda + 2.0 * self.shear;
        (square - self.lambda / bulk3 * trace * trace) / (4.0 * self.shear)
    }

    /// Strain energy of the neo-Hookean law per initial volume,
    /// mu/2 (tr F F^T - 3) - mu ln J + lambda/2 (ln J)² \[J/m³\].
    #[must_use]
    pub fn energy_density_of_stretch(&self, trace_b: f64, j: f64) -> f64 {
        let ln_j = libm::log(j);
        0.5 * self.shear * (trace_b - 3.0) - self.shear * ln_j + 0.5 * self.lambda * ln_j * ln_j
    }
}

/// Whether the gradient belongs to the positions at the beginning or the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// f = 1 + G.
    Beginning,
    /// f = (1 - G)^-1.
    End,
}

/// Determinant of 1 + s G.
#[inline(always)]
pub fn determinant_of_one_plus<L: Lanes, const D: usize>(g: &Matrix<L>, s: f64) -> L {
    determinant::<L, D>(&one_plus::<L, D>(g, s))
}

#[inline(always)]
fn one_plus<L: Lanes, const D: usize>(g: &Matrix<L>, s: f64) -> Matrix<L> {
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

/// Stress of the hypoelastic laws after the step. `s` is xx, yy, zz, yz, xz, xy in 3D and xx, yy, zz, xy in its
/// first four entries in 2D.
#[inline(always)]
pub fn hypoelastic<L: Lanes, const D: usize>(
    law: &Parameters,
    g: &Matrix<L>,
    at: Configuration,
    s: &[L; 6],
) -> [L; 6] {
    if law.kind == Kind::JaumannForward {
        return jaumann_forward::<L, D>(law, g, s);
    }
    // Hughes and Winget 1980: strain increment and spin on the midpoint configuration,
    // G_mid = 2 (f - 1)(f + 1)^-1, which is G (1 + G/2)^-1 or G (1 - G/2)^-1.
    let half = match at {
        Configuration::Beginning => 0.5,
        Configuration::End => -0.5,
    };
    let g_mid = product::<L, D>(g, &inverse::<L, D>(&one_plus::<L, D>(g, half)));
    let rotated = rotate::<L, D>(&g_mid, s);
    add_elastic::<L, D>(law, &g_mid, &rotated)
}

/// sigma + lambda tr(e) 1 + 2 G e with e = sym(g).
#[inline(always)]
fn add_elastic<L: Lanes, const D: usize>(law: &Parameters, g: &Matrix<L>, s: &[L; 6]) -> [L; 6] {
    let shear = L::splat(law.shear);
    let shear2 = L::splat(2.0 * law.shear);
    let mut trace = g[0][0] + g[1][1];
    if D == 3 {
        trace = trace + g[2][2];
    }
    let pressure = L::splat(law.lambda) * trace;
    let mut out = *s;
    for i in 0..3 {
        out[i] = s[i] + pressure;
        if i < D {
            out[i] = shear2.mul_add(g[i][i], out[i]);
        }
    }
    if D == 2 {
        out[3] = shear.mul_add(g[0][1] + g[1][0], s[3]);
    } else {
        out[3] = shear.mul_add(g[1][2] + g[2][1], s[3]);
        out[4] = shear.mul_add(g[0][2] + g[2][0], s[4]);
        out[5] = shear.mul_add(g[0][1] + g[1][0], s[5]);
    }
    out
}

/// Axes of the components of a symmetric tensor in space, in the order of storage.
const VOIGT: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// R s R^T with the rotation R = (1 - W/2)^-1 (1 + W/2) of the spin increment W = skew(g).
#[inline(always)]
fn rotate<L: Lanes, const D: usize>(g: &Matrix<L>, s: &[L; 6]) -> [L; 6] {
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

/// sigma + (W sigma - sigma W) + C : D, all at the beginning of the step (technical manual, algorithm 2,
/// lines 19-22). The in-plane deviator grows by about 8 pi²/N per turn of N steps.
#[inline(always)]
fn jaumann_forward<L: Lanes, const D: usize>(
    law: &Parameters,
    g: &Matrix<L>,
    s: &[L; 6],
) -> [L; 6] {
    let half = L::splat(0.5);
    let two = L::splat(2.0);
    let mut out = add_elastic::<L, D>(law, g, s);
    if D == 2 {
        let w = half * (g[0][1] - g[1][0]);
        out[0] = out[0] + two * w * s[3];
        out[1] = out[1] - two * w * s[3];
        out[3] = out[3] + w * (s[1] - s[0]);
    } else {
        let m = [[s[0], s[5], s[4]], [s[5], s[1], s[3]], [s[4], s[3], s[2]]];
        let mut w = *g;
        for i in 0..3 {
            for j in 0..3 {
                w[i][j] = half * (g[i][j] - g[j][i]);
            }
        }
        for (slot, (i, j)) in VOIGT.into_iter().enumerate() {
            let mut turned = w[i][0] * m[0][j] + w[j][0] * m[0][i];
            for k in 1..3 {
                turned = turned + w[i][k] * m[k][j] + w[j][k] * m[k][i];
            }
            out[slot] = out[slot] + turned;
        }
    }
    out
}

/// Stress of the neo-Hookean law, sigma = (mu (F F^T - 1) + lambda ln J 1)/J, plane strain in 2D.
#[inline(always)]
pub fn neo_hookean<L: Lanes, const D: usize>(law: &Parameters, f: &Matrix<L>, j: L) -> [L; 6] {
    let zero = L::splat(0.0);
    let mut out = [zero; 6];
    let r = L::splat(1.0) / j;
    let mu = L::splat(law.shear) * r;
    let volumetric = L::splat(law.lambda) * j.map(libm::log) * r - mu;
    out[0] = mu.mul_add(inner::<L, D>(&f[0], &f[0]), volumetric);
    out[1] = mu.mul_add(inner::<L, D>(&f[1], &f[1]), volumetric);
    if D == 2 {
        out[2] = mu + volumetric;
        out[3] = mu * inner::<L, D>(&f[0], &f[1]);
    } else {
        out[2] = mu.mul_add(inner::<L, D>(&f[2], &f[2]), volumetric);
        out[3] = mu * inner::<L, D>(&f[1], &f[2]);
        out[4] = mu * inner::<L, D>(&f[0], &f[2]);
        out[5] = mu * inner::<L, D>(&f[0], &f[1]);
    }
    out
}

/// Inner product of the first D entries.
#[inline(always)]
fn inner<L: Lanes, const D: usize>(a: &[L; 3], b: &[L; 3]) -> L {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum = a[k].mul_add(b[k], sum);
    }
    sum
}

/// Squared wave speed of the neo-Hookean law, bounded from above for every direction:
/// c² <= (mu b_max + max(lambda (1 - ln J) + mu, 0))/rho_0, the spatial speed along the largest principal stretch
/// of a longitudinal wave or, beyond J = exp(1 + mu/lambda), of a transverse one, with b_max <= m + s sqrt(D - 1) from mean and spread of the eigenvalues of b = F F^T
/// (Wolkowicz and Styan 1980).
#[inline(always)]
pub fn neo_hookean_speed_squared<L: Lanes, const D: usize>(
    law: &Parameters,
    f: &Matrix<L>,
    j: L,
) -> L {
    let mut trace = L::splat(0.0);
    let mut trace_of_square = L::splat(0.0);
    for a in 0..D {
        for b in 0..D {
            let entry = inner::<L, D>(&f[a], &f[b]);
            if a == b {
                trace = trace + entry;
            }
            trace_of_square = entry.mul_add(entry, trace_of_square);
        }
    }
    let share = L::splat(1.0 / D as f64);
    let mean = trace * share;
    let spread = (trace_of_square * share - mean * mean)
        .max(L::splat(0.0))
        .sqrt();
    let largest = L::splat((D as f64 - 1.0).sqrt()).mul_add(spread, mean);
    let (mu, lambda) = (L::splat(law.shear), L::splat(law.lambda));
    let longitudinal = (lambda * (L::splat(1.0) - j.map(libm::log)) + mu).max(L::splat(0.0));
    mu.mul_add(largest, longitudinal) / L::splat(law.density)
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

#[cfg(test)]
mod tests;
