//! The configuration of measurements: a file, read like a scene file, into checked values.
//!
//! A missing key takes its default; [`Config::defaults`] says which did, for `--log`.

mod check;
mod executables;
mod manual;
mod raw;
mod scene;
mod time_label;

pub use executables::proctor_command;
pub use manual::{ManualTest, TestScene};
pub use scene::{Method, SceneChoice};
pub use time_label::TimeLabel;

use super::children::OWN;
use check::Check;
use proctor_files::json::{parse, place, unreadable};
use proctor_scene::SceneError;
use proctor_scene::simulation::Part;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Name of the configuration that is looked for where none is named (technical manual, section 19.3).
pub const FILE: &str = "benchmark-configuration.json";

/// Options of the command line; they override the file.
#[derive(Clone, Debug, Default)]
pub struct CommandLineChoices {
    /// Numbers of threads; empty: as the file says.
    pub threads: Vec<usize>,
    /// Repetitions.
    pub repetitions: Option<usize>,
    /// Short: fewer particles and steps where the file does not say how many.
    pub quick: bool,
}

/// An executable that runs scenes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Executable {
    /// Name in tables and records.
    pub name: String,
    /// Program and arguments, with `{scene}`, `{threads}` and `{out}`.
    pub command: Vec<String>,
    /// Folder in which it works; that of its results where none is given.
    pub folder: Option<PathBuf>,
    /// Time by the clock after which it is ended, with all processes that it started.
    pub timeout: Duration,
    /// Meaning of the times of its frames.
    pub time_label: TimeLabel,
    /// True if a run of each scene comes before the timed ones, in which it compiles its kernels.
    pub warm_up: bool,
    /// Its method, in words for tables; none where its configuration does not say.
    pub method: Option<String>,
    /// Keys of the method, which replace those of each scene that it runs.
    pub scene: Map<String, Value>,
    /// Shape in which it gets problems in the plane.
    pub space: Space,
}

/// Shape of a problem in plane strain, as a solver gets it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// A scene in two dimensions; the solver knows no other.
    Plane,
    /// A slab of so many cells between rollers.
    Slab(usize),
}

impl Space {
    /// Dimensions of what the solver runs.
    #[must_use]
    pub fn axes(self) -> usize {
        match self {
            Self::Plane => 2,
            Self::Slab(_) => 3,
        }
    }
}

impl Executable {
    /// Time that an executable has where its configuration does not say: an hour.
    pub const TIMEOUT: Duration = Duration::from_secs(3600);

    /// A scene as this executable gets it: with its own keys of the method.
    #[must_use]
    pub fn given(&self, scene: &Value) -> Value {
        let mut given = scene.clone();
        for (key, value) in &self.scene {
            given[key] = value.clone();
        }
        given
    }

    /// True for this program, with whatever method.
    #[must_use]
    pub fn is_own(&self) -> bool {
        self.name == OWN || self.name.starts_with(&format!("{OWN} "))
    }

    /// Name of the file of a scene for it: executables with a scene of their own have a file of their own.
    #[must_use]
    pub fn scene_file(&self) -> String {
        if self.scene.is_empty() {
            "scene.json".to_owned()
        } else {
            format!("scene-{}.json", crate::record::key(&self.name))
        }
    }
}

/// Plan of the measurement.
#[derive(Debug)]
pub struct Config {
    /// Scenes of whole steps.
    pub scenes: Vec<SceneChoice>,
    /// Wanted numbers of particles.
    pub particles: Vec<usize>,
    /// Numbers of threads, of each rank.
    pub threads: Vec<usize>,
    /// Numbers of ranks that share whole steps.
    pub ranks: Vec<usize>,
    /// Combinations of weighting function, stress scheme and transfer.
    pub methods: Vec<Method>,
    /// Samples of each combination.
    pub repetitions: usize,
    /// Steps before the clock starts.
    pub warm_up: usize,
    /// Particles times steps of a sample.
    pub particle_steps: u64,
    /// Single stages that are measured.
    pub stages: Vec<Part>,
    /// True if they are measured in every scene rather than in the first.
    pub stages_everywhere: bool,
    /// The manual's tests of single stages.
    pub tests: Vec<ManualTest>,
    /// Programs that run the scenes, beside this one.
    pub executables: Vec<Executable>,
    /// Keys that took their default, and which.
    pub defaults: Vec<String>,
    /// Warnings of accepted settings.
    pub warnings: Vec<String>,
}

impl Config {
    /// Ranks and threads of each, for whole steps or for single stages, which one rank plays.
    #[must_use]
    pub fn processors(&self, whole: bool) -> Vec<[usize; 2]> {
        let ranks: &[usize] = if whole { &self.ranks } else { &[1] };
        let on = |ranks: &usize| {
            self.threads
                .iter()
                .map(|threads| [*ranks, *threads])
                .collect::<Vec<_>>()
        };
        ranks.iter().flat_map(on).collect()
    }

    /// Reads a configuration file. One that does not exist takes all defaults, as in the manual, with a warning.
    ///
    /// # Errors
    /// All problems of the file at once; see [`Config::from_json`].
    pub fn read(path: &Path, asked: &CommandLineChoices) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        match proctor_files::reading::read_to_string(path) {
            Ok(text) => {
                Self::from_json(&text, &name, path.parent().unwrap_or(Path::new("")), asked)
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                let mut config = Self::from_json("{}", &name, Path::new(""), asked)?;
                config.warnings.push(format!(
                    "{name}: no such file; every value takes its default"
                ));
                Ok(config)
            }
            Err(error) => Err(unreadable(
                &name,
                &error,
                "a configuration in JSON that can be read",
            )),
        }
    }

    /// Reads a configuration from text; scenes and executables that it names are looked for in `folder`.
    ///
    /// # Errors
    /// The first place where the text is not JSON, holds an unknown key or a value of another type; otherwise all
    /// other problems at once, those of the scenes that it names included.
    pub fn from_json(
        text: &str,
        source_name: &str,
        folder: &Path,
        asked: &CommandLineChoices,
    ) -> Result<Self, SceneError> {
        let raw: raw::RawConfig = parse(text, source_name)?;
        let mut check = Check::new(folder);
        let config = check.config(&raw, asked);
        place(&mut check.problems, text, source_name);
        SceneError::unless_empty(check.problems)?;
        Ok(config)
    }
}
