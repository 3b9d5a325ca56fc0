//! Planes at which the pressure of the water is given, and the water table.

use super::support::{GRAVITY, column, strip, water};
use crate::common::{IDENTITY, body, cuboid, run, simulation, simulation_from};
use proctor_kernel::layout::Layout;
use proctor_scene::plan::{PlanOptions, plan};
use proctor_scene::simulation::{InitialState, Simulation};
use proctor_scene::{
    DomainUpdate, History, InitialPressure, ParticleSeed, PlaneCondition, PlanePressure, Scene,
    Shape, StressScheme, Traction, Vector, Weighting,
};
use std::sync::Arc;

const GIVEN: f64 = 1e3; // Pressure [Pa]
const CELLS: usize = 8;

/// Velocity of water and skeleton, and pressure of the water of a particle.
fn state(simulation: &Simulation, p: usize) -> (f64, f64, f64) {
    let set = &simulation.sets()[0];
    let first = set.layout.water.expect("there is water");
    let pressure = set.layout.pore_pressure().expect("there is water");
    let v = set.velocity(p)[1];
    (set.vector(first, p)[1], v, set.columns[pressure][p])
}

/// A column with a pressure at its base, one pressure in it at the start, and no load.
fn under_pressure(k: f64) -> Scene {
    let mut scene = strip(&column(k), k, CELLS, StressScheme::Usl);
    scene.tractions.clear();
    scene.water_planes[1][0] = PlaneCondition::Free;
    scene.water_pressures[1][0] = Some(PlanePressure::Uniform(GIVEN));
    scene
}

/// Water under the pressure that it has already moves nowhere, at a plane that holds the skeleton and at one that does not,
/// where the traction is that of the water.
#[test]
fn the_pressure_that_is_given_rests() {
    for free in [false, true] {
        let mut scene = under_pressure(1e-3);
        scene.mesh.cells[1] = CELLS;
        scene.initial_pressures = vec![InitialPressure::Material {
            id: 1,
            pressure: GIVEN,
        }];
        if free {
            scene.water_pressures[1] = [None, Some(PlanePressure::Uniform(GIVEN))];
            scene.water_planes[1] = [PlaneCondition::Sliding, PlaneCondition::Free];
            scene.tractions = vec![Traction {
                p1: [0.0, 1.0, 0.0],
                p2: [1.0 / CELLS as f64, 1.0, 0.0],
                traction: History::from([0.0, -GIVEN, 0.0]),
            }];
        } else {
            scene.mesh.planes[1][1] = PlaneCondition::Sliding;
            scene.water_planes[1][1] = PlaneCondition::Sliding;
        }
        let mut simulation = simulation(&scene);
        run(&mut simulation, 1000);
        for p in 0..simulation.sets()[0].len() {
            let (w, v, pressure) = state(&simulation, p);
            assert!(
                w.abs() < 1e-12 && v.abs() < 1e-12,
                "free {free}: {w:e} {v:e}"
            );
            assert!(
                (pressure / GIVEN - 1.0).abs() < 1e-9,
                "free {free}: {pressure}"
            );
        }
    }
}

/// Ground whose upper end lies beyond a plane with a given pressure by a share of a cell, and whose lower one ends as far before the
/// opposite plane, rests under the pressure that it has: the area that the water pushes is that of the ground.
#[test]
fn the_pressure_rests_on_ground_that_ends_beside_the_plane() {
    let h = 1.0 / CELLS as f64;
    let follows = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    for weighting in [Weighting::UniformGimp, follows] {
        for share in [1.0 / 7.0, 0.2] {
            let mut scene = under_pressure(1e-3);
            scene.weighting = weighting;
            scene.mesh.cells[1] = CELLS;
            scene.mesh.planes[1] = [PlaneCondition::Free; 2];
            scene.water_planes[1] = [PlaneCondition::Free; 2];
            scene.water_pressures[1] = [(); 2].map(|()| Some(PlanePressure::Uniform(GIVEN)));
            scene.initial_pressures = vec![InitialPressure::Material {
                id: 1,
                pressure: GIVEN,
            }];
            let places = (0..2).flat_map(|i| (0..2 * CELLS).map(move |j| [i, j]));
            let seeds = places.map(|[i, j]| {
                let [x, y] = [i, j].map(|k| 0.5 * h * (k as f64 + 0.5));
                ParticleSeed {
                    position: [x, y + share * h, 0.0],
                    volume: 0.25 * h * h,
                }
            });
            scene.bodies = vec![body(1, Shape::Particles(Arc::new(seeds.collect())))];
            scene.bodies[0].particles_per_cell = [2, 2, 1];
            // The total traction is that of the water, at the nodes where the ground ends.
            let traction = |y: f64, pressure: f64| Traction {
                p1: [0.0, y, 0.0],
                p2: [h, y, 0.0],
                traction: History::from([0.0, pressure, 0.0]),
            };
            scene.tractions = vec![
                traction(1.0, -GIVEN),
                traction(0.0, (1.0 - share) * GIVEN),
                traction(h, share * GIVEN),
            ];
            let mut simulation = simulation(&scene);
            run(&mut simulation, 200);
            for p in 0..simulation.sets()[0].len() {
                let (w, v, pressure) = state(&simulation, p);
                assert!(
                    w.abs() < 1e-9 && v.abs() < 1e-9,
                    "{weighting:?} {share}: {w:e} {v:e}"
                );
                let off = (pressure / GIVEN - 1.0).abs();
                assert!(off < 1e-6, "{weighting:?} {share}: {off:e}");
            }
        }
    }
}

/// Soil that slides by less than anything through sides at which the pressure is the one that it has: the domains that reach beyond a
/// side and those that end before it by as much change nothing, in each scheme.
#[test]
fn the_pressure_rests_where_soil_slides_through_its_plane() {
    let follows = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    for (scheme, weighting) in [
        (StressScheme::Usl, Weighting::UniformGimp),
        (StressScheme::Musl, Weighting::UniformGimp),
        (StressScheme::Usl, follows),
    ] {
        let mut scene = under_pressure(1e-4);
        scene.scheme = scheme;
        scene.weighting = weighting;
        scene.mesh.cells = [2, CELLS, 1];
        scene.mesh.planes[0] = [PlaneCondition::Antisymmetric; 2];
        scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
        scene.water_planes[0] = [PlaneCondition::Free; 2];
        scene.water_planes[1] = [PlaneCondition::Sliding; 2];
        let given = || Some(PlanePressure::Uniform(GIVEN));
        scene.water_pressures = [[given(), given()], [None, None], [None, None]];
        scene.initial_pressures = vec![InitialPressure::Material {
            id: 1,
            pressure: GIVEN,
        }];
        scene.bodies = vec![body(1, cuboid([0.0; 3], [2.0 / CELLS as f64, 1.0, 0.0]))];
        // The sides bear what stands at the start.
        let moving = |_: &Vector| InitialState {
            velocity: [1e-6, 0.0, 0.0],
            velocity_gradient: [[0.0; 3]; 3],
            stress: [GIVEN, 0.0, 0.0, 0.0, 0.0, 0.0],
            deformation: IDENTITY,
        };
        let mut simulation = simulation_from(&scene, Arc::new(moving));
        run(&mut simulation, 100);
        for p in 0..simulation.sets()[0].len() {
            let (_, _, pressure) = state(&simulation, p);
            let off = (pressure / GIVEN - 1.0).abs();
            // The way is 3e-8 cells, and a side lacks twice that.
            assert!(off < 1e-6, "{scheme:?} {weighting:?}: {off:e}");
        }
    }
}

/// Darcy: through a column with a pressure at its base and none at its top flows k p/(rho g H), the pressure falls in a straight
/// line, and the total stress stays nothing. What the pressure does the drag takes.
#[test]
fn water_flows_from_the_pressure_as_darcy_says() {
    let k = 1e-2;
    let mut simulation = simulation(&under_pressure(k));
    simulation.run_until(1.0).expect("the step is stable");
    let flux = k * GIVEN / (1000.0 * GRAVITY);
    for p in 0..simulation.sets()[0].len() {
        let (w, v, pressure) = state(&simulation, p);
        let set = &simulation.sets()[0];
        let [mass, volume] = [Layout::MASS, Layout::VOLUME].map(|column| set.columns[column][p]);
        let n = water(0.4, k).porosity_of(mass, volume);
        assert!((n * (w - v) / flux - 1.0).abs() < 1e-2, "{w}");
        // The step of the strain in a cell is one over twice the cells.
        let exact = GIVEN * (1.0 - set.position(p)[1]);
        let total = set.stress(p)[1] - pressure;
        assert!(
            (pressure - exact).abs() < GIVEN / (2.0 * CELLS as f64),
            "{pressure} {exact}"
        );
        assert!(total.abs() < 1e-2 * GIVEN, "{total}");
    }
    let energy = simulation.energy();
    assert!(energy.external_work > 0.0 && energy.drag > 0.0);
    let left = energy.remainder.abs() / energy.external_work;
    // Twice what the smooth load of the prototype leaves, since this one comes on at once.
    assert!(left < 1e-3, "{left}");
}

/// Water that stands beyond the base presses as much as it is deep, and as it sinks the pressure at the base sinks with it.
#[test]
fn the_level_at_the_base_gives_the_pressure_of_its_depth() {
    let k = 1e-2;
    let (high, low) = (1.5, 0.5);
    let mut scene = under_pressure(k);
    scene.gravity = [0.0, -10.0, 0.0];
    scene.water_pressures[1][0] = Some(PlanePressure::Level(History {
        times: vec![0.0, 0.1],
        values: vec![[high, 0.0, 0.0], [low, 0.0, 0.0]],
    }));
    let mut simulation = simulation(&scene);
    simulation.run_until(1.0).expect("the step is stable");
    // Up against the weight with the head of the base over that of the drained top, which is the height.
    let flux = k * (low - 1.0);
    for p in 0..simulation.sets()[0].len() {
        let (w, v, _) = state(&simulation, p);
        assert!((0.4 * (w - v) / flux - 1.0).abs() < 1e-2, "{w} {v}");
    }
}

/// Below the table the pressure is that of water at rest, above it there is none; whichever way gravity points.
#[test]
fn the_table_gives_the_pressure_of_water_at_rest() {
    for (g, level) in [(-10.0, 0.6), (10.0, 0.4)] {
        let mut scene = strip(&column(1e-3), 1e-3, CELLS, StressScheme::Usl);
        scene.tractions.clear();
        scene.gravity = [0.0, g, 0.0];
        scene.initial_pressures = vec![InitialPressure::Table { level }];
        let simulation = simulation(&scene);
        for p in 0..simulation.sets()[0].len() {
            let y = simulation.sets()[0].position(p)[1];
            let exact = 1e4 * if g < 0.0 { level - y } else { y - level }.max(0.0);
            let (_, _, found) = state(&simulation, p);
            assert!((found - exact).abs() < 1e-9, "{found} {exact}");
        }
    }
}

#[test]
fn what_has_no_form_is_refused_by_name() {
    let found = |change: fn(&mut Scene)| {
        let mut scene = under_pressure(1e-3);
        change(&mut scene);
        format!("{}", scene.check().expect_err("it is refused"))
    };
    let shut = found(|scene| scene.water_planes[1][0] = PlaneCondition::Sliding);
    assert!(shut.contains("boundary_pressures_fluid.plane_Y0"), "{shut}");
    let level = found(|scene| {
        scene.initial_pressures = vec![InitialPressure::Table { level: 1.0 }];
    });
    assert!(level.contains("water_table"), "{level}");
    let weightless = found(|scene| {
        scene.water_pressures[1][0] = Some(PlanePressure::Level(History::from([1.0, 0.0, 0.0])));
    });
    assert!(
        weightless.contains("boundary_levels_fluid.plane_Y0"),
        "{weightless}"
    );
    let shut_side = found(|scene| scene.mesh.planes[0][0] = PlaneCondition::Antisymmetric);
    assert!(
        shut_side.contains("boundary_conditions_fluid.plane_X0"),
        "{shut_side}"
    );
    let dry = found(|scene| scene.pore_water.clear());
    assert!(dry.contains("boundary_pressures_fluid"), "{dry}");
}

#[test]
fn water_that_is_shut_in_is_told() {
    let told = |change: fn(&mut Scene)| {
        let mut scene = strip(&column(1e-3), 1e-3, CELLS, StressScheme::Usl);
        scene.mesh.cells[1] = CELLS;
        change(&mut scene);
        plan(&scene, PlanOptions::default()).warnings
    };
    let about = |warnings: Vec<String>, words: &str| {
        warnings
            .iter()
            .filter(|warning| warning.contains(words))
            .count()
    };
    assert_eq!(about(told(|_| ()), "water"), 0);
    let top = |scene: &mut Scene| scene.water_planes[1][1] = PlaneCondition::Sliding;
    assert_eq!(about(told(top), "plane_Yn `free` drains it"), 1);
    let all = |scene: &mut Scene| {
        scene.water_planes[1][1] = PlaneCondition::Sliding;
        scene.mesh.planes[1][1] = PlaneCondition::Sliding;
    };
    assert_eq!(about(told(all), "all planes are shut for its water"), 1);
}
