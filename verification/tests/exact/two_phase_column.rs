//! The column of soil and water: both equations of motion, the limits of Terzaghi and of no drainage.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::consolidation::Layer;
use proctor_verification::exact::two_phase_column::{SuddenLoads, TwoPhaseColumn};

fn column(conductivity: f64) -> TwoPhaseColumn {
    let column = TwoPhaseColumn {
        height: 1.0,
        confined_modulus: 1e7,
        bulk_water: 2e8,
        porosity: 0.4,
        density_grains: 2650.0,
        density_water: 1000.0,
        conductivity,
        gravity: 10.0,
        load: 1e3,
        ramp: 1.0,
    };
    TwoPhaseColumn {
        ramp: 40.0 / column.undrained_speed(),
        ..column
    }
}

/// Values of an independent program: eigenvalues of each mode, and the load in closed form.
#[test]
fn values_of_another_program() {
    for (k, t, base, middle, top) in [
        (1e-2, 0.1, 309.8072, 219.1023, -8.078_276_3e-5),
        (1e-3, 0.1, 971.1557, 839.8829, -2.865_895_8e-5),
        (1e-4, 1.0, 938.7917, 735.5004, -3.590_650_9e-5),
        (1e-5, 10.0, 934.0121, 726.8785, -3.653_032_2e-5),
        (1e-6, 100.0, 933.5459, 726.0478, -3.659_200_9e-5),
    ] {
        let state = column(k).at(t, 500);
        assert_relative_eq!(state.pressure(0.0), base, max_relative = 3e-7);
        assert_relative_eq!(state.pressure(0.5), middle, max_relative = 3e-7);
        assert_relative_eq!(state.displacement(1.0), top, max_relative = 3e-7);
    }
}

/// The total stress has the slope of the momentum of both: `sigma'_z - p_z = (1 - n) rho_s u'' + n rho_w w''`; with
/// little water
/// flow `w'' = u''` and the mean density is that of both.
#[test]
fn momentum_of_both_balances() {
    let column = column(1e-8);
    let column = TwoPhaseColumn {
        ramp: 2.0 / column.undrained_speed(),
        ..column
    };
    let (t, z, modes) = (0.75 * column.ramp, 0.4, 200);
    let slope = derivative(
        |dz| {
            let state = column.at(t, modes);
            state.effective_stress(z + dz) - state.pressure(z + dz)
        },
        1e-4,
    );
    let step = 2e-3 * column.ramp;
    let u = |dt: f64| column.at(t + dt, modes).displacement(z);
    let acceleration = (u(step) - 2.0 * u(0.0) + u(-step)) / (step * step);
    let inertia = column.saturated_density() * acceleration;
    let size = column.load / column.height;
    assert!((slope - inertia).abs() < 1e-2 * size, "{slope} {inertia}");
    assert!(inertia.abs() > 0.1 * size, "{inertia}");
}

/// Slow loading has no inertia left: Terzaghi's pressure, with the ramp in equal shares of the degree of that
/// polynomial.
#[test]
fn slow_loading_is_terzaghi() {
    let column = column(1e-5);
    let layer = Layer {
        height: 1.0,
        confined_modulus: 1e7,
        storage: 2e8 / 0.4,
        mobility: 1e-5 / 1e4,
        load: 1e3,
    };
    let state = column.at(10.0, 500);
    // A ramp that is even about its middle is the load at once at its middle, but for the square of ramp over time.
    let since = 10.0 - 0.5 * column.ramp;
    for z in [0.0, 0.3, 0.7] {
        let exact = layer.pressure(z, since, 0.0);
        assert_relative_eq!(state.pressure(z), exact, max_relative = 2e-5);
    }
    assert_relative_eq!(
        state.displacement(1.0),
        layer.settlement(since, 0.0),
        max_relative = 2e-5
    );
}

/// At the start, before anything drains, water carries its share of the stiffness.
#[test]
fn nothing_drains_at_first() {
    let column = column(1e-7);
    let t = 2.0 * column.ramp;
    let state = column.at(t, 1000);
    let share = state.pressure(0.2) / (state.pressure(0.2) - state.effective_stress(0.2));
    assert_relative_eq!(share, column.undrained_share(), max_relative = 1e-4);
}

/// Means between two heights are those of sixty points between them.
#[test]
fn means_are_those_of_points() {
    let state = column(1e-3).at(0.1, 200);
    let (low, high, points) = (0.5, 0.8, 60);
    let mean = |of: &dyn Fn(f64) -> f64| {
        let at = |i: usize| low + (high - low) * (i as f64 + 0.5) / points as f64;
        (0..points).map(|i| of(at(i))).sum::<f64>() / points as f64
    };
    let pressure = mean(&|z| state.pressure(z));
    let stress = mean(&|z| state.effective_stress(z));
    assert_relative_eq!(
        state.mean_pressure(low, high),
        pressure,
        max_relative = 1e-4
    );
    assert_relative_eq!(
        state.mean_effective_stress(low, high),
        stress,
        max_relative = 1e-4
    );
}

/// A load that comes on at once is the limit of a short ramp, on whose middle it comes.
#[test]
fn a_sudden_load_is_a_short_ramp() {
    let column = column(1e-3);
    let column = TwoPhaseColumn {
        ramp: 1e-6,
        ..column
    };
    let loads = SuddenLoads {
        load: column.load,
        ..SuddenLoads::default()
    };
    for t in [0.05, 0.2] {
        let sudden = column.after(loads, t - 0.5 * column.ramp, 200);
        let ramped = column.at(t, 200);
        for [low, high] in [[0.0, 0.25], [0.5, 0.75]] {
            let [a, b] = [
                ramped.mean_pressure(low, high),
                sudden.mean_pressure(low, high),
            ];
            assert_relative_eq!(a, b, max_relative = 1e-4);
        }
        assert_relative_eq!(
            ramped.displacement(1.0),
            sudden.displacement(1.0),
            max_relative = 1e-4
        );
    }
}

/// Under gravity the water comes to rest, and the skeleton under the buoyant weight; a pressure at the start drains as Terzaghi's
/// series says, all of which it carried.
#[test]
fn gravity_and_pressures_at_the_start_come_to_rest() {
    let column = column(1e-3);
    let heavy = SuddenLoads {
        gravity: 9.0,
        ..SuddenLoads::default()
    };
    let rest = column.after(heavy, 50.0, 200);
    assert_relative_eq!(
        rest.mean_pressure(0.0, 0.5),
        9e3 * 0.75,
        max_relative = 1e-6
    );
    let settlement = -0.5 * 0.6 * 1650.0 * 9.0 / 1e7;
    assert_relative_eq!(rest.displacement(1.0), settlement, max_relative = 1e-6);

    let slow = TwoPhaseColumn {
        conductivity: 1e-5,
        ..column
    };
    let drained = SuddenLoads {
        load: 1e3,
        pressure: 1e3,
        gravity: 0.0,
    };
    let layer = Layer {
        height: 1.0,
        confined_modulus: 1e7,
        storage: 2e8 / 0.4,
        mobility: 1e-5 / 1e4,
        load: 1e3,
    };
    // The series of a load that comes on at once begins with its undrained pressure.
    let share = 1e3 / layer.undrained_pressure();
    for t in [5.0, 20.0, 50.0] {
        let state = slow.after(drained, t, 400);
        let exact = share * layer.pressure(0.1, t, 0.0);
        assert_relative_eq!(
            state.mean_pressure(0.099, 0.101),
            exact,
            max_relative = 1e-3
        );
    }
    let gone = slow.after(drained, 1e4, 400);
    assert_relative_eq!(gone.displacement(1.0), -1e3 / 1e7, max_relative = 1e-6);
}
