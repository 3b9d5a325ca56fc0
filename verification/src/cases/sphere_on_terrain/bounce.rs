//! The bounce as other solvers run it: the energy that they have after it, read off a frame.

use crate::cases::prelude::*;

use super::{CENTER, GRAVITY, MATERIAL, RADIUS, VELOCITY, scene, wave_speed};

/// The number that is reported.
const KEPT: &str = "energy after the bounce over the initial";

/// The smooth terrain of the study, with the frame of the end. Frames hold displacement, velocity and stress, of which
/// an energy is made. Velocities may be half a step off, in which gravity changes the energy by 3e-4.
pub fn bounced(rung: &Rung) -> Guest {
    let settings = guest::settings();
    let mut scene = scene(rung, &settings, Reference::CORRECT);
    scene.bodies = rows(rung.cell / settings.particles_per_cell as f64);
    for body in &mut scene.bodies {
        body.particles_per_cell = [settings.particles_per_cell; 3];
    }
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

/// The sphere as rows of particles with a spacing \[m\], each a body: programs fill a sphere in ways of their own, and
/// a cuboid in one. Without contact bodies share one velocity field.
fn rows(spacing: f64) -> Vec<Body> {
    let middle = |i: i64| (i as f64 + 0.5) * spacing;
    let around = |axis: usize| {
        let [first, last] = [-RADIUS, RADIUS].map(|away| (CENTER[axis] + away) / spacing);
        first.floor() as i64..=last.floor() as i64
    };
    let mut all = vec![];
    for j in around(1) {
        for k in around(2) {
            let across = (middle(j) - CENTER[1]).powi(2) + (middle(k) - CENTER[2]).powi(2);
            let is_inside = |i: &i64| across + (middle(*i) - CENTER[0]).powi(2) < RADIUS * RADIUS;
            let inside: Vec<i64> = around(0).filter(is_inside).collect();
            if let (Some(first), Some(last)) = (inside.first(), inside.last()) {
                let low = [*first, j, k].map(|i| i as f64 * spacing);
                let high = [last + 1, j + 1, k + 1].map(|i| i as f64 * spacing);
                let number = all.len() as i64 + 1;
                all.push(Body {
                    velocity: VELOCITY,
                    ..body(format!("row {number}"), number, cuboid(low, high))
                });
            }
        }
    }
    all
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
