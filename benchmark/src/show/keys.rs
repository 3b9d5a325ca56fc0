//! Keys of scene files as tables and in full.

use proctor_files::json::{Key, KeyBlock, KeyDefault};
use proctor_kernel::number::Number;
use serde_json::Value;
use std::fmt::{self, Write as _};

/// Widest line of a table, in characters.
const WIDEST: usize = 110;
/// Longest default in a table, in characters.
const LONGEST_DEFAULT: usize = 16;
/// A key that every object of a scene has: its table says so once, at the top.
pub const EVERYWHERE: &str = "comment";

/// The keys of one block, a line each.
pub struct BlockTable<'a>(pub &'a KeyBlock);

impl fmt::Display for BlockTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let block = self.0;
        let title = if block.path.is_empty() {
            "the top of a scene"
        } else {
            &block.path
        };
        let head = format!("{title}: {}", first_sentence(&block.meaning));
        writeln!(f, "{}", cut(&head, WIDEST))?;
        let rows: Vec<[String; 4]> = block
            .keys
            .iter()
            .filter(|key| block.path.is_empty() || key.name != EVERYWHERE)
            .map(row)
            .collect();
        let width = |column: usize| {
            let cells = rows.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        let [name, unit, default] = [0, 1, 2].map(width);
        for row in &rows {
            let line = format!(
                "  {:<name$}  {:<unit$}  {:<default$}  {}",
                row[0], row[1], row[2], row[3]
            );
            writeln!(f, "{}", cut(line.trim_end(), WIDEST))?;
        }
        Ok(())
    }
}

/// Name, unit, default and meaning.
fn row(key: &Key) -> [String; 4] {
    let default = match &key.default {
        KeyDefault::Needed if key.needs.is_some() => "(needed)".to_owned(),
        KeyDefault::Value(value) => cut(&shown(value), LONGEST_DEFAULT),
        default => cut(&default.to_string(), LONGEST_DEFAULT),
    };
    [
        key.name.clone(),
        key.unit.clone().unwrap_or_default(),
        default,
        first_sentence(&key.meaning).to_owned(),
    ]
}

/// All that there is to say of a key in a block.
pub struct InFull<'a> {
    /// Path of the block; empty for the top of a scene.
    pub path: &'a str,
    /// The key.
    pub key: &'a Key,
}

impl fmt::Display for InFull<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let key = self.key;
        if self.path.is_empty() {
            writeln!(f, "{}", key.name)?;
        } else {
            writeln!(f, "{}.{}", self.path, key.name)?;
        }
        writeln!(f, "  {}", key.meaning)?;
        let mut line = |name: &str, text: &str| writeln!(f, "  {name:<10} {text}");
        line("value", &values(key))?;
        if let Some(unit) = &key.unit {
            line("unit", unit)?;
        }
        if let Some(needs) = &key.needs {
            line("only with", needs)?;
        }
        match &key.default {
            KeyDefault::Needed => line("default", "none: the key is needed")?,
            KeyDefault::OfOther => {}
            KeyDefault::Value(value) => line("default", &shown(value))?,
            KeyDefault::Words(words) => line("default", words)?,
        }
        for (i, example) in key.examples.iter().enumerate() {
            let name = if i == 0 { "example" } else { "" };
            line(name, &format!("\"{}\": {}", key.name, shown(example)))?;
        }
        Ok(())
    }
}

/// The values that a key may have, in words: the kind, and the words or the range.
pub fn values(key: &Key) -> String {
    let mut value = key.kind.clone();
    // Writing into a text does not fail.
    if !key.words.is_empty() {
        let words: Vec<String> = key.words.iter().map(shown).collect();
        let _ = write!(value, ": {}", words.join(", "));
    } else if !key.range.is_everything() {
        let each = if key.kind.starts_with("a list") {
            "each "
        } else {
            ""
        };
        let _ = write!(value, ", {each}{}", key.range);
    }
    value
}

/// A value as people write JSON: on one line, with blanks, and without a fraction of zero.
pub fn shown(value: &Value) -> String {
    match value {
        Value::Array(list) => {
            let entries: Vec<String> = list.iter().map(shown).collect();
            format!("[{}]", entries.join(", "))
        }
        Value::Object(map) => {
            let entries: Vec<String> = map
                .iter()
                .map(|(key, value)| format!("\"{key}\": {}", shown(value)))
                .collect();
            format!("{{{}}}", entries.join(", "))
        }
        Value::Number(number) => number
            .as_f64()
            .map_or_else(|| number.to_string(), |x| Number(x).to_string()),
        other => other.to_string(),
    }
}

fn first_sentence(text: &str) -> &str {
    text.split_once(". ")
        .map_or(text, |(first, _)| first)
        .trim_end_matches('.')
}

/// A text, cut to a number of characters.
fn cut(text: &str, longest: usize) -> String {
    if text.chars().count() <= longest {
        return text.to_owned();
    }
    let start: String = text.chars().take(longest.saturating_sub(1)).collect();
    format!("{}…", start.trim_end())
}
