//! Pressure, slope and energy are derivatives of each other; friction stays in its cone.

use crate::common::cases;
use proctor_contact::geometry::mortar::law::{FLOOR, Friction, NormalLaw};
use proptest::prelude::*;

const KAPPA: f64 = 1500.0;
const GC: f64 = 0.05;

#[test]
fn the_barrier_is_the_printed_one() {
    let law = NormalLaw::barrier(KAPPA, GC);
    // Eq. 48 at half the critical gap: kappa (-g_c/2) (2 ln(1/2) - 2 + 1).
    let by_hand = KAPPA * GC * 0.5 * (2.0 * 2.0_f64.ln() + 1.0);
    assert!((law.pressure(0.5 * GC) - by_hand).abs() < 1e-12 * by_hand);
    // Eq. 47 there.
    let energy = KAPPA * 0.25 * GC * GC * 2.0_f64.ln();
    assert!((law.energy(0.5 * GC) - energy).abs() < 1e-14);
    for gap in [GC, 1.5 * GC, f64::INFINITY] {
        assert_eq!(
            (law.pressure(gap), law.slope(gap), law.energy(gap)),
            (0.0, 0.0, 0.0)
        );
    }
    assert_eq!(law.reach(), GC);
}

/// Without pressure below zero bodies would pass through each other.
#[test]
fn the_barrier_pushes_also_below_the_gap() {
    let law = NormalLaw::barrier(KAPPA, GC);
    let at_floor = law.pressure(FLOOR * GC);
    assert!(law.pressure(0.0) > at_floor);
    assert!(law.pressure(-GC) > law.pressure(0.0));
    assert_eq!(law.slope(-GC), law.slope(FLOOR * GC));
}

#[test]
fn the_gap_of_a_pressure_is_the_smallest_with_no_more() {
    let law = NormalLaw::barrier(KAPPA, GC);
    for gap in [0.01 * GC, 0.2 * GC, 0.9 * GC] {
        assert!((law.gap_at(law.pressure(gap)) - gap).abs() < 1e-12 * GC);
    }
    assert_eq!(law.gap_at(2.0 * law.pressure(0.0)), 0.0);
    assert_eq!(NormalLaw::Penalty { stiffness: KAPPA }.gap_at(1.0), 0.0);
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn pressure_is_the_slope_of_the_energy(share in -1.0..1.2_f64, penalty in any::<bool>()) {
        let law = if penalty { NormalLaw::Penalty { stiffness: KAPPA } } else { NormalLaw::barrier(KAPPA, GC) };
        let (g, step) = (share * GC, 1e-6 * GC);
        let scale = law.pressure(-GC);
        let pressure = (law.energy(g - step) - law.energy(g + step)) / (2.0 * step);
        // Central differences over the kinks of the slope at the floor and at zero: slope times the step.
        let kink = law.slope(g - step).max(KAPPA) * step;
        prop_assert!((law.pressure(g) - pressure).abs() < kink + 1e-8 * scale, "{} {pressure}", law.pressure(g));
        let slope = (law.pressure(g - step) - law.pressure(g + step)) / (2.0 * step);
        let at_a_kink = (share - FLOOR).abs() < 2e-6 || share.abs() < 2e-6;
        if !at_a_kink {
            prop_assert!((law.slope(g) - slope).abs() < 1e-4 * law.slope(g) + 1e-3 * KAPPA, "{} {slope}", law.slope(g));
        }
        prop_assert!(law.pressure(g) >= law.pressure(g + step));
    }

    #[test]
    fn friction_stays_in_its_cone(
        slips in prop::collection::vec(-1.0e-3..1.0e-3_f64, 1..30), pressure in 0.0..100.0_f64, mu in 0.0..1.0_f64,
    ) {
        let law = Friction { coefficient: mu, stiffness: 1.0e5 };
        let mut elastic = 0.0;
        for du in slips {
            let ([traction], [kept]) = law.traction([elastic + du], pressure);
            prop_assert!(traction.abs() <= mu * pressure * (1.0 + 1e-15));
            // What is kept is what the spring carries, and never more than was there.
            prop_assert!((law.stiffness * kept - traction).abs() <= 1e-12 * traction.abs());
            prop_assert!(kept.abs() <= (elastic + du).abs() * (1.0 + 1e-15));
            // Sliding dissipates: traction times plastic slip.
            prop_assert!(traction * (elastic + du - kept) >= -1e-18);
            elastic = kept;
        }
    }
}

/// After sliding one way, the spring unloads at once when the motion turns.
#[test]
fn friction_turns_with_the_motion() {
    let law = Friction {
        coefficient: 0.5,
        stiffness: 1.0e3,
    };
    let (traction, kept) = law.traction([1.0], 10.0);
    assert_eq!((traction, kept), ([5.0], [0.005]));
    let ([back], _) = law.traction([kept[0] - 0.01], 10.0);
    assert!((back + 5.0).abs() < 1e-12);
    let (none, kept) = law.traction([0.1], 0.0);
    assert_eq!((none, kept), ([0.0], [0.0]));
}
