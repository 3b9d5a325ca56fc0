//! The background mesh and the conditions on its planes.

use crate::shape::{Dimension, Vector};

/// Regular background mesh of equal cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Lower corner \[m\].
    pub origin: Vector,
    /// Edges of a cell \[m\]; the third is 1 in two dimensions.
    pub cell: Vector,
    /// Number of cells per axis; the third is 1 in two dimensions.
    pub cells: [usize; 3],
    /// Condition of each boundary plane, `planes[axis][side]`, side 0 lower (`X0`), 1 upper (`Xn`).
    pub planes: [[PlaneCondition; 2]; 3],
    /// True where the two axes are radius and height: the scene is a body of revolution about the line x = 0.
    pub axisymmetric: bool,
}

/// Condition on a boundary plane of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneCondition {
    /// No condition.
    Free,
    /// Normal velocity zero, tangential free. A plane that is not named is sliding.
    Sliding,
    /// Velocity zero.
    Fixed,
    /// Tangential velocity zero, normal free: what lies beyond moves as what lies inside, turned by half a turn, as in a
    /// long layer that shears.
    Antisymmetric,
    /// Dashpots of the impedance of the ground: waves leave through it.
    Absorbing,
}

impl PlaneCondition {
    /// True if it prescribes the velocity along an axis of a plane with that normal.
    #[must_use]
    pub fn prescribes(self, along: usize, normal: usize) -> bool {
        match self {
            Self::Free | Self::Absorbing => false,
            Self::Sliding => along == normal,
            Self::Fixed => true,
            Self::Antisymmetric => along != normal,
        }
    }

    /// The axes along which it prescribes the velocity of a plane with that normal.
    #[must_use]
    pub fn prescribed(self, normal: usize) -> [bool; 3] {
        std::array::from_fn(|along| self.prescribes(along, normal))
    }

    /// True if it takes over forces that stand at the start.
    #[must_use]
    pub const fn bears_at_start(self) -> bool {
        matches!(self, Self::Antisymmetric | Self::Absorbing)
    }

    /// Its word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Sliding => "sliding",
            Self::Fixed => "fixed",
            Self::Antisymmetric => "antisymmetric",
            Self::Absorbing => "absorbing",
        }
    }
}

impl Mesh {
    /// A mesh whose planes are all sliding, the default of the manuals.
    ///
    /// In two dimensions the third components of the arguments are replaced by one cell of 1 m from 0, and the
    /// planes of the third axis are free: it does not exist for the cycle.
    #[must_use]
    pub fn new(
        dimension: Dimension,
        mut origin: Vector,
        mut cell: Vector,
        mut cells: [usize; 3],
    ) -> Self {
        let mut planes = [[PlaneCondition::Sliding; 2]; 3];
        if dimension == Dimension::Two {
            origin[2] = 0.0;
            cell[2] = 1.0;
            cells[2] = 1;
            planes[2] = [PlaneCondition::Free; 2];
        }
        Self {
            origin,
            cell,
            cells,
            planes,
            axisymmetric: false,
        }
    }

    /// Upper corner \[m\].
    #[must_use]
    pub fn upper(&self) -> Vector {
        std::array::from_fn(|axis| {
            self.cell[axis].mul_add(self.cells[axis] as f64, self.origin[axis])
        })
    }

    /// Distance along `axis` \[m\] below which two coordinates count as equal: 1e-9 of a cell, and the round-off
    /// of coordinates far from zero.
    #[must_use]
    pub fn tolerance(&self, axis: usize) -> f64 {
        let far = self.origin[axis].abs().max(self.upper()[axis].abs());
        1e-9 * self.cell[axis] + 8.0 * f64::EPSILON * far
    }
}
