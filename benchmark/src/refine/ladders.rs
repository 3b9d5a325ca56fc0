//! The ladders of a record of cases, as the calibration of error bars reads them.

use crate::record::{Kind, LADDER, Record};
use proctor_verification::refine::calibration::Ladder;
use std::collections::BTreeMap;

/// Every quantity of a record with its value, exact value and error on the meshes of a ladder. Balances have no error of
/// their own and are left out.
#[must_use]
pub fn of(record: &Record) -> Vec<Ladder> {
    let mut ladders: BTreeMap<(String, String), Vec<[f64; 3]>> = BTreeMap::new();
    for row in &record.rows {
        let sample = matches!(row.kind, Kind::Sample { repetition: 0 }) && row.error.is_none();
        let (Some(name), Some(&cell)) = (row.labels.get(LADDER), row.counters.get("cell_size"))
        else {
            continue;
        };
        for (key, &value) in row.counters.iter().filter(|_| sample) {
            let Some(quantity) = key.strip_prefix("value_") else {
                continue;
            };
            let exact = row.counters.get(&format!("exact_{quantity}"));
            let judged = row.counters.contains_key(&format!("error_{quantity}"));
            if let (Some(&exact), true) = (exact, judged) {
                let meshes = ladders.entry((name.clone(), quantity.to_owned()));
                meshes.or_default().push([cell, value, exact]);
            }
        }
    }
    ladders
        .into_iter()
        .map(|((name, quantity), meshes)| Ladder {
            case: name.split('/').next().unwrap_or_default().to_owned(),
            name,
            quantity,
            meshes,
        })
        .collect()
}
