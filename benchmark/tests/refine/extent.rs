//! Extents of bodies.

use proctor_benchmark::refine::extent::within;

#[test]
fn an_extent_lies_between_the_middles_of_particles() {
    let masses: Vec<(f64, f64)> = (0..100).map(|k| (f64::from(k), 1.0)).collect();
    assert!((within(masses, 0.995) - 99.0).abs() < 1e-9);
    let two = vec![(1.0, 1.0), (0.0, 1.0)];
    assert!((within(two, 0.5) - 0.5).abs() < 1e-12);
    assert!(within(vec![], 0.5).is_nan());
}
