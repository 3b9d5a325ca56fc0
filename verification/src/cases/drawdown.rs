//! Does a dam stand while its water does, and fail when the water is drawn down faster than its pores drain?
//!
//! The shell of a zoned dam, 5 m high with a face of 1 in 2, leans on a core that neither lets water through nor holds the shell back.
//! Its pores are full, and the reservoir stands at the crest; stresses at the start are those of the buoyant weight below the face.
//! *full*: the reservoir stays, and the shell has to stand. *drawn down*: it sinks to the foot in two seconds, in which the pores
//! cannot drain. The shell then has its whole weight and the pressures of the buoyant one: along a long slope
//! 0.49 tan(phi)/tan(beta) = 0.68 of the strength that it needs, where 1.40 held it under water (Skempton and DeLory 1957; Morgenstern
//! 1963). It has to fail, and nothing exact is known of where it comes to rest: books are judged, and the reach is shown. It is no
//! converged one: the tongue runs out until it is a cell thin, 0.8 heights with cells of half a metre, 1.5 with half of them.
//!
//! The reservoir presses on the face as standing water does (`conditions/standing.rs`); where the face emerges the pressure of the
//! pores is zero. Clay with friction: Mohr and Coulomb, 35° and 1 kPa, no dilation, E 400 times the buoyant stress at the base.
//! `proctor verify drawdown`; `proctor report RECORD` draws the frames.

use super::prelude::*;
use super::vocabulary::run_out::{self, FRONT, GAINED, LOST, MOVING, TOP};
use proctor_scene::StandingWater;

const HEIGHT_OF_DAM: f64 = 5.0; // Height [m]
const CREST: f64 = 3.0; // Width of the crest [m]
const FOOT: f64 = CREST + 2.0 * HEIGHT_OF_DAM; // Foot of the face [m]
const GROUND: f64 = 24.0; // Length of the ground [m]
const GRAVITY: f64 = 9.81; // Gravity [m/s²]
const YOUNG: f64 = 2e7; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
/// Angle of friction \[°\] and cohesion \[Pa\].
const STRENGTH: [f64; 2] = [35.0, 1e3];
/// Bulk modulus of the water \[Pa\]: four times what bears a load without it, and a fortieth of that of water, whose waves would take six
/// times the steps.
const BULK: f64 = 5e7;
const CONDUCTIVITY: f64 = 1e-6; // Hydraulic conductivity [m/s]
/// Times at which the reservoir begins to sink and is empty \[s\].
const SINKS: [f64; 2] = [1.0, 3.0];
const TIME: f64 = 8.0; // Time [s]
/// Share of PIC, which keeps the pressure from ringing where particles cross cells.
const PIC: f64 = 0.002;

const FULL: &str = "full"; // The reservoir stays
const DRAWN: &str = "drawn down"; // It sinks

const BEYOND: &str = "way of the foot over the height";
const RETURNED: &str = "energy that drag gave back over that of the fall";
const SQUEEZED: &str = "water that left the pores, over that at the start";
const DRAG: &str = "energy that drag took over that of the fall";

const WRONG_WORK: Wrong =
    Wrong::factor("work from outside", 0.5).breaks_only(|gate| gate.contains("energy gained"));

/// The dam that is drawn down.
pub static DRAWDOWN: Case = Case::new(
    "drawdown",
    "Does a dam stand while its water does, and fail when the water is drawn down faster than its pores drain?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.options(|_, _, options| {
    starting(options, |x| {
        let along = -buoyant() * (surface(x[0]) - x[1]).max(0.0);
        let across = (1.0 - libm::sin(STRENGTH[0].to_radians())) * along;
        InitialState {
            stress: [across, along, across, 0.0, 0.0, 0.0],
            ..AT_REST
        }
    })
})
.run(compare)
.gates_of_rungs(&[
    run_out::LOSES_NOTHING,
    value(BEYOND)
        .at_most(
            0.02,
            "it stands: the elastic way is a thousandth of the height, and a slope that fails goes farther",
        )
        .of(FULL),
    value(BEYOND)
        .at_least(
            0.2,
            "it fails: 0.68 of the strength that a long slope needs lets it sink to two thirds of its angle, which moves \
             its foot by half of its height",
        )
        .on(fails),
    value(GAINED)
        .at_most(
            1e-2,
            "only the fall and the reservoir give energy; cells that are crossed ring by a share of it",
        )
        .on(fails),
    run_out::GIVES_NOTHING_BACK.on(fails),
    value(RETURNED).at_most(0.0, "drag takes energy").on(fails),
    value(MOVING)
        .at_most(1e-2, "what has friction comes to rest; elastic ringing of FLIP remains")
        .on(fails),
])
.line_of_each(line)
.wrong_references(&[WRONG_WORK])
.no_study("nothing exact is known of where it comes to rest")
.no_guest("no other solver of the protocol knows pore water");

/// Buoyant weight per volume \[N/m³\].
fn buoyant() -> f64 {
    (1.0 - POROSITY) * (GRAINS - WATER) * GRAVITY
}

/// Height of the dam at a place \[m\].
fn surface(x: f64) -> f64 {
    (0.5 * (FOOT - x)).clamp(0.0, HEIGHT_OF_DAM)
}

fn rungs(size: Size) -> Vec<Rung> {
    let cells: &[f64] = size.pick(&[0.5], &[0.5, 0.25]);
    Rung::ladders(&[(FULL, cells), (DRAWN, cells)])
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = strip(h, [cells(GROUND, h), cells(HEIGHT_OF_DAM, h) + 2]);
    mesh.planes[0][1] = PlaneCondition::Free;
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = plane_scene(&rung.label, mesh, TIME);
    // The core and the ground are shut; what is free for the shell is free for its water.
    scene.water_planes[0][1] = PlaneCondition::Free;
    scene.water_planes[1][1] = PlaneCondition::Free;
    scene.gravity = [0.0, -GRAVITY, 0.0];
    let [friction, cohesion] = STRENGTH;
    let law = MohrCoulomb::new(YOUNG, POISSON, [friction, cohesion, 0.0]);
    scene.materials = material("shell", GRAINS, law);
    scene.pore_water = vec![Some(PoreWater {
        bulk: BULK,
        ..pore_water(POROSITY, CONDUCTIVITY)
    })];
    let corners = [
        [0.0, 0.0],
        [FOOT, 0.0],
        [CREST, HEIGHT_OF_DAM],
        [0.0, HEIGHT_OF_DAM],
    ];
    let shape = Shape::Polygon {
        points: corners.iter().map(|p| [p[0], p[1], 0.0]).collect(),
    };
    scene.bodies = vec![body("shell", 1, shape)];
    scene.initial_pressures = vec![InitialPressure::Table {
        level: HEIGHT_OF_DAM,
    }];
    let level = if rung.variant == DRAWN {
        History {
            times: SINKS.to_vec(),
            values: vec![[HEIGHT_OF_DAM, 0.0, 0.0], [0.0; 3]],
        }
    } else {
        [HEIGHT_OF_DAM, 0.0, 0.0].into()
    };
    scene.standing_waters = vec![StandingWater {
        level,
        density: WATER,
        bodies: vec![],
        shore: None,
    }];
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    Settings::new(Method::DEFAULT).apply(&mut scene);
    scene.transfer.pic_fraction = PIC;
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation) = (run.rung, run.simulation);
    let water = simulation.water_mass();
    let work = run.reference.of(&WRONG_WORK);
    let ran = run_out::run(simulation, work, run.observer)?;
    let foot = ran.places.first().map_or(f64::NAN, |place| place.front);
    let points = ran.places.iter();
    let points = points.map(|place| CurvePoint::new(place.time, place.front - foot, f64::NAN));
    let title = format!("foot of the dam, {}", rung.label);
    let curve = Curve::new(title, ["time (s)", "way of the foot (m)"], points);
    let energy = simulation.energy();
    let [front, _] = ran.at_last();
    let mut quantities = ran.quantities;
    if rung.variant == FULL {
        // What stands does not fall, and nothing is to be had as a share of that.
        quantities.retain(|quantity| [FRONT, TOP, LOST].contains(&quantity.name));
    } else {
        // FLIP leaves in the particles what a plane takes from its nodes: the momentum of the particles is not that of their ways.
        quantities.retain(|quantity| quantity.name != run_out::ASTRAY);
        let returned = (-energy.drag).max(0.0) / energy.external_work;
        quantities.extend([
            Quantity::balance(RETURNED, returned, "1"),
            Quantity::figure(DRAG, energy.drag / energy.external_work, "1"),
        ]);
    }
    quantities.extend([
        Quantity::figure(BEYOND, (front - foot) / HEIGHT_OF_DAM, "1"),
        Quantity::figure(SQUEEZED, 1.0 - simulation.water_mass() / water, "1"),
    ]);
    Ok(Measurements {
        drawings: vec![ran.drawing],
        ..Measurements::of(quantities).drawn(curve)
    })
}

/// Way of the foot, for the record.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    let what = format!(
        "foot {:.3} heights from where it was, highest point {:.2} m, {:.2} % of the water left the pores",
        run.value(BEYOND),
        run.value(TOP),
        100.0 * run.value(SQUEEZED)
    );
    Some(if fails(rung) {
        run_out::said(rung, run, &what)
    } else {
        format!("{}: {what}", rung.label)
    })
}

fn fails(rung: &Rung) -> bool {
    rung.variant != FULL
}
