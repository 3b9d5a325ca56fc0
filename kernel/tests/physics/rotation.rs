//! A disc that spins: its area must not grow with the number of steps.

use crate::common::{
    APIC, FLIP, SCHEMES, TPIC, body, elastic, empty, material, run_towards, simulation_from,
};
use proctor_scene::simulation::{InitialState, Simulation};
use proctor_scene::{Dimension, DomainUpdate, Shape, StressScheme, Transfer, Weighting};
use std::f64::consts::TAU;
use std::sync::Arc;

const RADIUS: f64 = 0.5;
const YOUNG: f64 = 1.0e6;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0;
/// One turn per second \[1/s\].
const OMEGA: f64 = TAU;

/// A disc that spins.
fn spinning(weighting: Weighting, scheme: StressScheme, transfer: Transfer) -> Simulation {
    let mut scene = empty(Dimension::Two, [14, 14, 1], 0.1);
    let center = [0.7, 0.7, 0.0];
    scene.weighting = weighting;
    scene.scheme = scheme;
    scene.transfer = transfer;
    scene.materials = vec![material(elastic(YOUNG, POISSON))];
    scene.bodies = vec![body(
        1,
        Shape::Sphere {
            center,
            radius: RADIUS,
        },
    )];
    scene.bodies[0].particles_per_cell = [3, 3, 1];
    simulation_from(
        &scene,
        Arc::new(move |x| InitialState {
            velocity: [-OMEGA * (x[1] - center[1]), OMEGA * (x[0] - center[0]), 0.0],
            velocity_gradient: [[0.0, -OMEGA, 0.0], [OMEGA, 0.0, 0.0], [0.0; 3]],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }),
    )
}

const CPGIMP: Weighting = Weighting::ContiguousGimp(DomainUpdate::LeftStretch);

/// Energy that a disc has gained in so many turns, as a share of the kinetic energy that it began with.
fn gained(weighting: Weighting, scheme: StressScheme, transfer: Transfer, turns: f64) -> f64 {
    let mut simulation = spinning(weighting, scheme, transfer);
    let before = simulation.kinetic_energy();
    while simulation.time() < turns {
        run_towards(&mut simulation, 1, turns);
    }
    (simulation.kinetic_energy() + simulation.strain_energy()) / before - 1.0
}

/// The plan says how much; nobody knows a cure, so that it must be said. In three turns it is 61 % with uGIMP and 7 % with
/// B-splines, and with MUSL 5 %.
#[test]
fn flip_with_usf_gains_energy_and_the_plan_says_so() {
    let usf = StressScheme::Usf;
    let flip = gained(Weighting::UniformGimp, usf, FLIP, 3.0);
    assert!((0.5..0.7).contains(&flip), "{flip}");
    let splines = gained(Weighting::QuadraticBSpline, usf, FLIP, 3.0);
    assert!((0.05..0.08).contains(&splines), "{splines}");
    for transfer in [APIC, TPIC] {
        let others = gained(Weighting::UniformGimp, usf, transfer, 3.0);
        assert!(others < 0.001, "{transfer:?}: {others}");
    }
    let usl = gained(Weighting::UniformGimp, StressScheme::Usl, FLIP, 3.0);
    assert!(usl < 0.001, "{usl}");
    for (scheme, transfer) in [(usf, FLIP), (usf, APIC), (StressScheme::Usl, FLIP)] {
        let simulation = spinning(Weighting::UniformGimp, scheme, transfer);
        let warned = simulation.plan().warnings.iter().any(|w| w.contains("USF"));
        assert_eq!(warned, (scheme, transfer) == (usf, FLIP));
    }
}

/// Sum of the volumes, which are V_0 det F.
fn area(simulation: &Simulation) -> f64 {
    (0..simulation.particles())
        .map(|p| simulation.particle_volume(0, p))
        .sum()
}

/// Growth by the centrifugal force, from the virial of the motion: the mean of sigma_rr + sigma_tt is rho (omega R)²/2,
/// and in plane strain the area grows by (1 + nu)(1 - 2 nu)/E of it. It is applied suddenly, so the disc swings
/// between nothing and twice that. F <- (1 + dt L) F with the spin of the particles, as eq. 11 of Liang et al. 2024
/// prints, would grow by omega² dt t on top: 5 % to 15 % here.
#[test]
fn the_area_of_a_spinning_disc_grows_by_the_centrifugal_force_alone() {
    let centrifugal = (1.0 + POISSON) * (1.0 - 2.0 * POISSON) * DENSITY * (OMEGA * RADIUS).powi(2)
        / (2.0 * YOUNG);
    for scheme in SCHEMES {
        let mut simulation = spinning(CPGIMP, scheme, APIC);
        let before = area(&simulation);
        let (mut sum, mut count, mut largest, mut inflation) = (0.0, 0, 0.0_f64, 0.0);
        while simulation.time() < 1.0 {
            let time = simulation.time();
            run_towards(&mut simulation, 1, 1.0);
            let growth = area(&simulation) / before - 1.0;
            sum += growth;
            count += 1;
            largest = largest.max(growth);
            inflation += OMEGA * OMEGA * (simulation.time() - time).powi(2);
        }
        let mean = sum / f64::from(count);
        assert!(inflation > 0.025, "{scheme:?} {inflation}");
        // Half of the centrifugal growth for what the cells do to it; a tenth of what the printed update adds.
        assert!(
            (mean - centrifugal).abs() < 0.5 * centrifugal,
            "{scheme:?}: mean {mean}, exact {centrifugal}, printed update {inflation}"
        );
        assert!(largest < 2.5 * centrifugal, "{scheme:?}: {largest}");
    }
}
