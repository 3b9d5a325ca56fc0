//! The volumetric strain as a mean over cells.

use crate::common::{
    DENSITY, DIMENSIONS, NEVER, TRANSFERS, body, calm, cuboid, distance, elastic, empty, material,
    momentum_scale, options, particles, rough, run, simulation_from, weightings_and_schemes,
};
use proctor_laws::AnyLaw;
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::{InitialField, InitialState, Options, Simulation, plan};
use proctor_scene::{Dimension, Scene, StressScheme, TimeStep, VolumetricStrain, Weighting};
use std::sync::Arc;

const YOUNG: f64 = 1.0e6;

/// A block off the nodes of a mesh of cells of 0.1 m, its volumetric strain a mean over cells.
fn averaged(dimension: Dimension, poisson: f64) -> Scene {
    let mut scene = empty(dimension, [9, 8, 7], 0.1);
    scene.materials = vec![material(elastic(YOUNG, poisson))];
    scene.bodies = vec![body(1, cuboid([0.21, 0.22, 0.23], [0.61, 0.52, 0.53]))];
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    scene
}

/// A velocity that is linear in the coordinates, and no stress.
fn linear(dimension: Dimension) -> InitialField {
    let flat = dimension == Dimension::Two;
    let gradient = [[0.3, -0.2, 0.1], [0.4, 0.5, -0.3], [-0.1, 0.2, -0.6]];
    let gradient: [[f64; 3]; 3] = std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            if flat && (a == 2 || b == 2) {
                0.0
            } else {
                gradient[a][b]
            }
        })
    });
    Arc::new(move |x| InitialState {
        velocity: gradient.map(|row| (0..3).map(|axis| row[axis] * x[axis]).sum()),
        velocity_gradient: gradient,
        stress: [0.0; 6],
        deformation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    })
}

/// Nothing is lost of a strain that is the same everywhere: the mean of a linear field's divergence is the divergence.
#[test]
fn uniform_strain_is_that_of_the_particles() {
    for dimension in DIMENSIONS {
        for (weighting, scheme) in weightings_and_schemes() {
            let mut scene = averaged(dimension, 0.3);
            // Nodal velocities at the edge of a body are linear with an affine transfer alone.
            scene.transfer = TRANSFERS[2];
            scene.weighting = weighting;
            scene.scheme = scheme;
            calm(&mut scene);
            let after = |volumetric_strain| {
                let scene = Scene {
                    volumetric_strain,
                    ..scene.clone()
                };
                let mut simulation = simulation_from(&scene, linear(dimension));
                run(&mut simulation, 1);
                particles(&simulation)
            };
            let usual = after(VolumetricStrain::Particle);
            let mean = after(VolumetricStrain::CellAverage);
            let scale = usual
                .iter()
                .flat_map(|p| p.3)
                .fold(0.0, |most: f64, s| most.max(s.abs()));
            assert!(scale > 1.0);
            for (usual, mean) in usual.iter().zip(&mean) {
                let off = distance(&usual.3, &mean.3) / scale;
                // Light nodes carry the round-off of their weights.
                assert!(off < 1e-6, "{dimension:?} {weighting:?} {scheme:?}: {off}");
            }
        }
    }
}

/// The particles of a cell, whose domains do not leave it, have one volumetric strain.
#[test]
fn a_cell_has_one_volumetric_strain() {
    for dimension in DIMENSIONS {
        for weighting in [Weighting::Linear, Weighting::UniformGimp] {
            let mut scene = averaged(dimension, 0.3);
            scene.weighting = weighting;
            scene.time_step = TimeStep::Fixed {
                dt: 1e-5,
                allow_unstable: false,
            };
            scene.bodies = vec![body(1, cuboid([0.2, 0.2, 0.2], [0.6, 0.5, 0.5]))];
            let spread = |volumetric_strain| {
                let scene = Scene {
                    volumetric_strain,
                    ..scene.clone()
                };
                let mut simulation = simulation_from(&scene, rough(dimension, 1e-8, 0.0, 3));
                run(&mut simulation, 1);
                spread_in_cells(&simulation)
            };
            let (usual, mean) = (
                spread(VolumetricStrain::Particle),
                spread(VolumetricStrain::CellAverage),
            );
            assert!(usual > 1e-2, "{dimension:?} {weighting:?}: {usual}");
            assert!(mean < 1e-12, "{dimension:?} {weighting:?}: {mean}");
        }
    }
}

/// Largest difference of the traces of stress in a cell, over the largest trace.
fn spread_in_cells(simulation: &Simulation) -> f64 {
    let axes = simulation.scene().dimension.axes();
    let mut cells: std::collections::BTreeMap<[i64; 3], Vec<f64>> =
        std::collections::BTreeMap::new();
    for (_, x, _, stress) in particles(simulation) {
        let cell = x.map(|x| (x / 0.1).floor() as i64);
        cells
            .entry(cell)
            .or_default()
            .push(stress[..axes].iter().sum());
    }
    let range = |values: &[f64]| {
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - values.iter().copied().fold(f64::INFINITY, f64::min)
    };
    let all: Vec<f64> = cells.values().flatten().copied().collect();
    let largest = all.iter().fold(0.0, |most: f64, t| most.max(t.abs()));
    cells
        .values()
        .map(|values| range(values))
        .fold(0.0, f64::max)
        / largest
}

/// Forces and strains belong together: what the stress loses in a step is the work of its forces, and momentum stays to
/// round-off.
#[test]
fn momentum_stays_and_stress_loses_the_work_of_its_forces() {
    for dimension in DIMENSIONS {
        for (weighting, scheme) in weightings_and_schemes() {
            if scheme != StressScheme::Usl {
                continue;
            }
            let mut scene = averaged(dimension, 0.4999);
            scene.weighting = weighting;
            let c = AnyLaw::from(elastic(YOUNG, 0.4999)).wave_speed(DENSITY);
            let dt = 0.003 * 0.1 / c;
            scene.time_step = TimeStep::Fixed {
                dt,
                allow_unstable: false,
            };
            let options = Options {
                initial: Some(rough(dimension, 0.0, 1.0, 5)),
                measure: true,
                ..options()
            };
            let mut simulation = Simulation::new(&scene, &options).expect("the scene is sound");
            let before = simulation.strain_energy();
            let info = simulation.step(NEVER).expect("a step");
            let (kinetic, _) = info.measured.expect("it was asked for");
            // From rest the first kick is dt/2: f_I = 2 m_I v_I / dt, and the work over the step is sum f_I v_I dt.
            let lost = (before - simulation.strain_energy()) / (4.0 * kinetic);
            assert!(
                (lost - 1.0).abs() < 1e-3,
                "{dimension:?} {weighting:?}: {lost}"
            );
            let off = distance(&[0.0; 3], &simulation.momentum()) / momentum_scale(&simulation);
            assert!(off < 1e-12, "{dimension:?} {weighting:?}: {off}");
        }
    }
}

/// Its request is in the plan; without it a material that would lock is warned of, with the ratio that the scene gave.
#[test]
fn the_plan_warns_of_locking() {
    let warnings = |poisson: f64, volumetric_strain| {
        let scene = Scene {
            volumetric_strain,
            ..averaged(Dimension::Two, poisson)
        };
        plan(&scene, PlanOptions::default()).warnings
    };
    for poisson in [-0.5, 0.0, 0.3, 0.49] {
        assert_eq!(
            warnings(poisson, VolumetricStrain::Particle),
            [""; 0],
            "{poisson}"
        );
    }
    for poisson in [0.491, 0.4999, 0.49999] {
        let said = warnings(poisson, VolumetricStrain::Particle);
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].contains(&format!("{poisson:.6}")) && said[0].contains("locks"),
            "{said:?}"
        );
        assert_eq!(
            warnings(poisson, VolumetricStrain::CellAverage),
            [""; 0],
            "{poisson}"
        );
    }
}
