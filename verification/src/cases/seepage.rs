//! Does water that seeps down through soil flow at the rate of Darcy, and hang its weight on the skeleton?
//!
//! Source: Darcy's law; Skempton and DeLory 1957 have it along a slope. A column of 1 m with a porosity of 0.4, drained at
//! both ends, under its weight: the water has no pressure anywhere, seeps down with k g/`g_k` and drags the skeleton, which so
//! bears the weight of both. It begins with that stress and with water at rest. The gravity of the scene is half of that with
//! which the conductivity was measured.
//!
//! Expected: exact on every mesh once the start has died away. `proctor verify seepage`.

use super::prelude::*;

const CONDUCTIVITY: f64 = 1e-2; // Hydraulic conductivity [m/s]
const GRAVITY: f64 = 5.0; // Gravity [m/s²]
const END: f64 = 1.0; // The wave of the start has died away: 500 ways of it through the column [s]
const FLUX: &str = "flux of the water at the middle";
const EFFECTIVE: &str = "max(effective stress)";
const PRESSURE: &str = "max(p) over that of water at rest";
const WRONG_CONDUCTIVITY: Wrong =
    Wrong::factor("conductivity", 1.03).breaks_only(|gate| gate.contains(FLUX));
const WRONG_WEIGHT: Wrong =
    Wrong::factor("weight", 1.03).breaks_only(|gate| gate.contains(EFFECTIVE));

/// The column through which water seeps.
pub static SEEPAGE: Case = Case::new(
    "seepage",
    "Does water that seeps down through soil flow at the rate of Darcy, and hang its weight on the skeleton?",
)
.ladder(Ladder::cells("column", "H/h", HEIGHT, &[8], &[8, 16]))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.options(|_, _, options| {
    starting(options, |x| InitialState {
        stress: [0.0, -weight() * (HEIGHT - x[1]), 0.0, 0.0, 0.0, 0.0],
        ..AT_REST
    })
})
.compare(compare)
.gates_of_rungs(&[
    error(FLUX).at_most(1e-2, "one percent, as along a slope"),
    error(EFFECTIVE).at_most(1e-2, "one percent, as along a slope"),
    error(PRESSURE).at_most(1e-2, "one percent, as along a slope"),
])
.wrong_references(&[WRONG_CONDUCTIVITY, WRONG_WEIGHT])
.no_study("it is exact on every mesh")
.no_guest("no other solver of the protocol knows pore water");

/// Weight of soil and water per volume \[N/m³\].
fn weight() -> f64 {
    exact_column(CONDUCTIVITY).saturated_density() * GRAVITY
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let water = pore_water(POROSITY, CONDUCTIVITY);
    let mut scene = wet_column("seepage", rung.cell, settings, water, END);
    scene.gravity = [0.0, -GRAVITY, 0.0];
    scene.water_planes[1][0] = PlaneCondition::Free;
    scene
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let simulation = &*run.simulation;
    let (h, reference) = (run.rung.cell, run.reference);
    let weight = reference.of(&WRONG_WEIGHT) * weight();
    let set = &simulation.sets()[0];
    let (mut stress, mut pressure) = (0.0_f64, 0.0_f64);
    let (mut flux, mut count) = (0.0, 0.0);
    // Both particles of the lowest cell keep what the start gave them, with opposite signs: the nodes do not see it.
    for (cell, [p, effective]) in means_over_cells(simulation, h).into_iter().enumerate() {
        let depth = HEIGHT - (cell as f64 + 0.5) * h;
        stress = stress.max((effective + weight * depth).abs());
        pressure = pressure.max(p.abs());
    }
    for p in 0..set.len() {
        if (set.position(p)[1] - 0.5 * HEIGHT).abs() < h {
            flux -= POROSITY * seeping(simulation, 0, p);
            count += 1.0;
        }
    }
    let exact = reference.of(&WRONG_CONDUCTIVITY) * CONDUCTIVITY * GRAVITY / CONDUCTIVITY_GRAVITY;
    Ok(Measurements::of([
        Quantity::compared(FLUX, flux / count, exact, "m/s"),
        ratio(EFFECTIVE, Some(stress / (weight * HEIGHT))),
        ratio(PRESSURE, Some(pressure / (WATER * GRAVITY * HEIGHT))),
    ]))
}
