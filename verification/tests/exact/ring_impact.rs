//! The impact of rings: balance of momentum and energy, and figures of another program.

use approx::assert_relative_eq;
use proctor_verification::exact::fe::{Barrier, NeoHookean};
use proctor_verification::exact::ring_impact::{Contact, RingImpact, Sample};
use std::f64::consts::PI;

fn ring() -> RingImpact {
    RingImpact {
        inner: 0.03,
        outer: 0.04,
        distance: 0.01,
        speed: 30.0,
        material: NeoHookean::from_bulk(121.7e6, 26.1e6, 1010.0),
        barrier: Barrier {
            stiffness: 4e7,
            critical_gap: 5e-3,
            floor: 0.05,
        },
    }
}

#[test]
fn published_figures() {
    // An independent program of the same kind: contact from 0.27 to 3.27 ms, impulse 121.4 N s, kinetic energy of
    // both rings 1999 J, smallest 170 J at 1.72 ms, 1730 J at the end.
    let samples = ring().history(4, 1e-5, 400).unwrap();
    let forces: Vec<_> = samples.iter().map(|s| (s.time, s.force)).collect();
    let contact = Contact::of(&forces).unwrap();
    assert_relative_eq!(contact.begin, 0.27e-3, epsilon = 0.02e-3);
    assert_relative_eq!(contact.end, 3.27e-3, epsilon = 0.1e-3);
    assert_relative_eq!(contact.impulse, 121.4, max_relative = 0.01);
    // All of the ring's mass moves at 30 m/s, but for what a polygon lacks of a circle.
    let mass = 1010.0 * PI * (16e-4 - 9e-4);
    assert_relative_eq!(samples[0].kinetic, 0.5 * mass * 900.0, max_relative = 2e-3);
    let smallest = samples
        .iter()
        .map(|s| s.kinetic)
        .fold(f64::INFINITY, f64::min);
    assert_relative_eq!(2.0 * smallest, 170.0, max_relative = 0.1);

    let total = |s: &Sample| s.kinetic + s.strain + s.barrier;
    for sample in &samples {
        assert_relative_eq!(total(sample), total(&samples[0]), max_relative = 1e-3);
    }
}

#[test]
fn nothing_happens_before_the_gap_is_closed_to_the_critical_one() {
    // 15 mm at 60 m/s.
    let samples = ring().history(4, 1e-5, 30).unwrap();
    for sample in samples {
        assert_eq!(sample.force > 0.0, sample.time > 0.2501e-3, "{sample:?}");
    }
}

#[test]
fn contact_of_a_history() {
    let history: Vec<(f64, f64)> = [0.0, 0.0, 1e-4, 1.0, 3.0, 1.0, 0.0]
        .into_iter()
        .enumerate()
        .map(|(k, f)| (k as f64, f))
        .collect();
    let contact = Contact::of(&history).unwrap();
    assert_eq!((contact.begin, contact.end), (3.0, 5.0));
    assert_relative_eq!(contact.impulse, 5.0001, max_relative = 1e-12);
    assert_eq!(Contact::of(&[(0.0, 0.0), (1.0, 0.0)]), None);
}
