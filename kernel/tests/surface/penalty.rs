//! The penalty force of a rigid surface.

use crate::surface::slide::{raise, start};
use crate::surface::slope::{H, Slope, dot};
use proctor_contact::surfaces::touch::{SurfaceTouch, SurfaceTouches, TouchedNode};
use proctor_kernel::lanes::SelectedLanes;
use proctor_scene::{Scene, StressScheme};

/// A body at rest that was pressed into a slope without friction, and how deep \[m\].
fn pressed_in(stiffness: f64) -> (Slope, Scene, f64) {
    let slope = Slope {
        gravity: 0.0,
        speed: 0.0,
        end: 0.05,
        ..Slope::new(StressScheme::Usl, 0.0)
    };
    let mut scene = slope.scene();
    // 0.9 % of a cell, which is let pass as the round-off of a careless input.
    let depth = 0.009 * H;
    scene.surfaces[0].penalty_stiffness = Some(stiffness);
    raise(&mut scene, &slope, -depth);
    (slope, scene, depth)
}

/// The penalty force alone is k times the penetration; a body that was pressed in is pushed out.
#[test]
fn a_penalty_force_pushes_out() {
    let stiffness = 1e4;
    let (slope, scene, depth) = pressed_in(stiffness);
    let mut simulation = start(&scene, 1);
    simulation.step(slope.end).expect("a step");
    let force = dot(&simulation.contact_force(0), &slope.normal());
    let expected = 32.0 * stiffness * depth;
    assert!((force / expected - 1.0).abs() < 1e-9, "{force} {expected}");
    simulation.run_until(slope.end).expect("a step");
    assert!(dot(&simulation.center(0).velocity, &slope.normal()) > 0.0);
}

/// The penalty force of a particle that is pressed is a part of what presses back, not beside it: one that arrives with 1 m/s
/// at a node of 1 kg is stopped by 1 N s, whatever smaller penalty acts; where nothing arrives the penalty acts alone.
#[test]
fn a_penalty_force_adds_nothing_where_contact_presses_more() {
    for (speed, penalty, expected) in [(1.0, 0.3, 1.0), (1.0, 0.0, 1.0), (-0.5, 0.3, 0.3)] {
        let mut touches = SurfaceTouches::default();
        touches.nodes.push(TouchedNode {
            node: 0,
            field: 0,
            others: 0..0,
            mobility: [1.0, 1.0, 1.0, 0.0],
            velocity: [0.0; 3],
            increment: [0.0; 3],
            change: [0.0; 4],
        });
        touches.weights.push((0, [1.0, 1.0, 1.0, 0.0]));
        touches.list.push(SurfaceTouch {
            weights: 0..1,
            normal: [0.0, 0.0, 1.0],
            relative: [0.0, 0.0, -speed],
            gap: -0.01,
            bound: 0.0,
            floor: 0.0,
            penalty,
            friction: 0.0,
            normal_impulse: 0.0,
            tangential_impulse: [0.0; 3],
        });
        touches.resolve(SelectedLanes::any(), 1e-12, 50);
        let given = touches.nodes[0].change[2];
        assert!((touches.list[0].normal_impulse - expected).abs() < 1e-15);
        assert!(
            (given - expected).abs() < 1e-15,
            "{given} m/s for {expected}"
        );
    }
}

/// However stiff, it pushes a body out within one step at most: it does not shoot it off.
#[test]
fn a_stiff_penalty_force_shoots_nothing_off() {
    let (slope, scene, depth) = pressed_in(1e12);
    let mut simulation = start(&scene, 1);
    let info = simulation.step(slope.end).expect("a step");
    let speed = dot(&simulation.center(0).velocity, &slope.normal());
    assert!(speed > 0.0);
    assert!(
        speed <= depth / info.dt * (1.0 + 1e-9),
        "{speed}, {depth} deep"
    );
}
