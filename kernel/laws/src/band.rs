//! The band in which softening strain gathers, and what its width does (crack band, Bažant and Oh 1983).
//!
//! Strain that softens gathers in a band as wide as a cell, so that the energy of a band is proportional to the cell. Where
//! a scene says how wide the band was in which strength was seen to fall, plastic strain counts as much more as a cell is
//! wider than it, and the energy of a band does not depend on the cell.

use super::{Choice, Constant, ConstantDefault, ConstantRange, InvalidConstant};

/// True if softening scales with the size of the cell.
pub(super) const REGULARISATION: Choice = Choice {
    key: "regularisation",
    words: &["none", "crack_band"],
    meaning: "Whether softening scales with the cell, so that a band takes the same energy in cells of any size.",
    elsewhere: "regularisation for a {law} material, which does not soften",
};

/// Width of the band in which strength was seen to fall.
pub(super) const WIDTH: Constant = Constant {
    key: "regularisation.width",
    meaning: "Width of the band in which strength was seen to fall as the law says; 0 where nothing is scaled",
    unit: "m",
    accepted: ConstantRange::NotNegative,
    given: ConstantDefault::Or(0.0),
};

/// A law that softens without a length of its own.
const NOT_CONVERGED: &str = "strength falls with strain: strain gathers in bands as wide as a cell, and the energy that a \
     band takes is proportional to the cell size, so that results do not converge as cells become smaller; \
     \"regularisation\": \"crack_band\" scales softening with the cell";

/// The band of a law that may soften.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// True if softening scales with the size of the cell.
    pub scales: bool,
    /// Width of the band in which strength was seen to fall \[m\].
    pub width: f64,
    /// Size of the cells that the law is in \[m\]; 0 in none yet.
    pub cell: f64,
}

impl Band {
    /// Band of a law whose softening does not know a length.
    pub const NONE: Self = Self {
        scales: false,
        width: 0.0,
        cell: 0.0,
    };

    /// Band of a law whose strength was seen to fall in a band of that width \[m\].
    #[must_use]
    pub const fn of_width(width: f64) -> Self {
        Self {
            scales: true,
            width,
            cell: 0.0,
        }
    }

    /// Band from the number of a word of [`REGULARISATION`] and a value of [`WIDTH`].
    pub(super) const fn read(choice: usize, width: f64) -> Self {
        Self {
            scales: choice == 1,
            width,
            cell: 0.0,
        }
    }

    /// The same in cells of a size \[m\], where that matters.
    pub(super) fn in_cells(self, cell: f64) -> Option<Self> {
        (self.scales && self.width > 0.0).then_some(Self { cell, ..self })
    }

    /// Factor on the plastic strain that softening counts.
    pub(super) fn factor(self) -> f64 {
        if self.scales && self.width > 0.0 && self.cell > 0.0 {
            self.cell / self.width
        } else {
            1.0
        }
    }

    /// True if a law that softens by such a slope has the size of the cells of its scene.
    fn is_placed(self) -> bool {
        !self.scales || self.cell > 0.0
    }

    /// Faults of the band itself.
    pub(super) fn problems(self) -> Option<InvalidConstant> {
        if self.scales && self.width == 0.0 {
            Some(InvalidConstant {
                key: WIDTH.key,
                found: "0 with a crack band".to_owned(),
                accepted: "a width greater than 0 [m]".to_owned(),
            })
        } else if !self.scales && self.width > 0.0 {
            Some(InvalidConstant {
                key: WIDTH.key,
                found: format!("{} without a crack band", self.width),
                accepted: "0, or \"regularisation\": \"crack_band\"".to_owned(),
            })
        } else {
            None
        }
    }

    /// Softening of a strength, by `slope` per plastic strain \[Pa\], where a point bears less than `most`: beyond, its
    /// stress would have to fall faster than its elasticity lets it (snap-back).
    pub(super) fn too_steep(
        self,
        key: &'static str,
        slope: f64,
        most: f64,
    ) -> Option<InvalidConstant> {
        // A strength that falls over no strain is refused for its marks.
        if !self.is_placed() || !slope.is_finite() || slope * self.factor() < most {
            return None;
        }
        Some(if self.factor() == 1.0 {
            InvalidConstant {
                key,
                found: format!(
                    "strength that falls by {slope} Pa per plastic strain, which no point can bear"
                ),
                accepted: format!("less than {most} Pa per plastic strain"),
            }
        } else {
            InvalidConstant {
                key: WIDTH.key,
                found: format!(
                    "strength that falls by {} Pa per plastic strain in cells of {} m, which no point can bear",
                    slope * self.factor(),
                    self.cell
                ),
                accepted: format!(
                    "cells of less than {} m, in which it falls by less than {most} Pa",
                    self.width * most / slope
                ),
            }
        })
    }

    /// Warning of a law that softens without a length of its own.
    pub(super) fn warning(self) -> Option<String> {
        (!self.scales).then(|| NOT_CONVERGED.to_owned())
    }
}
