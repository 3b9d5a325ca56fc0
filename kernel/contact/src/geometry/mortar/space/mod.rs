//! Mortar contact in three dimensions: boundaries made of triangles.
//!
//! - [`facets`]: triangulated boundaries, checked, with their normals and frames; [`skin`]: those of shapes, refined by
//!   [`refine`];
//! - [`clip`]: overlap of two triangles of a plane, and quadrature on it; [`projection`]: master triangles seen from a
//!   slave triangle;
//! - [`ridges`]: sharp edges that meet, which contact between faces does not see.
//!
//! Differences from the plane: the slave is projected triangle by triangle along its own normal onto an auxiliary
//! plane (Puso and Laursen 2004), since a projection along interpolated normals has no closed form in space; the slip
//! has two components, along tangents that turn with the surface.

pub mod clip;
pub mod facets;
pub mod projection;
pub mod refine;
pub mod ridges;
pub mod skin;

use nalgebra::Vector3;

/// A point or vector in space \[m\].
pub type Point = Vector3<f64>;

/// Resultant of forces on vertices \[N\], and their moment about a point \[N m\].
#[must_use]
pub fn resultant(points: &[Point], forces: &[Point], about: &Point) -> (Point, Point) {
    points
        .iter()
        .zip(forces)
        .fold((Point::zeros(), Point::zeros()), |(sum, moment), (x, f)| {
            (sum + f, moment + (x - about).cross(f))
        })
}
