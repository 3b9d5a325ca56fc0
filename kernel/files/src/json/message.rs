//! Conversion of an error of the JSON parser to a problem with path, place, found and accepted values.

use serde_json::error::Category;

use super::elsewhere;
use super::position::{find, location, offset};
use super::words::{listed, nearest};
use proctor_scene::Problem;

/// Longest piece of the text that a message shows, in characters.
const LONGEST_PIECE: usize = 40;

/// Message of the parser, as a problem.
pub(super) fn problem(
    file: &str,
    text: &str,
    error: &serde_path_to_error::Error<serde_json::Error>,
) -> Problem {
    let inner = error.inner();
    // Where the text ends too early the last piece of the path is a question mark.
    let path = match error.path().to_string().as_str() {
        "." | "?" => String::new(),
        path => path.trim_end_matches(".?").to_owned(),
    };
    let full = inner.to_string();
    let said = full
        .rsplit_once(" at line ")
        .map_or(full.as_str(), |(said, _)| said);
    let here = offset(text, inner.line(), inner.column());
    if inner.classify() != Category::Data {
        return syntax(file, text, path, said, here);
    }
    if let Some(rest) = said.strip_prefix("unknown field ") {
        return unknown_key(file, text, &path, rest);
    }
    if let Some(rest) = said.strip_prefix("duplicate field ") {
        let key = rest.trim_matches('`');
        let path = match path.as_str() {
            "" => key.to_owned(),
            parent => format!("{parent}.{key}"),
        };
        let at = find(text, &path).map_or(here, |place| place.key);
        return Problem::new(path, "a key that was given before", "each key once")
            .at(location(file, text, at));
    }
    let place = find(text, &path);
    let at = place.map_or(here, |place| place.value);
    let (found, accepted) = match said.split_once(", expected ") {
        Some((found, accepted)) => (found, in_words(accepted)),
        None => (said, "another value".to_owned()),
    };
    let found = place.map_or_else(
        || found.to_owned(),
        |place| piece(&text[place.value..place.end]),
    );
    // MPM-Geomechanics has lists of identifiers, positions, volumes and materials there.
    let is_particles = path.ends_with(".particles");
    let problem = Problem::new(path, found, accepted).at(location(file, text, at));
    if is_particles {
        return problem.hint("here rows of position and volume; materials are those of bodies");
    }
    problem
}

/// A key that no object of this kind has.
fn unknown_key(file: &str, text: &str, path: &str, said: &str) -> Problem {
    // `said` is "`key`, expected `a` or `b`" or "`key`, expected one of `a`, `b`, `c`": every second piece
    // between backticks is a key.
    let mut words = said.split('`').skip(1).step_by(2);
    let key = words.next().unwrap_or("");
    let known: Vec<&str> = words.collect();
    let at = find(text, path).map_or(0, |place| place.key);
    let problem = Problem::new(
        path,
        format!("the unknown key `{key}`"),
        listed(known.iter().copied()),
    )
    .at(location(file, text, at));
    if let Some(other) = elsewhere::of_key(path, key) {
        return problem.hint(other.answer);
    }
    match nearest(key, known) {
        Some(near) => problem.hint(format!("did you mean `{near}`?")),
        None => problem,
    }
}

/// Text that is not JSON.
fn syntax(file: &str, text: &str, path: String, said: &str, here: usize) -> Problem {
    if said == "number out of range" {
        let place = find(text, &path);
        let at = place.map_or(here, |place| place.value);
        let found = place.map_or_else(|| said.to_owned(), |p| piece(&text[p.value..p.end]));
        return Problem::new(path, found, "a finite number, up to 1.7e308")
            .at(location(file, text, at));
    }
    if said.starts_with("EOF") {
        return Problem::new(
            path,
            "the end of the text",
            "JSON in which every bracket and quote is closed",
        )
        .at(location(file, text, text.trim_end().len()));
    }
    if said.starts_with("expected `,` or") {
        let before = text[..here].trim_end();
        let entry = before.lines().next_back().unwrap_or("").trim();
        return Problem::new(
            path,
            format!("{} and no comma", piece(entry)),
            "a comma before the next entry",
        )
        .at(location(file, text, before.len()));
    }
    let rest = text[here..].lines().next().unwrap_or("").trim();
    let found = if rest.is_empty() {
        "the end of the line".to_owned()
    } else {
        format!("{} ({said})", piece(rest))
    };
    let problem = Problem::new(path, found, "JSON").at(location(file, text, here));
    // The parser stops at the letter that cannot be right: `NaN` at its N, `-inf` behind its sign.
    let word = rest.trim_start_matches('-').to_lowercase();
    if word.starts_with("nan") || word.starts_with("inf") {
        problem.hint("JSON has finite numbers only")
    } else {
        problem
    }
}

/// A piece of the text, cut to a readable length.
fn piece(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() <= LONGEST_PIECE {
        return line;
    }
    let start: String = line.chars().take(LONGEST_PIECE).collect();
    format!("{start}…")
}

/// Types in the words of a scene file.
fn in_words(accepted: &str) -> String {
    match accepted {
        "f64" => "a number",
        "u64" | "usize" => "a whole number, 0 or more",
        "i64" => "a whole number",
        "a boolean" => "true or false",
        "a string" => "a text in quotes",
        "a sequence" => "a list",
        other => other,
    }
    .to_owned()
}
