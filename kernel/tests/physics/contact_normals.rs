//! Normals of contact on the grid at free corners, edges and ends of walls, and bodies that overlap.

use crate::common::{
    APIC, DENSITY, DIMENSIONS, IDENTITY, SCHEMES, body, cuboid, elastic, empty, material, options,
};
use proctor_laws::NeoHookean;
use proctor_scene::simulation::{EventKind, InitialState, Options, Simulation};
use proctor_scene::{
    Contact, ContactNormal, Damping, Dimension, DomainUpdate, PlaneCondition, Scene, Shape,
    StressScheme, Weighting,
};
use std::sync::Arc;

const NORMALS: [ContactNormal; 3] = [
    ContactNormal::Master,
    ContactNormal::Slave,
    ContactNormal::Collinear,
];

fn pair(id: i64, master: i64, slave: i64, normal: ContactNormal) -> Contact {
    Contact {
        name: format!("contact {id}"),
        id,
        friction: 0.0,
        master,
        slave,
        normal,
    }
}

/// A column between two smooth elastic walls, which planes hold from outside and which end above its foot and above its top.
fn column(dimension: Dimension, foot: f64, normal: ContactNormal) -> Scene {
    let h = 0.08;
    let flat = dimension == Dimension::Two;
    let mut scene = empty(dimension, [11, if flat { 16 } else { 3 }, 16], h);
    let up = dimension.axes() - 1;
    scene.mesh.origin[0] = -3.0 * h;
    scene.mesh.planes[0] = [PlaneCondition::Fixed; 2];
    scene.mesh.planes[up][0] = PlaneCondition::Sliding;
    if !flat {
        scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    }
    let block = |x: [f64; 2], z: [f64; 2]| -> Shape {
        if flat {
            cuboid([x[0], z[0], 0.0], [x[1], z[1], 0.0])
        } else {
            cuboid([x[0], 0.0, z[0]], [x[1], 3.0 * h, z[1]])
        }
    };
    scene.materials = vec![material(elastic(4.0e6, 0.3))];
    scene.bodies = vec![
        body(1, block([0.0, 5.0 * h], [0.0, 12.0 * h])),
        body(2, block([-3.0 * h, 0.0], [foot, 14.0 * h + foot])),
        body(3, block([5.0 * h, 8.0 * h], [foot, 14.0 * h + foot])),
    ];
    if flat {
        for body in &mut scene.bodies {
            body.particles_per_cell = [2, 2, 1];
        }
    }
    scene.contacts = vec![pair(1, 2, 1, normal), pair(2, 3, 1, normal)];
    scene.gravity[up] = -10.0;
    scene.damping = Damping::Local { alpha: 0.2 };
    scene.transfer = APIC;
    scene
}

/// Stress along the column stays what its weight asks for, in the mean of each row of cells beside the walls, within 2 % of the
/// largest.
fn check_geostatic(scene: &Scene, foot: f64) {
    let what = format!(
        "{:?} {:?} {:?} {:?}",
        scene.dimension, scene.weighting, scene.scheme, scene.contacts[0].normal
    );
    let up = scene.dimension.axes() - 1;
    let top = 12.0 * 0.08;
    let weight = move |z: f64| -DENSITY * 10.0 * (top - z);
    let initial = move |x: &proctor_scene::Vector| {
        let mut stress = [0.0; 6];
        if x[0] > 0.0 && x[0] < 0.4 && x[up] < top {
            stress[up] = weight(x[up]);
        }
        InitialState {
            velocity: [0.0; 3],
            velocity_gradient: [[0.0; 3]; 3],
            stress,
            deformation: IDENTITY,
        }
    };
    let options = Options {
        initial: Some(Arc::new(initial)),
        ..options()
    };
    let mut simulation = Simulation::new(scene, &options).expect("the scene is sound");
    // A wave of 73 m/s crosses the column in 13 ms; what it swings by is damped within ten such times.
    simulation.run_until(0.3).expect("the step is sound");
    let set = &simulation.sets()[0];
    let mut rows: Vec<(f64, f64, f64)> = vec![];
    for p in 0..set.len() {
        let z = ((simulation.position(0, p)[up] / 0.08).floor() + 0.5) * 0.08;
        let stress = set.stress(p)[up];
        match rows.iter_mut().find(|row| (row.0 - z).abs() < 1e-9) {
            Some(row) => (row.1, row.2) = (row.1 + stress, row.2 + 1.0),
            None => rows.push((z, stress, 1.0)),
        }
    }
    // Below the walls the column bulges.
    for (z, sum, count) in rows.into_iter().filter(|row| row.0 > foot + 0.16) {
        let off = sum / count - weight(z);
        assert!(
            off.abs() < 0.02 * weight(0.0).abs(),
            "{what}: at {z} m {} of {} Pa",
            sum / count,
            weight(z)
        );
    }
}

#[test]
fn ends_of_smooth_walls_carry_no_weight() {
    for normal in NORMALS {
        for foot in [0.16, 0.11] {
            check_geostatic(&column(Dimension::Two, foot, normal), foot);
        }
    }
    for scheme in SCHEMES {
        let mut scene = column(Dimension::Two, 0.13, ContactNormal::Collinear);
        scene.scheme = scheme;
        check_geostatic(&scene, 0.13);
    }
}

#[test]
fn ends_of_smooth_walls_carry_no_weight_with_b_splines_and_in_space() {
    let mut scene = column(Dimension::Two, 0.16, ContactNormal::Collinear);
    scene.weighting = Weighting::QuadraticBSpline;
    check_geostatic(&scene, 0.16);
    check_geostatic(
        &column(Dimension::Three, 0.16, ContactNormal::Collinear),
        0.16,
    );
}

/// Two discs that run into each other, with mesh lines through both centres and the plane of contact.
fn discs(cells: usize, shift: f64, normal: ContactNormal) -> f64 {
    let h = 1.0 / cells as f64;
    let mut scene = empty(Dimension::Two, [cells * 8 / 5, cells, 1], h);
    scene.mesh.origin[0] = -shift * h;
    scene.mesh.origin[1] = -shift * h;
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Determinant);
    scene.scheme = StressScheme::Musl;
    scene.transfer = APIC;
    scene.materials = vec![material(NeoHookean::new(1.0e5, 0.3))];
    scene.bodies = [(1, 0.5), (2, 1.1)]
        .map(|(id, x)| {
            body(
                id,
                Shape::Sphere {
                    center: [x, 0.5, 0.0],
                    radius: 0.2,
                },
            )
        })
        .to_vec();
    for (body, speed) in scene.bodies.iter_mut().zip([1.0, -1.0]) {
        body.particles_per_cell = [2, 2, 1];
        body.velocity[0] = speed;
    }
    scene.contacts = vec![pair(1, 1, 2, normal)];
    let mut simulation = Simulation::new(&scene, &options()).expect("the scene is sound");
    simulation.run_until(0.6).expect("the step is sound");
    simulation.center(0).velocity[0]
}

#[test]
fn discs_rebound_wherever_mesh_lines_are() {
    for normal in NORMALS {
        for (cells, shift) in [(40, 0.0), (40, 0.5), (80, 0.0)] {
            let speed = discs(cells, shift, normal);
            println!("{normal:?} {cells} {shift}: {speed}");
            // On half of a fine mesh, moved by half a cell, -0.936 m/s.
            assert!(
                (speed + 0.92).abs() < 0.04,
                "{normal:?}, {cells} cells a metre moved by {shift}: {speed} m/s"
            );
        }
    }
}

/// Contact acts where bodies are nearer than the distance of contact by all of it, and an event notes it.
#[test]
fn bodies_that_overlap_are_driven_apart() {
    for dimension in DIMENSIONS {
        for normal in NORMALS {
            for share in [0.5, 0.8, 0.95] {
                let h = 0.1;
                let mut scene = empty(dimension, [20, 8, 8], h);
                // Faces on mesh lines; nearest particles are half a cell apart.
                scene.bodies = vec![
                    body(1, cuboid([0.5, 0.2, 0.2], [0.9, 0.6, 0.6])),
                    body(2, cuboid([0.9, 0.2, 0.2], [1.3, 0.6, 0.6])),
                ];
                scene.contact_distance = Some(0.5 / (1.0 - share));
                scene.bodies[0].velocity[0] = 0.5;
                scene.bodies[1].velocity[0] = -0.5;
                scene.contacts = vec![pair(1, 1, 2, normal)];
                let mut simulation =
                    Simulation::new(&scene, &options()).expect("the scene is sound");
                simulation.run_until(0.05).expect("the step is sound");
                let what = format!("{dimension:?} {normal:?} {share}");
                let [a, b] = [0, 1].map(|set| simulation.center(set).velocity[0]);
                assert!(a < 0.0 && b > 0.0, "{what}: {a} and {b} m/s");
                let mut events = simulation.events().iter();
                let noted = events.any(|event| {
                    matches!(event.kind, EventKind::Overlap { bodies: [1, 2], depth, .. } if depth > 0.4 * h)
                });
                assert!(noted, "{what}: {:?}", simulation.events());
            }
        }
    }
}
