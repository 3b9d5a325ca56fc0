//! Tables of a session: medians over the repetitions, and their spread.

use super::children::{Child, REFUSED};
use super::machine::Peaks;
use super::plan::Slot;
use super::rows::name;
use super::session::Session;
use crate::record::{Record, Row};
use crate::show::{Table, bytes, filled, grouped, number, seconds};
use crate::statistics::{Summary, median};
use proctor_scene::simulation::Phase;
use std::collections::BTreeSet;
use std::fmt;

/// Rows of a record by their name.
struct Samples<'a>(Vec<&'a Row>);

impl<'a> Samples<'a> {
    fn of(record: &'a Record, name: &str) -> Self {
        Self(record.rows.iter().filter(|row| row.name == name).collect())
    }

    /// Values of a counter over the samples that did not fail.
    fn all(&self, key: &str) -> Vec<f64> {
        let sound = self.0.iter().filter(|row| row.error.is_none());
        sound
            .filter_map(|row| row.counters.get(key).copied())
            .collect()
    }

    /// Clock times \[s\].
    fn wall(&self) -> Vec<f64> {
        let sound = self.0.iter().filter(|row| row.error.is_none());
        sound
            .filter_map(|row| Some(row.spent?.wall.as_secs_f64()))
            .collect()
    }

    /// CPU times \[s\].
    fn cpu(&self) -> Vec<f64> {
        let sound = self.0.iter().filter(|row| row.error.is_none());
        sound
            .filter_map(|row| Some(row.spent?.cpu.as_secs_f64()))
            .collect()
    }

    /// Median of a counter as text, or nothing.
    fn shown(&self, key: &str, show: impl Fn(f64) -> String) -> String {
        median(&self.all(key)).map_or_else(String::new, show)
    }

    /// Text in the place of a time.
    fn instead(&self) -> &'static str {
        if self.failure().is_some() {
            "failed"
        } else {
            "-"
        }
    }

    fn failure(&self) -> Option<&str> {
        self.0.iter().find_map(|row| row.error.as_deref())
    }
}

/// All tables of a session.
pub struct Report<'a> {
    session: &'a Session,
    record: &'a Record,
}

impl<'a> Report<'a> {
    /// A table over the rows of the record.
    #[must_use]
    pub fn new(session: &'a Session, record: &'a Record) -> Self {
        Self { session, record }
    }

    /// Whole steps alone, in a few lines, and what failed.
    #[must_use]
    pub fn short(&self) -> impl fmt::Display + '_ {
        Short(self)
    }

    /// Times of a scene: "moving-3d 118 on 1 thread, 150 on 2 (38 %)", the thread left out where there is one number of them.
    fn told(&self, of_scene: &[&Slot]) -> String {
        let times: Vec<String> = (of_scene.iter())
            .map(|slot| {
                let samples = self.samples(slot);
                let found = median(&samples.all("cpu_ns_per_particle_step"));
                let Some(cpu) = found else {
                    return samples.instead().to_owned();
                };
                let wall = median(&samples.all("wall_ns_per_particle_step"));
                let efficiency = wall.map_or_else(String::new, |wall| self.efficiency(slot, wall));
                let on = slot.work.on();
                match (slot.work.processors(), efficiency.as_str()) {
                    _ if of_scene.len() == 1 => ns(cpu),
                    (1, _) => format!("{} on 1 thread", ns(cpu)),
                    (_, "") => format!("{} on {on}", ns(cpu)),
                    (_, share) => format!("{} on {on} (efficiency {share})", ns(cpu)),
                }
            })
            .collect();
        format!("{} {}", of_scene[0].scene, times.join(", "))
    }

    fn samples(&self, slot: &Slot) -> Samples<'a> {
        Samples::of(self.record, &name(slot))
    }

    fn steps(&self) -> Vec<&'a Slot> {
        let slots = self.session.slots.iter();
        slots.filter(|slot| slot.stage.is_none()).collect()
    }

    /// Time on one thread over time on n threads, of all ranks, and n, in percent, where one thread was measured too.
    fn efficiency(&self, slot: &Slot, wall: f64) -> String {
        let one = self.session.slots.iter().find(|other| {
            other.work.name == slot.work.name
                && other.work.processors() == 1
                && slot.work.processors() > 1
        });
        one.and_then(|one| median(&self.samples(one).all("wall_ns_per_particle_step")))
            .map_or_else(String::new, |one| {
                format!(
                    "{:.0} %",
                    100.0 * one / wall / slot.work.processors() as f64
                )
            })
    }

    /// Cells of a failed slot: the reason is told below the table.
    fn times(&self, f: &mut fmt::Formatter<'_>, slots: &[&Slot], title: &str) -> fmt::Result {
        if slots.is_empty() {
            return Ok(());
        }
        writeln!(f, "{title}")?;
        let stages = slots[0].stage.is_some();
        let what = if stages { "stage" } else { "method" };
        let mut table = Table::new([
            "scene",
            "particles",
            what,
            "threads",
            "wall ns",
            "CPU ns",
            "spread",
            "million/s",
            "efficiency",
        ]);
        for slot in slots {
            let samples = self.samples(slot);
            let method = match slot.stage {
                Some(stage)
                    if slot.method[1] == "USL" || slots.iter().all(|s| s.method == slot.method) =>
                {
                    stage.to_owned()
                }
                Some(stage) => format!("{stage} {}", slot.method.join(" ")),
                None => slot.method.join(" "),
            };
            let wall = samples.all("wall_ns_per_particle_step");
            let mut line = vec![
                slot.scene.clone(),
                samples.shown("particles", |n| grouped(n as u64)),
                method,
                slot.work.on(),
            ];
            if let Some(wall) = Summary::of(&wall) {
                line.extend([
                    ns(wall.median),
                    samples.shown("cpu_ns_per_particle_step", ns),
                    format!("{:.0} %", 100.0 * wall.spread()),
                    samples.shown("particle_steps_per_second", |rate| {
                        format!("{:.2}", rate * 1e-6)
                    }),
                    self.efficiency(slot, wall.median),
                ]);
            } else {
                line.push(samples.instead().to_owned());
            }
            table.push(line);
        }
        writeln!(f, "{table}")
    }

    fn phases(&self, f: &mut fmt::Formatter<'_>, slots: &[&Slot]) -> fmt::Result {
        if slots.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "wall ns per particle and step in each phase (p2g_solve: one visit of the nodes; threads: grid contact, too)\n"
        )?;
        let heads = ["scene", "particles", "method", "threads"];
        let mut table = Table::new(heads.into_iter().chain(Phase::ALL.map(Phase::name)));
        for slot in slots {
            let samples = self.samples(slot);
            let mut line = vec![
                slot.scene.clone(),
                samples.shown("particles", |n| grouped(n as u64)),
                slot.method.join(" "),
                slot.work.on(),
            ];
            line.extend(Phase::ALL.map(|phase| samples.shown(&format!("ns_{}", phase.name()), ns)));
            table.push(line);
        }
        writeln!(f, "{table}")
    }

    fn machine(&self, f: &mut fmt::Formatter<'_>, slots: &[&Slot]) -> fmt::Result {
        if slots.is_empty() {
            return Ok(());
        }
        writeln!(f, "memory, and share of the measured peak of the machine\n")?;
        let mut table = Table::new([
            "scene",
            "particles",
            "method",
            "threads",
            "per particle",
            "nodes",
            "peak",
            "bandwidth",
            "arithmetic",
        ]);
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        for slot in slots {
            let samples = self.samples(slot);
            table.push([
                slot.scene.clone(),
                samples.shown("particles", |n| grouped(n as u64)),
                slot.method.join(" "),
                slot.work.on(),
                samples.shown("bytes_per_particle", |n| format!("{n} B")),
                samples.shown("node_bytes", |n| bytes(n as u64)),
                samples.shown("peak_rss_bytes", |n| bytes(n as u64)),
                samples.shown("share_of_bandwidth", percent),
                samples.shown("share_of_arithmetic", percent),
            ]);
        }
        writeln!(f, "{table}")?;
        for Peaks {
            threads,
            bandwidth,
            arithmetic,
        } in &self.session.peaks
        {
            writeln!(
                f,
                "  {threads} thread{}: triad {:.1} GB/s, multiply-adds {:.1} GFLOP/s",
                if *threads == 1 { "" } else { "s" },
                bandwidth * 1e-9,
                arithmetic * 1e-9
            )?;
        }
        writeln!(
            f,
            "  Shares count 2000 operations and 250 bytes per particle and step, the least for 3D, 27 nodes, USL\n  \
             and FLIP; elsewhere they are left out. The peak is the largest resident size of the process while\n  \
             the scene was set up and run.\n"
        )
    }

    fn children(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let children = &self.session.children;
        if children.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "executables: whole processes, set-up and output included\n"
        )?;
        let mut table = Table::new([
            "scene",
            "executable",
            "particles",
            "threads",
            "wall",
            "CPU",
            "spread",
            "peak",
            "error",
            "difference",
        ]);
        for child in children {
            let samples = Samples::of(self.record, &child.name());
            table.push(child_line(child, &samples));
        }
        writeln!(f, "{table}")?;
        let exact: BTreeSet<String> = children
            .iter()
            .filter_map(|child| Some((&child.job.scene, child.job.exact_source()?)))
            .map(|(scene, source)| format!("{scene} against {source}"))
            .collect();
        if !exact.is_empty() {
            let list: Vec<String> = exact.into_iter().collect();
            writeln!(
                f,
                "  error: of the displacement of the last frame, relative L2; {}",
                list.join("; ")
            )?;
        }
        writeln!(
            f,
            "  difference: the same against this proctor's last frame, particle by particle"
        )?;
        let refused: BTreeSet<String> = self
            .record
            .rows
            .iter()
            .filter_map(|row| {
                let label = |key: &str| row.labels.get(key);
                let (name, scene) = (label("executable")?, label("scene")?);
                Some(format!("{name}, {scene}: {}", label(REFUSED)?))
            })
            .collect();
        for line in refused {
            writeln!(f, "  no difference for {line}")?;
        }
        writeln!(f)
    }

    fn failures(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let failed: Vec<&Row> = self
            .record
            .rows
            .iter()
            .filter(|row| row.error.is_some())
            .collect();
        for row in &failed {
            writeln!(
                f,
                "FAIL  {}: {}",
                row.name,
                row.error.as_deref().unwrap_or_default()
            )?;
        }
        if failed.is_empty() {
            Ok(())
        } else {
            writeln!(f)
        }
    }
}

fn child_line(child: &Child, samples: &Samples<'_>) -> Vec<String> {
    let wall = samples.wall();
    let mut line = vec![
        child.job.scene.clone(),
        child.executable.name.clone(),
        samples.shown("particles", |n| grouped(n as u64)),
        child.threads.to_string(),
    ];
    if let Some(wall) = Summary::of(&wall) {
        line.extend([
            seconds(wall.median),
            median(&samples.cpu()).map_or_else(String::new, seconds),
            format!("{:.0} %", 100.0 * wall.spread()),
            samples.shown("peak_rss_bytes", |n| bytes(n as u64)),
            samples.shown("error_l2_displacement", number),
            samples.shown("difference_l2_displacement", number),
        ]);
    } else {
        line.push(samples.instead().to_owned());
    }
    line
}

/// Nanoseconds with about three digits.
fn ns(x: f64) -> String {
    let decimals = usize::from(x < 99.95) + usize::from(x < 9.995);
    format!("{x:.decimals$}")
}

/// Width of lines of words.
const WIDTH: usize = 120;

/// Summary of a report.
struct Short<'a>(&'a Report<'a>);

impl fmt::Display for Short<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let steps = self.0.steps();
        let scenes: Vec<String> = (steps.chunk_by(|a, b| a.work.name == b.work.name))
            .map(|of_scene| self.0.told(of_scene))
            .collect();
        let counts = (steps.iter()).flat_map(|slot| self.0.samples(slot).all("particles"));
        let counts: BTreeSet<u64> = counts.map(|n| n as u64).collect();
        let counts = match (counts.first(), counts.last()) {
            (Some(&least), Some(&most)) if least < most => {
                format!("{} to {} particles: ", grouped(least), grouped(most))
            }
            (Some(&one), _) => format!("{} particles: ", grouped(one)),
            _ => String::new(),
        };
        // A scene and its times are not parted.
        let mut words = scenes.join(",\n");
        words.insert_str(0, &counts);
        let lines = filled(words.split('\n'), WIDTH);
        writeln!(f, "  {}", lines.join("\n    "))?;
        self.0.failures(f)
    }
}

/// Heading above whole steps.
const STEPS: &str = "whole steps: ns per particle and step, less is better; median";

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let steps = self.steps();
        let stages: Vec<&Slot> = self
            .session
            .slots
            .iter()
            .filter(|s| s.stage.is_some())
            .collect();
        self.times(f, &steps, STEPS)?;
        self.phases(f, &steps)?;
        self.machine(f, &steps)?;
        self.times(
            f,
            &stages,
            "single stages: ns per particle and play, median",
        )?;
        self.children(f)?;
        self.failures(f)
    }
}
