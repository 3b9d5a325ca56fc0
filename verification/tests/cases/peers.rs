//! Scenes of MPM-Geomechanics with water, as they are printed there, beside the exact series of the columns that they are.

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Scene, TimeStep};
use proctor_verification::exact::two_phase_column::{SuddenLoads, TwoPhaseColumn};
use std::path::Path;

/// The scene of a file.
fn scene(name: &str) -> Scene {
    let path = format!("../fixtures/scenes/peers/{name}.json");
    proctor_files::json::read(Path::new(&path)).expect("it is sound")
}

fn options() -> Options {
    Options {
        threads: Some(1),
        ..Options::default()
    }
}

/// Means of the pore pressure over layers of a height (m), from the base up.
fn layers(simulation: &Simulation, height: f64, count: usize) -> Vec<f64> {
    let set = &simulation.sets()[0];
    let column = set.layout.pore_pressure().expect("there is water");
    let mut sums = vec![[0.0; 2]; count];
    for p in 0..set.len() {
        let layer = (set.position(p)[2] / height) as usize;
        let sum = &mut sums[layer.min(count - 1)];
        *sum = [sum[0] + set.columns[column][p], sum[1] + 1.0];
    }
    sums.iter().map(|[sum, count]| sum / count).collect()
}

/// Height at the start (m) of the upper layer of particles, and its displacement.
fn top(simulation: &Simulation) -> [f64; 2] {
    let set = &simulation.sets()[0];
    let start = set.layout.displacement_origin.expect("it is written");
    let z = &set.columns[start + 2];
    let highest = z.iter().copied().fold(0.0, f64::max);
    let upper: Vec<usize> = (0..set.len()).filter(|p| z[*p] == highest).collect();
    let sum: f64 = upper.iter().map(|p| set.position(*p)[2] - z[*p]).sum();
    [highest, sum / upper.len() as f64]
}

/// The skeleton and the water of a layer 10 m high on a shut base.
fn column(young: f64, bulk_water: f64, porosity: f64, density_grains: f64) -> TwoPhaseColumn {
    TwoPhaseColumn {
        height: 10.0,
        // Poisson's ratio is 0.3.
        confined_modulus: young * 0.7 / (1.3 * 0.4),
        bulk_water,
        porosity,
        density_grains,
        density_water: 1000.0,
        conductivity: 1e-3,
        gravity: 9.81,
        load: 0.0,
        ramp: 1.0,
    }
}

/// A hundred steps in which the water begins to drain at the top. The printed step is above what is stable wherever particles lie in
/// their cells, so that the scene is refused as it stands; these particles stay where they are, and it goes well.
#[test]
fn the_printed_consolidation_drains_as_the_series() {
    let mut scene = scene("consolidation");
    let refused = Simulation::new(&scene, &options()).err();
    let refused = refused.expect("the step is above the bound").to_string();
    assert!(refused.contains("critical time step"), "{refused}");
    scene.time_step = TimeStep::Fixed {
        dt: 1e-4,
        allow_unstable: true,
    };
    let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
    simulation.run_until(scene.time).expect("it is stable");

    let loads = SuddenLoads {
        load: 1e3,
        pressure: 1e3,
        gravity: 0.0,
    };
    let exact = column(50e6, 500e6, 0.3, 2600.0).after(loads, simulation.time(), 2000);
    let (mut squares, mut largest) = (0.0, [0.0_f64; 2]);
    for (i, p) in layers(&simulation, 0.2, 50).into_iter().enumerate() {
        let low = 0.2 * i as f64;
        let apart = (p - exact.mean_pressure(low, low + 0.2)) / 1e3;
        // The front of the wave is at the base, and is spread over some cells; the top drains.
        let place = usize::from(low < 2.0);
        largest[place] = largest[place].max(apart.abs());
        squares += apart * apart / 50.0;
    }
    let [z, u] = top(&simulation);
    let sinks = (u / exact.displacement(z) - 1.0).abs();
    let [above, below] = largest;
    let mean = squares.sqrt();
    println!("above {above:.1e}, below {below:.1e}, mean {mean:.1e}, top {sinks:.1e}");
    assert!(above < 0.01 && below < 0.025, "{above} {below}");
    assert!(mean < 0.006, "{mean}");
    assert!(sinks < 0.15);
}

/// Gravity that comes on at once: the column swings about a state that drains. Means over a period of the swing are those of the
/// series for all of the five seconds, a third of the consolidation.
#[test]
#[ignore = "takes 9 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn the_printed_two_phases_drain_as_the_series() {
    const TIMES: usize = 40;
    let scene = scene("two_phase");
    let column = column(20e6, 20e6, 0.2, 2500.0);
    let period = 4.0 * column.height / column.undrained_speed();
    let loads = SuddenLoads {
        gravity: 10.0,
        ..SuddenLoads::default()
    };
    let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
    for middle in [0.5, 2.0, scene.time - 0.5 * period] {
        let mut means = [[0.0; 2]; 20];
        let mut settlement = [0.0; 2];
        for i in 0..TIMES {
            let t = middle + period * (i as f64 / TIMES as f64 - 0.5);
            simulation.run_until(t).expect("it is stable");
            let exact = column.after(loads, simulation.time(), 200);
            for (i, p) in layers(&simulation, 0.5, 20).into_iter().enumerate() {
                let low = 0.5 * i as f64;
                means[i][0] += p / TIMES as f64;
                means[i][1] += exact.mean_pressure(low, low + 0.5) / TIMES as f64;
            }
            let [z, u] = top(&simulation);
            settlement[0] += u;
            settlement[1] += exact.displacement(z);
        }
        // Over the pressure at the base, which is the largest.
        let apart = |[found, exact]: [f64; 2]| (found - exact).abs() / means[0][1];
        let pressure = means.into_iter().map(apart).fold(0.0, f64::max);
        let sinks = (settlement[0] / settlement[1] - 1.0).abs();
        println!("{middle:.2} s: pressure {pressure:.1e}, settlement {sinks:.1e}");
        assert!(pressure < 0.01 && sinks < 0.005, "{pressure} {sinks}");
    }
    assert!(simulation.time() > scene.time - period);
}
