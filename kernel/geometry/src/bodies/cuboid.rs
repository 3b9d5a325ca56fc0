//! Axis-aligned boxes and rectangles: a lattice of their own, which fits them exactly.

use super::error::FillError;
use super::lattice::Lattice;
use super::{FilledBody, FilledSlice};
use crate::shape::Vector;
use std::iter::repeat_n;

/// Particles of a box along one axis. Coordinates are relative to the mesh \[m\].
struct Division {
    /// Number of particles; a float until it is known to fit into the mesh.
    count: f64,
    spacing: f64,
    lower: f64,
    upper: f64,
    /// First sub-cell, if both ends are sub-cell lines.
    aligned: Option<i64>,
}

impl Division {
    fn new(lattice: &Lattice, axis: usize, lower: f64, upper: f64) -> Self {
        let snapped = [snap(lattice, axis, lower), snap(lattice, axis, upper)];
        let coordinate = |k: Option<i64>, x: f64| k.map_or(x, |k| lattice.line(axis, k));
        let (lower, upper) = (coordinate(snapped[0], lower), coordinate(snapped[1], upper));
        if let [Some(first), Some(end)] = snapped {
            return Self {
                count: (end - first) as f64,
                spacing: lattice.spacing(axis),
                lower,
                upper,
                aligned: Some(first),
            };
        }
        let d = lattice.spacing(axis);
        // Round-off must not add a particle: (0.4 - 0.1) / 0.1 is 3.0000000000000004.
        let slack = 2.0 * lattice.tolerance[axis] / d;
        let count = ((upper - lower) / d - slack).ceil().max(1.0);
        Self {
            count,
            spacing: (upper - lower) / count,
            lower,
            upper,
            aligned: None,
        }
    }

    fn position(&self, lattice: &Lattice, axis: usize, i: i64) -> f64 {
        match self.aligned {
            Some(first) => lattice.centre(axis, first + i),
            None => self.lower + (i as f64 + 0.5) * self.spacing,
        }
    }

    /// The first particle outside the mesh, if any; positions ascend.
    fn first_outside(&self, lattice: &Lattice, axis: usize) -> Option<i64> {
        let extent = lattice.extent[axis];
        if self.position(lattice, axis, 0) < 0.0 {
            return Some(0);
        }
        let last = self.count as i64 - 1;
        if self.position(lattice, axis, last) <= extent {
            return None;
        }
        let mut i = ((extent - self.lower) / self.spacing - 0.5).floor() as i64 - 1;
        i = i.clamp(0, last);
        while self.position(lattice, axis, i) <= extent {
            i += 1;
        }
        Some(i)
    }
}

/// The sub-cell line that a coordinate stands for, if it is one within the tolerance.
fn snap(lattice: &Lattice, axis: usize, x: f64) -> Option<i64> {
    let k = (x / lattice.spacing(axis)).round();
    // Far outside the mesh nothing is snapped, and an index could overflow.
    if k.abs() > 1e15 {
        return None;
    }
    let k = k as i64;
    ((x - lattice.line(axis, k)).abs() <= lattice.tolerance[axis]).then_some(k)
}

/// Particles of the box from `p1` to `p2`, in the coordinates of the scene \[m\].
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill(lattice: &Lattice, p1: Vector, p2: Vector) -> Result<FilledBody, FillError> {
    let (p1, p2) = (lattice.relative(p1), lattice.relative(p2));
    let axes = lattice.axes;
    let mut divisions = Vec::with_capacity(axes);
    for axis in 0..axes {
        FillError::require_finite("lower corner of the box", None, p1[axis])?;
        FillError::require_finite("upper corner of the box", None, p2[axis])?;
        divisions.push(Division::new(lattice, axis, p1[axis], p2[axis]));
    }
    if divisions
        .iter()
        .any(|division| division.upper <= division.lower)
    {
        return Err(FillError::Empty {
            size: [0, 1, 2].map(|axis| p2[axis] - p1[axis]),
            spacing: [0, 1, 2].map(|axis| lattice.spacing(axis)),
            axes,
        });
    }
    require_inside(lattice, &divisions)?;

    let volume = divisions
        .iter()
        .map(|division| division.upper - division.lower)
        .product();
    FillError::require_positive("volume of the body", None, volume)?;
    let count: f64 = divisions.iter().map(|division| division.count).product();
    let mut spacing = [1.0; 3];
    for axis in 0..axes {
        spacing[axis] = divisions[axis].spacing;
    }
    let positions = |axis: usize| -> Vec<f64> {
        let division = &divisions[axis];
        (0..division.count as i64)
            .map(|i| division.position(lattice, axis, i))
            .collect()
    };
    // More than memory holds is refused before any is listed.
    let (slices, across) = (divisions[0].count, count / divisions[0].count);
    lattice.require_countable(slices, across)?;
    let first = positions(0);
    let slices: Vec<FilledSlice> = first
        .iter()
        .map(|x| FilledSlice {
            x: *x,
            count: across as u64,
        })
        .collect();
    let kept = first.iter().filter(|x| lattice.wants(**x));
    let kept = kept.count() as f64 * across;
    let mut particles = lattice.allocate(kept, (volume, count), spacing)?;
    particles.slices = slices;
    let middle = if axes == 3 { positions(1) } else { vec![0.0] };
    let last = positions(lattice.last());
    for x in first.iter().filter(|x| lattice.wants(**x)) {
        particles.x[0].extend(repeat_n(x, middle.len() * last.len()));
        for y in &middle {
            if axes == 3 {
                particles.x[1].extend(repeat_n(y, last.len()));
            }
            particles.x[lattice.last()].extend_from_slice(&last);
        }
    }
    Ok(particles)
}

/// Fails for the first particle, in their order, that is outside the mesh. Needs no particle in memory, so
/// that a box a thousand times too large is an error and not a full disc of swap.
fn require_inside(lattice: &Lattice, divisions: &[Division]) -> Result<(), FillError> {
    let mut stride = 1_usize;
    let mut found: Option<(usize, usize, i64)> = None;
    for (axis, division) in divisions.iter().enumerate().rev() {
        if let Some(i) = division.first_outside(lattice, axis) {
            let index = stride.saturating_mul(i as usize);
            if found.is_none_or(|(smallest, ..)| index <= smallest) {
                found = Some((index, axis, i));
            }
        }
        stride = stride.saturating_mul(division.count as usize);
    }
    let Some((index, beyond, i)) = found else {
        return Ok(());
    };
    let mut x = [0.0; 3];
    for (axis, division) in divisions.iter().enumerate() {
        x[axis] = division.position(lattice, axis, if axis == beyond { i } else { 0 });
    }
    Err(lattice.outside(index, x))
}
