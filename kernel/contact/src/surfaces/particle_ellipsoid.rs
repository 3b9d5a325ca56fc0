//! The ellipsoid in the domain of a particle, with which it touches a surface.

use crate::geometry::surface::NearestPoint;
use proctor_kernel::layout::Layout;
use proctor_kernel::model::Vector;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::{BodyRun, StepView};
use std::f64::consts::TAU;

/// Reach of the ellipsoid with these half-lengths along a unit normal \[m\].
pub(super) fn reach(half: &Vector, normal: &Vector) -> f64 {
    length(&std::array::from_fn(|axis| half[axis] * normal[axis]))
}

/// Point where the ellipsoid with these half-lengths touches a surface, from its centre \[m\]. Of a particle that is pressed
/// together to less than half of it the point comes nearer to the centre, and ends there: so no strain brings a centre through
/// a surface. For less strain it stays where a row of particles ends that a wall presses on.
pub(super) fn touching_point(half: &Vector, nearest: &NearestPoint) -> Vector {
    let normal = &nearest.normal;
    let reach = reach(half, normal);
    let pressed = (2.0 * nearest.distance / reach).clamp(0.0, 1.0);
    std::array::from_fn(|axis| -pressed * half[axis] * half[axis] * normal[axis] / reach)
}

/// Half-lengths of the domain of a particle \[m\]. Weighting functions without a domain leave the volume of a particle that is given
/// by place and volume: a cube, in the plane a square of the thickness of 1 m, about an axis the square of a ring.
pub(super) fn half_lengths(set: &ParticleSet, body: &BodyRun, p: usize) -> Vector {
    if let Some(half) = body.reach {
        return half;
    }
    match body.mapping.half_length_column {
        Some(first) => std::array::from_fn(|axis| {
            if axis < set.layout.axes {
                set.columns[first + axis][p] * body.mapping.cell[axis]
            } else {
                0.0
            }
        }),
        None if set.layout.axes == 3 => [0.5 * libm::cbrt(set.columns[Layout::VOLUME][p]); 3],
        None => {
            let depth = if set.layout.axisymmetric {
                TAU * (set.columns[Layout::POSITION][p] + body.mapping.first_radius)
            } else {
                1.0
            };
            let half = 0.5 * (set.columns[Layout::VOLUME][p] / depth).sqrt();
            [half, half, 0.0]
        }
    }
}

pub(super) fn length(v: &Vector) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// A position relative to the mesh as it is in the coordinates of a local surface that has moved by `shift`.
pub(super) fn on_surface(view: &StepView<'_>, x: &Vector, shift: &Vector) -> Vector {
    std::array::from_fn(|axis| x[axis] + view.mesh_shift[axis] - shift[axis])
}
