//! Whatever stands in a scene file: it runs, or there is a message. No panic, no abort, no end that never comes.
//!
//! Texts come from sound scenes in which something was changed, and from the JSON Schema, so that a key that is added is
//! tried without a line here. What they found once is kept by name in `found`.

mod bases;
mod found;
mod outcome;
mod tree;

use bases::{BASES, FOLDER};
use outcome::{Outcome, outcome, outcome_in};
use proctor_files::json::schema;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::Config;
use serde_json::Value;
use std::path::{Path, PathBuf};
use tree::Tree;

/// Numbers at the ends of what can be written, beyond them, and what looks like numbers.
const NUMBERS: &[&str] = &[
    "0",
    "-0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "0.5",
    "1e-3",
    "1e-9",
    "1e-12",
    "1e-300",
    "1e-320",
    "5e-324",
    "1e3",
    "1e9",
    "1e16",
    "1e150",
    "1e200",
    "1e300",
    "1.7976931348623157e308",
    "-1e308",
    "255",
    "65536",
    "1000000",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "1000000000000000000000000000000",
];

/// Texts that are almost numbers.
const ALMOST: &[&str] = &[
    "NaN",
    "Infinity",
    "-Infinity",
    "+1",
    ".5",
    "01",
    "1.",
    "1e",
    "0x10",
    "1e400",
    "-1e400",
];

/// Values of another type than is wanted, most of the time.
const OTHERS: &[&str] = &[
    "null",
    "true",
    "false",
    "\"\"",
    "\"x\"",
    "\"\\u0000\"",
    "\"../scenes\"",
    "\"/dev/null\"",
    "[]",
    "{}",
    "[[]]",
    "[[[]]]",
    "[null]",
    "{\"\": null}",
    "[1, 2]",
    "[0, 0, 0]",
    "[[0, 0], [1, 1]]",
    "[[0, 0, 0], [0, 0, 0]]",
    "[[[[[[[[[[1]]]]]]]]]]",
    "",
];

/// A change of a text.
#[derive(Clone, Debug)]
enum Change {
    Number(Index, &'static str),
    Scaled(Index, f64),
    Other(Index, &'static str),
    Removed(Index),
    Twice(Index),
    Swapped(Index, Index),
    Unknown(Index),
    Cut(Index),
}

fn change() -> impl Strategy<Value = Change> {
    let at = any::<Index>;
    prop_oneof![
        8 => (at(), select(NUMBERS)).prop_map(|(at, number)| Change::Number(at, number)),
        1 => (at(), select(ALMOST)).prop_map(|(at, number)| Change::Number(at, number)),
        8 => (at(), -3.0..3.0).prop_map(|(at, power)| Change::Scaled(at, 10_f64.powf(power))),
        2 => (at(), -300.0..300.0).prop_map(|(at, power)| Change::Scaled(at, 10_f64.powf(power))),
        2 => (at(), select(OTHERS)).prop_map(|(at, other)| Change::Other(at, other)),
        2 => at().prop_map(Change::Removed),
        2 => at().prop_map(Change::Twice),
        2 => (at(), at()).prop_map(|(a, b)| Change::Swapped(a, b)),
        1 => at().prop_map(Change::Unknown),
        1 => at().prop_map(Change::Cut),
    ]
}

/// Puts a change into effect; a text that is cut is no tree any more.
fn changed(base: &Tree, changes: &[Change]) -> String {
    let mut tree = base.clone();
    let mut cut = None;
    for change in changes {
        let count = tree.count() - 1;
        if count == 0 {
            break;
        }
        // Numbers alone, so that a change of a number is one.
        let numbers: Vec<usize> = (1..=count)
            .filter(|&at| number(&tree, at).is_some())
            .collect();
        match change {
            Change::Number(at, text) if !numbers.is_empty() => {
                put(
                    &mut tree,
                    numbers[at.index(numbers.len())],
                    &Tree::Text((*text).into()),
                );
            }
            Change::Scaled(at, factor) if !numbers.is_empty() => {
                let at = numbers[at.index(numbers.len())];
                if let Some(value) = number(&tree, at) {
                    // Whole numbers stay whole, or most would be refused at once.
                    let scaled = value * factor;
                    let whole =
                        matches!(self::value(&tree, at), Tree::Text(t) if t.parse::<i64>().is_ok());
                    let text = if whole && scaled.abs() < 1e18 {
                        format!("{scaled:.0}")
                    } else {
                        format!("{scaled:?}")
                    };
                    put(&mut tree, at, &Tree::Text(text));
                }
            }
            Change::Number(..) | Change::Scaled(..) => {}
            Change::Other(at, text) => {
                put(&mut tree, 1 + at.index(count), &Tree::Text((*text).into()));
            }
            Change::Removed(at) => tree.at(1 + at.index(count), &mut |holder, i| match holder {
                Tree::Text(_) => {}
                Tree::List(list) => drop(list.remove(i)),
                Tree::Object(map) => drop(map.remove(i)),
            }),
            Change::Twice(at) => tree.at(1 + at.index(count), &mut |holder, i| match holder {
                Tree::Text(_) => {}
                Tree::List(list) => list.insert(i, list[i].clone()),
                Tree::Object(map) => map.insert(i, map[i].clone()),
            }),
            Change::Swapped(a, b) => {
                let value = value(&tree, 1 + b.index(count));
                put(&mut tree, 1 + a.index(count), &value);
            }
            Change::Unknown(at) => tree.at(1 + at.index(count), &mut |holder, i| {
                if let Tree::Object(map) = holder {
                    map[i].0.push('x');
                }
            }),
            Change::Cut(at) => cut = Some(*at),
        }
    }
    let mut text = tree.text();
    if let Some(at) = cut {
        let mut end = at.index(text.len());
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        text.truncate(end);
    }
    text
}

fn value(tree: &Tree, at: usize) -> Tree {
    let mut found = Tree::Text("null".into());
    tree.clone().at(at, &mut |holder, i| {
        found = match holder {
            Tree::Text(_) => return,
            Tree::List(list) => list[i].clone(),
            Tree::Object(map) => map[i].1.clone(),
        }
    });
    found
}

fn number(tree: &Tree, at: usize) -> Option<f64> {
    match value(tree, at) {
        Tree::Text(text) => text.parse().ok(),
        _ => None,
    }
}

fn put(tree: &mut Tree, at: usize, new: &Tree) {
    tree.at(at, &mut |holder, i| match holder {
        Tree::Text(_) => {}
        Tree::List(list) => list[i] = new.clone(),
        Tree::Object(map) => map[i].1 = new.clone(),
    });
}

/// A stream of choices, from which a text is made along the schema.
struct Choices<'a> {
    words: &'a [u32],
    at: usize,
}

impl Choices<'_> {
    /// A number below `count`.
    fn of(&mut self, count: usize) -> usize {
        let word = self.words[self.at % self.words.len()];
        self.at += 1;
        (word.rotate_left((self.at / self.words.len()) as u32 % 32) as usize) % count
    }

    fn from<'t>(&mut self, words: &[&'t str]) -> &'t str {
        words[self.of(words.len())]
    }
}

/// A text that the schema allows, but for a few values.
fn text_of(schema: &Value, root: &Value, choices: &mut Choices<'_>, depth: usize) -> String {
    if choices.of(60) == 0 {
        return choices.from(OTHERS).to_owned();
    }
    if let Some(name) = schema["$ref"].as_str() {
        return text_of(
            &root["$defs"][name.rsplit('/').next().unwrap_or("")],
            root,
            choices,
            depth,
        );
    }
    if let Some(words) = schema["enum"].as_array() {
        return words[choices.of(words.len())].to_string();
    }
    if let Some(any) = schema["anyOf"].as_array() {
        return text_of(&any[choices.of(any.len())], root, choices, depth);
    }
    let kind = match &schema["type"] {
        Value::Array(kinds) => kinds[0].as_str(),
        kind => kind.as_str(),
    };
    match kind {
        Some("object") => {
            let mut entries = vec![];
            if let Some(keys) = schema["properties"].as_object() {
                for (key, value) in keys {
                    let wanted = [
                        "time",
                        "mesh",
                        "material",
                        "body",
                        "id",
                        "type",
                        "dimension",
                    ];
                    if choices.of(3) == 0 || wanted.contains(&key.as_str()) {
                        entries.push(format!(
                            "{key:?}: {}",
                            text_of(value, root, choices, depth + 1)
                        ));
                    }
                }
            } else {
                for i in 0..choices.of(3) {
                    let value = text_of(&schema["additionalProperties"], root, choices, depth + 1);
                    entries.push(format!("\"n{i}\": {value}"));
                }
            }
            format!("{{{}}}", entries.join(", "))
        }
        Some("array") => {
            let count = if depth > 6 { 0 } else { choices.of(4) };
            let entries: Vec<String> = (0..count)
                .map(|_| text_of(&schema["items"], root, choices, depth + 1))
                .collect();
            format!("[{}]", entries.join(", "))
        }
        Some("boolean") => choices.from(&["true", "false"]).to_owned(),
        Some("integer") => match choices.of(6) {
            0 => choices.from(NUMBERS).to_owned(),
            _ => (1 + choices.of(4)).to_string(),
        },
        Some("number") => match choices.of(6) {
            0 => choices.from(NUMBERS).to_owned(),
            _ => choices
                .from(&["0.1", "0.3", "0.5", "1", "2", "1000"])
                .to_owned(),
        },
        _ => choices
            .from(&[
                "\"x\"",
                "\"../surfaces/plane.stl\"",
                "\"shaken_base_2d.csv\"",
                "\"\"",
            ])
            .to_owned(),
    }
}

fn cases(count: u32) -> Config {
    Config {
        cases: count,
        failure_persistence: None,
        ..Config::default()
    }
}

#[test]
fn the_scenes_to_begin_with_are_sound() {
    for base in BASES {
        assert_eq!(outcome(base), Ok(Outcome::Stepped), "{base}");
        assert_eq!(outcome(&Tree::parse(base).text()), Ok(Outcome::Stepped));
    }
}

/// A box without a corner, beside a disc that it may touch: how far they overlap is not known.
#[test]
fn a_box_without_a_corner_beside_a_disc_is_refused() {
    let mut without = 0;
    for base in BASES {
        let corner = "\"point_p1\": [0.5, 0.5], ";
        let text = base.replacen(corner, "", 1);
        if text == *base || !base.contains("\"disc\"") {
            continue;
        }
        without += 1;
        assert!(matches!(outcome(&text), Ok(Outcome::Refused(_))), "{text}");
    }
    assert!(without > 0, "no base has a box and a disc");
}

/// The scenes of the fixtures and the manuals, each with its folder.
fn fixtures() -> Vec<(PathBuf, String)> {
    let mut found = vec![];
    for folder in [FOLDER.into(), Path::new(FOLDER).join("manual")] {
        let folder: PathBuf = folder;
        for entry in std::fs::read_dir(&folder).expect("the fixtures are there") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|ending| ending == "json") {
                let text = std::fs::read_to_string(&path).expect("a scene");
                found.push((path, folder.clone(), text));
            }
        }
    }
    // Whatever the order in which the system gives them.
    found.sort();
    let whole = found.into_iter();
    whole.map(|(_, folder, text)| (folder, text)).collect()
}

proptest! {
    #![proptest_config(cases(400))]

    /// `scripts/fuzz-scenes` does the same to the command, ten thousand times.
    #[test]
    fn a_scene_of_the_fixtures_in_which_something_changed_is_planned_or_says_why_not(
        which in any::<Index>(),
        changes in prop::collection::vec(change(), 1..4),
    ) {
        let fixtures = fixtures();
        let (folder, text) = &fixtures[which.index(fixtures.len())];
        let text = changed(&Tree::parse(text), &changes);
        let found = outcome_in(&text, folder, 0);
        prop_assert!(found.is_ok(), "{found:?} for {text}");
    }
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn a_sound_scene_in_which_something_changed_runs_or_says_why_not(
        base in 0..BASES.len(),
        changes in prop::collection::vec(change(), 1..4),
    ) {
        let text = changed(&Tree::parse(BASES[base]), &changes);
        let found = outcome(&text);
        prop_assert!(found.is_ok(), "{found:?} for {text}");
    }

    #[test]
    fn a_text_along_the_schema_runs_or_says_why_not(words in prop::collection::vec(any::<u32>(), 8..64)) {
        let root = schema();
        let text = text_of(&root, &root, &mut Choices { words: &words, at: 0 }, 0);
        let found = outcome(&text);
        prop_assert!(found.is_ok(), "{found:?} for {text}");
    }
}
