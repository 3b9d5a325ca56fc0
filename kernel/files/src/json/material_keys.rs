//! The keys of a material: those of every material, and those of the laws that there are.

use std::borrow::Cow;
use std::fmt;

use proctor_laws::{ALL, Choice, Constant, ConstantDefault, ConstantRange, Curve, LawType, Rows};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde_json::{Value, json};

use super::lists::Comment;
use super::words::PERMEABILITIES;

/// The keys of the water in the pores of a material.
const OF_WATER: [&str; 6] = [
    "porosity",
    "density_fluid",
    "bulk_fluid",
    "hydraulic_conductivity",
    "conductivity_gravity",
    "permeability",
];

/// A material as written: flat, all keys optional, nothing checked but types.
#[derive(Debug, Default)]
pub(super) struct RawMaterial {
    /// Constitutive law.
    pub r#type: Option<String>,
    /// Identifier, to which bodies refer.
    pub id: Option<i64>,
    /// Initial mass density [kg/m³].
    pub density: Option<f64>,
    /// Porosity at the start.
    pub porosity: Option<f64>,
    /// Density of the pore water [kg/m³].
    pub density_fluid: Option<f64>,
    /// Bulk modulus of the pore water [Pa].
    pub bulk_fluid: Option<f64>,
    /// Hydraulic conductivity per axis [m/s].
    pub hydraulic_conductivity: Option<Vec<f64>>,
    /// Gravity of the conductivity [m/s²].
    pub conductivity_gravity: Option<f64>,
    /// Law of the conductivity.
    pub permeability: Option<String>,
    numbers: Vec<(&'static str, Option<f64>)>,
    words: Vec<(&'static str, Option<String>)>,
    curves: Vec<(&'static str, Option<Rows>)>,
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

    /// The rows at a key of a law.
    pub fn curve(&self, curve: &Curve) -> Option<&Rows> {
        let given = self.curves.iter().find(|(key, _)| *key == curve.key);
        given.and_then(|(_, rows)| rows.as_ref())
    }
}

/// The numbers that the laws need, each key once.
pub(super) fn constants() -> Vec<&'static Constant> {
    each_once(|law| law.constants, |constant| constant.key)
}

/// The words that the laws may be given, each key once.
pub(super) fn choices() -> Vec<&'static Choice> {
    each_once(|law| law.choices, |choice| choice.key)
}

/// The curves that the laws may be given, each key once.
pub(super) fn curves() -> Vec<&'static Curve> {
    each_once(|law| law.curves, |curve| curve.key)
}

fn each_once<T>(
    of: impl Fn(&LawType) -> &'static [T],
    key: impl Fn(&T) -> &'static str,
) -> Vec<&'static T> {
    let mut all: Vec<&T> = vec![];
    for one in ALL.iter().flat_map(of) {
        if all.iter().all(|known| key(known) != key(one)) {
            all.push(one);
        }
    }
    all
}

/// A key that a material may have. One that it may not is refused while it is read, so that the error has its place.
struct MaterialKey(String);

impl<'de> Deserialize<'de> for MaterialKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let key = String::deserialize(deserializer)?;
        let of_all = ["type", "id", "density"].into_iter();
        let numbers = constants().into_iter().map(|constant| constant.key);
        let curves = curves().into_iter().map(|curve| curve.key);
        let words = choices().into_iter().map(|choice| choice.key);
        let known: Vec<&str> = (of_all.chain(numbers).chain(curves).chain(words))
            .chain(OF_WATER)
            .chain(["comment"])
            .collect();
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

/// A word; `true` and `false` may stand without quotes.
struct Word(String);

impl<'de> Deserialize<'de> for Word {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WordSeed;
        impl Visitor<'_> for WordSeed {
            type Value = Word;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a string")
            }
            fn visit_str<E: Error>(self, word: &str) -> Result<Word, E> {
                Ok(Word(word.to_owned()))
            }
            fn visit_bool<E: Error>(self, word: bool) -> Result<Word, E> {
                Ok(Word(word.to_string()))
            }
        }
        deserializer.deserialize_any(WordSeed)
    }
}

struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = RawMaterial;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with the keys of a material")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RawMaterial, A::Error> {
        let (constants, choices, curves) = (constants(), choices(), curves());
        let mut material = RawMaterial::default();
        let mut seen: Vec<String> = vec![];
        while let Some(MaterialKey(key)) = map.next_key()? {
            // The words of serde's own errors for keys of a struct, so that all are reported alike.
            if seen.contains(&key) {
                return Err(A::Error::custom(format!("duplicate field `{key}`")));
            }
            match key.as_str() {
                "type" => material.r#type = map.next_value()?,
                "id" => material.id = map.next_value()?,
                "density" => material.density = map.next_value()?,
                "porosity" => material.porosity = map.next_value()?,
                "density_fluid" => material.density_fluid = map.next_value()?,
                "bulk_fluid" => material.bulk_fluid = map.next_value()?,
                "hydraulic_conductivity" => material.hydraulic_conductivity = map.next_value()?,
                "conductivity_gravity" => material.conductivity_gravity = map.next_value()?,
                "permeability" => material.permeability = map.next_value()?,
                "comment" => {
                    map.next_value::<Option<Comment>>()?;
                }
                key => {
                    if let Some(constant) = constants.iter().find(|c| c.key == key) {
                        material.numbers.push((constant.key, map.next_value()?));
                    } else if let Some(choice) = choices.iter().find(|c| c.key == key) {
                        let word: Option<Word> = map.next_value()?;
                        material.words.push((choice.key, word.map(|word| word.0)));
                    } else if let Some(curve) = curves.iter().find(|c| c.key == key) {
                        material.curves.push((curve.key, map.next_value()?));
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

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = ALL.iter().map(|law| law.name).collect();
        let meanings = ALL
            .iter()
            .map(|law| format!("`{}`: {}.", law.name, law.meaning));
        let meanings: Vec<String> = meanings.collect();
        let mut schema = json_schema!({
            "description": "A material.",
            "type": "object",
            "properties": {
                "type": {
                    "description": format!("Constitutive law. {}", meanings.join(" ")),
                    "type": ["string", "null"],
                    "enum": names,
                    "x-needed": true,
                    "examples": [names.first()],
                },
                "id": {
                    "description": "Identifier, to which bodies refer.",
                    "type": ["integer", "null"],
                    "format": "int64",
                    "x-needed": true,
                    "examples": [1],
                },
                "density": {
                    "description": "Initial mass density.",
                    "type": ["number", "null"],
                    "format": "double",
                    "x-unit": "kg/m³",
                    "x-needed": true,
                    "exclusiveMinimum": 0,
                    "examples": [1000],
                },
                "comment": {
                    "description": "Words for people, in every object: one text or a list of them. Nothing reads them.",
                    "anyOf": [generator.subschema_for::<Comment>(), { "type": "null" }],
                    "x-default": "none",
                    "examples": ["stiffer than the soil"],
                },
            },
            "additionalProperties": false,
        });
        let of_water = [
            (
                "porosity",
                "Share of the volume that is pores, at the start. `density` is that of the grains then",
                "1",
                json!(0.4),
            ),
            (
                "density_fluid",
                "Density of the water in the pores",
                "kg/m³",
                json!(1000),
            ),
            (
                "bulk_fluid",
                "Bulk modulus of the water in the pores",
                "Pa",
                json!(2e9),
            ),
        ];
        let properties = schema
            .get_mut("properties")
            .and_then(serde_json::Value::as_object_mut);
        if let Some(properties) = properties {
            for (key, meaning, unit, example) in of_water {
                properties.insert(key.to_owned(), of_pores(meaning, unit, &example));
            }
            if let Some(porosity) = properties.get_mut("porosity") {
                porosity["exclusiveMaximum"] = 1.into();
            }
            properties.insert(
                "hydraulic_conductivity".to_owned(),
                json!({
                    "description": "Hydraulic conductivity, one number per axis.",
                    "type": ["array", "null"],
                    "items": { "type": "number", "format": "double", "exclusiveMinimum": 0 },
                    "x-unit": "m/s",
                    "x-needed": true,
                    "x-needs": "`n_phases` 2",
                    "examples": [[1e-4, 1e-4], [1e-4, 1e-4, 1e-4]],
                }),
            );
            let gravity = "Gravity for which the conductivity was measured, whatever gravity acts";
            let mut gravity = of_pores(gravity, "m/s²", &json!(9.81));
            if let Some(gravity) = gravity.as_object_mut() {
                gravity.remove("x-needed");
                gravity.insert("default".to_owned(), 9.81.into());
            }
            properties.insert("conductivity_gravity".to_owned(), gravity);
            let words: Vec<&str> = PERMEABILITIES.iter().map(|(word, _)| *word).collect();
            properties.insert(
                "permeability".to_owned(),
                json!({
                    "description": "Law by which the conductivity follows the skeleton, whose volume is J times that of the \
                        start and whose porosity is n. `constant`: it stays. `square`: times J². `kozeny_carman`: times J² n³ over that \
                        of the start, in proportion to n³/(1-n)².",
                    "type": ["string", "null"],
                    "enum": words,
                    "default": "constant",
                    "x-needs": "`n_phases` 2",
                    "examples": ["kozeny_carman"],
                }),
            );
            for constant in constants() {
                properties.insert(constant.key.to_owned(), of_constant(constant));
            }
            for choice in choices() {
                properties.insert(choice.key.to_owned(), of_choice(choice));
            }
            for curve in curves() {
                properties.insert(curve.key.to_owned(), of_curve(curve));
            }
        }
        schema
    }
}

/// The schema of a number greater than zero that water in the pores needs.
fn of_pores(meaning: &str, unit: &str, example: &Value) -> Value {
    json!({
        "description": format!("{meaning}."),
        "type": ["number", "null"],
        "format": "double",
        "x-unit": unit,
        "x-needed": true,
        "x-needs": "`n_phases` 2",
        "exclusiveMinimum": 0,
        "examples": [example],
    })
}

/// The schema of a number that some laws need.
fn of_constant(constant: &Constant) -> Value {
    let own = |law: &'static LawType| law.constants.iter().find(|own| own.key == constant.key);
    let mut property = json!({
        "description": said_by_laws(|law| Some(own(law)?.meaning.to_owned())) + ".",
        "type": ["number", "null"],
        "format": "double",
        "x-unit": if constant.unit.is_empty() { "1" } else { constant.unit },
        "examples": [example(constant)],
    });
    let all = || ALL.iter().filter_map(own);
    match constant.given {
        given if all().any(|other| other.given != given) => {
            let otherwise = said_by_laws(|law| {
                Some(match own(law)?.given {
                    ConstantDefault::Needed => "none".to_owned(),
                    ConstantDefault::Or(value) => value.to_string(),
                    ConstantDefault::As(key) => format!("`{key}`"),
                })
            });
            property["x-default"] = otherwise.into();
        }
        ConstantDefault::Needed => property["x-needed"] = true.into(),
        ConstantDefault::Or(value) => property["default"] = value.into(),
        ConstantDefault::As(key) => property["x-default"] = format!("`{key}`").into(),
    }
    match constant.accepted {
        ConstantRange::Positive => property["exclusiveMinimum"] = 0.into(),
        ConstantRange::NotNegative => property["minimum"] = 0.into(),
        ConstantRange::Between(low, high) => {
            property["exclusiveMinimum"] = low.into();
            property["exclusiveMaximum"] = high.into();
        }
        ConstantRange::From(low, high) => {
            property["minimum"] = low.into();
            property["exclusiveMaximum"] = high.into();
        }
        ConstantRange::Finite => {}
    }
    needs(&mut property, |law| {
        law.constants.iter().any(|own| own.key == constant.key)
    });
    property
}

/// The schema of a word that some laws may be given.
fn of_choice(choice: &Choice) -> Value {
    // What may be true or false is that, without quotes.
    let is_flag = choice.words == ["false", "true"];
    let mut property = if is_flag {
        json!({
            "description": choice.meaning,
            "type": ["boolean", "null"],
            "default": false,
            "examples": [true],
        })
    } else {
        json!({
            "description": choice.meaning,
            "type": ["string", "null"],
            "enum": choice.words,
            "default": choice.words.first(),
            "examples": [choice.words.last()],
        })
    };
    needs(&mut property, |law| {
        law.choices.iter().any(|own| own.key == choice.key)
    });
    property
}

/// The schema of a curve that some laws may be given.
fn of_curve(curve: &Curve) -> Value {
    let own = |law: &'static LawType| law.curves.iter().find(|own| own.key == curve.key);
    let units = curve
        .units
        .map(|unit| if unit.is_empty() { "1" } else { unit });
    let mut property = json!({
        "description": said_by_laws(|law| Some(own(law)?.meaning.to_owned())) + ".",
        "type": ["array", "null"],
        "items": {
            "type": "array",
            "items": { "type": "number", "format": "double" },
            "minItems": 2,
            "maxItems": 2,
        },
        "x-unit": units.join(", "),
        "x-default": "none",
        "examples": [curve.example],
    });
    needs(&mut property, |law| {
        law.curves.iter().any(|own| own.key == curve.key)
    });
    property
}

/// Description of a key by its laws: one text where they agree, else one for each type.
fn said_by_laws(of: impl Fn(&'static LawType) -> Option<String>) -> String {
    let mut all: Vec<(String, Vec<&str>)> = vec![];
    for law in ALL {
        let Some(said) = of(law) else { continue };
        match all.iter_mut().find(|(known, _)| *known == said) {
            Some((_, laws)) => laws.push(law.name),
            None => all.push((said, vec![law.name])),
        }
    }
    if let [(said, _)] = &all[..] {
        return said.clone();
    }
    let each = all.iter().map(|(said, laws)| {
        let laws: Vec<String> = laws.iter().map(|law| format!("{law:?}")).collect();
        format!("{said} (`type` {})", laws.join(" or "))
    });
    each.collect::<Vec<_>>().join("; ")
}

/// Says of a key which laws have it, unless all do.
fn needs(property: &mut Value, has: impl Fn(&LawType) -> bool) {
    let having = ALL.iter().filter(|law| has(law));
    let words: Vec<String> = having.map(|law| format!("{:?}", law.name)).collect();
    if words.len() < ALL.len() {
        property["x-needs"] = format!("`type` {}", words.join(" or ")).into();
    }
}

/// A value that a soft solid may have.
fn example(constant: &Constant) -> f64 {
    match constant.accepted {
        ConstantRange::Positive | ConstantRange::NotNegative if constant.unit == "Pa" => 1e6,
        ConstantRange::Positive => 1.0,
        ConstantRange::NotNegative | ConstantRange::Finite => 0.0,
        ConstantRange::From(..) => 30.0,
        accepted @ ConstantRange::Between(..) if accepted.holds(0.3) => 0.3,
        ConstantRange::Between(low, high) => 0.5 * (low + high),
    }
}
