//! Records in the shapes that other tools read.
//!
//! | format | for | times | beside them |
//! |---|---|---|---|
//! | BMF | Bencher (Bencher Metric Format) | `latency` \[ns\], median, least and most | errors, orders, counts as benchmarks of their own |
//! | github | github-action-benchmark, `customSmallerIsBetter` | median \[ms\] | errors and counts, for which less is better |
//! | critcmp | critcmp, as its own `--export` writes it | mean and median \[ns\] | particles per second |
//! | CSV | everything else | every row \[s\] | every counter and label |
//! | gates | people: Markdown, a table per case | none | what each gate found, and its bound |
//! | summary, badge | the summary of a CI job, shields.io | CPU \[s\] | verdict, errors of other solvers |
//! | junit | GitHub, GitLab, Jenkins and test viewers | of a case \[s\] | a test per gate |
//!
//! [`super::otava`] is a table over several records.

use super::{CaseKey, Cases, Record, Series, junit, summary};
use crate::show::number;
use crate::statistics::{Summary, median, ratio_interval};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use thiserror::Error;

/// Shape of an exported record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Bencher Metric Format.
    Bmf,
    /// `customSmallerIsBetter` of github-action-benchmark.
    Github,
    /// A baseline of critcmp.
    Critcmp,
    /// Comma-separated values, a line per row.
    Csv,
    /// Value and bound of each gate, as Markdown.
    Gates,
    /// A test per gate, as JUnit XML.
    Junit,
    /// Verdict and other solvers, as Markdown.
    Summary,
    /// A badge for the endpoint of shields.io.
    Badge,
}

/// Reason for which a record cannot be exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// Nothing in the record has a place in the format.
    #[error("nothing in the record has a place in this format")]
    Nothing,
    /// The text cannot be made.
    #[error("CSV: {0}")]
    Csv(csv::Error),
}

/// The text of a record in a format; `baseline` names it for critcmp. Runs that failed are left out but for CSV.
///
/// # Errors
/// [`ExportError`] if nothing of the record has a place in the format.
pub fn text(record: &Record, format: Format, baseline: &str) -> Result<String, ExportError> {
    let cases = Cases::of(record);
    let value = match format {
        Format::Bmf => bmf(&cases),
        Format::Github => github(&cases),
        Format::Critcmp => critcmp(&cases, baseline),
        Format::Csv => return csv(record),
        Format::Gates => return gates(record),
        Format::Summary => return Ok(summary::markdown(record)),
        Format::Badge => Some(summary::badge(record)),
        Format::Junit => return junit::text(record).ok_or(ExportError::Nothing),
    };
    value
        .map(|value| format!("{value:#}\n"))
        .ok_or(ExportError::Nothing)
}

/// Cases without a failed run.
fn sound(cases: &Cases) -> impl Iterator<Item = &(CaseKey, Series)> {
    cases
        .list
        .iter()
        .filter(|(_, series)| series.errors.is_empty())
}

/// Counters with their medians whose key begins with one of these.
fn counters<'a>(
    series: &'a Series,
    starts: &'a [&str],
) -> impl Iterator<Item = (&'a str, f64)> + 'a {
    series.counters.iter().filter_map(move |(key, values)| {
        let wanted = starts.iter().any(|start| key.starts_with(start));
        Some((wanted.then_some(key.as_str())?, median(values)?))
    })
}

/// Keys of counters for which less is better.
const LESS: [&str; 4] = ["error_", "instructions", "steps", "bytes_per_"];

/// Measure of each counter; Bencher sets its alarms by measure.
const MEASURES: [(&str, &str); 5] = [
    ("error_", "error"),
    ("observed_order", "observed-order"),
    ("instructions", "instructions"),
    ("steps", "steps"),
    ("bytes_per_", "bytes"),
];

fn bmf(cases: &Cases) -> Option<Value> {
    let mut all = Map::new();
    for (case, series) in sound(cases) {
        if let Some(wall) = Summary::of(&series.all_wall()) {
            let ns = 1e9;
            let latency = json!({
                "value": wall.median * ns,
                "lower_value": wall.minimum * ns,
                "upper_value": wall.maximum * ns,
            });
            all.insert(case.to_string(), json!({ "latency": latency }));
        }
        for (start, measure) in MEASURES {
            for (key, value) in counters(series, &[start]) {
                // A name of a measure has at most 64 characters, that of a benchmark a thousand.
                let name = format!("{case}: {key}");
                all.insert(name, json!({ (measure): { "value": value } }));
            }
        }
    }
    (!all.is_empty()).then(|| all.into())
}

fn github(cases: &Cases) -> Option<Value> {
    let mut all = vec![];
    for (case, series) in sound(cases) {
        if let Some(wall) = Summary::of(&series.all_wall()) {
            all.push(json!({
                "name": case.to_string(),
                "unit": "ms",
                "value": wall.median * 1e3,
                "range": format!("± {:.3}", (wall.upper_quartile - wall.lower_quartile) * 1e3 / 2.0),
                "extra": format!("median of {}, least {:.3} ms", wall.count, wall.minimum * 1e3),
            }));
        }
        for (key, value) in counters(series, &LESS) {
            let unit = if key.starts_with("error_") {
                "relative error"
            } else {
                "count"
            };
            all.push(json!({ "name": format!("{case}: {key}"), "unit": unit, "value": value }));
        }
    }
    (!all.is_empty()).then(|| all.into())
}

fn critcmp(cases: &Cases, baseline: &str) -> Option<Value> {
    let mut all = Map::new();
    for (case, series) in sound(cases) {
        let name = case.to_string();
        let times: Vec<f64> = series.all_wall().iter().map(|wall| wall * 1e9).collect();
        let Some(estimates) = estimates(&times) else {
            continue;
        };
        let (group, function) = name.split_once('/').unwrap_or((&name, ""));
        let counter = |key| series.counters.get(key).and_then(|values| median(values));
        let elements = counter("particles").zip(counter("steps"));
        let throughput = elements.map(
            |(particles, steps)| json!({ "Bytes": null, "Elements": (particles * steps) as u64 }),
        );
        let benchmark = json!({
            "baseline": baseline,
            "fullname": format!("{baseline}/{name}"),
            "criterion_benchmark_v1": {
                "group_id": group,
                "function_id": (!function.is_empty()).then_some(function),
                "value_str": null,
                "throughput": throughput,
                "full_id": name,
                "directory_name": name,
            },
            "criterion_estimates_v1": estimates,
        });
        all.insert(name, benchmark);
    }
    (!all.is_empty()).then(|| json!({ "name": baseline, "benchmarks": all }))
}

/// Estimates as criterion has them, in the unit of the values.
fn estimates(values: &[f64]) -> Option<Value> {
    let n = values.len() as f64;
    let middle = median(values)?;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    let deviation = if n > 1.0 {
        (squares / (n - 1.0)).sqrt()
    } else {
        0.0
    };
    let error = deviation / n.sqrt();
    let distances: Vec<f64> = values.iter().map(|x| (x - middle).abs()).collect();
    let estimate = |value: f64, error: f64, (lower, upper): (f64, f64)| {
        json!({
            "confidence_interval": {
                "confidence_level": 0.95, "lower_bound": lower, "upper_bound": upper
            },
            "point_estimate": value,
            "standard_error": error,
        })
    };
    let around = |value: f64| estimate(value, error, (value - 1.96 * error, value + 1.96 * error));
    Some(json!({
        "mean": around(mean),
        "median": estimate(middle, error, ratio_interval(&[1.0], values, 1)?),
        "median_abs_dev": around(median(&distances)?),
        "slope": null,
        "std_dev": around(deviation),
    }))
}

fn csv(record: &Record) -> Result<String, ExportError> {
    let mut bytes = vec![];
    record.table(&mut bytes).map_err(ExportError::Csv)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Gates as a table per case, in the order of the record. One that does not hold is marked.
fn gates(record: &Record) -> Result<String, ExportError> {
    let word = |key: &str| record.context[key].as_str().unwrap_or("unknown");
    let mut text = format!(
        "Measured until {}, {} ladders. Units are SI, errors relative.\n",
        word("date"),
        record.ladder().unwrap_or("other"),
    );
    let mut before = "";
    for gate in record.gate_rows() {
        if gate.case != before {
            let _ = write!(text, "\n## {}\n\n", gate.case);
            if let Some(commit) = gate.row.labels.get("commit") {
                let commit: String = commit.chars().take(10).collect();
                let _ = write!(text, "Commit {commit}.\n\n");
            }
            text.push_str("| gate | found | bound |\n|---|--:|--:|\n");
            before = gate.case;
        }
        let _ = writeln!(
            text,
            "| {} | {}{} | {} {} |",
            gate.name,
            gate.value.map_or_else(|| "none".to_owned(), number),
            if gate.holds() { "" } else { " **fails**" },
            gate.side,
            number(gate.bound.unwrap_or(f64::NAN))
        );
    }
    if before.is_empty() {
        return Err(ExportError::Nothing);
    }
    Ok(text)
}
