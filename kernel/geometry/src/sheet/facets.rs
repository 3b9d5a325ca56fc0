//! Facets: the plane triangles of a sheet.

use super::bins::Bins;
use super::{PlanPoint, PlanRange};
use crate::number::fingerprint_of;
use crate::vector::Vector;
use std::fmt;

/// Share of the square of its longest side below which a triangle has no area in plan.
const NO_AREA: f64 = 1e-12;
/// Share of a triangle by which a point may lie outside it.
const ROUND_OFF: f64 = 1e-12;

/// A plane that is not vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    base: PlanPoint,
    height: f64,
    slope: [f64; 2],
}

impl Plane {
    /// The plane of one height.
    pub fn level(height: f64) -> Self {
        Self {
            base: [0.0; 2],
            height,
            slope: [0.0; 2],
        }
    }

    /// The plane through three points whose plan has an area.
    fn through([a, b, c]: [Vector; 3]) -> Self {
        let [p, q]: [Vector; 2] = [b, c].map(|x| std::array::from_fn(|k| x[k] - a[k]));
        let area = p[0] * q[1] - p[1] * q[0];
        Self {
            base: [a[0], a[1]],
            height: a[2],
            slope: [
                (p[2] * q[1] - q[2] * p[1]) / area,
                (q[2] * p[0] - p[2] * q[0]) / area,
            ],
        }
    }

    /// Its height above a point of the plan \[m\].
    pub fn at(&self, [u, v]: PlanPoint) -> f64 {
        let [a, b] = self.base;
        self.height + self.slope[0] * (u - a) + self.slope[1] * (v - b)
    }
}

/// Plane triangles, counter-clockwise in plan.
#[derive(Clone, PartialEq)]
pub struct Facets {
    corners: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
    planes: Vec<Plane>,
    bins: Bins,
}

impl Facets {
    /// Triangles without area in plan, such as those of a cliff, are left out.
    pub(super) fn new(corners: Vec<Vector>, triangles: Vec<[u32; 3]>) -> Self {
        let oriented = |triangle: [u32; 3]| {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
            let twice = cross(a, b, c);
            let sides = [(a, b), (b, c), (c, a)];
            let longest = sides
                .iter()
                .map(|(a, b)| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2))
                .fold(0.0, f64::max);
            let [i, j, k] = triangle;
            (twice.abs() > NO_AREA * longest).then_some(if twice > 0.0 {
                [i, j, k]
            } else {
                [i, k, j]
            })
        };
        let triangles: Vec<[u32; 3]> = triangles.into_iter().filter_map(oriented).collect();
        let of = |triangle: &[u32; 3]| triangle.map(|corner| corners[corner as usize]);
        let planes = triangles.iter().map(|t| Plane::through(of(t))).collect();
        let rectangles: Vec<PlanRange> = triangles.iter().map(|t| rectangle(&of(t))).collect();
        Self {
            bins: Bins::new(&rectangles),
            corners,
            triangles,
            planes,
        }
    }

    pub(super) fn extent(&self) -> PlanRange {
        self.bins.extent()
    }

    pub(super) fn near(&self, range: &PlanRange) -> Vec<u32> {
        self.bins.near(range)
    }

    pub(super) fn plane(&self, triangle: u32) -> Plane {
        self.planes[triangle as usize]
    }

    /// The corners of a triangle in plan.
    pub(super) fn plan(&self, triangle: u32) -> [PlanPoint; 3] {
        self.triangles[triangle as usize].map(|corner| {
            let [u, v, _] = self.corners[corner as usize];
            [u, v]
        })
    }

    pub(super) fn height(&self, at: PlanPoint) -> Option<f64> {
        let point = [at[0], at[1], 0.0];
        let holds = |triangle: &&u32| {
            let [a, b, c] =
                self.triangles[**triangle as usize].map(|corner| self.corners[corner as usize]);
            let least = -ROUND_OFF * cross(a, b, c);
            cross(a, b, point) >= least
                && cross(b, c, point) >= least
                && cross(c, a, point) >= least
        };
        let found = self.bins.at(at).iter().find(holds)?;
        Some(self.plane(*found).at(at))
    }

    pub(super) fn relative_to(&self, origin: &Vector) -> Self {
        let mut moved = self.clone();
        for corner in &mut moved.corners {
            *corner = std::array::from_fn(|axis| corner[axis] - origin[axis]);
        }
        for plane in &mut moved.planes {
            plane.base = [plane.base[0] - origin[0], plane.base[1] - origin[1]];
            plane.height -= origin[2];
        }
        moved.bins = self.bins.relative_to([origin[0], origin[1]]);
        moved
    }
}

impl fmt::Debug for Facets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Facets")
            .field("triangles", &self.triangles.len())
            .field("extent", &self.extent())
            .field(
                "fingerprint",
                &fingerprint_of(&self.corners, &self.triangles),
            )
            .finish_non_exhaustive()
    }
}

/// Twice the area of a triangle in plan, positive if it is counter-clockwise.
fn cross(a: Vector, b: Vector, c: Vector) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The rectangle around a triangle in plan.
pub(crate) fn rectangle(corners: &[Vector; 3]) -> PlanRange {
    [0, 1].map(|axis| {
        let x = corners.map(|corner| corner[axis]);
        [x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2])]
    })
}
