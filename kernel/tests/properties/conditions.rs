//! A condition that a user adds acts as one of the scene does.

use crate::common::{SCHEMES, TRANSFERS, block, rough, run};
use proctor_scene::HeldBox;
use proctor_scene::prelude::*;
use std::sync::Arc;

const BELOW: f64 = 0.35;

/// Nodes below a height stand still.
struct Held;

impl Held {
    fn hold(field: &mut FieldNodes<'_, '_>) {
        field.for_each(|node| {
            if node.position()[1] < BELOW {
                node.prescribe([0.0; 3], [0.0; 3]);
            }
        });
    }
}

impl Condition for Held {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        Self::hold(field);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        Self::hold(field);
    }
}

#[test]
fn held_by_the_user_or_by_the_scene() {
    for dimension in crate::common::DIMENSIONS {
        let deep = if dimension == Dimension::Two {
            0.0
        } else {
            0.7
        };
        for scheme in SCHEMES {
            for transfer in TRANSFERS {
                let mut scene = block(dimension);
                scene.scheme = scheme;
                scene.transfer = transfer;
                let at_end = |scene: &Scene, conditions: Vec<Arc<dyn Condition>>, threads| {
                    let options = Options {
                        threads: Some(threads),
                        least_share: Some(1),
                        initial: Some(rough(dimension, 0.1, 1.0e3, 7)),
                        conditions,
                        ..Options::default()
                    };
                    let mut simulation = Simulation::new(scene, &options).expect("a sound scene");
                    run(&mut simulation, 20);
                    (simulation.state_hash(), simulation.energy())
                };
                let free = at_end(&scene, vec![], 1);
                let own = at_end(&scene, vec![Arc::new(Held)], 1);
                let on_threads = at_end(&scene, vec![Arc::new(Held)], 3);
                scene.held_boxes = vec![HeldBox {
                    p1: [0.0; 3],
                    p2: [0.9, BELOW, deep],
                }];
                let held = at_end(&scene, vec![], 1);
                assert_ne!(free.0, held.0, "{dimension:?} {scheme:?} {transfer:?}");
                assert_eq!(own, held, "{dimension:?} {scheme:?} {transfer:?}");
                assert_eq!(own, on_threads, "{dimension:?} {scheme:?} {transfer:?}");
            }
        }
    }
}

/// A constant force on every node, whose work is told.
struct Push(Vector);

impl Condition for Push {
    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        field.for_each(|node| node.add_force(self.0.map(|a| node.mass() * a)));
        Ok(())
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        field.for_each(|node| {
            let power = (0..3).map(|k| node.mass() * self.0[k] * node.velocity()[k]);
            node.add_power(power.sum());
        });
    }
}

/// As weight does, but for round-off: motion and the work that is done.
#[test]
fn pushed_by_the_user_or_by_gravity() {
    for scheme in SCHEMES {
        let mut scene = block(Dimension::Two).with_planes(PlaneCondition::Free);
        scene.scheme = scheme;
        let at_end = |scene: &Scene, conditions: Vec<Arc<dyn Condition>>| {
            let options = Options {
                conditions,
                ..crate::common::options()
            };
            let mut simulation = Simulation::new(scene, &options).expect("a sound scene");
            run(&mut simulation, 50);
            (simulation.center(0).velocity, simulation.energy())
        };
        let a = [0.3, -0.5, 0.0];
        let (v, energy) = at_end(&scene, vec![Arc::new(Push(a))]);
        scene.gravity = a;
        let (exact, expected) = at_end(&scene, vec![]);
        for axis in 0..2 {
            assert!(
                (v[axis] / exact[axis] - 1.0).abs() < 1e-12,
                "{v:?} {exact:?}"
            );
        }
        let ratio = energy.external_work / expected.external_work;
        assert!((ratio - 1.0).abs() < 1e-9, "{scheme:?} {ratio}");
    }
}
