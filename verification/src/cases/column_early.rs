//! Does water that has not had the time to flow bear the undrained pressure?
//!
//! Source: Biot 1956, `exact/two_phase_column.rs`. The column of *column-modal* at k = 1e-6 and 1e-7 m/s, just after
//! its load has come on: the drained layer at the top is 0.03 of a cell to a fifth of one, and no mesh resolves it. Two
//! cells and four layers below the top the pressure is that of the series all the same.
//!
//! Expected: a prototype in one dimension was off by 9e-6 and 6e-6. `proctor verify column-early`.

use super::prelude::*;

const SOILS: [(&str, f64); 2] = [("k=1e-6", 1e-6), ("k=1e-7", 1e-7)];
const END: f64 = 0.1; // Time of the comparison [s]
const CELLS: u32 = 20;
const MODES: usize = 2000; // So close to no drainage the series falls slowly
const PRESSURE: &str = "max(p) below the drained layer";
const WRONG_LOAD: Wrong = Wrong::factor("load", 1.001);

/// The column before it drains.
pub static COLUMN_EARLY: Case = Case::new(
    "column-early",
    "Does water that has not had the time to flow bear the undrained pressure?",
)
.ladder(Ladder::made(|size| {
    let of = |number: usize| of_soil(number, SOILS[number].0, &[CELLS]);
    let last = size.pick(1, SOILS.len());
    (0..last).flat_map(of).collect()
}))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.compare(compare)
.gates_of_rungs(&[error(PRESSURE).at_most(
    1e-4,
    "the prototype had 9e-6 at most, and means of the load in time are off by less",
)])
.wrong_references(&[WRONG_LOAD])
.no_study("no mesh resolves the drained layer; *column-modal* studies one that a mesh resolves")
.no_guest("no other solver of the protocol knows pore water");

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (_, conductivity) = SOILS[*rung.problem::<usize>()];
    let exact = exact_column(conductivity);
    let water = pore_water(POROSITY, conductivity);
    let mut scene = wet_column("column_early", rung.cell, settings, water, END);
    scene.tractions = vec![pressed(rung.cell, exact.load, exact.ramp)];
    scene
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let (_, conductivity) = SOILS[*run.rung.problem::<usize>()];
    let mut column = exact_column(conductivity);
    column.load *= run.reference.of(&WRONG_LOAD);
    let exact = column.at(run.time(), MODES);
    let h = run.rung.cell;
    // Coefficient of consolidation with water that can be compressed.
    let storage = 1.0 / column.confined_modulus + column.porosity / column.bulk_water;
    let diffusion = conductivity / (column.density_water * column.gravity) / storage;
    let below = HEIGHT - 2.0 * h - 4.0 * (diffusion * run.time()).sqrt();
    let undrained = column.load * column.undrained_share();
    let mut off = 0.0_f64;
    for (cell, [p, _]) in means_over_cells(run.simulation, h).into_iter().enumerate() {
        let (low, high) = (cell as f64 * h, (cell + 1) as f64 * h);
        if high < below {
            off = off.max((p - exact.mean_pressure(low, high)).abs() / undrained);
        }
    }
    Ok(Measurements::of([ratio(PRESSURE, Some(off))]))
}
