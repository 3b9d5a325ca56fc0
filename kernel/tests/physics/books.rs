//! The energy balance where it begins, and where the mesh moves.

use crate::common::{SCHEMES, block, run_towards, simulation};
use crate::mortar::{collision, contact, line, run_until};
use proctor_kernel::scene::{BaseMotion, Dimension, History, Motion, StressScheme};

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
        let start = simulation.center(0).1;
        run_until(&mut simulation, 0.02);
        assert!(simulation.origin()[1] > 0.04, "the mesh has moved");
        let (mass, x, _) = simulation.center(0);
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

/// What mortar contact stores at the start is in the balance once: a body that begins to be pushed has lost nothing.
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
