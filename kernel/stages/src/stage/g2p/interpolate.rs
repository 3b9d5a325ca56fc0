//! Sums over the nodes that a block of particles reaches, lanes = particles.

use super::differences::Differences;
use super::reach::{BlockReach, Rows};
use super::three_nodes::interpolate_group;
use super::values::{InterpolatedValues, group, keep};
use crate::lanes::Lanes;
use crate::laws::HOOP;
use crate::stage::{Block, Mapping, radii, weights_of};
use crate::weights::Family;

/// Interpolates to one block, with `ON_NODES` from the nodes of [`Bases::before`](super::reach::Bases::before). It writes
/// the values of the chosen sums, from particle `to` on, and leaves the others.
#[inline(always)]
pub(super) fn interpolate<
    L: Lanes,
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
    const MOVE: bool,
    const RADIAL: bool,
    const R: usize,
    const ON_NODES: bool,
>(
    columns: &[&mut [f64]],
    mapping: &Mapping,
    reach: &BlockReach<'_, L, R>,
    block: &Block<L>,
    at: usize,
    to: usize,
    values: &mut InterpolatedValues,
) {
    let [w, g, q] = factors::<L, D, N, APIC, ON_NODES, RADIAL>(columns, mapping, block, at);
    // A particle of a hat that lies on a node has the operations of the others of its group, which reach two nodes.
    if N == 3 && !ON_NODES {
        let differences = Differences::new::<D, N>(&w, &g, &q);
        interpolate_group::<L, D, KICK, GRADIENT, APIC, UPPER, MOVE, RADIAL, R>(
            mapping,
            reach,
            &differences,
            to,
            values,
        );
        if RADIAL && GRADIENT {
            hoop_rate(mapping, block, to, values);
        }
        return;
    }
    let stencil = Stencil::<L, D, N, R>::new(mapping, reach, &w, &g);
    let affine = if APIC {
        Some(AffineFactors::new::<D>(&w, &q))
    } else {
        None
    };
    // One component after the other: its sums and the weights along a row fit the registers.
    for c in 0..D {
        let of = stencil.component::<KICK, GRADIENT, UPPER, MOVE>(affine.as_ref(), c);
        if MOVE {
            keep(of.velocity, &mut values.velocity[c], to);
        }
        if KICK {
            keep(of.increment, &mut values.increment[c], to);
        }
        for axis in 0..D {
            if GRADIENT {
                keep(of.gradient[axis], &mut values.gradient.0[D * c + axis], to);
            }
            if APIC {
                keep(of.affine[axis], &mut values.affine[D * c + axis], to);
            }
        }
        if RADIAL && GRADIENT && c == 0 {
            keep(of.source, &mut values.gradient.0[HOOP], to);
        }
    }
    if RADIAL && GRADIENT {
        hoop_rate(mapping, block, to, values);
    }
}

/// Divides the radial velocity that strains particles, which stands in the place of the hoop strain rate, by their radius.
#[inline(always)]
fn hoop_rate<L: Lanes>(
    mapping: &Mapping,
    block: &Block<L>,
    to: usize,
    values: &mut InterpolatedValues,
) {
    let (_, inverse) = radii(mapping, block);
    let scale = inverse * L::splat(mapping.inverse_cell[0]);
    let velocity: L = group(&values.gradient.0[HOOP], to);
    keep(velocity * scale, &mut values.gradient.0[HOOP], to);
}

/// Weights, derivatives \[1/m\] and, with APIC, the factors of the affine velocity of a group that begins at particle `at`.
#[inline(always)]
pub(super) fn factors<
    L: Lanes,
    const D: usize,
    const N: usize,
    const APIC: bool,
    const ON_NODES: bool,
    const RADIAL: bool,
>(
    columns: &[&mut [f64]],
    mapping: &Mapping,
    block: &Block<L>,
    at: usize,
) -> [[[L; N]; 3]; 3] {
    let (w, mut g) = weights_of::<L, _, D, N, ON_NODES, RADIAL>(columns, mapping, block, at);
    let mut q = g;
    for axis in 0..D {
        let scale = L::splat(mapping.inverse_cell[axis]);
        for n in 0..N {
            g[axis][n] = g[axis][n] * scale;
        }
        if APIC {
            q[axis] = affine_weights::<L, N>(mapping, axis, block.f[axis], &w[axis], &g[axis]);
        }
    }
    [w, g, q]
}

/// One component of the interpolated values.
struct Component<L> {
    velocity: L,
    /// The velocity that strains.
    source: L,
    increment: L,
    gradient: [L; 3],
    affine: [L; 3],
}

/// Factors that the components share: those along a row, products over slow and middle axis for each row, and the rows.
struct Stencil<'a, L: Lanes, const D: usize, const N: usize, const R: usize> {
    /// Weight and derivative along the row.
    w: [L; N],
    g: [L; N],
    /// Weight times weight.
    ww: [[L; N]; N],
    /// Derivative along the slow axis, and along the middle one.
    gw: [[L; N]; N],
    wg: [[L; N]; N],
    /// The nodes of each row.
    rows: [[Rows<'a, N, R>; N]; N],
    reach: &'a BlockReach<'a, L, R>,
}

/// The same for the factors of APIC: along the row, and over slow and middle axis with that of one of them.
struct AffineFactors<L, const N: usize> {
    q: [L; N],
    qw: [[L; N]; N],
    wq: [[L; N]; N],
}

impl<L: Lanes, const N: usize> AffineFactors<L, N> {
    #[inline(always)]
    fn new<const D: usize>(w: &[[L; N]; 3], q: &[[L; N]; 3]) -> Self {
        let mut factors = Self {
            q: q[D - 1],
            qw: [q[0]; N],
            wq: [q[0]; N],
        };
        for i in 0..N {
            for j in 0..rows_of_plane(D, N) {
                if D == 3 {
                    factors.qw[i][j] = q[0][i] * w[1][j];
                    factors.wq[i][j] = w[0][i] * q[1][j];
                } else {
                    factors.qw[i][j] = q[0][i];
                }
            }
        }
        factors
    }
}

impl<'a, L: Lanes, const D: usize, const N: usize, const R: usize> Stencil<'a, L, D, N, R> {
    #[inline(always)]
    fn new(
        mapping: &Mapping,
        reach: &'a BlockReach<'a, L, R>,
        w: &[[L; N]; 3],
        g: &[[L; N]; 3],
    ) -> Self {
        let fast = D - 1;
        let plane = mapping.nodes[1] * mapping.nodes[2];
        let mut stencil = Self {
            w: w[fast],
            g: g[fast],
            ww: [w[0]; N],
            gw: [g[0]; N],
            wg: [g[0]; N],
            rows: [[reach.rows(0); N]; N],
            reach,
        };
        for i in 0..N {
            for j in 0..rows_of_plane(D, N) {
                stencil.rows[i][j] = reach.rows(i * plane + j * mapping.nodes[2]);
                if D == 3 {
                    stencil.ww[i][j] = w[0][i] * w[1][j];
                    stencil.gw[i][j] = g[0][i] * w[1][j];
                    stencil.wg[i][j] = w[0][i] * g[1][j];
                } else {
                    stencil.ww[i][j] = w[0][i];
                    stencil.gw[i][j] = g[0][i];
                }
            }
        }
        stencil
    }

    #[inline(always)]
    fn component<const KICK: bool, const GRADIENT: bool, const UPPER: bool, const MOVE: bool>(
        &self,
        affine: Option<&AffineFactors<L, N>>,
        c: usize,
    ) -> Component<L> {
        let zero = L::splat(0.0);
        let fast = D - 1;
        let source = if UPPER { 4 } else { 1 };
        let mut sums = Component {
            velocity: zero,
            source: zero,
            increment: zero,
            gradient: [zero; 3],
            affine: [zero; 3],
        };
        for i in 0..N {
            for j in 0..rows_of_plane(D, N) {
                let row = &self.rows[i][j];
                // Sums along the row. A first product may be -0 where a sum from 0 is not; neither changes what it
                // is added to.
                let (mut v_0, mut v, mut dv) = (zero, zero, zero);
                if MOVE {
                    v_0 = self.reach.value(row, 0, 1 + c);
                    v = self.w[0] * v_0;
                }
                if KICK {
                    dv = self.w[0] * self.reach.value(row, 0, 4 + c);
                }
                let (mut s, mut vg) = (zero, zero);
                if GRADIENT {
                    let s_0 = self.reach.value(row, 0, source + c);
                    (s, vg) = (self.w[0] * s_0, self.g[0] * s_0);
                }
                for k in 1..N {
                    if MOVE {
                        v = self.w[k].mul_add(self.reach.value(row, k, 1 + c), v);
                    }
                    if KICK {
                        dv = self.w[k].mul_add(self.reach.value(row, k, 4 + c), dv);
                    }
                    if GRADIENT {
                        let s_i = self.reach.value(row, k, source + c);
                        if UPPER {
                            s = self.w[k].mul_add(s_i, s);
                        }
                        vg = self.g[k].mul_add(s_i, vg);
                    }
                }
                if !UPPER {
                    s = v;
                }
                let ww = self.ww[i][j];
                if MOVE {
                    sums.velocity = ww.mul_add(v, sums.velocity);
                }
                if KICK {
                    sums.increment = ww.mul_add(dv, sums.increment);
                }
                if GRADIENT {
                    sums.source = ww.mul_add(s, sums.source);
                    sums.gradient[0] = self.gw[i][j].mul_add(s, sums.gradient[0]);
                    sums.gradient[fast] = ww.mul_add(vg, sums.gradient[fast]);
                    if D == 3 {
                        sums.gradient[1] = self.wg[i][j].mul_add(s, sums.gradient[1]);
                    }
                }
                if let Some(affine) = affine {
                    let mut vq = affine.q[0] * v_0;
                    for k in 1..N {
                        vq = affine.q[k].mul_add(self.reach.value(row, k, 1 + c), vq);
                    }
                    sums.affine[0] = affine.qw[i][j].mul_add(v, sums.affine[0]);
                    sums.affine[fast] = ww.mul_add(vq, sums.affine[fast]);
                    if D == 3 {
                        sums.affine[1] = affine.wq[i][j].mul_add(v, sums.affine[1]);
                    }
                }
            }
        }
        sums
    }
}

/// Rows of a stencil of `nodes` per axis in one plane of the slow axis.
#[inline(always)]
const fn rows_of_plane(axes: usize, nodes: usize) -> usize {
    if axes == 3 { nodes } else { 1 }
}

/// Factors of APIC along an axis: S_I (x_I - x_p)/D_p with D_p = sum S_I (x_I - x_p)² of that axis. The cross
/// terms of D_p vanish because the weights reproduce linear fields. For hats the quotient is the derivative,
/// also where D_p is zero.
#[inline(always)]
fn affine_weights<L: Lanes, const N: usize>(
    mapping: &Mapping,
    axis: usize,
    f: L,
    w: &[L; N],
    g: &[L; N],
) -> [L; N] {
    if mapping.family == Family::Hat {
        return *g;
    }
    let mut q = *w;
    let mut inertia = L::splat(0.0);
    for n in 0..N {
        let distance = L::splat(n as f64) - f;
        q[n] = w[n] * distance;
        inertia = q[n].mul_add(distance, inertia);
    }
    let scale = L::splat(mapping.inverse_cell[axis]) / inertia;
    for n in 0..N {
        q[n] = q[n] * scale;
    }
    q
}
