//! The samples of a configuration.

use super::config::Config;
use super::sample::{Kind, Work};
use proctor_kernel::weighting;
use proctor_scene::{Scene, SceneError, StressScheme, Weighting};

/// A combination that is sampled, with what tables say of it.
pub struct Slot {
    /// Work that is sampled.
    pub work: Work,
    /// Scene.
    pub scene: String,
    /// Weighting function, stress scheme and transfer.
    pub method: [String; 3],
    /// Single stage.
    pub stage: Option<&'static str>,
}

/// All combinations of a configuration, but for other executables.
///
/// # Errors
/// If a scene does not go with a method.
pub fn slots(config: &Config) -> Result<Vec<Slot>, SceneError> {
    let mut slots = vec![];
    for (i, choice) in config.scenes.iter().enumerate() {
        let stages = if i == 0 || config.stages_everywhere {
            config.stages.as_slice()
        } else {
            &[]
        };
        // A scene file has its own number of particles.
        let counts = if choice.scales() {
            config.particles.as_slice()
        } else {
            &[0]
        };
        for &particles in counts {
            for method in &config.methods {
                let mut scene = choice.scene(particles, method)?;
                scene.results.print = 0;
                let kinds = std::iter::once(Kind::Steps)
                    .chain(stages.iter().map(|part| Kind::Stage(*part)));
                for kind in kinds {
                    let whole = kind == Kind::Steps;
                    for &[ranks, threads] in &config.processors(whole) {
                        let name = if choice.scales() {
                            format!("{}/{particles}", choice.name())
                        } else {
                            choice.name()
                        };
                        let on = [ranks, threads];
                        slots.push(slot(choice.name(), &name, kind, scene.clone(), on));
                    }
                }
            }
        }
    }
    for test in &config.tests {
        for &particles in &config.particles {
            let made = test.make(particles);
            made.scene.check()?;
            for &threads in &config.threads {
                let kind = Kind::Stage(test.part);
                let name = format!("{}/{particles}", test.name);
                let mut slot = slot(
                    test.name.to_owned(),
                    &name,
                    kind,
                    made.scene.clone(),
                    [1, threads],
                );
                slot.work.initial = Some(made.initial.clone());
                slots.push(slot);
            }
        }
    }
    Ok(slots)
}

fn slot(
    scene: String,
    name: &str,
    kind: Kind,
    values: Scene,
    [ranks, threads]: [usize; 2],
) -> Slot {
    let method = words(&values);
    let stage = match kind {
        Kind::Steps => None,
        Kind::Stage(part) => Some(part.name()),
    };
    let mut name = format!("{name}/{}", method.join("/"));
    if let Some(stage) = stage {
        name = format!("{name}/{stage}");
    }
    Slot {
        work: Work {
            name,
            kind,
            scene: values,
            initial: None,
            ranks,
            threads,
        },
        scene,
        method,
        stage,
    }
}

/// Weighting function, stress scheme and transfer in the words of scene files.
pub(super) fn words(scene: &Scene) -> [String; 3] {
    let kind = scene.weighting.kind();
    // The first update is what the word alone stands for.
    let update = kind
        .update
        .filter(|_| first_of(kind.word) != scene.weighting);
    let weighting = update.map_or(kind.word.to_owned(), |update| {
        format!("{}-{}", kind.word, update.replace('_', "-"))
    });
    let scheme = match scene.scheme {
        StressScheme::Usf => "USF",
        StressScheme::Usl => "USL",
        StressScheme::Musl => "MUSL",
    };
    let transfer = scene.transfer.kind.kind().word;
    [weighting, scheme.to_owned(), transfer.to_owned()]
}

/// The weighting function that a word of scene files stands for by itself.
fn first_of(word: &str) -> Weighting {
    let first = weighting::ALL.iter().find(|kind| kind.word == word);
    first.map_or(Weighting::UniformGimp, |kind| kind.weighting)
}
