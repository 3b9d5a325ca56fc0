//! The mode of damped sound, against its differential equation.

use proctor_verification::exact::sound::DampedSound;

#[test]
fn the_mode_solves_its_equation() {
    let mode = DampedSound {
        speed: 12.0,
        diffusivity: 0.7,
        wave_number: 2.0,
    };
    // u'' + nu k² u' + c² k² u = 0 by the classical rule of Runge and Kutta.
    let (a, b) = (0.7 * 4.0, 144.0 * 4.0);
    let f = |[u, v]: [f64; 2]| [v, -a * v - b * u];
    let add = |x: [f64; 2], s: f64, y: [f64; 2]| [x[0] + s * y[0], x[1] + s * y[1]];
    let (mut x, dt) = ([0.0, 1.0], 1e-4);
    for i in 0..5000 {
        let exact = mode.velocity(f64::from(i) * dt);
        assert!((x[1] - exact).abs() < 1e-9, "{i}: {} {exact}", x[1]);
        let k1 = f(x);
        let k2 = f(add(x, 0.5 * dt, k1));
        let k3 = f(add(x, 0.5 * dt, k2));
        let k4 = f(add(x, dt, k3));
        for i in 0..2 {
            x[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    assert!((mode.decay() - 1.4).abs() < 1e-12);
}
