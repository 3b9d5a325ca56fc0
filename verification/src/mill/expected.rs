//! What theory expects of a problem: orders and errors, as gates.

use proctor_kernel::scene::Weighting;

use super::ladder::{Errors, order};
use super::problem::{Family, Problem};

/// A bound that a number must keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// Quantity.
    pub what: &'static str,
    /// Its value; not a number where there is none.
    pub value: f64,
    /// Bound.
    pub bound: f64,
    /// Whether the bound is the least that is accepted, of an order, or the most, of an error.
    pub at_least: bool,
}

impl Gate {
    /// Whether the number keeps its bound. What is not a number does not.
    #[must_use]
    pub fn holds(&self) -> bool {
        if self.at_least {
            self.value >= self.bound
        } else {
            self.value <= self.bound
        }
    }
}

/// Order of the displacement by theory: the functions are linear to second order, and leapfrog is of second order in time.
pub const ORDER_OF_DISPLACEMENT: f64 = 2.0;
/// Order of the stress by theory: that of a gradient.
pub const ORDER_OF_STRESS: f64 = 1.0;
/// Least median order of the displacement of many problems of a family.
pub const LEAST_MEDIAN: f64 = 1.8;

/// What is expected of a problem on its finest pair of meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Least order of the displacement; none where its error is round-off or time alone.
    pub displacement: Option<f64>,
    /// Least order of the stress.
    pub stress: Option<f64>,
    /// Least order of the first internal variable.
    pub variable: Option<f64>,
    /// Largest error of the displacement on the finest mesh.
    pub error: f64,
    /// Largest error of the stress there.
    pub error_of_stress: f64,
}

/// What is expected of a problem.
#[must_use]
pub fn of(problem: &Problem) -> Expected {
    let none = Expected {
        displacement: Some(1.5),
        stress: Some(0.8),
        variable: None,
        error: 0.1,
        error_of_stress: 0.2,
    };
    let _ = Weighting::Linear;
    match problem.family {
        Family::Box | Family::Floating => none,
        Family::Frame => Expected {
            variable: problem.material.kind.yields().then_some(0.8),
            ..none
        },
        Family::Affine => Expected {
            displacement: None,
            stress: None,
            ..none
        },
    }
}

/// Gates of a problem from the errors on its ladder, coarse to fine.
#[must_use]
pub fn gates(problem: &Problem, errors: &[Errors]) -> Vec<Gate> {
    let expected = of(problem);
    let [.., coarse, fine] = errors else {
        return vec![];
    };
    let cells = &problem.ladder[errors.len() - 2..];
    let of_order = |what, bound: Option<f64>, errors: [f64; 2]| {
        bound.map(|bound| Gate {
            what,
            value: order(errors, [cells[0], cells[1]]),
            bound,
            at_least: true,
        })
    };
    let of_error = |what, value, bound| {
        Some(Gate {
            what,
            value,
            bound,
            at_least: false,
        })
    };
    let variables = [coarse.variable, fine.variable].map(|error| error.unwrap_or(f64::NAN));
    [
        of_order("order of L2(u)", expected.displacement, [coarse.displacement, fine.displacement]),
        of_order("order of L2(stress)", expected.stress, [coarse.stress, fine.stress]),
        of_order("order of L2(plastic strain)", expected.variable, variables),
        of_error("L2(u)", fine.displacement, expected.error),
        of_error("L2(stress)", fine.stress, expected.error_of_stress),
    ]
    .into_iter()
    .flatten()
    .collect()
}
