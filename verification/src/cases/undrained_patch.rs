//! Does water that cannot flow bear a load that varies along the ground, without locking and without a pattern?
//!
//! Source: an elastic layer under a wavy load, `exact/wavy_layer.rs`, with the moduli that stiff water gives to a
//! skeleton: the same shear modulus, and Poisson's ratio 0.497. A layer on a base without friction is loaded by `cos(pi x/L)`
//! slowly; its water is a hundred times as stiff as its skeleton and has no time to flow. Volumetric strain and pressure are
//! means over cells: those of particles lock.
//!
//! Expected: what soil that keeps its volume does, within 5 %. `proctor verify undrained-patch`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use crate::exact::wavy_layer::WavyLayer;

const LENGTH: f64 = 1.0; // Half of a wave [m]
const DEPTH: f64 = 0.5; // Height of the layer [m]
const POISSON: f64 = 0.25; // Poisson's ratio of the skeleton
const STIFF: f64 = 100.0; // Bulk modulus of the water over porosity and confined modulus
const CONDUCTIVITY: f64 = 1e-10; // Hydraulic conductivity [m/s]
const LOAD: f64 = 1.0; // Amplitude of the load [Pa]
const RAMP: f64 = 0.2; // Time in which it comes on: six periods of the layer in shear [s]
const ROWS: u32 = 2000; // Intervals of its record
const AIR: usize = 2; // Empty cells above
const SETTLEMENT: &str = "settlement under the crest of the load";
const PRESSURE: &str = "mean(p)";
const PATTERN: &str = "max(second difference of p)";
const WRONG_SHEAR: Wrong =
    Wrong::factor("shear modulus", 1.1).breaks_only(|gate| gate.contains(SETTLEMENT));
const WRONG_LOAD: Wrong = Wrong::factor("load", 0.7).breaks(|gate| gate.contains(PRESSURE));

/// The layer under the wavy load.
pub static UNDRAINED_PATCH: Case = Case::new(
    "undrained-patch",
    "Does water that cannot flow bear a load that varies along the ground, without locking and without a pattern?",
)
.ladder(Ladder::cells("layer", "L/h", LENGTH, &[16], &[16, 32]))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.displacements()
.compare(compare)
.gates_of_rungs(&[
    error(SETTLEMENT).at_most(5e-2, "five percent: a layer that locks settles by less than half"),
    error(PRESSURE).at_most(5e-2, "five percent of the load, as the settlement"),
    error(PATTERN).at_most(5e-2, "five percent of the load: a chequered pressure has four times its own size"),
])
.wrong_references(&[WRONG_SHEAR, WRONG_LOAD])
.studies(&[Plan::new(
    Ladder::cells("layer", "L/h", LENGTH, &[8, 16], &[8, 16, 32]),
    &[
        Measure::new("displacement", SETTLEMENT),
        Measure::new("pressure", PRESSURE),
    ],
    2,
)
.trying(with_water)])
.no_guest("no other solver of the protocol knows pore water");

/// Confined modulus of the skeleton \[Pa\].
fn confined() -> f64 {
    SKELETON * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
}

fn exact(shear: f64, load: f64) -> WavyLayer {
    WavyLayer {
        height: DEPTH,
        wave_number: PI / LENGTH,
        load: load * LOAD,
        shear: shear * SKELETON / (2.0 * (1.0 + POISSON)),
        bulk: SKELETON / (3.0 * (1.0 - 2.0 * POISSON)),
        storage: STIFF * confined(),
    }
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let water = PoreWater {
        bulk: STIFF * POROSITY * confined(),
        ..pore_water(POROSITY, CONDUCTIVITY)
    };
    let mut mesh = strip(h, [cells(LENGTH, h), cells(DEPTH, h) + AIR]);
    mesh.planes[1][1] = PlaneCondition::Free;
    let speed = water.fast_speed(confined() / water.dry_density(), POROSITY);
    let share = |i: u32| f64::from(i) / f64::from(ROWS);
    // Each cell of the top has the mean of the load over it.
    let integral = |x: f64| LENGTH / PI * libm::sin(PI * x / LENGTH);
    let pieces = (0..cells(LENGTH, h)).map(|cell| {
        let (left, right) = (cell as f64 * h, (cell + 1) as f64 * h);
        let mean = LOAD * (integral(right) - integral(left)) / h;
        Traction {
            p1: [left, DEPTH, 0.0],
            p2: [right, DEPTH, 0.0],
            traction: History {
                times: (0..=ROWS).map(|i| share(i) * RAMP).collect(),
                values: (0..=ROWS)
                    .map(|i| [0.0, -mean * smooth(share(i))[0], 0.0])
                    .collect(),
            },
        }
    });
    settings.applied(Scene {
        time_step: settings.equal_steps(RAMP, h, speed).0,
        materials: elastic(GRAINS, SKELETON, POISSON),
        water_planes: mesh.planes,
        pore_water: vec![Some(water)],
        bodies: vec![body("layer", 1, rectangle([0.0; 2], [LENGTH, DEPTH]))],
        tractions: pieces.collect(),
        volumetric_strain: VolumetricStrain::CellAverage,
        ..plane_scene("undrained_patch", mesh, RAMP)
    })
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let (h, simulation) = (run.rung.cell, &*run.simulation);
    let exact = exact(
        run.reference.of(&WRONG_SHEAR),
        run.reference.of(&WRONG_LOAD),
    );
    let [along, up] = [cells(LENGTH, h), cells(DEPTH, h)];
    let mut means = vec![vec![0.0; up]; along];
    let (mut settled, mut highest) = ([0.0; 2], 0.0);
    let set = &simulation.sets()[0];
    let each = (along * up) as f64 / set.len() as f64;
    for p in 0..set.len() {
        let [x, y, _] = set.position(p);
        let cell = |x: f64, count: usize| ((x / h) as usize).min(count - 1);
        means[cell(x, along)][cell(y, up)] += each * pore_pressure(simulation, 0, p);
        if x < 0.5 * h && y > highest {
            highest = y;
            let moved = simulation.displacement(0, p).map_or(f64::NAN, |u| u[1]);
            settled = [moved, exact.rise([x, y - moved])];
        }
    }
    let middle = |i: usize| (i as f64 + 0.5) * h;
    let off = |i: usize, j: usize| (means[i][j] - exact.pressure([middle(i), middle(j)])) / LOAD;
    let bend = |a: f64, b: f64, c: f64| (a - 2.0 * b + c).abs();
    let (mut sum, mut pattern) = (0.0, 0.0_f64);
    for i in 0..along {
        for j in 0..up {
            sum += off(i, j).abs();
            if i > 0 && i + 1 < along {
                pattern = pattern.max(bend(off(i - 1, j), off(i, j), off(i + 1, j)));
            }
            if j > 0 && j + 1 < up {
                pattern = pattern.max(bend(off(i, j - 1), off(i, j), off(i, j + 1)));
            }
        }
    }
    let points = (0..along).map(|i| {
        let at = [middle(i), middle(up / 2)];
        CurvePoint::new(at[0], means[i][up / 2] / LOAD, exact.pressure(at) / LOAD)
    });
    let title = format!("pore pressure at half of the height, {}", run.rung.label);
    let curve = Curve::new(
        title,
        ["place (m)", "pressure / load"],
        points.collect::<Vec<_>>(),
    );
    Ok(Measurements::of([
        Quantity::compared(SETTLEMENT, settled[0], settled[1], "m"),
        ratio(PRESSURE, Some(sum / (along * up) as f64)),
        ratio(PATTERN, Some(pattern)),
    ])
    .drawn(curve))
}
