//! Rings of particles, of which a wedge is cut out.

use proctor_benchmark::frames::Frame;
use proctor_benchmark::show::particles::{View, revolved};

/// A cylinder of radius 1 and height 0.5, particles 0.05 apart, with the number of each as a field.
fn cylinder() -> Frame {
    let mut frame = Frame::default();
    for i in 0..20 {
        for j in 0..10 {
            let at = |k: i32| 0.025 + 0.05 * f64::from(k);
            frame.points.push([at(i), at(j), 0.0]);
        }
    }
    let numbers = (0..frame.points.len()).map(|p| p as f64).collect();
    frame.arrays.insert("Id".to_owned(), (1, numbers));
    frame
}

#[test]
fn rings_keep_radius_height_and_values() {
    let flat = cylinder();
    for degrees in [90.0, 270.0, 360.0] {
        let turned = revolved(&flat, 0.05, degrees);
        let (width, numbers) = &turned.arrays["Id"];
        assert_eq!((*width, numbers.len()), (1, turned.points.len()));
        for (point, number) in turned.points.iter().zip(numbers) {
            let [radius, height, _] = flat.points[*number as usize];
            assert!((point[0].hypot(point[1]) - radius).abs() < 1e-12);
            assert_eq!(point[2], height);
        }
    }
}

/// The wedge lies towards who looks; both its sides show all particles, and nothing inside is drawn.
#[test]
fn a_wedge_is_open_and_its_sides_are_whole() {
    let flat = cylinder();
    let turned = revolved(&flat, 0.05, 270.0);
    let azimuth = |point: &[f64; 3]| {
        let angle = point[1].atan2(point[0]).to_degrees() - View::default().azimuth;
        (angle + 540.0).rem_euclid(360.0) - 180.0
    };
    let on_cut = |point: &[f64; 3], side: f64| (azimuth(point) - side).abs() < 1e-6;
    for point in &turned.points {
        assert!(azimuth(point).abs() > 45.0 - 1e-6, "{point:?}");
    }
    for side in [-45.0, 45.0] {
        let count = turned.points.iter().filter(|p| on_cut(p, side)).count();
        assert_eq!(count, flat.points.len());
    }
    let inside = turned.points.iter().filter(|p| {
        let (radius, height) = (p[0].hypot(p[1]), p[2]);
        let deep = radius < 0.8 && (0.2..0.3).contains(&height);
        deep && !on_cut(p, 45.0) && !on_cut(p, -45.0)
    });
    assert_eq!(inside.count(), 0);
    let whole = revolved(&flat, 0.05, 360.0);
    assert!(whole.points.iter().any(|p| azimuth(p).abs() < 5.0));
}
