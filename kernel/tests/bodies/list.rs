//! Particles given one by one.

use crate::bodies::support::Setting;
use proctor_kernel::bodies::HalfLength;
use proctor_scene::{ParticleSeed, Shape};
use std::sync::Arc;

fn list(seeds: &[([f64; 3], f64)]) -> Shape {
    let seeds = seeds
        .iter()
        .map(|&(position, volume)| ParticleSeed { position, volume })
        .collect();
    Shape::Particles(Arc::new(seeds))
}

#[test]
fn a_list_keeps_its_order_and_gets_cubes_of_equal_volume() {
    let setting = Setting::space(1.0, 4, 1).at(-3.5);
    let filled = setting.fill(list(&[
        ([0.25, -1.0, -3.5], 0.027),
        ([-3.0, -3.0, -2.0], 8.0),
    ]));
    assert_eq!(filled.x, [vec![3.75, 0.5], vec![2.5, 0.5], vec![0.0, 1.5]]);
    assert_eq!(filled.volume, [0.027, 8.0]);
    assert_eq!(filled.exact_volume, 8.027);
    let HalfLength::PerParticle(half) = &filled.half_length else {
        panic!("one half-length for all particles")
    };
    for axis in half {
        assert!((axis[0] - 0.15).abs() < 1e-16 && axis[1] == 1.0);
    }
    assert_eq!(filled.half_length.of(1), [1.0; 3]);
}

#[test]
fn in_two_dimensions_the_domain_is_a_square_of_unit_thickness() {
    let setting = Setting::plane(1.0, 4, 1);
    let filled = setting.fill(list(&[([1.0, 2.0, 0.0], 0.25), ([0.5, 0.5, 0.0], 4.0)]));
    assert_eq!(filled.half_length.of(0), [0.25, 0.25, 0.5]);
    assert_eq!(filled.half_length.of(1), [1.0, 1.0, 0.5]);
}
