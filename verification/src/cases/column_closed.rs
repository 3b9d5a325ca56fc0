//! Does soil from which no water can flow swing as one solid of the undrained modulus?
//!
//! Source: `exact/bar.rs` with the modulus `E_c` + `K_w`/n and the density of soil and water. A column between two shut
//! planes begins with the velocity of its first mode. From k = 1e-6 m/s on the water lags by less than 4e-4 of the way,
//! so the wave is that of a bar that both ends hold, and the run that of the same scene of one phase (`one phase`).
//!
//! Expected: order 2, and no difference to one phase beyond the flow. `proctor verify column-closed`.

use super::prelude::*;
use crate::exact::bar::{Bar, FarEnd};

const ONE_PHASE: &str = "one phase";
/// Conductivities \[m/s\], and no water.
const SOILS: [(&str, Option<f64>); 4] = [
    (ONE_PHASE, None),
    ("k=1e-6", Some(1e-6)),
    ("k=1e-8", Some(1e-8)),
    ("k=1e-10", Some(1e-10)),
];
const SPEED: f64 = 1e-6; // Amplitude of the velocity [m/s]
const END: f64 = 0.2; // Time of the comparison, in periods
const TOTAL: &str = "L2(mean total stress of cells)";
const OFF: &str = "difference from the solid of one phase";
const WRONG_MODULUS: Wrong = Wrong::factor("modulus", 1.05).breaks_only(|gate| !gate.contains(OFF));

/// The column that nothing drains.
pub static COLUMN_CLOSED: Case = Case::new(
    "column-closed",
    "Does soil from which no water can flow swing as one solid of the undrained modulus?",
)
.ladder(Ladder::made(|size| {
    let counts: &[u32] = size.pick(&[10, 20], &[10, 20, 40]);
    let of = |number: usize| of_soil(number, SOILS[number].0, counts);
    (0..SOILS.len()).flat_map(of).collect()
}))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.displacements()
.options(|_, _, options| {
    let start = exact();
    starting(options, move |x| {
        let (v, slope) = (
            start.velocity(x[1], 0.0),
            start.velocity_gradient(x[1], 0.0),
        );
        moving([0.0, v, 0.0], [[0.0; 3], [0.0, slope, 0.0], [0.0; 3]])
    })
})
.compare(compare)
.gates_of_variants(&[
    error(DISPLACEMENT).at_most_by(of_order_two, "a sixth of the square of pi h/H"),
    error(TOTAL).at_most_by(of_order_two, "a sixth of the square of pi h/H"),
    order(DISPLACEMENT).at_least(1.9, "2 of linear functions, less 0.1"),
    error(OFF)
        .at_most(
            1e-3,
            "the water lags by w k/(n g_k) of the way at most, 4e-4 at k = 1e-6 m/s",
        )
        .on(|rung| rung.variant != ONE_PHASE),
])
.tables(&[TableRule::new(
    "column-closed, {variant}",
    &[DISPLACEMENT, TOTAL],
)])
.wrong_references(&[WRONG_MODULUS])
.no_study("its question is if two phases are one; *bar* studies the cost of a wave")
.no_guest("no other solver of the protocol knows pore water");

/// The solid swings a fifth of a period; the phase is late by that times (pi h/H)²/12 or less, and its sine as much.
fn of_order_two(rung: &Rung) -> f64 {
    (PI * rung.cell / HEIGHT).powi(2) / 6.0
}

fn exact() -> Bar {
    let column = exact_column(1.0);
    Bar {
        length: HEIGHT,
        modulus: SKELETON + BULK_WATER / POROSITY,
        density: column.saturated_density(),
        velocity_amplitude: SPEED,
        mode: 1,
        far_end: FarEnd::Fixed,
    }
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (h, exact) = (rung.cell, exact());
    let (_, conductivity) = SOILS[*rung.problem::<usize>()];
    let end = END * TAU / exact.angular_frequency();
    // The steps of both, which are those of the faster wave.
    let mut scene = wet_column("column_closed", h, settings, pore_water(POROSITY, 1.0), end);
    scene.mesh.cells[1] = cells(HEIGHT, h);
    scene.mesh.planes[1][1] = PlaneCondition::Sliding;
    scene.water_planes = scene.mesh.planes;
    if let Some(conductivity) = conductivity {
        scene.pore_water = vec![Some(pore_water(POROSITY, conductivity))];
        scene
    } else {
        scene.pore_water = vec![];
        scene.materials = elastic(exact.density, exact.modulus, 0.0);
        scene
    }
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let (mut exact, t) = (exact(), run.time());
    exact.modulus *= run.reference.of(&WRONG_MODULUS);
    let simulation = &*run.simulation;
    let displacement = l2(simulation, |p, x| {
        Some((
            [simulation.displacement(0, p)?[1]],
            [exact.displacement(x[1], t)],
        ))
    });
    let wet = SOILS[*run.rung.problem::<usize>()].1.is_some();
    let mut sums = vec![(0.0, 0.0); cells(HEIGHT, run.rung.cell)];
    for p in 0..simulation.sets()[0].len() {
        let of_water = if wet {
            pore_pressure(simulation, 0, p)
        } else {
            0.0
        };
        let set = &simulation.sets()[0];
        let cell = ((set.position(p)[1] / run.rung.cell) as usize).min(sums.len() - 1);
        sums[cell].0 += set.stress(p)[1] - of_water;
        sums[cell].1 += 1.0;
    }
    // Particles of a cell have one strain: its mean is of order 2.
    let gauss = 0.5 / 3.0_f64.sqrt();
    let stresses = sums.iter().enumerate().map(|(cell, (sum, count))| {
        let at = |x: f64| exact.stress((cell as f64 + 0.5 + x) * run.rung.cell, t);
        (1.0, [sum / count], [0.5 * (at(-gauss) + at(gauss))])
    });
    let stress = relative_l2(stresses);
    let mut quantities = vec![ratio(DISPLACEMENT, displacement), ratio(TOTAL, stress)];
    if wet {
        let solid = as_one_phase(run)?;
        let off = l2(simulation, |p, _| {
            Some((
                [simulation.displacement(0, p)?[1]],
                [solid.displacement(0, p)?[1]],
            ))
        });
        quantities.push(ratio(OFF, off));
    }
    Ok(Measurements::of(quantities))
}

/// The same scene of one phase, at its end.
fn as_one_phase(run: &Run<'_>) -> Result<Simulation, Failure> {
    let rung = run.rung.clone().with(0_usize);
    let start = exact();
    let options = Options {
        displacement: true,
        threads: Some(1),
        ..Options::default()
    };
    let options = starting(options, move |x| moving_along_y(start.velocity(x[1], 0.0)));
    let mut solid = Simulation::new(&scene(&rung, run.settings), &options)?;
    for _ in 0..run.equal_steps() {
        solid.step(f64::INFINITY)?;
    }
    Ok(solid)
}

fn moving_along_y(velocity: f64) -> InitialState {
    moving([0.0, velocity, 0.0], [[0.0; 3]; 3])
}
