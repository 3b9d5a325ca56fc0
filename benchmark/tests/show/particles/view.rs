//! Views of particles.

use proctor_benchmark::show::particles::View;

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn directions_are_at_right_angles_and_z_is_up() {
    let view = View::default().projection();
    // The directions, as the places of the unit vectors.
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let right = axes.map(|axis| view.place(&axis)[0]);
    let up = axes.map(|axis| view.place(&axis)[1]);
    let near = axes.map(|axis| view.nearness(&axis));
    for (a, b) in [(right, up), (up, near), (near, right)] {
        assert!(dot(&a, &b).abs() < 1e-15);
        assert!((dot(&a, &a) - 1.0).abs() < 1e-15);
    }
    assert!(view.place(&[0.0, 0.0, 1.0])[1] > 0.8);
    // From the side of negative y, what lies there is nearer.
    assert!(view.nearness(&[0.0, -1.0, 0.0]) > view.nearness(&[0.0, 1.0, 0.0]));
}

#[test]
fn views_are_two_angles() {
    let found = View::parse("30, -10").expect("a view");
    assert_eq!((found.azimuth, found.elevation), (30.0, -10.0));
    for wrong in ["30", "30,100", "a,b", "1,2,3", ""] {
        assert!(View::parse(wrong).is_err(), "{wrong}");
    }
}
