//! MLS: gradients of least squares, and what they are not derived for.

use crate::common::{
    DIMENSIONS, IDENTITY, MLS, NEVER, SCHEMES, TPIC, block, momentum_scale, rough, run,
    run_towards, simulation_from,
};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Dimension, DomainUpdate, Scene, Transfer, VolumetricStrain, Weighting};
use std::sync::Arc;

/// A block that no plane touches.
fn of(dimension: Dimension, transfer: Transfer) -> Scene {
    let mut scene = block(dimension);
    scene.weighting = Weighting::QuadraticBSpline;
    scene.transfer = transfer;
    scene
}

/// Velocities that are linear in space give every particle that gradient, at the edges of the body too: a linear field is its own
/// fit, whatever the weights.
#[test]
fn a_linear_velocity_has_its_gradient() {
    const GRADIENT: [[f64; 3]; 3] = [[0.3, -1.1, 0.2], [0.7, 0.4, -0.5], [-0.2, 0.6, -0.8]];
    for dimension in DIMENSIONS {
        let axes = dimension.axes();
        for scheme in SCHEMES {
            let mut scene = of(dimension, MLS);
            scene.scheme = scheme;
            let mut gradient = GRADIENT;
            if axes == 2 {
                for k in 0..3 {
                    (gradient[k][2], gradient[2][k]) = (0.0, 0.0);
                }
            }
            let start = Arc::new(move |x: &[f64; 3]| InitialState {
                velocity: gradient.map(|row| (0..3).map(|b| row[b] * x[b]).sum()),
                velocity_gradient: gradient,
                stress: [0.0; 6],
                deformation: IDENTITY,
            });
            let mut simulation = simulation_from(&scene, start);
            run(&mut simulation, 1);
            let set = &simulation.sets()[0];
            let first = set.layout.affine.expect("an affine velocity");
            for (at, expected) in (0..axes * axes).map(|i| (i, gradient[i / axes][i % axes])) {
                for found in &set.columns[first + at] {
                    assert!(
                        (found - expected).abs() < 1.0e-12,
                        "{dimension:?} {scheme:?} component {at}: {found} {expected}"
                    );
                }
            }
        }
    }
}

/// Forces sum to zero, as those of true gradients do.
#[test]
fn momentum_of_a_stressed_body_stays() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = of(dimension, MLS);
            scene.scheme = scheme;
            let mut simulation = simulation_from(&scene, rough(dimension, 1.0, 1.0e4, 11));
            let before = simulation.momentum();
            run(&mut simulation, 5);
            let (after, scale) = (simulation.momentum(), momentum_scale(&simulation));
            for axis in 0..3 {
                assert!((after[axis] - before[axis]).abs() <= 5.0e-14 * scale);
            }
        }
    }
}

/// It is no other transfer: where velocities are not linear, its gradients differ from those of the weighting functions.
#[test]
fn it_differs_from_tpic() {
    for dimension in DIMENSIONS {
        let hash = |transfer| {
            let mut simulation =
                simulation_from(&of(dimension, transfer), rough(dimension, 1.0, 1.0e3, 5));
            run(&mut simulation, 3);
            simulation.state_hash()
        };
        assert_ne!(hash(MLS), hash(TPIC));
    }
}

/// A long run with particles that cross cells; `bits` has all thread counts and lanes.
#[test]
fn three_threads_have_the_bits_of_one() {
    for dimension in DIMENSIONS {
        let hash = |threads| {
            let options = Options {
                threads: Some(threads),
                least_share: Some(1),
                initial: Some(crate::common::rough_drift(
                    dimension,
                    [3.0, 1.0, 0.0],
                    0.5,
                    1.0e3,
                    17,
                )),
                ..Options::default()
            };
            let scene = of(dimension, MLS);
            let mut simulation = Simulation::new(&scene, &options).expect("a sound scene");
            run_towards(&mut simulation, 40, NEVER);
            simulation.state_hash()
        };
        assert_eq!(hash(1), hash(3));
    }
}

#[test]
fn what_it_is_not_derived_for_is_refused() {
    let problems = |change: fn(&mut Scene)| -> Vec<String> {
        let mut scene = of(Dimension::Two, MLS);
        change(&mut scene);
        let found = scene.check().err().map_or(vec![], |error| error.problems);
        let all = found.iter().map(ToString::to_string);
        all.filter(|problem| problem.contains("MLS")).collect()
    };
    assert!(problems(|_| ()).is_empty());
    for change in [
        |scene: &mut Scene| scene.weighting = Weighting::Linear,
        |scene: &mut Scene| scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch),
    ] {
        assert_eq!(problems(change).len(), 1);
    }
    assert_eq!(
        problems(|scene| scene.weighting = Weighting::UniformGimp),
        [
            "transfer: found MLS with uGIMP; accepted: MLS with `shape_function` \"quadratic_bspline\", or APIC"
        ]
    );
    assert_eq!(
        problems(|scene| scene.volumetric_strain = VolumetricStrain::CellAverage),
        [
            "volumetric_strain: found cell_average with MLS; accepted: particle, or `transfer` APIC or TPIC: cell means \
          are those of derivatives"
        ]
    );
    assert_eq!(
        problems(|scene| scene.transfer.pic_fraction = 0.5),
        [
            "pic_fraction: found 0.5 with MLS; accepted: 1: its affine velocity carries the part that FLIP keeps in the particles"
        ]
    );
}
