//! The energy balance where it begins, and where the mesh moves.

use crate::common::{SCHEMES, block, body, cuboid, empty, run_towards, simulation};
use crate::physics::mortar::{collision, contact, line, run_until};
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    BaseMotion, Dimension, History, Motion, PlaneCondition, Scene, StressScheme, Weighting,
};

/// The work of gravity is the weight times the way in the scene, whatever way the mesh takes meanwhile.
#[test]
fn the_work_of_gravity_over_a_moving_base() {
    for scheme in SCHEMES {
        let mut scene = block(Dimension::Two);
        scene.scheme = scheme;
        scene.gravity = [2.0, -10.0, 0.0];
        // The body flies above the base and does not feel it.
        scene.base_motion = Some(BaseMotion {
            axis: 1,
            side: 0,
            motion: Motion::Velocity(History {
                times: vec![0.0, 0.01],
                values: vec![[0.0; 3], [1.0, 3.0, 0.0]],
            }),
        });
        let mut simulation = simulation(&scene);
        let start = simulation.center(0).position;
        run_until(&mut simulation, 0.02);
        assert!(simulation.origin()[1] > 0.04, "the mesh has moved");
        let center = simulation.center(0);
        let (mass, x) = (center.mass, center.position);
        let exact: f64 = (0..2)
            .map(|axis| mass * scene.gravity[axis] * (x[axis] - start[axis]))
            .sum();
        let found = simulation.energy().external_work;
        assert!(
            (found / exact - 1.0).abs() < 1.0e-9,
            "{scheme:?}: {found} {exact}"
        );
    }
}

/// The energy that mortar contact stores at the start is in the balance once: a body that begins to be pushed has lost nothing.
#[test]
fn contact_that_is_there_at_the_start_is_no_dissipation() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let mut scene = collision(0.0);
        scene.scheme = scheme;
        scene.bodies.truncate(1);
        scene.bodies[0].velocity = [0.0; 3];
        scene.mortar.boundaries.truncate(1);
        // Half of the critical gap below the disc.
        scene.mortar.lines = vec![line(&[[2.2, 0.28], [0.1, 0.28]])];
        scene.mortar.contacts = vec![contact(9, 1, 0.0)];
        let mut simulation = simulation(&scene);
        run_towards(&mut simulation, 1, 1.0);
        let stored = simulation.mortar_energy();
        assert!(stored > 0.0);
        run_towards(&mut simulation, 4, 1.0);
        let energy = simulation.energy();
        assert!(
            energy.dissipated.abs() < 0.1 * stored,
            "{scheme:?}: {energy:?} {stored}"
        );
    }
}

/// A block of one layer of cells on a plane that slides along with the base, from rest, by 4 m/s² along the plane.
fn on_a_base_that_starts(scheme: StressScheme) -> Scene {
    let mut scene = empty(Dimension::Two, [8, 6, 1], 0.1);
    scene.scheme = scheme;
    scene.bodies = vec![body(1, cuboid([0.2, 0.0, 0.0], [0.5, 0.2, 0.0]))];
    scene.base_motion = Some(BaseMotion {
        axis: 1,
        side: 0,
        motion: Motion::Velocity(History {
            times: vec![0.0, 1.0],
            values: vec![[0.0; 3], [PULL, 0.0, 0.0]],
        }),
    });
    scene
}

/// Acceleration of that base \[m/s²\].
const PULL: f64 = 4.0;

/// Largest component of a stress of the first body \[Pa\].
fn largest_stress(simulation: &Simulation) -> f64 {
    let set = &simulation.sets()[0];
    (0..set.len())
        .flat_map(|p| set.stress(p))
        .fold(0.0, |most, s| most.max(s.abs()))
}

/// A body that falls as the base does is not strained by it, whatever the scheme maps a second time.
#[test]
fn a_base_that_falls_with_the_body_strains_nothing() {
    for scheme in SCHEMES {
        let mut scene = on_a_base_that_starts(scheme);
        // Particles reach beyond the plane.
        scene.weighting = Weighting::QuadraticBSpline;
        scene.gravity = [PULL, 0.0, 0.0];
        let mut simulation = simulation(&scene);
        run_towards(&mut simulation, 20, 1.0);
        let most = largest_stress(&simulation);
        // A plane that lags by half a step strains the lowest cells: 14 Pa with USF.
        assert!(most < 1e-6, "{scheme:?}: {most} Pa");
        let fast = simulation.center(0).velocity[0] / (PULL * simulation.velocity_time());
        assert!((fast - 1.0).abs() < 1e-12, "{scheme:?}: {fast}");
    }
}

/// A block from the base to the plane opposite, which moves along with the mesh, falls as the base does.
#[test]
fn what_falls_between_the_base_and_the_plane_opposite_is_not_strained() {
    for scheme in SCHEMES {
        for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
            let mut scene = empty(Dimension::Two, [8, 6, 1], 0.1);
            scene.scheme = scheme;
            scene.weighting = weighting;
            scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
            scene.bodies = vec![body(1, cuboid([0.2, 0.0, 0.0], [0.5, 0.6, 0.0]))];
            scene.gravity = [0.0, -PULL, 0.0];
            scene.base_motion = Some(BaseMotion {
                axis: 1,
                side: 0,
                motion: Motion::Velocity(History {
                    times: vec![0.0, 1.0],
                    values: vec![[0.0; 3], [0.0, -PULL, 0.0]],
                }),
            });
            let mut simulation = simulation(&scene);
            run_towards(&mut simulation, 20, 1.0);
            let most = largest_stress(&simulation);
            assert!(most < 1e-6, "{scheme:?} {weighting:?}: {most} Pa");
            let fast = simulation.center(0).velocity[1] / (-PULL * simulation.velocity_time());
            assert!(
                (fast - 1.0).abs() < 1e-12,
                "{scheme:?} {weighting:?}: {fast}"
            );
        }
    }
}

/// The work of the base in a step is its force, which the momentum tells, times its way in the step: with the velocity of
/// half a step after.
#[test]
fn the_work_of_a_base_is_its_force_times_its_way() {
    let scene = on_a_base_that_starts(StressScheme::Usl);
    let mut simulation = simulation(&scene);
    let (mut work, mut momentum, mut before) = (0.0, 0.0, 0.0);
    for _ in 0..20 {
        let from = simulation.time();
        run_towards(&mut simulation, 1, 1.0);
        let after = simulation.velocity_time();
        let force = (simulation.momentum()[0] - momentum) / (after - before);
        work += force * PULL * after * (simulation.time() - from);
        (momentum, before) = (simulation.momentum()[0], after);
    }
    let found = simulation.energy().external_work;
    assert!(work > 0.0);
    // Mapped velocities of nodes in the plane are not quite those that it had; half a step is 5 %.
    assert!((found / work - 1.0).abs() < 1e-3, "{found} {work}");
}
