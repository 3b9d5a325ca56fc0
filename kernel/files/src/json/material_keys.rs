//! The keys of a material: those of every material, and those of the laws that there are.

use std::borrow::Cow;
use std::fmt;

use proctor_kernel::laws::{ALL, Choice, Constant};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor};

/// A material as written: flat, all keys optional, nothing checked but types.
#[derive(Debug, Default)]
pub(super) struct RawMaterial {
    /// Constitutive law.
    pub r#type: Option<String>,
    /// Identifier, to which bodies refer.
    pub id: Option<i64>,
    /// Initial mass density [kg/m³].
    pub density: Option<f64>,
    numbers: Vec<(&'static str, Option<f64>)>,
    words: Vec<(&'static str, Option<String>)>,
}

impl RawMaterial {
    /// The number at a key of a law.
    pub fn number(&self, constant: &Constant) -> Option<f64> {
        let given = self.numbers.iter().find(|(key, _)| *key == constant.key);
        given.and_then(|(_, value)| *value)
    }

    /// The word at a key of a law.
    pub fn word(&self, choice: &Choice) -> Option<&String> {
        let given = self.words.iter().find(|(key, _)| *key == choice.key);
        given.and_then(|(_, word)| word.as_ref())
    }
}

/// The numbers that the laws need, each key once.
fn constants() -> Vec<&'static Constant> {
    let mut all: Vec<&Constant> = vec![];
    for constant in ALL.iter().flat_map(|law| law.constants) {
        if all.iter().all(|known| known.key != constant.key) {
            all.push(constant);
        }
    }
    all
}

/// The words that the laws may be given, each key once.
pub(super) fn choices() -> Vec<&'static Choice> {
    let mut all: Vec<&Choice> = vec![];
    for choice in ALL.iter().flat_map(|law| law.choices) {
        if all.iter().all(|known| known.key != choice.key) {
            all.push(choice);
        }
    }
    all
}

/// A key that a material may have. One that it may not is refused while it is read, so that the error has its place.
struct Key(String);

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let key = String::deserialize(deserializer)?;
        let of_all = ["type", "id", "density"].into_iter();
        let numbers = constants().into_iter().map(|constant| constant.key);
        let words = choices().into_iter().map(|choice| choice.key);
        let known: Vec<&str> = of_all.chain(numbers).chain(words).collect();
        if known.contains(&key.as_str()) {
            return Ok(Self(key));
        }
        let known: Vec<String> = known.into_iter().map(|key| format!("`{key}`")).collect();
        let known = known.join(", ");
        Err(D::Error::custom(format!(
            "unknown field `{key}`, expected one of {known}"
        )))
    }
}

struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = RawMaterial;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with the keys of a material")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RawMaterial, A::Error> {
        let (constants, choices) = (constants(), choices());
        let mut material = RawMaterial::default();
        let mut seen: Vec<String> = vec![];
        while let Some(Key(key)) = map.next_key()? {
            // The words of serde's own errors for keys of a struct, so that all are reported alike.
            if seen.contains(&key) {
                return Err(A::Error::custom(format!("duplicate field `{key}`")));
            }
            match key.as_str() {
                "type" => material.r#type = map.next_value()?,
                "id" => material.id = map.next_value()?,
                "density" => material.density = map.next_value()?,
                key => {
                    if let Some(constant) = constants.iter().find(|c| c.key == key) {
                        material.numbers.push((constant.key, map.next_value()?));
                    } else if let Some(choice) = choices.iter().find(|c| c.key == key) {
                        material.words.push((choice.key, map.next_value()?));
                    }
                }
            }
            seen.push(key);
        }
        Ok(material)
    }
}

impl<'de> Deserialize<'de> for RawMaterial {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Keys)
    }
}

impl JsonSchema for RawMaterial {
    fn schema_name() -> Cow<'static, str> {
        "RawMaterial".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = ALL.iter().map(|law| law.name).collect();
        let mut schema = json_schema!({
            "description": "A material.",
            "type": "object",
            "properties": {
                "type": {
                    "description": "Constitutive law.",
                    "type": ["string", "null"],
                    "enum": names,
                },
                "id": {
                    "description": "Identifier, to which bodies refer.",
                    "type": ["integer", "null"],
                    "format": "int64",
                },
                "density": {
                    "description": "Initial mass density [kg/m³].",
                    "type": ["number", "null"],
                    "format": "double",
                },
            },
            "additionalProperties": false,
        });
        let properties = schema
            .get_mut("properties")
            .and_then(serde_json::Value::as_object_mut);
        if let Some(properties) = properties {
            for constant in constants() {
                let unit = match constant.unit {
                    "" => String::new(),
                    unit => format!(" [{unit}]"),
                };
                let property = json_schema!({
                    "description": format!("{}{unit}.", constant.meaning),
                    "type": ["number", "null"],
                    "format": "double",
                });
                properties.insert(constant.key.to_owned(), property.to_value());
            }
            for choice in choices() {
                let default = choice.words.first().copied().unwrap_or_default();
                let property = json_schema!({
                    "description": format!("{} Default: `{default}`.", choice.meaning),
                    "type": ["string", "null"],
                    "enum": choice.words,
                });
                properties.insert(choice.key.to_owned(), property.to_value());
            }
        }
        schema
    }
}
