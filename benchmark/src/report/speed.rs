//! Speed of whole steps, beside what the machine's arithmetic and memory would take alone.

use super::html::{Cell, Pictures, Section, Table, paragraph};
use crate::record::details::Figure;
use crate::record::{Record, Row};
use crate::show::{figures, grouped, number};
use crate::statistics::median;
use std::fmt::Write as _;

/// Whole steps of one scene on one number of threads: medians of the samples.
pub struct Speed {
    scene: String,
    method: String,
    threads: u64,
    particles: f64,
    /// Time by the clock \[ns per particle and step\].
    wall: f64,
    /// Time on the processors \[ns per particle and step\].
    cpu: f64,
    /// Particles times steps per second.
    rate: f64,
    /// The least operations and the least bytes of a step, each over what the machine did at most in the same run.
    shares: [Option<f64>; 2],
}

/// Bases of the shares.
const FLOORS: [&str; 2] = ["arithmetic", "memory"];

impl Speed {
    /// All whole steps of a record, in the order in which it first has them.
    #[must_use]
    pub fn all(record: &Record) -> Vec<Self> {
        let mut steps: Vec<(&str, Vec<&Row>)> = vec![];
        for row in &record.rows {
            if row.error.is_some() || row.labels.get("stage").is_none_or(|s| s != "step") {
                continue;
            }
            match steps.iter_mut().find(|(name, _)| *name == row.name) {
                Some((_, rows)) => rows.push(row),
                None => steps.push((&row.name, vec![row])),
            }
        }
        steps.iter().map(|(_, rows)| Self::of(rows)).collect()
    }

    fn of(rows: &[&Row]) -> Self {
        let middle = |key: &str| {
            let values: Vec<f64> = rows
                .iter()
                .filter_map(|row| row.counters.get(key).copied())
                .collect();
            median(&values)
        };
        let or_nothing = |key: &str| middle(key).unwrap_or(f64::NAN);
        let said = |key: &str| rows[0].labels.get(key).map_or("", String::as_str);
        Self {
            scene: said("scene").to_owned(),
            method: ["shape_function", "stress_scheme_update", "transfer"]
                .map(said)
                .join(" "),
            threads: rows[0].threads,
            particles: or_nothing("particles"),
            wall: or_nothing("wall_ns_per_particle_step"),
            cpu: or_nothing("cpu_ns_per_particle_step"),
            rate: or_nothing("particle_steps_per_second"),
            shares: ["share_of_arithmetic", "share_of_bandwidth"].map(middle),
        }
    }

    fn threads(&self) -> String {
        threads(self.threads)
    }

    /// Times that arithmetic and memory would take alone, each with its name, its share of the time, and that share of the processor
    /// time \[ns per particle and step\].
    fn floors(&self) -> Vec<(&'static str, f64, f64)> {
        let floor = |(name, share): (&'static str, &Option<f64>)| {
            let share = (*share)?;
            Some((name, share, share * self.cpu))
        };
        FLOORS
            .into_iter()
            .zip(&self.shares)
            .filter_map(floor)
            .collect()
    }
}

fn threads(number: u64) -> String {
    match number {
        1 => "1 thread".to_owned(),
        n => format!("{n} threads"),
    }
}

fn share(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

/// The scene that stands for all, which a record has first, and the others.
fn first_and_others(all: &[Speed]) -> (Vec<&Speed>, Vec<&Speed>) {
    all.iter().partition(|speed| speed.scene == all[0].scene)
}

/// The speed of the first scene on the fewest threads in a number and a sentence.
#[must_use]
pub fn headline(all: &[Speed]) -> Option<[String; 2]> {
    let (first, others) = first_and_others(all);
    let one = first.into_iter().min_by_key(|speed| speed.threads)?;
    let mut text = format!(
        "of processor time per particle and step on {}",
        one.threads()
    );
    if !others.is_empty() {
        let _ = write!(text, ", {}", one.scene);
    }
    let floors: Vec<String> = one
        .floors()
        .into_iter()
        .map(|(name, of, _)| format!("{} in {name}", share(of)))
        .collect();
    if !floors.is_empty() {
        text.push_str("; of this machine's peaks it uses ");
        text.push_str(&floors.join(" and "));
    }
    Some([format!("{:.1} ns", one.cpu), text])
}

/// The panel of the first screen: each measured time of the first scene with the two floors below it, and the other scenes
/// in a line each.
#[must_use]
pub fn panel(all: &[Speed]) -> Option<String> {
    let (first, others) = first_and_others(all);
    let longest = |of: &[&Speed]| of.iter().map(|speed| speed.cpu).fold(0.0, f64::max);
    let scale = longest(&first);
    if scale <= 0.0 {
        return None;
    }
    let mut table = Table::new("Processor time per particle and step", &["", "ns", ""]);
    for speed in &first {
        let cells: [Cell; 3] = [
            speed.threads().into(),
            Cell::with_share(number(speed.cpu), speed.cpu / scale),
            format!("{:.1} million particle steps/s", 1e-6 * speed.rate).into(),
        ];
        table.push(cells);
        for (floor, of, ns) in speed.floors() {
            let cells: [Cell; 3] = [
                format!("{floor} alone").into(),
                Cell::with_share(number(ns), ns / scale),
                format!("{} of the time", share(of)).into(),
            ];
            table.push_as("soft", cells);
        }
    }
    let mut html = table.html();
    let one = first[0];
    html.push_str(&paragraph(&format!(
        "Alone: the time of the least operations, or bytes, of a step at the machine's peaks, measured in the same run. \
         The scene is {}, {} particles, with {}.",
        one.scene,
        grouped(one.particles as u64),
        one.method
    )));
    if !others.is_empty() {
        let scale = longest(&others);
        let mut table = Table::new("The other scenes", &["", "ns", "particles"]);
        for speed in others {
            let name = if speed.threads == 1 {
                speed.scene.clone()
            } else {
                format!("{}, {}", speed.scene, speed.threads())
            };
            let cells: [Cell; 3] = [
                name.into(),
                Cell::with_share(number(speed.cpu), speed.cpu / scale),
                grouped(speed.particles as u64).into(),
            ];
            table.push(cells);
        }
        html.push_str(&table.html());
    }
    Some(html)
}

/// The section, where the record holds whole steps.
pub fn section(record: &Record, pictures: &mut Pictures) -> Option<Section> {
    let all = Speed::all(record);
    if all.is_empty() {
        return None;
    }
    let mut bars: Vec<(String, f64)> = vec![];
    let head = [
        "scene",
        "method",
        "threads",
        "particles",
        "ns by the clock",
        "ns of processor time",
        "million particle steps/s",
        "of the machine's memory",
        "of its arithmetic",
    ];
    let mut table = Table::new(
        "Time per particle and step, median of the samples, by scene and threads",
        &head,
    );
    for speed in &all {
        let scene = format!("{}, {}", speed.scene, speed.threads());
        bars.push((scene, speed.cpu));
        let floors = speed.floors();
        bars.extend(
            floors
                .iter()
                .map(|(name, _, ns)| (format!("{name} alone, {}", speed.threads()), *ns)),
        );
        let [arithmetic, memory] = speed.shares.map(|of| of.map_or_else(String::new, share));
        table.push([
            speed.scene.clone(),
            speed.method.clone(),
            speed.threads.to_string(),
            grouped(speed.particles as u64),
            number(speed.wall),
            number(speed.cpu),
            format!("{:.2}", 1e-6 * speed.rate),
            memory,
            arithmetic,
        ]);
    }
    bars.retain(|(_, ns)| ns.is_finite());
    let picture = Figure {
        caption: "Processor time per particle and step, beside the time that its least operations or its least \
            bytes take alone at the peaks of this machine, measured in the same run on as many threads."
            .to_owned(),
        chart: figures::logarithmic_bars("Cost of a step", "ns of processor time per particle and step", &bars),
    };
    let mut body = pictures.one("", &picture);
    body.push_str(&table.html());
    body.push_str(&peaks(record));
    Some(Section {
        id: "speed",
        title: "Speed".to_owned(),
        body,
    })
}

/// Measured peaks of the machine.
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
        text.push_str(&paragraph(&format!(
            "This machine on {}, at most: {:.1} GB/s (a triad, a = b + s c, on arrays beyond the caches) and {:.1} GFLOP/s \
             (multiply-adds in the widest lanes), measured in the same run.",
            threads(row.threads),
            1e-9 * bandwidth,
            1e-9 * arithmetic
        )));
    }
    text
}
