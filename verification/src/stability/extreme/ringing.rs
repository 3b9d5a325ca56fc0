//! Motions that the grid does not see: stresses that give no force, and cells that are crossed at a creep.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState, Simulation};
use proctor_scene::{
    DomainUpdate, ParticleSeed, PlaneCondition, Scene, Shape, StressScheme, Weighting,
};

use super::trial::{
    Kept, always, elastic, kept, noise, open, run_steps, run_to, start, step, worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "creeping-cells",
        what: "a stressed bar that creeps through a cell in 1e4 steps",
        required: "the noise of the stress by cell crossing told; of linear functions at least ten times that of GIMP",
        cause: None,
        judge: creeping,
    },
    Extreme {
        name: "null-space",
        what: "16 particles in a cell with stresses of alternating sign, which give no force at any node",
        required: "what the grid does not see stays as it is, and no energy comes of it",
        cause: None,
        judge: null_space,
    },
];

/// Root mean square of the stress less that at the start, over it, in a bar that creeps through a cell.
fn creep(weighting: Weighting, scheme: StressScheme) -> Result<f64, Unexpected> {
    const STEPS: u64 = 10_000;
    const STRESS: f64 = -1e-3;
    // Three columns of particles over two cells: the number in a cell changes as they move.
    const SPACING: f64 = 2.0 / 3.0;
    const LAYERS: u32 = 3;
    let bar = |speed: f64| {
        let mut scene = open([20, 2]);
        (scene.weighting, scene.scheme) = (weighting, scheme);
        scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
        let material = scene.add_material(elastic(1.0, 0.0), 1.0);
        // Ends that are driven keep the bar as long as it is.
        for columns in [5..15_u32, 0..5, 15..20] {
            let driven = columns.len() < 10;
            let seeds = columns.flat_map(|column| {
                (0..LAYERS).map(move |row| ParticleSeed {
                    position: [
                        2.0 + SPACING * (f64::from(column) + 0.5),
                        SPACING * (f64::from(row) + 0.5),
                        0.0,
                    ],
                    volume: SPACING * SPACING,
                })
            });
            let shape = Shape::Particles(Arc::new(seeds.collect()));
            let mut body = scene.add_body(shape, material);
            body.velocity = [speed, 0.0, 0.0];
            body.particles_per_cell = [1; 3];
            if driven {
                body.motion = Some(always([speed, 0.0, 0.0]));
            }
        }
        scene
    };
    let dt = step(&mut start(&bar(0.0), None)?, f64::INFINITY)?.dt;
    let speed = 1.0 / (STEPS as f64 * dt);
    let pressed: InitialField = Arc::new(move |_| InitialState {
        velocity: [speed, 0.0, 0.0],
        stress: [STRESS, 0.0, 0.0, 0.0, 0.0, 0.0],
        ..AT_REST
    });
    let mut simulation = start(&bar(speed), Some(pressed))?;
    let (mut squares, mut count) = (0.0, 0_u32);
    run_to(&mut simulation, 1.0 / speed, |s, info| {
        if info.step.is_multiple_of(10) {
            let set = &s.sets()[0];
            for p in 0..set.len() {
                squares += (set.stress(p)[0] / STRESS - 1.0).powi(2);
                count += 1;
            }
        }
    })?;
    Ok((squares / f64::from(count)).sqrt())
}

fn creeping() -> Result<Finding, Unexpected> {
    let (mut ratio, mut of_gimp, mut of_linear) = (f64::INFINITY, 0.0, f64::INFINITY);
    for scheme in [StressScheme::Usf, StressScheme::Musl] {
        let linear = creep(Weighting::Linear, scheme)?;
        for weighting in [
            Weighting::UniformGimp,
            Weighting::ContiguousGimp(DomainUpdate::Stretch),
        ] {
            let gimp = creep(weighting, scheme)?;
            of_gimp = worst(of_gimp, gimp);
            let own = linear / gimp;
            ratio = if own < ratio || own.is_nan() {
                own
            } else {
                ratio
            };
        }
        of_linear = of_linear.min(linear);
    }
    Ok(Finding {
        gates: vec![
            Gate::at_least(
                String::from(
                    "noise of the stress, root mean square, of linear functions over that of GIMP",
                ),
                ratio,
                10.0,
                "domains that fill the bar give a uniform stress no force inside it; points that cross a node do at once",
            ),
            Gate::at_most(
                String::from("noise with GIMP over the stress"),
                of_gimp,
                1e-3,
                "domains keep filling the bar but for its strain, which is 1e-3",
            ),
            Gate::at_least(
                String::from("noise with linear functions over the stress"),
                of_linear,
                0.01,
                "a point that crosses a node takes half of the force of two particles with it: without noise nothing crossed",
            ),
        ],
        refusals: vec![],
    })
}

/// Norm of what is left of the stresses along x less their means over each column of cells \[Pa\]: particles whose domains
/// lie within a cell feel one velocity gradient, and act on its nodes by the mean alone.
fn unseen(simulation: &Simulation, cells: usize) -> f64 {
    let set = &simulation.sets()[0];
    let mut by_cell = vec![vec![]; cells];
    for p in 0..set.len() {
        let cell = simulation.position(0, p)[0] as usize;
        by_cell[cell].push(set.stress(p)[0]);
    }
    let squares = by_cell.iter().map(|all| {
        let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
        all.iter().map(|s| (s - mean).powi(2)).sum::<f64>()
    });
    squares.sum::<f64>().sqrt()
}

/// Largest change of the norm of the stresses that no node sees, over it, in a bar of one row of cells.
fn change_of_unseen(weighting: Weighting, scheme: StressScheme) -> Result<f64, Unexpected> {
    const CELLS: usize = 8;
    let mut scene = open([CELLS, 1]).with_planes(PlaneCondition::Sliding);
    (scene.weighting, scene.scheme) = (weighting, scheme);
    let material = scene.add_material(elastic(1.0, 0.0), 1.0);
    scene
        .add_body(Shape::rectangle([0.0, 0.0], [CELLS as f64, 1.0]), material)
        .with_particles_per_cell([4, 4]);
    let wave = std::f64::consts::PI / CELLS as f64;
    let alternating: InitialField = Arc::new(move |x| {
        let quarter = (4.0 * x[0]) as i64;
        let sign = if quarter % 2 == 0 { 1.0 } else { -1.0 };
        InitialState {
            // A swing that the grid sees, beside what it does not.
            velocity: [1e-12 * libm::sin(wave * x[0]), 0.0, 0.0],
            stress: [1e-12 * sign, 0.0, 0.0, 0.0, 0.0, 0.0],
            ..AT_REST
        }
    });
    let mut simulation = start(&scene, Some(alternating))?;
    let before = unseen(&simulation, CELLS);
    let mut most = 0.0;
    run_steps(&mut simulation, 5000, |s, info| {
        if info.step.is_multiple_of(50) {
            most = worst(most, (unseen(s, CELLS) / before - 1.0).abs());
        }
    })?;
    Ok(most)
}

/// A free block of two dimensions with 16 particles in a cell whose stresses alternate and whose velocities are noise.
fn ringing(weighting: Weighting, scheme: StressScheme) -> Result<Kept, Unexpected> {
    let mut scene: Scene = open([8, 8]);
    (scene.weighting, scene.scheme) = (weighting, scheme);
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    scene
        .add_body(Shape::rectangle([2.6, 2.3], [4.6, 4.3]), material)
        .with_particles_per_cell([4, 4]);
    let rough: InitialField = Arc::new(|x| {
        let quarters = (4.0 * x[0]) as i64 + (4.0 * x[1]) as i64;
        let sign = if quarters % 2 == 0 { 1e-6 } else { -1e-6 };
        InitialState {
            velocity: [1e-7 * noise(x, 1), 1e-7 * noise(x, 2), 0.0],
            stress: [sign, sign, 0.0, 0.0, 0.0, sign],
            ..AT_REST
        }
    });
    let mut simulation = start(&scene, Some(rough))?;
    let mut balance = Kept::of(&simulation);
    run_steps(&mut simulation, 3000, |s, info| {
        if info.step.is_multiple_of(10) {
            balance.look(s);
        }
    })?;
    Ok(balance)
}

fn null_space() -> Result<Finding, Unexpected> {
    let [mut changed, mut drift, mut grown] = [0.0; 3];
    for scheme in SCHEMES {
        for weighting in [
            Weighting::Linear,
            Weighting::UniformGimp,
            Weighting::ContiguousGimp(DomainUpdate::Stretch),
            Weighting::QuadraticBSpline,
        ] {
            // B-splines see more than means, and linear functions have no safe step with USL.
            if weighting != Weighting::QuadraticBSpline {
                changed = worst(changed, change_of_unseen(weighting, scheme)?);
            }
            if weighting != Weighting::Linear {
                let balance = ringing(weighting, scheme)?;
                drift = worst(drift, balance.drift);
                grown = worst(grown, balance.grown);
            }
        }
    }
    let mut gates = vec![Gate::at_most(
        String::from("change of the stresses that no node sees, over their norm"),
        changed,
        1e-6,
        "particles in a cell feel one velocity gradient; a swing of 1e-11 of a cell takes that share of a domain across a face, in \
         each of 5000 steps",
    )];
    gates.extend(kept(
        "free block with stresses that alternate and noise",
        drift,
        grown,
    ));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
