//! Meshes of quadrilaterals.

use std::f64::consts::PI;

/// Nodes and elements. The four nodes of an element run counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Positions \[m\].
    pub nodes: Vec<[f64; 2]>,
    /// Nodes of the elements.
    pub elements: Vec<[usize; 4]>,
    /// Edges of the outer boundary, where contact can act; the material is on the left of their direction.
    pub outer: Vec<[usize; 2]>,
}

impl Mesh {
    /// A rectangle from the origin to `size` \[m\], of `cells` equal elements per axis. It has no outer edges.
    #[must_use]
    pub fn rectangle(size: [f64; 2], cells: [usize; 2]) -> Self {
        let [n, m] = cells;
        let node = |i: usize, j: usize| i * (m + 1) + j;
        let nodes = (0..=n)
            .flat_map(|i| {
                (0..=m).map(move |j| [size[0] * i as f64 / n as f64, size[1] * j as f64 / m as f64])
            })
            .collect();
        let elements = (0..n)
            .flat_map(|i| {
                (0..m).map(move |j| {
                    [
                        node(i, j),
                        node(i + 1, j),
                        node(i + 1, j + 1),
                        node(i, j + 1),
                    ]
                })
            })
            .collect();
        Self {
            nodes,
            elements,
            outer: vec![],
        }
    }

    /// The upper half of a ring about `center` between two radii \[m\], of `cells` elements along the radius and
    /// around. The first nodes lie in the direction of x, the last ones opposite.
    #[must_use]
    pub fn half_ring(center: [f64; 2], inner: f64, outer: f64, cells: [usize; 2]) -> Self {
        let [n, around] = cells;
        let node = |i: usize, k: usize| k * (n + 1) + i;
        let nodes = (0..=around)
            .flat_map(|k| {
                let (sin, cos) = libm::sincos(PI * k as f64 / around as f64);
                (0..=n).map(move |i| {
                    let r = inner + (outer - inner) * i as f64 / n as f64;
                    [center[0] + r * cos, center[1] + r * sin]
                })
            })
            .collect();
        let elements = (0..around)
            .flat_map(|k| {
                (0..n).map(move |i| {
                    [
                        node(i, k),
                        node(i + 1, k),
                        node(i + 1, k + 1),
                        node(i, k + 1),
                    ]
                })
            })
            .collect();
        Self {
            nodes,
            elements,
            outer: (0..around).map(|k| [node(n, k), node(n, k + 1)]).collect(),
        }
    }

    /// Values of the bilinear shape functions of the element that holds a point of a mesh made by
    /// [`Mesh::rectangle`] with the same arguments, with its nodes.
    #[must_use]
    pub fn shape_in_rectangle(
        size: [f64; 2],
        cells: [usize; 2],
        point: [f64; 2],
    ) -> ([usize; 4], [f64; 4]) {
        let at: [(usize, f64); 2] = std::array::from_fn(|axis| {
            let s = point[axis] / size[axis] * cells[axis] as f64;
            let cell = (s as usize).min(cells[axis] - 1);
            (cell, s - cell as f64)
        });
        let [(i, s), (j, t)] = at;
        let first = i * (cells[1] + 1) + j;
        let next = first + cells[1] + 1;
        (
            [first, next, next + 1, first + 1],
            [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t],
        )
    }
}
