//! Flow between walls, against finite differences.

use approx::assert_relative_eq;
use proctor_verification::exact::channel::Channel;

const CHANNEL: Channel = Channel {
    width: 0.8,
    viscosity: 3.0,
    density: 900.0,
    yield_stress: 0.0,
};

/// Velocities at the nodes of a grid after a time: v' = g + nu v'' with the far wall at a speed, explicit.
fn diffused(g: f64, speed: f64, time: f64) -> Vec<f64> {
    const CELLS: usize = 100;
    let h = CHANNEL.width / CELLS as f64;
    let nu = CHANNEL.diffusivity();
    let steps = (time * nu / (0.1 * h * h)).ceil() as usize;
    let dt = time / steps as f64;
    let mut v = vec![0.0; CELLS + 1];
    v[CELLS] = speed;
    for _ in 0..steps {
        let old = v.clone();
        for i in 1..CELLS {
            v[i] += dt * (g + nu * (old[i - 1] - 2.0 * old[i] + old[i + 1]) / (h * h));
        }
    }
    v
}

#[test]
fn series_solve_the_equation_of_diffusion() {
    let crossing = CHANNEL.width * CHANNEL.width / CHANNEL.diffusivity();
    for share in [0.02, 0.1, 0.4] {
        let time = share * crossing;
        let (force, wall) = (diffused(0.3, 0.0, time), diffused(0.0, 0.2, time));
        for (i, (by_force, by_wall)) in force.iter().zip(&wall).enumerate() {
            let y = CHANNEL.width * i as f64 / 100.0;
            let exact = CHANNEL.driven_by_force(0.3, y, time);
            assert!((by_force - exact).abs() < 2e-4 * force[50], "{share} {y}");
            let exact = CHANNEL.dragged(0.2, y, time);
            assert!(
                (by_wall - exact).abs() < 2e-4 * 0.2,
                "{share} {y} {by_wall} {exact}"
            );
        }
    }
}

#[test]
fn series_end_in_the_steady_flow() {
    for y in [0.1, 0.3, 0.4, 0.75] {
        let late = CHANNEL.driven_by_force(0.3, y, 1e6);
        let at_last = CHANNEL.driven_by_force_at_last(0.3, y);
        assert_relative_eq!(late, at_last, max_relative = 1e-12);
        assert_relative_eq!(
            CHANNEL.dragged(0.2, y, 1e6),
            0.2 * y / CHANNEL.width,
            max_relative = 1e-12
        );
    }
}

/// tau = tau_y + mu |dv/dy| balances the force up to the middle where it flows, and a plug moves as one.
#[test]
fn a_plug_flows_where_the_stress_is_low() {
    let g = 0.05;
    let bingham = Channel {
        yield_stress: 6.0,
        ..CHANNEL
    };
    let velocity = |y: f64| bingham.driven_by_force_at_last(g, y);
    let plug = 6.0 / (900.0 * g);
    let half = 0.5 * bingham.width;
    assert_eq!(velocity(half), velocity(half - 0.99 * plug));
    for y in [0.05, 0.15, 0.7] {
        let d = 1e-6;
        let slope = (velocity(y + d) - velocity(y - d)) / (2.0 * d);
        let stress = 6.0 + 3.0 * slope.abs();
        assert_relative_eq!(stress, 900.0 * g * (y - half).abs(), max_relative = 1e-6);
    }
    assert_eq!(velocity(0.0), 0.0);
    assert_relative_eq!(
        bingham.dragging_stress(0.4),
        6.0 + 3.0 * 0.5,
        max_relative = 1e-12
    );
    // Too weak a force moves nothing.
    assert_eq!(bingham.driven_by_force_at_last(1e-3, 0.3), 0.0);
}
