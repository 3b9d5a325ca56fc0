//! An interaction that a user adds acts in all schemes, on any number of threads, and is saved.

use crate::common::{DIMENSIONS, FLIP, SCHEMES, block, cuboid, options, rough, run};
use proctor_scene::prelude::*;
use proctor_scene::simulation::SavedArrays;

/// Gives two bodies fields of their own, and one velocity where both are: they move as if they shared one.
#[derive(Clone)]
struct Glue {
    bodies: [usize; 2],
    /// Steps so far.
    steps: f64,
}

impl Interaction for Glue {
    fn owners(&self) -> BodyList {
        self.bodies.into_iter().collect()
    }

    fn on_slabs<'a>(
        &'a mut self,
        grid: &Grid,
        _: VelocityMapping,
        give: &mut dyn FnMut(SlabPart<'a>),
    ) {
        for _ in &grid.slabs {
            give(SlabPart::own(&*self));
        }
    }

    fn settle(
        &mut self,
        _: &mut StepUpdate<'_>,
        _: &NodalConditions,
    ) -> Result<usize, InteractionError> {
        self.steps += 1.0;
        Ok(0)
    }

    fn save(&self) -> SavedArrays {
        vec![("steps".into(), vec![self.steps])]
    }

    fn restore(&mut self, saved: &SavedArrays) {
        self.steps = saved[0].1[0];
    }
}

impl Glue {
    fn join(&self, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        context.for_each_shared(slab, self.bodies, |[a, b]| {
            let mass = a.mass() + b.mass();
            let mean = |of_a: Vector, of_b: Vector| -> Vector {
                std::array::from_fn(|k| (a.mass() * of_a[k] + b.mass() * of_b[k]) / mass)
            };
            let after = mean(a.velocity(), b.velocity());
            let change = mean(a.change(), b.change());
            let before = std::array::from_fn(|k| after[k] - change[k]);
            a.prescribe(before, after);
            b.prescribe(before, after);
        });
    }
}

impl SlabInteraction for &Glue {
    fn correct(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>, _: &mut ExactStepSums) {
        self.join(slab, context);
    }

    fn correct_remapped(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        self.join(slab, context);
    }
}

#[test]
fn glued_by_the_user_or_in_one_field() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = block(dimension);
            scene.scheme = scheme;
            scene.transfer = FLIP;
            let mut second = scene.bodies[0].clone();
            second.id += 1;
            second.shape = cuboid([0.61, 0.22, 0.23], [0.81, 0.52, 0.53]);
            scene.bodies.push(second);
            let start = |interactions: Vec<Box<dyn Interaction>>, threads| {
                let all = Options {
                    threads: Some(threads),
                    least_share: Some(1),
                    initial: Some(rough(dimension, 0.1, 1.0e3, 3)),
                    interactions,
                    ..options()
                };
                Simulation::new(&scene, &all).expect("a sound scene")
            };
            let glue = || -> Vec<Box<dyn Interaction>> {
                vec![Box::new(Glue {
                    bodies: [0, 1],
                    steps: 0.0,
                })]
            };
            let (mut one, mut glued) = (start(vec![], 1), start(glue(), 1));
            run(&mut one, 20);
            run(&mut glued, 20);
            for set in 0..2 {
                let center = one.center(set);
                let (x, v) = (center.position, center.velocity);
                let center = glued.center(set);
                let (y, w) = (center.position, center.velocity);
                for axis in 0..2 {
                    let close = |a: f64, b: f64| (a - b).abs() < 1e-11;
                    assert!(close(x[axis], y[axis]), "{scheme:?} {x:?} {y:?}");
                    assert!(close(v[axis], w[axis]), "{scheme:?} {v:?} {w:?}");
                }
            }

            // On threads, after it was saved and taken up again.
            let mut resumed = start(glue(), 3);
            resumed.restore(glued.save()).expect("the same scene");
            run(&mut glued, 5);
            run(&mut resumed, 5);
            assert_eq!(glued.state_hash(), resumed.state_hash(), "{scheme:?}");
            let steps = resumed.interaction::<Glue>().map(|glue| glue.steps);
            assert_eq!(steps, Some(25.0));
        }
    }
}
