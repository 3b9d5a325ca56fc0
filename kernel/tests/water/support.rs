//! Columns of soil and water as scenes.

use super::series::Column;
use crate::common::{FLIP, body, cuboid, elastic, empty, material, simulation};
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    Dimension, History, Permeability, PoreWater, Scene, StressScheme, TimeStep, Traction,
};

/// Gravity of the conductivity \[m/s²\].
pub const GRAVITY: f64 = 10.0;

/// The column of which the errors are known, with a conductivity \[m/s\].
pub fn column(k: f64) -> Column {
    let (porosity, water) = (0.4, 1000.0);
    let (modulus, bulk, grains) = (1e7, 2e8, 2650.0);
    let density = (1.0 - porosity) * grains + porosity * water;
    let undrained: f64 = (modulus + bulk / porosity) / density;
    Column {
        height: 1.0,
        modulus,
        bulk,
        porosity,
        grains,
        water,
        drag: porosity * porosity * water * GRAVITY / k,
        // So small that the top sinks by nothing beside a cell: the traction stays where it is in space.
        load: 1.0,
        ramp: 40.0 / undrained.sqrt(),
    }
}

/// Water of a porosity in soil with a conductivity \[m/s\].
pub fn water(porosity: f64, k: f64) -> PoreWater {
    PoreWater {
        porosity,
        grain_density: 2650.0,
        density: 1000.0,
        bulk: 2e8,
        conductivity: [k; 3],
        permeability: Permeability::Constant,
        conductivity_gravity: GRAVITY,
    }
}

/// The smooth ramp of a load, in rows.
pub fn ramp(load: f64, over: f64) -> History {
    const ROWS: usize = 4000;
    let s = (0..=ROWS).map(|i| i as f64 / ROWS as f64);
    let times = s.clone().map(|s| s * over).collect();
    let values = s.map(|s| {
        let f = s * s * s * (10.0 + s * (6.0 * s - 15.0));
        [0.0, -load * f, 0.0]
    });
    History {
        times,
        values: values.collect(),
    }
}

/// A strip of one cell between sliding sides on a shut base, its top free and drained, loaded by the smooth ramp.
pub fn strip(of: &Column, k: f64, cells: usize, scheme: StressScheme) -> Scene {
    let h = of.height / cells as f64;
    let mut scene = empty(Dimension::Two, [1, cells + 2, 1], h);
    scene.materials = vec![material(elastic(of.modulus, 0.0))];
    scene.materials[0].density = of.grains;
    scene.pore_water = vec![Some(water(of.porosity, k))];
    scene.scheme = scheme;
    scene.transfer = FLIP;
    scene.mesh.planes = [[proctor_scene::PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[1][1] = proctor_scene::PlaneCondition::Free;
    scene.mesh.planes[2] = [proctor_scene::PlaneCondition::Free; 2];
    scene.water_planes = scene.mesh.planes;
    scene.bodies = vec![body(1, cuboid([0.0; 3], [h, of.height, 0.0]))];
    scene.tractions = vec![Traction {
        p1: [0.0, of.height, 0.0],
        p2: [h, of.height, 0.0],
        traction: ramp(of.load, of.ramp),
    }];
    scene.time_step = TimeStep::Multiplier {
        multiplier: 0.35,
        allow_unstable: false,
    };
    scene
}

/// The column at a time, in cells of this number.
pub fn run(of: &Column, k: f64, cells: usize, scheme: StressScheme, time: f64) -> Simulation {
    let mut simulation = simulation(&strip(of, k, cells, scheme));
    simulation.run_until(time).expect("the step is stable");
    simulation
}

/// Means over the cells of pore pressure and effective stress, from the base up \[Pa\].
pub fn means(simulation: &Simulation, h: f64, cells: usize) -> Vec<[f64; 2]> {
    let set = &simulation.sets()[0];
    let column = set.layout.pore_pressure().expect("there is water");
    let mut sums = vec![([0.0; 2], 0.0); cells];
    for p in 0..set.len() {
        let cell = ((set.position(p)[1] / h) as usize).min(cells - 1);
        let values = [set.columns[column][p], set.stress(p)[1]];
        for (sum, value) in sums[cell].0.iter_mut().zip(values) {
            *sum += value;
        }
        sums[cell].1 += 1.0;
    }
    sums.iter()
        .map(|(sum, count)| sum.map(|s| s / count))
        .collect()
}
