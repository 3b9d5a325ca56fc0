//! How vertices follow the body (eq. 28-30).

use super::Point;
use super::weights::VertexWeights;
use nalgebra::Matrix2;

/// What of the motion around a node is carried to a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follow {
    /// Velocities of the nodes through the weights of a particle, which are not augmented: for comparison. Empty nodes
    /// take their share of velocities and of contact forces, so vertices drift off and momentum is lost.
    Unaugmented,
    /// Velocities of the nodes alone. Vertices at corners lag behind a rotation.
    Velocity,
    /// Velocity and spin of the nodes, as printed (eq. 29).
    Spin,
    /// Velocity and full velocity gradient of the nodes: exact for every linear field, also next to empty nodes.
    Gradient,
}

impl Follow {
    /// The part of the velocity gradient of a node \[1/s\] that the vertices use.
    #[must_use]
    pub fn part(self, gradient: &Matrix2<f64>) -> Matrix2<f64> {
        match self {
            Self::Unaugmented | Self::Velocity => Matrix2::zeros(),
            Self::Spin => 0.5 * (gradient - gradient.transpose()),
            Self::Gradient => *gradient,
        }
    }
}

/// Velocity of a vertex \[m/s\], sum_I S_Iv (v_I + G_I (x_v - x_I)) with G_I the spin or gradient at the node.
///
/// `velocities` and `gradients` belong to the nodes of the patch. The velocities are those at the end of the step:
/// with those at its beginning, as eq. 29 prints, a rolling disk blows up. `cell` is the size of a cell per axis \[m\].
#[must_use]
pub fn vertex_velocity(
    weights: &VertexWeights,
    velocities: &[Point; 9],
    gradients: &[Matrix2<f64>; 9],
    follow: Follow,
    cell: &Point,
) -> Point {
    let mut v = Point::zeros();
    for k in 0..9 {
        let w = weights.weights[k];
        if w == 0.0 {
            continue;
        }
        let distance = weights.offsets[k].component_mul(cell);
        v += w * (velocities[k] + follow.part(&gradients[k]) * distance);
    }
    v
}

/// Velocity gradient of a node, sum_p S_Ip m_p L_p / m_I (eq. 28 for the whole gradient), added up particle by
/// particle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodalGradient {
    sum: Matrix2<f64>,
    mass: f64,
}

impl NodalGradient {
    /// Adds a particle: its weight at the node, mass \[kg\] and velocity gradient \[1/s\].
    pub fn add(&mut self, weight: f64, mass: f64, gradient: &Matrix2<f64>) {
        self.sum += gradient * (weight * mass);
        self.mass += weight * mass;
    }

    /// The mean \[1/s\]; zero where no particle was added.
    #[must_use]
    pub fn mean(&self) -> Matrix2<f64> {
        if self.mass > 0.0 {
            self.sum / self.mass
        } else {
            Matrix2::zeros()
        }
    }
}
