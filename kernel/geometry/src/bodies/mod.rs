//! Bodies: from a shape to particles.
//!
//! [`fill`] turns a [`Shape`] into positions, volumes and half-lengths of particles.
//!
//! - A cuboid gets its own lattice: per axis the fewest equal intervals that are not longer than the
//!   sub-cell h / ppc. An edge within round-off of a sub-cell line is that line, so that a box that is
//!   aligned with the mesh has particles exactly in the sub-cell centres (k + 1/2) h / ppc.
//! - Every other shape takes the sub-cell centres of the mesh that lie strictly inside it. A centre on the
//!   surface, within round-off, is outside: the rule is the same for mirrored and turned shapes, and two
//!   bodies that touch never hold the same point twice.
//!   The particles of all parts of ground between sheets have one volume.
//! - A particle list is taken as given.
//!
//! Volumes sum to the exact volume of the shape. Particles come in lexicographic order of position, the first
//! axis slowest (a particle list keeps its own order).
//!
//! Left out: sub-cells cut by a curved surface are in or out as a whole, so the surface is a staircase of
//! height h / ppc, and the centre of mass of a shape that the mesh does not mirror is off by O(h / ppc).

mod ball;
mod columns;
mod cuboid;
mod cylinder;
mod error;
mod lattice;
mod list;
mod polygon;

pub use error::FillError;

use crate::memory::Memory;
use crate::mesh::Mesh;
use crate::shape::{Dimension, Shape};
use lattice::Lattice;

/// The particles of one body.
#[derive(Clone, Debug, PartialEq)]
pub struct FilledBody {
    /// Positions relative to [`Mesh::origin`] \[m\], one vector of coordinates per axis; the third is all
    /// zero in two dimensions. Relative, because at an origin of 1e6 m an absolute coordinate is good to
    /// 1e-10 m only.
    pub x: [Vec<f64>; 3],
    /// Volumes \[m³\]; in two dimensions area times unit thickness.
    pub volume: Vec<f64>,
    /// Half-lengths `l_p` of the particle domains.
    pub half_length: HalfLength,
    /// Volume of the shape \[m³\], which the particle volumes sum to; for a particle list their sum.
    pub exact_volume: f64,
    /// Slices of the whole body across the first axis, in ascending order; none of a particle list. A body that was filled in
    /// a range alone has the particles of the slices in that range.
    pub slices: Vec<FilledSlice>,
}

/// Particles of a body with the same first coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilledSlice {
    /// That coordinate, relative to [`Mesh::origin`] \[m\].
    pub x: f64,
    /// Number of particles.
    pub count: u64,
}

/// All first coordinates.
pub const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl FilledBody {
    /// Number of particles.
    #[must_use]
    pub fn count(&self) -> usize {
        self.volume.len()
    }

    /// Number of particles of the whole body, in whatever range it was filled.
    #[must_use]
    pub fn whole_count(&self) -> u64 {
        if self.slices.is_empty() {
            return self.count() as u64;
        }
        self.slices.iter().map(|slice| slice.count).sum()
    }
}

/// Half-lengths `l_p` of the particle domains per axis \[m\]; the third is 0.5 in two dimensions.
///
/// In a shape filled from the mesh lattice they are half a sub-cell and, unlike the volumes, not rescaled to
/// the exact volume: the domains then tile the interior without gap or overlap, and a uniform interior stays
/// uniform on the nodes. Only the volume carries the correction of the staircase surface.
#[derive(Clone, Debug, PartialEq)]
pub enum HalfLength {
    /// The same for all particles.
    Uniform([f64; 3]),
    /// One vector per axis, one value per particle.
    PerParticle([Vec<f64>; 3]),
}

impl HalfLength {
    /// Half-lengths of one particle per axis \[m\].
    ///
    /// # Panics
    ///
    /// If there is one value per particle and `index` is not a particle.
    #[must_use]
    pub fn of(&self, index: usize) -> [f64; 3] {
        match self {
            Self::Uniform(l_p) => *l_p,
            Self::PerParticle(l_p) => [l_p[0][index], l_p[1][index], l_p[2][index]],
        }
    }
}

/// Bytes of a particle in [`FilledBody`]: position, volume and half-lengths.
pub const FILLED: f64 = 56.0;

/// Needs of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemoryRoom {
    /// Memory that is free.
    pub memory: Memory,
    /// Bytes for each particle.
    pub per_particle: f64,
}

/// About how many particles a shape gets: its volume over that of a sub-cell. Not a number where the shape has none.
#[must_use]
pub fn expected(shape: &Shape, particles_per_cell: [usize; 3], mesh: &Mesh, axes: usize) -> f64 {
    let sub_cell: f64 = (0..axes)
        .map(|axis| mesh.cell[axis] / particles_per_cell[axis] as f64)
        .product();
    let volume = match shape {
        Shape::Particles(seeds) => return seeds.len() as f64,
        Shape::Cuboid { p1, p2 } => (0..axes).map(|axis| p2[axis] - p1[axis]).product(),
        Shape::Sphere { radius, .. } => ball::volume(axes, 0.0, *radius),
        Shape::Ring { inner, outer, .. } => ball::volume(axes, *inner, *outer),
        Shape::Cylinder { p1, p2, radius } => cylinder::volume(p1, p2, *radius),
        Shape::Polygon { points } => {
            let plane: Vec<_> = points.iter().map(|p| [p[0], p[1]]).collect();
            polygon::area(&plane)
        }
        Shape::ExtrudedPolygon { points, range, .. } => {
            polygon::area(points) * (range[1] - range[0])
        }
        Shape::Stratum(stratum) => stratum.volume(),
        Shape::Enclosed(body) => body.volume(),
    };
    volume / sub_cell
}

/// Fills a shape with particles, so many per cell and axis. Deterministic: the same arguments give the same bits.
///
/// # Errors
///
/// [`FillError`] where the body gets no particle, a particle lies outside the mesh, a number is not finite or
/// not positive, the shape does not exist in this dimension, or the particles do not fit into memory.
pub fn fill(
    shape: &Shape,
    particles_per_cell: [usize; 3],
    mesh: &Mesh,
    dimension: Dimension,
) -> Result<FilledBody, FillError> {
    let room = MemoryRoom {
        memory: Memory::of_machine(),
        per_particle: FILLED,
    };
    fill_within(
        shape,
        particles_per_cell,
        (mesh, dimension),
        EVERYWHERE,
        &room,
    )
}

/// [`fill`] of the slices whose first coordinate, relative to the origin of the mesh, lies in `range` \[m\], its end excluded;
/// unless the particles and what is made of them need more than there is room for. A particle list comes as a whole.
///
/// # Errors
/// As [`fill`]. A body without a particle in the range has none, and is no error.
pub fn fill_within(
    shape: &Shape,
    particles_per_cell: [usize; 3],
    (mesh, dimension): (&Mesh, Dimension),
    range: [f64; 2],
    room: &MemoryRoom,
) -> Result<FilledBody, FillError> {
    // A particle list needs no lattice.
    let lattice = || {
        let lattice = Lattice::new(mesh, particles_per_cell, dimension, *room);
        lattice.map(|lattice| lattice.within(range))
    };
    let refuse = |shape| Err(FillError::Dimension { shape, dimension });
    match (shape, dimension) {
        (Shape::Cuboid { p1, p2 }, _) => cuboid::fill(&lattice()?, *p1, *p2),
        (Shape::Sphere { center, radius }, _) => ball::fill(&lattice()?, *center, 0.0, *radius),
        (
            Shape::Ring {
                center,
                inner,
                outer,
            },
            Dimension::Two,
        ) => ball::fill(&lattice()?, *center, *inner, *outer),
        (Shape::Cylinder { p1, p2, radius }, Dimension::Three) => {
            cylinder::fill(&lattice()?, *p1, *p2, *radius)
        }
        (Shape::Polygon { points }, Dimension::Two) => polygon::fill(&lattice()?, points),
        (
            Shape::ExtrudedPolygon {
                points,
                axis,
                range,
            },
            Dimension::Three,
        ) => polygon::fill_extruded(&lattice()?, points, *axis, *range),
        (Shape::Stratum(stratum), _) if stratum.axes() == dimension.axes() => {
            columns::fill_stratum(&lattice()?, stratum, &mesh.origin)
        }
        (Shape::Enclosed(body), Dimension::Three) => {
            columns::fill_enclosed(&lattice()?, body, &mesh.origin)
        }
        (Shape::Stratum(_), _) => refuse("stratum"),
        (Shape::Enclosed(_), Dimension::Two) => refuse("enclosed body"),
        (Shape::Ring { .. }, Dimension::Three) => refuse("ring"),
        (Shape::Cylinder { .. }, Dimension::Two) => refuse("cylinder"),
        (Shape::Polygon { .. }, Dimension::Three) => refuse("polygon"),
        (Shape::ExtrudedPolygon { .. }, Dimension::Two) => refuse("extruded polygon"),
        (Shape::Particles(seeds), _) => list::fill(seeds, mesh, dimension),
    }
}
