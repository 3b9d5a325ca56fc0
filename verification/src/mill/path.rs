//! Laws with a memory along an exact motion.
//!
//! A law is integrated by its own update along F(X, t) as a jet over X, from f = F(t_2) F(t_1)^-1 in each step, so that stress
//! and derivatives of the stress come together. What a step of the law leaves is taken out by Richardson's extrapolation of
//! whole and half steps.

use proctor_laws::tensor::Configuration;
use proctor_laws::{Component, Increment, Law, Stress};

use super::material::{determinant_of, divergence, inverse_of, product_of};
use super::motion::{Matrix, Moment, Place, matrix};
use crate::exact::jet::{Jet, Scalar};

/// Places of the components of a stress in its matrix: xx, yy, zz, yz, xz, xy.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// The law, and what it begins with.
pub struct Start<'a, M> {
    /// Law.
    pub law: &'a M,
    /// Order of its update in the step, for the extrapolation.
    pub order: u32,
    /// Initial density \[kg/m³\].
    pub density: f64,
    /// Stress of the start xx, yy, zz, yz, xz, xy \[Pa\].
    pub stress: [f64; 6],
}

/// A particle on its way.
#[derive(Clone)]
struct State<const D: usize> {
    stress: Stress<Jet<D>, D>,
    variables: Vec<Jet<D>>,
}

/// The state of a place at the end of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathEnd {
    /// Cauchy stress xx, yy, zz, yz, xz, xy \[Pa\].
    pub stress: [f64; 6],
    /// Internal variables.
    pub variables: Vec<f64>,
    /// Smallest growth of the first variable in a step: positive where a body that yields never stops to.
    pub least_growth: f64,
    /// Smallest share of the radius of the stress in the plane by which the stress across it lies between the principal stresses
    /// of the plane: positive where a pyramid of yield is never left by an edge.
    pub least_margin: f64,
}

/// A step of the law from one deformation to another.
fn strain<M: Law, const D: usize>(
    start: &Start<'_, M>,
    state: &mut State<D>,
    [from, to]: [&Matrix<Jet<D>>; 2],
    dt: f64,
) {
    let relative = product_of::<_, D>(to, &inverse_of::<_, D>(from));
    let one = |i: usize, j: usize| Jet::<D>::of(f64::from(u8::from(i == j && i < D)));
    let jacobian = determinant_of::<_, D>(to);
    let increment = Increment {
        gradient: matrix(|i, j| relative[i][j] - one(i, j)),
        configuration: Configuration::Beginning,
        dt,
        deformation: *to,
        jacobian,
        mass: Jet::constant(start.density),
        volume: jacobian,
        density: start.density,
    };
    (start.law).update::<Jet<D>, D>(&increment, &mut state.stress, &mut state.variables);
}

/// Follows a place through moments half a step apart, of which the even ones are those of a run with steps of `dt` \[s\]:
/// calls `at` with each number of such a step and the force of the stress per initial volume, Div P \[N/m³\].
pub fn follow<M: Law, const D: usize>(
    start: &Start<'_, M>,
    place: &Place,
    moments: &[Moment],
    dt: f64,
    mut at: impl FnMut(usize, [f64; 3]),
) -> PathEnd {
    let zero = Jet::<D>::of(0.0);
    let mut stress = Stress::of_packed([zero; 6]);
    for component in Component::ALL {
        stress[component] = Jet::constant(start.stress[component.place()]);
    }
    let initial = M::VARIABLES.iter();
    let variables = initial
        .flat_map(|variable| vec![Jet::constant(variable.initial); variable.components])
        .collect();
    let (mut whole, mut half) = (State { stress, variables }, None);
    let mut fine = whole.clone();
    let share = 1.0 / f64::from(2_u32.pow(start.order) - 1);
    let better = |fine: Jet<D>, coarse: Jet<D>| fine + (fine - coarse) * Jet::of(share);
    let mut deformation = moments[0].deformation_jet::<D>(place);
    let (mut least_growth, mut least_margin) = (f64::INFINITY, f64::INFINITY);
    for (number, moment) in moments.iter().enumerate() {
        let now = moment.deformation_jet::<D>(place);
        if number > 0 {
            let first = variable(&fine);
            strain(start, &mut fine, [&deformation, &now], 0.5 * dt);
            least_growth = least_growth.min(variable(&fine) - first);
            least_margin = least_margin.min(margin(&fine));
        }
        if number % 2 == 0 {
            if let Some(before) = &half {
                strain(start, &mut whole, [before, &now], dt);
            }
            half = Some(now);
            let stress = Component::ALL.map(|c| better(fine.stress[c], whole.stress[c]));
            let jacobian = determinant_of::<_, D>(&now);
            let kirchhoff = full::<D>(&stress).map(|row| row.map(|s| s * jacobian));
            at(number / 2, divergence::<D>(&kirchhoff, &now));
        }
        deformation = now;
    }
    let stress = Component::ALL.map(|c| better(fine.stress[c], whole.stress[c]));
    let full = full::<D>(&stress);
    let both = fine.variables.iter().zip(&whole.variables);
    PathEnd {
        stress: PLACES.map(|(i, j)| full[i][j].value),
        variables: both.map(|(f, w)| better(*f, *w).value).collect(),
        least_growth,
        least_margin,
    }
}

/// The share of the radius of the stress in the plane that is left between the stress across it and the nearer principal
/// stress; not a number where there is no stress.
fn margin<const D: usize>(state: &State<D>) -> f64 {
    let stress = Component::ALL.map(|c| state.stress[c]);
    let full = full::<D>(&stress).map(|row| row.map(|s| s.value));
    let mean = 0.5 * (full[0][0] + full[1][1]);
    let radius = libm::hypot(0.5 * (full[0][0] - full[1][1]), full[0][1]);
    1.0 - (full[2][2] - mean).abs() / radius
}

/// The first internal variable; 0 where a law has none.
fn variable<const D: usize>(state: &State<D>) -> f64 {
    state.variables.first().map_or(0.0, |jet| jet.value)
}

/// A stress as a matrix.
fn full<const D: usize>(stress: &[Jet<D>; 6]) -> Matrix<Jet<D>> {
    let mut out = [[Jet::of(0.0); 3]; 3];
    for ((i, j), entry) in PLACES.into_iter().zip(stress) {
        out[i][j] = *entry;
        out[j][i] = *entry;
    }
    out
}
