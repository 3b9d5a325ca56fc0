//! Pictures of particles.

mod field;
mod palette;
mod revolve;
mod view;

use proctor_benchmark::frames::Frame;
use proctor_benchmark::show::drawing::Item;
use proctor_benchmark::show::particles::{
    ParticleField, ParticlePicture, View, bounds, is_flat, spacing,
};

fn block(axes: usize) -> Frame {
    let n = 6;
    let mut frame = Frame::default();
    for i in 0..n {
        for j in 0..n {
            for k in 0..if axes == 3 { n } else { 1 } {
                let z = if axes == 3 {
                    0.05 + 0.1 * f64::from(k)
                } else {
                    0.0
                };
                frame
                    .points
                    .push([0.05 + 0.1 * f64::from(i), 0.05 + 0.1 * f64::from(j), z]);
            }
        }
    }
    let values: Vec<f64> = frame.points.iter().map(|point| point[0]).collect();
    frame.arrays.insert("Mass".to_owned(), (1, values));
    frame
}

#[test]
fn a_block_is_drawn_in_both_dimensions() {
    for axes in [2, 3] {
        let frame = block(axes);
        assert!((spacing(&frame) - 0.1).abs() < 1e-12);
        assert_eq!(is_flat(&frame), axes == 2);
        let [low, high] = bounds(&frame, 0.1);
        assert!(low[0].abs() < 1e-12 && (high[1] - 0.6).abs() < 1e-12);
        let field = ParticleField::of(&frame, "mass").expect("a field");
        let picture = ParticlePicture {
            frame: &frame,
            field: &field,
            range: field.range(),
            bounds: [low, high],
            spacing: 0.1,
            view: View::default(),
            mesh: None,
            title: "block",
            caption: "t = 1 s",
        };
        let drawing = picture.drawing();
        let texts: Vec<&str> = (drawing.before.iter().chain(&drawing.behind))
            .filter_map(|item| match item {
                Item::Text { text, .. } => Some(text.as_str()),
                _ => None,
            })
            .collect();
        for wanted in ["block", "t = 1 s", "x (m)", "y (m)", "Mass (kg)"] {
            assert!(texts.contains(&wanted), "{wanted} of {texts:?}");
        }
        assert_eq!(texts.contains(&"z (m)"), axes == 3);
    }
}

#[test]
fn nothing_and_one_particle_are_drawn() {
    for count in [0, 1] {
        let frame = Frame {
            points: vec![[1.0, 2.0, 0.0]; count],
            ..Frame::default()
        };
        let field = ParticleField {
            label: "one".to_owned(),
            values: vec![f64::NAN; count],
        };
        let picture = ParticlePicture {
            frame: &frame,
            field: &field,
            range: field.range(),
            bounds: bounds(&frame, spacing(&frame)),
            spacing: spacing(&frame),
            view: View::default(),
            mesh: None,
            title: "",
            caption: "",
        };
        let [width, height] = picture.drawing().size;
        assert!(width > 300 && height > 100);
    }
}
