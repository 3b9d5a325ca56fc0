//! Rotation by ten turns.

use std::f64::consts::TAU;
use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState, ResultWarning, Simulation};
use proctor_scene::{DomainUpdate, Scene, Shape, StressScheme, Transfer, TransferKind, Weighting};

use super::trial::{
    Kept, elastic, kept, of_case, off_by_a_quarter_turn, open, run_to, start, worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::{AT_REST, SHEAR_AND_TURN};
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "ten-turns",
        what: "a stressed block that is turned rigidly ten times, and a free disc that spins ten times",
        required: "the stress as its objective rate says; the disc grows by the centrifugal force alone, keeps its spin and is its own quarter turn",
        cause: None,
        judge: ten_turns,
    },
    Extreme {
        name: "ten-turns-flip",
        what: "a free disc of five cells that spins ten times with the default method, FLIP",
        required: "keeps nine tenths of its spin, or the run says how much of it is gone",
        cause: None,
        judge: ten_turns_flip,
    },
];

const RADIUS: f64 = 2.5;
const CENTER: f64 = 4.0;
const POISSON: f64 = 0.3;
/// Speed of the rim over sqrt(E/rho).
const RIM: f64 = 0.02;
const TURNS: f64 = 10.0;

/// A disc that spins about the middle of the mesh.
fn disc(weighting: Weighting, transfer: TransferKind) -> (Scene, InitialField) {
    let mut scene = open([8, 8]);
    scene.weighting = weighting;
    scene.transfer = Transfer::new(transfer);
    let material = scene.add_material(elastic(1.0, POISSON), 1.0);
    scene.add_body(Shape::disc([CENTER; 2], RADIUS), material);
    let omega = RIM / RADIUS;
    let spins: InitialField = Arc::new(move |x| InitialState {
        velocity: [-omega * (x[1] - CENTER), omega * (x[0] - CENTER), 0.0],
        velocity_gradient: [[0.0, -omega, 0.0], [omega, 0.0, 0.0], [0.0; 3]],
        ..AT_REST
    });
    (scene, spins)
}

fn area(simulation: &Simulation) -> f64 {
    let all = 0..simulation.particles();
    all.map(|p| simulation.particle_volume(0, p)).sum()
}

/// Angular momentum about the middle, that of affine velocities with it, whose moment of inertia with quadratic B-splines
/// is m h²/4 \[kg m²/s\].
fn angular_momentum(simulation: &Simulation) -> f64 {
    let set = &simulation.sets()[0];
    let of = |p: usize| {
        let m = simulation.particle_mass(0, p);
        let (x, v) = (simulation.position(0, p), set.velocity(p));
        let affine = set.layout.affine.map_or(0.0, |first| {
            set.columns[first + 2][p] - set.columns[first + 1][p]
        });
        m * ((x[0] - CENTER) * v[1] - (x[1] - CENTER) * v[0] + 0.25 * affine)
    };
    (0..set.len()).map(of).sum()
}

fn ten_turns() -> Result<Finding, Unexpected> {
    let time = TURNS * TAU * RADIUS / RIM;
    // In plane strain the mean of sigma_rr + sigma_tt is rho (omega R)²/2.
    let centrifugal = (1.0 + POISSON) * (1.0 - 2.0 * POISSON) * RIM * RIM / 2.0;
    let [mut spin, mut drift, mut grown, mut wide, mut skew] = [0.0; 5];
    for scheme in SCHEMES {
        for (weighting, transfer) in [
            (Weighting::QuadraticBSpline, TransferKind::Apic),
            (
                Weighting::ContiguousGimp(DomainUpdate::LeftStretch),
                TransferKind::Apic,
            ),
        ] {
            let (mut scene, spins) = disc(weighting, transfer);
            scene.scheme = scheme;
            let mut simulation = start(&scene, Some(spins))?;
            let (before, whole) = (angular_momentum(&simulation), area(&simulation));
            let mut balance = Kept::of(&simulation);
            let counted = weighting == Weighting::QuadraticBSpline && scheme != StressScheme::Usf;
            run_to(&mut simulation, time, |s, info| {
                if info.step.is_multiple_of(20) {
                    balance.look(s);
                    wide = worst(wide, (area(s) / whole - 1.0) / centrifugal);
                    if counted {
                        spin = worst(spin, (angular_momentum(s) / before - 1.0).abs());
                    }
                }
            })?;
            skew = worst(skew, off_by_a_quarter_turn(&simulation, [CENTER; 2], 1.0));
            drift = worst(drift, balance.drift);
            grown = worst(grown, balance.grown);
        }
    }
    let mut gates = of_case(&SHEAR_AND_TURN)?;
    gates.extend(kept("free disc", drift, grown));
    gates.extend([
        Gate::at_most(
            String::from("free disc: angular momentum with B-splines and APIC, change over it"),
            spin,
            1e-10,
            "nodes exert no torque on each other, and APIC takes all that they have; round-off of 2e4 steps",
        ),
        Gate::at_most(
            String::from("free disc: a quarter turn of it against itself, over a cell"),
            skew,
            1e-8,
            "disc and mesh are the same after a quarter turn; round-off of 2e4 steps, which the turns carry along",
        ),
        Gate::at_most(
            String::from("free disc: largest growth of the area over the centrifugal one"),
            wide,
            2.5,
            "applied at once it swings to twice the growth at rest, and a quarter for a rim of cells; each step taken along its \
             chord would add 1e3 times as much in ten turns",
        ),
    ]);
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

fn ten_turns_flip() -> Result<Finding, Unexpected> {
    let time = TURNS * TAU * RADIUS / RIM;
    let mut unsaid = 0.0;
    for scheme in SCHEMES {
        let (mut scene, spins) = disc(Weighting::UniformGimp, TransferKind::Flip);
        scene.scheme = scheme;
        let mut simulation = start(&scene, Some(spins))?;
        let before = angular_momentum(&simulation);
        for turn in 1..=10 {
            run_to(&mut simulation, 0.1 * f64::from(turn) * time, |_, _| ())?;
        }
        let energy = simulation.energy();
        let cautions = simulation.cautions(&energy);
        let said = cautions
            .iter()
            .any(|caution| matches!(caution, ResultWarning::Spin { .. }));
        if simulation.invariants().violation.is_none() && !said {
            let lost = (angular_momentum(&simulation) / before - 1.0).abs();
            unsaid = worst(unsaid, lost);
        }
    }
    Ok(Finding {
        gates: vec![Gate::at_most(
            String::from("angular momentum lost in ten turns of which nothing was said"),
            unsaid,
            0.1,
            "nothing turns a free disc; a tenth is what a user may call the same",
        )],
        refusals: vec![],
    })
}
