//! A refinement as rows of a record: a sample for each mesh, an aggregate for each quantity.

use super::judge::{FieldBar, QuantityBar, SceneBars};
use super::run::MeshRun;
use super::work::Runs;
use crate::record::row::VERDICT;
use crate::record::{LADDER, Record, Row, key};
use std::fmt::Write;

/// Name of the aggregates that are bars.
pub const BAR: &str = "bar";

/// The history of the column of a quantity on the finest mesh with its bars, as a table in CSV: time, value and half-width of
/// the bar, empty where none is claimed.
#[must_use]
pub fn history(refined: &SceneBars, judged: &QuantityBar, runs: &Runs) -> Option<String> {
    let column = &judged.quantity.column;
    let values = runs.meshes.last()?.columns.get(column)?;
    let claimed = judged.bar().is_some();
    let mut table = format!("time,{column},bar\n");
    for (k, (time, value)) in refined.times.iter().zip(values).enumerate() {
        let bar = judged
            .curve
            .get(k)
            .filter(|bar| claimed && bar.verdict.claims());
        let bar = bar.map_or_else(String::new, |bar| bar.width.to_string());
        // Writing to a text does not fail.
        let _ = writeln!(table, "{time},{value},{bar}");
    }
    Some(table)
}

/// Adds all runs, and where they were judged every quantity.
pub fn push(
    record: &mut Record,
    scene: &str,
    runs: &Runs,
    refined: Option<&SceneBars>,
    threads: usize,
) {
    for (k, run) in runs.meshes.iter().enumerate() {
        let mut row = sample(&format!("refine/{scene}/h={}", run.cell), run, threads);
        row.label(LADDER, format!("refine/{scene}"));
        for judged in refined.iter().flat_map(|refined| &refined.judged) {
            if let Some(value) = judged.values.get(k) {
                row.count(format!("value_{}", key(&judged.quantity.name)), *value);
            }
        }
        record.push(row);
    }
    for (k, run) in runs.moved.iter().enumerate() {
        let name = format!("refine/{scene}/h={}/moved={}", run.cell, k + 1);
        let mut row = sample(&name, run, threads);
        for judged in refined.iter().flat_map(|refined| &refined.judged) {
            if let Some(value) = judged.moved.get(k) {
                row.count(format!("value_{}", key(&judged.quantity.name)), *value);
            }
        }
        record.push(row);
    }
    if let Some(refined) = refined {
        for judged in &refined.judged {
            record.push(bar(scene, refined, judged, runs, threads));
        }
        for field in &refined.fields {
            record.push(of_field(scene, field, threads));
        }
    }
}

fn sample(name: &str, run: &MeshRun, threads: usize) -> Row {
    let mut row = Row::sample(name, 0, threads).timed(run.spent);
    row.count("cell_size", run.cell);
    row.count("particles", run.particles as f64);
    row.count("steps", run.steps as f64);
    row.count("time", run.times.last().copied().unwrap_or(0.0));
    if let Some(fault) = &run.fault {
        row.fail(fault.clone());
    }
    row
}

fn bar(scene: &str, refined: &SceneBars, judged: &QuantityBar, runs: &Runs, threads: usize) -> Row {
    let name = key(&judged.quantity.name);
    let mut row = Row::aggregate(format!("refine/{scene}/{name}"), BAR, threads);
    row.label(VERDICT, judged.verdict());
    row.count(format!("value_{name}"), judged.value());
    let width = match judged.bar() {
        Some(_) => format!("uncertainty_{name}"),
        None => format!("not_claimed_{name}"),
    };
    row.count(width, judged.estimate.width);
    if let Some(order) = judged.estimate.order {
        row.count(format!("observed_order_{name}"), order.min(2.0));
    }
    if let Some(value) = judged.extrapolated() {
        row.count(format!("extrapolated_{name}"), value);
    }
    if let Some(range) = judged.offset_range {
        row.count(format!("offset_range_{name}"), range);
    }
    row.count(format!("change_{name}"), judged.change);
    row.count(format!("largest_in_time_{name}"), judged.norm.width);
    if let Some(cell) = judged.cell_for_one_percent(refined.cells[2]) {
        let times = libm::pow(refined.cells[2] / cell, runs.exponent());
        row.count("cell_size_for_error_0.01", cell);
        row.count("seconds_for_error_0.01", times * runs.finest_seconds());
    }
    row
}

fn of_field(scene: &str, field: &FieldBar, threads: usize) -> Row {
    let name = format!("rms_{}", field.field.word());
    let mut row = Row::aggregate(format!("refine/{scene}/{name}"), BAR, threads);
    row.label(VERDICT, field.estimate.verdict.word());
    row.count(format!("value_{name}"), field.size);
    let word = if field.claimed {
        "uncertainty"
    } else {
        "not_claimed"
    };
    row.count(format!("{word}_{name}"), field.estimate.width);
    if let Some(order) = field.estimate.order {
        row.count(format!("observed_order_{name}"), order.min(2.0));
    }
    row
}
