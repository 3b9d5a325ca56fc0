//! Values with more than one form: a list or named entries, one number or one per axis, a vector or a table, a text or
//! lines of it.
//!
//! Written by hand, as serde's untagged enums lose the place of an error.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Unexpected, Visitor};

use super::keys::{RawContact, RawTerrainContact};

/// Entries as a list or as an object of named entries, in the order of the file.
#[derive(Debug)]
pub(super) struct Entries<T>(pub Vec<(Option<String>, T)>);

struct EntriesVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for EntriesVisitor<T> {
    type Value = Entries<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list or an object of named entries")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = list.next_element()? {
            entries.push((None, entry));
        }
        Ok(Entries(entries))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut entries: Vec<(Option<String>, T)> = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            // The words of serde's own error for keys of a struct, so that both are reported alike.
            if entries
                .iter()
                .any(|(known, _)| known.as_ref() == Some(&name))
            {
                return Err(A::Error::custom(format!("duplicate field `{name}`")));
            }
            let entry = map.next_value()?;
            entries.push((Some(name), entry));
        }
        Ok(Entries(entries))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Entries<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EntriesVisitor(PhantomData))
    }
}

impl<T: JsonSchema> JsonSchema for Entries<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("EntriesOf{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let entry = generator.subschema_for::<T>();
        json_schema!({
            "anyOf": [
                { "type": "array", "items": entry },
                { "type": "object", "additionalProperties": entry },
            ]
        })
    }
}

/// Words for people: JSON has no comments. A text or a list of texts, of which nothing is kept.
#[derive(Debug)]
pub(super) struct Comment;

struct CommentVisitor;

impl<'de> Visitor<'de> for CommentVisitor {
    type Value = Comment;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a text in quotes, or a list of them")
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<Comment, E> {
        Ok(Comment)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Comment, A::Error> {
        while list.next_element::<String>()?.is_some() {}
        Ok(Comment)
    }
}

impl<'de> Deserialize<'de> for Comment {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CommentVisitor)
    }
}

impl JsonSchema for Comment {
    fn schema_name() -> Cow<'static, str> {
        "Comment".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let text = json_schema!({ "type": "string" });
        json_schema!({ "anyOf": [text, { "type": "array", "items": text }] })
    }
}

/// One whole number, or one per axis.
#[derive(Debug)]
pub(super) enum Counts {
    One(usize),
    PerAxis(Vec<usize>),
}

struct CountsVisitor;

impl<'de> Visitor<'de> for CountsVisitor {
    type Value = Counts;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a whole number, or a list of one per axis")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Counts, E> {
        usize::try_from(value)
            .map(Counts::One)
            .map_err(|_| E::custom(format!("invalid value: integer `{value}`, expected usize")))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Counts, E> {
        // As for other whole numbers: 2.0 is one.
        if value.fract() == 0.0 && (0.0..=1e9).contains(&value) {
            return Ok(Counts::One(value as usize));
        }
        Err(E::invalid_type(Unexpected::Float(value), &self))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Counts, A::Error> {
        let mut counts = Vec::new();
        while let Some(count) = list.next_element()? {
            counts.push(count);
        }
        Ok(Counts::PerAxis(counts))
    }
}

impl<'de> Deserialize<'de> for Counts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CountsVisitor)
    }
}

impl JsonSchema for Counts {
    fn schema_name() -> Cow<'static, str> {
        "Counts".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let count = json_schema!({ "type": "integer", "minimum": 1 });
        json_schema!({
            "anyOf": [
                count,
                { "type": "array", "items": count, "minItems": 2, "maxItems": 3 },
            ]
        })
    }
}

/// A vector, or rows of numbers.
#[derive(Debug)]
pub(super) enum VectorOrTable {
    Vector(Vec<f64>),
    Table(Vec<Vec<f64>>),
}

/// A number or a row of numbers.
enum NumberOrRow {
    Number(f64),
    Row(Vec<f64>),
}

struct NumberOrRowVisitor;

impl<'de> Visitor<'de> for NumberOrRowVisitor {
    type Value = NumberOrRow;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a row of numbers")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<NumberOrRow, E> {
        Ok(NumberOrRow::Number(value))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<NumberOrRow, E> {
        Ok(NumberOrRow::Number(value as f64))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<NumberOrRow, E> {
        Ok(NumberOrRow::Number(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<NumberOrRow, A::Error> {
        let mut row = Vec::new();
        while let Some(number) = list.next_element()? {
            row.push(number);
        }
        Ok(NumberOrRow::Row(row))
    }
}

impl<'de> Deserialize<'de> for NumberOrRow {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrRowVisitor)
    }
}

struct VectorOrTableVisitor;

impl<'de> Visitor<'de> for VectorOrTableVisitor {
    type Value = VectorOrTable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a vector, or a list of rows of a time and a vector")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<VectorOrTable, A::Error> {
        let (mut vector, mut table) = (Vec::new(), Vec::new());
        while let Some(entry) = list.next_element()? {
            match entry {
                NumberOrRow::Number(number) => vector.push(number),
                NumberOrRow::Row(row) => table.push(row),
            }
            if !vector.is_empty() && !table.is_empty() {
                return Err(A::Error::custom(
                    "invalid value: a mixture of numbers and rows, expected either numbers or rows",
                ));
            }
        }
        Ok(if table.is_empty() {
            VectorOrTable::Vector(vector)
        } else {
            VectorOrTable::Table(table)
        })
    }
}

impl<'de> Deserialize<'de> for VectorOrTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(VectorOrTableVisitor)
    }
}

impl JsonSchema for VectorOrTable {
    fn schema_name() -> Cow<'static, str> {
        "VectorOrTable".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "type": "array", "items": { "type": "number" } },
                { "type": "array", "items": { "type": "array", "items": { "type": "number" } } },
            ]
        })
    }
}

/// A number, or rows of a time and a number.
#[derive(Debug)]
pub(super) enum NumberOrTable {
    Number(f64),
    Table(Vec<Vec<f64>>),
}

struct NumberOrTableVisitor;

impl<'de> Visitor<'de> for NumberOrTableVisitor {
    type Value = NumberOrTable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a list of rows of a time and a number")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<NumberOrTable, E> {
        Ok(NumberOrTable::Number(value))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<NumberOrTable, E> {
        Ok(NumberOrTable::Number(value as f64))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<NumberOrTable, E> {
        Ok(NumberOrTable::Number(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<NumberOrTable, A::Error> {
        let mut table = Vec::new();
        while let Some(row) = list.next_element()? {
            table.push(row);
        }
        Ok(NumberOrTable::Table(table))
    }
}

impl<'de> Deserialize<'de> for NumberOrTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrTableVisitor)
    }
}

impl JsonSchema for NumberOrTable {
    fn schema_name() -> Cow<'static, str> {
        "NumberOrTable".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "type": "number" },
                { "type": "array", "items": { "type": "array", "items": { "type": "number" } } },
            ]
        })
    }
}

/// Contacts as a list or by name, or the switch that an older form of the language has in its place.
#[derive(Debug)]
pub(super) enum Contacts {
    Switch(bool),
    List(Entries<RawContact>),
}

struct ContactsVisitor;

impl<'de> Visitor<'de> for ContactsVisitor {
    type Value = Contacts;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list or an object of named contacts")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Contacts, E> {
        Ok(Contacts::Switch(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Contacts, A::Error> {
        EntriesVisitor(PhantomData)
            .visit_seq(list)
            .map(Contacts::List)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Contacts, A::Error> {
        EntriesVisitor(PhantomData)
            .visit_map(map)
            .map(Contacts::List)
    }
}

impl<'de> Deserialize<'de> for Contacts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ContactsVisitor)
    }
}

impl JsonSchema for Contacts {
    fn schema_name() -> Cow<'static, str> {
        "Contacts".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let list = generator.subschema_for::<Entries<RawContact>>();
        json_schema!({ "anyOf": [{ "type": "boolean" }, list] })
    }
}

/// One rigid surface, as the manuals' program has it, or a list.
#[derive(Debug)]
pub(super) enum Terrains {
    One(Box<RawTerrainContact>),
    List(Vec<RawTerrainContact>),
}

struct TerrainsVisitor;

impl<'de> Visitor<'de> for TerrainsVisitor {
    type Value = Terrains;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with the keys of a terrain contact, or a list of such objects")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Terrains, A::Error> {
        let one = RawTerrainContact::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Terrains::One(Box::new(one)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Terrains, A::Error> {
        let mut terrains = Vec::new();
        while let Some(terrain) = list.next_element()? {
            terrains.push(terrain);
        }
        Ok(Terrains::List(terrains))
    }
}

impl<'de> Deserialize<'de> for Terrains {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TerrainsVisitor)
    }
}

impl JsonSchema for Terrains {
    fn schema_name() -> Cow<'static, str> {
        "Terrains".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<RawTerrainContact>();
        json_schema!({ "anyOf": [one, { "type": "array", "items": one }] })
    }
}
