//! The indenter in the block.

use super::{failing, quick};
use proctor_files::json::read;
use proctor_verification::case::{Quantity, Rung, RungResult, Size};
use proctor_verification::cases::IRONING;
use proctor_verification::sensitivity::{Reaction, reactions};
use std::path::Path;

/// Figures of the whole ladder: the figures themselves, and no error.
fn figures() -> Vec<(Rung, RungResult)> {
    let of = |rung: &Rung| -> [f64; 3] {
        let figures = if rung.variant.contains("friction") {
            [479.0, 525.0, -82.0]
        } else {
            [473.0, 529.0, -20.0]
        };
        let stiffness = if rung.variant.contains("kPa") {
            1e3
        } else {
            1.0
        };
        figures.map(|f| f * stiffness)
    };
    let quantity = |name, value| Quantity {
        name,
        value,
        exact: Some(value),
        error: Some(0.0),
        unit: "1",
    };
    let ripple = Quantity {
        exact: Some(0.0),
        error: None,
        ..quantity("ripple of the force about its trend", 0.0025)
    };
    let run = |rung: Rung| {
        let [pressed, down, along] = of(&rung);
        let mut quantities = vec![
            quantity("force at 60 s", pressed),
            quantity("mean force from 120 to 180 s", down),
            quantity("mean horizontal force from 120 to 180 s", along),
            quantity(
                "horizontal over vertical force from 120 to 180 s",
                along / down,
            ),
            ripple.clone(),
            quantity("L2 of the force while it goes down", 0.0),
        ];
        if rung.variant.starts_with("600 Pa") {
            let leftward = if rung.variant.contains("friction") {
                50.0
            } else {
                60.0
            };
            quantities.push(quantity(
                "largest leftward force on the block on the way out",
                leftward,
            ));
            quantities.push(Quantity {
                exact: Some(0.0),
                error: None,
                ..quantity("force beyond the block over that from 120 to 180 s", 0.0)
            });
        }
        let solved = RungResult {
            particles: 1,
            steps: 1,
            time: 180.0,
            quantities,
            drawings: vec![],
            curve: None,
        };
        (rung, solved)
    };
    let rungs = IRONING.rungs(Size::Full).into_iter();
    rungs.map(run).collect()
}

/// Gates that fail where the run of one variant gave what that of another should.
fn mistaken(solved: &[(Rung, RungResult)], size: Size, variant: &str, other: &str) -> Vec<String> {
    let of = |variant: &str| {
        let found = solved.iter().position(|(r, _)| r.variant == variant);
        found.expect("it is run")
    };
    let mut mixed = solved.to_vec();
    let from = &solved[of(other)].1;
    for q in &mut mixed[of(variant)].1.quantities {
        q.value = from.value(q.name);
        q.error = q.exact.map(|exact| (q.value / exact - 1.0).abs());
    }
    failing(&IRONING.judge(size, &mixed))
}

#[test]
fn friction_is_told_from_none() {
    let quick = quick(&IRONING);
    let (with, without) = ("600 Pa, friction", "600 Pa");
    for (variant, other) in [(with, without), (without, with)] {
        let failing = mistaken(quick, Size::Quick, variant, other);
        assert_eq!(failing.len(), 1, "{failing:?}");
        assert!(failing[0].contains("increase by friction of the force at 60 s"));
    }
    let full = figures();
    assert!(IRONING.judge(Size::Full, &full).passed());
    for stiff in ["600 Pa", "600 kPa"] {
        let with = format!("{stiff}, friction");
        for (variant, other) in [(with.as_str(), stiff), (stiff, with.as_str())] {
            let failing = mistaken(&full, Size::Full, variant, other);
            for name in [
                "error of the mean horizontal force",
                "error of horizontal over vertical force",
            ] {
                let own = format!("{variant} h=0.2: {name}");
                assert!(
                    failing.iter().any(|line| line.starts_with(&own)),
                    "{failing:?}"
                );
            }
            let added = failing
                .iter()
                .filter(|line| line.contains("increase by friction"));
            assert_eq!(added.count(), 3, "{failing:?}");
        }
    }
}

#[test]
fn every_gate_of_the_whole_ladder_reacts() {
    let full = figures();
    for Reaction { gate, to } in reactions(&IRONING, Size::Full, &full) {
        assert!(!to.is_empty(), "nothing makes it fail: {}", gate.name);
        assert!(
            to.iter().all(|n| gate.name.contains(n.quantity)),
            "{gate:?}"
        );
    }
}

#[test]
fn the_scene_file_is_the_case_with_friction() {
    let file = Path::new("../fixtures/scenes/ironing_2d.json");
    let given = read(file).unwrap_or_else(|e| panic!("{e}"));
    let rungs = IRONING.rungs(Size::Full);
    let rung = rungs.iter().find(|r| r.variant == "600 Pa, friction");
    let meant = IRONING.scene_of(rung.expect("a rung")).expect("a scene");
    let said = |scene: &proctor_scene::Scene| {
        let contact = &scene.mortar.contacts[0];
        format!(
            "{} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
            scene.time,
            scene.mesh,
            scene.weighting,
            scene.scheme,
            scene.transfer,
            scene.damping,
            scene.time_step,
            scene.bodies,
            scene.mortar.boundaries,
            (contact.master, contact.slave, contact.friction),
            (
                contact.critical_gap,
                contact.normal_stiffness,
                contact.tangential_stiffness
            ),
        )
    };
    assert_eq!(said(&given), said(&meant));
    let [given, meant] = [&given, &meant].map(|scene| &scene.mortar.lines[0]);
    let [points, exact] = [given, meant].map(|line| &line.chains[0].points);
    assert_eq!(points.len(), exact.len());
    for (a, b) in points.iter().zip(exact) {
        assert!((a - b).norm() < 1e-8, "{a} {b}");
    }
    let [motion, exact] = [given, meant].map(|line| line.motion.as_ref().expect("moves"));
    assert_eq!(motion.times, exact.times);
    for (a, b) in motion.values.iter().zip(&exact.values) {
        for axis in 0..3 {
            assert!((a[axis] - b[axis]).abs() < 1e-8, "{a:?} {b:?}");
        }
    }
}
