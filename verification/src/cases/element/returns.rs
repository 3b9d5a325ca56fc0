//! Properties of any stress that a law returns, whatever it was before.

use super::{DENSITY, POISSON, RETURNS, YOUNG};
use proctor_laws::Point;

use crate::cases::prelude::*;
use crate::random::Random;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};

const STRENGTH: f64 = 1.0; // Strength of the laws [Pa]: yield stress, cohesion
const SPREAD: f64 = 6.0; // States are so many times the strength at most
/// Friction \[°\], cohesion \[Pa\] and dilation \[°\].
const SOIL: [f64; 3] = [30.0, STRENGTH, 10.0];
/// Tensile strength \[Pa\].
const TENSILE: f64 = 0.4;
const SEED: u64 = 2026;

/// Names of the quantities, each the worst of all laws and states.
pub(super) const YIELD: &str = "distance beyond the yield surface over the initial state";
pub(super) const AGAIN: &str = "change by a second return over the initial state";
pub(super) const TURNED: &str = "difference when axes are turned over the initial state";
pub(super) const WORK: &str = "negative plastic work over that of the initial state";
pub(super) const LANES: &str = "states with other bits on other lanes";
pub(super) const CORNERS: &str =
    "distance beyond the yield surface at corners over the initial state";

/// A law that does not harden, and by how much a stress is beyond its surface \[Pa\], of the strength and the principal stresses,
/// the largest first.
struct Solid {
    law: fn() -> AnyLaw,
    beyond: fn(f64, [f64; 3]) -> f64,
}

/// sqrt(3 `J_2`) and the mean stress.
fn invariants([a, b, c]: [f64; 3]) -> (f64, f64) {
    let squares = (a - b).powi(2) + (b - c).powi(2) + (c - a).powi(2);
    ((0.5 * squares).sqrt(), (a + b + c) / 3.0)
}

/// Mohr and Coulomb's plane, and tension.
fn pyramid(friction: f64, cohesion: f64, tensile: f64, [first, _, third]: [f64; 3]) -> f64 {
    let (sine, cosine) = libm::sincos(friction.to_radians());
    let shear = (1.0 + sine) * first - (1.0 - sine) * third - 2.0 * cohesion * cosine;
    shear.max(first - tensile)
}

/// The cone through the outer (`side` -1) or the inner (+1) edges of that pyramid.
fn cone(side: f64, friction: f64, cohesion: f64, principal: [f64; 3]) -> f64 {
    let (sine, cosine) = libm::sincos(friction.to_radians());
    let (q, mean) = invariants(principal);
    let part = 6.0 / (3.0_f64.sqrt() * (3.0 + side * sine));
    q / 3.0_f64.sqrt() + part * sine * mean - part * cohesion * cosine
}

const SOLIDS: [Solid; 8] = [
    Solid {
        law: || VonMises::new(YOUNG, POISSON, STRENGTH, 0.0).into(),
        beyond: |strength, s| invariants(s).0 - strength,
    },
    Solid {
        law: || Tresca::new(YOUNG, POISSON, STRENGTH).into(),
        beyond: |strength, s| pyramid(0.0, strength, f64::INFINITY, s),
    },
    Solid {
        law: || (Tresca::new(YOUNG, POISSON, STRENGTH).with_tensile(TENSILE)).into(),
        beyond: |strength, s| pyramid(0.0, strength, TENSILE * strength, s),
    },
    Solid {
        law: || MohrCoulomb::new(YOUNG, POISSON, SOIL).into(),
        beyond: |strength, s| pyramid(SOIL[0], strength, f64::INFINITY, s),
    },
    Solid {
        law: || (MohrCoulomb::new(YOUNG, POISSON, SOIL).with_tensile(TENSILE)).into(),
        beyond: |strength, s| pyramid(SOIL[0], strength, TENSILE * strength, s),
    },
    Solid {
        law: || MohrCoulomb::new(YOUNG, POISSON, [SOIL[0], 0.0, 0.0]).into(),
        beyond: |strength, s| pyramid(strength * SOIL[0], 0.0, 0.0, s),
    },
    Solid {
        law: || DruckerPrager::new(YOUNG, POISSON, SOIL, ConeMatch::Outer).into(),
        beyond: |strength, s| cone(-1.0, SOIL[0], strength, s),
    },
    Solid {
        law: || DruckerPrager::new(YOUNG, POISSON, UNDILATED, ConeMatch::Inner).into(),
        beyond: |strength, s| cone(1.0, SOIL[0], strength, s),
    },
];

/// The soil without dilation.
const UNDILATED: [f64; 3] = [SOIL[0], STRENGTH, 0.0];

/// Principal stresses over the strength on edges and at apexes, of two or three that are equal, and of none.
const AT_CORNERS: [[f64; 3]; 11] = [
    [1.0, 1.0, -2.0],
    [2.0, -1.0, -1.0],
    [1.0, 1.0, 1.0],
    [5.0, 5.0, 5.0],
    [5.0, 5.0, 4.999_999_999_999],
    [-1.0, -1.0, -1.0],
    [0.0, 0.0, 0.0],
    [1.0, 0.0, -1.0],
    [0.4, 0.4, -3.0],
    [0.4, -3.0, -3.0],
    [1.732_050_807_568_877_2; 3],
];

fn tensor([xx, yy, zz, yz, xz, xy]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn six(s: &Matrix3<f64>) -> [f64; 6] {
    [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)].map(|place| s[place])
}

/// The point after a step without strain from a stress.
fn returned(law: &AnyLaw, lanes: Option<SelectedLanes>, stress: [f64; 6]) -> Result<Point, String> {
    let mut point = Point::new(law, DENSITY, stress);
    if let Some(lanes) = lanes {
        point = point.on(lanes);
    }
    let still = [[0.0; 3]; 3];
    point.step(&still, 1.0).map_err(|fault| fault.to_string())?;
    Ok(point)
}

/// Sweeps after which nothing is left beside the diagonal: they converge with the square.
const SWEEPS: usize = 8;

/// Principal stresses, the largest first, by the rotations of Jacobi: roots alone, so that the bits are those of every platform.
fn principal(stress: [f64; 6]) -> [f64; 3] {
    let mut s = tensor(stress);
    for _ in 0..SWEEPS {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if s[(i, j)] == 0.0 {
                continue;
            }
            let half = 0.5 * (s[(j, j)] - s[(i, i)]) / s[(i, j)];
            let tangent = 1.0_f64.copysign(half) / (half.abs() + (half * half + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            let mut turn = Matrix3::identity();
            turn[(i, i)] = cosine;
            turn[(j, j)] = cosine;
            turn[(i, j)] = sine;
            turn[(j, i)] = -sine;
            s = turn.transpose() * s * turn;
        }
    }
    let mut values = [s[(0, 0)], s[(1, 1)], s[(2, 2)]];
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Returns so many random states by each law, and those at corners.
pub(super) fn quantities(
    states: u32,
    strength: f64,
    progress: &mut dyn FnMut(f64),
) -> Result<Vec<Quantity>, String> {
    let lanes: Vec<SelectedLanes> = [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar]
        .into_iter()
        .filter_map(|choice| SelectedLanes::new(choice).ok())
        .collect();
    let mut random = Random::new(SEED);
    let mut number = move || 2.0 * random.unit() - 1.0;
    let (mut beyond, mut again, mut turned) = (0.0, 0.0, 0.0);
    let (mut work, mut other, mut corners) = (0.0, 0.0, 0.0);
    for (index, solid) in SOLIDS.iter().enumerate() {
        progress(index as f64 / SOLIDS.len() as f64);
        let law = (solid.law)();
        let off = |stress: [f64; 6]| (solid.beyond)(strength, principal(stress)).max(0.0);
        for _ in 0..states {
            let before: [f64; 6] = std::array::from_fn(|_| SPREAD * STRENGTH * number());
            let size = before.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
            let point = returned(&law, None, before)?;
            let after = point.stress();
            beyond = larger(beyond, off(after) / size);
            // Per volume, over the energy of the stress before.
            work = larger(work, -point.dissipated() * YOUNG / (size * size));
            let once_more = returned(&law, None, after)?.stress();
            let moved = (tensor(once_more) - tensor(after)).amax();
            again = larger(again, moved / size);
            let [w, x, y, z] = [(); 4].map(|()| number());
            let axes = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            let axes = axes.to_rotation_matrix().into_inner();
            let there = returned(&law, None, six(&(axes * tensor(before) * axes.transpose())))?;
            let apart = tensor(there.stress()) - axes * tensor(after) * axes.transpose();
            turned = larger(turned, apart.amax() / size);
            let bits = after.map(f64::to_bits);
            for lanes in &lanes {
                let same = returned(&law, Some(*lanes), before)?;
                if same.stress().map(f64::to_bits) != bits {
                    other += 1.0;
                }
            }
        }
        for corner in AT_CORNERS {
            let [a, b, c] = corner.map(|s| s * STRENGTH);
            let after = returned(&law, None, [a, b, c, 0.0, 0.0, 0.0])?.stress();
            let size = a.abs().max(c.abs()).max(STRENGTH);
            corners = larger(corners, off(after) / size);
        }
    }
    Ok(vec![
        Quantity::of_zero(YIELD, beyond),
        Quantity::of_zero(AGAIN, again),
        Quantity::of_zero(TURNED, turned),
        Quantity::of_zero(WORK, work.max(0.0)),
        Quantity::of_zero(LANES, other),
        Quantity::of_zero(CORNERS, corners),
    ])
}

/// Reason for the bounds of differences.
pub(super) const ROUND_OFF: &str = "round-off of the state before";

/// Gate on one of them.
pub(super) const fn gate(quantity: &'static str, bound: f64, reason: &'static str) -> GateRule {
    let gate = error(quantity).at_most(bound, reason);
    gate.of_each().of(RETURNS)
}
