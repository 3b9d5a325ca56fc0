//! Causes of a violation, by experiment: the choice of a scene in whose place another one lets its property hold.

use proctor_scene::{
    Damping, DomainUpdate, Scene, StressScheme, TimeStep, Transfer, TransferKind, Weighting,
};

use super::{Answer, Deviation, trial};

/// Another choice than that of a scene.
struct Choice {
    /// The choice, as in "holds with USL".
    name: &'static str,
    /// Makes the choice; `false` where the scene has it already.
    change: fn(&mut Scene) -> bool,
}

/// All that are tried, the mildest change first.
static CHOICES: &[Choice] = &[
    Choice {
        name: "four times the time to come to rest",
        change: |scene| {
            scene.time *= 4.0;
            scene.damping != Damping::None
        },
    },
    Choice {
        name: "a quarter of the time step",
        change: |scene| {
            scene.time_step = match scene.time_step {
                TimeStep::Automatic => TimeStep::Multiplier {
                    multiplier: QUARTER,
                    allow_unstable: false,
                },
                TimeStep::Multiplier {
                    multiplier,
                    allow_unstable,
                } => TimeStep::Multiplier {
                    multiplier: 0.25 * multiplier,
                    allow_unstable,
                },
                TimeStep::Fixed { dt, allow_unstable } => TimeStep::Fixed {
                    dt: 0.25 * dt,
                    allow_unstable,
                },
            };
            true
        },
    },
    Choice {
        name: "USL",
        change: |scene| replace(&mut scene.scheme, StressScheme::Usl),
    },
    Choice {
        name: "MUSL",
        change: |scene| replace(&mut scene.scheme, StressScheme::Musl),
    },
    Choice {
        name: "APIC",
        change: |scene| replace(&mut scene.transfer, Transfer::new(TransferKind::Apic)),
    },
    Choice {
        name: "FLIP",
        change: |scene| replace(&mut scene.transfer, Transfer::new(TransferKind::Flip)),
    },
    Choice {
        name: "uGIMP",
        change: |scene| replace(&mut scene.weighting, Weighting::UniformGimp),
    },
    Choice {
        name: "cpGIMP",
        change: |scene| {
            replace(
                &mut scene.weighting,
                Weighting::ContiguousGimp(DomainUpdate::Stretch),
            )
        },
    },
    Choice {
        name: "uGIMP, MUSL and APIC",
        change: |scene| {
            scene.scheme = StressScheme::Musl;
            scene.transfer = Transfer::new(TransferKind::Apic);
            scene.weighting = Weighting::UniformGimp;
            true
        },
    },
    Choice {
        name: "uGIMP, USL and APIC",
        change: |scene| {
            scene.scheme = StressScheme::Usl;
            scene.transfer = Transfer::new(TransferKind::Apic);
            scene.weighting = Weighting::UniformGimp;
            true
        },
    },
    Choice {
        name: "half the local damping",
        change: |scene| match &mut scene.damping {
            Damping::Local { alpha } => {
                *alpha *= 0.5;
                scene.time *= 2.0;
                true
            }
            _ => false,
        },
    },
];

/// Courant number of a step that is a quarter of what is usual.
const QUARTER: f64 = 0.1;

/// The first other choice with which the property of a scene holds and its distance is at most half of what it was, in words;
/// `None` where no single one does.
#[must_use]
pub fn cause(seed: u64, answer: &Answer) -> Option<&'static str> {
    let before = answer.worst()?.share();
    let holds = |choice: &&Choice| {
        let (_, mut trial) = trial(seed, answer.number);
        let mut runs = trial.runs.iter_mut();
        runs.all(|run| (choice.change)(&mut run.scene))
            && super::results(&trial.runs).is_ok_and(|seen| {
                let all = (trial.judge)(&seen);
                let worst = all.iter().map(Deviation::share).fold(0.0, f64::max);
                !all.is_empty() && worst <= 1.0 && worst <= 0.5 * before
            })
    };
    let found = CHOICES.iter().find(holds);
    found.map(|choice| choice.name)
}

fn replace<T: PartialEq>(old: &mut T, new: T) -> bool {
    let other = *old != new;
    *old = new;
    other
}
