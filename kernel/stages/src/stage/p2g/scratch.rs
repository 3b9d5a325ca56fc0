//! Weights and quantities of a block of particles, as the sums over nodes want them.

use super::source::{P2gSource, line_of, place_of};
use super::{AXISYMMETRIC, Carry, MASS_GRADIENT, MEAN_STRESS, RING_GRADIENT, RING_MEAN, voigt};
use crate::lanes::{Lanes, Quad, load};
use crate::layout::Layout;
use crate::stage::{Block, Mapping, radii, weights_of};
use crate::weights::{cell_mean_weights, ring_mean_weights};

/// Per particle of a block: the line multiplied by the weight, and those multiplied by derivative (upper lanes) and distance
/// (lower lanes) along each axis.
pub(super) type Lines = [[[f64; 8]; 4]; 8];

/// Weights and quantities of a block.
// Lines of eight numbers are lines of the cache: half of them lay across two wherever the stack began between, which took
// 18 % longer for *rotation*, in every second process.
#[repr(align(64))]
pub(super) struct Scratch<const N: usize> {
    /// Weights, `[axis][node][particle]`.
    pub w: [[[f64; 8]; N]; 3],
    /// Derivatives times h.
    pub g: [[[f64; 8]; N]; 3],
    /// Weights times distance in cells, for the affine term.
    pub q: [[[f64; 8]; N]; 3],
    /// Quantities.
    pub lines: Lines,
}

impl<const N: usize> Scratch<N> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            w: [[[0.0; 8]; N]; 3],
            g: [[[0.0; 8]; N]; 3],
            q: [[[0.0; 8]; N]; 3],
            lines: [[[0.0; 8]; 4]; 8],
        }
    }

    /// Weights of a block that begins at particle `at`.
    #[inline(always)]
    pub(super) fn fill_weights<
        L: Lanes,
        const D: usize,
        const FULL: bool,
        const GRADIENT: bool,
        const RADIAL: bool,
        const ON_NODES: bool,
    >(
        &mut self,
        from: &P2gSource<'_>,
        block: &Block<L>,
        at: usize,
    ) {
        let (w, g) =
            weights_of::<L, _, D, N, ON_NODES, RADIAL>(from.columns, from.mapping, block, at);
        for axis in 0..D {
            for n in 0..N {
                w[axis][n].store(&mut self.w[axis][n]);
                if GRADIENT {
                    g[axis][n].store(&mut self.g[axis][n]);
                }
                if FULL {
                    let node = n as f64 - if ON_NODES { 1.0 } else { 0.0 };
                    let q = w[axis][n] * (L::splat(node) - block.f[axis]);
                    q.store(&mut self.q[axis][n]);
                    if from.carry == Carry::Remap {
                        // The remapped momentum lies in the upper lanes, with its affine part.
                        q.store(&mut self.g[axis][n]);
                    }
                }
            }
        }
    }

    /// Puts cell means in the place of the weights, which go with derivatives along other axes alone.
    #[inline(always)]
    pub(super) fn take_cell_means<L: Lanes, const D: usize>(&mut self) {
        for axis in 0..D {
            let mut g = [L::splat(0.0); N];
            for n in 0..N {
                g[n] = L::load(&self.g[axis][n]);
            }
            let means = cell_mean_weights::<L, N>(&g);
            for n in 0..N {
                means[n].store(&mut self.w[axis][n]);
            }
        }
    }

    /// Puts what radial and hoop strain have together in the place of the derivatives along the radius: with means over cells, which
    /// also go with the derivatives along the axis, from the derivatives of the plane, else with the weights.
    #[inline(always)]
    pub(super) fn take_rings<L: Lanes>(
        &mut self,
        from: &P2gSource<'_>,
        block: &Block<L>,
        averaged: bool,
    ) {
        let (first, inverse) = radii(from.mapping, block);
        let mut g = [L::splat(0.0); N];
        for n in 0..N {
            g[n] = L::load(&self.g[0][n]);
        }
        if averaged {
            let [means, strains] = ring_mean_weights::<L, N>(&g, first);
            for n in 0..N {
                means[n].store(&mut self.w[0][n]);
                strains[n].store(&mut self.g[0][n]);
            }
        } else {
            for n in 0..N {
                let w = L::load(&self.w[0][n]);
                w.mul_add(inverse, g[n]).store(&mut self.g[0][n]);
            }
        }
    }

    /// Quantities of `count` particles from `at`: formed with lanes = particles, four at a time, and turned to
    /// lanes = quantities.
    #[inline(always)]
    pub(super) fn fill_lines<
        Q: Quad,
        const D: usize,
        const FULL: bool,
        const GRADIENT: bool,
        const EXTRA: u8,
    >(
        &mut self,
        from: &P2gSource<'_>,
        at: usize,
        count: usize,
    ) {
        let mut done = 0;
        while done < count {
            let part = (count - done).min(4);
            let (lower, upper) = rows::<Q, D, FULL, EXTRA>(from, at + done, part);
            let lines = &mut self.lines[done..done + 4];
            for line in 0..4 {
                // Line 1 exists with affine terms only, line 2 in space only, where there are no affine terms line 3 as well;
                // without a derivative there is line 0.
                let exists = match line {
                    0 => true,
                    1 => FULL,
                    2 => D == 3 && GRADIENT,
                    _ => GRADIENT && (FULL || D == 3),
                };
                // Momentum alone has nothing in the upper lanes, and mapped again nothing in the lower ones.
                if exists && (GRADIENT || from.carry != Carry::Momentum) {
                    for (lines, half) in lines.iter_mut().zip(Q::transpose(upper[line])) {
                        half.store(&mut lines[line][4..]);
                    }
                }
                if (line == 0 && (GRADIENT || from.carry != Carry::Remap)) || FULL && exists {
                    for (lines, half) in lines.iter_mut().zip(Q::transpose(lower[line])) {
                        half.store(&mut lines[line]);
                    }
                }
            }
            done += part;
        }
    }
}

/// Lower and upper half of each line, row by row, of `count <= 4` particles.
#[inline(always)]
fn rows<Q: Quad, const D: usize, const FULL: bool, const EXTRA: u8>(
    from: &P2gSource<'_>,
    at: usize,
    count: usize,
) -> ([[Q; 4]; 4], [[Q; 4]; 4]) {
    let zero = Q::splat(0.0);
    let (mut lower, mut upper) = ([[zero; 4]; 4], [[zero; 4]; 4]);
    let (columns, mapping, carry) = (from.columns, from.mapping, from.carry);
    let m = load::<Q>(&columns[Layout::MASS], at, count);
    if EXTRA == MASS_GRADIENT || EXTRA == RING_GRADIENT {
        // A uniform body has no gradient inside where the mass of a ring is that of one length of it.
        let m = if EXTRA == RING_GRADIENT {
            m / radius(columns, mapping, at, count)
        } else {
            m
        };
        for axis in 0..D {
            let (line, lane) = place_of::<D, false>(axis, axis);
            upper[line][lane] = m * Q::splat(mapping.inverse_cell[axis]);
        }
        return (lower, upper);
    }
    if EXTRA == MEAN_STRESS || EXTRA == RING_MEAN {
        let directions = if EXTRA == RING_MEAN { 3 } else { D };
        let sign = match carry {
            Carry::MeanStress { averaged: true } => -1.0,
            _ => 1.0,
        };
        let volume =
            Q::splat(sign / directions as f64) * load::<Q>(&columns[Layout::VOLUME], at, count);
        let mut trace = zero;
        for axis in 0..directions {
            trace = trace + load::<Q>(&columns[Layout::stress(D) + axis], at, count);
        }
        for axis in 0..D {
            let (line, lane) = place_of::<D, false>(axis, axis);
            upper[line][lane] = volume * Q::splat(mapping.inverse_cell[axis]) * trace;
        }
        return (lower, upper);
    }
    let mut v = [zero; 3];
    for c in 0..D {
        v[c] = load::<Q>(&columns[Layout::velocity(D) + c], at, count);
    }
    if carry == Carry::Remap {
        for c in 0..D {
            upper[0][c] = m * v[c];
        }
    } else if carry != Carry::Force {
        lower[0][0] = m;
        for c in 0..D {
            lower[0][1 + c] = m * v[c];
        }
    }
    if FULL
        && carry != Carry::Force
        && let Some(affine) = from.layout.affine
    {
        for axis in 0..D {
            let cell = Q::splat(mapping.cell[axis]);
            for c in 0..D {
                let rate = load::<Q>(&columns[affine + c * D + axis], at, count);
                let along = m * rate * cell;
                if carry == Carry::Remap {
                    let (line, lane) = place_of::<D, true>(axis, c);
                    upper[line][lane] = along;
                } else {
                    lower[line_of::<D>(axis)][1 + c] = along;
                }
            }
        }
    }
    if matches!(carry, Carry::All | Carry::Force) {
        let volume = -load::<Q>(&columns[Layout::VOLUME], at, count);
        for axis in 0..D {
            let scale = volume * Q::splat(from.stress_factor * mapping.inverse_cell[axis]);
            for c in 0..D {
                let stress = &columns[Layout::stress(D) + voigt::<D>(c, axis)];
                let (line, lane) = place_of::<D, FULL>(axis, c);
                upper[line][lane] = scale * load::<Q>(stress, at, count);
            }
        }
        if FULL {
            if let Some(force) = from.layout.force {
                for c in 0..D {
                    upper[0][c] = load::<Q>(&columns[force + c], at, count);
                }
            }
            if from.viscous_rate != 0.0 {
                let rate = Q::splat(from.viscous_rate);
                for c in 0..D {
                    upper[0][c] = upper[0][c] - rate * m * v[c];
                }
            }
        }
        if EXTRA == AXISYMMETRIC {
            // The hoop force goes with the weights alone: without affine terms in the lane of the third component of momentum.
            let hoop = load::<Q>(&columns[Layout::stress(D) + 2], at, count);
            let force = volume * hoop / radius(columns, mapping, at, count);
            if FULL {
                upper[0][0] = upper[0][0] + force;
            } else {
                lower[0][3] = force;
            }
        }
    }
    (lower, upper)
}

/// Radius of `count` particles \[m\].
#[inline(always)]
fn radius<Q: Quad>(columns: &[Vec<f64>], mapping: &Mapping, at: usize, count: usize) -> Q {
    load::<Q>(&columns[Layout::POSITION], at, count) + Q::splat(mapping.first_radius)
}
