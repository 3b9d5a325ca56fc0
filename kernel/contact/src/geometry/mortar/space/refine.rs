//! Flat faces inside a polygon, cut into triangles of a given size.

use crate::geometry::mortar::cross;
use nalgebra::Vector2;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

/// A point of the plane of the polygon \[m\].
type PlanePoint = Vector2<f64>;

/// Triangles that fill a simple polygon, counter-clockwise, and their vertices: first those of the polygon, whose edges
/// are kept as they are, then new ones inside, so that no edge inside is longer than `segment` \[m\] and the longest edge
/// of the polygon. Without the latter there would be no end: of the sides of a triangle on an edge one is always longer
/// than half of it.
#[must_use]
pub fn fill(polygon: &[PlanePoint], segment: f64) -> (Vec<PlanePoint>, Vec<[usize; 3]>) {
    let mut points = polygon.to_vec();
    let edges = (0..polygon.len()).map(|k| polygon[(k + 1) % polygon.len()] - polygon[k]);
    let segment = edges.map(|edge| edge.norm()).fold(segment, f64::max);
    let triangles = halve(&mut points, ears(polygon), segment);
    (points, triangles)
}

/// Sine of the smallest angle of a triangle, negative when clockwise.
fn shape([a, b, c]: [PlanePoint; 3]) -> f64 {
    let sides = [b - a, c - b, a - c];
    let longest = sides
        .iter()
        .map(PlanePoint::norm_squared)
        .fold(0.0, f64::max);
    cross(&sides[0], &sides[1]) / longest
}

/// Cuts off the best-shaped ear again and again. Vertices on a straight edge are no ears, so that none is lost.
fn ears(polygon: &[PlanePoint]) -> Vec<[usize; 3]> {
    let mut rest: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = vec![];
    while rest.len() > 3 {
        let count = rest.len();
        let corner = |k: usize| [(k + count - 1) % count, k, (k + 1) % count].map(|k| rest[k]);
        let free = |ear: [usize; 3]| {
            let [a, b, c] = ear.map(|v| polygon[v]);
            let inside = |p: &PlanePoint| {
                [(a, b), (b, c), (c, a)]
                    .iter()
                    .all(|(from, to)| cross(&(to - from), &(p - from)) >= 0.0)
            };
            !rest
                .iter()
                .any(|v| !ear.contains(v) && inside(&polygon[*v]))
        };
        let best = (0..count)
            .map(|k| (k, shape(corner(k).map(|v| polygon[v]))))
            .filter(|(k, s)| *s > 0.0 && free(corner(*k)))
            .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        let Some((k, _)) = best else {
            break;
        };
        triangles.push(corner(k));
        rest.remove(k);
    }
    if let [a, b, c] = rest[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

/// An edge by its length; of equal ones the first counts.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Long(f64, [usize; 2]);

impl Eq for Long {}

impl Ord for Long {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Long {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Halves the longest edge inside together with the triangles on both sides of it until none is longer than `segment`.
fn halve(
    points: &mut Vec<PlanePoint>,
    triangles: Vec<[usize; 3]>,
    segment: f64,
) -> Vec<[usize; 3]> {
    let mut triangles = triangles;
    // The triangle on the left of an edge in its direction.
    let mut left: HashMap<[usize; 2], usize> = HashMap::new();
    for (t, v) in triangles.iter().enumerate() {
        for k in 0..3 {
            left.insert([v[k], v[(k + 1) % 3]], t);
        }
    }
    let long = |points: &[PlanePoint], [a, b]: [usize; 2]| {
        let length = (points[b] - points[a]).norm();
        (length > segment * (1.0 + 1.0e-9)).then_some(Long(length, [a.min(b), a.max(b)]))
    };
    let inner = left
        .keys()
        .filter(|[a, b]| a < b && left.contains_key(&[*b, *a]));
    let mut heap: BinaryHeap<Long> = inner.filter_map(|edge| long(points, *edge)).collect();
    while let Some(Long(_, [a, b])) = heap.pop() {
        let (Some(t), Some(u)) = (left.remove(&[a, b]), left.remove(&[b, a])) else {
            continue;
        };
        let opposite = |t: usize| triangles[t].into_iter().find(|v| *v != a && *v != b);
        let (Some(c), Some(d)) = (opposite(t), opposite(u)) else {
            continue;
        };
        let m = points.len();
        points.push(0.5 * (points[a] + points[b]));
        triangles[t] = [a, m, c];
        triangles[u] = [m, a, d];
        let (second, fourth) = (triangles.len(), triangles.len() + 1);
        triangles.push([m, b, c]);
        triangles.push([b, m, d]);
        for triangle in [t, u, second, fourth] {
            let v = triangles[triangle];
            for k in 0..3 {
                left.insert([v[k], v[(k + 1) % 3]], triangle);
            }
        }
        heap.extend(
            [[a, m], [m, b], [m, c], [m, d]]
                .into_iter()
                .filter_map(|edge| long(points, edge)),
        );
    }
    triangles
}
