//! A scene that is measured: one of the built-in ones, or a file.

use crate::bench::scenes::{BuiltIn, Made};
use proctor_files::json::from_json;
use proctor_kernel::scene::{Scene, SceneError};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A scene by name or by file.
#[derive(Clone)]
pub enum SceneChoice {
    /// A built-in scene in a number of axes.
    BuiltIn(&'static BuiltIn, usize),
    /// A scene file: its path and what it says, with absolute names of other files.
    File(PathBuf, Value),
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
        let folder = path.parent().unwrap_or(Path::new(""));
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        make_absolute(&mut value, &folder);
        Ok(Self::File(path.to_owned(), value))
    }

    /// Name in tables and records: that of a built-in scene, or the stem of the file.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::BuiltIn(scene, axes) => format!("{}-{axes}d", scene.name),
            Self::File(path, _) => path
                .file_stem()
                .map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into()),
        }
    }

    /// Whether it can be made for a wanted number of particles.
    #[must_use]
    pub fn scales(&self) -> bool {
        matches!(self, Self::BuiltIn(..))
    }

    /// The scene in JSON for a wanted number of particles, with a method.
    #[must_use]
    pub fn make(&self, particles: usize, method: &Method) -> Made {
        let mut made = match self {
            Self::BuiltIn(scene, axes) => scene.make(*axes, particles),
            Self::File(_, scene) => Made {
                scene: scene.clone(),
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
    /// If the scene does not go with the method.
    pub fn scene(&self, particles: usize, method: &Method) -> Result<Scene, SceneError> {
        let text = self.make(particles, method).scene.to_string();
        from_json(&text, &self.name(), Path::new(""))
    }
}

/// Makes the names of files in a scene absolute, so that it can be written elsewhere.
fn make_absolute(value: &mut Value, folder: &Path) {
    match value {
        Value::Object(entries) => {
            for (key, entry) in entries {
                match entry {
                    Value::String(name) if key == "file" => {
                        *name = folder.join(&*name).display().to_string();
                    }
                    other => make_absolute(other, folder),
                }
            }
        }
        Value::Array(list) => list
            .iter_mut()
            .for_each(|entry| make_absolute(entry, folder)),
        _ => {}
    }
}
