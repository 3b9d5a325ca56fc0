//! Every key of a scene file with all that there is to say of it, taken from the JSON Schema.

use std::fmt::{self, Write as _};
use std::ops::Bound;

use schemars::schema_for;
use serde_json::{Map, Value};

use super::keys::RawScene;

/// Objects of the same kind in a scene file, such as all bodies, and the keys that they may have.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyBlock {
    /// Path of the keys: `mesh.boundary_conditions`; empty for the top of a scene.
    pub path: String,
    /// Meaning of the keys, in sentences.
    pub meaning: String,
    /// Their keys, sorted by name.
    pub keys: Vec<Key>,
}

/// A key of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Its name.
    pub name: String,
    /// Meaning of the key, in sentences.
    pub meaning: String,
    /// Kind of its value: `a number`, `a list of numbers`, ...
    pub kind: String,
    /// SI unit of its numbers, where they have one.
    pub unit: Option<String>,
    /// Range of its number, or of each number of its list.
    pub range: Range,
    /// The values that it may have, or those of its list, where there are only these.
    pub words: Vec<Value>,
    /// Value if the key is missing.
    pub default: KeyDefault,
    /// Keys that must be in the scene for this one to have a meaning.
    pub needs: Option<String>,
    /// The key of which this is another spelling.
    pub also: Option<String>,
    /// True if its text names a file, relative to the folder of the scene.
    pub is_file: bool,
    /// Values that it may have.
    pub examples: Vec<Value>,
}

/// Value that holds where a key is missing.
#[derive(Clone, Debug, PartialEq)]
pub enum KeyDefault {
    /// The key must be there.
    Needed,
    /// This value, as if the key had it.
    Value(Value),
    /// A sentence.
    Words(String),
    /// The default of the key of which this is another spelling.
    OfOther,
}

/// An interval of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end.
    pub low: Bound<f64>,
    /// Upper end.
    pub high: Bound<f64>,
}

impl Range {
    fn of(schema: &Value) -> Self {
        let end = |included: &str, excluded: &str| {
            let number = |word: &str| schema[word].as_f64();
            match (number(included), number(excluded)) {
                (Some(end), _) => Bound::Included(end),
                (None, Some(end)) => Bound::Excluded(end),
                (None, None) => Bound::Unbounded,
            }
        };
        Self {
            low: end("minimum", "exclusiveMinimum"),
            high: end("maximum", "exclusiveMaximum"),
        }
    }

    /// True if every number lies in it.
    #[must_use]
    pub fn is_everything(&self) -> bool {
        (self.low, self.high) == (Bound::Unbounded, Bound::Unbounded)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.low, self.high) {
            (Bound::Included(low), Bound::Included(high)) => {
                return write!(f, "from {low} to {high}");
            }
            (Bound::Included(low), _) => write!(f, "{low} or greater")?,
            (Bound::Excluded(low), _) => write!(f, "greater than {low}")?,
            (Bound::Unbounded, Bound::Unbounded) => return f.write_str("any number"),
            (Bound::Unbounded, _) => {}
        }
        let and = if self.low == Bound::Unbounded {
            ""
        } else {
            " and "
        };
        match self.high {
            Bound::Included(high) => write!(f, "{and}at most {high}"),
            Bound::Excluded(high) => write!(f, "{and}less than {high}"),
            Bound::Unbounded => Ok(()),
        }
    }
}

impl fmt::Display for KeyDefault {
    /// `needed`, or what holds.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Needed => f.write_str("needed"),
            Self::Value(value) => write!(f, "{value}"),
            Self::Words(words) => f.write_str(words),
            Self::OfOther => Ok(()),
        }
    }
}

impl Key {
    fn new(name: &str, property: &Value, root: &Value) -> Self {
        let text = |word: &str| property[word].as_str().map(str::to_owned);
        let list = |word: &str| property[word].as_array().cloned().unwrap_or_default();
        let own = Range::of(property);
        Self {
            name: name.to_owned(),
            meaning: text("description").unwrap_or_default(),
            kind: kind(property, root),
            unit: text("x-unit"),
            range: if own.is_everything() {
                Range::of(&property["items"])
            } else {
                own
            },
            words: [list("enum"), list("x-words")].concat(),
            default: match (property.get("default"), text("x-default"), text("x-also")) {
                (Some(value), ..) => KeyDefault::Value(value.clone()),
                (None, Some(words), _) => KeyDefault::Words(words),
                (None, None, Some(_)) => KeyDefault::OfOther,
                (None, None, None) => KeyDefault::Needed,
            },
            needs: text("x-needs"),
            also: text("x-also"),
            is_file: property["x-file"] == true,
            examples: list("examples"),
        }
    }

    /// Text that its description in the schema adds to its meaning: an editor shows nothing else.
    fn more(&self) -> String {
        let mut more = String::new();
        // Writing into a text does not fail.
        if let Some(unit) = &self.unit {
            let _ = write!(more, " Unit: {unit}.");
        }
        if let Some(needs) = &self.needs {
            let _ = write!(more, " Only with {needs}.");
        }
        match &self.default {
            KeyDefault::Needed => more.push_str(" Needed."),
            KeyDefault::OfOther => {}
            default => {
                let _ = write!(more, " Default: {default}.");
            }
        }
        more
    }
}

/// The blocks of a scene file, the top first; what is another spelling of a block is no block of its own.
#[must_use]
pub fn blocks() -> Vec<KeyBlock> {
    let root = schema_for!(RawScene).to_value();
    let mut blocks = vec![];
    collect("", &root, &root, &mut blocks);
    blocks
}

fn collect(path: &str, object: &Value, root: &Value, blocks: &mut Vec<KeyBlock>) {
    let nothing = Map::new();
    let properties = object["properties"].as_object().unwrap_or(&nothing);
    let keys: Vec<Key> = properties
        .iter()
        .map(|(name, property)| Key::new(name, property, root))
        .collect();
    let inner: Vec<(String, &Value)> = keys
        .iter()
        .filter(|key| key.also.is_none())
        .filter_map(|key| {
            let inner = inner(&properties[&key.name], root)?;
            Some((super::build::join(path, &key.name), inner))
        })
        .collect();
    blocks.push(KeyBlock {
        path: path.to_owned(),
        meaning: object["description"]
            .as_str()
            .unwrap_or_default()
            .to_owned(),
        keys,
    });
    for (path, object) in inner {
        collect(&path, object, root, blocks);
    }
}

/// Schema that a reference stands for.
fn resolved<'a>(schema: &'a Value, root: &'a Value) -> &'a Value {
    let name = schema["$ref"].as_str().and_then(|r| r.rsplit('/').next());
    name.map_or(schema, |name| &root["$defs"][name])
}

/// The object with keys of its own that a value is, or of which it has many.
fn inner<'a>(schema: &'a Value, root: &'a Value) -> Option<&'a Value> {
    let schema = resolved(schema, root);
    if schema["properties"].is_object() {
        return Some(schema);
    }
    let forms = schema["anyOf"].as_array().into_iter().flatten();
    forms
        .chain([&schema["items"], &schema["additionalProperties"]])
        .find_map(|form| match form {
            Value::Object(_) => inner(form, root),
            _ => None,
        })
}

/// The kind of a value in words.
fn kind(schema: &Value, root: &Value) -> String {
    let (one, _) = kinds(schema, root);
    one
}

/// The kind of a value in words, for one and for many.
fn kinds(schema: &Value, root: &Value) -> (String, String) {
    let both = |one: &str, many: &str| (one.to_owned(), many.to_owned());
    let schema = resolved(schema, root);
    if let Some(forms) = schema["anyOf"].as_array() {
        let mut words: Vec<String> = vec![];
        for form in forms.iter().filter(|form| form["type"] != "null") {
            let (one, _) = kinds(form, root);
            if !words.contains(&one) {
                words.push(one);
            }
        }
        let words = words.join(" or ");
        return (words.clone(), words);
    }
    let of_type = match &schema["type"] {
        Value::Array(types) => types.iter().find(|word| **word != "null"),
        word => Some(word),
    };
    let is_word = schema["enum"].is_array();
    match of_type.and_then(Value::as_str) {
        Some("string") if is_word => both("a word", "words"),
        Some("string") if schema["x-file"] == true => both("the name of a file", "names of files"),
        Some("string") => both("a text", "texts"),
        Some("number") => both("a number", "numbers"),
        Some("integer") => both("a whole number", "whole numbers"),
        Some("boolean") => both("true or false", "truth values"),
        Some("array") => {
            let (_, many) = kinds(&schema["items"], root);
            (format!("a list of {many}"), format!("lists of {many}"))
        }
        Some("object") if schema["properties"].is_object() => both("an object", "objects"),
        Some("object") => both("named objects", "named objects"),
        _ => both("a value", "values"),
    }
}

/// The JSON Schema of a scene file, for editors: the description of a key says its unit and default too.
#[must_use]
pub fn schema() -> Value {
    let raw = schema_for!(RawScene).to_value();
    let mut said = raw.clone();
    say_more(&mut said, &raw);
    let definitions = said.get_mut("$defs").and_then(Value::as_object_mut);
    for definition in definitions.into_iter().flat_map(Map::values_mut) {
        say_more(definition, &raw);
    }
    said
}

/// Puts what is said of the keys of an object into their descriptions.
fn say_more(object: &mut Value, root: &Value) {
    let properties = object.get_mut("properties").and_then(Value::as_object_mut);
    for (name, property) in properties.into_iter().flatten() {
        let key = Key::new(name, property, root);
        property["description"] = format!("{}{}", key.meaning, key.more()).into();
    }
}
