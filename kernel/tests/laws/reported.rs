//! Faults that users of other codes reported of their laws, each a test here.
//!
//! Where another test asks the same question it is named instead of copied:
//!
//! - dilation without an end inflates a body (geomechanics/mpm 103): `pyramid::dilation_ends`;
//! - a pressure that is summed from increments drifts in cycles: `fluids::a_cycle_of_volume_brings_the_pressure_back`;
//! - nobody can tell whether a perfectly plastic law works (GeoTaichi 45): `von_mises::uniaxial_strain_has_two_slopes`,
//!   `pyramid::an_oedometer_yields_as_rankine_says`, `cone::an_oedometer_yields`;
//! - results depend on the size of cells (GeoTaichi 22): `bands::a_band_takes_the_same_energy_in_any_cell`;
//! - an initial stress beyond the surface is taken without a word (pylith 9): `physics`
//!   `initial_stress::a_stress_beyond_the_yield_surface_is_refused`;
//! - the rate of softening is read as a whole number, and a tensile strength of 0 means another one without saying so:
//!   `soils::materials_are_read_and_written_back` and the plan.

use crate::laws::returned::laws;
use crate::laws::support::{DENSITY, close, point, shear, strain, tensor};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_laws::{
    AnyLaw, ConeMatch, DruckerPrager, EquationOfState, LinearElastic, MohrCoulomb, Newtonian,
    Point, Tresca,
};

const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.3;
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const LAMBDA: f64 = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));

fn soil(friction: f64, cohesion: f64, dilation: f64) -> MohrCoulomb {
    MohrCoulomb::new(YOUNG, POISSON, [friction, cohesion, dilation])
}

/// The stress to which a trial stress returns.
fn returned(law: &AnyLaw, trial: [f64; 6]) -> [f64; 6] {
    let mut point = Point::new(law, DENSITY, trial);
    point.step(&[[0.0; 3]; 3], 1.0).expect("a finite stress");
    point.stress()
}

fn principal(s: [f64; 3]) -> [f64; 6] {
    [s[0], s[1], s[2], 0.0, 0.0, 0.0]
}

/// Kratos 14608: an apex at c/(N - 1) is a division by zero without friction, and a stress that is no number.
#[test]
fn no_friction_is_no_division_by_zero() {
    for friction in [0.0, 1e-300, 1e-12, 1e-5] {
        for tensile in [0.0, 0.5] {
            let laws: [AnyLaw; 2] = [
                soil(friction, 1.0, 0.0).with_tensile(tensile).into(),
                DruckerPrager::new(YOUNG, POISSON, [friction, 1.0, 0.0], ConeMatch::Outer)
                    .with_tensile(tensile)
                    .into(),
            ];
            for law in laws {
                for trial in [
                    [50.0; 3],
                    [50.0, 49.0, 40.0],
                    [0.0; 3],
                    [-50.0, -50.0, -80.0],
                ] {
                    let after = returned(&law, principal(trial));
                    assert!(after.iter().all(|s| s.is_finite()), "{law:?} {trial:?}");
                    let mean = (trial[0] + trial[1] + trial[2]) / 3.0;
                    if tensile > 0.0 && mean > 0.0 {
                        let left = (after[0] + after[1] + after[2]) / 3.0;
                        assert!(left <= tensile + 1e-14, "{law:?} {trial:?}: {left}");
                    } else {
                        close(after[0] + after[1] + after[2], 3.0 * mean, 1e-5, 150.0);
                    }
                }
            }
        }
    }
}

/// Kratos 14155: a tension that is cut off moves the other stresses too, by lambda/(lambda + 2 G).
#[test]
fn the_middle_stress_moves_where_tension_is_cut_off() {
    let law: AnyLaw = soil(30.0, 5.0, 10.0).with_tensile(0.5).into();
    let trial = [2.0, 0.4, -0.3];
    let after = returned(&law, principal(trial));
    let aside = LAMBDA / (LAMBDA + 2.0 * SHEAR) * (trial[0] - 0.5);
    for (found, exact) in after.iter().zip([0.5, trial[1] - aside, trial[2] - aside]) {
        close(*found, exact, 1e-15, 4.0);
    }
    // Two of them: lambda/(lambda + G) of what their mean loses.
    let trial = [2.0, 1.8, -0.3];
    let after = returned(&law, principal(trial));
    let aside = LAMBDA / (LAMBDA + SHEAR) * (1.9 - 0.5);
    for (found, exact) in after.iter().zip([0.5, 0.5, trial[2] - aside]) {
        close(*found, exact, 1e-15, 4.0);
    }
}

/// `CalculiX` 184: in pure shear without dilation round-off chose the region of the return, and each machine its answer. Here
/// neighbours of a trial stress, digits apart, return to neighbours, and all lanes to the same bits.
#[test]
fn round_off_decides_nothing() {
    let lanes = [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar];
    let lanes: Vec<SelectedLanes> = lanes
        .into_iter()
        .filter_map(|choice| SelectedLanes::new(choice).ok())
        .chain([SelectedLanes::plain()])
        .collect();
    let laws: [AnyLaw; 3] = [
        Tresca::new(YOUNG, POISSON, 1.0).into(),
        soil(30.0, 1.0, 0.0).into(),
        soil(30.0, 1.0, 0.0).with_tensile(0.3).into(),
    ];
    for law in laws {
        for size in [1.5, 2.0, 7.0, 1e3] {
            for trial in [
                [0.0, 0.0, 0.0, 0.0, 0.0, size],
                principal([size, 0.0, -size]),
                principal([size, size, -size]),
                principal([size, -size, -size]),
            ] {
                let centre = returned(&law, trial);
                for slot in 0..6 {
                    for digits in -3_i32..=3 {
                        let mut beside = trial;
                        beside[slot] += f64::from(digits) * f64::EPSILON * size;
                        let after = returned(&law, beside);
                        for (a, b) in after.iter().zip(centre) {
                            close(*a, b, 2e-14, size);
                        }
                        for lanes in &lanes {
                            let mut point = Point::new(&law, DENSITY, beside).on(*lanes);
                            point.step(&[[0.0; 3]; 3], 1.0).expect("a finite stress");
                            let same = point.stress().map(f64::to_bits);
                            assert_eq!(same, after.map(f64::to_bits), "{law:?} {beside:?}");
                        }
                    }
                }
            }
        }
    }
}

/// cb-geo 652: the sine of three times the angle of Lode comes out beyond 1 by a digit where two stresses are equal, and its
/// arc sine is no number. In any axes such a stress returns to where it does in its own.
#[test]
fn two_equal_stresses_in_any_axes_are_no_fault() {
    for law in laws(1.0) {
        for (i, state) in [
            [3.0, 3.0, -2.0],
            [4.0, -2.0, -2.0],
            [-1.0, -1.0, -9.0],
            [-1.0, -9.0, -9.0],
            [2.0, 2.0, 2.0],
        ]
        .into_iter()
        .enumerate()
        {
            let own = tensor(returned(&law, principal(state)));
            for turn in 0..200_u32 {
                let angle = f64::from(turn) * 0.7 + i as f64;
                let axis = Vector3::new(angle.sin(), (2.3 * angle).cos(), (1.7 * angle).sin());
                let r = Rotation3::new(axis * 2.0).into_inner();
                let t = r * Matrix3::from_diagonal(&Vector3::from(state)) * r.transpose();
                let s = [
                    t[(0, 0)],
                    t[(1, 1)],
                    t[(2, 2)],
                    t[(1, 2)],
                    t[(0, 2)],
                    t[(0, 1)],
                ];
                let after = tensor(returned(&law, s));
                let exact = r * own * r.transpose();
                let off = (after - exact).amax();
                assert!(off < 4e-14 * 9.0, "{law:?} {state:?}: {off:e}");
            }
        }
    }
}

/// geomechanics/mpm 116: beyond shear and tension at once a stress returns to where both end, not to one of them.
#[test]
fn shear_and_tension_at_once_have_their_corner() {
    let (friction, cohesion, tension) = (30.0_f64, 1.0, 0.5);
    let law: AnyLaw = soil(friction, cohesion, 5.0).with_tensile(tension).into();
    let after = returned(&law, principal([6.0, -0.5, -4.0]));
    let (s, c) = friction.to_radians().sin_cos();
    close(after[0], tension, 1e-14, 6.0);
    let smallest = ((1.0 + s) * tension - 2.0 * cohesion * c) / (1.0 - s);
    close(after[2], smallest, 1e-14, 6.0);
    assert!(after[2] <= after[1] && after[1] <= after[0], "{after:?}");
}

/// cb-geo 344, pylith 9, ogs 2790: a law that forgets the stress of the start. Elastic steps add to it, strength with friction
/// is that of it, and a fluid begins under its pressure.
#[test]
fn the_stress_of_the_start_counts() {
    let start = [-2.0, -1.0, -1.5, 0.1, -0.2, 0.05];
    let elastic: AnyLaw = LinearElastic::new(YOUNG, POISSON).into();
    let hard: AnyLaw = soil(30.0, 100.0, 0.0).into();
    for law in [elastic, hard] {
        let added = [[0.0; 6], start].map(|start| {
            let mut point = Point::new(&law, DENSITY, start);
            strain(&mut point, &shear(1e-3), 4);
            point.stress()
        });
        for i in 0..6 {
            close(added[1][i] - start[i], added[0][i], 1e-14, 2.0);
        }
    }
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let law: AnyLaw = soil(30.0, 0.2, 0.0).into();
    for pressure in [0.0, 1.0, 40.0] {
        let mut point = Point::new(&law, DENSITY, principal([-pressure; 3]));
        strain(&mut point, &shear(3.0), 30);
        let strength = 0.2 * c + pressure * s;
        close(point.stress()[5], strength, 1e-13, strength);
    }
    let water: AnyLaw = Newtonian::new(2e5, 1.0).into();
    let mut point = Point::new(&water, DENSITY, principal([-300.0; 3]));
    strain(&mut point, &Matrix3::zeros(), 1);
    close(point.stress()[0], -300.0, 1e-12, 300.0);
}

/// cb-geo 571: a pressure made with a viscosity has the wrong dimension. Neither viscosity nor the time that a volume change
/// takes, nor the way to it, is in the pressure.
#[test]
fn neither_rate_nor_viscosity_is_in_a_pressure() {
    let state = EquationOfState {
        bulk: 2e5,
        exponent: 7.0,
        carries_tension: true,
    };
    let pressure = |viscosity: f64, dt: f64, steps: u32| {
        let law: AnyLaw = Newtonian::new(2e5, viscosity).with_state(state).into();
        let mut point = point(&law);
        let each = -0.02 / f64::from(steps);
        for _ in 0..steps {
            let step = [each, 0.0, 0.0, 0.0, 0.0, 0.0];
            point.strain(&step, dt).expect("a finite stress");
        }
        let s = point.stress();
        let exact = 2e5 / 7.0 * (point.volume().powi(-7) - 1.0);
        close(-(s[0] + s[1] + s[2]) / 3.0, exact, 1e-11, exact);
        exact
    };
    let found = pressure(0.0, 1.0, 200);
    for (viscosity, dt, steps) in [(50.0, 1.0, 200), (50.0, 1e-3, 200), (3.0, 1.0, 400)] {
        close(pressure(viscosity, dt, steps), found, 1e-6, found);
    }
}

/// `ComFluSoM` 1: the answer of Drucker and Prager depended on the step. Halving it halves what is missing, on a path on which
/// stress turns along the surface.
#[test]
fn the_step_does_not_decide_the_answer() {
    for dilation in [0.0, 10.0] {
        let cone = [30.0, 0.1, dilation];
        let laws: [AnyLaw; 2] = [
            DruckerPrager::new(YOUNG, POISSON, cone, ConeMatch::PlaneStrain).into(),
            soil(30.0, 0.1, dilation).into(),
        ];
        for law in laws {
            let found = [100, 200, 400, 800].map(|steps| {
                let mut point = Point::new(&law, DENSITY, principal([-0.6, -1.4, -0.9]));
                strain(&mut point, &shear(0.02), steps);
                Vector3::new(point.stress()[0], point.stress()[1], point.stress()[5])
            });
            let apart: Vec<f64> = found.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
            assert!(apart[0] < 0.01, "{law:?}: {apart:?}");
            for pair in apart.windows(2) {
                let order = (pair[0] / pair[1]).log2();
                assert!(
                    (order - 1.0).abs() < 0.1,
                    "{law:?}: order {order} of {apart:?}"
                );
            }
        }
    }
}

/// The softening strain of another code counts plastic volume too: torn apart from all sides, nothing is sheared here, and
/// the strength in shear is what it was.
#[test]
fn plastic_volume_is_no_plastic_strain() {
    let law: AnyLaw = soil(30.0, 1.0, 0.0).with_tensile(0.2).into();
    let mut point = point(&law);
    strain(&mut point, &(Matrix3::identity() * 0.02), 20);
    let variables = point.variables();
    assert!(variables[0] < 1e-15 && variables[3] > 0.05, "{variables:?}");
}
