//! Renamed gates and quantities: names in old records, and their names today.
//!
//! A clumsy name can become a good one without losing its history: records and ledgers are read under today's names, so that
//! `compare`, `history` and the ledger see one number and not two. `renamed.csv` beside this file lists the parts of names
//! that changed. It only grows, and no part is a name of today.

use super::row::key;
use std::borrow::Cow;
use std::sync::LazyLock;

/// A part of names that changed.
#[derive(Debug)]
pub struct Renaming {
    /// Name in old records.
    pub old: String,
    /// Name in new ones.
    pub new: String,
}

/// All parts of names that ever changed, in their order.
pub static RENAMINGS: LazyLock<Vec<Renaming>> = LazyLock::new(|| {
    let mut table = csv::Reader::from_reader(include_str!("renamed.csv").as_bytes());
    let rows: Result<Vec<(String, String)>, _> = table.deserialize().collect();
    let rows = rows.expect("the table of the program is a table");
    rows.into_iter()
        .map(|(old, new)| Renaming { old, new })
        .collect()
});

/// Today's form of a name, of a gate for example.
#[must_use]
pub fn name(name: &str) -> Cow<'_, str> {
    let mut today = Cow::Borrowed(name);
    for Renaming { old, new } in &*RENAMINGS {
        if today.contains(old.as_str()) {
            today = today.replace(old.as_str(), new).into();
        }
    }
    today
}

/// Today's form of a key of a row, `error_` and the words of a quantity for example.
#[must_use]
pub fn key_of_row(of_row: &str) -> Cow<'_, str> {
    static KEYS: LazyLock<Vec<[String; 2]>> = LazyLock::new(|| {
        let parts = RENAMINGS.iter();
        parts.map(|part| [key(&part.old), key(&part.new)]).collect()
    });
    let mut today = Cow::Borrowed(of_row);
    for [old, new] in &*KEYS {
        let Some(at) = today.find(old.as_str()) else {
            continue;
        };
        let end = at + old.len();
        let begins = at == 0 || today.as_bytes()[at - 1] == b'_';
        if begins && matches!(today.as_bytes().get(end), None | Some(b'_')) {
            today = format!("{}{new}{}", &today[..at], &today[end..]).into();
        }
    }
    today
}
