//! Does soft soil that is squeezed to half of its height lose its water as large strain has it?
//!
//! Source: Xie and Leo 2004, `exact/consolidation.rs`. A layer with the conductivity k J² is loaded by 0.8 of its
//! modulus, so that it ends at 0.45 of its height, and has lost 0.34 of it at the time factor 0.3. The load is the weight of a
//! soil on it that lets all water through, since tractions stay where they are in space. A share of PIC of 0.002 keeps
//! the pressure smooth while particles cross cells.
//!
//! Expected: a prototype in one dimension settled by 3e-4 too much at 20 cells, its pressure was off by 0.4 % of the load
//! in the mean. Water that can be compressed is worth 0.35 %. `proctor verify xie-leo`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use crate::exact::consolidation::Layer;

const STRAIN: f64 = 0.8; // Load over the modulus of the skeleton
const LOOSE: f64 = 0.7; // Porosity at the start: 0.33 where all of the load is borne
const STIFF_WATER: f64 = 2e9; // Bulk modulus of the water [Pa]
const CONDUCTIVITY: f64 = 1e-3; // Hydraulic conductivity at the start [m/s]
const OPEN: f64 = 1.0; // That of the soil on top [m/s]
const CAP: f64 = 0.1; // Height of the soil on top [m]
const CAP_STIFFNESS: f64 = 5.0; // Modulus of the soil on top over that of the layer
const RAMP: f64 = 0.01; // Time in which the load comes on: fourteen ways of the wave through the layer [s]
const FACTOR: f64 = 0.3; // Time factor of the comparison
const PIC: f64 = 0.002; // Share of PIC
const SETTLEMENT: &str = "settlement of the layer";
const PRESSURE: &str = "mean(p)";
const LARGEST: &str = "max(p)";
const WRONG_CONDUCTIVITY: Wrong =
    Wrong::factor("conductivity", 1.05).breaks(|gate| gate.contains(SETTLEMENT));
const WRONG_MODULUS: Wrong =
    Wrong::factor("modulus", 1.05).breaks(|gate| gate.contains(SETTLEMENT));

/// The layer that is squeezed.
pub static XIE_LEO: Case = Case::new(
    "xie-leo",
    "Does soft soil that is squeezed to half of its height lose its water as large strain has it?",
)
.ladder(Ladder::cells("layer", "H/h", HEIGHT, &[20], &[20, 40]))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.displacements()
.options(|_, _, options| {
    let per_mass = STRAIN * SKELETON / (water(CONDUCTIVITY).dry_density() * CAP);
    driven(options, move |x, t| {
        let share = smooth((t / RAMP).min(1.0))[0];
        [
            0.0,
            if x[1] > HEIGHT {
                -per_mass * share
            } else {
                0.0
            },
            0.0,
        ]
    })
})
.compare(compare)
.gates_of_rungs(&[
    error(SETTLEMENT).at_most(5e-3, "3.5e-3 by the water that is compressed, and the mesh"),
    error(PRESSURE).at_most(
        1e-2,
        "the prototype had 4e-3, and water that keeps its volume",
    ),
    error(LARGEST).at_most(
        4e-2,
        "particles that cross cells: the prototype had 2.1e-2, with softer water",
    ),
])
.wrong_references(&[WRONG_CONDUCTIVITY, WRONG_MODULUS])
.no_study(
    "a study tries all weighting functions and transfers, and water goes with uGIMP and FLIP alone",
)
.no_guest("no other solver of the protocol knows pore water");

fn water(conductivity: f64) -> PoreWater {
    PoreWater {
        bulk: STIFF_WATER,
        permeability: Permeability::Square,
        ..pore_water(LOOSE, conductivity)
    }
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let layer = water(CONDUCTIVITY);
    let cap = PoreWater {
        permeability: Permeability::Constant,
        ..water(OPEN)
    };
    // The load counts from the middle of its ramp.
    let exact = reference(1.0, 1.0);
    let end = FACTOR * HEIGHT * HEIGHT / (exact.mobility * SKELETON) + 0.5 * RAMP;
    let mut scene = wet_column("xie_leo", h, settings, layer, end);
    // The wave is fastest where the pores are fewest.
    let squeezed = 1.0 - (1.0 - LOOSE) * libm::exp(STRAIN);
    let fastest = layer.fast_speed(SKELETON / layer.dry_density(), squeezed);
    scene.time_step = settings.equal_steps(end, h, fastest).0;
    scene.mesh.cells[1] += cells(CAP, h);
    scene.materials.push(Material {
        id: 2,
        name: "open soil".into(),
        ..elastic(GRAINS, CAP_STIFFNESS * SKELETON, 0.0).remove(0)
    });
    scene.pore_water.push(Some(cap));
    scene.bodies.push(Body {
        material: 1,
        ..body("cap", 2, rectangle([0.0, HEIGHT], [h, HEIGHT + CAP]))
    });
    scene.transfer.pic_fraction = PIC;
    settings.applied(scene)
}

fn reference(conductivity: f64, modulus: f64) -> Layer {
    Layer {
        height: HEIGHT,
        confined_modulus: modulus * SKELETON,
        storage: f64::INFINITY,
        mobility: conductivity * CONDUCTIVITY / (WATER * CONDUCTIVITY_GRAVITY),
        load: STRAIN * SKELETON,
    }
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let wrong = run.reference;
    let exact = reference(wrong.of(&WRONG_CONDUCTIVITY), wrong.of(&WRONG_MODULUS));
    let time = run.time() - 0.5 * RAMP;
    let simulation = &*run.simulation;
    let (mut sum, mut most, mut count) = (0.0, 0.0_f64, 0.0);
    let (mut points, mut top) = (vec![], None);
    for p in 0..simulation.sets()[0].len() {
        let Some([x, z, _]) = simulation.initial_position(0, p) else {
            continue;
        };
        let (computed, pressure) = (
            pore_pressure(simulation, 0, p),
            exact.large_pressure(z, time),
        );
        let off = (computed - pressure).abs() / exact.load;
        sum += off;
        most = most.max(off);
        count += 1.0;
        // One column of the two.
        if x < 0.5 * run.rung.cell {
            points.push(CurvePoint::new(
                z,
                computed / exact.load,
                pressure / exact.load,
            ));
        }
        if top.is_none_or(|(_, highest)| z > highest) {
            top = Some((p, z));
        }
    }
    points.sort_by(|a, b| a.at.total_cmp(&b.at));
    let settlement = top.and_then(|(p, z)| {
        let moved = simulation.displacement(0, p)?[1];
        // The strain of the quarter of a cell above the highest particle is that at its middle.
        let borne = exact.load - exact.large_pressure(0.5 * (z + HEIGHT), time);
        let above = (HEIGHT - z) * (libm::exp(-borne / exact.confined_modulus) - 1.0);
        let settled = exact.large_settlement(time);
        Some(Quantity::compared(SETTLEMENT, moved + above, settled, "m"))
    });
    let quantities = [
        ratio(PRESSURE, Some(sum / count)),
        ratio(LARGEST, Some(most)),
    ];
    let title = format!(
        "pore pressure at the time factor {FACTOR}, {}",
        run.rung.label
    );
    let curve = Curve::new(
        title,
        ["height at the start (m)", "pressure / load"],
        points,
    );
    Ok(Measurements::of(quantities.into_iter().chain(settlement).collect::<Vec<_>>()).drawn(curve))
}
