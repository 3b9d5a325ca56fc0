//! Derivatives of a problem against differences, before it is run.

use super::material::{determinant_of, inverse_of};
use super::motion::{Matrix, Vector, matrix, product};
use super::problem::Problem;
use super::reference::Reference;

/// Largest difference of F from that of places, over 1.
const MOST_OF_DEFORMATION: f64 = 1e-6;
/// Largest difference of Div P from that of P, over the largest of Young's modulus times the second derivatives of the motion.
const MOST_OF_FORCE: f64 = 1e-4;
/// Step of differences \[m\].
const STEP: f64 = 1e-4;
/// Places that are looked at.
const COUNT: usize = 10;

/// Differences between derivatives by forward mode and central differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// Error of F.
    pub deformation: f64,
    /// Error of Div P, over Young's modulus per metre times the strain.
    pub force: f64,
}

impl Derivation {
    /// True where derivatives are what differences say.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.deformation <= MOST_OF_DEFORMATION && self.force <= MOST_OF_FORCE
    }
}

/// Compares the derivatives of a problem at some places, at its end.
#[must_use]
pub fn derivation(problem: &Problem) -> Derivation {
    let axes = problem.axes();
    let half = 0.9 * problem.family.half().min(0.5);
    // Places without a pattern: multiples of irrational parts of the edge.
    let place = |k: usize| -> Vector {
        std::array::from_fn(|axis| {
            let part = [0.618_034, 0.754_878, 0.819_173][axis] * (k as f64 + 0.5);
            let from_center = half * (2.0 * part.fract() - 1.0);
            problem.motion.center[axis] + if axis < axes { from_center } else { 0.0 }
        })
    };
    let mut found = Derivation {
        deformation: 0.0,
        force: 0.0,
    };
    let moment = problem.motion.at(problem.end);
    let (_, steps) = problem.steps(problem.ladder[0]);
    for x in (0..COUNT).map(place) {
        let beside = |axis: usize, sign: f64| {
            let mut beside = x;
            beside[axis] += sign * STEP;
            beside
        };
        let mut starts = vec![x];
        starts.extend((0..axes).flat_map(|axis| [beside(axis, 1.0), beside(axis, -1.0)]));
        let places = starts.iter().map(|x| problem.motion.of(x)).collect();
        let reference = Reference::at(problem, &starts, places, problem.end / steps as f64, steps);
        let deformation = moment.deformation(&problem.motion.of(&x));
        let mut force = [0.0; 3];
        for axis in 0..axes {
            let at = |sign: f64| problem.motion.place(&beside(axis, sign), problem.end);
            let (above, below) = (at(1.0), at(-1.0));
            for i in 0..axes {
                let difference = (above[i] - below[i]) / (2.0 * STEP);
                found.deformation = found
                    .deformation
                    .max((difference - deformation[i][axis]).abs());
            }
            let [above, below] = [1.0, -1.0].map(|sign| {
                let x = beside(axis, sign);
                let deformation = moment.deformation(&problem.motion.of(&x));
                reference
                    .end(&x)
                    .map(|exact| piola(&deformation, &exact.stress))
            });
            let (Some(above), Some(below)) = (above, below) else {
                force = [f64::NAN; 3];
                continue;
            };
            for i in 0..axes {
                force[i] += (above[i][axis] - below[i][axis]) / (2.0 * STEP);
            }
        }
        let exact = reference.stress_force(0, steps);
        let scale = problem.material.young * strain(problem);
        for i in 0..axes {
            let off = (exact[i] - force[i]).abs() / scale;
            // What is not a number is no number that holds.
            found.force = if off.is_nan() {
                off
            } else {
                found.force.max(off)
            };
        }
    }
    found
}

/// Largest part of the field over a metre, which strains are of the size of.
fn strain(problem: &Problem) -> f64 {
    let all = problem.motion.field.polynomials.iter().flatten();
    let most = all.fold(0.0_f64, |most, factor| most.max(factor.abs()));
    if most > 0.0 { most } else { 1.0 }
}

/// P = J sigma F^-T \[Pa\].
fn piola(deformation: &Matrix, stress: &[f64; 6]) -> Matrix {
    let [xx, yy, zz, yz, xz, xy] = *stress;
    let jacobian = determinant_of::<f64, 3>(deformation);
    let sigma = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let inverse = inverse_of::<f64, 3>(deformation);
    product(&sigma, &matrix(|i, j| jacobian * inverse[j][i]))
}
