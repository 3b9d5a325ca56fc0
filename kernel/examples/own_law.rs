//! A law of one's own with an internal variable: a Maxwell solid, whose shear stress relaxes with time.
//!
//! `check_law` looks at the law alone, then a block fills its mesh between fixed walls, under a stress that is the same
//! everywhere. Nothing moves, and the deviator decays as exp(-t/tau). The energy that it loses is kept by each particle.

use proctor_scene::prelude::*;
use std::error::Error;

const YOUNG: f64 = 1.0e6;
const POISSON: f64 = 0.25;
const DENSITY: f64 = 1000.0;
/// Relaxation time, tau [s].
const TAU: f64 = 0.02;
const END: f64 = 0.03;
/// Initial stress: normal, and in-plane shear [Pa].
const NORMAL: f64 = 2.0e3;
const SHEAR: f64 = 3.0e3;

/// Linear elasticity, its shear in series with a dashpot: s' = 2 G d - s/tau for the deviator s.
#[derive(Debug, PartialEq)]
struct Maxwell {
    elastic: LinearElastic,
    /// tau [s].
    relaxation_time: f64,
}

impl Maxwell {
    fn new() -> Self {
        Self {
            elastic: LinearElastic::new(YOUNG, POISSON),
            relaxation_time: TAU,
        }
    }
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
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let speed_squared = self.elastic.update(increment, stress, &mut []);
        let decay = libm::exp(-increment.dt / self.relaxation_time);
        let trace = stress[Component::XX] + stress[Component::YY] + stress[Component::ZZ];
        let mean = trace * L::splat(1.0 / 3.0);
        // s : s, each shear component counted twice.
        let mut square = L::splat(0.0);
        for component in Component::ALL {
            let (mean, times) = if component.is_normal() {
                (mean, 1.0)
            } else {
                (L::splat(0.0), 2.0)
            };
            let s = stress[component] - mean;
            square = (s * L::splat(times)).mul_add(s, square);
            stress[component] = s * L::splat(decay) + mean;
        }
        let lost = (1.0 - decay * decay) / (4.0 * self.elastic.elasticity().shear);
        variables[0] = square.mul_add(L::splat(lost), variables[0]);
        speed_squared
    }

    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.elastic.energy(particle)
    }
}

/// Factor of the deviator at the end.
fn decay() -> f64 {
    (-END / TAU).exp()
}

fn main() -> Result<(), Box<dyn Error>> {
    check_law(Maxwell::new(), DENSITY)?;
    material_point()?;
    block()
}

/// One material point without a grid, held still.
fn material_point() -> Result<(), Box<dyn Error>> {
    let stress = InitialState::default().with_stress(Component::XY, SHEAR);
    let mut point = Point::new(&Maxwell::new().into(), DENSITY, stress.stress);
    for _ in 0..30 {
        point.strain(&[0.0; 6], END / 30.0)?;
    }
    let error = (point.stress()[Component::XY.place()] / (SHEAR * decay()) - 1.0).abs();
    println!("at a point the shear stress is off by {error:.1e}");
    assert!(error < 1e-12);
    Ok(())
}

/// A block of such material.
fn block() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::plane([4, 4], 0.25).with_planes(PlaneCondition::Fixed);
    let material = scene.add_material(Maxwell::new(), DENSITY);
    let square = Shape::rectangle([0.0, 0.0], [1.0, 1.0]);
    let block = scene.add_body(square, material).handle();
    let options = Options::default().with_initial(|_| {
        InitialState::default()
            .with_stress(Component::XX, NORMAL)
            .with_stress(Component::YY, -NORMAL)
            .with_stress(Component::XY, SHEAR)
    });
    let mut simulation = scene.simulate(&options)?;
    simulation.run_until(END)?;

    let square = 2.0 * (NORMAL * NORMAL + SHEAR * SHEAR);
    let shear_modulus = Maxwell::new().elastic.elasticity().shear;
    let exact = square * (1.0 - decay() * decay()) / (4.0 * shear_modulus);
    let particles = simulation.particles_of(block);
    let dissipated = particles
        .column("dissipated energy")
        .ok_or("a variable of the law")?;
    let (mut of_stress, mut of_energy) = (0.0_f64, 0.0_f64);
    for (p, energy) in dissipated.iter().enumerate() {
        let shear = particles.stress(p)[Component::XY.place()];
        of_stress = of_stress.max((shear / (SHEAR * decay()) - 1.0).abs());
        of_energy = of_energy.max((energy / exact - 1.0).abs());
    }
    // The balance of energy lacks what the particles dissipated, over an area of 1 m².
    let balance = (simulation.energy().dissipated / exact - 1.0).abs();
    println!(
        "in a block the shear stress is off by {of_stress:.1e}, dissipated energy by {of_energy:.1e}, its balance by {balance:.1e}"
    );
    assert!(of_stress < 1e-12 && of_energy < 1e-12 && balance < 1e-12);
    Ok(())
}

#[test]
fn the_law_holds_what_every_law_must() -> Result<(), Box<dyn Error>> {
    check_law(Maxwell::new(), DENSITY)?;
    Ok(())
}

#[test]
fn the_deviator_decays_as_it_should() -> Result<(), Box<dyn Error>> {
    material_point()?;
    block()
}
