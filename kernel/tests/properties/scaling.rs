//! Units: scaling length, mass and time by powers of two scales every result to the last bit. An absolute
//! threshold anywhere would show.

use crate::common::{
    DIMENSIONS, NEO_HOOKEAN, NEVER, TRANSFERS, block, elastic, options, rough,
    weightings_and_schemes,
};
use proctor_laws::{LinearElastic, NeoHookean};
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{Damping, PlaneCondition, PointLoad, Scene, Shape, TimeStep, Traction, Vector};
use proptest::prelude::*;
use std::sync::Arc;

/// Units of length, mass and time, powers of two.
#[derive(Clone, Copy, Debug)]
struct Units {
    length: f64,
    mass: f64,
    time: f64,
}

impl Units {
    fn velocity(self) -> f64 {
        self.length / self.time
    }

    fn stress(self) -> f64 {
        self.mass / (self.length * self.time * self.time)
    }

    fn density(self) -> f64 {
        self.mass / self.length.powi(3)
    }

    /// In two dimensions the thickness stays 1 m.
    fn force(self, axes: usize) -> f64 {
        self.stress() * self.length.powi(axes as i32 - 1)
    }

    fn scale(self, scene: &Scene) -> Scene {
        let mut scaled = scene.clone();
        let axes = scene.dimension.axes();
        let long = |x: &mut Vector| x[..axes].iter_mut().for_each(|c| *c *= self.length);
        long(&mut scaled.mesh.origin);
        long(&mut scaled.mesh.cell);
        scaled.gravity = scene.gravity.map(|g| g * self.velocity() / self.time);
        for material in &mut scaled.materials {
            material.density *= self.density();
            let [young, poisson] = [0, 1].map(|i| material.law.constants()[i].1);
            let young = young * self.stress();
            material.law = match material.law.downcast::<LinearElastic>() {
                Some(law) => LinearElastic::with_rate(young, poisson, law.rate()).into(),
                None => NeoHookean::new(young, poisson).into(),
            };
        }
        for body in &mut scaled.bodies {
            let Shape::Cuboid { p1, p2 } = &mut body.shape else {
                unreachable!("a cuboid")
            };
            long(p1);
            long(p2);
        }
        for load in &mut scaled.point_loads {
            long(&mut load.position);
            load.force = load.force.map(|f| f * self.force(axes));
        }
        for load in &mut scaled.tractions {
            long(&mut load.p1);
            long(&mut load.p2);
            for value in &mut load.traction.values {
                *value = value.map(|t| t * self.stress());
            }
        }
        if let TimeStep::Fixed { dt, .. } = &mut scaled.time_step {
            *dt *= self.time;
        }
        scaled
    }

    fn scale_field(self, axes: usize, field: InitialField) -> InitialField {
        Arc::new(move |x| {
            let mut local = *x;
            local[..axes].iter_mut().for_each(|c| *c /= self.length);
            let mut state = field(&local);
            state.velocity = state.velocity.map(|v| v * self.velocity());
            state.stress = state.stress.map(|s| s * self.stress());
            state
        })
    }
}

fn compare(scene: &Scene, units: Units, seed: u64) -> Result<(), TestCaseError> {
    let axes = scene.dimension.axes();
    let stress = if scene.materials[0].law.needs_deformation() {
        0.0
    } else {
        1.0e3
    };
    let field = rough(scene.dimension, 0.5, stress, seed);
    let simulate = |scene: &Scene, field, never: f64| {
        let all = Options {
            initial: Some(field),
            ..options()
        };
        let mut simulation = Simulation::new(scene, &all).expect("the scene is sound");
        crate::common::run_towards(&mut simulation, 25, never);
        simulation
    };
    let one = simulate(scene, Arc::clone(&field), NEVER);
    let two = simulate(
        &units.scale(scene),
        units.scale_field(axes, field),
        NEVER * units.time,
    );
    prop_assert_eq!(one.time() * units.time, two.time());
    for (set, scaled) in one.sets().iter().zip(two.sets()) {
        prop_assert_eq!(&set.id, &scaled.id);
        for p in 0..set.len() {
            prop_assert_eq!(
                set.position(p).map(|x| x * units.length),
                scaled.position(p)
            );
            prop_assert_eq!(
                set.velocity(p).map(|v| v * units.velocity()),
                scaled.velocity(p)
            );
            prop_assert_eq!(set.stress(p).map(|s| s * units.stress()), scaled.stress(p));
        }
    }
    Ok(())
}

fn power() -> impl Strategy<Value = f64> {
    (-12_i32..12).prop_map(|e| 2.0_f64.powi(e))
}

proptest! {
    #![proptest_config(crate::common::cases(4))]

    #[test]
    fn results_scale_with_the_units(length in power(), mass in power(), time in power(), seed in 0_u64..1000) {
        let units = Units { length, mass, time };
        for dimension in DIMENSIONS {
            for (i, (weighting, scheme)) in weightings_and_schemes().enumerate() {
                let mut scene = block(dimension);
                scene.weighting = weighting;
                scene.scheme = scheme;
                scene.transfer = TRANSFERS[(i + seed as usize) % 4];
                scene.gravity = [0.0, -10.0, 0.0];
                scene.mesh.planes = [[PlaneCondition::Sliding, PlaneCondition::Fixed]; 3];
                // Against the lower planes, so that ghosts take part.
                scene.bodies[0].shape = crate::common::cuboid([0.0; 3], [0.4, 0.3, 0.3]);
                scene.materials[0].law =
                    if i % 2 == 0 { NEO_HOOKEAN.into() } else { elastic(1.0e6, 0.3).into() };
                scene.damping = match i % 4 {
                    0 => Damping::None,
                    1 => Damping::Local { alpha: 0.3 },
                    2 => Damping::Kinetic,
                    _ => Damping::Viscous { alpha: 0.5 },
                };
                scene.point_loads =
                    vec![PointLoad { position: [0.2, 0.2, 0.2], force: [30.0, 40.0, 0.0] }];
                scene.tractions = vec![Traction {
                    p1: [0.05, 0.2, 0.0],
                    p2: [0.25, 0.2, 0.17],
                    traction: [0.0, -100.0, 0.0].into(),
                }];
                crate::common::calm(&mut scene);
                compare(&scene, units, seed)?;
            }
        }
    }
}
