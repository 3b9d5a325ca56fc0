//! Shapes of bodies, and the space that they are in.

use crate::enclosed::EnclosedRegion;
use crate::stratum::Stratum;
use std::sync::Arc;

pub use crate::vector::Vector;

/// Number of space dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Plane strain in the x-y plane, unit thickness (1 m).
    Two,
    /// Three dimensions.
    Three,
}

impl Dimension {
    /// Number of axes, 2 or 3.
    #[must_use]
    pub fn axes(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}

/// Shape of a body, in the coordinates of the scene \[m\].
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Axis-aligned box between two corners; a rectangle in two dimensions.
    Cuboid {
        /// Lower corner.
        p1: Vector,
        /// Upper corner.
        p2: Vector,
    },
    /// Sphere; a disc in two dimensions.
    Sphere {
        /// Centre.
        center: Vector,
        /// Radius.
        radius: f64,
    },
    /// Ring between two radii (2D).
    Ring {
        /// Centre.
        center: Vector,
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
    },
    /// Circular cylinder between the centres of its two end faces (3D).
    Cylinder {
        /// Centre of the first end face.
        p1: Vector,
        /// Centre of the second end face.
        p2: Vector,
        /// Radius.
        radius: f64,
    },
    /// Simple polygon, either orientation, not closed (2D).
    Polygon {
        /// Corners; the third component is unused.
        points: Vec<Vector>,
    },
    /// Simple polygon extruded along an axis (3D).
    ExtrudedPolygon {
        /// Corners in the plane of the two other axes, in axis order.
        points: Vec<[f64; 2]>,
        /// Axis of extrusion, 0 to 2.
        axis: usize,
        /// Lower and upper coordinate along the axis.
        range: [f64; 2],
    },
    /// Ground between sheets, such as a terrain and the base of a layer.
    Stratum(Arc<Stratum>),
    /// The inside of a closed surface of triangles (3D).
    Enclosed(Arc<EnclosedRegion>),
    /// Particles given one by one.
    Particles(Arc<Vec<ParticleSeed>>),
}

impl Shape {
    /// True if the nearest point of its surface can be found: see [`Shape::nearest`].
    #[must_use]
    pub fn has_surface(&self) -> bool {
        !matches!(
            self,
            Self::Stratum(_) | Self::Enclosed(_) | Self::Particles(_)
        )
    }

    /// Radius of a shape that can roll: a sphere, disc, ring or cylinder \[m\].
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        match *self {
            Self::Sphere { radius, .. } | Self::Cylinder { radius, .. } => Some(radius),
            Self::Ring { outer, .. } => Some(outer),
            _ => None,
        }
    }

    /// The radius, or half of the smallest extent along the axes of a dimension \[m\]; infinite for a polygon or a list of
    /// particles with nothing in it.
    #[must_use]
    pub fn half_size(&self, dimension: Dimension) -> f64 {
        let of = |points: &mut dyn Iterator<Item = Vector>, axes: usize| {
            let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
            for x in points {
                low = std::array::from_fn(|axis| low[axis].min(x[axis]));
                high = std::array::from_fn(|axis| high[axis].max(x[axis]));
            }
            let extents = (0..axes).map(|axis| 0.5 * (high[axis] - low[axis]).abs());
            extents.fold(f64::INFINITY, f64::min)
        };
        let axes = dimension.axes();
        match self {
            Self::Cuboid { p1, p2 } => of(&mut [*p1, *p2].into_iter(), axes),
            Self::Polygon { points } => of(&mut points.iter().copied(), 2),
            Self::ExtrudedPolygon { points, range, .. } => {
                let flat = points.iter().map(|[u, v]| [*u, *v, 0.0]);
                let across = of(&mut flat.into_iter(), 2);
                across.min(0.5 * (range[1] - range[0]).abs())
            }
            Self::Stratum(stratum) => of(&mut stratum.bounds().into_iter(), axes),
            Self::Enclosed(body) => of(&mut body.bounds().into_iter(), axes),
            Self::Particles(seeds) => of(&mut seeds.iter().map(|seed| seed.position), axes),
            Self::Sphere { radius, .. } | Self::Cylinder { radius, .. } => *radius,
            Self::Ring { outer, .. } => *outer,
        }
    }
}

/// One particle of a particle list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleSeed {
    /// Position \[m\].
    pub position: Vector,
    /// Volume \[m³\]; in two dimensions area times unit thickness.
    pub volume: f64,
}

impl Shape {
    /// Lower and upper corner of the box around it \[m\]; `None` for a polygon or a list of particles with nothing in it.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vector; 2]> {
        let around = |center: &Vector, radius: f64| {
            [-1.0, 1.0].map(|side| center.map(|x| x + side * radius))
        };
        Some(match self {
            Self::Cuboid { p1, p2 } => [*p1, *p2],
            Self::Sphere { center, radius } => around(center, *radius),
            Self::Ring { center, outer, .. } => around(center, *outer),
            Self::Cylinder { p1, p2, radius } => {
                let along: Vector = std::array::from_fn(|axis| p2[axis] - p1[axis]);
                let square: f64 = along.iter().map(|c| c * c).sum();
                let of_end = |axis: usize| {
                    radius * (1.0 - along[axis] * along[axis] / square).max(0.0).sqrt()
                };
                [
                    std::array::from_fn(|axis| p1[axis].min(p2[axis]) - of_end(axis)),
                    std::array::from_fn(|axis| p1[axis].max(p2[axis]) + of_end(axis)),
                ]
            }
            Self::Polygon { points } => box_around(points.iter().copied())?,
            Self::ExtrudedPolygon {
                points,
                axis,
                range,
            } => {
                let corner = |end: f64| {
                    points.iter().map(move |[u, v]| match axis {
                        0 => [end, *u, *v],
                        1 => [*u, end, *v],
                        _ => [*u, *v, end],
                    })
                };
                box_around(corner(range[0]).chain(corner(range[1])))?
            }
            Self::Stratum(stratum) => stratum.bounds(),
            Self::Enclosed(body) => body.bounds(),
            Self::Particles(seeds) => box_around(seeds.iter().map(|seed| seed.position))?,
        })
    }

    /// A rectangle of the plane between two corners \[m\].
    #[must_use]
    pub fn rectangle([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> Self {
        Self::Cuboid {
            p1: [x_1, y_1, 0.0],
            p2: [x_2, y_2, 0.0],
        }
    }

    /// A disc of the plane \[m\].
    #[must_use]
    pub fn disc([x, y]: [f64; 2], radius: f64) -> Self {
        Self::Sphere {
            center: [x, y, 0.0],
            radius,
        }
    }

    /// The same shape in coordinates that begin at `origin`. What is far from zero but near `origin` loses no digit.
    #[must_use]
    pub fn relative_to(&self, origin: &Vector) -> Self {
        let moved = |x: &Vector| -> Vector { std::array::from_fn(|axis| x[axis] - origin[axis]) };
        match self {
            Self::Cuboid { p1, p2 } => Self::Cuboid {
                p1: moved(p1),
                p2: moved(p2),
            },
            Self::Sphere { center, radius } => Self::Sphere {
                center: moved(center),
                radius: *radius,
            },
            Self::Ring {
                center,
                inner,
                outer,
            } => Self::Ring {
                center: moved(center),
                inner: *inner,
                outer: *outer,
            },
            Self::Cylinder { p1, p2, radius } => Self::Cylinder {
                p1: moved(p1),
                p2: moved(p2),
                radius: *radius,
            },
            Self::Polygon { points } => Self::Polygon {
                points: points.iter().map(moved).collect(),
            },
            Self::ExtrudedPolygon {
                points,
                axis,
                range,
            } => {
                let [u, v] = [(1, 2), (0, 2), (0, 1)].map(|(u, v)| [origin[u], origin[v]])[*axis];
                Self::ExtrudedPolygon {
                    points: points.iter().map(|[a, b]| [a - u, b - v]).collect(),
                    axis: *axis,
                    range: range.map(|x| x - origin[*axis]),
                }
            }
            Self::Stratum(stratum) => Self::Stratum(Arc::new(stratum.relative_to(origin))),
            Self::Enclosed(body) => Self::Enclosed(Arc::new(body.relative_to(origin))),
            Self::Particles(seeds) => {
                let seed = |seed: &ParticleSeed| ParticleSeed {
                    position: moved(&seed.position),
                    ..*seed
                };
                Self::Particles(Arc::new(seeds.iter().map(seed).collect()))
            }
        }
    }

    /// Word for the shape in a scene file, by the number of dimensions.
    #[must_use]
    pub fn word(&self, dimension: Dimension) -> &'static str {
        match (self, dimension) {
            (Self::Cuboid { .. }, Dimension::Three) => "cuboid",
            (Self::Cuboid { .. }, Dimension::Two) => "rectangle",
            (Self::Sphere { .. }, Dimension::Three) => "sphere",
            (Self::Sphere { .. }, Dimension::Two) => "disc",
            (Self::Ring { .. }, _) => "ring",
            (Self::Cylinder { .. }, _) => "cylinder",
            (Self::Polygon { .. }, _) => "polygon",
            (Self::ExtrudedPolygon { .. }, _) => "extruded_polygon",
            (Self::Stratum(_), _) => "between",
            (Self::Enclosed(_), _) => "solid",
            (Self::Particles(_), _) => "particles",
        }
    }
}

/// Lower and upper corner of the box around points; `None` where there are none.
fn box_around(points: impl Iterator<Item = Vector>) -> Option<[Vector; 2]> {
    points.fold(None, |all, x| {
        let [low, high] = all.unwrap_or([x, x]);
        Some([
            std::array::from_fn(|axis| low[axis].min(x[axis])),
            std::array::from_fn(|axis| high[axis].max(x[axis])),
        ])
    })
}
