//! Mortar segment-to-segment contact between boundaries of vertices (Liang, Fang, Yin and Zhao 2024): polylines in two
//! dimensions, triangles in three.
//!
//! The parts, in the order in which a step uses them:
//! - [`boundary`]: the polylines, checked; [`outline`]: polylines of the shapes of bodies; [`overlap`]: polylines that
//!   lie in each other at the start; [`space`]: the same made of
//!   triangles, and what projection and clipping are there;
//! - [`tie`]: where the material says that a vertex is; [`weights`]: augmented weights of a vertex, which give no share to
//!   nodes without mass; [`motion`]: how vertices follow the body;
//! - [`sites`]: where a slave has normals; [`elements`]: what a boundary of either dimension is to the rest; [`broad`]: pairs of elements that can meet;
//! - [`points`]: the points at which integrals over a contact are evaluated; [`segments`]: how they are found in the
//!   plane, by projection and mortar segments;
//! - [`law`]: pressure against gap; [`pair`]: weighted gaps, friction and forces of a pair of boundaries;
//! - [`bound`]: the time step that the stiffness of the contact allows.
//!
//! The paper is read so: the gap g = n_s . (x_m - x_s) is positive when apart (eq. 31 has the other sign than 37 and
//! 40); forces are f_s = -D lambda and f_m = M^T lambda with a tangential traction that has the sign of the slip
//! (eq. 50 has none) and is mapped back to the cone; the slip of eq. 51 is divided by the row sum of D, as the gap
//! is; vertices follow the velocity at the end of the step (eq. 29 prints that at its beginning, with which rolling
//! blows up), and by default they do not integrate velocities but stay on the particles around them; the barrier goes on below the gap instead of ending there (eq. 48 lets bodies pass through each other
//! in explicit steps).

pub mod bound;
pub mod boundary;
pub mod broad;
pub mod elements;
pub mod law;
pub mod motion;
pub mod outline;
pub mod overlap;
pub mod pair;
pub mod points;
pub mod segments;
pub mod sites;
pub mod space;
pub mod tie;
pub mod weights;

/// A point or vector of the plane \[m\].
pub type Point = nalgebra::Vector2<f64>;

/// A point or vector in D dimensions \[m\].
pub type PointIn<const D: usize> = nalgebra::SVector<f64, D>;

/// z component of the product a x b.
#[inline]
#[must_use]
pub fn cross(a: &Point, b: &Point) -> f64 {
    a.x * b.y - a.y * b.x
}
