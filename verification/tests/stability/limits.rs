//! Predictions against the spectral radius of the linear step and against runs.

use proctor_scene::{Dimension, StressScheme, TransferKind, Weighting};
use proctor_verification::case::{Gate, Size};
use proctor_verification::settings::Method;
use proctor_verification::stability::block::{Choice, Form, Place};
use proctor_verification::stability::map::{SCHEMES, TRANSFERS, WEIGHTINGS, choices};
use proctor_verification::stability::measured::Class;
use proctor_verification::stability::nonlinear;
use proctor_verification::stability::predicted::growth;

fn all(dimension: Dimension, particles_per_cell: usize) -> Vec<Choice> {
    let mut all = vec![];
    for weighting in WEIGHTINGS {
        for scheme in SCHEMES {
            for transfer in TRANSFERS {
                all.push(Choice {
                    method: Method {
                        weighting,
                        scheme,
                        transfer,
                    },
                    dimension,
                    particles_per_cell,
                });
            }
        }
    }
    all
}

/// Below the limit nothing grows, but for a drift that falls off with the number of steps; above it something does. This
/// is what the prediction takes for granted: that the first eigenvalue to leave the unit circle does so at -1.
#[test]
fn the_linear_step_grows_above_the_limit_and_not_below() {
    for choice in all(Dimension::Two, 2) {
        let worst = choice.worst_of(Form::LARGE).expect("a limit");
        let scene = choice.scene(worst.place);
        let below = growth(&scene, 0.98 * worst.courant, 400).expect("growth");
        let above = growth(&scene, 1.02 * worst.courant, 400).expect("growth");
        let name = choice.name();
        assert!(below < 1.005, "{name}: {below} per step below");
        assert!(above > 1.05, "{name}: {above} per step above");
    }
}

/// Every gate of a row but that on the kernel's step: measured limits lie where they were predicted.
#[test]
fn runs_become_unstable_where_it_was_predicted() {
    let sample = [
        (
            Weighting::UniformGimp,
            StressScheme::Usl,
            TransferKind::Flip,
            2,
        ),
        (
            Weighting::QuadraticBSpline,
            StressScheme::Usf,
            TransferKind::Apic,
            1,
        ),
        (Weighting::Linear, StressScheme::Musl, TransferKind::Tpic, 4),
    ];
    for (weighting, scheme, transfer, particles_per_cell) in sample {
        let choice = Choice {
            method: Method {
                weighting,
                scheme,
                transfer,
            },
            dimension: Dimension::Two,
            particles_per_cell,
        };
        let entry = choice.solve().expect("an entry");
        let ratio = entry.ratio().expect("a measured limit");
        let name = choice.name();
        assert!((1.0..1.05).contains(&ratio), "{name}: {ratio}");
        let predicted = |gate: &&Gate| gate.name.ends_with("over predicted");
        assert!(entry.gates().iter().filter(predicted).all(Gate::passed));
    }
}

/// Nowhere on the mesh is a body worse off than at the places that are asked.
#[test]
fn no_other_place_is_worse() {
    for (scheme, transfer, particles_per_cell) in [
        (StressScheme::Usl, TransferKind::Flip, 2),
        (StressScheme::Usl, TransferKind::Flip, 4),
        (StressScheme::Musl, TransferKind::Flip, 1),
        (StressScheme::Musl, TransferKind::Apic, 2),
    ] {
        let choice = Choice {
            method: Method {
                weighting: Weighting::UniformGimp,
                scheme,
                transfer,
            },
            dimension: Dimension::Two,
            particles_per_cell,
        };
        for form in Form::all(choice.dimension, particles_per_cell) {
            let worst = choice.worst_of(form).expect("a limit").courant;
            for k in 0..40_u32 {
                // Golden ratio: spread over the cell, and on none of the places.
                let offset = (f64::from(k) * 0.618_033_988_749_895).fract();
                let found = choice.predict(Place { form, offset }).expect("a limit");
                assert!(
                    found >= 0.995 * worst,
                    "{} {} at {offset}: {found} < {worst}",
                    choice.name(),
                    form.words()
                );
            }
        }
    }
}

#[test]
fn a_free_particle_of_flip_has_no_limit_with_musl() {
    let [usl, musl] = [StressScheme::Usl, StressScheme::Musl].map(|scheme| {
        let choice = Choice {
            method: Method {
                weighting: Weighting::UniformGimp,
                scheme,
                transfer: TransferKind::Flip,
            },
            dimension: Dimension::Two,
            particles_per_cell: 2,
        };
        choice.worst_of(Form::Particle).expect("a limit").courant
    });
    assert!(usl < 0.4, "{usl}");
    assert_eq!(musl, f64::INFINITY);
}

#[test]
fn the_map_has_every_method_once() {
    let quick = choices(Size::Quick);
    // Three sizes and schemes of four weighting functions with three transfers, and of B-splines with MLS.
    assert_eq!(quick.len(), 3 * 3 * (4 * 3 + 1));
    let full = choices(Size::Full);
    assert_eq!(full.len(), 2 * quick.len());
    for (i, choice) in full.iter().enumerate() {
        assert!(!full[..i].contains(choice), "{}", choice.name());
    }
}

#[test]
fn scenes_that_are_not_linear_hold_at_the_kernels_step() {
    for name in [
        "large-strain",
        "rotation",
        "von-mises",
        "mohr-coulomb",
        "newtonian",
        "grid-contact",
        "mortar-line",
        "moving-base",
    ] {
        let scene = nonlinear::ALL.iter().find(|scene| scene.name == name);
        let scene = scene.expect("a scene of that name");
        let limit = scene.solve(Method::DEFAULT, Size::Quick).expect("a limit");
        let gate = scene.gate(Method::DEFAULT, &limit);
        assert!(gate.passed(), "{name}: {limit:?}");
        let unstable = limit.measured.unstable.expect("a limit in the range");
        assert!(unstable > 1.0, "{name}: {limit:?}");
    }
}

/// A gate that no step could fail would say nothing: steps of a few times the kernel's own find energy from nowhere where
/// laws yield and where viscosity bounds the step, with every method.
#[test]
fn laws_that_dissipate_show_their_limits() {
    for name in ["von-mises", "mohr-coulomb", "newtonian"] {
        let scene = nonlinear::ALL.iter().find(|scene| scene.name == name);
        let scene = scene.expect("a scene of that name");
        assert_eq!(scene.methods(Size::Quick).len(), 2);
        for method in scene.methods(Size::Full) {
            let limit = scene.solve(method, Size::Full).expect("a limit");
            assert!(scene.gate(method, &limit).passed(), "{name}: {limit:?}");
            let unstable = limit.measured.unstable.expect("a limit in the range");
            assert!((1.0..4.0).contains(&unstable), "{name} {method}: {limit:?}");
            assert_eq!(limit.measured.class, Some(Class::TimeStep));
        }
    }
}
