//! Machine, compiler and commit: what a reader needs to repeat the measurement.

use super::html::{Section, Table};
use crate::record::Record;
use serde_json::Value;

/// The section, where the record says anything of its context.
pub fn section(record: &Record) -> Option<Section> {
    let context = record.context.as_object()?;
    let mut table = Table::new("Where and how the record was measured", &["key", "value"]);
    for (key, value) in context {
        table.push([key.replace('_', " "), said(value)]);
    }
    Some(Section {
        id: "machine",
        title: "Machine and commit".to_owned(),
        body: table.html(),
    })
}

/// A value without quotes and braces.
fn said(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(values) => values.iter().map(said).collect::<Vec<_>>().join(", "),
        Value::Object(map) => map
            .iter()
            .map(|(key, value)| format!("{key} {}", said(value)))
            .collect::<Vec<_>>()
            .join(" "),
        other => other.to_string(),
    }
}
