//! Impact of bars: conservation, known limits, and the method of characteristics.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use proctor_verification::exact::bar_impact::{BarImpact, MovingBar};

fn bar(length: f64, ratio: f64, velocity: f64) -> MovingBar {
    MovingBar {
        length,
        modulus: 100.0 * ratio,
        density: ratio,
        velocity,
    }
}

fn after(impact: &BarImpact) -> [f64; 2] {
    impact.velocities().expect("they meet")
}

#[test]
fn equal_bars_exchange_their_velocities() {
    let impact = BarImpact {
        bars: [bar(2.0, 1.0, 0.3), bar(2.0, 1.0, -0.1)],
    };
    assert_relative_eq!(impact.press().expect("they meet").duration, 0.4);
    let [a, b] = after(&impact);
    assert_relative_eq!(a, -0.1, max_relative = 1e-13);
    assert_relative_eq!(b, 0.3, max_relative = 1e-13);
    assert_relative_eq!(impact.stress(), 0.5 * 10.0 * 0.4, max_relative = 1e-13);
}

#[test]
fn equal_transit_times_keep_momentum_and_energy() {
    for ratio in [1.0, 1e3, 1e6] {
        let impact = BarImpact {
            bars: [bar(2.0, 1.0, 1.0), bar(2.0, ratio, -0.5)],
        };
        let v = after(&impact);
        let sum = |f: fn(f64) -> f64, v: [f64; 2]| {
            (0..2).map(|i| impact.bars[i].mass() * f(v[i])).sum::<f64>()
        };
        let before = impact.bars.map(|b| b.velocity);
        assert_relative_eq!(sum(|v| v, v), sum(|v| v, before), max_relative = 1e-9);
        assert_relative_eq!(
            sum(|v| v * v, v),
            sum(|v| v * v, before),
            max_relative = 1e-9
        );
        assert_relative_eq!(
            impact.restitution().expect("they meet"),
            1.0,
            max_relative = 1e-9
        );
    }
}

/// Saint-Venant: the shorter of two bars of one material stops, and restitution is the ratio of the lengths.
#[test]
fn the_shorter_bar_stops() {
    let impact = BarImpact {
        bars: [bar(1.0, 1.0, 0.2), bar(2.5, 1.0, 0.0)],
    };
    let [a, b] = after(&impact);
    assert_abs_diff_eq!(a, 0.0, epsilon = 1e-15);
    assert_relative_eq!(b, 0.08, max_relative = 1e-13);
    assert_relative_eq!(
        impact.restitution().expect("they meet"),
        0.4,
        max_relative = 1e-13
    );
}

#[test]
fn bars_that_do_not_come_nearer() {
    let parting = BarImpact {
        bars: [bar(1.0, 1.0, 0.0), bar(1.0, 1.0, 0.1)],
    };
    assert_eq!((parting.velocities(), parting.press()), (None, None));
}

/// Bars that nearly have equal transits or impedances do nearly what those do that have.
#[test]
fn the_closed_families_are_limits() {
    for (length, ratio) in [(2.0, 1.0), (2.0, 5.0), (3.0, 1.0)] {
        let of = |length: f64, ratio: f64| BarImpact {
            bars: [bar(2.0, 1.0, 0.3), bar(length, ratio, -0.1)],
        };
        let closed = of(length, ratio).press().expect("they meet");
        let near = of(length * (1.0 + 1e-7), ratio * (1.0 + 1e-7))
            .press()
            .expect("they meet");
        assert_ne!(closed, near);
        assert_relative_eq!(near.impulse, closed.impulse, max_relative = 1e-5);
        assert_relative_eq!(near.duration, closed.duration, max_relative = 1e-5);
    }
}

/// A wall is a bar with a transit as long and a mass beyond bounds. Its impulse is what turns the momentum round.
#[test]
fn a_wall_is_the_limit_of_a_heavy_bar() {
    for velocity in [0.3, -0.7] {
        let moving = bar(2.0, 1.0, velocity);
        let wall = moving.at_a_wall();
        let heavy = bar(2.0, 1e9, 0.0);
        // The bar behind comes first.
        let (bars, own) = if velocity > 0.0 {
            ([moving, heavy], 0)
        } else {
            ([heavy, moving], 1)
        };
        let impact = BarImpact { bars };
        assert_relative_eq!(wall.stress, impact.stress(), max_relative = 1e-8);
        assert_relative_eq!(
            wall.duration,
            impact.press().expect("they meet").duration,
            max_relative = 1e-12
        );
        assert_relative_eq!(wall.velocity, after(&impact)[own], max_relative = 1e-8);
        let momentum = moving.mass() * (velocity - wall.velocity);
        assert_relative_eq!(
            wall.stress * wall.duration,
            momentum.abs(),
            max_relative = 1e-12
        );
    }
}

/// Characteristics on a grid of `n` elements per transit: exact for waves that take one element per step.
#[test]
fn agrees_with_characteristics() {
    // The last two are of neither family, and the last presses in stages.
    for (lengths, ratio) in [([8, 8], 7.0), ([4, 10], 1.0), ([8, 12], 4.5), ([9, 4], 2.0)] {
        let (v, z) = ([1.0, -0.25], [1.0, ratio]);
        // Waves going right and left: w = v - s/z and u = v + s/z, s the stress, tension positive.
        let mut right = [vec![v[0]; lengths[0]], vec![v[1]; lengths[1]]];
        let mut left = right.clone();
        let (mut impulse, mut moment, mut parted, mut gap) = (0.0, 0.0, 0, 0.0_f64);
        for step in 0..12 * lengths[0].max(lengths[1]) {
            // Waves that arrive at the interface, and what they make there.
            let (w, u) = (right[0][lengths[0] - 1], left[1][0]);
            let mut pressure = z[0] * z[1] / (z[0] + z[1]) * (w - u);
            if gap > 1e-12 || pressure <= 1e-12 {
                pressure = 0.0;
                gap = (gap + u - w).max(0.0);
            } else {
                parted = step + 1;
            }
            impulse += pressure;
            moment += pressure * (step as f64 + 0.5);
            // v is that of the interface, -s the pressure.
            let velocity = [w - pressure / z[0], u + pressure / z[1]];
            let from_free = [left[0][0], right[1][lengths[1] - 1]];
            for bar in 0..2 {
                let n = lengths[bar];
                right[bar].rotate_right(1);
                left[bar].rotate_left(1);
                if bar == 0 {
                    right[bar][0] = from_free[0];
                    left[bar][n - 1] = velocity[0] - pressure / z[0];
                } else {
                    left[bar][n - 1] = from_free[1];
                    right[bar][0] = velocity[1] + pressure / z[1];
                }
            }
        }
        let bar = |i: usize| MovingBar {
            length: lengths[i] as f64,
            modulus: z[i],
            density: z[i],
            velocity: v[i],
        };
        let impact = BarImpact {
            bars: [bar(0), bar(1)],
        };
        let press = impact.press().expect("they meet");
        println!("{lengths:?} {ratio}: {press:?}");
        assert_relative_eq!(press.parted, parted as f64, max_relative = 1e-12);
        assert_relative_eq!(press.duration, 2.0 * moment / impulse, max_relative = 1e-12);
        let [a, b] = after(&impact);
        assert_relative_eq!(a, v[0] - impulse / bar(0).mass(), epsilon = 1e-12);
        assert_relative_eq!(b, v[1] + impulse / bar(1).mass(), epsilon = 1e-12);
    }
}
