//! A scene that is measured: one of the built-in ones, or a file.

use crate::bench::scenes::{BuiltIn, Made};
use proctor_files::json::{self, from_json, place};
use proctor_scene::{Scene, SceneError};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The key of words for people.
const COMMENT: &str = "comment";

/// A scene by name or by file.
#[derive(Clone)]
pub enum SceneChoice {
    /// A built-in scene in a number of axes.
    BuiltIn(&'static BuiltIn, usize),
    /// A scene file.
    File(FileScene),
}

/// A scene file.
#[derive(Clone)]
pub struct FileScene {
    path: PathBuf,
    /// Text as its user wrote it.
    text: String,
    /// Text of the scene, with absolute names of other files and without comments: it is handed to others, in other folders.
    value: Value,
}

/// Weighting function, stress scheme and transfer in the words of scene files; what is not given is the scene's own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Method {
    /// `shape_function`.
    pub weighting: Option<String>,
    /// `stress_scheme_update`.
    pub scheme: Option<String>,
    /// `transfer`.
    pub transfer: Option<String>,
}

impl std::fmt::Debug for SceneChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.name())
    }
}

impl SceneChoice {
    /// Reads a scene file; relative names of other files in it are taken from its folder.
    pub(super) fn read(path: &Path) -> Result<Self, SceneError> {
        // Read as a scene first: its problems are reported with their places.
        proctor_files::json::read(path)?;
        let text = proctor_files::reading::read_to_string(path).unwrap_or_default();
        let mut value: Value =
            serde_json::from_str(text.trim_start_matches('\u{feff}')).unwrap_or_default();
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        make_absolute(&mut value, &folder, &names_of_files());
        Ok(Self::File(FileScene {
            path: path.to_owned(),
            text,
            value,
        }))
    }

    /// Name in tables and records: that of a built-in scene, or the stem of the file.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::BuiltIn(scene, axes) => format!("{}-{axes}d", scene.name),
            Self::File(file) => (file.path.file_stem())
                .map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into()),
        }
    }

    /// True if it can be made for a wanted number of particles.
    #[must_use]
    pub fn scales(&self) -> bool {
        matches!(self, Self::BuiltIn(scene, _) if scene.particles.is_none())
    }

    /// The scene in JSON for a wanted number of particles, with a method.
    #[must_use]
    pub fn make(&self, particles: usize, method: &Method) -> Made {
        let mut made = match self {
            Self::BuiltIn(scene, axes) => scene.make(*axes, particles),
            Self::File(file) => Made {
                scene: file.value.clone(),
                exact: None,
            },
        };
        for (key, word) in [
            ("shape_function", &method.weighting),
            ("stress_scheme_update", &method.scheme),
            ("transfer", &method.transfer),
        ] {
            if let Some(word) = word {
                made.scene[key] = word.clone().into();
            }
        }
        made
    }

    /// The same as checked values.
    ///
    /// # Errors
    /// If the scene does not go with the method; of a scene file with places in the text of its user.
    pub fn scene(&self, particles: usize, method: &Method) -> Result<Scene, SceneError> {
        let made = self.make(particles, method).scene;
        self.checked(&made)
    }

    /// A form of this scene as checked values.
    ///
    /// # Errors
    /// As [`SceneChoice::scene`].
    pub fn checked(&self, form: &Value) -> Result<Scene, SceneError> {
        let name = self.name();
        from_json(&form.to_string(), &name, Path::new("")).map_err(|mut error| {
            if let Self::File(file) = self {
                // Nobody wrote the text in which they were found.
                for problem in &mut error.problems {
                    if (problem.location.as_ref()).is_some_and(|at| at.file == name) {
                        problem.location = None;
                    }
                }
                let path = file.path.display().to_string();
                place(&mut error.problems, &file.text, &path);
            }
            error
        })
    }
}

/// The keys that name files.
fn names_of_files() -> Vec<String> {
    let blocks = json::blocks();
    let keys = blocks.into_iter().flat_map(|block| block.keys);
    keys.filter(|key| key.is_file).map(|key| key.name).collect()
}

/// Makes the names of files in a scene absolute, so that it can be written elsewhere, and leaves out its comments, which
/// not every program knows.
fn make_absolute(value: &mut Value, folder: &Path, files: &[String]) {
    match value {
        Value::Object(entries) => {
            // A body may have this name, but it is an object.
            entries.retain(|key, entry| key != COMMENT || entry.is_object());
            for (key, entry) in entries {
                match entry {
                    Value::String(name) if files.contains(key) => {
                        *name = folder.join(&*name).display().to_string();
                    }
                    other => make_absolute(other, folder, files),
                }
            }
        }
        Value::Array(list) => list
            .iter_mut()
            .for_each(|entry| make_absolute(entry, folder, files)),
        _ => {}
    }
}
