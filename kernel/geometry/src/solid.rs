//! Shapes as solids: the point of their surface that is nearest to another, and the side on which that lies.

use crate::shape::{Dimension, Shape, Vector};

/// The point of the surface of a shape nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// The point of the surface \[m\].
    pub point: Vector,
    /// Distance from the surface \[m\], negative inside the shape.
    pub distance: f64,
    /// Outward unit normal, the direction in which the distance grows fastest: of the face over a face, else along the line
    /// from the corner or the edge.
    pub normal: Vector,
}

impl Shape {
    /// The point of the surface of the shape that is nearest to `x`, both in the same coordinates \[m\]; `None` for a list
    /// of particles, which has no surface, and for a stratum or an enclosed body, whose surface is not searched.
    #[must_use]
    pub fn nearest(&self, dimension: Dimension, x: &Vector) -> Option<ClosestPoint> {
        let (distance, normal) = match self {
            Self::Cuboid { p1, p2 } => cuboid(p1, p2, dimension.axes(), x),
            Self::Sphere { center, radius } => {
                let (r, outward) = radial(&minus(x, center), dimension.axes());
                (r - radius, outward)
            }
            Self::Ring {
                center,
                inner,
                outer,
            } => {
                let (r, outward) = radial(&minus(x, center), 2);
                if 2.0 * r >= inner + outer {
                    (r - outer, outward)
                } else {
                    (inner - r, outward.map(|c| -c))
                }
            }
            Self::Cylinder { p1, p2, radius } => {
                let axis = minus(p2, p1);
                let length = dot(&axis, &axis).sqrt();
                let along = axis.map(|c| c / length);
                let from = minus(x, p1);
                let s = dot(&from, &along);
                let across: Vector = std::array::from_fn(|k| from[k] - s * along[k]);
                let r = dot(&across, &across).sqrt();
                let outward = if r > 0.0 {
                    across.map(|c| c / r)
                } else {
                    normal_to(&along)
                };
                prism((r - radius, outward), slab(s, [0.0, length], &along))
            }
            Self::Polygon { points } => {
                let corner = |i: usize| [points[i][0], points[i][1]];
                let (distance, [u, v]) = polygon(points.len(), corner, [x[0], x[1]])?;
                (distance, [u, v, 0.0])
            }
            Self::ExtrudedPolygon {
                points,
                axis,
                range,
            } => {
                let [i, j] = [[1, 2], [0, 2], [0, 1]][*axis];
                let (distance, [u, v]) = polygon(points.len(), |k| points[k], [x[i], x[j]])?;
                let (mut outward, mut along) = ([0.0; 3], [0.0; 3]);
                (outward[i], outward[j], along[*axis]) = (u, v, 1.0);
                prism((distance, outward), slab(x[*axis], *range, &along))
            }
            Self::Stratum(_) | Self::Enclosed(_) | Self::Particles(_) => return None,
        };
        Some(ClosestPoint {
            point: std::array::from_fn(|k| x[k] - distance * normal[k]),
            distance,
            normal,
        })
    }
}

/// Distance and normal of an axis-aligned box.
fn cuboid(p1: &Vector, p2: &Vector, axes: usize, x: &Vector) -> (f64, Vector) {
    let mut beyond = [0.0; 3];
    let (mut shallowest, mut face) = (f64::NEG_INFINITY, [0.0; 3]);
    for axis in 0..axes {
        let sides = [(p1[axis] - x[axis], -1.0), (x[axis] - p2[axis], 1.0)];
        for (out, sign) in sides {
            if out > 0.0 {
                beyond[axis] = sign * out;
            }
            if out > shallowest {
                (shallowest, face) = (out, [0.0; 3]);
                face[axis] = sign;
            }
        }
    }
    let outside = beyond.iter().filter(|c| **c != 0.0).count();
    if outside < 2 {
        return (shallowest, face);
    }
    let distance = dot(&beyond, &beyond).sqrt();
    (distance, beyond.map(|c| c / distance))
}

/// Distance from a centre, and the direction away from it; up at the centre itself.
fn radial(from: &Vector, axes: usize) -> (f64, Vector) {
    let from: Vector = std::array::from_fn(|k| if k < axes { from[k] } else { 0.0 });
    let r = dot(&from, &from).sqrt();
    if r > 0.0 {
        (r, from.map(|c| c / r))
    } else {
        (0.0, [0.0, 1.0, 0.0])
    }
}

/// Distance and normal of the space between two planes across a direction, for a point at `s` along it.
fn slab(s: f64, [low, high]: [f64; 2], along: &Vector) -> (f64, Vector) {
    let (below, above) = (low - s, s - high);
    if above >= below {
        (above, *along)
    } else {
        (below, along.map(|c| -c))
    }
}

/// Distance and normal of what lies in two solids whose normals are perpendicular.
fn prism((a, normal_a): (f64, Vector), (b, normal_b): (f64, Vector)) -> (f64, Vector) {
    if a > 0.0 && b > 0.0 {
        let distance = (a * a + b * b).sqrt();
        let normal = std::array::from_fn(|k| (a * normal_a[k] + b * normal_b[k]) / distance);
        (distance, normal)
    } else if a >= b {
        (a, normal_a)
    } else {
        (b, normal_b)
    }
}

/// Distance and normal of a simple polygon of either orientation.
fn polygon(
    count: usize,
    corner: impl Fn(usize) -> [f64; 2],
    x: [f64; 2],
) -> Option<(f64, [f64; 2])> {
    let next = |i: usize| (i + 1) % count;
    let twice_area: f64 = (0..count)
        .map(|i| {
            let (a, b) = (corner(i), corner(next(i)));
            a[0] * b[1] - a[1] * b[0]
        })
        .sum();
    let turn = twice_area.signum();
    let normal = |i: usize| {
        let (a, b) = (corner(i), corner(next(i)));
        let (u, v) = (b[0] - a[0], b[1] - a[1]);
        let length = (u * u + v * v).sqrt();
        [turn * v / length, -turn * u / length]
    };
    // Squared distance, edge, and the share of the edge at which its nearest point lies.
    let mut best: Option<(f64, usize, f64)> = None;
    for i in 0..count {
        let (a, b) = (corner(i), corner(next(i)));
        let (u, v) = (b[0] - a[0], b[1] - a[1]);
        let share = ((x[0] - a[0]) * u + (x[1] - a[1]) * v) / (u * u + v * v);
        let share = share.clamp(0.0, 1.0);
        let (du, dv) = (x[0] - a[0] - share * u, x[1] - a[1] - share * v);
        let square = du * du + dv * dv;
        if best.is_none_or(|(least, ..)| square < least) {
            best = Some((square, i, share));
        }
    }
    let (square, edge, share) = best?;
    let (a, b, of_edge) = (corner(edge), corner(next(edge)), normal(edge));
    if share > 0.0 && share < 1.0 {
        let side = (x[0] - a[0]) * of_edge[0] + (x[1] - a[1]) * of_edge[1];
        return Some((side, of_edge));
    }
    // At a corner the mean of its two edges says on which side the point is.
    let (at, other) = if share <= 0.0 {
        (a, normal((edge + count - 1) % count))
    } else {
        (b, normal(next(edge)))
    };
    let mean = [of_edge[0] + other[0], of_edge[1] + other[1]];
    let away = [x[0] - at[0], x[1] - at[1]];
    let sign = if away[0] * mean[0] + away[1] * mean[1] < 0.0 {
        -1.0
    } else {
        1.0
    };
    let distance = square.sqrt();
    let scale = x[0].abs().max(x[1].abs()).max(at[0].abs().max(at[1].abs()));
    if distance <= 1e-9 * scale {
        return Some((sign * distance, of_edge));
    }
    Some((sign * distance, away.map(|c| sign * c / distance)))
}

/// A unit vector across another.
fn normal_to(v: &Vector) -> Vector {
    let axis = usize::from(v[0].abs() >= 0.6);
    let mut across = v.map(|c| -c * v[axis]);
    across[axis] += 1.0;
    let length = dot(&across, &across).sqrt();
    across.map(|c| c / length)
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
