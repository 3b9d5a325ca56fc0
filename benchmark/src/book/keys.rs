//! The chapter of the keys of scene files: a table per object, made of the tables that the reader of scenes uses.

use super::{BookFile, WRITTEN_FROM_KEYS};
use crate::show::keys::{EVERYWHERE, shown, values};
use proctor_files::json::{Key, KeyBlock, KeyDefault, blocks};
use std::fmt::Write as _;

/// The chapter.
pub fn chapter() -> BookFile {
    let mut text = format!(
        "{WRITTEN_FROM_KEYS}# Keys of scene files\n\n\
         A table per object. The path of an object stands in its heading: the key `radius` below `body` is written in each entry \
         of `body`. All values are in SI units. `proctor keys WORD` prints a key with its examples, and \
         `proctor schema` the same keys as JSON Schema. Every object takes a `{EVERYWHERE}`, which nothing reads.\n"
    );
    for block in &blocks() {
        text.push_str(&section(block));
    }
    BookFile {
        path: "reference/keys.md".to_owned(),
        text,
    }
}

/// Heading, meaning and table of an object.
fn section(block: &KeyBlock) -> String {
    let heading = if block.path.is_empty() {
        "The top of a scene"
    } else {
        &block.path
    };
    let mut text = format!(
        "\n## {heading}\n\n{}\n\n| key | meaning | value |\n|---|---|---|\n",
        block.meaning
    );
    for key in block.keys.iter().filter(|key| key.name != EVERYWHERE) {
        let _ = writeln!(
            text,
            "| `{}` | {} | {} |",
            key.name,
            cell(&meaning(key)),
            cell(&value(key)),
        );
    }
    text
}

/// The values that a key may have, their unit, and the default.
fn value(key: &Key) -> String {
    let mut text = values(key);
    if let Some(unit) = &key.unit {
        let _ = write!(text, " [{unit}]");
    }
    match &key.default {
        KeyDefault::Needed => text.push_str("; **needed**"),
        KeyDefault::Value(value) => {
            let _ = write!(text, "; default: {}", shown(value));
        }
        KeyDefault::Words(words) => {
            let _ = write!(text, "; default: {words}");
        }
        KeyDefault::OfOther => {}
    }
    text
}

/// The meaning, and the keys without which it has none.
fn meaning(key: &Key) -> String {
    let mut text = key.meaning.clone();
    if let Some(needs) = &key.needs {
        let _ = write!(text, " Only with {needs}.");
    }
    text
}

/// A text as a cell of a table: a bar in it would end the cell, and an angle bracket begin a tag.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
        .replace('<', "&lt;")
        .replace('\n', " ")
}
