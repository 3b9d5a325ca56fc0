//! Does a layer that consolidates slowly have the pressures of Terzaghi, drained at one end or at both?
//!
//! Source: Terzaghi 1925 with water that can be compressed, `exact/consolidation.rs`: there is no inertia in it. A load
//! comes on smoothly in 0.2 s, sixty times the way of the undrained wave through the layer and back. `top` drains at
//! the top alone, `both ends` at the base too, which holds the skeleton.
//!
//! Expected: order 2; a prototype in one dimension was off by 1.0e-2, 2.6e-3 and 6.8e-4 of the pressure at 10, 20 and
//! 40 cells (`both ends`). `proctor verify column-terzaghi`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use crate::exact::consolidation::Layer;

const TOP: &str = "top";
const BOTH: &str = "both ends";
const CONDUCTIVITY: f64 = 1e-4; // Hydraulic conductivity [m/s]
const LOAD: f64 = 1.0; // Load [Pa]
const RAMP: f64 = 0.2; // Time in which it comes on [s]
/// Time of the comparison \[s\]: the time factor of the longest way of the water is 0.1 (`top`), 0.2 (`both ends`).
fn end(rung: &Rung) -> f64 {
    if rung.variant == BOTH { 0.5 } else { 1.0 }
}
/// Linear pieces of the load in the reference: the joints are off by a share of 1e-5 of it.
const PIECES: u32 = 200;
/// Shares of the time at which isochrones are drawn: the first is while the load comes on.
const SHARES: [f64; 4] = [0.1, 0.25, 0.5, 1.0];
const PRESSURE: &str = "max(p)";
const EFFECTIVE: &str = "max(effective stress)";
const WRONG_CONDUCTIVITY: Wrong =
    Wrong::factor("conductivity", 1.05).breaks(|gate| gate.contains("error"));

/// The layer that consolidates.
pub static COLUMN_TERZAGHI: Case = Case::new(
    "column-terzaghi",
    "Does a layer that consolidates slowly have the pressures of Terzaghi, drained at one end or at both?",
)
.ladder(Ladder::made(|size| {
    let of = |variant: &'static str, counts: &[u32]| {
        Rung::counted(variant, &format!("{variant} H/h"), HEIGHT, counts)
    };
    match size {
        Size::Quick => of(BOTH, &[10, 20]),
        Size::Full => [TOP, BOTH]
            .iter()
            .flat_map(|variant| of(variant, &[10, 20, 40]))
            .collect(),
    }
}))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.run(compare)
.gates_of_variants(&[
    error(PRESSURE)
        .at_most_of(
            [2e-3, 1e-3],
            [
                "half of it the mesh, as in *column-modal*, and inertia, which leaves 3e-4",
                "a quarter of the mesh's at twice the cells, and inertia",
            ],
        )
        .of(TOP),
    error(PRESSURE)
        .at_most_of(
            [3e-3, 1e-3],
            ["the prototype had 2.6e-3", "the prototype had 6.8e-4"],
        )
        .of(BOTH),
    error(EFFECTIVE).at_most_of(
        [3e-3, 1e-3],
        [
            "the skeleton bears the part of the load that the water does not",
            "the skeleton bears the part of the load that the water does not",
        ],
    ),
    order(PRESSURE).at_least(1.9, "2 of linear functions, less 0.1"),
])
.tables(&[TableRule::new(
    "column-terzaghi, drained at {variant}",
    &[PRESSURE, EFFECTIVE],
)])
.wrong_references(&[WRONG_CONDUCTIVITY])
.no_study("its column is that of *column-modal*, which studies it")
.no_guest("no other solver of the protocol knows pore water");

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let water = pore_water(POROSITY, CONDUCTIVITY);
    let mut scene = wet_column("column_terzaghi", rung.cell, settings, water, end(rung));
    scene.tractions = vec![pressed(rung.cell, LOAD, RAMP)];
    if rung.variant == BOTH {
        scene.water_planes[1][0] = PlaneCondition::Free;
    }
    scene
}

/// Pressure at a depth below the drained top \[m\] at a time \[s\]: the sum of what each piece of the load leaves. Drained
/// at both ends, the layer is one of half the height and its image.
fn pressure(rung: &Rung, reference: Reference, depth: f64, time: f64) -> f64 {
    let height = if rung.variant == BOTH {
        0.5 * HEIGHT
    } else {
        HEIGHT
    };
    let weight = WATER * CONDUCTIVITY_GRAVITY;
    let layer = Layer {
        height,
        confined_modulus: SKELETON,
        storage: BULK_WATER / POROSITY,
        mobility: reference.of(&WRONG_CONDUCTIVITY) * CONDUCTIVITY / weight,
        load: LOAD,
    };
    let piece = |i: u32| f64::from(i) / f64::from(PIECES);
    let of_piece = |i: u32| {
        let share = smooth(piece(i + 1))[0] - smooth(piece(i))[0];
        let length = RAMP / f64::from(PIECES);
        share * layer.pressure(height - depth, time - RAMP * piece(i), length)
    };
    // Pieces that come on later leave nothing.
    let on = (0..PIECES).take_while(|i| RAMP * piece(i + 1) <= time);
    on.map(of_piece).sum()
}

fn compare(mut run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, h, reference) = (run.rung, run.rung.cell, run.reference);
    // Two points of Gauss in each cell: the pressure is smooth.
    let gauss = 0.5 / 3.0_f64.sqrt();
    let exact = |cell: usize, time: f64| {
        let middle = (cell as f64 + 0.5) * h;
        let at = |z: f64| pressure(rung, reference, HEIGHT - z, time);
        let mean = 0.5 * (at(middle - gauss * h) + at(middle + gauss * h));
        (middle, mean)
    };
    let (times, points) = isochrones(&mut run, &SHARES, |simulation, time| {
        let means = means_over_cells(simulation, h).into_iter().enumerate();
        let point = means.map(|(cell, [found, _])| {
            let (middle, exact) = exact(cell, time);
            CurvePoint::new(middle, found / LOAD, exact / LOAD)
        });
        point.collect()
    })?;
    let time = run.time();
    let (off, _) = beside_exact(&run, [LOAD; 2], LOAD, |cell| {
        let (middle, exact) = exact(cell, time);
        (middle, [exact, exact - LOAD])
    });
    let title = format!("isochrones after {}, {}", words_of(&times), rung.label);
    let curve = Curve::new(title, ["height (m)", "pore pressure / load"], points);
    Ok(Measurements::of([
        ratio(PRESSURE, Some(off[0])),
        ratio(EFFECTIVE, Some(off[1])),
    ])
    .drawn(curve))
}
