//! Mortar contact beside contact on the grid and beside rigid surfaces.

use crate::common::{APIC, FLIP, body, cuboid, momentum_scale, particles, run_towards, simulation};
use crate::physics::contact::pair;
use crate::physics::mortar::collision;
use crate::physics::mortar_space;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::simulation::Simulation;
use proctor_scene::{RigidSurface, Scene, StressScheme, Vector};
use std::sync::Arc;

/// Runs, and looks at each step.
fn watch(simulation: &mut Simulation, end: f64, mut look: impl FnMut(&Simulation)) {
    while simulation.time() < end {
        run_towards(simulation, 1, end);
        look(simulation);
    }
}

fn keeps_momentum(simulation: &Simulation, before: &Vector, scale: f64) {
    for (axis, p) in simulation.momentum().iter().enumerate() {
        let change = (p - before[axis]).abs();
        assert!(change <= 1e-12 * scale, "axis {axis}: {change} of {scale}");
    }
}

/// Blocks in contact on the grid, far away, leave the discs that collide by mortar every bit.
#[test]
fn a_far_pair_on_the_grid_changes_no_bit() {
    let mut scene = collision(0.4);
    scene
        .bodies
        .push(body(3, cuboid([2.0, 0.1, 0.0], [2.2, 0.3, 0.0])));
    scene
        .bodies
        .push(body(4, cuboid([2.0, 0.3, 0.0], [2.2, 0.5, 0.0])));
    for block in &mut scene.bodies[2..] {
        block.particles_per_cell = [2, 2, 1];
    }
    let mut plain = simulation(&scene);
    scene.contacts = vec![pair(7, 3, 4, 0.2)];
    scene.check().expect("sound");
    let mut paired = simulation(&scene);
    let mut pushed = 0.0_f64;
    watch(&mut plain, 0.1, |s| {
        pushed = pushed.max(-s.mortar_force(1).expect("a boundary")[0]);
    });
    watch(&mut paired, 0.1, |_| ());
    assert!(pushed > 100.0, "{pushed}");
    assert_eq!(paired.contact_layers(), 4);
    assert_eq!(particles(&plain), particles(&paired));
}

/// A disc hits another by mortar, which pushes a block on the grid: the momentum of all three stays, and the block has
/// some in the end.
#[test]
fn a_push_goes_on_from_mortar_to_the_grid() {
    let runs = [
        (APIC, StressScheme::Usl),
        (FLIP, StressScheme::Usl),
        (APIC, StressScheme::Musl),
    ];
    for (transfer, scheme) in runs {
        let mut scene = collision(0.3);
        (scene.transfer, scene.scheme) = (transfer, scheme);
        scene.bodies[1].velocity = [0.0; 3];
        scene
            .bodies
            .push(body(3, cuboid([1.73, 0.5, 0.0], [2.1, 1.0, 0.0])));
        scene.bodies[2].particles_per_cell = [2, 2, 1];
        scene.contacts = vec![pair(7, 3, 2, 0.3)];
        scene.check().expect("sound");
        let mut simulation = simulation(&scene);
        let (before, scale) = (simulation.momentum(), momentum_scale(&simulation));
        let (mut by_mortar, mut on_grid) = (0.0_f64, 0.0_f64);
        watch(&mut simulation, 0.25, |s| {
            by_mortar = by_mortar.max(s.mortar_force(2).expect("a boundary")[0]);
            on_grid = on_grid.max(s.contact_force(2)[0]);
            keeps_momentum(s, &before, scale);
        });
        assert!(
            by_mortar > 100.0 && on_grid > 100.0,
            "{by_mortar} {on_grid}"
        );
        let x: Vec<f64> = (0..3)
            .map(|set| simulation.center(set).position[0])
            .collect();
        let v = simulation.center(2).velocity[0];
        assert!(v > 0.2, "the block stays behind with {v} m/s");
        // The discs stay apart, and the block before them.
        assert!(x[1] - x[0] > 0.58 && x[2] - x[1] > 0.46, "{x:?}");
    }
}

/// Balls that collide by mortar over a smooth plane of triangles: what the plane gives is all that their momentum changes
/// by, whether they touch each other at that time or not.
#[test]
fn balls_with_boundaries_lie_on_a_surface() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let mut scene: Scene = mortar_space::collision(0.3);
        scene.scheme = scheme;
        for ball in &mut scene.bodies {
            ball.velocity[2] = -1.0;
        }
        let at = |x: f64, y: f64| [x, y, 0.11];
        let corners = [
            [at(-9.0, -9.0), at(9.0, -9.0), at(9.0, 9.0)],
            [at(-9.0, -9.0), at(9.0, 9.0), at(-9.0, 9.0)],
        ];
        scene.surfaces.push(RigidSurface {
            name: "plane".into(),
            surface: Arc::new(Surface::new(&corners).expect("a plane")),
            friction: 0.0,
            distance_threshold: 0.1,
            penalty_stiffness: None,
            motion: None,
        });
        scene.check().expect("sound");
        let mut simulation = simulation(&scene);
        let (before, scale) = (simulation.momentum(), momentum_scale(&simulation));
        let mut pushed = 0.0_f64;
        watch(&mut simulation, 0.15, |s| {
            pushed = pushed.max(s.mortar_force(2).expect("a boundary")[0]);
            let mut expected = before;
            for set in 0..2 {
                let impulse = s.surface_impulse(0, set);
                expected = std::array::from_fn(|axis| expected[axis] + impulse[axis]);
            }
            keeps_momentum(s, &expected, scale);
        });
        assert!(pushed > 100.0, "{pushed}");
        let impulses = [0, 1].map(|set| simulation.surface_impulse(0, set)[2]);
        assert!(impulses.iter().all(|i| *i > 1.0), "{impulses:?}");
        for set in 0..2 {
            assert!(
                simulation.center(set).position[2] > 0.11 + 0.25,
                "through the plane"
            );
        }
    }
}
