//! The bounce as other solvers run it: the energy that they have after it, read off a frame.

use crate::cases::prelude::*;

use super::{GRAVITY, MATERIAL, VELOCITY, scene, wave_speed};

/// The number that is reported.
const KEPT: &str = "energy after the bounce over the initial";

/// The smooth terrain of the study, with the frame of the end. Frames hold displacement, velocity and stress, of which an energy
/// is made. Velocities may be half a step off, in which gravity changes the energy by 3e-4.
pub fn bounced(rung: &Rung) -> Guest {
    let scene = scene(rung, &guest::settings(), Reference::CORRECT);
    let step = guest::COURANT * rung.cell / wave_speed();
    let mut scene = guest::prepared(scene, 1, step);
    scene.results.fields.push(Field::Stress);
    let source = "a smooth terrain takes no energy";
    Guest {
        compared: ComparedField::Velocity,
        reading: Some(Reading::new(KEPT, 1.0, source, |frames| {
            frames.last().map_or(f64::NAN, kept)
        })),
        ..Guest::new(scene, |_, _| [0.0; 3]).at_the_end()
    }
}

/// Energy of a frame over that of its start, both per mass: all particles have one mass.
fn kept(frame: &Snapshot) -> f64 {
    let squares = |v: &Vector| v.iter().map(|v| v * v).sum::<f64>();
    let heights: f64 = frame.starts.iter().map(|x| x[2]).sum();
    let start = 0.5 * squares(&VELOCITY) * frame.starts.len() as f64 + GRAVITY * heights;
    let sunk: f64 = frame.displacements.iter().map(|u| u[2]).sum();
    let moving: f64 = frame.values.iter().map(|v| 0.5 * squares(v)).sum();
    // A frame without stresses has no energy.
    let strained = if frame.stresses.is_empty() {
        f64::NAN
    } else {
        frame.stresses.iter().map(strain_energy).sum::<f64>() / MATERIAL[0]
    };
    (moving + strained + GRAVITY * (heights + sunk)) / start
}

/// Strain energy per volume \[J/m³\] of a stress \[Pa: xx, yy, zz, yz, xz, xy\] by Hooke's law.
fn strain_energy([xx, yy, zz, yz, xz, xy]: &[f64; 6]) -> f64 {
    let [_, young, poisson] = MATERIAL;
    let squares = [xx, yy, zz].map(|s| s * s).iter().sum::<f64>()
        + 2.0 * [yz, xz, xy].map(|s| s * s).iter().sum::<f64>();
    let trace = xx + yy + zz;
    ((1.0 + poisson) * squares - poisson * trace * trace) / (2.0 * young)
}
