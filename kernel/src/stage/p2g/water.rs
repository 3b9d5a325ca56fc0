//! Quantities of the pore water of a block of particles.

use super::Carry;
use super::source::{P2gSource, place_of};
use crate::lanes::{Quad, load};
use crate::layout::Layout;
use crate::model::Permeability;

/// Lower and upper half of each line of `count <= 4` particles, which are zero.
///
/// The drag goes with the weights alone: in the plane in the lane of the third component of momentum, in space beside the
/// force.
#[inline(always)]
pub(super) fn rows<Q: Quad, const D: usize>(
    from: &P2gSource<'_>,
    at: usize,
    count: usize,
    (lower, upper): (&mut [[Q; 4]; 4], &mut [[Q; 4]; 4]),
) {
    let (Some(water), Some(first)) = (from.water, from.layout.water) else {
        return;
    };
    let columns = from.columns;
    let mass = load::<Q>(&columns[Layout::MASS], at, count);
    let volume = load::<Q>(&columns[Layout::VOLUME], at, count);
    let pores = volume - mass * Q::splat(1.0 / water.grain_density);
    let of_water = Q::splat(water.density) * pores;
    let mut momentum = [of_water; 3];
    for c in 0..D {
        momentum[c] = of_water * load::<Q>(&columns[first + c], at, count);
    }
    if from.carry == Carry::Remap {
        upper[0][..D].copy_from_slice(&momentum[..D]);
        return;
    }
    lower[0][0] = of_water;
    lower[0][1..=D].copy_from_slice(&momentum[..D]);
    // V n² is the square of the pores over the volume.
    let mut drag = Q::splat(water.drag_scale()) * pores * pores / volume;
    if water.permeability != Permeability::Constant {
        // One over J.
        let denser = mass / (Q::splat(water.dry_density()) * volume);
        drag = drag * denser * denser;
    }
    if water.permeability == Permeability::KozenyCarman {
        let narrower = Q::splat(water.porosity) * volume / pores;
        drag = drag * narrower * narrower * narrower;
    }
    if D == 2 {
        lower[0][3] = drag;
    } else {
        upper[0][3] = drag;
    }
    let force = volume * load::<Q>(&columns[first + D], at, count);
    for axis in 0..D {
        let (line, lane) = place_of::<D, false>(axis, axis);
        upper[line][lane] = force * Q::splat(from.mapping.inverse_cell[axis]);
    }
}

/// The same of the force of the pressure alone: that with means over cells, or minus that of the usual weights.
#[inline(always)]
pub(super) fn rows_of_mean<Q: Quad, const D: usize>(
    from: &P2gSource<'_>,
    at: usize,
    count: usize,
    upper: &mut [[Q; 4]; 4],
) {
    let Some(first) = from.layout.water else {
        return;
    };
    let sign = match from.carry {
        Carry::MeanStress { averaged: true } => 1.0,
        _ => -1.0,
    };
    let volume = Q::splat(sign) * load::<Q>(&from.columns[Layout::VOLUME], at, count);
    let force = volume * load::<Q>(&from.columns[first + D], at, count);
    for axis in 0..D {
        let (line, lane) = place_of::<D, false>(axis, axis);
        upper[line][lane] = force * Q::splat(from.mapping.inverse_cell[axis]);
    }
}
