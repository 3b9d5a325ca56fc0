//! A block that is pressed between two surfaces, wherever they lie against the mesh.

use proctor_contact::geometry::surface::Surface;
use proctor_laws::LinearElastic;
use proctor_scene::simulation::Options;
use proctor_scene::{
    Damping, DomainUpdate, History, ParticleSeed, PlaneCondition, RigidSurface, Scene, Shape,
    StressScheme, Vector, Weighting,
};
use std::sync::Arc;

/// Young's modulus \[Pa\], Poisson's ratio and density \[kg/m³\]; cells of 1 m.
const YOUNG: f64 = 1e4;
const POISSON: f64 = 0.2;
const DENSITY: f64 = 1.0;
/// Height of the block \[m\], distance of its particles, and by how much of its height it is pressed.
const HEIGHT: f64 = 4.0;
const STEP: f64 = 0.5;
const STRAIN: f64 = 1e-3;

/// A square of the plane at a height, as two triangles, that looks up or down.
fn surface(name: &str, height: f64, up: bool, motion: Option<History>) -> RigidSurface {
    let at = |x: f64, y: f64| [x, y, height];
    let mut corners = [
        [at(-9.0, -8.0), at(9.0, -8.0), at(9.0, 8.0)],
        [at(-9.0, -8.0), at(9.0, 8.0), at(-9.0, 8.0)],
    ];
    if !up {
        for triangle in &mut corners {
            triangle.swap(1, 2);
        }
    }
    RigidSurface {
        name: name.to_owned(),
        surface: Arc::new(Surface::new(&corners).expect("a surface")),
        friction: 0.0,
        distance_threshold: 1.0,
        penalty_stiffness: None,
        motion,
    }
}

/// Vertical stress over that of a block without width that is strained as much, of each layer of particles from below.
fn pressed(scheme: StressScheme, weighting: Weighting, bottom: f64) -> Vec<f64> {
    let mut scene = Scene::space([1, 1, 9], 1.0).with_planes(PlaneCondition::Sliding);
    scene.scheme = scheme;
    scene.weighting = weighting;
    scene.damping = Damping::Local { alpha: 0.5 };
    scene.time = 2.0;
    let material = scene.add_material(LinearElastic::new(YOUNG, POISSON), DENSITY);
    let layers = (HEIGHT / STEP).round() as usize;
    let place = |k: usize| bottom + (k as f64 + 0.5) * STEP;
    let mut seeds = vec![];
    for k in 0..layers {
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let side = |i: usize| (i as f64 + 0.5) * STEP;
            seeds.push(ParticleSeed {
                position: [side(i), side(j), place(k)],
                volume: STEP.powi(3),
            });
        }
    }
    scene.add_body(Shape::Particles(seeds.into()), material);
    // Pressed in a tenth of the time, then held.
    let speed = -STRAIN * HEIGHT / (0.1 * scene.time);
    let motion = History {
        times: vec![
            0.0,
            0.1 * scene.time,
            0.1 * scene.time * 1.000_001,
            scene.time,
        ],
        values: vec![[0.0, 0.0, speed], [0.0, 0.0, speed], [0.0; 3], [0.0; 3]],
    };
    scene.surfaces = vec![
        surface("below", bottom, true, None),
        surface("above", bottom + HEIGHT, false, Some(motion)),
    ];
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = scene.simulate(&options).expect("sound");
    simulation.run_until(scene.time).expect("a step");
    let modulus = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    let of_layer = |k: usize| {
        let here = |p: &usize| {
            let x: Vector = simulation.position(0, *p);
            (x[2] - place(k)).abs() < 0.4 * STEP
        };
        let found: Vec<usize> = (0..simulation.particles()).filter(here).collect();
        let sum: f64 = found
            .iter()
            .map(|p| simulation.sets()[0].stress(*p)[2])
            .sum();
        sum / found.len() as f64 / (-modulus * STRAIN)
    };
    (0..layers).map(of_layer).collect()
}

/// The stress of all particles is that of the block, also of those on the surfaces: what a surface gives to the nodes is what
/// the stress of the layer on it gives to them. With linear functions a row of particles does not end anywhere: the stress
/// of a cell depends on how many of them are in it.
#[test]
fn the_layer_on_a_surface_has_the_stress_of_the_block() {
    let weightings = [
        Weighting::UniformGimp,
        Weighting::ContiguousGimp(DomainUpdate::Stretch),
        Weighting::QuadraticBSpline,
    ];
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        for weighting in weightings {
            for bottom in [2.0, 2.13, 2.35] {
                let found = pressed(scheme, weighting, bottom);
                println!("{scheme:?} {weighting:?} {bottom}: {found:.3?}");
                let off = found.iter().map(|s| (s - 1.0).abs()).fold(0.0, f64::max);
                assert!(off < 0.05, "{scheme:?} {weighting:?} {bottom}: {found:.3?}");
            }
        }
    }
}

/// With USF a block that is held for long loses some of its stress, all layers the same share.
#[test]
fn with_usf_the_layers_have_one_stress() {
    for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
        for bottom in [2.0, 2.13, 2.35] {
            let found = pressed(StressScheme::Usf, weighting, bottom);
            println!("{weighting:?} {bottom}: {found:.3?}");
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            assert!(mean > 0.85, "{found:.3?}");
            let off = found
                .iter()
                .map(|s| (s / mean - 1.0).abs())
                .fold(0.0, f64::max);
            assert!(off < 0.05, "{weighting:?} {bottom}: {found:.3?}");
        }
    }
}
