//! The new state of a group of particles from its sums, and what was found on the way.

use super::interpolate::Sums;
use super::{Affine, FaultKind, Found, G2p};
use crate::constitutive::{
    Configuration, Kind, determinant, hypoelastic, left_stretch_diagonal, neo_hookean,
    neo_hookean_speed_squared, product, relative_deformation, stretch_diagonal, volume_ratio,
};
use crate::lanes::Lanes;
use crate::particles::Layout;
use crate::scene::DomainUpdate;
use crate::stage::{load, store};
use std::ops::Range;

/// Writes the new state of one group; returns the lanes that went wrong.
#[inline(always)]
pub(super) fn update<L: Lanes, const D: usize, const N: usize>(
    call: &mut G2p<'_, '_>,
    sums: &Sums<L>,
    maxima: &mut Maxima<L>,
    at: usize,
    count: usize,
) -> u32 {
    let zero = L::splat(0.0);
    let task = call.task;
    let live = live_lanes::<L>(count);
    let mut good = u32::MAX;
    if task.kick {
        let pic = L::splat(task.pic_fraction);
        let mut square = zero;
        for c in 0..D {
            let column = &mut *call.columns[Layout::velocity(D) + c];
            let mut v = load::<L>(column, at, count) + sums.increment[c];
            if task.pic_fraction != 0.0 {
                v = pic.mul_add(sums.velocity[c] - v, v);
            }
            store(v, column, at, count);
            square = v.mul_add(v, square);
        }
        maxima.speed_squared = maxima.speed_squared.max(L::select(live, square, zero));
    }
    if let Some(affine) = call.layout.affine {
        let c_p = match task.affine {
            Affine::Leave => None,
            Affine::Apic => Some(&sums.affine),
            Affine::Tpic => Some(&sums.gradient),
        };
        if let Some(c_p) = c_p {
            for a in 0..D {
                for b in 0..D {
                    store(c_p[a][b], call.columns[affine + a * D + b], at, count);
                }
            }
        }
    }
    if let Some(dt) = task.drift {
        let dt = L::splat(dt);
        for axis in 0..D {
            let column = &mut *call.columns[Layout::POSITION + axis];
            let move_ = dt * sums.velocity[axis] - L::splat(task.mesh_shift[axis]);
            let x = load::<L>(column, at, count) + move_;
            store(x, column, at, count);
            let cells = (move_ * L::splat(call.mapping.inverse_cell[axis])).abs();
            maxima.travel = maxima.travel.max(L::select(live, cells, zero));
            // False for NaN, true on the planes themselves.
            good &= L::bits(L::splat(-f64::MIN_POSITIVE).lt(x));
            good &= L::bits(x.lt(L::splat(call.beyond[axis])));
        }
    }
    if let Some((dt, configuration)) = task.strain {
        good &= strain::<L, D>(call, sums, maxima, at, count, dt, configuration);
    }
    !good & L::bits(live)
}

/// Stress, volume and deformation after a strain increment; returns the lanes that are sound.
#[inline(always)]
fn strain<L: Lanes, const D: usize>(
    call: &mut G2p<'_, '_>,
    sums: &Sums<L>,
    maxima: &mut Maxima<L>,
    at: usize,
    count: usize,
    dt: f64,
    configuration: Configuration,
) -> u32 {
    let zero = L::splat(0.0);
    let live = live_lanes::<L>(count);
    let law = call.law;
    let mut g = sums.gradient;
    for a in 0..D {
        for b in 0..D {
            g[a][b] = g[a][b] * L::splat(dt);
        }
    }
    let mass = load::<L>(call.columns[Layout::MASS], at, count);
    let mut f = [[zero; 3]; 3];
    let mut ratio = L::splat(1.0);
    if let Some(first) = call.layout.deformation {
        for a in 0..D {
            for b in 0..D {
                f[a][b] = load::<L>(call.columns[first + a * D + b], at, count);
            }
        }
        f = product::<L, D>(&relative_deformation::<L, D>(&g, configuration), &f);
        for a in 0..D {
            for b in 0..D {
                store(f[a][b], call.columns[first + a * D + b], at, count);
            }
        }
        ratio = determinant::<L, D>(&f);
    }
    // Where F has a use in the cycle the volume is V_0 det F, so that volume, density and F agree to round-off;
    // an F that is only written must not change a bit.
    let volume = if law.kind == Kind::NeoHookean || call.domain_update.is_some() {
        mass * L::splat(1.0 / law.density) * ratio
    } else {
        load::<L>(call.columns[Layout::VOLUME], at, count) * volume_ratio::<L, D>(&g, configuration)
    };
    store(volume, call.columns[Layout::VOLUME], at, count);
    let mut good = L::bits(zero.lt(volume));

    let components = if D == 2 { 4 } else { 6 };
    let first = Layout::stress(D);
    let mut s = [zero; 6];
    let stiffness = if law.kind == Kind::NeoHookean {
        s = neo_hookean::<L, D>(law, &f, ratio);
        neo_hookean_speed_squared::<L, D>(law, &f, ratio)
    } else {
        for i in 0..components {
            s[i] = load::<L>(call.columns[first + i], at, count);
        }
        s = hypoelastic::<L, D>(law, &g, configuration, &s);
        volume / mass
    };
    maxima.stiffness = maxima.stiffness.max(L::select(live, stiffness, zero));
    let mut finite = zero;
    for i in 0..components {
        store(s[i], call.columns[first + i], at, count);
        finite = s[i].mul_add(zero, finite);
    }
    good &= L::bits(finite.eq(zero));

    if let (Some(update), Some(first), Some(initial)) = (
        call.domain_update,
        call.layout.half_length,
        call.layout.initial_half_length,
    ) {
        let factor = match update {
            DomainUpdate::Stretch => stretch_diagonal::<L, D>(&f),
            DomainUpdate::LeftStretch => left_stretch_diagonal::<L, D>(&f),
            DomainUpdate::Determinant if D == 2 => [ratio.sqrt(); 3],
            DomainUpdate::Determinant => [ratio.map(libm::cbrt); 3],
        };
        for axis in 0..D {
            let l = factor[axis] * load::<L>(call.columns[initial + axis], at, count);
            store(l, call.columns[first + axis], at, count);
            maxima.half_length = maxima.half_length.max(L::select(live, l, zero));
        }
    }
    good
}

#[inline(always)]
fn live_lanes<L: Lanes>(count: usize) -> L::Mask {
    const INDEX: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    L::load(&INDEX).lt(L::splat(count as f64))
}

/// Largest values over the particles seen so far, per lane. Maxima do not depend on the order.
pub(super) struct Maxima<L> {
    speed_squared: L,
    stiffness: L,
    travel: L,
    half_length: L,
}

impl<L: Lanes> Maxima<L> {
    #[inline(always)]
    pub fn new() -> Self {
        let zero = L::splat(0.0);
        Self {
            speed_squared: zero,
            stiffness: zero,
            travel: zero,
            half_length: zero,
        }
    }

    #[inline(always)]
    pub fn found(&self, fault: Option<(usize, FaultKind)>) -> Found {
        Found {
            speed_squared: largest(self.speed_squared),
            stiffness: largest(self.stiffness),
            travel: largest(self.travel),
            half_length: largest(self.half_length),
            fault,
        }
    }
}

#[inline(always)]
fn largest<L: Lanes>(x: L) -> f64 {
    let mut values = [0.0; 8];
    x.store(&mut values);
    let mut most = 0.0;
    for value in values {
        if value > most {
            most = value;
        }
    }
    most
}

/// Names the fault of the first bad lane of a group.
#[cold]
pub(super) fn first_fault<const D: usize>(
    call: &G2p<'_, '_>,
    at: usize,
    bad: u32,
) -> (usize, FaultKind) {
    let p = at + bad.trailing_zeros() as usize;
    let state: Range<usize> = Layout::VOLUME..Layout::stress(D) + call.layout.stress_components();
    let volume = call.columns[Layout::VOLUME][p];
    // First, because ln J makes the stress of an inverted neo-Hookean particle NaN.
    let kind = if volume.is_finite() && volume <= 0.0 {
        FaultKind::Inverted
    } else if state
        .clone()
        .any(|column| !call.columns[column][p].is_finite())
    {
        FaultKind::NotFinite
    } else {
        FaultKind::Outside
    };
    (p, kind)
}
