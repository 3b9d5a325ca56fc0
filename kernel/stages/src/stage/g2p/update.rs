//! The new velocities and positions of a block of particles from its sums, and what was found on the way.

use super::values::{InterpolatedValues, group};
use super::{Affine, FaultKind, G2p, ParticleMaxima};
use crate::lanes::{Lanes, load, store};
use crate::layout::Layout;
use std::ops::Range;

/// Writes the new velocity, affine velocity and position of a group that begins at particle `at`, and at particle `from` of the
/// values; returns the lanes that went wrong.
#[inline(always)]
pub(super) fn update<L: Lanes, const D: usize>(
    call: &mut G2p<'_, '_>,
    values: &InterpolatedValues,
    from: usize,
    maxima: &mut Maxima<L>,
    at: usize,
    count: usize,
) -> u32 {
    let zero = L::splat(0.0);
    let task = call.task;
    let live = L::first(count);
    let mut good = u32::MAX;
    // Position and velocity: one bound for all of them.
    let columns = &mut call.columns[..Layout::stress(D)];
    if task.kick {
        let pic = L::splat(task.pic_fraction);
        let mut square = zero;
        for c in 0..D {
            let column = &mut *columns[Layout::velocity(D) + c];
            let v = if task.pic_fraction == 1.0 {
                group(&values.velocity[c], from)
            } else {
                let flip = load::<L>(column, at, count) + group(&values.increment[c], from);
                if task.pic_fraction == 0.0 {
                    flip
                } else {
                    pic.mul_add(group::<L>(&values.velocity[c], from) - flip, flip)
                }
            };
            store(v, column, at, count);
            square = v.mul_add(v, square);
        }
        maxima.speed_squared = maxima.speed_squared.max(L::select(live, square, zero));
    }
    if let Some(dt) = task.drift {
        let dt = L::splat(dt);
        for axis in 0..D {
            let column = &mut *columns[Layout::POSITION + axis];
            let move_ = dt * group(&values.velocity[axis], from) - L::splat(task.mesh_shift[axis]);
            let x = load::<L>(column, at, count) + move_;
            store(x, column, at, count);
            let cells = (move_ * L::splat(call.mapping.inverse_cell[axis])).abs();
            maxima.travel = maxima.travel.max(L::select(live, cells, zero));
            // False for NaN, true on the planes themselves.
            good &= L::bits(L::splat(-f64::MIN_POSITIVE).lt(x));
            good &= L::bits(x.lt(L::splat(call.beyond[axis])));
        }
    }
    if let Some(affine) = call.layout.affine {
        let c_p = match task.affine {
            Affine::Leave => None,
            Affine::Apic => Some(&values.affine),
            Affine::Tpic => Some(&values.gradient.0),
        };
        if let Some(c_p) = c_p {
            for component in 0..D * D {
                let value = group::<L>(&c_p[component], from);
                store(value, call.columns[affine + component], at, count);
            }
        }
    }
    !good & L::bits(live)
}

/// Largest values over the particles seen so far, per lane. Maxima do not depend on the order.
pub(super) struct Maxima<L> {
    speed_squared: L,
    travel: L,
}

impl<L: Lanes> Maxima<L> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        let zero = L::splat(0.0);
        Self {
            speed_squared: zero,
            travel: zero,
        }
    }

    /// Adds these to the findings of strains.
    #[inline(always)]
    pub(super) fn found(&self, of_strain: ParticleMaxima) -> ParticleMaxima {
        ParticleMaxima {
            speed_squared: self.speed_squared.largest(),
            travel: self.travel.largest(),
            ..of_strain
        }
    }
}

/// Fault of a particle.
#[cold]
pub(super) fn fault<const D: usize>(call: &G2p<'_, '_>, p: usize) -> FaultKind {
    let state: Range<usize> = Layout::VOLUME..Layout::stress(D) + call.layout.stress_components();
    let volume = call.columns[Layout::VOLUME][p];
    // First, because ln J makes the stress of an inverted particle NaN.
    if volume.is_finite() && volume <= 0.0 {
        FaultKind::Inverted
    } else if (state.chain(call.layout.variables..call.layout.columns))
        .any(|column| !call.columns[column][p].is_finite())
    {
        FaultKind::NotFinite
    } else {
        FaultKind::Outside
    }
}
