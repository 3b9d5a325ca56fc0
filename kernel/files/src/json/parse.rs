//! Raw keys from JSON text; where it has faults all of them at once.

use std::collections::BTreeMap;

use proctor_scene::{Problem, SceneError};
use serde::de::DeserializeOwned;
use serde_json::error::Category;
use serde_path_to_error::Segment;

use super::tree::{self, Tree};
use super::{MOST_PROBLEMS, message, place, position};

/// Longer texts are read again for fewer of their faults \[bytes\].
const LONG: usize = 1 << 20;
/// Most faults of such a text in one message.
const MOST_OF_LONG: usize = 10;
/// Longest list of accepted words that a message repeats, in characters.
const LONGEST_AGAIN: usize = 100;

/// A text that is not raw keys.
pub(super) struct ParseFailure<T> {
    /// All that is wrong with it; in each the place.
    pub problems: Vec<Problem>,
    /// The text without that fault.
    pub rest: Option<T>,
}

impl<T> From<Problem> for ParseFailure<T> {
    fn from(problem: Problem) -> Self {
        Self {
            problems: vec![problem],
            rest: None,
        }
    }
}

/// Reads a value of raw keys from JSON text, as [`from_json`](super::from_json) reads a scene; `source_name` stands for the
/// text in messages. For other files in the same strict style: their raw types deny unknown keys and leave every key
/// optional.
///
/// # Errors
/// The first place where the text is not JSON; otherwise all unknown keys, keys given twice and values of another type.
pub fn parse<T: DeserializeOwned>(text: &str, source_name: &str) -> Result<T, SceneError> {
    all(text, source_name)
        .map_err(|ParseFailure { problems, .. }| told(problems, text, source_name))
}

/// Problems in the order of the text, as an error.
pub(super) fn told(mut problems: Vec<Problem>, text: &str, source_name: &str) -> SceneError {
    place(&mut problems, text, source_name);
    // What an object accepts is listed once.
    let mut listed: Vec<String> = vec![];
    for problem in &mut problems {
        if problem.accepted.len() <= LONGEST_AGAIN {
            continue;
        }
        if listed.contains(&problem.accepted) {
            "one of those listed above".clone_into(&mut problem.accepted);
        } else {
            listed.push(problem.accepted.clone());
        }
    }
    SceneError { problems }
}

/// Raw keys, or all that is wrong with the text and what is left of it.
pub(super) fn all<T: DeserializeOwned>(
    text: &str,
    source_name: &str,
) -> Result<T, ParseFailure<T>> {
    // A byte order mark is no JSON, but some editors write it.
    let text = text.trim_start_matches('\u{feff}');
    match whole(text, source_name) {
        Ok(raw) => return Ok(raw),
        Err(fault) if fault.1 == Category::Data => {}
        Err(fault) => return Err(fault.0.into()),
    }
    let tree: Result<Tree, _> = whole(text, source_name);
    let mut tree = tree.map_err(|fault| ParseFailure::from(fault.0))?;
    let most = if text.len() > LONG {
        MOST_OF_LONG
    } else {
        MOST_PROBLEMS
    };
    let mut problems = vec![];
    let mut replaced = PlaceholderReader::default();
    while problems.len() < most {
        match tree::read(&tree) {
            Ok(raw) if problems.is_empty() => return Ok(raw),
            Ok(raw) => {
                let rest = Some(raw);
                return Err(ParseFailure { problems, rest });
            }
            Err(error) => {
                let path: Vec<Segment> = error.path().iter().cloned().collect();
                let said = error.inner().to_string();
                if !replaced.contains(&path) {
                    problems.push(message::problem(source_name, text, &error));
                }
                if !replaced.put(&mut tree, path, &said) {
                    break;
                }
            }
        }
    }
    Err(ParseFailure {
        problems,
        rest: None,
    })
}

/// Reads all of a text; else the problem, and of which category it is.
fn whole<T: DeserializeOwned>(
    text: &str,
    source_name: &str,
) -> Result<T, Box<(Problem, Category)>> {
    let mut parser = serde_json::Deserializer::from_str(text);
    let raw = serde_path_to_error::deserialize(&mut parser).map_err(|error| {
        let category = error.inner().classify();
        Box::new((message::problem(source_name, text, &error), category))
    })?;
    parser.end().map_err(|error| {
        let at = position::offset(text, error.line(), error.column());
        let problem = Problem::new("", "more text behind its end", "the end of the file")
            .at(position::location(source_name, text, at));
        Box::new((problem, Category::Syntax))
    })?;
    Ok(raw)
}

/// Stand-ins for values that cannot be read, so that the reader goes on behind them.
#[derive(Default)]
struct PlaceholderReader {
    /// Number of stand-ins at each path.
    tries: BTreeMap<String, usize>,
}

impl PlaceholderReader {
    /// Values of every type; an entry of a list may need one that is no null.
    const STAND_INS: [Tree; 5] = [
        Tree::Null,
        Tree::Whole(0),
        Tree::Text(String::new()),
        Tree::List(vec![]),
        Tree::Object(vec![]),
    ];

    /// True where the fault at a path is that of a stand-in.
    fn contains(&self, path: &[Segment]) -> bool {
        self.tries.contains_key(&name(path))
    }

    /// Takes out what cannot be read; whether there is something else to be read now.
    fn put(&mut self, tree: &mut Tree, mut path: Vec<Segment>, said: &str) -> bool {
        let unknown = said.strip_prefix("unknown field `");
        let twice = said.strip_prefix("duplicate field `");
        if let Some(key) = unknown.or(twice).and_then(|rest| rest.split('`').next()) {
            // The path ends with the key where it was known when the fault was found.
            if let Some(Segment::Map { key: last }) = path.last()
                && last == key
            {
                path.pop();
            }
            let Some(object) = tree.at(&path) else {
                return false;
            };
            object.take_out(key, twice.is_some());
            return true;
        }
        loop {
            let tries = self.tries.entry(name(&path)).or_default();
            if let Some(stand_in) = Self::STAND_INS.get(*tries) {
                *tries += 1;
                let Some(value) = tree.at(&path) else {
                    return false;
                };
                *value = stand_in.clone();
                return true;
            }
            if path.pop().is_none() {
                return false;
            }
        }
    }
}

/// A path in words, each segment apart.
fn name(path: &[Segment]) -> String {
    let segments: Vec<String> = path.iter().map(ToString::to_string).collect();
    segments.join("\n")
}
