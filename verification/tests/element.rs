//! Paths of the laboratory against closed forms.

use proctor_laws::{
    AnyLaw, Bingham, ConeMatch, DruckerPrager, EquationOfState, LinearElastic, MohrCoulomb,
    Newtonian, Residual, Softening, Tresca, VonMises,
};
use proctor_verification::element::path::{Path, Row, follow};
use proctor_verification::element::{Control, State, Test, exact_deviator, exact_pressure, run};

const YOUNG: f64 = 1e7;
const POISSON: f64 = 0.3;
const PRESSURE: f64 = 1e5;

fn end(law: &AnyLaw, test: Test, strain: f64) -> State {
    let (states, ended) = run(law, 2000.0, PRESSURE, &test.controls(strain), 400, 1.0);
    ended.unwrap_or_else(|error| panic!("{} of {law:?}: {error}", test.word()));
    states.last().expect("a state").clone()
}

fn laws() -> Vec<AnyLaw> {
    vec![
        VonMises::new(YOUNG, POISSON, 8e4, 0.0).into(),
        Tresca::new(YOUNG, POISSON, 4e4).into(),
        MohrCoulomb::new(YOUNG, POISSON, [30.0, 1e4, 0.0]).into(),
        MohrCoulomb::new(YOUNG, POISSON, [30.0, 1e4, 30.0]).into(),
        DruckerPrager::new(YOUNG, POISSON, [30.0, 1e4, 5.0], ConeMatch::Outer).into(),
        DruckerPrager::new(YOUNG, POISSON, [20.0, 1e4, 0.0], ConeMatch::Inner).into(),
    ]
}

/// Every law ends at its strength where that has a closed form, and stresses that are held stay.
#[test]
fn strength_is_what_a_closed_form_says() {
    let mut compared = 0;
    for law in laws() {
        for test in Test::ALL {
            let state = end(&law, test, 0.05);
            for (i, control) in test.controls(0.05).iter().enumerate() {
                if *control == Control::Held {
                    assert!(
                        (state.stress[i] + PRESSURE).abs() < 1e-8 * PRESSURE,
                        "{:?}",
                        state.stress
                    );
                }
            }
            if let Some(exact) = test.strength(&law, PRESSURE) {
                let found = state.deviator();
                assert!(
                    (found / exact - 1.0).abs() < 1e-8,
                    "{} of {law:?}: {found} {exact}",
                    test.word()
                );
                compared += 1;
            }
        }
    }
    assert!(compared >= 18, "{compared}");
}

/// Drained to failure: the volume grows by 2 sin psi/(1 - sin psi) of the axial strain of flow, and the modulus before is
/// Young's.
#[test]
fn dilation_and_stiffness_show_in_the_triaxial_test() {
    let law: AnyLaw = MohrCoulomb::new(YOUNG, POISSON, [30.0, 1e4, 12.0]).into();
    let controls = Test::Triaxial.controls(0.08);
    let (states, ended) = run(&law, 2000.0, PRESSURE, &controls, 400, 1.0);
    ended.expect("it goes through");
    let modulus = states[20].deviator() / -states[20].strain[2];
    // Hypoelastic stress is that of logarithmic strain: so is this slope.
    assert!((modulus / YOUNG - 1.0).abs() < 1e-9, "{modulus}");
    let (a, b) = (&states[300], &states[400]);
    let flow = -(b.volume_strain() - a.volume_strain()) / (b.strain[2] - a.strain[2]);
    let sine = 12.0_f64.to_radians().sin();
    assert!((flow - 2.0 * sine / (1.0 - sine)).abs() < 1e-6, "{flow}");
    // A step that strains by d has the volume exp(d) but for d³/12.
    assert!((b.volume.ln() - b.volume_strain()).abs() < 1e-9);
    assert!(b.dissipated > 0.0 && b.stored > 0.0);
}

#[test]
fn elastic_paths_are_those_of_hooke() {
    let law: AnyLaw = LinearElastic::new(YOUNG, POISSON).into();
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let bulk = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
    let near =
        |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
    near(end(&law, Test::Shear, 0.01).stress[4], shear * 0.01);
    near(
        end(&law, Test::Isotropic, 0.01).pressure(),
        PRESSURE + bulk * 0.01,
    );
    near(
        end(&law, Test::Undrained, 0.01).deviator(),
        3.0 * shear * 0.01,
    );
    let confined = bulk + 4.0 * shear / 3.0;
    near(
        -end(&law, Test::Oedometer, 0.01).stress[2],
        PRESSURE + confined * 0.01,
    );
    let plane = YOUNG / (1.0 - POISSON * POISSON);
    near(
        -end(&law, Test::Biaxial, 0.01).stress[2],
        PRESSURE + plane * 0.01,
    );
    assert!(Test::Triaxial.strength(&law, PRESSURE).is_none());
}

/// A strength that falls faster than the point unloads has no path under a held stress: it ends with an error, not with a
/// wrong curve.
#[test]
fn a_path_that_cannot_be_held_says_so() {
    let residual = Residual {
        cohesion: Some(0.0),
        ..Residual::default()
    };
    let softening = Softening::Linear {
        from: 0.0,
        to: 1e-4,
    };
    let law: AnyLaw = MohrCoulomb::new(YOUNG, POISSON, [0.0, 5e4, 0.0])
        .with_tensile(1e3)
        .softening(softening, residual)
        .into();
    let controls = Test::Triaxial.controls(0.1);
    let (states, ended) = run(&law, 2000.0, PRESSURE, &controls, 50, 1.0);
    // Whatever becomes of it, what is kept was held.
    for state in &states {
        assert!((state.stress[0] + PRESSURE).abs() < 1e-6 * PRESSURE);
    }
    let error = ended.expect_err("it cannot be held");
    assert!(error.to_string().starts_with("step "), "{error}");
}

/// A row that drives what the oedometer drives takes the same steps.
#[test]
fn a_table_can_repeat_the_oedometer() {
    for law in laws() {
        let controls = Test::Oedometer.controls(0.05);
        let (wanted, _) = run(&law, 2000.0, PRESSURE, &controls, 200, 1.0 / 200.0);
        let path = Path {
            stress: [false; 6],
            rows: vec![Row {
                time: 1.0,
                values: [0.0, 0.0, -0.05, 0.0, 0.0, 0.0],
            }],
        };
        let (times, found, ended) = follow(&law, 2000.0, PRESSURE, &path, 200);
        ended.expect("it goes through");
        assert_eq!((found.len(), times.last()), (201, Some(&1.0)));
        for (a, b) in wanted.iter().zip(&found) {
            let size = a.stress[2].abs();
            for (a, b) in a.stress.iter().zip(b.stress) {
                assert!((a - b).abs() <= 1e-12 * size, "{law:?}: {a} {b}");
            }
        }
    }
}

/// No stress at the sides: s_zz = E eps_zz, eps_xx = -nu eps_zz, there and back; and three stresses that differ.
#[test]
fn stresses_of_a_table_are_met() {
    let law: AnyLaw = LinearElastic::new(YOUNG, POISSON).into();
    let row = |time, zz| Row {
        time,
        values: [0.0, 0.0, zz, 0.0, 0.0, 0.0],
    };
    let path = Path {
        stress: [true, true, false, false, false, false],
        rows: vec![row(1.0, 0.01), row(3.0, -0.02)],
    };
    let (times, states, ended) = follow(&law, 2000.0, 0.0, &path, 50);
    ended.expect("it goes through");
    assert!((times[75] - 2.0).abs() < 1e-12);
    for k in [50, 75, 100] {
        let state = &states[k];
        let zz = [0.01, -0.005, -0.02][(k - 50) / 25];
        assert!((state.strain[2] - zz).abs() < 1e-12);
        assert!((state.stress[2] - YOUNG * zz).abs() < 1e-8 * YOUNG * zz.abs());
        assert!((state.strain[0] + POISSON * zz).abs() < 1e-8 * zz.abs());
    }
    let values = [-2e4, -3e4, -5e4, 0.0, 1e4, 0.0];
    let path = Path {
        stress: [true; 6],
        rows: vec![Row { time: 1.0, values }],
    };
    let (_, states, ended) = follow(&law, 2000.0, 0.0, &path, 10);
    ended.expect("it goes through");
    let last = states.last().expect("a state");
    for (found, wanted) in last.stress.iter().zip(values) {
        assert!((found - wanted).abs() < 1e-8 * 5e4, "{:?}", last.stress);
    }
    // Laws that yield reach their strength in the same way as by the test of that name.
    let law: AnyLaw = MohrCoulomb::new(YOUNG, POISSON, [30.0, 1e4, 0.0]).into();
    let path = Path {
        stress: [true, true, false, false, false, false],
        rows: vec![Row {
            time: 1.0,
            values: [-PRESSURE, -PRESSURE, -0.05, 0.0, 0.0, 0.0],
        }],
    };
    let (_, states, ended) = follow(&law, 2000.0, PRESSURE, &path, 200);
    ended.expect("it goes through");
    let exact = Test::Triaxial.strength(&law, PRESSURE).expect("a strength");
    let found = states.last().expect("a state").deviator();
    assert!((found / exact - 1.0).abs() < 1e-8, "{found} {exact}");
}

/// All the way, not at its end alone: elastic, up to a strength, and with every kind of hardening.
#[test]
fn curves_are_those_of_closed_forms() {
    let mut all = laws();
    all.extend([
        LinearElastic::new(YOUNG, POISSON).into(),
        VonMises::new(YOUNG, POISSON, 8e4, 2e6).into(),
        VonMises::new(YOUNG, POISSON, 8e4, -1e6).into(),
        VonMises::new(YOUNG, POISSON, 8e4, 1e5)
            .saturating(4e4, 80.0)
            .into(),
        VonMises::new(YOUNG, POISSON, 8e4, 1e5)
            .along(&[[0.005, 1.3e5], [0.02, 1e5]])
            .into(),
    ]);
    let mut compared = vec![0; all.len()];
    for (law, compared) in all.iter().zip(&mut compared) {
        for test in Test::ALL {
            let (states, ended) = run(law, 2000.0, PRESSURE, &test.controls(0.05), 500, 1.0);
            ended.unwrap_or_else(|error| panic!("{} of {law:?}: {error}", test.word()));
            for (i, state) in states.iter().enumerate() {
                let strain = 0.05 * i as f64 / 500.0;
                let Some(exact) = exact_deviator(test, law, PRESSURE, strain, 0.05) else {
                    continue;
                };
                let found = state.deviator();
                assert!(
                    (found - exact).abs() < 1e-7 * PRESSURE,
                    "{} of {law:?} at {strain}: {found} {exact}",
                    test.word()
                );
                *compared += 1;
            }
        }
    }
    assert!(
        compared.iter().all(|count| *count >= 2 * 501),
        "{compared:?}"
    );
    let late: AnyLaw = VonMises::new(YOUNG, POISSON, 8e4, 0.0).relaxing(0.1).into();
    assert_eq!(exact_deviator(Test::Shear, &late, 0.0, 0.05, 1.0), None);
}

/// Shear stress by the rate, start-up of flow at first order in the step, and a pressure that is a function of the volume.
#[test]
fn fluids_have_closed_forms() {
    let (end, time, bulk) = (0.02, 0.01, 2e6);
    let state = EquationOfState {
        bulk,
        exponent: 7.0,
        carries_tension: true,
    };
    let newtonian: AnyLaw = Newtonian::new(bulk, 3.0).with_state(state).into();
    let bingham: AnyLaw = Bingham::new(bulk, 5.0, 10.0, 2e3).into();
    for test in [
        Test::Oedometer,
        Test::Undrained,
        Test::Shear,
        Test::Isotropic,
    ] {
        let missed = |law: &AnyLaw, steps: usize| {
            let dt = time / steps as f64;
            let (states, ended) = run(law, 1000.0, PRESSURE, &test.controls(end), steps, dt);
            ended.expect("it goes through");
            let mut most = [0.0_f64; 2];
            for (i, state) in states.iter().enumerate().skip(1) {
                let strain = end * i as f64 / steps as f64;
                let rate = end / time;
                let q = exact_deviator(test, law, PRESSURE, strain, rate).expect("a q");
                let p = exact_pressure(test, law, PRESSURE, strain).expect("a p");
                let volume = state.volume_strain();
                let by_hand = if law.viscosity() > 0.0 {
                    bulk / 7.0 * ((1.0 + 7.0 * PRESSURE / bulk) * (-7.0 * volume).exp() - 1.0)
                } else {
                    PRESSURE - bulk * volume
                };
                assert!((p / by_hand - 1.0).abs() < 1e-12, "{p} {by_hand}");
                most[0] = most[0].max((state.deviator() - q).abs());
                most[1] = most[1].max((state.pressure() - p).abs());
            }
            most
        };
        let found = missed(&newtonian, 200);
        // What is missing of p is that the volume of a step is not exp of its strain to the third power of the step.
        assert!(found[0] < 1e-8 && found[1] < 1e-8 * bulk, "{found:?}");
        let [coarse, fine] = [200, 400].map(|steps| missed(&bingham, steps)[0]);
        if test == Test::Isotropic {
            assert!(coarse < 1e-8, "{coarse}");
        } else {
            let order = (coarse / fine).log2();
            assert!((order - 1.0).abs() < 0.1 && fine < 0.5, "{order} {fine}");
        }
    }
    assert_eq!(exact_pressure(Test::Extension, &newtonian, 0.0, 0.01), None);
    assert_eq!(exact_pressure(Test::Oedometer, &laws()[0], 0.0, 0.01), None);
}

/// Pressed until it flows under held stress, unloaded, sheared under another: the way back begins along Young's line whatever
/// the flow before, and each stress of the way is met.
#[test]
fn a_table_unloads_at_held_stress() {
    let soil = [30.0, 5e3, 10.0];
    let mut all = laws();
    all.push(MohrCoulomb::new(YOUNG, POISSON, soil).into());
    all.push(MohrCoulomb::new(YOUNG, POISSON, [35.0, 0.0, 5.0]).into());
    all.push(DruckerPrager::new(YOUNG, POISSON, soil, ConeMatch::Outer).into());
    for law in all {
        let p = -PRESSURE;
        let row = |time, values| Row { time, values };
        let path = Path {
            stress: [true, true, false, false, false, false],
            rows: vec![
                row(1.0, [p, p, -0.05, 0.0, 0.0, 0.0]),
                row(2.0, [p, p, -0.02, 0.0, 0.0, 0.0]),
                row(3.0, [1.5 * p, p, -0.05, 0.0, 0.01, 0.0]),
            ],
        };
        for steps in [7, 50, 200] {
            let (times, states, ended) = follow(&law, 2000.0, PRESSURE, &path, steps);
            ended.unwrap_or_else(|error| panic!("{law:?} in {steps} steps: {error}"));
            assert_eq!(states.len(), 3 * steps + 1);
            for (time, state) in times.iter().zip(&states) {
                let x = p * (1.0 + 0.5 * (time - 2.0).max(0.0));
                let off = (state.stress[0] - x).abs().max((state.stress[1] - p).abs());
                assert!(off < 1e-8 * 5.0 * PRESSURE, "{law:?}: {:?}", state.stress);
            }
            let (flown, back) = (&states[steps], &states[steps + 1]);
            assert!(flown.dissipated > 0.0, "{law:?}");
            let slope = (back.stress[2] - flown.stress[2]) / (back.strain[2] - flown.strain[2]);
            if steps == 200 {
                assert!((slope / YOUNG - 1.0).abs() < 1e-6, "{law:?}: {slope}");
            }
        }
    }
}
