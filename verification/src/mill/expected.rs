//! Expectations of theory for a problem: orders and errors, as gates.

use proctor_scene::{StressScheme, TransferKind, Weighting};

use super::ladder::{Errors, order};
use super::material::Kind;
use super::problem::{Family, Problem};
use crate::settings::Method;

/// A bound that a number must keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// Quantity.
    pub what: &'static str,
    /// Its value; not a number where there is none.
    pub value: f64,
    /// Bound.
    pub bound: f64,
    /// True where the bound is the least that is accepted, of an order, or the most, of an error.
    pub at_least: bool,
}

impl Gate {
    /// True where the number keeps its bound. What is not a number does not.
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

/// Expectations for a problem on its finest pair of meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectations {
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

/// Angle beyond which the order of the stress of a turned body is not judged \[rad\]: domains keep their axes, leave gaps that
/// grow with the angle, and what is left of that does not fall with the mesh.
const MOST_TURN: f64 = 0.5;

/// Expectations for a problem.
///
/// Floors of orders lie below theory by what meshes of 8 to 32 cells show before errors are asymptotic; bounds of errors are
/// some times those of the verification notes, A1 to A3, at 32 cells, and fall with h².
#[must_use]
pub fn of(problem: &Problem) -> Expectations {
    let finest = problem.ladder.last().copied().unwrap_or(1) as f64;
    let scale = (32.0 / finest).powi(2);
    let turn = (problem.motion.spin * problem.end).abs();
    let flips = problem.method.transfer == TransferKind::Flip;
    let plane = problem.axes() == 2;
    let [affine, floats] =
        [Family::Affine, Family::Floating].map(|family| problem.family == family);
    let kind = problem.material.kind;
    let displacement = if kind.has_edges() {
        // Perfectly plastic: errors of the stress are some 1e-3 on any mesh, which the bound of the error says.
        1.0
    } else if !plane || kind == Kind::DruckerPrager {
        // Two meshes of 8 and 16 cells in space; without hardening some waves have no speed, and no error is carried off.
        1.2
    } else if flips && problem.method.scheme != StressScheme::Usl && follows(problem.method) {
        // Under tension particles move on by velocities that no strain sees, by sigma/rho (dt/h)² in a step.
        1.3
    } else {
        1.5
    };
    let [error, error_of_stress] = if affine {
        [5e-4, 1e-2]
    } else if floats && flips {
        // Mass at nodes has more inertia, 2/3 (h/R)², so that FLIP turns a body too little; affine transfers carry the spin.
        [0.25, 0.3]
    } else if kind.has_edges() {
        [0.03, 5e-3]
    } else {
        [0.03, 0.1]
    };
    let stress = if kind.has_edges() { 0.4 } else { 0.85 };
    Expectations {
        displacement: (!affine).then_some(displacement),
        stress: (!affine && (!floats || turn < MOST_TURN)).then_some(stress),
        variable: (problem.material.kind.yields() && !affine).then_some(0.85),
        error: error * scale,
        error_of_stress: error_of_stress * scale.sqrt(),
    }
}

/// True where domains follow the deformation.
fn follows(method: Method) -> bool {
    matches!(method.weighting, Weighting::ContiguousGimp(_))
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
        of_order(
            "order of L2(u)",
            expected.displacement,
            [coarse.displacement, fine.displacement],
        ),
        of_order(
            "order of L2(stress)",
            expected.stress,
            [coarse.stress, fine.stress],
        ),
        of_order(
            match problem.material.kind {
                Kind::Bingham => "order of L2(viscous work)",
                _ => "order of L2(plastic strain)",
            },
            expected.variable,
            variables,
        ),
        of_error("L2(u)", fine.displacement, expected.error),
        of_error("L2(stress)", fine.stress, expected.error_of_stress),
    ]
    .into_iter()
    .flatten()
    .collect()
}
