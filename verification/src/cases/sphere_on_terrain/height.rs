//! The height of a terrain over the ground, from its triangles one by one, as a check of the kernel's search.

use crate::cases::prelude::*;

/// Triangles by the squares of the ground that they lie over.
pub struct HeightField {
    triangles: Vec<[Vector; 3]>,
    low: [f64; 2],
    /// Edge of a square \[m\].
    edge: f64,
    squares: [usize; 2],
    over: Vec<Vec<usize>>,
    highest: f64,
}

impl HeightField {
    /// The height field of a surface that is nowhere steep beyond the vertical.
    pub fn new(surface: &Surface) -> Self {
        let (low, high) = surface.bounds();
        let count = surface.triangle_count();
        let edge = ((high[0] - low[0]) * (high[1] - low[1]) / count as f64).sqrt();
        let squares = [0, 1].map(|axis| ((high[axis] - low[axis]) / edge) as usize + 1);
        let mut field = Self {
            triangles: (0..count).map(|t| surface.corners(t)).collect(),
            low: [low[0], low[1]],
            edge,
            squares,
            over: vec![vec![]; squares[0] * squares[1]],
            highest: high[2],
        };
        for (t, corners) in field.triangles.iter().enumerate() {
            let [first, last] = [f64::min as fn(f64, f64) -> f64, f64::max].map(|pick| {
                let of = |axis: usize| corners.map(|x| x[axis]).into_iter().reduce(pick);
                [0, 1].map(|axis| field.square(axis, of(axis).unwrap_or(f64::NAN)))
            });
            for i in first[0]..=last[0] {
                for j in first[1]..=last[1] {
                    field.over[i * squares[1] + j].push(t);
                }
            }
        }
        field
    }

    /// The highest point of the terrain \[m\].
    pub fn highest(&self) -> f64 {
        self.highest
    }

    fn square(&self, axis: usize, x: f64) -> usize {
        (((x - self.low[axis]) / self.edge).max(0.0) as usize).min(self.squares[axis] - 1)
    }

    /// Height of the terrain below or above a point \[m\]; `None` beside it.
    pub fn height(&self, x: &Vector) -> Option<f64> {
        let square = self.square(0, x[0]) * self.squares[1] + self.square(1, x[1]);
        self.over[square].iter().find_map(|&t| {
            let [a, b, c] = self.triangles[t];
            let area = |p: &Vector, q: &Vector, r: &Vector| {
                (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
            };
            let whole = area(&a, &b, &c);
            let shares = [area(x, &b, &c), area(&a, x, &c), area(&a, &b, x)].map(|s| s / whole);
            // A point on the line between two triangles belongs to both.
            shares
                .iter()
                .all(|s| *s >= -1e-12)
                .then(|| shares[0] * a[2] + shares[1] * b[2] + shares[2] * c[2])
        })
    }
}
