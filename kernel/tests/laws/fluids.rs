//! Fluids at a material point: a pressure that is a function of the volume, shear that follows its rate.

use crate::laws::support::{DENSITY, close, first_order, midpoint, numbers, point, strain, tensor};
use nalgebra::Matrix3;
use proctor_laws::{AnyLaw, Bingham, EquationOfState, Newtonian, Particle, Point, UNDEFORMED};

const BULK: f64 = 2.0e5;
const VISCOSITY: f64 = 3.0;

fn state(exponent: f64, carries_tension: bool) -> EquationOfState {
    EquationOfState {
        bulk: BULK,
        exponent,
        carries_tension,
    }
}

fn newtonian(state: EquationOfState) -> AnyLaw {
    Newtonian::new(state.bulk, VISCOSITY)
        .with_state(state)
        .into()
}

/// Pressure of a point whose volume ratio is J.
fn pressure(law: &AnyLaw, j: f64) -> f64 {
    let mut point = point(law);
    let e = Matrix3::identity() * (j.ln() / 3.0);
    strain(&mut point, &e, 100);
    // What the strains add up to is not exactly ln J.
    assert!((point.volume() / j - 1.0).abs() < 1e-4);
    let s = tensor(point.stress());
    -s.trace() / 3.0
}

/// K/n (J^-n - 1), -K ln J for n = 0.
fn exact(n: f64, j: f64) -> f64 {
    if n == 0.0 {
        -BULK * j.ln()
    } else {
        BULK / n * (j.powf(-n) - 1.0)
    }
}

#[test]
fn pressure_is_a_function_of_the_volume() {
    for n in [0.0, 1.0, 7.0] {
        let law = newtonian(state(n, true));
        for j in [0.9, 0.999, 1.0, 1.001, 1.1] {
            let mut point = point(&law);
            strain(
                &mut point,
                &(Matrix3::identity() * (libm::log(j) / 3.0)),
                50,
            );
            let (found, exact) = (
                -tensor(point.stress()).trace() / 3.0,
                exact(n, point.volume()),
            );
            close(found, exact, 1e-12, exact.abs().max(1e-2 * BULK));
        }
    }
}

/// An increment K tr D dt is left with 1e-5 K after such a cycle.
#[test]
fn a_cycle_of_volume_brings_the_pressure_back() {
    for n in [0.0, 7.0] {
        let mut point = point(&newtonian(state(n, true)));
        let e = Matrix3::identity() * (0.1 / 3.0);
        strain(&mut point, &-e, 1000);
        assert!(tensor(point.stress()).trace() < -0.29 * BULK);
        strain(&mut point, &e, 1000);
        let left = tensor(point.stress()).trace() / 3.0;
        assert!(left.abs() < 1e-12 * BULK, "{left} Pa are left");
    }
}

/// Simpson's rule of the pressure over the volume, from J to 1.
fn integral(n: f64, j: f64) -> f64 {
    const HALVES: u32 = 2000;
    let width = (1.0 - j) / f64::from(HALVES);
    let at = |i: u32| exact(n, j + width * f64::from(i));
    let inner = (1..HALVES).map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) });
    width / 3.0 * (at(0) + inner.sum::<f64>() + at(HALVES))
}

#[test]
fn energy_is_the_work_of_the_pressure() {
    for n in [0.0, 0.5, 1.0, 2.0, 7.0] {
        for j in [0.5, 0.949, 0.951, 0.99, 1.01, 1.049, 1.051, 1.5] {
            let (found, exact) = (state(n, true).energy_density(j), integral(n, j));
            close(found, exact, 1e-11, exact);
        }
        // Where Simpson's rule has no digits, the first terms: K x²/2 (1 - (n + 1) x/3 ...).
        let x = 1e-5;
        let first = 0.5 * BULK * x * x * (1.0 - (n + 1.0) * x / 3.0);
        close(state(n, true).energy_density(1.0 + x), first, 1e-8, first);
        assert_eq!(state(n, false).energy_density(1.3), 0.0);
        assert!(state(n, false).energy_density(0.9) > 0.0);
    }
}

#[test]
fn a_fluid_without_tension_parts_at_no_pressure() {
    let law = newtonian(state(7.0, false));
    assert_eq!(pressure(&law, 1.05), 0.0);
    assert!(pressure(&law, 0.95) > 0.0);
    assert!(pressure(&newtonian(state(7.0, true)), 1.05) < 0.0);
}

/// s = 2 mu dev D, in shear and along an axis, whatever came before.
#[test]
fn newtons_stress_follows_the_rate() {
    let mut next = numbers(5);
    for _ in 0..50 {
        let d = Matrix3::from_fn(|_, _| 1e-3 * next());
        let d = 0.5 * (d + d.transpose());
        let dt = 1e-2;
        let mut point = point(&newtonian(state(0.0, true)));
        for _ in 0..3 {
            point
                .step(&midpoint(&d).map(|row| row.map(|x| x / dt)), dt)
                .expect("a finite stress");
        }
        let s = tensor(point.stress());
        let deviator = s - Matrix3::identity() * (s.trace() / 3.0);
        let rate = (d - Matrix3::identity() * (d.trace() / 3.0)) / dt;
        let exact = rate * (2.0 * VISCOSITY);
        // The pressure of the volume change is the larger part of the stress that these digits are of.
        assert!((deviator - exact).amax() < 1e-12 * (s.amax() + exact.amax()));
        let work = point.dissipated();
        let each = exact.dot(&(rate * dt));
        close(work, 3.0 * each, 1e-2, 3.0 * each);
    }
}

const SHEAR: f64 = 500.0;
const LIMIT: f64 = 2.0;

/// Simple shear of Bingham's fluid from rest at a constant rate: tau = G g' t up to the yield stress, from then on
/// tau_y + mu g' (1 - exp(-G (t - t_y)/mu)).
#[test]
fn bingham_starts_to_flow() {
    let rate = 1.5;
    let onset = LIMIT / (SHEAR * rate);
    let end = onset + VISCOSITY / SHEAR;
    let exact = LIMIT + VISCOSITY * rate * (1.0 - (-SHEAR * (end - onset) / VISCOSITY).exp());
    let law: AnyLaw = Bingham::new(BULK, VISCOSITY, LIMIT, SHEAR).into();
    let mut errors = vec![];
    for steps in [100_u32, 200, 400, 800] {
        let mut point = point(&law);
        // The first steps end exactly at the yield stress.
        for (time, count) in [(onset, steps), (end - onset, steps)] {
            let dt = time / f64::from(count);
            let mut d = [[0.0; 6]; 1];
            d[0][5] = 0.5 * rate * dt;
            for _ in 0..count {
                point.strain(&d[0], dt).expect("a finite stress");
            }
        }
        errors.push((point.stress()[5] - exact).abs() / exact);
    }
    first_order(&errors);
    assert!(errors[3] < 2e-3, "{errors:?}");
}

/// Far below its yield stress it is elastic and dissipates nothing; without one it is Maxwell's fluid.
#[test]
fn bingham_is_elastic_below_its_yield_stress_and_maxwells_fluid_without_one() {
    let law: AnyLaw = Bingham::new(BULK, VISCOSITY, LIMIT, SHEAR).into();
    let mut point_ = point(&law);
    let g = 0.9 * LIMIT / SHEAR;
    for _ in 0..10 {
        point_
            .strain(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.05 * g], 1.0)
            .expect("a finite stress");
    }
    close(point_.stress()[5], 0.9 * LIMIT, 1e-12, LIMIT);
    assert_eq!(point_.dissipated(), 0.0);
    close(
        point_.energy(),
        0.5 * (0.9 * LIMIT).powi(2) / SHEAR,
        1e-10,
        LIMIT,
    );

    let law: AnyLaw = Bingham::new(BULK, VISCOSITY, 0.0, SHEAR).into();
    let mut maxwell = point(&law);
    let rate = 0.7;
    let dt = 0.01 * VISCOSITY / SHEAR;
    for _ in 0..5000 {
        maxwell
            .strain(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * rate * dt], dt)
            .expect("a finite stress");
    }
    close(
        maxwell.stress()[5],
        VISCOSITY * rate,
        1e-9,
        VISCOSITY * rate,
    );
}

/// Energy put in by a long random path is stored or dissipated, and nothing is ever dissipated backwards.
#[test]
fn work_is_stored_or_dissipated() {
    let laws: [AnyLaw; 3] = [
        newtonian(state(7.0, true)),
        Bingham::new(BULK, VISCOSITY, LIMIT, SHEAR).into(),
        Bingham::new(BULK, 0.0, LIMIT, SHEAR).into(),
    ];
    for law in laws {
        let mut next = numbers(17);
        let mut point = Point::new(&law, DENSITY, [0.0; 6]);
        let (mut work, mut before) = (0.0, 0.0);
        for _ in 0..40 {
            let d = Matrix3::from_fn(|_, _| 2e-2 * next());
            let d = 0.5 * (d + d.transpose());
            for _ in 0..50 {
                let (old, volume) = (tensor(point.stress()), point.volume());
                let e = d / 50.0;
                let increment = [
                    e[(0, 0)],
                    e[(1, 1)],
                    e[(2, 2)],
                    e[(1, 2)],
                    e[(0, 2)],
                    e[(0, 1)],
                ];
                point.strain(&increment, 1e-3).expect("a finite stress");
                let new = tensor(point.stress());
                // Viscous stress is that of the step, all others are halfway between its ends.
                let mean = 0.5 * (old + new);
                let pressure = Matrix3::identity() * (mean.trace() / 3.0);
                let deviator = |s: &Matrix3<f64>| s - Matrix3::identity() * (s.trace() / 3.0);
                let shear = if law.viscosity() > 0.0 {
                    deviator(&new)
                } else {
                    deviator(&mean)
                };
                work += (pressure + shear).dot(&e) * 0.5 * (volume + point.volume());
                assert!(point.dissipated() >= before);
                before = point.dissipated();
            }
        }
        let sum = point.energy() + point.dissipated();
        assert!(point.dissipated() > 0.0);
        close(sum, work, 0.03, work);
    }
}

/// A parted fluid is no faster than at rest, carries shear by its share of fluid alone, and keeps its energy balance.
#[test]
fn a_fluid_that_has_parted_is_no_faster_than_at_rest() {
    let bingham = Bingham::new(BULK, VISCOSITY, LIMIT, SHEAR).with_state(state(7.0, false));
    for (law, strength) in [(newtonian(state(7.0, false)), 0.0), (bingham.into(), LIMIT)] {
        let law: AnyLaw = law;
        assert!(law.parts());
        let mut point = point(&law);
        let mut work = 0.0;
        for _ in 0..2000 {
            let (before, volume) = (tensor(point.stress()), point.volume());
            // Sheared beyond what it bears, and drawn apart.
            let step = [1e-3, 1e-3, 1e-3, 0.0, 0.0, 2e-5];
            point.strain(&step, 1e-3).expect("a finite stress");
            let after = tensor(point.stress());
            let shear = if strength > 0.0 {
                0.5 * (before + after)
            } else {
                after
            };
            work += 2.0 * shear[(0, 1)] * 2e-5 * 0.5 * (volume + point.volume());
        }
        let j = point.volume();
        assert!(j > 300.0);
        let viscous = 2.0 * VISCOSITY * 2e-2;
        let shear = point.stress()[5];
        if strength > 0.0 {
            assert!(shear > 0.9 * strength / j, "{shear}");
        }
        assert!(shear * j < strength + viscous * 1.001, "{shear} {j}");
        close(point.energy() + point.dissipated(), work, 0.01, work);
        let square = law.speed_squared(&Particle {
            mass: DENSITY,
            volume: j,
            density: DENSITY,
            stress: point.stress(),
            deformation: UNDEFORMED,
            variables: &point.variables(),
        });
        let at_rest = law.wave_speed(DENSITY).powi(2);
        close(square, at_rest, 1e-12, at_rest);
    }
}

/// Directions mean nothing to a fluid, and nothing else than the deviator of the stress before is remembered.
#[test]
fn fluids_are_isotropic() {
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -1.1, 2.0).into_inner();
    let laws: [AnyLaw; 2] = [
        newtonian(state(0.0, true)),
        Bingham::new(BULK, VISCOSITY, LIMIT, SHEAR).into(),
    ];
    for law in laws {
        let mut next = numbers(9);
        let (mut a, mut b) = (point(&law), point(&law));
        for _ in 0..50 {
            let d = Matrix3::from_fn(|_, _| 5e-3 * next());
            let turned = turn * d * turn.transpose();
            a.step(&midpoint(&d), 1.0).expect("a finite stress");
            b.step(&midpoint(&turned), 1.0).expect("a finite stress");
            let (a, b) = (tensor(a.stress()), tensor(b.stress()));
            assert!((turn * a * turn.transpose() - b).amax() < 1e-13 * BULK);
        }
    }
}
