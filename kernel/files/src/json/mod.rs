//! The raw stage: from JSON text to a checked scene, with a place in the text for every problem.
//! Other programs get a scene by [`fn@write`]; [`write_own`] has what only this one reads, too.

mod at_rest;
mod bodies;
mod build;
mod contact;
mod elsewhere;
mod glossary;
mod keys;
mod layers;
mod lists;
mod loads;
mod material_keys;
mod materials;
mod mesh;
mod message;
mod method;
mod mortar;
mod own;
mod parse;
pub mod position;
mod probes;
mod shapes;
mod sheets;
mod source;
mod stages;
mod surfaces;
mod tree;
mod water;
mod words;
mod write;

use std::path::Path;

use self::build::Build;
use self::keys::RawScene;
use self::parse::ParseFailure;
use proctor_scene::{Problem, Scene, SceneError};

pub use self::elsewhere::{ForeignWord, all_elsewhere, elsewhere};
pub use self::glossary::{Key, KeyBlock, KeyDefault, Range, blocks, schema};
pub use self::own::write_own;
pub use self::parse::parse;
pub use self::source::{SceneSource, SourceMap, unreadable};
pub use self::stages::Stage;
pub use self::words::{listed, nearest, words_of};
pub use self::write::{Omission, SceneWriter, write};

/// Reads a scene from a JSON file; files that it names are looked for in its folder.
///
/// # Errors
/// A file that cannot be read, and everything that [`from_json`] reports.
pub fn read(path: &Path) -> Result<Scene, SceneError> {
    Ok(SceneSource::file(path)?.scene()?.0)
}

/// Reads a scene from JSON text. `source_name` stands for the text in messages, and its stem becomes the name of
/// the scene; files that the scene names are looked for in `folder`.
///
/// # Errors
/// The first place where the text is not JSON; all unknown keys and words and values of another type at once; otherwise all
/// other problems: keys that are missing or contradict each other, and all that [`Scene::check`] finds.
pub fn from_json(text: &str, source_name: &str, folder: &Path) -> Result<Scene, SceneError> {
    placed(text, source_name, folder).map(|(scene, _)| scene)
}

/// [`from_json`], with how paths of the checked scene are spelt in the text.
fn placed(
    text: &str,
    source_name: &str,
    folder: &Path,
) -> Result<(Scene, Vec<(String, String)>), SceneError> {
    let mut build = Build::new(folder);
    let raw: RawScene = match parse::all(text, source_name) {
        Ok(raw) => raw,
        Err(ParseFailure { mut problems, rest }) => {
            if let Some(rest) = rest {
                build.scene(&rest);
                problems.extend(build.of_words());
            }
            return Err(parse::told(problems, text, source_name));
        }
    };
    let mut scene = build.scene(&raw);
    scene.name = Path::new(source_name)
        .file_stem()
        .map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into());
    let (mut problems, spellings) = build.merged(scene.check());
    // Finding the place of a problem is a walk through the text, and nobody reads thousands.
    let more = problems.len().saturating_sub(MOST_PROBLEMS);
    problems.truncate(MOST_PROBLEMS);
    place(&mut problems, text, source_name);
    if more > 0 {
        problems.push(Problem::new("", format!("{more} more problems"), "none"));
    }
    SceneError::unless_empty(problems)?;
    Ok((scene, spellings))
}

/// Problems of a scene that are told one by one.
const MOST_PROBLEMS: usize = 100;

/// Gives problems that have a path and no place their place in the text, and sorts them in the order of the text.
pub fn place(problems: &mut [Problem], text: &str, source_name: &str) {
    let text = text.trim_start_matches('\u{feff}');
    for problem in &mut *problems {
        if problem.location.is_none()
            && let Some(place) = position::find(text, &problem.path)
        {
            let at = if place.exact { place.value } else { place.key };
            problem.location = Some(position::location(source_name, text, at));
        }
    }
    // In the order of the text; a stable sort keeps problems of other files where they are among their like.
    problems.sort_by_key(|problem| {
        problem
            .location
            .as_ref()
            .map(|at| (at.file != source_name, at.file.clone(), at.line, at.column))
    });
}
