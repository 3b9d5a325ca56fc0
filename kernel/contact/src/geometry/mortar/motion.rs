//! Motion of vertices with their body: by velocities of the nodes (eq. 28-30), or on its particles.

use super::PointIn;
use super::weights::VertexWeights;
use nalgebra::SMatrix;

/// Part of the motion around a node that is carried to a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FollowMode {
    /// Velocities of the nodes through the weights of a particle, which are not augmented: for comparison. Empty nodes
    /// take their share of velocities and of contact forces, so vertices drift off and momentum is lost.
    Unaugmented,
    /// Velocities of the nodes alone. Vertices at corners lag behind a rotation.
    Velocity,
    /// Velocity and spin of the nodes, as printed (eq. 29).
    Spin,
    /// Velocity and full velocity gradient of the nodes: exact for every linear field, also next to empty nodes.
    Gradient,
    /// The particles that were around the vertex at the start, from whose displacements its own follows
    /// ([`affine_weights`](super::tie::affine_weights)): nothing is integrated, so that no vertex drifts off its body.
    Material,
}

impl FollowMode {
    /// The part of the velocity gradient of a node \[1/s\] that the vertices use.
    #[must_use]
    pub fn part<const D: usize>(self, gradient: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
        match self {
            Self::Unaugmented | Self::Velocity | Self::Material => SMatrix::zeros(),
            Self::Spin => 0.5 * (gradient - gradient.transpose()),
            Self::Gradient => *gradient,
        }
    }
}

/// Velocity of a vertex \[m/s\], sum_I S_Iv (v_I + G_I (x_v - x_I)) with G_I the spin or gradient at the node.
///
/// `velocity` and `gradient` are those of a node of the patch, asked for where it has a weight. The velocities are those at the
/// end of the step: with those at its beginning, as eq. 29 prints, a rolling disk blows up. `cell` is the size of a cell per
/// axis \[m\].
#[must_use]
pub fn vertex_velocity<const D: usize, const N: usize>(
    weights: &VertexWeights<D, N>,
    velocity: impl Fn(usize) -> PointIn<D>,
    gradient: impl Fn(usize) -> SMatrix<f64, D, D>,
    follow: FollowMode,
    cell: &PointIn<D>,
) -> PointIn<D> {
    let mut v = PointIn::zeros();
    for k in 0..N {
        let w = weights.weights[k];
        if w == 0.0 {
            continue;
        }
        let distance = weights.offset(k).component_mul(cell);
        v += w * (velocity(k) + follow.part(&gradient(k)) * distance);
    }
    v
}

/// Velocity gradient of a node, sum_p S_Ip m_p L_p / m_I (eq. 28 for the whole gradient), added up particle by
/// particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodalGradient<const D: usize> {
    sum: SMatrix<f64, D, D>,
    mass: f64,
}

impl<const D: usize> Default for NodalGradient<D> {
    fn default() -> Self {
        Self {
            sum: SMatrix::zeros(),
            mass: 0.0,
        }
    }
}

impl<const D: usize> NodalGradient<D> {
    /// Adds a particle: its weight at the node, mass \[kg\] and velocity gradient \[1/s\].
    pub fn add(&mut self, weight: f64, mass: f64, gradient: &SMatrix<f64, D, D>) {
        self.sum += gradient * (weight * mass);
        self.mass += weight * mass;
    }

    /// The mean \[1/s\]; zero where no particle was added.
    #[must_use]
    pub fn mean(&self) -> SMatrix<f64, D, D> {
        if self.mass > 0.0 {
            self.sum / self.mass
        } else {
            SMatrix::zeros()
        }
    }
}
