//! Stiff beside soft and heavy beside light.

use super::prelude::*;
use crate::exact::sudden_weight::SuddenWeight;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("stiffness-contrast", stiffness)
        .with("a soft layer on one that is 1e6 times as stiff")
        .must("the step from the stiff layer; the stress under its weight exact; the soft layer as good as alone, times two"),
    Extreme::of("density-contrast", density)
        .with("a light bar at the end of one that is 1e6 times as dense")
        .must("the step from the wave speed of each particle; momentum to round-off; the light bar swings as a clamped one"),
    Extreme::of("contrast-of-both", both)
        .with("layers and quarters with stiffness 1 and 1e9 and density 1 and 1e6 in one scene")
        .must("the stress under the weight exact; momentum to round-off, no growth of energy"),
];

/// Steps of a column that should stand still.
const STANDS: u64 = 1000;

/// A layer of a column: its height in cells, Young's modulus \[Pa\] and density \[kg/m³\].
type Layer = (usize, f64, f64);

/// A column one cell wide under its weight, its layers from below; Poisson's ratio is zero.
fn column(layers: &[Layer], gravity: f64) -> Scene {
    let height: usize = layers.iter().map(|layer| layer.0).sum();
    let mut scene = open([1, height + 2])
        .with_gravity([0.0, -gravity])
        .between(0)
        .with_plane(1, 0, PlaneCondition::Sliding);
    let mut below = 0.0;
    for &(cells, young, density) in layers {
        let above = below + cells as f64;
        let layer = rectangle([0.0, below], [1.0, above]);
        scene.body(layer, elastic(young, 0.0), density);
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

/// The stress of a column that starts in balance, with each method.
fn standing_column(layers: &'static [Layer], gravity: f64) -> Result<Gate> {
    // Round-off of many steps, in stresses and densities that differ by nine digits.
    let mut off = gate("stress of the standing column, over that at its base")
        .at_most(1e-10, "particles that fill their cells carry a stress that is linear in each layer exactly; round-off alone moves them");
    let settled = stressed(move |x| [0.0, carried(layers, gravity, x[1]), 0.0, 0.0, 0.0, 0.0]);
    for scene in each_scheme(&column(layers, gravity), &FILLING) {
        for seen in unsorted(&after(&scene, &settled, STANDS)?) {
            let error = seen.stress[1] - carried(layers, gravity, seen.position[1]);
            off.see((error / carried(layers, gravity, 0.0)).abs());
        }
    }
    Ok(off)
}

/// The critical step of a scene at rest over C h/c, less one.
fn critical_step(whose: &str, scene: &Scene, wave_speed: f64) -> Result<Gate> {
    let mut simulation = start(scene, &options())?;
    let number = simulation.stability_number();
    let found = step(&mut simulation, NEVER)?.dt_critical;
    Ok(gate(format!("critical step against that of {whose}"))
        .at_most(ROUND_OFF, STEP_OF_FASTEST)
        .found((found * wave_speed / number - 1.0).abs()))
}

fn stiffness() -> RowVerdict {
    const LAYERS: &[Layer] = &[(4, 1e6, 1.0), (8, 1.0, 1.0)];
    const GRAVITY: f64 = 1e-6;
    let exact = SuddenWeight {
        height: 8.0,
        wave_speed: 1.0,
        gravity: GRAVITY,
    };
    // While the front from the base is on its way up, over the largest stress.
    let end = 0.75 * exact.height;
    let error = |layers: &[Layer], scheme, base: f64| -> Result<f64> {
        let scene = column(layers, GRAVITY).with_scheme(scheme);
        let simulation = at_time(&scene, &options(), end)?;
        let soft: Vec<_> = of_body(&simulation, layers.len() - 1).collect();
        let squares = soft.iter().map(|seen| {
            let y = seen.position[1] - base;
            (seen.stress[1] - exact.stress(y, end, 1.0)).powi(2)
        });
        let mean = squares.sum::<f64>() / soft.len() as f64;
        Ok(mean.sqrt() / (GRAVITY * exact.height))
    };
    let mut ratio = gate("error of the suddenly loaded soft layer over that of its own run")
        .at_most(2.0, "a base that is 1e6 times as stiff is rigid, so that nothing but the shorter step differs");
    for scheme in SCHEMES {
        let own = error(&LAYERS[1..], scheme, 0.0)?;
        ratio.see(error(LAYERS, scheme, 4.0)? / own);
    }
    Ok(Finding::of([
        critical_step("the stiff layer", &column(LAYERS, 0.0), 1e3)?,
        standing_column(LAYERS, GRAVITY)?,
        ratio,
    ]))
}

fn density() -> RowVerdict {
    const HEAVY: f64 = 4.0;
    const LIGHT: f64 = 8.0;
    const SPEED: f64 = 1e-4;
    let mut bar = open([16, 1]).between(1);
    for (left, length, density) in [(2.0, HEAVY, 1e6), (2.0 + HEAVY, LIGHT, 1.0)] {
        let part = rectangle([left, 0.0], [left + length, 1.0]);
        bar.body(part, elastic(1.0, 0.0), density);
    }
    let wave = FRAC_PI_2 / LIGHT;
    let swings =
        from(move |x| moving_along_x(SPEED * libm::sin(wave * (x[0] - 2.0 - HEAVY).max(0.0)), 0.0));
    let mut off = gate("way of the light bar in a quarter of its period, GIMP").at_most(
        0.01,
        "the impedances differ by 1e3, the grid by (k h)²/24, and the step by as much",
    );
    let mut smeared = gate("way of the light bar in a quarter of its period, B-splines")
        .at_most(2.0 / LIGHT, "functions of the heavy bar reach the node one cell into the light one and hold it, and the way goes with the square of \
             the length: 2 h/L");
    let mut kept = Conservation::named("twenty periods");
    for scene in each_scheme(&bar, &SAFE) {
        let mut simulation = kept.start(&scene, &swings)?;
        let from = simulation.center(1).position[0];
        run_to(&mut simulation, LIGHT, |s, _| kept.look(s))?;
        // A quarter of the period: the mean of SPEED sin(k x)/(k c).
        let exact = SPEED / wave * FRAC_2_PI;
        let moved = simulation.center(1).position[0] - from;
        let smooth = scene.weighting == Weighting::QuadraticBSpline;
        let way = if smooth { &mut smeared } else { &mut off };
        way.see((moved / exact - 1.0).abs());
        run_to(&mut simulation, 80.0 * LIGHT, |s, _| kept.look(s))?;
    }
    let critical = critical_step("the light bar", &bar, 1.0)?;
    Ok(Finding::of([critical, off, smeared]).and(kept.gates()))
}

fn both() -> RowVerdict {
    const LAYERS: &[Layer] = &[(3, 1e9, 1.0), (3, 1.0, 1e6), (3, 1e9, 1e6), (3, 1.0, 1.0)];
    const GRAVITY: f64 = 1e-12;
    let breathes = flying(|x| [1e-3 * (x[0] - 5.9), 1e-3 * (x[1] - 5.9), 0.0]);
    // Quarters of a block, not on the nodes; each kind beside two others.
    let mut quarters = open([12, 12]);
    for (x, y, young, density) in [
        (2.9, 2.9, 1.0, 1.0),
        (5.9, 2.9, 1e9, 1.0),
        (2.9, 5.9, 1.0, 1e6),
        (5.9, 5.9, 1e9, 1e6),
    ] {
        let quarter = rectangle([x, y], [x + 3.0, y + 3.0]);
        quarters.body(quarter, elastic(young, 0.3), density);
    }
    let kept = conserved("quarters of a block", &quarters, &breathes, [STANDS, 1])?;
    let stiff = column(LAYERS, 0.0);
    Ok(Finding::of([
        critical_step("the stiff and light layer", &stiff, 1e9_f64.sqrt())?,
        standing_column(LAYERS, GRAVITY)?,
    ])
    .and(kept))
}
