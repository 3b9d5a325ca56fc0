//! Conditions of a program's own that say that they are local, shared among ranks.

use super::harness::{drifting, measures, step, strip};
use super::threads::{self, Thread};
use crate::common::{DIMENSIONS, SCHEMES, options};
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::{NOT_LOCAL, SharingRefusal};
use proctor_scene::prelude::*;
use std::sync::Arc;

/// Whatever lies below a height is pushed along the first axis, and slowed down.
struct Layer {
    is_local: bool,
}

impl Layer {
    const TOP: f64 = 0.3;
}

impl Condition for Layer {
    fn not_local(&self) -> Option<&'static str> {
        (!self.is_local).then_some("a layer of its own")
    }

    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        field.for_each(|node| {
            if node.position()[1] < Self::TOP {
                node.add_force([node.mass() * 3.0, 0.0, 0.0]);
            }
        });
        Ok(())
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        field.for_each(|node| {
            if node.position()[1] < Self::TOP {
                node.set_velocity(node.velocity().map(|v| 0.999 * v));
            }
        });
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        field.for_each(|node| {
            if node.position()[1] < Self::TOP {
                node.add_power(node.mass() * 3.0 * node.velocity()[0]);
            }
        });
    }
}

/// Does nothing, and says nothing of ranks.
struct Silent;

impl Condition for Silent {}

fn start(scene: &Scene, condition: Arc<dyn Condition>) -> Simulation {
    let options = Options {
        threads: Some(1),
        least_share: Some(1),
        initial: Some(drifting(scene, 8.0)),
        conditions: vec![condition],
        ..options()
    };
    Simulation::new(scene, &options).expect("the scene is sound")
}

#[test]
fn ranks_share_a_local_condition() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let scene = &{
                let mut scene = strip(dimension);
                scene.scheme = scheme;
                scene
            };
            let run = |rank: Option<Thread>| {
                let mut simulation = start(scene, Arc::new(Layer { is_local: true }));
                if let Some(rank) = rank {
                    let shared = simulation.share_among(Arc::new(rank));
                    shared.expect("the condition is local");
                }
                let (sorts, error) = step(&mut simulation, 80);
                assert!(error.is_none() && sorts >= 10, "{error:?}, {sorts} sorts");
                measures(&mut simulation, None)
            };
            let expected = run(None);
            assert!(expected.energy.external_work != 0.0);
            for count in [2, 3, 4] {
                std::thread::scope(|scope| {
                    let ranks = threads::ranks(count, None).into_iter();
                    let all: Vec<_> = ranks
                        .map(|rank| scope.spawn(move || run(Some(rank))))
                        .collect();
                    for found in all {
                        let found = found.join().expect("no rank panics");
                        assert_eq!(found, expected, "{count} ranks {scheme:?}");
                    }
                });
            }
        }
    }
}

#[test]
fn a_condition_that_is_not_local_is_refused() {
    let own: [(Arc<dyn Condition>, &str); 2] = [
        (Arc::new(Layer { is_local: false }), "a layer of its own"),
        (Arc::new(Silent), NOT_LOCAL[0]),
    ];
    for (condition, part) in own {
        let rank: Arc<dyn Ranks> = Arc::new(threads::ranks(2, None).swap_remove(0));
        let mut simulation = start(&strip(Dimension::Two), condition);
        let refused = simulation.share_among(rank).expect_err("not local");
        assert_eq!(refused, SharingRefusal::Part { part });
    }
}
