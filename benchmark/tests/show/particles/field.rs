//! Fields of a frame, by their names.

use proctor_benchmark::frames::Frame;
use proctor_benchmark::show::particles::{ParticleField, usual};

/// Components of the stress in the order of the frames.
const STRESS: [&str; 6] = ["XX", "YY", "ZZ", "YZ", "XZ", "XY"];

fn frame() -> Frame {
    let mut frame = Frame {
        points: vec![[0.0; 3]; 2],
        ..Frame::default()
    };
    let vector = vec![3.0, 4.0, 0.0, 0.0, -1.0, 0.0];
    frame.arrays.insert("Displacement".into(), (3, vector));
    for (i, component) in STRESS.iter().enumerate() {
        let values = vec![if i == 1 { -10.0 } else { 0.0 }, f64::NAN];
        frame
            .arrays
            .insert(format!("Stress_{component}"), (1, values));
    }
    frame
}

#[test]
fn fields_have_names_units_and_ranges() {
    let of = |name: &str| ParticleField::of(&frame(), name).expect("a field");
    assert_eq!(of("displacement").values, [5.0, 1.0]);
    assert_eq!(of("displacement_y").values, [4.0, -1.0]);
    assert_eq!(of("Displacement").label, "Displacement (m)");
    assert_eq!(of("stress_yy").range(), [-10.0, -10.0]);
    assert_eq!(of("mises stress").values[0], 10.0);
    assert_eq!(usual(&frame()).as_deref(), Ok("Displacement"));
    let error = ParticleField::of(&frame(), "strain").unwrap_err();
    assert!(error.contains("Displacement x, Displacement y"), "{error}");
    assert!(error.ends_with("Mises stress"), "{error}");
    assert!(usual(&Frame::default()).is_err());
}
