//! Water that stands beside bodies: buoyancy, columns at rest below it, a level that falls, a dam with water on one side.

use super::support::{column, means, strip};
use crate::common::{
    DENSITY, FLIP, IDENTITY, WEIGHTINGS, block, body, cuboid, elastic, empty, material, options,
    run, simulation, simulation_from,
};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{
    Dimension, History, InitialPressure, InitialStress, PlaneCondition, Scene, Shore,
    StandingWater, StressScheme, TransferKind, Vector, VolumetricStrain, Weighting,
};
use std::sync::Arc;

const WATER: f64 = 1000.0; // Density of the water [kg/m³]
const DRY: f64 = 2000.0; // Density of a column without water in its pores [kg/m³]
const G: f64 = 10.0; // Gravity [m/s²]
const LEVEL: f64 = 1.5; // Level above the columns, which are 1 m high [m]

fn standing(level: impl Into<History>) -> StandingWater {
    StandingWater {
        level: level.into(),
        density: WATER,
        bodies: vec![],
        shore: None,
    }
}

/// A body as heavy as the water, with its pressure as stress, rests below a level of 2 m for 500 steps.
fn require_rest(mut scene: Scene, what: &str) {
    scene.bodies[0].initial_stress = InitialStress::AtRest {
        ratio: 1.0,
        level: 2.0,
        surcharge: 0.0,
    };
    scene.standing_waters = vec![standing([2.0, 0.0, 0.0])];
    let mut simulation = simulation(&scene);
    run(&mut simulation, 500);
    let set = &simulation.sets()[0];
    for p in 0..set.len() {
        for v in set.velocity(p) {
            assert!(v.abs() < 1e-11, "{what}: {v:e}");
        }
    }
}

/// The block under water, in free space.
fn submerged(dimension: Dimension) -> Scene {
    let mut scene = block(dimension);
    scene.gravity = [0.0; 3];
    scene.gravity[dimension.axes() - 1] = -G;
    scene.standing_waters = vec![standing([2.0, 0.0, 0.0])];
    scene
}

/// Archimedes: what the block gets is its weight less that of the water in its place, to round-off, with any weighting function,
/// and the work of both is its kinetic energy.
#[test]
fn a_block_under_water_has_its_buoyancy() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for weighting in WEIGHTINGS {
            let mut scene = submerged(dimension);
            scene.weighting = weighting;
            scene.materials[0].density = 2.5 * DENSITY;
            let mut simulation = simulation(&scene);
            let up = dimension.axes() - 1;
            let volume = simulation.mass() / (2.5 * DENSITY);
            let info = simulation.step(1.0).expect("the step is stable");
            let force = (WATER * volume - simulation.mass()) * G;
            let momentum = simulation.momentum();
            for axis in 0..3 {
                let exact = if axis == up {
                    0.5 * info.dt * force
                } else {
                    0.0
                };
                let off = (momentum[axis] - exact).abs() / (WATER * volume * G * info.dt);
                assert!(
                    off < 1e-13,
                    "{dimension:?} {weighting:?} axis {axis}: {off:e}"
                );
            }
        }
    }
}

/// A block as heavy as the water, whose stress is the pressure around it, does not stir: what its surface gets and the stress behind it
/// cancel at every node, wherever the faces lie in their cells.
#[test]
fn a_block_that_the_water_carries_rests() {
    for averaged in [false, true] {
        for dimension in [Dimension::Two, Dimension::Three] {
            let mut scene = submerged(dimension);
            scene.materials[0].density = WATER;
            if averaged {
                scene.volumetric_strain = VolumetricStrain::CellAverage;
            }
            let up = dimension.axes() - 1;
            scene.bodies[0].initial_stress = InitialStress::AtRest {
                ratio: 1.0,
                level: 2.0,
                surcharge: 0.0,
            };
            let mut simulation = simulation(&scene);
            run(&mut simulation, 500);
            let set = &simulation.sets()[0];
            for p in 0..set.len() {
                let v = set.velocity(p)[up];
                assert!(v.abs() < 1e-11, "{averaged} {dimension:?}: {v:e}");
            }
        }
    }
}

/// The same block on smooth ground: its buoyancy comes back from beyond the plane as its weight does.
#[test]
fn a_block_that_the_water_carries_rests_on_a_plane() {
    for weighting in WEIGHTINGS {
        for ends in [0, 1] {
            let mut scene = empty(Dimension::Two, [5, 8, 1], 0.125);
            scene.weighting = weighting;
            scene.materials[0].density = WATER;
            // Its base or its top lies in a plane.
            let at = [0.0, 0.5][ends];
            scene.mesh.planes[1] = [PlaneCondition::Free; 2];
            scene.mesh.planes[1][ends] = PlaneCondition::Sliding;
            scene.gravity = [0.0, -G, 0.0];
            scene.bodies = vec![body(1, cuboid([0.125, at, 0.0], [0.375, at + 0.5, 0.0]))];
            require_rest(scene, &format!("{weighting:?} {ends}"));
        }
    }
}

/// The same block beside a smooth plane: what functions that reach beyond the plane carry there comes back to the nodes inside, of the
/// water as of the stress and the weight.
#[test]
fn a_block_that_the_water_carries_rests_beside_a_plane() {
    for weighting in WEIGHTINGS {
        let mut scene = empty(Dimension::Two, [5, 10, 1], 0.125);
        scene.weighting = weighting;
        scene.materials[0].density = WATER;
        scene.mesh.planes[0] = [PlaneCondition::Sliding, PlaneCondition::Free];
        scene.gravity = [0.0, -G, 0.0];
        scene.bodies = vec![body(1, cuboid([0.0, 0.5, 0.0], [0.25, 1.0, 0.0]))];
        require_rest(scene, &format!("{weighting:?}"));
    }
}

/// The work of the water is in the books: a light block whose stress is the pressure around it rises as a whole.
#[test]
fn the_work_of_the_water_is_booked() {
    let mut scene = submerged(Dimension::Two);
    scene.materials[0].density = 0.5 * WATER;
    let pressed = |x: &Vector| {
        let p = WATER * G * (2.0 - x[1]);
        InitialState {
            velocity_gradient: [[0.0; 3]; 3],
            velocity: [0.0; 3],
            stress: [-p, -p, -p, 0.0, 0.0, 0.0],
            deformation: IDENTITY,
        }
    };
    let mut simulation = simulation_from(&scene, Arc::new(pressed));
    let before = simulation.center(0).position[1];
    simulation.run_until(0.05).expect("the step is stable");
    let energy = simulation.energy();
    let rose = simulation.center(0).position[1] - before;
    let volume = simulation.mass() / (0.5 * WATER);
    let exact = 0.5 * WATER * volume * G * rose;
    assert!(exact > 0.0, "{exact}");
    let left = energy.remainder.abs() / exact;
    assert!(left < 1e-2, "{left}");
    let off = (energy.kinetic / exact - 1.0).abs();
    assert!(off < 1e-2, "{} {exact}", energy.kinetic);
}

/// A dry column between smooth walls with water above it.
fn under_water(scheme: StressScheme) -> Scene {
    let mut scene = empty(Dimension::Two, [1, 10, 1], 0.125);
    scene.materials = vec![material(elastic(1e7, 0.25))];
    scene.materials[0].density = DRY;
    scene.scheme = scheme;
    scene.transfer = FLIP;
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[1][1] = PlaneCondition::Free;
    scene.mesh.planes[2] = [PlaneCondition::Free; 2];
    scene.gravity = [0.0, -G, 0.0];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.125, 1.0, 0.0]))];
    scene.bodies[0].initial_stress = InitialStress::AtRest {
        ratio: 1.0 / 3.0,
        level: 1.0,
        surcharge: WATER * G * (LEVEL - 1.0),
    };
    scene.standing_waters = vec![standing([LEVEL, 0.0, 0.0])];
    scene
}

/// A column bears its weight and the water above it: begun with these stresses it rests, in each scheme.
#[test]
fn a_column_under_a_level_has_its_exact_stress() {
    for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
        let mut simulation = simulation(&under_water(scheme));
        run(&mut simulation, 500);
        let set = &simulation.sets()[0];
        for p in 0..set.len() {
            let depth = 1.0 - set.position(p)[1];
            let exact = -(WATER * G * (LEVEL - 1.0) + DRY * G * depth);
            let off = (set.stress(p)[1] / exact - 1.0).abs();
            assert!(off < 1e-9, "{scheme:?}: {off:e}");
            let v = set.velocity(p)[1];
            assert!(v.abs() < 1e-11, "{scheme:?}: {v:e}");
        }
    }
}

/// A column of wet soil under water: its pores have the pressure of the level, its skeleton bears the buoyant weight.
fn wet(level: History) -> Scene {
    let k = 1e-2;
    let mut scene = strip(&column(k), k, 8, StressScheme::Usl);
    scene.tractions.clear();
    scene.gravity = [0.0, -G, 0.0];
    scene.bodies[0].initial_stress = InitialStress::AtRest {
        ratio: 0.0,
        level: 1.0,
        surcharge: 0.0,
    };
    scene.initial_pressures = vec![InitialPressure::Table { level: LEVEL }];
    scene.standing_waters = vec![standing(level)];
    scene
}

/// Velocities of skeleton and water, effective stress and pore pressure of a particle.
fn state(simulation: &Simulation, p: usize) -> [f64; 4] {
    let set = &simulation.sets()[0];
    let first = set.layout.water.expect("there is water");
    let pressure = set.layout.pore_pressure().expect("there is water");
    [
        set.velocity(p)[1],
        set.vector(first, p)[1],
        set.stress(p)[1],
        set.columns[pressure][p],
    ]
}

#[test]
fn a_wet_column_under_a_level_rests() {
    let mut simulation = simulation(&wet([LEVEL, 0.0, 0.0].into()));
    run(&mut simulation, 1000);
    let buoyant = 0.6 * (2650.0 - WATER) * G;
    for p in 0..simulation.sets()[0].len() {
        let depth = 1.0 - simulation.sets()[0].position(p)[1];
        let [v, w, stress, pressure] = state(&simulation, p);
        assert!(v.abs() < 1e-11 && w.abs() < 1e-11, "{v:e} {w:e}");
        let off = (stress + buoyant * depth).abs() / buoyant;
        assert!(off < 1e-9, "{stress} at {depth}");
        let exact = WATER * G * (LEVEL - 1.0 + depth);
        assert!((pressure / exact - 1.0).abs() < 1e-9, "{pressure} {exact}");
    }
}

/// The level falls by half a metre: the pores end with the pressure of the new level, the skeleton bears what it bore, and what
/// the level gave up is in the books.
#[test]
fn the_pores_follow_a_level_that_falls() {
    let now = 1.0;
    let level = History {
        times: vec![0.0, 0.2],
        values: vec![[LEVEL, 0.0, 0.0], [now, 0.0, 0.0]],
    };
    let mut simulation = simulation(&wet(level));
    simulation.run_until(1.0).expect("the step is stable");
    let buoyant = 0.6 * (2650.0 - WATER) * G;
    let (cells, h) = (8, 0.125);
    for (cell, [pressure, stress]) in means(&simulation, h, cells).into_iter().enumerate() {
        let depth = 1.0 - (cell as f64 + 0.5) * h;
        // A thousandth of the pressure that went: consolidation is over after ten times its time.
        let scale = 1e-3 * WATER * G * (LEVEL - now);
        let exact = WATER * G * (now - 1.0 + depth);
        assert!((pressure - exact).abs() < scale, "{pressure} {exact}");
        assert!((stress + buoyant * depth).abs() < scale, "{stress} {depth}");
    }
}

/// Water on one side of a block: half of the weight times the square of the depth pushes it, whatever the level cuts.
#[test]
fn a_dam_has_the_push_of_the_water_on_its_side() {
    for (side, level) in [(0, 0.42), (1, 0.47)] {
        let mut scene = submerged(Dimension::Two);
        scene.standing_waters[0].level = [level, 0.0, 0.0].into();
        scene.standing_waters[0].shore = Some(Shore {
            axis: 0,
            side,
            between: [0.3, 0.5],
        });
        let mut simulation = simulation(&scene);
        let info = simulation.step(1.0).expect("the step is stable");
        let push = 0.5 * WATER * G * (level - 0.22_f64).powi(2);
        let exact = if side == 0 { push } else { -push };
        let found = simulation.momentum()[0] / (0.5 * info.dt);
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
}

#[test]
fn threads_and_a_start_anew_change_no_bit() {
    let scene = wet(History {
        times: vec![0.0, 0.2],
        values: vec![[LEVEL, 0.0, 0.0], [1.0, 0.0, 0.0]],
    });
    let hashes = [1, 3].map(|threads| {
        let options = Options {
            threads: Some(threads),
            least_share: Some(1),
            ..options()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("the scene is sound");
        run(&mut simulation, 50);
        let saved = simulation.save();
        run(&mut simulation, 50);
        let on = simulation.state_hash();
        simulation.restore(saved).expect("the same scene");
        run(&mut simulation, 50);
        assert_eq!(simulation.state_hash(), on);
        on
    });
    assert_eq!(hashes[0], hashes[1]);
}

/// Two bodies that share the nodes between them, cut into as many slabs as their planes allow.
#[test]
fn slabs_of_wide_bodies_change_no_bit() {
    for (dimension, averaged) in [
        (Dimension::Two, false),
        (Dimension::Two, true),
        (Dimension::Three, false),
    ] {
        let mut scene = empty(dimension, [24, 8, 6], 0.1);
        let up = dimension.axes() - 1;
        scene.gravity[up] = -G;
        scene.materials[0].density = 0.5 * WATER;
        scene.mesh.planes[up][0] = PlaneCondition::Sliding;
        scene.bodies = [(1, [0.21, 1.13]), (2, [1.13, 1.98])]
            .map(|(id, [from, to])| body(id, cuboid([from, 0.0, 0.0], [to, 0.43, 0.37])))
            .to_vec();
        if averaged {
            scene.volumetric_strain = VolumetricStrain::CellAverage;
        }
        scene.standing_waters = vec![standing([0.31, 0.0, 0.0])];
        let hashes = [1, 2, 5].map(|threads| {
            let options = Options {
                threads: Some(threads),
                least_share: Some(1),
                ..options()
            };
            let mut simulation = Simulation::new(&scene, &options).expect("the scene is sound");
            run(&mut simulation, 60);
            simulation.state_hash()
        });
        assert_eq!(hashes[0], hashes[1], "{dimension:?} {averaged}");
        assert_eq!(hashes[0], hashes[2], "{dimension:?} {averaged}");
    }
}

#[test]
fn what_has_no_form_is_refused_by_name() {
    let found = |change: fn(&mut Scene)| {
        let mut scene = submerged(Dimension::Two);
        change(&mut scene);
        format!("{}", scene.check().expect_err("it is refused"))
    };
    let shore = |axis, between| Shore {
        axis,
        side: 0,
        between,
    };
    for (key, text) in [
        ("standing_water", found(|scene| scene.gravity = [0.0; 3])),
        (
            "standing_water[0].density",
            found(|scene| scene.standing_waters[0].density = 0.0),
        ),
        (
            "standing_water[0].body_ids[0]",
            found(|scene| scene.standing_waters[0].bodies = vec![7]),
        ),
        (
            "standing_water[0].level",
            found(|scene| scene.standing_waters[0].level.times.clear()),
        ),
        ("transfer", {
            let mut scene = submerged(Dimension::Two);
            scene.weighting = Weighting::QuadraticBSpline;
            scene.transfer = proctor_scene::Transfer::new(TransferKind::Mls);
            format!("{}", scene.check().expect_err("it is refused"))
        }),
        ("standing_water[0].side", {
            let mut scene = submerged(Dimension::Two);
            scene.standing_waters[0].shore = Some(shore(1, [0.2, 0.4]));
            format!("{}", scene.check().expect_err("it is refused"))
        }),
        ("standing_water[0].between", {
            let mut scene = submerged(Dimension::Two);
            scene.standing_waters[0].shore = Some(shore(0, [0.4, 0.2]));
            format!("{}", scene.check().expect_err("it is refused"))
        }),
    ] {
        assert!(text.contains(key), "{key}: {text}");
    }
}
