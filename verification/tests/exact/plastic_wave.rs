//! The wave in a solid that yields: its differential equations, its balances, and a march along characteristics.

use approx::assert_relative_eq;
use proctor_verification::exact::plastic_wave::PlasticWave;
use proctor_verification::exact::two_slopes::TwoSlopes;

/// The set-up of the notes: c_e = 11.6024, c_p = 9.3500, limit 0.175.
fn wave() -> PlasticWave {
    let solid = TwoSlopes::von_mises(100.0, 0.3, 0.1, 10.0);
    PlasticWave {
        solid,
        density: 1.0,
        load: 3.0 * solid.limit,
        rise: 0.03,
    }
}

fn end(wave: &PlasticWave) -> f64 {
    0.9 / wave.elastic_speed()
}

#[test]
fn the_notes_have_speeds_and_limit() {
    let wave = wave();
    assert_relative_eq!(wave.elastic_speed(), 11.6024, max_relative = 1e-5);
    assert_relative_eq!(wave.plastic_speed(), 9.35, max_relative = 1e-5);
    assert_relative_eq!(wave.solid.limit, 0.175, max_relative = 1e-12);
}

/// rho v_t = -q_x and e_t = -v_x by central differences, away from the kinks.
#[test]
fn momentum_and_strain_are_in_step() {
    let (wave, d) = (wave(), 1e-6);
    let mut compared = 0;
    for i in 1..100 {
        for t in [0.2, 0.5, 0.8, 1.0].map(|share| share * end(&wave)) {
            let x = f64::from(i) / 100.0;
            let along = |of: &dyn Fn(f64) -> f64| (of(x + d) - of(x - d)) / (2.0 * d);
            let later = |of: &dyn Fn(f64) -> f64| (of(t + d) - of(t - d)) / (2.0 * d);
            let strain = |x: f64, t: f64| wave.solid.strain(wave.compression(x, t));
            let momentum =
                wave.density * later(&|t| wave.velocity(x, t)) + along(&|x| wave.compression(x, t));
            let fit = later(&|t| strain(x, t)) + along(&|x| wave.velocity(x, t));
            let near = (wave.compression(x, t) / wave.solid.limit - 1.0).abs() < 1e-3;
            if !near {
                assert!(momentum.abs() < 1e-5, "{x} {t}: {momentum:e}");
                assert!(fit.abs() < 1e-5, "{x} {t}: {fit:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared}");
}

/// The impulse of the load is the momentum, and its work is what moves, what is stored and what was dissipated: no wave
/// is a shock.
#[test]
fn balances_close() {
    let wave = wave();
    let n = 20_000;
    let dx = 1.0 / f64::from(n);
    let over = |of: &dyn Fn(f64) -> f64| -> f64 {
        (0..n).map(|i| of((f64::from(i) + 0.5) * dx)).sum::<f64>() * dx
    };
    for t in [0.3, 0.7, 1.0].map(|share| share * end(&wave)) {
        let momentum = over(&|x| wave.density * wave.velocity(x, t));
        assert_relative_eq!(momentum, wave.momentum(t), max_relative = 1e-6);
        let kinetic = over(&|x| 0.5 * wave.density * wave.velocity(x, t).powi(2));
        let stored = over(&|x| wave.solid.stored(wave.compression(x, t)));
        let plastic = over(&|x| wave.solid.plastic_work(wave.compression(x, t)));
        assert_relative_eq!(
            plastic,
            wave.plastic_work(t),
            epsilon = 1e-12,
            max_relative = 1e-6
        );
        assert_relative_eq!(
            kinetic + stored + plastic,
            wave.work(t),
            max_relative = 1e-6
        );
    }
}

/// A march of masses and springs that have the two slopes, by central differences: it knows no speeds, and comes nearer with
/// the first power of the spacing or better.
#[test]
fn masses_and_springs_come_near() {
    let wave = wave();
    let off = |n: usize| -> f64 {
        let dx = 1.0 / n as f64;
        let steps = (2.0 * end(&wave) * wave.elastic_speed() / dx).ceil();
        let dt = end(&wave) / steps;
        let (mut v, mut strain) = (vec![0.0; n + 1], vec![0.0; n]);
        let stress = |e: f64| {
            let first = wave.solid.limit / wave.solid.confined_modulus();
            if e < first {
                wave.solid.confined_modulus() * e
            } else {
                wave.solid.limit + wave.solid.plastic_modulus * (e - first)
            }
        };
        for step in 0..steps as usize {
            let load = wave.load_at(step as f64 * dt);
            for i in 0..n {
                let (left, mass) = if i == 0 {
                    (load, 0.5 * dx)
                } else {
                    (stress(strain[i - 1]), dx)
                };
                v[i] += dt * (left - stress(strain[i])) / (wave.density * mass);
            }
            for i in 0..n {
                strain[i] += dt * (v[i] - v[i + 1]) / dx;
            }
        }
        let (mut difference, mut scale) = (0.0, 0.0);
        for (i, e) in strain.iter().enumerate() {
            let exact = wave.compression((i as f64 + 0.5) * dx, end(&wave));
            difference += (stress(*e) - exact).powi(2);
            scale += exact.powi(2);
        }
        (difference / scale).sqrt()
    };
    let [coarse, fine] = [100, 200].map(off);
    assert!(coarse < 1e-2 && fine < 0.6 * coarse, "{coarse:e} {fine:e}");
}
