//! A condition of one's own: a viscous layer, in which a block slows down as exp(-c t), while one above it glides on.
//!
//!     cargo run --release --package proctor-kernel --example own_condition

use proctor_scene::prelude::*;
use std::error::Error;

const SPEED: f64 = 1.0;
const RATE: f64 = 2.0;
const TOP: f64 = 0.4;

/// Whatever lies below `top` \[m\] loses speed at a rate \[1/s\].
struct ViscousLayer {
    rate: f64,
    top: f64,
}

impl Condition for ViscousLayer {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        // Exact for any step: what is left of the velocity after the time over which it changes.
        let left = (-self.rate * field.kick()).exp();
        field.for_each(|node| {
            if node.position()[1] < self.top {
                node.set_velocity(node.velocity().map(|v| v * left));
            }
        });
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::plane([20, 16], 0.05).with_end(0.2);
    let rubber = scene.add_material(LinearElastic::new(1e6, 0.3), 1000.0);
    let blocks = [0.1, 0.5].map(|y| {
        let block = Shape::rectangle([0.1, y], [0.3, y + 0.2]);
        let body = scene.add_body(block, rubber);
        body.with_velocity([SPEED, 0.0]).handle()
    });

    let layer = ViscousLayer {
        rate: RATE,
        top: TOP,
    };
    let mut simulation = scene.simulate(&Options::default().with_condition(layer))?;
    simulation.run_until(scene.time)?;

    let [slowed, free] = blocks.map(|body| simulation.center(body).velocity[0]);
    let exact = SPEED * (-RATE * simulation.velocity_time()).exp();
    println!("in the layer {slowed:.6} m/s, exactly {exact:.6} m/s; above it {free:.6} m/s");
    assert!((slowed - exact).abs() < 1e-12, "{slowed} and {exact} m/s");
    assert!((free - SPEED).abs() < 1e-12, "{free} m/s");
    Ok(())
}

#[test]
fn runs() -> Result<(), Box<dyn Error>> {
    main()
}
