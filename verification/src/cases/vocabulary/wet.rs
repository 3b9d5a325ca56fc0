//! A column of soil with water in its pores: its scene, its means over cells, and the water beside the skeleton.

use proctor_scene::simulation::Simulation;
use proctor_scene::{
    History, Permeability, PlaneCondition, PoreWater, Scene, StressScheme, Traction, TransferKind,
    Weighting,
};

use super::moved::smooth;
use super::parts::{body, cells, elastic, plane_scene, rectangle, strip};
use super::stepping::step;
use crate::case::{Curve, CurvePoint, Run, Rung, Size};
use crate::cases::PARTED;
use crate::exact::two_phase_column::TwoPhaseColumn;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Phase};

/// Height \[m\].
pub const HEIGHT: f64 = 1.0;
/// Porosity, where a case has one.
pub const POROSITY: f64 = 0.4;
/// Density of the grains \[kg/m³\].
pub const GRAINS: f64 = 2650.0;
/// Density of the water \[kg/m³\].
pub const WATER: f64 = 1000.0;
/// Young's modulus of the skeleton, whose Poisson's ratio is zero \[Pa\].
pub const SKELETON: f64 = 1e7;
/// Bulk modulus of the water \[Pa\].
pub const BULK_WATER: f64 = 2e8;
/// Gravity with which the conductivity was measured \[m/s²\].
pub const CONDUCTIVITY_GRAVITY: f64 = 10.0;
/// `c1 dt/h` of the prototype that the bounds are from.
pub const WET_COURANT: f64 = 0.35;
const AIR: usize = 2; // Empty cells above
const ROWS: u32 = 4000; // Intervals of the record of a load

/// Rungs of the soil of that number among those of a case, by the cells over the height.
pub fn of_soil(number: usize, variant: &'static str, counts: &[u32]) -> Vec<Rung> {
    let rungs = Rung::counted(variant, &format!("{variant} H/h"), HEIGHT, counts);
    rungs.into_iter().map(|rung| rung.with(number)).collect()
}

/// Methods that studies of soil with water try: those that water goes with.
pub fn with_water(_: Size, method: Method) -> bool {
    method.weighting == Weighting::UniformGimp
        && method.transfer == TransferKind::Flip
        && method.scheme != StressScheme::Usf
}

/// Water in soil of a porosity, with a conductivity \[m/s\].
pub fn pore_water(porosity: f64, conductivity: f64) -> PoreWater {
    PoreWater {
        porosity,
        grain_density: GRAINS,
        density: WATER,
        bulk: BULK_WATER,
        conductivity: [conductivity; 3],
        permeability: Permeability::Constant,
        conductivity_gravity: CONDUCTIVITY_GRAVITY,
    }
}

/// Speed of the fast wave in soil with this water \[m/s\].
pub fn fast_speed(water: &PoreWater) -> f64 {
    water.fast_speed(SKELETON / water.dry_density(), water.porosity)
}

/// The exact column under 1 Pa, so that the top sinks by nothing beside a cell, that comes on smoothly in forty
/// transits of the undrained wave.
pub fn exact_column(conductivity: f64) -> TwoPhaseColumn {
    let column = TwoPhaseColumn {
        height: HEIGHT,
        confined_modulus: SKELETON,
        bulk_water: BULK_WATER,
        porosity: POROSITY,
        density_grains: GRAINS,
        density_water: WATER,
        conductivity,
        gravity: CONDUCTIVITY_GRAVITY,
        load: 1.0,
        ramp: 1.0,
    };
    TwoPhaseColumn {
        ramp: 40.0 * HEIGHT / column.undrained_speed(),
        ..column
    }
}

/// A strip of one cell between sliding sides on a shut base, its top free and drained.
pub fn wet_column(name: &str, h: f64, settings: &Settings, water: PoreWater, end: f64) -> Scene {
    let mut mesh = strip(h, [1, cells(HEIGHT, h) + AIR]);
    mesh.planes[1][1] = PlaneCondition::Free;
    settings.applied(Scene {
        time_step: settings.equal_steps(end, h, fast_speed(&water)).0,
        materials: elastic(GRAINS, SKELETON, 0.0),
        water_planes: mesh.planes,
        pore_water: vec![Some(water)],
        bodies: vec![body("column", 1, rectangle([0.0; 2], [h, HEIGHT]))],
        ..plane_scene(name, mesh, end)
    })
}

/// A pressure \[Pa\] on the top of the strip, which comes on smoothly \[s\].
pub fn pressed(h: f64, load: f64, ramp: f64) -> Traction {
    let s = (0..=ROWS).map(|i| f64::from(i) / f64::from(ROWS));
    Traction {
        p1: [0.0, HEIGHT, 0.0],
        p2: [h, HEIGHT, 0.0],
        traction: History {
            times: s.clone().map(|s| s * ramp).collect(),
            values: s.map(|s| [0.0, -load * smooth(s)[0], 0.0]).collect(),
        },
    }
}

/// Pore pressure of a particle of a body \[Pa\]; NaN without water.
pub fn pore_pressure(simulation: &Simulation, body: usize, p: usize) -> f64 {
    let set = &simulation.sets()[body];
    let column = set.layout.pore_pressure();
    column.map_or(f64::NAN, |column| set.columns[column][p])
}

/// Velocity of the water less that of the skeleton along y \[m/s\]; NaN without water.
pub fn seeping(simulation: &Simulation, body: usize, p: usize) -> f64 {
    let set = &simulation.sets()[body];
    let first = set.layout.water;
    first.map_or(f64::NAN, |first| {
        set.vector(first, p)[1] - set.velocity(p)[1]
    })
}

/// Means over cells of pore pressure and effective stress, from the base up \[Pa\], of particles that have moved by
/// nothing.
pub fn means_over_cells(simulation: &Simulation, h: f64) -> Vec<[f64; 2]> {
    let count = cells(HEIGHT, h);
    let set = &simulation.sets()[0];
    let mut sums = vec![([0.0; 2], 0.0); count];
    for p in 0..set.len() {
        let cell = ((set.position(p)[1] / h) as usize).min(count - 1);
        sums[cell].0[0] += pore_pressure(simulation, 0, p);
        sums[cell].0[1] += set.stress(p)[1];
        sums[cell].1 += 1.0;
    }
    let mean = |(sum, particles): &([f64; 2], f64)| sum.map(|s| s / particles);
    sums.iter().map(mean).collect()
}

/// Runs a column of equal steps to its end, and stops at these shares of its time, the last of which is the end: the isochrones, one
/// after the other, of `points` at each time \[s\], and the times.
///
/// # Errors
/// As [`step`].
pub fn isochrones(
    run: &mut Run<'_>,
    shares: &[f64],
    mut points: impl FnMut(&Simulation, f64) -> Vec<CurvePoint>,
) -> Result<(Vec<f64>, Vec<CurvePoint>), Failure> {
    let (steps, end) = (run.equal_steps(), run.simulation.scene().time);
    let (mut times, mut all) = (vec![], vec![]);
    for share in shares {
        run.observer.phase(Phase::Stepping);
        let until = (share * steps as f64).round() as u64;
        while run.simulation.steps() < until {
            step(run.simulation, end, run.observer)?;
        }
        run.observer.progress(*share);
        run.observer.phase(Phase::Comparing);
        let time = run.time();
        times.push(time);
        if !all.is_empty() {
            all.push(PARTED);
        }
        all.extend(points(run.simulation, time));
    }
    Ok((times, all))
}

/// Times \[s\] as words of a title.
pub fn words_of(times: &[f64]) -> String {
    let words: Vec<String> = times.iter().map(|time| format!("{time:.2}")).collect();
    format!("{} s", words.join(", "))
}

/// Means over cells beside exact ones: the largest differences of pore pressure and effective stress, over a scale each \[Pa\], and
/// the curve of the pressure over a load \[Pa\]. A cell has a height \[m\] and an exact pair.
pub fn beside_exact(
    run: &Run<'_>,
    scales: [f64; 2],
    load: f64,
    exact: impl Fn(usize) -> (f64, [f64; 2]),
) -> ([f64; 2], Curve) {
    let mut off = [0.0_f64; 2];
    let mut points = vec![];
    let means = means_over_cells(run.simulation, run.rung.cell);
    for (cell, found) in means.into_iter().enumerate() {
        let (height, exact) = exact(cell);
        for k in 0..2 {
            off[k] = off[k].max((found[k] - exact[k]).abs() / scales[k]);
        }
        points.push(CurvePoint::new(height, found[0] / load, exact[0] / load));
    }
    let title = format!("pore pressure after {} s, {}", run.time(), run.rung.label);
    (
        off,
        Curve::new(title, ["height (m)", "pressure / load"], points),
    )
}
