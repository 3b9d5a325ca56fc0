//! Studies: own settings are what `verify` runs, other settings reach the scene, and observers see every phase.

use proctor_scene::simulation::Options;
use proctor_scene::{DomainUpdate, Scene, StressScheme, TimeStep, TransferKind, Weighting};
use proctor_verification::case::{self, Size};
use proctor_verification::settings::{Method, Settings};
use proctor_verification::study::{Observer, Phase, STOPPED, Study, all, few};

const METHOD: Method = Method {
    weighting: Weighting::ContiguousGimp(DomainUpdate::Determinant),
    // The one scheme that every study takes: USF is refused beside mortar contact.
    scheme: StressScheme::Musl,
    transfer: TransferKind::Tpic,
};

/// Studies of soil with water, which goes with uGIMP and FLIP alone.
const WITH_WATER: [&str; 3] = ["column-modal", "undrained-patch", "xie-leo"];

/// A method that shares as little as a study allows with that of its case.
fn other(study: Study) -> Method {
    if WITH_WATER.contains(&study.name()) {
        Method::DEFAULT.with_scheme(StressScheme::Musl)
    } else {
        METHOD
    }
}

fn one_thread() -> Options {
    Options {
        threads: Some(1),
        ..Options::default()
    }
}

fn coarsest(study: Study) -> proctor_verification::case::Rung {
    study.path(Size::Quick).swap_remove(0)
}

/// Settings with which every study can be solved.
fn usual() -> Settings {
    Settings {
        allow_unstable: true,
        ..Settings::new(Method::DEFAULT)
    }
    .courant(0.3)
}

/// Looks and counts; stops at once if told to.
#[derive(Default)]
struct Watch {
    phases: Vec<Phase>,
    stop: bool,
}

impl Observer for Watch {
    fn phase(&mut self, phase: Phase) {
        self.phases.push(phase);
    }

    fn stop(&self) -> bool {
        self.stop
    }
}

#[test]
#[ignore = "takes 18 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn own_settings_give_the_same_bits_watched_or_not() {
    for study in all() {
        let rung = coarsest(study);
        let own = study.case.own_settings(&rung);
        let alone = study.case.solve(&rung, &one_thread(), &mut |_| {});
        let mut watch = Watch::default();
        let watched = study.solve_with(&rung, &own, &one_thread(), &mut watch);
        let solved = watched.expect("own settings hold").solved;
        // As text: a curve may hold points that are not numbers, which part its lines.
        let alone = alone.expect("own settings hold");
        assert_eq!(
            format!("{alone:?}"),
            format!("{solved:?}"),
            "{}",
            study.name()
        );
        assert_eq!(
            watch.phases.first(),
            Some(&Phase::SetUp),
            "{}",
            study.name()
        );
        assert!(watch.phases.contains(&Phase::Stepping), "{}", study.name());
        assert_eq!(
            watch.phases.last(),
            Some(&Phase::Comparing),
            "{}",
            study.name()
        );
    }
}

#[test]
fn other_settings_reach_the_scene_and_its_step() {
    for study in all() {
        let rung = coarsest(study);
        let settings = |courant| {
            Settings {
                particles_per_cell: 3,
                allow_unstable: true,
                ..Settings::new(other(study))
            }
            .courant(courant)
        };
        let scene_with = |courant| {
            let scene = study.case.scene_with(&rung, &settings(courant));
            scene.expect("a scene")
        };
        let scene = scene_with(0.2);
        scene.check().unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(scene.weighting, other(study).weighting);
        assert_eq!(scene.scheme, other(study).scheme);
        // A case may need a share of PIC beside the transfer.
        assert_eq!(scene.transfer.kind, other(study).transfer);
        // A slab is one layer of cells with one particle across, as all depths are alike.
        let axes = if study.name().ends_with("-slab") {
            2
        } else {
            scene.dimension.axes()
        };
        for body in &scene.bodies {
            assert_eq!(body.particles_per_cell[..axes], [3; 3][..axes]);
            assert!(axes == 3 || body.particles_per_cell[2] == 1);
        }
        let step = |scene: &Scene| match scene.time_step {
            TimeStep::Fixed {
                dt,
                allow_unstable: true,
            } => dt,
            TimeStep::Multiplier {
                multiplier,
                allow_unstable: true,
            } => multiplier,
            other => panic!("{other:?}"),
        };
        // Equal steps to the end are whole in number, so half the Courant number is half the step but for that.
        let ratio = step(&scene_with(0.1)) / step(&scene);
        assert!((ratio - 0.5).abs() < 0.05, "{}: {ratio}", study.name());
    }
}

#[test]
#[ignore = "takes 6 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn measures_are_quantities_with_errors() {
    for study in all() {
        let rung = coarsest(study);
        let studied = study
            .solve_with(&rung, &usual(), &one_thread(), &mut Watch::default())
            .unwrap_or_else(|e| panic!("{e}"));
        assert!(!study.measures().is_empty());
        for measure in study.measures() {
            let error = studied.solved.error(measure.quantity);
            assert!(
                error > 0.0 && error < 1.0,
                "{} {}: {error}",
                study.name(),
                measure.word
            );
        }
        assert!(studied.dt > 0.0 && studied.dt_critical > 0.0);
    }
}

#[test]
fn an_observer_stops_a_run() {
    for study in all() {
        let mut watch = Watch {
            stop: true,
            ..Watch::default()
        };
        let stopped = study.solve_with(&coarsest(study), &usual(), &one_thread(), &mut watch);
        assert_eq!(stopped.expect_err("stopped").reason, STOPPED);
    }
}

#[test]
fn paths_refine_and_skip_no_halving() {
    for study in all() {
        for size in [Size::Quick, Size::Full] {
            let path = study.path(size);
            assert!(path.len() >= 2);
            for pair in path.windows(2) {
                let finer = pair[0].cell / pair[1].cell;
                assert!(
                    (1.5 - 1e-12..=2.0 + 1e-12).contains(&finer),
                    "{}: {finer}",
                    study.name()
                );
                assert_ne!(pair[0].label, pair[1].label);
            }
        }
    }
}

#[test]
fn every_case_has_a_study_or_a_reason_why_not() {
    let mut studies = all().into_iter().map(|study| study.name());
    for case in case::all() {
        match case.studied() {
            Ok(own) => {
                assert!(!own.is_empty(), "{}", case.name());
                for study in own {
                    // In the order of the cases, and no other beside them.
                    assert_eq!(studies.next(), Some(study.name()));
                    assert!(study.name().starts_with(case.name()), "{}", case.name());
                }
            }
            Err(reason) => assert!(reason.len() > 20, "{}: {reason}", case.name()),
        }
    }
    assert_eq!(studies.next(), None);
    // All but those whose reason is known: a case that loses its study is noticed.
    let without = case::all().iter().filter(|case| case.studied().is_err());
    let without: Vec<_> = without.map(|case| case.name()).collect();
    assert_eq!(
        without,
        [
            "incompressible-box",
            "plastic-wave",
            "yielding-column",
            "softening-bar",
            "footing",
            "collapse",
            "slope",
            "fluid",
            "element",
            "homogeneous",
            "shear-and-turn",
            "spin",
            "bar-energy",
            "angular-momentum",
            "grains",
            "cylinder-core",
            "half-space",
            "punch",
            "half-space-boxes",
            "radial-vibration",
            "column-early",
            "column-closed",
            "column-terzaghi",
            "hydrostatic-jump",
            "seepage",
            "infinite-slope",
            "drawdown",
            "clay-footing",
            "breathing",
            "revolved",
            "thick-sphere",
            "yielding-cylinder",
            "cavity",
            "triaxial",
            "circular-footing",
            "round-collapse",
            "absorbing"
        ]
    );
}

#[test]
fn a_short_study_tries_the_default_and_a_full_one_all_that_there_is() {
    for study in all() {
        for method in [Method::DEFAULT, other(study)] {
            assert!(study.tries(Size::Full, method), "{}", study.name());
        }
        let with_water = WITH_WATER.contains(&study.name());
        assert_ne!(study.tries(Size::Full, METHOD), with_water);
        assert!(
            study.tries(Size::Quick, Method::DEFAULT),
            "{}",
            study.name()
        );
    }
    assert!(!few(Size::Quick, METHOD));
}
