//! Triangles on the boundaries of shapes.

use super::Point;
use super::refine::fill;
use crate::geometry::mortar::outline::{OutlineError, along, around, parts, signed_area};
use nalgebra::Vector2;
use proctor_geometry::shape::Shape;
use std::f64::consts::{PI, TAU};

/// Corners of a triangle \[m\].
type Triangle = [Point; 3];

/// Triangles of the boundary of a shape, counter-clockwise from outside; no vertex is further than `segment` \[m\] from
/// the next one along an edge, a circle or a meridian. Vertices of curved surfaces lie on them. Neighbours repeat the
/// coordinates of their common corners but for round-off.
///
/// # Errors
/// A length that is not positive, or a shape without a surface of its own.
pub fn skin(shape: &Shape, segment: f64) -> Result<Vec<[[f64; 3]; 3]>, OutlineError> {
    if !(segment > 0.0 && segment.is_finite()) {
        return Err(OutlineError::Segment(segment));
    }
    let mut out = vec![];
    match shape {
        Shape::Cuboid { p1, p2 } => cuboid(&Point::from(*p1), &Point::from(*p2), segment, &mut out),
        Shape::Sphere { center, radius } => {
            let rings = parts(PI * radius, segment).max(2);
            let profile: Vec<[f64; 2]> = (0..=rings)
                .map(|k| {
                    let (sin, cos) = libm::sincos(PI * k as f64 / rings as f64);
                    let on_axis = k == 0 || k == rings;
                    [if on_axis { 0.0 } else { radius * sin }, -radius * cos]
                })
                .collect();
            let frame = [Point::x(), Point::y(), Point::z()];
            revolve(&Point::from(*center), &frame, &profile, segment, &mut out);
        }
        Shape::Cylinder { p1, p2, radius } => {
            let (from, to) = (Point::from(*p1), Point::from(*p2));
            let length = (to - from).norm();
            let axis = (to - from) / length;
            let mut least = Point::zeros();
            least[axis.iamin()] = 1.0;
            let first = (least - axis * axis.dot(&least)).normalize();
            let (across, up) = (parts(*radius, segment), parts(length, segment));
            let share = |k: usize, n: usize| k as f64 / n as f64;
            let mut profile = vec![];
            profile.extend((0..across).map(|k| [radius * share(k, across), 0.0]));
            profile.extend((0..up).map(|k| [*radius, length * share(k, up)]));
            profile.extend((0..=across).map(|k| [radius * share(across - k, across), length]));
            let frame = [first, axis.cross(&first), axis];
            revolve(&from, &frame, &profile, segment, &mut out);
        }
        Shape::ExtrudedPolygon {
            points,
            axis,
            range,
        } => extruded(points, *axis, *range, segment, &mut out),
        Shape::Ring { .. }
        | Shape::Polygon { .. }
        | Shape::Stratum(_)
        | Shape::Enclosed(_)
        | Shape::Particles(_) => {
            return Err(OutlineError::Shape);
        }
    }
    Ok(out.into_iter().map(|t| t.map(Into::into)).collect())
}

/// About how many triangles [`skin`] would make, never far fewer: a number, since it may be too large to be one of them.
/// Zero for a shape without a surface.
#[must_use]
pub fn triangles(shape: &Shape, segment: f64) -> f64 {
    let parts = |length: f64| length / segment + 1.0;
    match shape {
        Shape::Cuboid { p1, p2 } => {
            let n: [f64; 3] = std::array::from_fn(|axis| parts(p2[axis] - p1[axis]));
            4.0 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0])
        }
        // Two for each vertex; rings have up to four more vertices than their circle is long.
        Shape::Sphere { radius, .. } => 2.0 * parts(PI * radius) * (parts(TAU * radius) + 4.0),
        Shape::Cylinder { p1, p2, radius } => {
            let length = (Point::from(*p2) - Point::from(*p1)).norm();
            let rings = parts(length) + 2.0 * parts(*radius);
            2.0 * rings * (parts(TAU * radius) + 4.0)
        }
        Shape::ExtrudedPolygon { points, range, .. } => {
            let corners: Vec<Vector2<f64>> = points.iter().map(|p| Vector2::from(*p)).collect();
            let outline = around(&corners, segment);
            // Inside both faces, triangles whose edges are longer than half a segment.
            let area = signed_area(&corners).abs();
            let faces = 2.0 * (outline + 8.0 * area / segment / segment);
            2.0 * outline * parts(range[1] - range[0]) + faces
        }
        Shape::Ring { .. }
        | Shape::Polygon { .. }
        | Shape::Stratum(_)
        | Shape::Enclosed(_)
        | Shape::Particles(_) => 0.0,
    }
}

/// A parallelogram of nu x nv cells, seen from the side to which u x v points. Diagonals alternate, so that around each
/// vertex the triangles are alike on all sides.
fn grid(origin: &Point, u: &Point, v: &Point, [nu, nv]: [usize; 2], out: &mut Vec<Triangle>) {
    let at = |i: usize, j: usize| origin + u * (i as f64 / nu as f64) + v * (j as f64 / nv as f64);
    for i in 0..nu {
        for j in 0..nv {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if (i + j) % 2 == 0 {
                out.extend([[a, b, c], [a, c, d]]);
            } else {
                out.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
}

fn cuboid(low: &Point, high: &Point, segment: f64, out: &mut Vec<Triangle>) {
    let size = high - low;
    for axis in 0..3 {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let edge = |axis: usize| {
            let mut e = Point::zeros();
            e[axis] = size[axis];
            e
        };
        let (u, v) = (edge(j), edge(k));
        let (nu, nv) = (parts(size[j], segment), parts(size[k], segment));
        grid(low, &v, &u, [nv, nu], out);
        grid(&(low + edge(axis)), &u, &v, [nu, nv], out);
    }
}

/// A surface of revolution: rings at the radii and heights of a profile that begins and ends on the axis and leaves the
/// body on its inner side going up, joined one to the next. `frame` is right-handed with the axis last.
fn revolve(
    center: &Point,
    frame: &[Point; 3],
    profile: &[[f64; 2]],
    segment: f64,
    out: &mut Vec<Triangle>,
) {
    let ring = |[radius, height]: [f64; 2]| -> Vec<Point> {
        let middle = center + frame[2] * height;
        if radius == 0.0 {
            return vec![middle];
        }
        // The same in all four quadrants, so that planes of symmetry cut no triangle.
        let count = 4 * parts(0.25 * TAU * radius, segment);
        (0..count)
            .map(|k| {
                let (sin, cos) = libm::sincos(TAU * k as f64 / count as f64);
                middle + frame[0] * (radius * cos) + frame[1] * (radius * sin)
            })
            .collect()
    };
    let rings: Vec<Vec<Point>> = profile.iter().map(|p| ring(*p)).collect();
    for pair in rings.windows(2) {
        stitch(&pair[0], &pair[1], out);
    }
}

/// Triangles between two rings around the same axis, the second further along the profile.
fn stitch(lower: &[Point], upper: &[Point], out: &mut Vec<Triangle>) {
    let steps = |ring: &[Point]| if ring.len() == 1 { 0 } else { ring.len() };
    let (n, m) = (steps(lower), steps(upper));
    let at = |ring: &[Point], k: usize| ring[k % ring.len()];
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        // The ring whose next vertex comes first takes the step.
        if j == m || (i < n && (i + 1) * m <= (j + 1) * n) {
            out.push([at(lower, i), at(lower, i + 1), at(upper, j)]);
            i += 1;
        } else {
            out.push([at(lower, i), at(upper, j + 1), at(upper, j)]);
            j += 1;
        }
    }
}

fn extruded(
    corners: &[[f64; 2]],
    axis: usize,
    range: [f64; 2],
    segment: f64,
    out: &mut Vec<Triangle>,
) {
    let mut corners: Vec<Vector2<f64>> = corners.iter().map(|p| Vector2::from(*p)).collect();
    if signed_area(&corners) < 0.0 {
        corners.reverse();
    }
    let outline = along(&corners, segment);
    let (first, second) = [(1, 2), (0, 2), (0, 1)][axis];
    let at = |p: &Vector2<f64>, height: f64| {
        let mut x = Point::zeros();
        (x[first], x[second], x[axis]) = (p.x, p.y, height);
        x
    };
    let start = out.len();
    let layers = parts(range[1] - range[0], segment);
    let height = |k: usize| range[0] + (range[1] - range[0]) * (k as f64 / layers as f64);
    for (i, p) in outline.iter().enumerate() {
        let q = &outline[(i + 1) % outline.len()];
        for k in 0..layers {
            let [a, b] = [at(p, height(k)), at(q, height(k))];
            let [d, c] = [at(p, height(k + 1)), at(q, height(k + 1))];
            if (i + k) % 2 == 0 {
                out.extend([[a, b, c], [a, c, d]]);
            } else {
                out.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    let (points, triangles) = fill(&outline, segment);
    for [a, b, c] in triangles {
        out.push([a, b, c].map(|v| at(&points[v], range[1])));
        out.push([a, c, b].map(|v| at(&points[v], range[0])));
    }
    // x, z and y in this order are left-handed.
    if axis == 1 {
        for triangle in &mut out[start..] {
            triangle.swap(1, 2);
        }
    }
}
