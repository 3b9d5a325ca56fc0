//! Particles of a body of revolution as rings in space, of which a wedge is cut out.

use super::View;
use crate::frames::Frame;
use std::collections::{BTreeMap, BTreeSet};

/// Side of the squares in which neighbours are looked for, over the distance of neighbours: a lattice leaves none of them empty.
const NEAR: f64 = 1.5;

/// Rings of particles, through so many degrees from the axis of a frame of radius x and height y on \[m\]: x and y become the
/// horizontal plane, z the height. Values are those of the section at every angle.
///
/// The rest of the circle is open towards the usual direction to look from. Of particles inside the body only those on the
/// two cuts are there: nobody sees the others.
#[must_use]
pub fn revolved(frame: &Frame, spacing: f64, degrees: f64) -> Frame {
    let is_whole = degrees >= 360.0;
    let skin = skin(frame, spacing);
    let (mut points, mut from) = (vec![], vec![]);
    let first = View::default().azimuth + 0.5 * (360.0 - degrees);
    for (p, &[radius, height, _]) in frame.points.iter().enumerate() {
        let arc = degrees.to_radians() * radius;
        let steps = ((arc / spacing).ceil() as usize).max(1);
        let last = if is_whole { steps - 1 } else { steps };
        for step in 0..=last {
            let is_cut = !is_whole && (step == 0 || step == last);
            if !skin[p] && !is_cut {
                continue;
            }
            let angle = (first + degrees * step as f64 / steps as f64).to_radians();
            points.push([radius * angle.cos(), radius * angle.sin(), height]);
            from.push(p);
        }
    }
    let of_each = |(width, values): &(usize, Vec<f64>)| {
        let rows = from
            .iter()
            .flat_map(|p| &values[p * width..(p + 1) * width]);
        (*width, rows.copied().collect())
    };
    let arrays = frame.arrays.iter();
    let arrays: BTreeMap<_, _> = arrays.map(|(name, a)| (name.clone(), of_each(a))).collect();
    Frame {
        points,
        arrays,
        time: frame.time,
    }
}

/// True for particles at the surface of a section: beside an empty square, which is not beyond the axis.
fn skin(frame: &Frame, spacing: f64) -> Vec<bool> {
    let side = NEAR * spacing;
    let square = |point: &[f64; 3]| [0, 1].map(|axis| (point[axis] / side).floor() as i64);
    let filled: BTreeSet<[i64; 2]> = frame.points.iter().map(square).collect();
    let is_open = |[i, j]: [i64; 2]| i >= 0 && !filled.contains(&[i, j]);
    let points = frame.points.iter();
    let beside = points.map(|point| {
        let [i, j] = square(point);
        (-1..=1).any(|a| (-1..=1).any(|b| is_open([i + a, j + b])))
    });
    beside.collect()
}
