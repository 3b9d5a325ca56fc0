//! Water at rest, and balances of both phases.

use super::support::{column, strip, water};
use crate::common::{FLIP, body, cuboid, elastic, empty, material, run, simulation};
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Dimension, PlaneCondition, Scene, StressScheme};

/// Two porosities above each other under one weight, at rest.
fn jump() -> (Scene, Simulation) {
    let (cells, h) = (16, 0.0625);
    let mut scene = empty(Dimension::Two, [1, cells, 1], h);
    let law = || material(elastic(1e7, 0.0));
    scene.materials = vec![law(), law()];
    scene.materials[1].id = 2;
    scene.materials[0].density = 2650.0;
    scene.materials[1].density = 2650.0;
    scene.pore_water = vec![Some(water(0.3, 1e-4)), Some(water(0.5, 1e-4))];
    scene.transfer = FLIP;
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[2] = [PlaneCondition::Free; 2];
    scene.water_planes = scene.mesh.planes;
    scene.bodies = vec![
        body(1, cuboid([0.0; 3], [h, 0.5, 0.0])),
        body(2, cuboid([0.0, 0.5, 0.0], [h, 1.0, 0.0])),
    ];
    scene.bodies[1].material = 1;
    let simulation = simulation(&scene);
    (scene, simulation)
}

/// One pressure everywhere in a shut box of two porosities: nothing moves, whatever the porosity does.
#[test]
fn one_pressure_over_a_jump_of_the_porosity_rests() {
    let (mut scene, _) = jump();
    scene.initial_pressures = [1, 2]
        .map(|id| proctor_scene::InitialPressure::Material { id, pressure: 1e4 })
        .to_vec();
    let mut simulation = simulation(&scene);
    run(&mut simulation, 2000);
    for set in simulation.sets() {
        let first = set.layout.water.expect("there is water");
        let pressure = set.layout.pore_pressure().expect("there is water");
        for p in 0..set.len() {
            let (v, w) = (set.velocity(p), set.vector(first, p));
            assert!((w[1] - v[1]).abs() <= 1e-12, "{w:?} beside {v:?}");
            let p = set.columns[pressure][p];
            assert!((p / 1e4 - 1.0).abs() < 1e-9, "{p}");
        }
    }
}

/// A wet block in free space, with noise in both velocities and in the pressure: what one phase gains the other loses.
#[test]
fn drag_and_pressure_give_no_momentum() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for scheme in [StressScheme::Usl, StressScheme::Musl] {
            let mut scene = crate::common::block(dimension);
            scene.materials[0].density = 2650.0;
            scene.pore_water = vec![Some(water(0.4, 1e-3))];
            scene.scheme = scheme;
            scene.transfer = FLIP;
            let mut simulation = simulation(&scene);
            let mut saved = simulation.save();
            let set = &mut saved.state.sets[0];
            let (first, axes) = (set.layout.water.expect("there is water"), set.layout.axes);
            for p in 0..set.len() {
                let noise = |salt: usize| ((p * 7919 + salt * 104_729) % 1000) as f64 / 500.0 - 1.0;
                for axis in 0..axes {
                    set.columns[first + axis][p] = 1e-3 * noise(axis);
                    set.columns[Layout::velocity(axes) + axis][p] = 1e-3 * noise(3 + axis);
                }
                set.columns[first + axes][p] = 1e3 * noise(6);
            }
            simulation.restore(saved).expect("the same scene");
            for _ in 0..5 {
                let masses = |simulation: &Simulation| {
                    let set = &simulation.sets()[0];
                    let m = &set.columns[Layout::MASS];
                    let v = &set.columns[Layout::VOLUME];
                    let n = m.iter().zip(v).map(|(m, v)| 1000.0 * (v - m / 2650.0));
                    (m.clone(), n.collect::<Vec<f64>>())
                };
                let (grains, pores) = masses(&simulation);
                let momentum = |simulation: &Simulation, axis: usize| {
                    let set = &simulation.sets()[0];
                    let v = &set.columns[Layout::velocity(axes) + axis];
                    let w = &set.columns[first + axis];
                    let terms = (0..set.len()).map(|p| [grains[p] * v[p], pores[p] * w[p]]);
                    terms.fold([0.0, 0.0], |sum, [a, b]| {
                        [sum[0] + a + b, sum[1] + a.abs() + b.abs()]
                    })
                };
                let before: Vec<[f64; 2]> = (0..axes).map(|a| momentum(&simulation, a)).collect();
                run(&mut simulation, 1);
                for (axis, [before, scale]) in before.into_iter().enumerate() {
                    let [after, _] = momentum(&simulation, axis);
                    let lost = (after - before).abs() / scale;
                    assert!(
                        lost < 1e-14,
                        "{dimension:?} {scheme:?} axis {axis}: {lost:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let of = column(1e-3);
    let mut scene = strip(&of, 1e-3, 32, StressScheme::Musl);
    scene.bodies[0].particles_per_cell = [4, 4, 1];
    let hashes = [1, 2, 3].map(|threads| {
        let options = Options {
            threads: Some(threads),
            least_share: Some(1),
            ..Options::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("the scene is sound");
        run(&mut simulation, 40);
        simulation.state_hash()
    });
    assert_eq!(hashes[0], hashes[1]);
    assert_eq!(hashes[0], hashes[2]);
}
