//! Speed of whole steps, beside the floor of the method and the peaks of the machine.

use super::html::{Section, Table, figure, paragraph};
use crate::record::details::Figure;
use crate::record::{Record, Row};
use crate::show::{figures, grouped, number};
use crate::statistics::median;
use std::collections::BTreeMap;

/// Floors of the method on paper \[ns of CPU per particle and step\]: 3D, 27 nodes, one core of 75 GFLOP/s with AVX-512
/// or of 42 GFLOP/s with AVX2, and two passes over the particles at 11.9 GB/s.
const FLOORS: [(&str, f64); 3] = [
    ("floor: arithmetic, AVX-512", 27.0),
    ("floor: arithmetic, AVX2", 47.0),
    ("floor: memory, two passes", 23.0),
];

/// The section, where the record holds whole steps.
pub fn section(record: &Record) -> Option<Section> {
    let mut steps: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in &record.rows {
        if row.error.is_none() && row.labels.get("stage").is_some_and(|stage| stage == "step") {
            steps.entry(&row.name).or_default().push(row);
        }
    }
    if steps.is_empty() {
        return None;
    }
    let middle = |rows: &[&Row], key: &str| {
        let values: Vec<f64> = rows
            .iter()
            .filter_map(|row| row.counters.get(key).copied())
            .collect();
        median(&values).unwrap_or(f64::NAN)
    };
    let mut bars: Vec<(String, f64)> = FLOORS
        .iter()
        .map(|&(name, floor)| (name.to_owned(), floor))
        .collect();
    let head = [
        "scene",
        "method",
        "threads",
        "particles",
        "wall ns",
        "CPU ns",
        "million/s",
        "of bandwidth",
        "of arithmetic",
    ];
    let mut table = Table::new("ns per particle and step, median of the samples", &head);
    for rows in steps.values() {
        let said = |key: &str| rows[0].labels.get(key).map_or("", String::as_str);
        let (threads, scene) = (rows[0].threads, said("scene"));
        let cpu = middle(rows, "cpu_ns_per_particle_step");
        let plural = if threads == 1 { "" } else { "s" };
        bars.push((format!("{scene}, {threads} thread{plural}: CPU"), cpu));
        let share = |key: &str| {
            let share = middle(rows, key);
            if share.is_finite() {
                format!("{:.0} %", 100.0 * share)
            } else {
                String::new()
            }
        };
        table.push([
            scene.to_owned(),
            ["shape_function", "stress_scheme_update", "transfer"]
                .map(said)
                .join(" "),
            threads.to_string(),
            grouped(middle(rows, "particles") as u64),
            number(middle(rows, "wall_ns_per_particle_step")),
            number(cpu),
            format!("{:.2}", 1e-6 * middle(rows, "particle_steps_per_second")),
            share("share_of_bandwidth"),
            share("share_of_arithmetic"),
        ]);
    }
    let bars: Vec<(String, f64)> = bars.into_iter().filter(|(_, ns)| ns.is_finite()).collect();
    let picture = Figure {
        caption: "CPU time per particle and step, beside the least that a step of 27 nodes in 3D can take: arithmetic \
                  on a core of 75 GFLOP/s with AVX-512 or 42 GFLOP/s with AVX2, memory at 11.9 GB/s."
            .to_owned(),
        chart: figures::bars("Cost of a step", "ns of CPU per particle and step", &bars),
    };
    let mut body = figure(&picture);
    body.push_str(&table.html());
    body.push_str(&peaks(record));
    Some(Section {
        id: "speed",
        title: "Speed".to_owned(),
        body,
    })
}

/// What the machine was measured to do at most.
fn peaks(record: &Record) -> String {
    let mut text = String::new();
    for row in &record.rows {
        let counter = |key: &str| row.counters.get(key).copied();
        let (Some(bandwidth), Some(arithmetic)) = (
            counter("triad_bytes_per_second"),
            counter("multiply_add_flops_per_second"),
        ) else {
            continue;
        };
        let threads = match row.threads {
            1 => "1 thread".to_owned(),
            n => format!("{n} threads"),
        };
        text.push_str(&paragraph(&format!(
            "This machine with {threads}: triad {:.1} GB/s, multiply-adds {:.1} GFLOP/s, measured in the same run.",
            1e-9 * bandwidth,
            1e-9 * arithmetic
        )));
    }
    text
}
