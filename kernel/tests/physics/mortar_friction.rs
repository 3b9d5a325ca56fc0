//! Friction of a block with corners that slides as slave of a rigid line.

use crate::common::{APIC, body, cuboid, elastic, empty, material, simulation};
use crate::mortar::{contact, line};
use proctor_kernel::mortar::motion::Follow;
use proctor_kernel::scene::{BodyBoundary, Dimension, MortarContact, Vertices};

/// A block with corners that slides as slave, its lower face bent by friction, is held by mu N of the plane: the pressure acts
/// along the normal of the plane.
#[test]
fn a_block_with_corners_is_rubbed_by_mu_n() {
    const MU: f64 = 0.35;
    let (h, bottom) = (0.1, 0.232);
    let mut scene = empty(Dimension::Two, [30, 12, 1], h);
    scene.transfer = APIC;
    scene.gravity = [5.0, -8.66, 0.0];
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![body(
        1,
        cuboid([0.23, bottom, 0.0], [1.43, bottom + 0.6, 0.0]),
    )];
    scene.bodies[0].velocity = [1.0, 0.0, 0.0];
    scene.bodies[0].particles_per_cell = [2, 2, 1];
    scene.mortar.boundaries = vec![BodyBoundary {
        body: 1,
        vertices: Vertices::Spacing(0.05),
        follow: Follow::Spin,
    }];
    scene.mortar.lines = vec![line(&[[2.95, bottom - 0.01], [0.02, bottom - 0.01]])];
    scene.mortar.contacts = vec![MortarContact {
        critical_gap: 0.02,
        ..contact(9, 1, MU)
    }];
    let mut simulation = simulation(&scene);
    let (mut rubbed, mut pressed) = (0.0, 0.0);
    while simulation.time() < 0.6 {
        let dt = simulation.step(0.6).expect("a step").dt;
        let [along, up, _] = simulation.mortar_force(1).expect("has a boundary");
        if simulation.time() > 0.05 {
            rubbed -= along * dt;
            pressed += up * dt;
        }
    }
    let off = rubbed / (MU * pressed) - 1.0;
    assert!(off.abs() < 1e-3, "friction is off mu N by {off}");
}
