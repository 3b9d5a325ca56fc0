//! Building a scene from its keys: what is missing or contradicts itself is collected, and its place is taken by
//! a value (NaN, nothing) that no check accepts, so that everything else is still checked.

use std::collections::HashSet;
use std::path::Path;

use super::elsewhere;
use super::keys::{RawInitialState, RawScene};
use super::words::{START_VELOCITIES, listed, meaning, nearest};
use proctor_scene::{Dimension, Problem, Scene, SceneError, StateFile, Vector};

/// A scene under construction.
pub(super) struct Build<'a> {
    /// Folder of the files that the scene names.
    pub folder: &'a Path,
    /// Number of dimensions.
    pub dimension: Dimension,
    /// Identifiers of bodies that were divided into parts.
    pub divided_bodies: Vec<i64>,
    problems: Vec<Problem>,
    /// Indices of those that refuse a word or a choice as unknown, whatever else is in the scene.
    of_words: Vec<usize>,
    /// Spellings of paths of the checked scene in the file, where they differ.
    spellings: Vec<(String, String)>,
    /// Paths that hold a stand-in, about which the check is not to speak.
    stand_ins: Vec<String>,
}

impl<'a> Build<'a> {
    pub fn new(folder: &'a Path) -> Self {
        Self {
            folder,
            dimension: Dimension::Three,
            divided_bodies: Vec::new(),
            problems: Vec::new(),
            of_words: Vec::new(),
            spellings: Vec::new(),
            stand_ins: Vec::new(),
        }
    }

    /// The whole scene; [`Build::merged`] says whether it is one.
    pub fn scene(&mut self, raw: &RawScene) -> Scene {
        self.dimension = match raw.dimension {
            None | Some(3) => Dimension::Three,
            Some(2) => Dimension::Two,
            Some(other) => {
                self.add("dimension", other.to_string(), "2 or 3");
                Dimension::Three
            }
        };
        if let Some(stages) = &raw.stages {
            self.add(
                "stages",
                format!("{} stages", stages.len()),
                "a scene of one stage; `run` and `plan` take a scene with stages",
            );
        }
        let mesh = self.mesh(raw.mesh.as_ref());
        let time = self.number(
            "time",
            raw.time,
            "the end time, a number greater than 0 [s]",
        );
        let mut scene = Scene::new(self.dimension, mesh, time);
        self.method(raw, &mut scene);
        self.results(raw, &mut scene);
        scene.threads = raw.n_threads;
        scene.materials = self.materials(raw);
        self.water(raw, &mut scene);
        self.standing_waters(raw, &mut scene);
        scene.bodies = self.bodies(raw, &scene.mesh, &scene.materials);
        if let Some(until) = &raw.until {
            let share = self.number(
                "until.unbalanced_force",
                until.unbalanced_force,
                "a share of the weight, a number greater than 0",
            );
            scene.until = Some(share);
        }
        scene.initial_state = self.initial_state(raw.initial_state.as_ref());
        self.loads(raw, &mut scene);
        self.boundaries(raw, &mut scene);
        self.contacts(raw, &mut scene);
        scene.surfaces = self.surfaces(raw, &scene.mesh);
        scene
    }

    /// The run from whose end bodies begin; its file is read when the scene runs.
    fn initial_state(&mut self, raw: Option<&RawInitialState>) -> Option<StateFile> {
        let raw = raw?;
        let keeps_velocity = self.word_or(
            "initial_state.velocity",
            raw.velocity.as_ref(),
            START_VELOCITIES,
            false,
        );
        let Some(name) = &raw.file else {
            let accepted = "the path of a checkpoint, or of the folder of a run";
            self.missing("initial_state.file", accepted);
            return None;
        };
        let file = self.folder.join(name);
        if !file.exists() {
            self.add(
                "initial_state.file",
                format!("{name:?}, where there is no file"),
                "a checkpoint, or the folder of a run that has one",
            );
        }
        Some(StateFile {
            file,
            keeps_velocity,
        })
    }

    /// The words and choices that are none. A shape of another number of dimensions is left out: that number may be what could
    /// not be read.
    pub fn of_words(&self) -> Vec<Problem> {
        let hint_at_dimension = |problem: &&Problem| {
            (problem.hint.as_ref()).is_some_and(|hint| hint.contains("`dimension`"))
        };
        let all = self.of_words.iter().map(|i| &self.problems[*i]);
        all.filter(|problem| !hint_at_dimension(problem))
            .cloned()
            .collect()
    }

    /// Adds a problem of a choice that is none, whatever else is in the scene.
    pub fn add_choice(&mut self, path: &str, found: String, accepted: &str) {
        self.add(path, found, accepted);
        self.of_words.push(self.problems.len() - 1);
    }

    /// Adds a problem.
    pub fn add(
        &mut self,
        path: impl Into<String>,
        found: impl Into<String>,
        accepted: impl Into<String>,
    ) {
        self.problems.push(Problem::new(path, found, accepted));
    }

    /// Number of problems so far.
    pub fn problem_count(&self) -> usize {
        self.problems.len()
    }

    /// Adds a hint to the last problem.
    pub fn hint(&mut self, hint: impl Into<String>) {
        if let Some(last) = self.problems.last_mut() {
            last.hint = Some(hint.into());
        }
    }

    /// Adds the problems of a file that the scene names at `path`.
    pub fn add_all(&mut self, path: &str, error: SceneError) {
        for mut problem in error.problems {
            path.clone_into(&mut problem.path);
            self.problems.push(problem);
        }
    }

    /// Adds a key that is not there.
    pub fn missing(&mut self, path: impl Into<String>, accepted: impl Into<String>) {
        self.add(path, "nothing: the key is missing", accepted);
    }

    /// Says that the checked scene's path `checked` is spelt `written` in the file.
    pub fn spelt(&mut self, checked: impl Into<String>, written: impl Into<String>) {
        self.spellings.push((checked.into(), written.into()));
    }

    /// Says that a stand-in takes the place of what is at `path`, for a reason that is reported elsewhere.
    pub fn stands_in(&mut self, path: impl Into<String>) {
        self.stand_ins.push(path.into());
    }

    /// A number that must be there; NaN if it is not.
    pub fn number(&mut self, path: &str, value: Option<f64>, accepted: &str) -> f64 {
        value.unwrap_or_else(|| {
            self.missing(path, accepted);
            f64::NAN
        })
    }

    /// A vector that must be there; NaN if it is not.
    pub fn vector(&mut self, path: &str, value: Option<&Vec<f64>>, accepted: &str) -> Vector {
        let Some(value) = value else {
            let n = self.dimension.axes();
            self.missing(path, format!("{accepted}, {n} numbers"));
            return [f64::NAN; 3];
        };
        self.components(path, value)
    }

    /// A vector that is zero where it is not given.
    pub fn vector_or_zero(&mut self, path: &str, value: Option<&Vec<f64>>) -> Vector {
        value.map_or([0.0; 3], |value| self.components(path, value))
    }

    /// Checks that there are as many components as axes, the rest zero; NaN if there are more or fewer.
    pub fn components(&mut self, path: &str, value: &[f64]) -> Vector {
        if self.length(path, value, self.dimension.axes()) {
            std::array::from_fn(|axis| value.get(axis).copied().unwrap_or(0.0))
        } else {
            [f64::NAN; 3]
        }
    }

    /// Checks the length of a list.
    pub fn length<T: std::fmt::Debug>(&mut self, path: &str, list: &[T], length: usize) -> bool {
        if list.len() == length {
            return true;
        }
        self.add(
            path,
            format!("a list of length {}", list.len()),
            format!("{length} numbers in {} dimensions", self.dimension.axes()),
        );
        false
    }

    /// The meaning of a word, or `None` and a problem.
    pub fn word<T: Copy>(
        &mut self,
        path: &str,
        word: &str,
        words: &[(&'static str, T)],
    ) -> Option<T> {
        let meaning = meaning(word, words);
        if meaning.is_none() {
            let known = || words.iter().map(|(known, _)| *known);
            let mut problem = Problem::new(path, format!("{word:?}"), listed(known()));
            if let Some(other) = elsewhere::of_word(path, word) {
                problem = problem.hint(other.answer);
            } else if let Some(near) = nearest(word, known()) {
                problem = problem.hint(format!("did you mean `{near}`?"));
            }
            self.of_words.push(self.problems.len());
            self.problems.push(problem);
        }
        meaning
    }

    /// The meaning of a word with a default, which also stands in for a word that is not known.
    pub fn word_or<T: Copy>(
        &mut self,
        path: &str,
        word: Option<&String>,
        words: &[(&'static str, T)],
        default: T,
    ) -> T {
        word.and_then(|word| self.word(path, word, words))
            .unwrap_or(default)
    }

    /// The one of two spellings of a key that is given, with the spelling; both at once are a problem.
    pub fn either<'v, V>(
        &mut self,
        parent: &str,
        first: (&'static str, Option<&'v V>),
        second: (&'static str, Option<&'v V>),
    ) -> Option<(&'static str, &'v V)> {
        match (first.1, second.1) {
            (Some(value), None) => Some((first.0, value)),
            (None, Some(value)) => Some((second.0, value)),
            (Some(value), Some(_)) => {
                self.add(
                    join(parent, second.0),
                    format!("`{}` and `{}` together", first.0, second.0),
                    "one of them: they are two spellings of one key",
                );
                Some((first.0, value))
            }
            (None, None) => None,
        }
    }

    /// All problems, those of the check spelt as in the file. A problem of the check is left out where building
    /// already reported the same place: its value is only a stand-in.
    /// With them how paths of the checked scene are spelt in the file.
    pub fn merged(self, check: Result<(), SceneError>) -> (Vec<Problem>, Vec<(String, String)>) {
        let mut problems = self.problems;
        let built = problems.len();
        let mut known = HashSet::new();
        for mut problem in check.err().map(|error| error.problems).unwrap_or_default() {
            problem.path = as_in_file(&problem.path, &self.spellings);
            let is_shadowed = problems[..built]
                .iter()
                .map(|p| &p.path)
                .chain(&self.stand_ins)
                .any(|path| reaches(path, &problem.path) || reaches(&problem.path, path));
            // The parts of one body have the same faults.
            let is_new = known.insert((problem.path.clone(), problem.found.clone()));
            if !is_shadowed && is_new {
                problems.push(problem);
            }
        }
        (problems, self.spellings)
    }
}

/// A key in its parent.
pub(super) fn join(parent: &str, key: &str) -> String {
    if parent.is_empty() {
        key.to_owned()
    } else {
        format!("{parent}.{key}")
    }
}

/// True if `path` is `prefix` or lies below it.
pub(super) fn reaches(prefix: &str, path: &str) -> bool {
    path.strip_prefix(prefix)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// A path of the checked scene as the file has it.
pub(super) fn as_in_file(path: &str, spellings: &[(String, String)]) -> String {
    // Twice: first the entry as it is spelt in the file, then a key within it.
    respelt(&respelt(path, spellings), spellings)
}

/// The path with its longest respelt beginning replaced.
fn respelt(path: &str, spellings: &[(String, String)]) -> String {
    spellings
        .iter()
        .filter(|(checked, _)| reaches(checked, path))
        .max_by_key(|(checked, _)| checked.len())
        .map_or_else(
            || path.to_owned(),
            |(checked, written)| format!("{written}{}", &path[checked.len()..]),
        )
}
