//! The free fall that a solver runs first: what is found in its frames.

use proctor_benchmark::bench::children::{Fault, Finding, free_fall, judge};
use proctor_benchmark::bench::config::TimeLabel;
use proctor_benchmark::frames::Frame;
use proctor_files::json::from_json;
use std::path::Path;

/// Step and end of the free fall \[s\].
const STEP: f64 = 0.001;
const END: f64 = 0.04;

/// Particles of the free fall that moved by `u` (m), in lengths of `metre`.
fn frame(u: [f64; 3], metre: f64) -> Frame {
    let mut frame = Frame::default();
    let mut flat = vec![];
    for n in 0..216 {
        let place = [n % 6, n / 6 % 6, n / 36].map(|i| 0.325 + 0.05 * f64::from(i));
        frame
            .points
            .push(std::array::from_fn(|axis| metre * (place[axis] + u[axis])));
        flat.extend(u.map(|u| metre * u));
    }
    frame.arrays.insert("Displacement".into(), (3, flat));
    frame
}

/// Displacement at a time \[s\].
fn exact(t: f64) -> [f64; 3] {
    [t, 0.0, -0.5 * 9.81 * t * t]
}

fn found(frame: &Frame, label: Option<f64>, declared: TimeLabel) -> Vec<Finding> {
    match judge(frame, label, declared, 3) {
        Ok(_) => vec![],
        Err(Fault::Found(findings)) => findings,
        Err(Fault::Run(reason)) => panic!("{reason}"),
    }
}

#[test]
fn the_free_fall_is_a_sound_scene() {
    for axes in [2, 3] {
        let text = free_fall(axes).to_string();
        let scene = from_json(&text, "free_fall", Path::new("")).expect("sound");
        assert_eq!(scene.dimension.axes(), axes);
        assert!((scene.time - END).abs() < 1e-15);
    }
}

#[test]
fn a_label_is_held_against_the_way_of_the_particles() {
    let ahead = frame(exact(END + STEP), 1.0);
    for (declared, fits) in [
        (TimeLabel::Frame, false),
        (TimeLabel::OneStepLate, true),
        (TimeLabel::OneStepEarly, false),
    ] {
        let findings = found(&ahead, Some(END), declared);
        assert_eq!(findings.is_empty(), fits, "{findings:?}");
        for finding in findings {
            assert_eq!(finding.fitting(), Some(TimeLabel::OneStepLate));
            assert!(finding.to_string().contains("1 step ahead of"), "{finding}");
        }
    }
    // Frames without a label are of the end.
    assert!(found(&frame(exact(END), 1.0), None, TimeLabel::Frame).is_empty());
    let far = found(&ahead, Some(END - 4.0 * STEP), TimeLabel::Frame);
    assert_eq!(far[0].fitting(), None, "{far:?}");
    assert!(far[0].to_string().contains("no `time_label` fits"));
}

#[test]
fn a_cycle_that_kicks_before_it_moves_is_no_other_gravity() {
    let mut u = exact(END);
    u[2] = -0.5 * 9.81 * END * (END + STEP);
    assert!(found(&frame(u, 1.0), Some(END), TimeLabel::Frame).is_empty());
    // It is named, since it costs an order.
    let hint = |u: [f64; 3]| {
        judge(&frame(u, 1.0), Some(END), TimeLabel::Frame, 3).map(|sound| sound.hint())
    };
    assert!(matches!(hint(u), Ok(Some(words)) if words.contains("first order in time")));
    assert!(matches!(hint(exact(END)), Ok(None)));
    u[2] *= 1.1;
    let findings = found(&frame(u, 1.0), Some(END), TimeLabel::Frame);
    assert!(
        matches!(findings[..], [Finding::Gravity { .. }]),
        "{findings:?}"
    );
}

#[test]
fn units_are_told_from_times_and_from_particles() {
    let millimetres = frame(exact(END), 1000.0);
    let findings = found(&millimetres, Some(END), TimeLabel::Frame);
    assert!(
        matches!(findings[..], [Finding::Length { factor }] if (factor - 1e3).abs() < 1e-6),
        "{findings:?}"
    );
    let findings = found(
        &frame(exact(END), 1.0),
        Some(1000.0 * END),
        TimeLabel::Frame,
    );
    assert!(
        matches!(findings[..], [Finding::Clock { factor }] if (factor - 1e3).abs() < 1e-6),
        "{findings:?}"
    );
    // Gauss points are no other unit, and nothing else is wrong with them.
    let mut gauss = frame(exact(END), 1.0);
    let moved = exact(END);
    for x in &mut gauss.points {
        *x = std::array::from_fn(|axis| 1.031 * (x[axis] - moved[axis]) + moved[axis]);
    }
    let findings = found(&gauss, Some(END), TimeLabel::Frame);
    assert!(
        matches!(findings[..], [Finding::Places { .. }]),
        "{findings:?}"
    );
    assert!(
        findings[0]
            .to_string()
            .contains("as those at Gauss points do")
    );
    // Displacements alone in millimetres: the factor is a unit, and no other time.
    let mut mixed = frame(exact(END), 1.0);
    let (_, values) = mixed.arrays.get_mut("Displacement").expect("displacements");
    for u in values.iter_mut() {
        *u *= 1000.0;
    }
    let findings = found(&mixed, Some(END), TimeLabel::Frame);
    assert_eq!(findings, [Finding::Displacement { factor: 1000.0 }]);
    assert!(
        findings[0]
            .to_string()
            .contains("1000 times those of the scene"),
        "{}",
        findings[0]
    );
    let mut fewer = frame(exact(END), 1.0);
    fewer.points.pop();
    fewer
        .arrays
        .values_mut()
        .for_each(|(_, values)| values.truncate(3 * 215));
    let findings = found(&fewer, Some(END), TimeLabel::Frame);
    let wanted = Finding::Particles {
        found: 215,
        expected: 216,
    };
    assert_eq!(findings, [wanted]);
}

#[test]
fn what_is_not_finite_is_found() {
    let findings = found(&frame([f64::NAN; 3], 1.0), Some(END), TimeLabel::Frame);
    assert!(!findings.is_empty());
    let findings = found(&frame(exact(END), 1.0), Some(f64::NAN), TimeLabel::Frame);
    assert!(!findings.is_empty());
    assert!(judge(&Frame::default(), None, TimeLabel::Frame, 3).is_err());
}

#[test]
fn the_time_of_the_velocities_is_measured() {
    let mut frame = frame(exact(END), 1.0);
    let v = [1.0, 0.0, -9.81 * (END - 0.5 * STEP)];
    frame
        .arrays
        .insert("Velocity".into(), (3, v.repeat(frame.points.len())));
    let calibration = judge(&frame, Some(END), TimeLabel::Frame, 3).expect("sound");
    let ahead = calibration.velocity_ahead.expect("velocities");
    assert!((ahead + 0.5).abs() < 1e-9, "{ahead}");
}
