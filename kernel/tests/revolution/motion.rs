//! Motion: kinematics of rings, energy, bits, and a run in two parts.

use super::{cylinder, revolved};
use crate::common::{
    FLIP, NEO_HOOKEAN, SCHEMES, TRANSFERS, WEIGHTINGS, all_lanes, body, cuboid, material, options,
    run, simulation, simulation_from,
};
use proctor_kernel::lanes::LaneChoice;
use proctor_scene::simulation::{InitialField, InitialState, Options, Simulation};
use proctor_scene::{DomainUpdate, Scene, Shape, Weighting};
use std::f64::consts::PI;
use std::sync::Arc;

const CPGIMP: Weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);

/// A radial pulse and a motion along the axis, smooth and large.
fn pulse(speed: f64) -> InitialField {
    Arc::new(move |x| InitialState {
        velocity: [
            speed * (3.0 * x[0]).sin(),
            speed * (2.0 * x[0] + 5.0 * x[1]).cos(),
            0.0,
        ],
        velocity_gradient: [
            [3.0 * speed * (3.0 * x[0]).cos(), 0.0, 0.0],
            [
                -2.0 * speed * (2.0 * x[0] + 5.0 * x[1]).sin(),
                -5.0 * speed * (2.0 * x[0] + 5.0 * x[1]).sin(),
                0.0,
            ],
            [0.0; 3],
        ],
        ..InitialState::default()
    })
}

/// The mass is that of the body of revolution.
#[test]
fn mass_is_that_of_the_full_circle() {
    let solid = simulation(&cylinder());
    let exact = 1000.0 * PI * 0.25 * 0.4;
    assert!((solid.mass() / exact - 1.0).abs() < 1e-14);
    let mut scene = revolved([32, 64], 0.02);
    scene.bodies = vec![body(
        1,
        Shape::Sphere {
            center: [0.0, 0.64, 0.0],
            radius: 0.5,
        },
    )];
    let ball = simulation(&scene);
    let exact = 1000.0 * 4.0 / 3.0 * PI * 0.125;
    assert!(
        (ball.mass() / exact - 1.0).abs() < 5e-3,
        "{}",
        ball.mass() / exact
    );
}

/// The hoop stretch of a particle is its radius over that of the start.
#[test]
fn hoop_stretch_is_the_ratio_of_radii() {
    for weighting in [
        Weighting::Linear,
        Weighting::UniformGimp,
        CPGIMP,
        Weighting::QuadraticBSpline,
    ] {
        for transfer in TRANSFERS {
            let mut scene = cylinder();
            scene.materials = vec![material(NEO_HOOKEAN)];
            (scene.weighting, scene.transfer) = (weighting, transfer);
            crate::common::calm(&mut scene);
            if transfer != FLIP && transfer.pic_fraction < 1.0 {
                continue;
            }
            let mut simulation = simulation_from(&scene, pulse(3.0));
            let start: Vec<f64> = (0..simulation.sets()[0].len())
                .map(|p| radius(&simulation, p))
                .collect();
            let ids = simulation.sets()[0].id.clone();
            run(&mut simulation, 60);
            let set = &simulation.sets()[0];
            let mut largest = 0.0_f64;
            for p in 0..set.len() {
                let first = ids
                    .iter()
                    .position(|id| *id == set.id[p])
                    .expect("it is there");
                let stretch = radius(&simulation, p) / start[first];
                let hoop = simulation.deformation(0, p).expect("kept")[2][2];
                assert!(
                    (hoop / stretch - 1.0).abs() < 1e-12,
                    "{weighting:?} {transfer:?} {hoop} {stretch}"
                );
                let f = simulation.deformation(0, p).expect("kept");
                let ratio = (f[0][0] * f[1][1] - f[0][1] * f[1][0]) * f[2][2];
                let volume = simulation.particle_volume(0, p) * 1000.0;
                let exact = simulation.particle_mass(0, p) * ratio;
                assert!(
                    (volume / exact - 1.0).abs() < 1e-12,
                    "{weighting:?} {volume} {exact}"
                );
                largest = largest.max((stretch - 1.0).abs());
            }
            assert!(largest > 0.005, "it moves: {largest}");
        }
    }
}

fn radius(simulation: &Simulation, p: usize) -> f64 {
    simulation.position(0, p)[0]
}

/// The hoop force is the transpose of the hoop strain: a free body loses about as much energy as the same body of the plane, to what
/// FLIP cannot hold at the nodes and, with MUSL and USF, to the second mapping.
#[test]
fn a_free_body_keeps_its_energy_as_in_the_plane() {
    for weighting in [CPGIMP, Weighting::QuadraticBSpline] {
        for scheme in SCHEMES {
            let lost = |axisymmetric: bool| {
                let mut scene = cylinder();
                scene.mesh.axisymmetric = axisymmetric;
                scene.materials = vec![material(NEO_HOOKEAN)];
                (scene.weighting, scene.scheme) = (weighting, scheme);
                let mut simulation = simulation_from(&scene, pulse(0.3));
                let before = simulation.energy();
                let whole = before.kinetic + before.strain;
                while simulation.time() < 0.02 {
                    simulation.step(0.02).expect("a stable step");
                }
                let energy = simulation.energy();
                assert!(energy.strain > 0.05 * whole, "{scheme:?} {energy:?}");
                energy.dissipated / whole
            };
            let (ring, plane) = (lost(true), lost(false));
            assert!(
                ring.abs() < 1.5 * plane.abs() + 0.01,
                "{weighting:?} {scheme:?}: {ring} against {plane}"
            );
        }
    }
}

/// A rigid motion along the axis strains nothing.
#[test]
fn a_motion_along_the_axis_strains_nothing() {
    for weighting in WEIGHTINGS {
        let mut scene = cylinder();
        scene.weighting = weighting;
        crate::common::calm(&mut scene);
        scene.bodies[0].velocity = [0.0, -0.5, 0.0];
        let mut simulation = simulation(&scene);
        run(&mut simulation, 50);
        let stress = (0..simulation.sets()[0].len()).flat_map(|p| simulation.sets()[0].stress(p));
        let most = stress.fold(0.0_f64, |most, s| most.max(s.abs()));
        assert!(most < 1e-6, "{weighting:?}: {most} Pa");
        let v = simulation.sets()[0].velocity(7);
        assert!((v[1] + 0.5).abs() < 1e-12 && v[0].abs() < 1e-12, "{v:?}");
    }
}

/// Every scheme, transfer and weighting on one thread, two and three, and on all lanes.
#[test]
fn bits_do_not_depend_on_threads_or_lanes() {
    for weighting in [
        Weighting::Linear,
        Weighting::UniformGimp,
        CPGIMP,
        Weighting::QuadraticBSpline,
    ] {
        for scheme in SCHEMES {
            for transfer in [FLIP, TRANSFERS[2], TRANSFERS[3]] {
                let mut scene = cylinder();
                (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                crate::common::calm(&mut scene);
                let hash = |options: Options| {
                    let initial = Some(pulse(1.0));
                    let mut simulation =
                        Simulation::new(&scene, &Options { initial, ..options }).expect("sound");
                    run(&mut simulation, 30);
                    simulation.state_hash()
                };
                let one = hash(options());
                for threads in [2, 3] {
                    let many = Options {
                        threads: Some(threads),
                        least_share: Some(1),
                        ..options()
                    };
                    assert_eq!(
                        hash(many),
                        one,
                        "{weighting:?} {scheme:?} {threads} threads"
                    );
                }
                for choice in crate::common::lanes() {
                    let other = options().with_lanes(choice);
                    assert_eq!(hash(other), one, "{weighting:?} {scheme:?} {choice:?}");
                }
            }
        }
    }
    assert!(!all_lanes().is_empty() && LaneChoice::Scalar != LaneChoice::Avx512);
}

#[test]
fn a_run_in_two_parts_has_the_same_bits() {
    let mut scene = cylinder();
    scene.materials = vec![material(NEO_HOOKEAN)];
    scene.weighting = CPGIMP;
    let mut whole = simulation_from(&scene, pulse(1.0));
    run(&mut whole, 20);
    let saved = whole.save();
    let mut resumed = simulation(&scene);
    resumed.restore(saved).expect("the same scene");
    run(&mut whole, 20);
    run(&mut resumed, 20);
    assert_eq!(resumed.state_hash(), whole.state_hash());
}

/// A mesh that begins beyond the axis is a ring; its numbers are those of a mesh from the axis on.
#[test]
fn a_mesh_beyond_the_axis_is_the_same_ring() {
    let ring = |first: f64| -> Scene {
        let mut scene = revolved([20, 8], 0.1);
        scene.mesh.origin[0] = first;
        scene.bodies = vec![body(1, cuboid([1.2, 0.2, 0.0], [1.7, 0.6, 0.0]))];
        scene.bodies[0].particles_per_cell = [2, 2, 1];
        scene
    };
    let after = |first: f64| {
        let mut simulation = simulation_from(&ring(first), pulse(0.3));
        run(&mut simulation, 50);
        crate::common::particles(&simulation)
    };
    for (a, b) in after(0.0).iter().zip(&after(0.7)) {
        assert!(crate::common::distance(&a.1, &b.1) < 1e-12);
        assert!(crate::common::distance(&a.3, &b.3) < 1e-7 * 1e6);
    }
}
