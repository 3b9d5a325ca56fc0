//! An interaction of one's own: two bodies that fill the same space, as a skeleton and what flows through it, and drag on
//! each other. Their relative velocity falls as exp(-r t), and their momentum stays.
//!
//!     cargo run --release --package proctor-kernel --example own_interaction

use proctor_scene::prelude::*;
use std::error::Error;

/// Speed of the first body, and less that of the second \[m/s\]: so slow that they stay where they are.
const SPEED: f64 = 1.0e-5;
const RATE: f64 = 3.0;

/// Force on one body against the other, proportional to their relative velocity.
#[derive(Clone)]
struct Drag {
    /// Places of the bodies in the scene.
    bodies: [usize; 2],
    /// Rate at which the relative velocity falls \[1/s\].
    rate: f64,
}

impl Interaction for Drag {
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
}

impl SlabInteraction for &Drag {
    fn correct(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>, _: &mut ExactStepSums) {
        // Exact for any step: the share of the relative velocity that is lost in the time over which velocities change.
        let lost = 1.0 - (-self.rate * context.nodal().kick).exp();
        context.for_each_shared(slab, self.bodies, |[a, b]| {
            let (m_a, m_b) = (a.mass(), b.mass());
            let (v_a, v_b) = (a.velocity(), b.velocity());
            let impulse: Vector =
                std::array::from_fn(|k| lost * m_a * m_b / (m_a + m_b) * (v_b[k] - v_a[k]));
            a.set_velocity(std::array::from_fn(|k| v_a[k] + impulse[k] / m_a));
            b.set_velocity(std::array::from_fn(|k| v_b[k] - impulse[k] / m_b));
        });
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::plane([12, 12], 0.05).with_end(0.2);
    let bodies = [(2000.0, SPEED), (500.0, -SPEED)].map(|(density, speed)| {
        let material = scene.add_material(LinearElastic::new(1e5, 0.3), density);
        let block = Shape::rectangle([0.2, 0.2], [0.4, 0.4]);
        let body = scene.add_body(block, material);
        body.with_velocity([speed, 0.0]).handle()
    });

    let drag = Drag {
        bodies: bodies.map(BodyHandle::place),
        rate: RATE,
    };
    let mut simulation = scene.simulate(&Options::default().with_interaction(drag))?;
    let [before, _, _] = simulation.momentum();
    simulation.run_until(scene.time)?;

    let [a, b] = bodies.map(|body| simulation.center(body).velocity[0]);
    let share = (a - b) / (2.0 * SPEED);
    let exact = (-RATE * simulation.velocity_time()).exp();
    let [after, _, _] = simulation.momentum();
    println!("relative velocity {share:.7} of that at the start, exactly {exact:.7}");
    assert!((share - exact).abs() < 1e-6, "{share} and {exact}");
    assert!((after / before - 1.0).abs() < 1e-12, "{before} and {after}");
    Ok(())
}

#[test]
fn runs() -> Result<(), Box<dyn Error>> {
    main()
}
