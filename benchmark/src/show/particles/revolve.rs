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

#[cfg(test)]
mod tests {
    use super::*;

    /// A cylinder of radius 1 and height 0.5, particles 0.05 apart, with the number of each as a field.
    fn cylinder() -> Frame {
        let mut frame = Frame::default();
        for i in 0..20 {
            for j in 0..10 {
                let at = |k: i32| 0.025 + 0.05 * f64::from(k);
                frame.points.push([at(i), at(j), 0.0]);
            }
        }
        let numbers = (0..frame.points.len()).map(|p| p as f64).collect();
        frame.arrays.insert("Id".to_owned(), (1, numbers));
        frame
    }

    #[test]
    fn rings_keep_radius_height_and_values() {
        let flat = cylinder();
        for degrees in [90.0, 270.0, 360.0] {
            let turned = revolved(&flat, 0.05, degrees);
            let (width, numbers) = &turned.arrays["Id"];
            assert_eq!((*width, numbers.len()), (1, turned.points.len()));
            for (point, number) in turned.points.iter().zip(numbers) {
                let [radius, height, _] = flat.points[*number as usize];
                assert!((point[0].hypot(point[1]) - radius).abs() < 1e-12);
                assert_eq!(point[2], height);
            }
        }
    }

    /// The wedge lies towards who looks; both its sides show all particles, and nothing inside is drawn.
    #[test]
    fn a_wedge_is_open_and_its_sides_are_whole() {
        let flat = cylinder();
        let turned = revolved(&flat, 0.05, 270.0);
        let azimuth = |point: &[f64; 3]| {
            let angle = point[1].atan2(point[0]).to_degrees() - View::default().azimuth;
            (angle + 540.0).rem_euclid(360.0) - 180.0
        };
        let on_cut = |point: &[f64; 3], side: f64| (azimuth(point) - side).abs() < 1e-6;
        for point in &turned.points {
            assert!(azimuth(point).abs() > 45.0 - 1e-6, "{point:?}");
        }
        for side in [-45.0, 45.0] {
            let count = turned.points.iter().filter(|p| on_cut(p, side)).count();
            assert_eq!(count, flat.points.len());
        }
        let inside = turned.points.iter().filter(|p| {
            let (radius, height) = (p[0].hypot(p[1]), p[2]);
            let deep = radius < 0.8 && (0.2..0.3).contains(&height);
            deep && !on_cut(p, 45.0) && !on_cut(p, -45.0)
        });
        assert_eq!(inside.count(), 0);
        let whole = revolved(&flat, 0.05, 360.0);
        assert!(whole.points.iter().any(|p| azimuth(p).abs() < 5.0));
    }
}
