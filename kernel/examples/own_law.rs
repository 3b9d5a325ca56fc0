//! A law of one's own with an internal variable: a Maxwell solid, whose shear stress relaxes with time.
//!
//! A block fills its mesh between fixed walls, under a stress that is the same everywhere, so nothing moves and the
//! deviator decays as exp(-t/tau). The energy that it loses is kept by each particle.

use proctor_scene::prelude::*;
use std::sync::Arc;

/// Linear elasticity, its shear in series with a dashpot: s' = 2 G d - s/tau for the deviator s.
#[derive(Debug, PartialEq)]
struct Maxwell {
    elastic: LinearElastic,
    /// tau [s].
    relaxation_time: f64,
}

impl Law for Maxwell {
    const VARIABLES: &'static [Variable] = &[Variable::scalar("dissipated energy", "J/m³")];

    fn name(&self) -> &'static str {
        "maxwell"
    }

    fn young(&self) -> f64 {
        self.elastic.young()
    }

    fn wave_speed(&self, density: f64) -> f64 {
        self.elastic.wave_speed(density)
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut [L; 6],
        variables: &mut [L],
    ) -> L {
        let speed_squared = self.elastic.update::<L, D>(increment, stress, &mut []);
        let decay = libm::exp(-increment.dt / self.relaxation_time);
        let mean = (stress[0] + stress[1] + stress[2]) * L::splat(1.0 / 3.0);
        // s : s, each shear component counted twice.
        let mut square = L::splat(0.0);
        for (i, component) in stress.iter_mut().enumerate() {
            let normal = i < 3;
            let s = if normal {
                *component - mean
            } else {
                *component
            };
            square = (s * L::splat(if normal { 1.0 } else { 2.0 })).mul_add(s, square);
            let relaxed = s * L::splat(decay);
            *component = if normal { relaxed + mean } else { relaxed };
        }
        let lost = (1.0 - decay * decay) / (4.0 * self.elastic.elasticity().shear);
        variables[0] = square.mul_add(L::splat(lost), variables[0]);
        speed_squared
    }

    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.elastic.energy(particle)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    const TAU: f64 = 0.02;
    const END: f64 = 0.03;
    let elastic = LinearElastic::new(1.0e6, 0.25);
    let (normal, shear) = (2.0e3, 3.0e3);

    let mut scene = Scene::plane([4, 4], 0.25).with_planes(PlaneCondition::Fixed);
    let material = scene.add_material(
        Maxwell {
            elastic,
            relaxation_time: TAU,
        },
        1000.0,
    );
    scene.add_body(Shape::rectangle([0.0, 0.0], [1.0, 1.0]), material);
    let mut simulation = scene.simulate(&Options {
        initial: Some(Arc::new(move |_| InitialState {
            stress: [normal, -normal, 0.0, 0.0, 0.0, shear],
            ..InitialState::default()
        })),
        ..Options::default()
    })?;
    while simulation.time() < END {
        simulation.step(END)?;
    }

    let decay = (-END / TAU).exp();
    let square = 2.0 * (normal * normal + shear * shear);
    let exact = square * (1.0 - decay * decay) / (4.0 * elastic.elasticity().shear);
    let set = &simulation.sets()[0];
    let dissipated = set
        .column("dissipated energy")
        .ok_or("a variable of the law")?;
    let (mut of_stress, mut of_energy) = (0.0_f64, 0.0_f64);
    for (p, energy) in dissipated.iter().enumerate() {
        of_stress = of_stress.max((set.stress(p)[5] / (shear * decay) - 1.0).abs());
        of_energy = of_energy.max((energy / exact - 1.0).abs());
    }
    // What the balance of energy lacks is what the particles say that they lost, over an area of 1 m².
    let balance = (simulation.energy().dissipated / exact - 1.0).abs();
    println!(
        "shear stress off by {of_stress:.1e}, dissipated energy by {of_energy:.1e}, its balance by {balance:.1e}"
    );
    assert!(of_stress < 1e-12 && of_energy < 1e-12 && balance < 1e-12);
    Ok(())
}

#[test]
fn the_deviator_decays_as_it_should() -> Result<(), Box<dyn std::error::Error>> {
    main()
}
