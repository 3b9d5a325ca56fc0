//! Built-in scenes: sound, of the wanted size, and they stay sound to their end.

use proctor_benchmark::bench::config::{Method, SceneChoice};
use proctor_benchmark::bench::scenes::{find, names};
use proctor_scene::simulation::{Options, Simulation};

fn run(name: &str, particles: usize) -> Simulation {
    let (scene, axes) = find(name).expect("a built-in scene");
    let scene = SceneChoice::BuiltIn(scene, axes)
        .scene(particles, &Method::default())
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let options = Options {
        threads: Some(1),
        displacement: true,
        ..Options::default()
    };
    let mut simulation =
        Simulation::new(&scene, &options).unwrap_or_else(|e| panic!("{name}: {e}"));
    while simulation.time() < scene.time * (1.0 - 1e-9) {
        simulation
            .step(scene.time)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
    }
    simulation
}

#[test]
fn each_has_about_the_wanted_number_of_particles_and_stays_sound() {
    for name in names() {
        for wanted in [300, 3000] {
            let wanted = if name.starts_with("tiny") {
                1000
            } else {
                wanted
            };
            let particles = run(&name, wanted).particles();
            let ratio = particles as f64 / wanted as f64;
            assert!(
                (0.8..1.25).contains(&ratio),
                "{name}: {particles} of {wanted}"
            );
        }
    }
}

#[test]
fn the_sparse_mesh_is_64_times_too_large() {
    let nodes = |name| {
        let scene = run(name, 300).scene().clone();
        scene.mesh.cells.iter().product::<usize>()
    };
    for (sparse, moving) in [("sparse-2d", "moving-2d"), ("sparse-3d", "moving-3d")] {
        assert_eq!(nodes(sparse), 64 * nodes(moving));
    }
}

/// Largest error of the displacement over the largest displacement.
fn error(name: &str, particles: usize) -> f64 {
    let (scene, axes) = find(name).expect("a built-in scene");
    let (_, exact) = scene
        .make(axes, particles)
        .exact
        .expect("an exact solution");
    let simulation = run(name, particles);
    let (mut wrong, mut right) = (0.0_f64, 0.0_f64);
    for p in 0..simulation.particles() {
        let u = simulation.displacement(0, p).expect("kept");
        let x = simulation.initial_position(0, p).expect("kept");
        let truth = exact(&x, simulation.time());
        for axis in 0..3 {
            wrong = wrong.max((u[axis] - truth[axis]).abs());
            right = right.max(truth[axis].abs());
        }
    }
    wrong / right
}

#[test]
fn the_exact_solutions_are_those_of_the_scenes() {
    assert!(error("moving-2d", 400) < 1e-12);
    assert!(error("moving-3d", 1000) < 1e-12);
    // Second order in space and time but for the kink of the wave.
    let (coarse, fine) = (error("column-2d", 256), error("column-2d", 4096));
    assert!(fine < 0.01 && fine < 0.5 * coarse, "{coarse} {fine}");
}

#[test]
fn the_moving_block_crosses_cells() {
    let simulation = run("moving-3d", 1000);
    let u = simulation.displacement(0, 0).expect("kept");
    assert!(u[0] > 3.0 * simulation.scene().mesh.cell[0]);
}

/// The blocks touch from the start, each in a field of its own, and friction brakes the upper ones and pulls the lower.
#[test]
fn the_blocks_in_contact_rub() {
    for (name, fields) in [
        ("contact-2d", 2),
        ("contact-3d", 2),
        ("mixed-2d", 3),
        ("mixed-3d", 3),
    ] {
        let simulation = run(name, 1000);
        assert_eq!(simulation.contact_layers(), fields, "{name}");
        let up = simulation.scene().dimension.axes() - 1;
        let forces: Vec<_> = (0..fields)
            .map(|set| simulation.contact_force(set))
            .collect();
        assert!(
            forces[0][up] < 0.0 && forces[0][0] > 0.0,
            "{name}: {forces:?}"
        );
        for axis in 0..3 {
            let sum: f64 = forces.iter().map(|force| force[axis]).sum();
            assert!(sum.abs() <= -1e-12 * forces[0][up], "{name}: {forces:?}");
        }
        if fields == 3 {
            // The left half catches up with the right one.
            assert!(simulation.center(2).velocity[0] > 0.9, "{name}");
            continue;
        }
        // Coulomb at every node; at the edges the normals tilt, which leaves the sums a percent.
        let upper = forces[1];
        assert!(-upper[0] <= 0.3 * upper[up] * 1.02, "{name}: {upper:?}");
        let center = simulation.center(1);
        let (mass, velocity) = (center.mass, center.velocity);
        let lost = mass * (2.0 - velocity[0]);
        let most = 0.3 * mass * (velocity[up] + 10.0 * simulation.velocity_time());
        assert!(
            lost > 0.5 * most && lost <= most * 1.02,
            "{name}: {lost} of {most}"
        );
    }
}

/// A body that slides on a surface of triangles, or in mortar contact, is carried and braked by Coulomb's law.
#[test]
fn what_slides_on_a_surface_is_carried_and_braked() {
    for (name, body) in [("stl-3d", 0), ("mortar-2d", 1), ("mortar-3d", 1)] {
        let simulation = run(name, 1000);
        let up = simulation.scene().dimension.axes() - 1;
        let center = simulation.center(body);
        let (mass, velocity) = (center.mass, center.velocity);
        let carried = mass * (velocity[up] + 10.0 * simulation.velocity_time());
        let weight = mass * 10.0 * simulation.velocity_time();
        assert!(carried > 0.2 * weight, "{name}: {carried} of {weight}");
        let lost = mass * (2.0 - velocity[0]);
        assert!(
            lost > 0.9 * 0.3 * carried && lost <= 1.02 * 0.3 * carried,
            "{name}: {lost} of {}",
            0.3 * carried
        );
    }
}

#[test]
fn a_scene_with_its_own_number_is_measured_once() {
    let (tiny, axes) = find("tiny-3d").expect("a built-in scene");
    assert!(!SceneChoice::BuiltIn(tiny, axes).scales());
    assert_eq!(
        run("tiny-3d", 300).particles(),
        run("tiny-3d", 3000).particles()
    );
    assert!(find("stl-2d").is_none() && find("stl-3d").is_some());
}
