//! A boundary in motion, and the nodes that its vertices hang on.

use super::neighbours::NeighbourParticles;
use super::patch::{Patch, from_vector};
use super::tied_particles::TiedParticles;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::motion::FollowMode;
use proctor_kernel::model::{History, Vector};
use proctor_kernel::simulation::BodyRun;

/// The motion of the vertices of a surface.
#[derive(Clone, Debug)]
pub(super) enum BoundaryCarrier {
    /// The nodes of a body's layer.
    Body {
        /// Index of the body.
        index: usize,
        follow: FollowMode,
    },
    /// A prescribed velocity.
    Prescribed(Option<History>),
}

impl BoundaryCarrier {
    /// The motion of the boundary of a body: that of its nodes, or a prescribed one.
    pub(super) fn of(body: &BodyRun, index: usize, follow: FollowMode) -> Self {
        match &body.motion {
            Some(motion) => Self::Prescribed(Some(motion.clone())),
            None => Self::Body { index, follow },
        }
    }

    /// Way in which the vertices of a body follow it; nothing for a prescribed motion.
    pub(super) fn follow(&self) -> Option<FollowMode> {
        match self {
            Self::Body { follow, .. } => Some(*follow),
            Self::Prescribed(_) => None,
        }
    }

    /// Room for the particles around the boundary, where its vertices follow more than velocities.
    pub(super) fn around<const D: usize>(&self) -> Option<NeighbourParticles<D>> {
        match self {
            Self::Body {
                follow: FollowMode::Spin | FollowMode::Gradient,
                ..
            } => Some(NeighbourParticles::default()),
            _ => None,
        }
    }
}

/// A boundary in motion; positions relative to the origin of the mesh.
#[derive(Clone, Debug)]
pub(crate) struct MovingBoundary<B, const D: usize, const N: usize> {
    pub(crate) id: i64,
    pub(super) carrier: BoundaryCarrier,
    pub(crate) boundary: B,
    /// Positions of the vertices at the start.
    pub(super) start: Vec<PointIn<D>>,
    /// Displacement of the vertices in the last step \[m\].
    pub(crate) moved: Vec<PointIn<D>>,
    /// Velocity of the vertices at the beginning of this step \[m/s\].
    pub(super) velocity: Vec<PointIn<D>>,
    /// Change of it in the longest next step where nothing touches the vertices \[m/s\].
    pub(super) kick: Vec<PointIn<D>>,
    /// Contact force on the vertices in this step \[N\].
    pub(super) force: Vec<PointIn<D>>,
    /// Vertices on faces at which rows of particles end at the start; none for what moves as prescribed.
    pub(super) on_face: Vec<bool>,
    /// Elements of those vertices, each with the axis that it lies across.
    pub(super) faces: Vec<(usize, usize)>,
    /// Share of the weights of the face that each vertex has in this step.
    pub(super) flat: Vec<f64>,
    /// Contact presses on one of them in this step.
    pub(super) pressed: bool,
    /// Weights and masses of the patches, for surfaces of bodies.
    pub(super) patches: Vec<Patch<D, N>>,
    /// Forces on the vertices without what planes of symmetry bear, and their stiffnesses, while they are used.
    pub(super) held: Vec<PointIn<D>>,
    pub(super) stiffness: Vec<f64>,
    /// The particles around them, where vertices follow more than velocities.
    pub(super) around: Option<NeighbourParticles<D>>,
    /// The ties of the vertices of a body to its particles.
    pub(super) tied: Option<TiedParticles<D>>,
}

impl<B, const D: usize, const N: usize> MovingBoundary<B, D, N> {
    /// Index of the body that carries the surface.
    pub(super) fn body(&self) -> Option<usize> {
        match self.carrier {
            BoundaryCarrier::Body { index, .. } => Some(index),
            BoundaryCarrier::Prescribed(_) => None,
        }
    }

    /// True where a motion is prescribed that is not rest.
    pub(super) fn moves(&self) -> bool {
        match &self.carrier {
            BoundaryCarrier::Prescribed(Some(motion)) => !motion.is_zero(),
            BoundaryCarrier::Prescribed(None) | BoundaryCarrier::Body { .. } => false,
        }
    }

    /// Moves the vertices by what they move in this step, relative to a mesh that moves too \[m\].
    pub(super) fn advance<const T: usize>(&mut self, mesh_shift: &Vector)
    where
        B: Elements<D, T>,
    {
        let mesh: PointIn<D> = from_vector(mesh_shift);
        let moves = *mesh_shift != [0.0; 3];
        for (x, moved) in self.boundary.points_mut().iter_mut().zip(&self.moved) {
            *x += moved;
            if moves {
                *x -= mesh;
            }
        }
    }

    /// Largest speed of a vertex \[m/s\].
    pub(super) fn fastest(&self) -> f64 {
        largest(&self.velocity)
    }

    /// Largest displacement of a vertex in the last step \[m\].
    pub(super) fn farthest(&self) -> f64 {
        largest(&self.moved)
    }
}

fn largest<const D: usize>(vectors: &[PointIn<D>]) -> f64 {
    vectors
        .iter()
        .map(PointIn::norm_squared)
        .fold(0.0, f64::max)
        .sqrt()
}

/// True if vertices carried so stay on the material.
pub(super) fn stays(carrier: &BoundaryCarrier) -> bool {
    let BoundaryCarrier::Body { follow, .. } = carrier else {
        return false;
    };
    *follow == FollowMode::Material
}
