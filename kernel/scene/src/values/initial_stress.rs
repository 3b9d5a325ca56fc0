//! Stress that a body has at the start.

use super::Overburden;
use proctor_kernel::model::Vector;

/// Stress of a body at the start; tension is positive.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum InitialStress {
    /// None.
    #[default]
    None,
    /// The same stress in all directions \[Pa\].
    Isotropic(f64),
    /// Ground at rest: the weight above a point along gravity, and a share of it across.
    AtRest {
        /// Coefficient of earth pressure at rest, K_0.
        ratio: f64,
        /// Coordinate of the surface along the axis of gravity \[m\].
        level: f64,
        /// Pressure on the surface \[Pa\].
        surcharge: f64,
    },
    /// Ground at rest below a surface that need not be level, in layers.
    Overburden(Overburden),
}

impl InitialStress {
    /// The stress xx, yy, zz, yz, xz, xy at a point \[Pa\], for gravity \[m/s²\] along one axis of so many and a density
    /// \[kg/m³\]; above the surface there is none. Soil with water in its pores gets what its set-up makes of that.
    #[must_use]
    pub fn at(&self, x: &Vector, gravity: &Vector, density: f64, axes: usize) -> [f64; 6] {
        match self {
            Self::None => [0.0; 6],
            &Self::Isotropic(stress) => [stress, stress, stress, 0.0, 0.0, 0.0],
            &Self::AtRest {
                ratio,
                level,
                surcharge,
            } => {
                let axis = axis_of(gravity).unwrap_or(0);
                let fall = (x[axis] - level) * gravity[axis].signum();
                let along = if fall < 0.0 {
                    0.0
                } else {
                    -surcharge - density * gravity[axis].abs() * fall
                };
                let mut stress = [ratio * along, ratio * along, ratio * along, 0.0, 0.0, 0.0];
                stress[axis] = along;
                stress
            }
            Self::Overburden(overburden) => overburden.at(x, gravity, axes),
        }
    }
}

/// The axis along which gravity acts, if it is one alone.
pub(super) fn axis_of(gravity: &Vector) -> Option<usize> {
    let mut acting = (0..3).filter(|axis| gravity[*axis] != 0.0);
    match (acting.next(), acting.next()) {
        (Some(axis), None) => Some(axis),
        _ => None,
    }
}
