//! A column of Hencky's law under its own weight.

use crate::common::{APIC, body, cuboid, empty, material, options};
use proctor_laws::Hencky;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Damping, Dimension, DomainUpdate, PlaneCondition, Weighting};

/// Lambert's w e^w = x for x >= 0, by Newton's method.
fn lambert(x: f64) -> f64 {
    let mut w = x.ln_1p();
    for _ in 0..50 {
        let e = w.exp();
        w -= (w * e - x) / (e * (1.0 + w));
    }
    w
}

/// P = E ln(l)/l = -rho g (H - Y) for a Poisson's ratio of 0: l = exp(-W(S (1 - Y/H))) with S = rho g H/E, and the height over
/// that of the start is (w + w²/2)/S with w = W(S).
#[test]
fn a_column_settles_to_its_height() {
    const CELLS: usize = 20;
    const CELL: f64 = 1.0 / CELLS as f64;
    let (young, density, gravity) = (3e4, 1200.0, 10.0);
    let load = density * gravity / young;
    let mut scene = empty(Dimension::Two, [1, CELLS + 1, 1], CELL);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity = [0.0, -gravity, 0.0];
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    scene.transfer = APIC;
    scene.damping = Damping::Local { alpha: 0.3 };
    let mut column = body(1, cuboid([0.0; 3], [CELL, 1.0, 0.0]));
    column.particles_per_cell[2] = 1;
    scene.bodies = vec![column];
    let mut soft = material(Hencky::new(young, 0.0));
    soft.density = density;
    scene.materials = vec![soft];
    let options = Options {
        displacement: true,
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("it is sound");
    simulation.run_until(12.0).expect("a step");
    assert!(simulation.kinetic_energy() < 1e-6 * density * gravity * CELL);
    let way = |w: f64| (w + 0.5 * w * w) / load;
    let whole = way(lambert(load));
    let sunk = 1.0 - whole;
    assert!(sunk > 0.14);
    let set = &simulation.sets()[0];
    for p in 0..set.len() {
        let y = set.position(p)[1];
        let start = y - simulation.displacement(0, p).expect("asked for")[1];
        let exact = whole - way(lambert(load * (1.0 - start)));
        assert!((y - exact).abs() < 0.01 * sunk, "{start}: {y} {exact}");
    }
}
