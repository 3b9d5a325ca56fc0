//! The state at the start is the one that was given.

use crate::common::{APIC, DIMENSIONS, FLIP, NEO_HOOKEAN, block, material, simulation_from};
use proctor_scene::simulation::InitialState;
use proctor_scene::{Dimension, Vector};
use std::sync::Arc;

/// A field in which no component is another one; out of the plane it is zero in two dimensions, but for the stress.
fn given(dimension: Dimension, x: &Vector) -> InitialState {
    let flat = dimension == Dimension::Two;
    let mut next = 0.0;
    let mut number = |zero: bool| {
        next += 1.0;
        if zero { 0.0 } else { next + x[0] - 2.0 * x[1] }
    };
    let velocity = [0, 1, 2].map(|axis| number(flat && axis == 2));
    let velocity_gradient = [0, 1, 2].map(|a| [0, 1, 2].map(|b| number(flat && a.max(b) == 2)));
    let stress = [0, 1, 2, 3, 4, 5].map(|i| number(flat && (i == 3 || i == 4)));
    let deformation = [0, 1, 2].map(|a| {
        [0, 1, 2].map(|b| {
            let share = 0.01 * number(flat && a.max(b) == 2);
            if a == b { 1.0 + share } else { share }
        })
    });
    InitialState {
        velocity,
        velocity_gradient,
        stress,
        deformation,
    }
}

#[test]
fn particles_hold_the_initial_field() {
    for dimension in DIMENSIONS {
        let axes = dimension.axes();
        for transfer in [FLIP, APIC] {
            let mut scene = block(dimension);
            scene.transfer = transfer;
            scene.materials = vec![material(NEO_HOOKEAN)];
            let field = Arc::new(move |x: &Vector| given(dimension, x));
            let simulation = simulation_from(&scene, field);
            let set = &simulation.sets()[0];
            for p in 0..set.len() {
                let exact = given(dimension, &simulation.position(0, p));
                assert_eq!(set.velocity(p), exact.velocity);
                assert_eq!(set.stress(p), exact.stress);
                assert_eq!(simulation.deformation(0, p), Some(exact.deformation));
                let Some(first) = set.layout.affine else {
                    assert_eq!(transfer, FLIP);
                    continue;
                };
                for a in 0..axes {
                    for b in 0..axes {
                        let found = set.columns[first + a * axes + b][p];
                        assert_eq!(found, exact.velocity_gradient[a][b], "{a}{b}");
                    }
                }
            }
        }
    }
}
