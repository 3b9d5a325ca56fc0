//! Rotation by ten turns.

use super::prelude::*;
use crate::cases::SHEAR_AND_TURN;
use proctor_scene::simulation::ResultWarning;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("ten-turns", ten_turns)
        .with("a stressed block that is turned rigidly ten times, and a free disc that spins ten times")
        .must("the stress as its objective rate says; the disc grows by the centrifugal force alone, keeps its spin and is its own quarter turn"),
    Extreme::of("ten-turns-flip", ten_turns_flip)
        .with("a free disc of five cells that spins ten times with the default method, FLIP")
        .must("keeps nine tenths of its spin, or the run says how much of it is gone"),
];

const RADIUS: f64 = 2.5;
const CENTER: f64 = 4.0;
const POISSON: f64 = 0.3;
/// Speed of the rim over sqrt(E/rho).
const RIM: f64 = 0.02;
/// Time of ten turns \[s\].
const TIME: f64 = 10.0 * TAU * RADIUS / RIM;

/// A disc that spins about the middle of the mesh.
fn disc(transfer: TransferKind) -> Scene {
    let disc = Shape::disc([CENTER; 2], RADIUS);
    alone([8, 8], disc, elastic(1.0, POISSON)).with_transfer(Transfer::new(transfer))
}

/// Its start.
fn spins() -> Options {
    let omega = RIM / RADIUS;
    let spin = [[0.0, -omega, 0.0], [omega, 0.0, 0.0], [0.0; 3]];
    from(move |x| {
        let [a, b] = [x[0] - CENTER, x[1] - CENTER];
        moving([-omega * b, omega * a, 0.0], spin)
    })
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

fn ten_turns() -> RowVerdict {
    // In plane strain the mean of sigma_rr + sigma_tt is rho (omega R)²/2.
    let centrifugal = (1.0 + POISSON) * (1.0 - 2.0 * POISSON) * RIM * RIM / 2.0;
    let mut spin = gate("free disc: angular momentum with B-splines and APIC, change over it")
        .at_most(1e-10, "nodes exert no torque on each other, and APIC takes all that they have; round-off of 2e4 steps");
    let mut wide = gate("free disc: largest growth of the area over the centrifugal one")
        .at_most(2.5, "applied at once it swings to twice the growth at rest, and a quarter for a rim of cells; each step taken along its \
             chord would add 1e3 times as much in ten turns");
    let mut skew = gate("free disc: a quarter turn of it against itself, over a cell")
        .at_most(1e-8, "disc and mesh are the same after a quarter turn; round-off of 2e4 steps, which the turns carry along");
    let mut kept = Conservation::named("free disc");
    let area = |simulation: &Simulation| sum(simulation, |seen| seen.volume);
    let left = Weighting::ContiguousGimp(DomainUpdate::LeftStretch);
    let weightings = [Weighting::QuadraticBSpline, left];
    for scene in each_scheme(&disc(TransferKind::Apic), &weightings) {
        let mut simulation = kept.start(&scene, &spins())?;
        let (before, whole) = (angular_momentum(&simulation), area(&simulation));
        let counted = scene.weighting != left && scene.scheme != StressScheme::Usf;
        run_to(&mut simulation, TIME, |s, info| {
            if info.step.is_multiple_of(20) {
                kept.look(s);
                wide.see((area(s) / whole - 1.0) / centrifugal);
                if counted {
                    spin.see((angular_momentum(s) / before - 1.0).abs());
                }
            }
        })?;
        skew.see(off_by_a_quarter_turn(&simulation, [CENTER; 2], 1.0));
    }
    let turned = Finding::of(of_case(&SHEAR_AND_TURN)?);
    Ok(turned.and(kept.gates()).and([spin, skew, wide]))
}

fn ten_turns_flip() -> RowVerdict {
    let mut unsaid = gate("angular momentum lost in ten turns of which nothing was said").at_most(
        0.1,
        "nothing turns a free disc; a tenth is what a user may call the same",
    );
    for scene in with_schemes(&disc(TransferKind::Flip)) {
        let mut simulation = start(&scene, &spins())?;
        let before = angular_momentum(&simulation);
        for turn in 1..=10 {
            to_time(&mut simulation, 0.1 * f64::from(turn) * TIME)?;
        }
        let energy = simulation.energy();
        let cautions = simulation.cautions(&energy);
        let mut cautions = cautions.iter();
        let said = cautions.any(|caution| matches!(caution, ResultWarning::Spin { .. }));
        if simulation.invariants().violation.is_none() && !said {
            unsaid.see((angular_momentum(&simulation) / before - 1.0).abs());
        }
    }
    Ok(Finding::of([unsaid]))
}
