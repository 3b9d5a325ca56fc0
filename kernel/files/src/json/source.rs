//! The text of a scene, from a file or from a stream, and the places in it of what shows its fault only when the scene
//! is set up or run.

use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::build::as_in_file;
use super::{placed, position};
use crate::reading::{NotUtf8, read_to_string, stream_to_string};
use proctor_scene::simulation::{SetupError, StepError, StepErrorKind};
use proctor_scene::{Location, Problem, Scene, SceneError};

/// Text that can stand where a scene is read.
const ACCEPTED: &str = "a scene in JSON that can be read";

/// The text of a scene.
#[derive(Clone, Debug)]
pub struct SceneSource {
    name: String,
    text: String,
    folder: PathBuf,
}

impl SceneSource {
    /// Reads a file; files that it names are looked for in its folder.
    ///
    /// # Errors
    /// A file that cannot be read or is no text in UTF-8.
    pub fn file(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = read_to_string(path).map_err(|error| unreadable(&name, &error, ACCEPTED))?;
        let folder = path.parent().unwrap_or_else(|| Path::new("")).to_owned();
        Ok(Self { name, text, folder })
    }

    /// Reads a stream to its end. Messages call it `<name>`, and the scene has this name; files that it names are looked
    /// for in `folder`.
    ///
    /// # Errors
    /// A stream that cannot be read, is no text in UTF-8 or is longer than what fits into memory.
    pub fn stream(name: &str, folder: &Path, from: impl Read) -> Result<Self, SceneError> {
        let name = format!("<{name}>");
        let text = stream_to_string(from).map_err(|error| unreadable(&name, &error, ACCEPTED))?;
        let folder = folder.to_owned();
        Ok(Self { name, text, folder })
    }

    /// The text.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// Its name in messages.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Folder of the files that it names.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The scene, and where its values stand.
    ///
    /// # Errors
    /// As [`from_json`](super::from_json).
    pub fn scene(self) -> Result<(Scene, SourceMap), SceneError> {
        let (mut scene, spellings) = placed(&self.text, &self.name, &self.folder)?;
        scene.name = scene.name.trim_matches(['<', '>']).to_owned();
        let places = SourceMap::new(self, spellings, &scene);
        Ok((scene, places))
    }
}

/// Places of the values of a scene in its text.
#[derive(Clone, Debug)]
pub struct SourceMap {
    source: SceneSource,
    /// Spellings of paths of the checked scene in the text.
    spellings: Vec<(String, String)>,
    /// Names and identifiers.
    bodies: Vec<(String, i64)>,
    /// Identifiers of master and slave, and the path.
    contacts: Vec<([i64; 2], String)>,
}

impl SourceMap {
    /// Source of a scene that was read from a text.
    pub(super) fn new(
        source: SceneSource,
        spellings: Vec<(String, String)>,
        scene: &Scene,
    ) -> Self {
        Self {
            source,
            spellings,
            bodies: (scene.bodies.iter())
                .map(|body| (body.name.clone(), body.id))
                .collect(),
            contacts: (scene.contacts.iter())
                .map(|contact| ([contact.master, contact.slave], contact.name.clone()))
                .chain(
                    (scene.mortar.contacts.iter())
                        .map(|contact| ([contact.master, contact.slave], contact.name.clone())),
                )
                .collect(),
        }
    }

    /// Name of the text in messages.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// Reasons for which the scene cannot be set up, a line for each fault that begins with its file, line and column; with the
    /// file alone where nothing in it is to blame.
    #[must_use]
    pub fn of_setup(&self, error: &SetupError) -> String {
        if let SetupError::Overlap(all) = error {
            let lines: Vec<String> = (all.iter())
                .map(|one| {
                    let alone = SetupError::Overlap(vec![one.clone()]);
                    self.told(std::slice::from_ref(&one.contact), &alone.to_string())
                })
                .collect();
            return lines.join("\n");
        }
        let paths = match error {
            SetupError::Body { body, .. } => {
                let index = self.bodies.iter().position(|(name, _)| name == body);
                index
                    .map(|index| self.spelt(&format!("bodies[{index}]")))
                    .into_iter()
                    .collect()
            }
            SetupError::UnstableTimeStep(_) => self.time_steps(),
            SetupError::Load { path, .. } | SetupError::Memory { path, .. } => {
                vec![self.spelt(path)]
            }
            SetupError::Interaction { path, .. } => self.of_mortar(path),
            SetupError::TooLarge { .. } => vec!["mesh.cells_number".into()],
            SetupError::Threads(_) => vec!["n_threads".into()],
            SetupError::Lanes(_)
            | SetupError::Overlap(_)
            | SetupError::Change { .. }
            | SetupError::Ranks(_) => vec![],
        };
        self.told(&paths, &error.to_string())
    }

    /// Reason for which a step failed, with the place of the value that would have to be another, or with the file alone.
    #[must_use]
    pub fn of_step(&self, error: &StepError) -> String {
        let paths = match &error.kind {
            StepErrorKind::UnstableTimeStep(_) | StepErrorKind::TimeStands { .. } => {
                self.time_steps()
            }
            StepErrorKind::Interaction(error) => (self.contacts.iter())
                .filter(|(pair, _)| Some(*pair) == error.bodies())
                .map(|(_, path)| path.clone())
                .collect(),
            StepErrorKind::LoadOnEmptyNode { load, .. } => {
                load.iter().map(|path| self.spelt(path)).collect()
            }
            _ => vec![],
        };
        self.told(&paths, &error.to_string())
    }

    /// A problem with a value that is sound by itself, with its place where it has one.
    #[must_use]
    pub fn of_problem(&self, problem: &Problem) -> String {
        let spelt = self.spelt(&problem.path);
        let location = problem.location.clone().or_else(|| self.place(&spelt));
        Problem {
            path: spelt,
            location,
            ..problem.clone()
        }
        .to_string()
    }

    /// Names in the words of mortar contact: a contact by its path, a rigid line or surface by its name, the boundary of a body
    /// by the identifier.
    fn of_mortar(&self, path: &str) -> Vec<String> {
        let mut paths = vec![path.to_owned()];
        paths.extend(["rigid_line", "rigid_surface"].map(|key| format!("{key}.{path}")));
        let id = path
            .rsplit(' ')
            .next()
            .and_then(|word| word.parse::<i64>().ok());
        let index = id.and_then(|id| self.bodies.iter().position(|(_, own)| *own == id));
        if let Some(index) = index {
            let keys = ["boundary_segment", "boundary", "boundary_stl_mesh"];
            paths.extend(keys.map(|key| self.spelt(&format!("bodies[{index}].{key}"))));
        }
        paths
    }

    /// The keys of which one is the time step.
    fn time_steps(&self) -> Vec<String> {
        ["time_step", "critical_time_step_multiplier"]
            .map(|path| self.spelt(path))
            .to_vec()
    }

    /// A path of the checked scene as the text has it.
    fn spelt(&self, path: &str) -> String {
        as_in_file(path, &self.spellings)
    }

    /// Message behind the place of the first of these paths that is in the text.
    fn told(&self, paths: &[String], said: &str) -> String {
        let place = paths.iter().find_map(|path| self.place(path));
        match place {
            Some(place) => format!("{place}: {said}"),
            None => format!("{}: {said}", self.source.name),
        }
    }

    /// The place of a path, spelt as in the text.
    fn place(&self, path: &str) -> Option<Location> {
        let text = self.source.text.trim_start_matches('\u{feff}');
        let place = position::find(text, path)?;
        place
            .exact
            .then(|| position::location(&self.source.name, text, place.value))
    }
}

/// Message for a text that cannot be read; with the place of its bytes where they are at fault.
#[must_use]
pub fn unreadable(name: &str, error: &io::Error, accepted: &str) -> SceneError {
    let not_text = (error.get_ref()).and_then(|inner| inner.downcast_ref::<NotUtf8>());
    let problem = match not_text {
        Some(at) => Problem::new(
            "",
            format!("the byte 0x{:02x}, which is no UTF-8", at.byte),
            "text in UTF-8",
        )
        .at(Location {
            file: name.to_owned(),
            line: at.line,
            column: at.column,
        }),
        None => Problem::new("", format!("{name} ({error})"), accepted),
    };
    SceneError {
        problems: vec![problem],
    }
}
