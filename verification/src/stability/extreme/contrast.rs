//! Stiff beside soft and heavy beside light.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{DomainUpdate, PlaneCondition, Scene, Shape, Weighting};

use super::trial::{
    Kept, ROUND_OFF, STEP_OF_FASTEST, elastic, kept, open, run_steps, run_to, start, step, worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::exact::sudden_weight::SuddenWeight;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "stiffness-contrast",
        what: "a soft layer on one that is 1e6 times as stiff",
        required: "the step from the stiff layer; the stress under its weight exact; the soft layer as good as alone, times two",
        cause: None,
        judge: stiffness,
    },
    Extreme {
        name: "density-contrast",
        what: "a light bar at the end of one that is 1e6 times as dense",
        required: "the step from the wave speed of each particle; momentum to round-off; the light bar swings as a clamped one",
        cause: None,
        judge: density,
    },
    Extreme {
        name: "contrast-of-both",
        what: "layers and quarters with stiffness 1 and 1e9 and density 1 and 1e6 in one scene",
        required: "the stress under the weight exact; momentum to round-off, no growth of energy",
        cause: None,
        judge: both,
    },
];

/// Weighting functions with which particles that fill their cells carry a linear stress exactly.
const EXACT: [Weighting; 3] = [
    Weighting::Linear,
    Weighting::UniformGimp,
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
];
/// Weighting functions with a stable step for every body.
const SAFE: [Weighting; 3] = [EXACT[1], EXACT[2], Weighting::QuadraticBSpline];
/// Steps of a column that should stand still.
const STANDS: u64 = 1000;
/// Largest error of a stress that is carried exactly, over the largest stress: round-off of many steps, in stresses and
/// densities that differ by nine digits.
const STANDS_TO: f64 = 1e-10;
/// Why it stands.
const IN_BALANCE: &str = "particles that fill their cells carry a stress that is linear in each layer exactly; round-off alone moves them";

/// A layer of a column: its height in cells, Young's modulus \[Pa\] and density \[kg/m³\].
type Layer = (usize, f64, f64);

/// A column one cell wide under its weight, its layers from below; Poisson's ratio is zero.
fn column(layers: &[Layer], gravity: f64) -> Scene {
    let height: usize = layers.iter().map(|layer| layer.0).sum();
    let mut scene = open([1, height + 2]).with_gravity([0.0, -gravity, 0.0]);
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    let mut below = 0.0;
    for &(cells, young, density) in layers {
        let above = below + cells as f64;
        let material = scene.add_material(elastic(young, 0.0), density);
        scene.add_body(Shape::rectangle([0.0, below], [1.0, above]), material);
        below = above;
    }
    scene
}

/// Vertical stress under the weight of what lies above a height \[Pa\].
fn carried(layers: &[Layer], gravity: f64, y: f64) -> f64 {
    let (mut below, mut stress) = (0.0, 0.0);
    for &(cells, _, density) in layers {
        let above = below + cells as f64;
        stress -= density * gravity * (above - y.max(below)).max(0.0);
        below = above;
    }
    stress
}

/// Largest error of the stress in a column that starts in balance, over that at its base: the worst over methods.
fn error_of_a_standing_column(layers: &'static [Layer], gravity: f64) -> Result<f64, Unexpected> {
    let mut most = 0.0;
    for weighting in EXACT {
        for scheme in SCHEMES {
            let mut scene = column(layers, gravity);
            (scene.weighting, scene.scheme) = (weighting, scheme);
            let settled: InitialField = Arc::new(move |x| InitialState {
                stress: [0.0, carried(layers, gravity, x[1]), 0.0, 0.0, 0.0, 0.0],
                ..AT_REST
            });
            let mut simulation = start(&scene, Some(settled))?;
            run_steps(&mut simulation, STANDS, |_, _| ())?;
            for (index, set) in simulation.sets().iter().enumerate() {
                for p in 0..set.len() {
                    let y = simulation.position(index, p)[1];
                    let off = set.stress(p)[1] - carried(layers, gravity, y);
                    most = worst(most, (off / carried(layers, gravity, 0.0)).abs());
                }
            }
        }
    }
    Ok(most)
}

/// The critical step of a scene at rest over C h/c, less one.
fn error_of_the_step(scene: &Scene, wave_speed: f64) -> Result<f64, Unexpected> {
    let mut simulation = start(scene, None)?;
    let number = simulation.stability_number();
    let found = step(&mut simulation, f64::INFINITY)?.dt_critical;
    Ok((found * wave_speed / number - 1.0).abs())
}

fn stiffness() -> Result<Finding, Unexpected> {
    const LAYERS: &[Layer] = &[(4, 1e6, 1.0), (8, 1.0, 1.0)];
    const GRAVITY: f64 = 1e-6;
    let exact = SuddenWeight {
        height: 8.0,
        wave_speed: 1.0,
        gravity: GRAVITY,
    };
    // While the front from the base is on its way up, over the largest stress.
    let end = 0.75 * exact.height;
    let error = |layers: &[Layer], scheme, base: f64| -> Result<f64, Unexpected> {
        let mut scene = column(layers, GRAVITY);
        scene.scheme = scheme;
        let mut simulation = start(&scene, None)?;
        run_to(&mut simulation, end, |_, _| ())?;
        let index = layers.len() - 1;
        let set = &simulation.sets()[index];
        let squares = (0..set.len()).map(|p| {
            let y = simulation.position(index, p)[1] - base;
            (set.stress(p)[1] - exact.stress(y, end, 1.0)).powi(2)
        });
        let scale = GRAVITY * exact.height;
        Ok((squares.sum::<f64>() / set.len() as f64).sqrt() / scale)
    };
    let mut ratio = 0.0;
    for scheme in SCHEMES {
        let own = error(&LAYERS[1..], scheme, 0.0)?;
        ratio = worst(ratio, error(LAYERS, scheme, 4.0)? / own);
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                String::from("critical step against that of the stiff layer"),
                error_of_the_step(&column(LAYERS, 0.0), 1e3)?,
                ROUND_OFF,
                STEP_OF_FASTEST,
            ),
            Gate::at_most(
                String::from("stress of the standing column, over that at its base"),
                error_of_a_standing_column(LAYERS, GRAVITY)?,
                STANDS_TO,
                IN_BALANCE,
            ),
            Gate::at_most(
                String::from("error of the suddenly loaded soft layer over that of its own run"),
                ratio,
                2.0,
                "what is 1e6 times as stiff is a rigid base, so that nothing but the shorter step differs",
            ),
        ],
        refusals: vec![],
    })
}

fn density() -> Result<Finding, Unexpected> {
    const HEAVY: f64 = 4.0;
    const LIGHT: f64 = 8.0;
    const SPEED: f64 = 1e-4;
    let bar = || {
        let mut scene = open([16, 1]);
        scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
        let heavy = scene.add_material(elastic(1.0, 0.0), 1e6);
        let light = scene.add_material(elastic(1.0, 0.0), 1.0);
        let ends = [2.0, 2.0 + HEAVY, 2.0 + HEAVY + LIGHT];
        scene.add_body(Shape::rectangle([ends[0], 0.0], [ends[1], 1.0]), heavy);
        scene.add_body(Shape::rectangle([ends[1], 0.0], [ends[2], 1.0]), light);
        scene
    };
    let wave = std::f64::consts::FRAC_PI_2 / LIGHT;
    let swings: InitialField = Arc::new(move |x| InitialState {
        velocity: [
            SPEED * libm::sin(wave * (x[0] - 2.0 - HEAVY).max(0.0)),
            0.0,
            0.0,
        ],
        ..AT_REST
    });
    let [mut off, mut smeared, mut drift, mut grown] = [0.0; 4];
    for weighting in SAFE {
        for scheme in SCHEMES {
            let mut scene = bar();
            (scene.weighting, scene.scheme) = (weighting, scheme);
            let mut simulation = start(&scene, Some(swings.clone()))?;
            let mut balance = Kept::of(&simulation);
            let from = simulation.center(1).position[0];
            run_to(&mut simulation, LIGHT, |s, _| balance.look(s))?;
            // A quarter of the period: the mean of SPEED sin(k x)/(k c).
            let exact = SPEED / wave * std::f64::consts::FRAC_2_PI;
            let moved = simulation.center(1).position[0] - from;
            let own = (moved / exact - 1.0).abs();
            if weighting == Weighting::QuadraticBSpline {
                smeared = worst(smeared, own);
            } else {
                off = worst(off, own);
            }
            run_to(&mut simulation, 80.0 * LIGHT, |s, _| balance.look(s))?;
            drift = worst(drift, balance.drift);
            grown = worst(grown, balance.grown);
        }
    }
    let mut gates = vec![
        Gate::at_most(
            String::from("critical step against that of the light bar"),
            error_of_the_step(&bar(), 1.0)?,
            ROUND_OFF,
            STEP_OF_FASTEST,
        ),
        Gate::at_most(
            String::from("way of the light bar in a quarter of its period, GIMP"),
            off,
            0.01,
            "the impedances differ by 1e3, the grid by (k h)²/24, and the step by as much",
        ),
        Gate::at_most(
            String::from("way of the light bar in a quarter of its period, B-splines"),
            smeared,
            2.0 / LIGHT,
            "functions of the heavy bar reach the node one cell into the light one and hold it, and the way goes with the square of \
             the length: 2 h/L",
        ),
    ];
    gates.extend(kept("twenty periods", drift, grown));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

fn both() -> Result<Finding, Unexpected> {
    const LAYERS: &[Layer] = &[(3, 1e9, 1.0), (3, 1.0, 1e6), (3, 1e9, 1e6), (3, 1.0, 1.0)];
    const GRAVITY: f64 = 1e-12;
    let (mut drift, mut grown) = (0.0, 0.0);
    for weighting in SAFE {
        for scheme in SCHEMES {
            let mut scene = open([12, 12]);
            (scene.weighting, scene.scheme) = (weighting, scheme);
            // Quarters of a block, not on the nodes; each kind beside two others.
            for (x, y, young, density) in [
                (2.9, 2.9, 1.0, 1.0),
                (5.9, 2.9, 1e9, 1.0),
                (2.9, 5.9, 1.0, 1e6),
                (5.9, 5.9, 1e9, 1e6),
            ] {
                let material = scene.add_material(elastic(young, 0.3), density);
                scene.add_body(Shape::rectangle([x, y], [x + 3.0, y + 3.0]), material);
            }
            let breathes: InitialField = Arc::new(|x| InitialState {
                velocity: [1e-3 * (x[0] - 5.9), 1e-3 * (x[1] - 5.9), 0.0],
                ..AT_REST
            });
            let mut simulation = start(&scene, Some(breathes))?;
            let mut balance = Kept::of(&simulation);
            run_steps(&mut simulation, STANDS, |s, _| balance.look(s))?;
            drift = worst(drift, balance.drift);
            grown = worst(grown, balance.grown);
        }
    }
    let mut gates = vec![
        Gate::at_most(
            String::from("critical step against that of the stiff and light layer"),
            error_of_the_step(&column(LAYERS, 0.0), 1e9_f64.sqrt())?,
            ROUND_OFF,
            STEP_OF_FASTEST,
        ),
        Gate::at_most(
            String::from("stress of the standing column, over that at its base"),
            error_of_a_standing_column(LAYERS, GRAVITY)?,
            STANDS_TO,
            IN_BALANCE,
        ),
    ];
    gates.extend(kept("quarters of a block", drift, grown));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
