//! Particles to nodes: mass, momentum and force, lanes = quantities of a node.
//!
//! m_I = sum_p m_p S_Ip, p_I = sum_p m_p (v_p + C_p (x_I - x_p)) S_Ip,
//! f_I = sum_p (f_p S_Ip - V_p sigma_p . grad S_Ip)   (technical manual, algorithm 2, lines 1, 2, 5, 6).
//!
//! The caller owns some planes of nodes and pulls from all particles that reach them; a node's sum is formed
//! in the order of the particles whatever planes the caller owns, so the bits do not depend on the partition.

use super::{Group, Mapping, group_at, layer_of, weights_of};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes, Selected};
use crate::particles::Layout;
use std::ops::Range;

/// What is carried to the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carry {
    /// Mass and momentum to the lower lanes, force to the upper ones.
    All,
    /// Mass and momentum to the lower lanes.
    Momentum,
    /// Force to the upper lanes.
    Force,
    /// Momentum to the upper lanes (the second mapping of MUSL).
    Remap,
    /// Mass gradient sum m grad S to the upper lanes, for the normals of contact.
    MassGradient,
    /// As [`Carry::All`], and m times spin to the last lane, for the vertices of boundaries (2D; Liang et al. 2024,
    /// eq. 28).
    AllAndSpin,
}

/// One call: the particles of some layers of a set onto some planes.
pub struct P2g<'a> {
    /// Columns of the set.
    pub columns: &'a [Vec<f64>],
    /// Where the columns are.
    pub layout: &'a Layout,
    /// How the set sees the grid.
    pub mapping: &'a Mapping,
    /// Particles of each layer, in order, and whether the caller owns the layer; groups do not cross layers.
    pub layers: Vec<(Range<usize>, bool)>,
    /// Planes of nodes that are owned.
    pub planes: Range<usize>,
    /// The nodes of these planes.
    pub nodes: &'a mut [Line],
    /// What is carried.
    pub carry: Carry,
    /// First column of the velocity gradient of which the spin is carried.
    pub spin: Option<usize>,
    /// Rate of viscous damping, f = -rate m v \[1/s\] (Liang et al. 2024, eq. 20); 0 for none.
    pub viscous_rate: f64,
}

/// What an instance carries beyond mass, momentum and force: nothing, the mass gradient instead of them, or the spin.
const NOTHING: u8 = 0;
const MASS_GRADIENT: u8 = 1;
const SPIN: u8 = 2;

/// A mapping stage, compiled for one dimension, stencil and set of terms. Returns the number of groups in the
/// layers that the caller owns.
pub type P2gFn = fn(Selected, P2g<'_>) -> usize;

/// Chooses the instance: dimension, nodes per axis, whether particles carry affine velocity or forces of their
/// own (`full`).
///
/// Without affine velocity, mass and momentum need no derivative and take a shorter loop.
#[must_use]
pub fn instance(axes: usize, stencil: usize, full: bool, carry: Carry) -> P2gFn {
    let gradient = full || matches!(carry, Carry::All | Carry::AllAndSpin | Carry::Force);
    // An instance of its own, so that the others do not ask for every particle.
    match carry {
        Carry::MassGradient => {
            return match (axes, stencil) {
                (2, 3) => entry::<2, 3, false, true, MASS_GRADIENT>,
                (2, _) => entry::<2, 4, false, true, MASS_GRADIENT>,
                (_, 3) => entry::<3, 3, false, true, MASS_GRADIENT>,
                (_, _) => entry::<3, 4, false, true, MASS_GRADIENT>,
            };
        }
        Carry::AllAndSpin if stencil == 3 => return entry::<2, 3, true, true, SPIN>,
        Carry::AllAndSpin => return entry::<2, 4, true, true, SPIN>,
        _ => {}
    }
    match (axes, stencil, full, gradient) {
        (2, 3, false, true) => entry::<2, 3, false, true, NOTHING>,
        (2, 3, false, false) => entry::<2, 3, false, false, NOTHING>,
        (2, 3, true, _) => entry::<2, 3, true, true, NOTHING>,
        (2, _, false, true) => entry::<2, 4, false, true, NOTHING>,
        (2, _, false, false) => entry::<2, 4, false, false, NOTHING>,
        (2, _, true, _) => entry::<2, 4, true, true, NOTHING>,
        (_, 3, false, true) => entry::<3, 3, false, true, NOTHING>,
        (_, 3, false, false) => entry::<3, 3, false, false, NOTHING>,
        (_, 3, true, _) => entry::<3, 3, true, true, NOTHING>,
        (_, _, false, true) => entry::<3, 4, false, true, NOTHING>,
        (_, _, false, false) => entry::<3, 4, false, false, NOTHING>,
        (_, _, true, _) => entry::<3, 4, true, true, NOTHING>,
    }
}

fn entry<
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const EXTRA: u8,
>(
    lanes: Selected,
    call: P2g<'_>,
) -> usize {
    lanes.run(Instance::<'_, D, N, FULL, GRADIENT, EXTRA>(call))
}

struct Instance<
    'a,
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const EXTRA: u8,
>(P2g<'a>);

impl<const D: usize, const N: usize, const FULL: bool, const GRADIENT: bool, const EXTRA: u8> Kernel
    for Instance<'_, D, N, FULL, GRADIENT, EXTRA>
{
    type Output = usize;

    #[inline(always)]
    fn run<B: Backend>(self) -> usize {
        let P2g {
            columns,
            layout,
            mapping,
            layers,
            planes,
            nodes,
            carry,
            spin,
            viscous_rate,
        } = self.0;
        let mut scratch = Scratch::<N>::new();
        let mut groups = 0;
        for (layer, own_layer) in layers {
            let mut at = layer.start;
            while at < layer.end {
                let group = group_at::<B::Line, _, D, N>(columns, mapping, at, layer.end);
                let first_plane = layer_of(group.base[0]);
                let own = first_plane.max(planes.start)..(first_plane + N).min(planes.end);
                if own.start < own.end {
                    scratch.fill_weights::<B::Line, D, FULL>(columns, mapping, &group, at, carry);
                    scratch.fill_lines::<D, FULL, EXTRA>(
                        columns,
                        layout,
                        mapping,
                        at,
                        group.count,
                        carry,
                        spin,
                        viscous_rate,
                    );
                    let row = if D == 3 {
                        layer_of(group.base[1])
                    } else {
                        0
                    };
                    let fast = layer_of(group.base[D - 1]);
                    for plane in own {
                        let first = ((plane - planes.start) * mapping.nodes[1] + row)
                            * mapping.nodes[2]
                            + fast;
                        scratch.add_plane::<B, D, FULL, GRADIENT>(
                            plane - first_plane,
                            group.count,
                            first,
                            mapping.nodes[2],
                            nodes,
                        );
                    }
                }
                at += group.count;
                groups += usize::from(own_layer);
            }
        }
        groups
    }
}

/// Weights and quantities of one group.
struct Scratch<const N: usize> {
    /// Weights, `[axis][node][particle]`.
    w: [[[f64; 8]; N]; 3],
    /// Derivatives times h.
    g: [[[f64; 8]; N]; 3],
    /// Weights times distance in cells, for the affine term.
    q: [[[f64; 8]; N]; 3],
    /// Per particle: the line multiplied by the weight, and those multiplied by derivative (upper lanes) and
    /// distance (lower lanes) along each axis.
    lines: [[[f64; 8]; 4]; 8],
}

impl<const N: usize> Scratch<N> {
    #[inline(always)]
    fn new() -> Self {
        Self {
            w: [[[0.0; 8]; N]; 3],
            g: [[[0.0; 8]; N]; 3],
            q: [[[0.0; 8]; N]; 3],
            lines: [[[0.0; 8]; 4]; 8],
        }
    }

    #[inline(always)]
    fn fill_weights<L: Lanes, const D: usize, const FULL: bool>(
        &mut self,
        columns: &[Vec<f64>],
        mapping: &Mapping,
        group: &Group<L>,
        at: usize,
        carry: Carry,
    ) {
        let (w, g) = weights_of::<L, _, D, N>(columns, mapping, group, at);
        for axis in 0..D {
            for n in 0..N {
                w[axis][n].store(&mut self.w[axis][n]);
                g[axis][n].store(&mut self.g[axis][n]);
                if FULL {
                    let q = w[axis][n] * (L::splat(n as f64) - group.f[axis]);
                    q.store(&mut self.q[axis][n]);
                    if carry == Carry::Remap {
                        // The remapped momentum lies in the upper lanes, with its affine part.
                        q.store(&mut self.g[axis][n]);
                    }
                }
            }
        }
    }

    // One call site; a struct of the nine would only be taken apart again.
    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    fn fill_lines<const D: usize, const FULL: bool, const EXTRA: u8>(
        &mut self,
        columns: &[Vec<f64>],
        layout: &Layout,
        mapping: &Mapping,
        at: usize,
        count: usize,
        carry: Carry,
        spin: Option<usize>,
        viscous_rate: f64,
    ) {
        let stress = Layout::stress(D);
        let velocity = Layout::velocity(D);
        for p in 0..count {
            let i = at + p;
            let lines = &mut self.lines[p];
            *lines = [[0.0; 8]; 4];
            let m = columns[Layout::MASS][i];
            if EXTRA == MASS_GRADIENT {
                for axis in 0..D {
                    lines[Self::lean_line_of::<D>(axis)][4 + axis] = m * mapping.inverse_cell[axis];
                }
                continue;
            }
            if EXTRA == SPIN
                && let Some(gradient) = spin
            {
                lines[0][7] = 0.5 * m * (columns[gradient + 2][i] - columns[gradient + 1][i]);
            }
            if carry != Carry::Force {
                let first = if carry == Carry::Remap { 4 } else { 1 };
                if carry != Carry::Remap {
                    lines[0][0] = m;
                }
                for c in 0..D {
                    lines[0][first + c] = m * columns[velocity + c][i];
                }
                if FULL && let Some(affine) = layout.affine {
                    for axis in 0..D {
                        for c in 0..D {
                            let rate = columns[affine + c * D + axis][i];
                            lines[Self::line_of::<D>(axis)][first + c] =
                                m * rate * mapping.cell[axis];
                        }
                    }
                }
            }
            if matches!(carry, Carry::All | Carry::AllAndSpin | Carry::Force) {
                let volume = -columns[Layout::VOLUME][i];
                for axis in 0..D {
                    let scale = volume * mapping.inverse_cell[axis];
                    let line = if FULL {
                        Self::line_of::<D>(axis)
                    } else {
                        Self::lean_line_of::<D>(axis)
                    };
                    for c in 0..D {
                        lines[line][4 + c] = scale * columns[stress + voigt::<D>(c, axis)][i];
                    }
                }
                if FULL {
                    if let Some(force) = layout.force {
                        for c in 0..D {
                            lines[0][4 + c] = columns[force + c][i];
                        }
                    }
                    if viscous_rate != 0.0 {
                        for c in 0..D {
                            lines[0][4 + c] -= viscous_rate * m * columns[velocity + c][i];
                        }
                    }
                }
            }
        }
    }

    /// Line of the terms that go with the derivative along an axis: 1 slow, 2 middle, 3 fast.
    #[inline(always)]
    const fn line_of<const D: usize>(axis: usize) -> usize {
        if axis + 1 == D { 3 } else { axis + 1 }
    }

    /// As [`Self::line_of`]; without affine terms the slow axis shares line 0, whose upper lanes are free.
    #[inline(always)]
    const fn lean_line_of<const D: usize>(axis: usize) -> usize {
        if axis == 0 {
            0
        } else {
            Self::line_of::<D>(axis)
        }
    }

    /// Adds the group to one plane of nodes, `i` planes above its base.
    #[inline(always)]
    fn add_plane<B: Backend, const D: usize, const FULL: bool, const GRADIENT: bool>(
        &self,
        i: usize,
        count: usize,
        first: usize,
        row_length: usize,
        nodes: &mut [Line],
    ) {
        let fast = D - 1;
        let rows = if D == 3 { N } else { 1 };
        for j in 0..rows {
            // Products over slow and middle axis, eight particles at a time.
            let (mut ww, mut gw, mut wg) = (self.w[0][i], self.g[0][i], [0.0; 8]);
            let (mut qw, mut wq) = (self.q[0][i], [0.0; 8]);
            if D == 3 {
                let w_1 = B::Line::load(&self.w[1][j]);
                let w_0 = B::Line::load(&ww);
                (w_0 * w_1).store(&mut ww);
                if GRADIENT {
                    (B::Line::load(&gw) * w_1).store(&mut gw);
                    (w_0 * B::Line::load(&self.g[1][j])).store(&mut wg);
                }
                if FULL {
                    (B::Line::load(&qw) * w_1).store(&mut qw);
                    (w_0 * B::Line::load(&self.q[1][j])).store(&mut wq);
                }
            }
            let row = &mut nodes[first + j * row_length..][..N];
            let mut sums = [B::Line::splat(0.0); N];
            for k in 0..N {
                sums[k] = B::Line::load(&row[k]);
            }
            for p in 0..count {
                let lines = &self.lines[p];
                let by_weight = B::Line::load(&lines[0]);
                let mut s = if FULL || !GRADIENT {
                    B::Line::splat(ww[p]) * by_weight
                } else {
                    B::Line::splat_halves(ww[p], gw[p]) * by_weight
                };
                if FULL {
                    s = B::Line::splat_halves(qw[p], gw[p]).mul_add(B::Line::load(&lines[1]), s);
                }
                if GRADIENT && D == 3 {
                    let middle = B::Line::load(&lines[2]);
                    let factor = if FULL {
                        B::Line::splat_halves(wq[p], wg[p])
                    } else {
                        B::Line::splat(wg[p])
                    };
                    s = factor.mul_add(middle, s);
                }
                for k in 0..N {
                    sums[k] = B::Line::splat(self.w[fast][k][p]).mul_add(s, sums[k]);
                }
                if GRADIENT {
                    let t = B::Line::splat(ww[p]) * B::Line::load(&lines[3]);
                    for k in 0..N {
                        let factor = if FULL {
                            B::Line::splat_halves(self.q[fast][k][p], self.g[fast][k][p])
                        } else {
                            B::Line::splat(self.g[fast][k][p])
                        };
                        sums[k] = factor.mul_add(t, sums[k]);
                    }
                }
            }
            for k in 0..N {
                sums[k].store(&mut row[k]);
            }
        }
    }
}

/// Column of the stress component sigma_ab, counted from the first.
#[inline(always)]
pub(crate) const fn voigt<const D: usize>(a: usize, b: usize) -> usize {
    if a == b {
        a
    } else if D == 2 {
        3
    } else {
        // yz, xz, xy are 3, 4, 5: six minus the sum of the two axes.
        6 - a - b
    }
}
