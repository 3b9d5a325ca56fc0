//! A scene without any file: a column settles under its own weight, and its stress is that of what lies above.
//!
//!     cargo run --release --package proctor-kernel --example without_json

use proctor_scene::prelude::*;
use std::error::Error;

const HEIGHT: f64 = 1.0;
const GRAVITY: f64 = 10.0;
const DENSITY: f64 = 2000.0;

fn main() -> Result<(), Box<dyn Error>> {
    // The planes of the mesh slide: the column stands between them, on the lower one.
    let mut scene = Scene::plane([2, 14], 0.1)
        .with_gravity([0.0, -GRAVITY])
        .with_damping(Damping::Local { alpha: 0.5 })
        .with_end(2.0);
    let soil = scene.add_material(LinearElastic::new(1e7, 0.3), DENSITY);
    let rectangle = Shape::rectangle([0.0, 0.0], [0.2, HEIGHT]);
    let column = scene.add_body(rectangle, soil).handle();

    let mut simulation = scene.simulate(&Options::default())?;
    simulation.run_until(scene.time)?;

    let particles = simulation.particles_of(column);
    let mut farthest = 0.0_f64;
    for p in 0..particles.len() {
        let above = HEIGHT - simulation.position(column, p)[1];
        let exact = -DENSITY * GRAVITY * above;
        farthest = farthest.max((particles.stress(p)[1] - exact).abs());
    }
    // Stress is constant over a particle, so that the weight of one layer of them is what it can be off by.
    let layer = DENSITY * GRAVITY * 0.05;
    println!("stress at most {farthest:.0} Pa off; a layer of particles weighs {layer:.0} Pa");
    assert!(farthest < layer, "{farthest} Pa");
    Ok(())
}

#[test]
fn runs() -> Result<(), Box<dyn Error>> {
    main()
}
