//! Two dimensions are three with one cell across and sliding sides.

use crate::common::{
    APIC, DIMENSIONS, FLIP, NEO_HOOKEAN, block, body, cuboid, distance, elastic, empty, material,
    particles, run, simulation_from, weightings_and_schemes,
};
use proctor_scene::simulation::{InitialState, Simulation};
use proctor_scene::{
    Damping, Dimension, DomainUpdate, PlaneCondition, PointLoad, Scene, TimeStep, Traction,
    Weighting,
};
use std::collections::HashMap;
use std::sync::Arc;

const H: f64 = 0.1;

fn plate(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [8, 7, 1], H);
    let thick = if dimension == Dimension::Two { 0.0 } else { H };
    scene.mesh.planes = [
        [PlaneCondition::Fixed, PlaneCondition::Free],
        [PlaneCondition::Sliding, PlaneCondition::Sliding],
        [PlaneCondition::Sliding, PlaneCondition::Sliding],
    ];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.5, 0.3, thick]))];
    scene.gravity = [2.0, -10.0, 0.0];
    // The neo-Hookean bound on the wave speed is tighter in two dimensions, and with it the automatic step.
    scene.time_step = TimeStep::Fixed {
        dt: 5.0e-4,
        allow_unstable: false,
    };
    // Per metre of thickness in two dimensions; on one of the two faces in three, each half of the cell.
    let share = if dimension == Dimension::Two {
        1.0
    } else {
        0.5 * H
    };
    let faces = if dimension == Dimension::Two {
        vec![0.0]
    } else {
        vec![0.0, H]
    };
    scene.point_loads = faces
        .into_iter()
        .map(|z| PointLoad {
            position: [0.4, 0.2, z],
            force: [50.0 * share, 20.0 * share, 0.0],
        })
        .collect();
    scene.tractions = vec![Traction {
        p1: [0.13, 0.3, 0.0],
        p2: [0.36, 0.3, thick],
        traction: [0.0, -400.0, 0.0].into(),
    }];
    scene
}

fn simulate(scene: &Scene) -> Simulation {
    let mut simulation = simulation_from(
        scene,
        Arc::new(|x| InitialState {
            velocity_gradient: [[0.0; 3]; 3],
            velocity: [
                (5.0 * x[0] + 3.0 * x[1]).sin(),
                (4.0 * x[0] - 6.0 * x[1]).cos(),
                0.0,
            ],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }),
    );
    run(&mut simulation, 60);
    simulation
}

#[test]
fn one_cell_across_is_plane_strain() {
    for (i, (weighting, scheme)) in weightings_and_schemes().enumerate() {
        // det F^(1/d) is another length in another dimension: the two runs differ on purpose.
        if weighting == Weighting::ContiguousGimp(DomainUpdate::Determinant) {
            continue;
        }
        let [two, three] = [Dimension::Two, Dimension::Three].map(|dimension| {
            let mut scene = plate(dimension);
            (scene.weighting, scene.scheme) = (weighting, scheme);
            scene.transfer = if i % 2 == 0 { FLIP } else { APIC };
            scene.materials = vec![if i % 4 < 2 {
                material(elastic(1.0e6, 0.3))
            } else {
                material(NEO_HOOKEAN)
            }];
            scene.damping = if i % 3 == 0 {
                Damping::Local { alpha: 0.2 }
            } else {
                Damping::None
            };
            crate::common::calm(&mut scene);
            simulate(&scene)
        });
        let name = format!("{weighting:?} {scheme:?} {i}");
        let flat = particles(&two);
        assert_eq!(2 * flat.len(), three.particles(), "two layers of particles");
        assert!(
            (two.time() - three.time()).abs() < 1.0e-12,
            "{name}: {} {}",
            two.time(),
            three.time()
        );
        for (_, x, v, s) in particles(&three) {
            let (_, y, w, t) = flat
                .iter()
                .min_by(|a, b| {
                    let off = |p: &[f64; 3]| (p[0] - x[0]).hypot(p[1] - x[1]);
                    off(&a.1).total_cmp(&off(&b.1))
                })
                .expect("there are particles");
            assert!(
                (x[0] - y[0]).abs().max((x[1] - y[1]).abs()) < 1.0e-10 * H,
                "{name} {x:?} {y:?}"
            );
            assert!(distance(&v, w) < 1.0e-10, "{name} {v:?} {w:?}");
            assert!(distance(&s, t) < 1.0e-10 * 1.0e6, "{name} {s:?} {t:?}");
        }
        // Something happened.
        assert!(flat.iter().any(|p| p.3[1].abs() > 1.0e3), "{name}");
    }
}

/// By the determinant a domain grows as a cube or a square of its volume does.
#[test]
fn a_domain_grows_by_the_root_of_its_volume() {
    for dimension in DIMENSIONS {
        let mut scene = block(dimension);
        scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Determinant);
        let axes = dimension.axes();
        let mut simulation = simulation_from(
            &scene,
            Arc::new(move |x| InitialState {
                velocity: std::array::from_fn(|axis| if axis < axes { 8.0 * x[axis] } else { 0.0 }),
                velocity_gradient: [[0.0; 3]; 3],
                stress: [0.0; 6],
                deformation: crate::common::IDENTITY,
            }),
        );
        let volumes = |simulation: &Simulation| -> Vec<(u64, f64)> {
            let set = &simulation.sets()[0];
            (0..set.len())
                .map(|p| (set.id[p], simulation.particle_volume(0, p)))
                .collect()
        };
        let before: HashMap<u64, f64> = volumes(&simulation).into_iter().collect();
        run(&mut simulation, 5);
        let set = &simulation.sets()[0];
        let (now, start) = (set.layout.half_length, set.layout.initial_half_length);
        let (now, start) = (now.expect("kept"), start.expect("kept"));
        let mut most = 0.0_f64;
        for (p, (id, volume)) in volumes(&simulation).into_iter().enumerate() {
            let grown = volume / before[&id];
            most = most.max(grown);
            for axis in 0..axes {
                let length = set.columns[now + axis][p] / set.columns[start + axis][p];
                let root = grown.powf(1.0 / axes as f64);
                assert!(
                    (length / root - 1.0).abs() < 1e-12,
                    "{dimension:?}: {length} {root}"
                );
            }
        }
        assert!(most > 1.02, "{dimension:?}: {most}");
    }
}
