//! The plane that separates the particles of two bodies near a node.
//!
//! A mass gradient turns beside a free corner, an edge or the end of a wall, though the face there is flat. The shortest
//! way between the convex hulls of the particles of both bodies does not: it is across the face up to its very end, and
//! it is one and the same whichever body is called the master. It is found by the method of Gilbert, Johnson and Keerthi
//! (1988), in space and in the plane. Logistic regression (Nairn, Hammerquist & Smith 2021) finds the same plane in the
//! limit of no penalty; with one, a body that ends beside the node still turns it by some degrees.

use proctor_kernel::model::Vector;

/// Most points that are taken up; each brings the hulls nearer, and a dozen is much.
const MOST_POINTS: usize = 64;
/// Share of the distance below which a further point brings nothing.
const PRECISION: f64 = 1e-15;
/// Length of the way between hulls, over the extent of the points, below which they are not apart.
const APART: f64 = 1e-9;
/// Share of the product of squared edges below which points of a simplex lie in one plane or line.
const FLAT: f64 = 1e-12;

/// Particles of a pair near a node, relative to it \[m\].
#[derive(Clone, Debug, Default)]
pub struct Cloud {
    /// Particles of the master and those of the slave.
    pub points: [Vec<Vector>; 2],
}

impl Cloud {
    /// The shortest way from the hull of the master to that of the slave \[m\]; `None` where the hulls meet, or one is
    /// empty. `first` is a first guess: the way between two particles that bound the hulls along some direction. A way that is
    /// no longer than `enough` \[m\] may be longer than the shortest.
    #[must_use]
    pub fn way(&self, first: Vector, enough: f64) -> Option<Vector> {
        if self.points.iter().any(Vec::is_empty) {
            return None;
        }
        let mut simplex = Simplex {
            points: [first; 4],
            count: 1,
        };
        let mut way = first;
        let mut extent = dot(&first, &first);
        for _ in 0..MOST_POINTS {
            let square = dot(&way, &way);
            if square <= APART * APART * extent {
                return None;
            }
            if enough > 0.0 && square <= enough * enough {
                break;
            }
            let next = self.nearest_along(&way)?;
            extent = extent.max(dot(&next, &next));
            if square - dot(&way, &next) <= PRECISION * square || simplex.has(&next) {
                break;
            }
            let shorter = simplex.take(next);
            if dot(&shorter, &shorter) >= square {
                break;
            }
            way = shorter;
        }
        Some(way)
    }

    /// Distance by which a direction separates the particles \[m\]; negative where it does not.
    #[must_use]
    pub fn margin(&self, normal: &Vector) -> f64 {
        self.nearest_along(normal)
            .map_or(f64::NEG_INFINITY, |between| dot(&between, normal))
    }

    /// Vector from the middle of the particles of the master to that of the slave \[m\].
    #[must_use]
    pub fn between_middles(&self) -> Vector {
        let middle = |points: &[Vector], axis: usize| {
            points.iter().map(|x| x[axis]).sum::<f64>() / points.len() as f64
        };
        std::array::from_fn(|axis| middle(&self.points[1], axis) - middle(&self.points[0], axis))
    }

    /// The way from the particle of the master that is farthest along a direction to that of the slave that is least far \[m\];
    /// `None` where a body has none.
    #[must_use]
    pub fn nearest_along(&self, direction: &Vector) -> Option<Vector> {
        let [master, slave] = &self.points;
        let m = farthest(master, direction)?;
        let s = farthest(slave, &direction.map(|c| -c))?;
        Some(std::array::from_fn(|axis| s[axis] - m[axis]))
    }
}

/// The first of the points that are farthest along a direction.
fn farthest(points: &[Vector], direction: &Vector) -> Option<Vector> {
    let (mut most, mut best) = (f64::NEG_INFINITY, None);
    for (index, x) in points.iter().enumerate() {
        let along = dot(x, direction);
        if along > most {
            (most, best) = (along, Some(index));
        }
    }
    best.map(|index| points[index])
}

/// Up to four points whose hull is nearest to the origin so far.
struct Simplex {
    points: [Vector; 4],
    count: usize,
}

impl Simplex {
    fn has(&self, point: &Vector) -> bool {
        self.points[..self.count].contains(point)
    }

    /// Takes up a point that lies nearer to the origin; the simplex becomes the face on which its nearest point lies, which
    /// is returned. The new point is one of its corners.
    fn take(&mut self, point: Vector) -> Vector {
        let mut best = (f64::INFINITY, [0.0; 3], self.points, 1);
        for face in 0..1_usize << self.count {
            let (mut corners, mut count) = ([point; 4], 1);
            for corner in 0..self.count {
                if face & (1 << corner) != 0 {
                    corners[count.min(3)] = self.points[corner];
                    count += 1;
                }
            }
            if count > 4 {
                continue;
            }
            if let Some(foot) = foot(&corners[..count]) {
                let square = dot(&foot, &foot);
                if square < best.0 {
                    best = (square, foot, corners, count);
                }
            }
        }
        (self.points, self.count) = (best.2, best.3);
        best.1
    }
}

/// The foot of the perpendicular from the origin on the plane of one to four corners, where it lies between them.
fn foot(corners: &[Vector]) -> Option<Vector> {
    let start = corners[0];
    let n = corners.len() - 1;
    let mut edges = [[0.0; 3]; 3];
    let mut right = [0.0; 3];
    for i in 0..n {
        edges[i] = std::array::from_fn(|axis| corners[i + 1][axis] - start[axis]);
        right[i] = -dot(&edges[i], &start);
    }
    let g = |i: usize, j: usize| dot(&edges[i], &edges[j]);
    let scale: f64 = (0..n).map(|i| g(i, i)).product();
    let (whole, shares): (f64, [f64; 3]) = match n {
        0 => return Some(start),
        1 => (g(0, 0), [right[0], 0.0, 0.0]),
        2 => {
            let (a, b, c) = (g(0, 0), g(0, 1), g(1, 1));
            let shares = [
                right[0] * c - right[1] * b,
                a * right[1] - b * right[0],
                0.0,
            ];
            (a * c - b * b, shares)
        }
        _ => {
            let column = |j: usize| -> Vector { std::array::from_fn(|i| g(i, j)) };
            let all = [column(0), column(1), column(2)];
            let with = |place: usize| {
                let mut columns = all;
                columns[place] = right;
                determinant(&columns)
            };
            (determinant(&all), [with(0), with(1), with(2)])
        }
    };
    if whole <= FLAT * scale {
        return None;
    }
    let inside = shares[..n].iter().all(|s| *s >= 0.0) && shares[..n].iter().sum::<f64>() <= whole;
    inside.then(|| {
        let mut point = start;
        for (edge, share) in edges[..n].iter().zip(shares) {
            for axis in 0..3 {
                point[axis] += share / whole * edge[axis];
            }
        }
        point
    })
}

fn determinant([a, b, c]: &[Vector; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1])
        + c[0] * (a[1] * b[2] - a[2] * b[1])
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
