//! Things that the user names on the command line.

use crate::exit::Failure;
use proctor_verification::case;
use proctor_verification::study::{self, Study};

/// Least likeness of a known name to an unknown word, 0 to 1, for it to be suggested.
const LIKENESS: f64 = 0.4;

/// The things of those names, each once; all of them where none is named.
pub fn chosen<T: Copy>(
    names: &[String],
    all: &[T],
    kind: &str,
    name_of: impl Fn(T) -> &'static str,
) -> Result<Vec<T>, Failure> {
    if names.is_empty() {
        return Ok(all.to_vec());
    }
    let mut chosen: Vec<T> = vec![];
    for name in names {
        let found = all.iter().copied().find(|thing| name_of(*thing) == name);
        let thing = found.ok_or_else(|| {
            let known: Vec<&str> = all.iter().map(|thing| name_of(*thing)).collect();
            Failure::BadInput(unknown(kind, name, &known))
        })?;
        if chosen.iter().all(|known| name_of(*known) != name_of(thing)) {
            chosen.push(thing);
        }
    }
    Ok(chosen)
}

/// Studies of those names; a case that has none says why.
pub fn studies(names: &[String]) -> Result<Vec<Study>, Failure> {
    for name in names {
        let case = case::all().iter().find(|case| case.name() == name);
        if let Some(case) = case
            && let Err(reason) = case.studied()
        {
            let others = if case.open().is_empty() {
                ""
            } else {
                ", and `proctor arena` with other solvers"
            };
            return Err(Failure::BadInput(format!(
                "{name}: there is no study of it: {reason}; `proctor verify {name}` runs it{others}"
            )));
        }
    }
    chosen(names, &study::all(), "case", |study| study.name())
}

/// Open problems of those names, or why a case has none; all where none is named.
pub fn open(names: &[String]) -> Result<Vec<Study>, Failure> {
    let is_open = |name: &String| study::open().iter().any(|study| study.name() == name);
    for name in names.iter().filter(|name| !is_open(name)) {
        let case = case::all().iter().find(|case| case.name() == name);
        if let Some(case) = case.filter(|case| case.open().is_empty()) {
            return Err(Failure::BadInput(format!(
                "{name}: not for other solvers: {}; `proctor verify {name}` runs it",
                case.why_closed()
            )));
        }
    }
    chosen(names, &study::open(), "case", |study| study.name())
}

/// Answer to a name that nothing has: the nearest known one, then all.
fn unknown(kind: &str, name: &str, known: &[&str]) -> String {
    let likeness = |known: &str| strsim::normalized_damerau_levenshtein(name, known);
    let nearest = known
        .iter()
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))
        .filter(|known| likeness(known) >= LIKENESS || known.starts_with(name));
    // First what helps most: behind dozens of names nobody reads on.
    let hint = nearest.map_or_else(String::new, |near| format!(" (did you mean `{near}`?)"));
    format!(
        "found the {kind} {name:?}, which is not known{hint}; accepted: {}",
        known.join(", ")
    )
}
