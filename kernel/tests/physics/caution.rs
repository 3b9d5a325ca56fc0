//! Runs that end well with results that call for caution say so, and others do not.

use crate::common::{
    APIC, FLIP, SCHEMES, body, cuboid, elastic, empty, material, options, simulation,
};
use proctor_laws::{AnyLaw, NeoHookean};
use proctor_scene::simulation::{InitialState, ResultWarning, Simulation};
use proctor_scene::{
    Damping, Dimension, DomainUpdate, PlaneCondition, Scene, StressScheme, Transfer, Weighting,
};
use std::sync::Arc;

/// An elastic block that falls 1.5 m; the reported scene with cells of 0.5 m in place of 0.25 m.
fn bounce(law: impl Into<AnyLaw>) -> Scene {
    let mut scene = empty(Dimension::Two, [16, 14, 1], 0.5);
    scene.scheme = StressScheme::Musl;
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    scene.gravity = [0.0, -9.8, 0.0];
    scene.materials = vec![material(law)];
    scene.bodies = vec![body(1, cuboid([2.0, 1.5, 0.0], [6.0, 5.5, 0.0]))];
    scene
}

fn until(scene: &Scene, time: f64) -> Simulation {
    let mut simulation = simulation(scene);
    while simulation.time() < time {
        if let Err(error) = simulation.step(time) {
            panic!("{error}");
        }
    }
    simulation
}

fn cautions(simulation: &mut Simulation) -> Vec<ResultWarning> {
    let energy = simulation.energy();
    simulation.cautions(&energy)
}

#[test]
fn energy_from_nowhere_and_large_strain_of_incremental_elasticity_are_told() {
    let mut simulation = until(&bounce(elastic(4.0e5, 0.25)), 1.4);
    let energy = simulation.energy();
    let all = simulation.cautions(&energy);
    let [
        ResultWarning::Energy {
            remainder,
            scale,
            causes,
        },
        ResultWarning::Strain { volume_change, .. },
    ] = &all[..]
    else {
        panic!("{all:?} {energy:?}");
    };
    assert_eq!(*remainder, energy.remainder);
    assert!(*remainder < -0.02 * scale && *scale >= energy.external_work);
    assert!(causes[0].contains("neo_hookean") && causes[0].contains("hencky"));
    assert!(volume_change.abs() > 0.2, "{volume_change}");
    let text = all[0].to_string();
    assert!(
        text.contains("came from nowhere") && text.contains('%'),
        "{text}"
    );
    assert!(all[1].to_string().contains("J - 1"), "{}", all[1]);
}

#[test]
fn a_law_with_an_energy_and_a_stiff_block_need_no_caution() {
    for law in [
        AnyLaw::from(NeoHookean::new(4.0e5, 0.25)),
        elastic(4.0e7, 0.25).into(),
    ] {
        for scheme in SCHEMES {
            let mut scene = bounce(law.clone());
            scene.scheme = scheme;
            for transfer in [FLIP, APIC] {
                // FLIP with USF makes energy of an impact, 5 % of it for the stiff block.
                if scheme == StressScheme::Usf && transfer == FLIP {
                    continue;
                }
                scene.transfer = transfer;
                let mut simulation = until(&scene, 0.7);
                let all = cautions(&mut simulation);
                assert_eq!(all, [], "{law:?} {scheme:?} {transfer:?}");
            }
        }
    }
}

/// A bar that hangs from a plane, whose own weight over Young's modulus is `load`, without lateral strain.
fn hanging(load: f64, weighting: Weighting) -> Scene {
    let mut scene = empty(Dimension::Two, [2, 18, 1], 0.1);
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1] = [PlaneCondition::Free, PlaneCondition::Fixed];
    scene.weighting = weighting;
    scene.transfer = APIC;
    scene.damping = Damping::Local { alpha: 0.3 };
    scene.gravity = [0.0, -load * 100.0, 0.0];
    scene.materials = vec![material(NeoHookean::new(1.0e5, 0.0))];
    scene.bodies = vec![body(1, cuboid([0.0, 0.8, 0.0], [0.2, 1.8, 0.0]))];
    scene
}

#[test]
fn domains_that_do_not_follow_a_large_stretch_are_told() {
    // The bars still swing, of which their runs tell as well.
    let found = |load: f64, weighting: Weighting| {
        let mut all = cautions(&mut until(&hanging(load, weighting), 0.6));
        all.retain(|caution| !matches!(caution, ResultWarning::Motion(_)));
        all
    };
    let determinant = Weighting::ContiguousGimp(DomainUpdate::Determinant);
    for (weighting, words) in [
        (determinant, "\"domain_update\": \"stretch\""),
        (Weighting::QuadraticBSpline, "B-spline"),
    ] {
        let all = found(0.4, weighting);
        let [ResultWarning::Stretch { ratio, .. }] = &all[..] else {
            panic!("{all:?}");
        };
        // 1.477 at rest.
        assert!((1.3..2.2).contains(ratio), "{ratio}");
        assert!(all[0].to_string().contains(words), "{}", all[0]);
        assert_eq!(found(0.1, weighting), []);
    }
    for update in [DomainUpdate::Stretch, DomainUpdate::LeftStretch] {
        assert_eq!(found(0.4, Weighting::ContiguousGimp(update)), []);
    }
}

/// A block of four cells that spins freely loses most of its spin with FLIP, and the run says so; with APIC it keeps it, and
/// beside planes that could turn it nothing is known.
#[test]
fn lost_spin_is_a_reason_for_caution() {
    let spun = |transfer: Transfer, planes: PlaneCondition| {
        let mut scene = empty(Dimension::Two, [10, 10, 1], 1.0).with_planes(planes);
        scene.transfer = transfer;
        scene.materials = vec![material(elastic(1.0e6, 0.3))];
        scene.bodies = vec![body(1, cuboid([3.0, 3.0, 0.0], [7.0, 7.0, 0.0]))];
        scene.bodies[0].particles_per_cell = [2, 2, 1];
        let omega = 0.5;
        let mut options = options();
        options.initial = Some(Arc::new(move |x| InitialState {
            velocity: [-omega * (x[1] - 5.0), omega * (x[0] - 5.0), 0.0],
            velocity_gradient: [[0.0, -omega, 0.0], [omega, 0.0, 0.0], [0.0; 3]],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }));
        let mut simulation = Simulation::new(&scene, &options).expect("sound");
        simulation.run_until(8.0).expect("a step");
        let all = cautions(&mut simulation);
        all.into_iter().find_map(|caution| match caution {
            ResultWarning::Spin { lost } => Some(lost),
            _ => None,
        })
    };
    let lost = spun(FLIP, PlaneCondition::Free).expect("a caution");
    assert!((0.05..1.5).contains(&lost), "{lost}");
    assert_eq!(spun(APIC, PlaneCondition::Free), None);
    assert_eq!(spun(FLIP, PlaneCondition::Sliding), None);
}

/// A damped bar that is let go swings for a while. Its run tells so until it rests, whatever takes the motion out of it.
#[test]
fn damped_bodies_that_still_move_are_told() {
    let motion = |scene: &Scene, time: f64| {
        let all = cautions(&mut until(scene, time)).into_iter();
        let mut all = all.filter(|caution| matches!(caution, ResultWarning::Motion(_)));
        all.next().map(|caution| caution.to_string())
    };
    let mut scene = hanging(0.01, Weighting::UniformGimp);
    for (damping, rest) in [
        (Damping::Local { alpha: 0.3 }, 4.0),
        (Damping::Viscous { alpha: 0.1 }, 6.0),
    ] {
        (scene.scheme, scene.damping) = (StressScheme::Usl, damping);
        let told = motion(&scene, 0.25).unwrap_or_else(|| panic!("{damping:?}"));
        assert!(
            told.contains("not at rest") && !told.contains("USL"),
            "{told}"
        );
        assert_eq!(motion(&scene, rest), None, "{damping:?}");
    }
    (scene.scheme, scene.damping) = (StressScheme::Musl, Damping::Local { alpha: 0.3 });
    let told = motion(&scene, 0.25).expect("it moves");
    assert!(told.contains("USL"), "{told}");
    // Kinetic damping has taken the motion of the first mode at its first peak.
    (scene.scheme, scene.damping) = (StressScheme::Usl, Damping::Kinetic);
    assert_eq!(motion(&scene, 6.0), None);
    // No rest is due.
    (scene.scheme, scene.damping) = (StressScheme::Musl, Damping::Local { alpha: 0.3 });
    let mut free = scene.clone();
    free.damping = Damping::None;
    assert_eq!(motion(&free, 0.25), None, "nothing takes the motion away");
    let mut driven = scene.clone();
    driven
        .bodies
        .push(body(2, cuboid([0.0, 0.2, 0.0], [0.2, 0.4, 0.0])));
    driven.bodies[1].motion = Some([0.01, 0.0, 0.0].into());
    assert_eq!(motion(&driven, 0.25), None, "a body is driven on");
    driven.bodies[1].motion = Some([0.0; 3].into());
    assert!(motion(&driven, 0.25).is_some(), "a driven body stands");
}
