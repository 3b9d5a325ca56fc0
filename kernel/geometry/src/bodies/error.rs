//! Error of a body that could not be filled.

use crate::memory::OutOfMemory;
use crate::mesh::Mesh;
use crate::number::{Number, list};
use crate::shape::{Dimension, Vector};
use std::fmt;

/// Error of a body that could not be filled. Positions and ranges are in the coordinates of the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum FillError {
    /// No sub-cell centre lies inside the body.
    Empty {
        /// Edges of the bounding box of the body \[m\].
        size: Vector,
        /// Distance of particles per axis, h / ppc \[m\].
        spacing: Vector,
        /// Number of axes that count, 2 or 3.
        axes: usize,
    },
    /// The particle list is empty.
    EmptyList,
    /// A particle lies outside the mesh; the boundary planes belong to the mesh.
    ParticleOutside {
        /// The first such particle, in the order of the body.
        index: usize,
        /// Its position \[m\].
        position: Vector,
        /// Lower and upper coordinate of the mesh per axis \[m\].
        mesh: [[f64; 2]; 3],
        /// Number of axes that count, 2 or 3.
        axes: usize,
    },
    /// The body reaches beyond the mesh by more than one particle spacing.
    BodyOutside {
        /// Axis, 0 to 2.
        axis: usize,
        /// Lower and upper coordinate of the body along it \[m\].
        body: [f64; 2],
        /// Lower and upper coordinate of the mesh along it \[m\].
        mesh: [f64; 2],
    },
    /// A number is infinite or not a number.
    NotFinite {
        /// The quantity.
        quantity: &'static str,
        /// Particle of a particle list that it belongs to, if any.
        index: Option<usize>,
        /// The number.
        value: f64,
    },
    /// A number that must be positive is not.
    NotPositive {
        /// The quantity.
        quantity: &'static str,
        /// Particle of a particle list that it belongs to, if any.
        index: Option<usize>,
        /// The number.
        value: f64,
    },
    /// The shape does not exist in this number of dimensions.
    Dimension {
        /// Name of the shape.
        shape: &'static str,
        /// Dimension of the scene.
        dimension: Dimension,
    },
    /// The axis of an extruded polygon is not 0, 1 or 2.
    Axis(usize),
    /// The particles do not fit into memory.
    TooMany {
        /// Number of particles; infinite where it does not fit into an integer.
        particles: f64,
    },
    /// The particles need more memory than there is.
    Memory(OutOfMemory),
}

impl FillError {
    /// `Ok` if `value` is finite.
    pub(super) fn require_finite(
        quantity: &'static str,
        index: Option<usize>,
        value: f64,
    ) -> Result<(), Self> {
        if value.is_finite() {
            return Ok(());
        }
        Err(Self::NotFinite {
            quantity,
            index,
            value,
        })
    }

    /// `Ok` if `value` is finite and positive.
    pub(super) fn require_positive(
        quantity: &'static str,
        index: Option<usize>,
        value: f64,
    ) -> Result<(), Self> {
        Self::require_finite(quantity, index, value)?;
        if value > 0.0 {
            return Ok(());
        }
        Err(Self::NotPositive {
            quantity,
            index,
            value,
        })
    }
}

/// Lower and upper coordinate of the mesh per axis \[m\].
pub(super) fn mesh_range(mesh: &Mesh) -> [[f64; 2]; 3] {
    std::array::from_fn(|axis| {
        let lower = mesh.origin[axis];
        [lower, lower + mesh.cells[axis] as f64 * mesh.cell[axis]]
    })
}

impl fmt::Display for FillError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of_particle = |index: &Option<usize>| match index {
            Some(index) => format!(" of particle {index}"),
            None => String::new(),
        };
        match self {
            Self::Empty {
                size,
                spacing,
                axes,
            } => write!(
                f,
                "the body gets no particle: its size is {} m, the particle spacing {} m; \
                 use more particles per cell or a finer mesh",
                list(&size[..*axes]),
                list(&spacing[..*axes])
            ),
            Self::EmptyList => write!(f, "the particle list is empty"),
            Self::ParticleOutside {
                index,
                position,
                mesh,
                axes,
            } => {
                let side = |side: usize| list(&[0, 1, 2].map(|axis| mesh[axis][side])[..*axes]);
                write!(
                    f,
                    "particle {index} at {} m lies outside the mesh, which reaches from {} to {} m",
                    list(&position[..*axes]),
                    side(0),
                    side(1)
                )
            }
            Self::BodyOutside { axis, body, mesh } => write!(
                f,
                "the body reaches from {} to {} m along axis {}, the mesh from {} to {} m",
                Number(body[0]),
                Number(body[1]),
                ["x", "y", "z"].get(*axis).unwrap_or(&"?"),
                Number(mesh[0]),
                Number(mesh[1])
            ),
            Self::NotFinite {
                quantity,
                index,
                value,
            } => {
                write!(
                    f,
                    "the {quantity}{} is not finite: {}",
                    of_particle(index),
                    Number(*value)
                )
            }
            Self::NotPositive {
                quantity,
                index,
                value,
            } => {
                write!(
                    f,
                    "the {quantity}{} is not positive: {}",
                    of_particle(index),
                    Number(*value)
                )
            }
            Self::Dimension { shape, dimension } => {
                write!(f, "there is no {shape} in {} dimensions", dimension.axes())
            }
            Self::Axis(axis) => write!(f, "the axis of extrusion is {axis}, not 0, 1 or 2"),
            Self::TooMany { particles } => {
                write!(f, "{particles:e} particles do not fit into memory")
            }
            Self::Memory(error) => {
                write!(f, "{error}: fewer particles per cell, or larger cells")
            }
        }
    }
}

impl std::error::Error for FillError {}
