//! The report that a run prints at its end.

use crate::measure::{self, Spent};
use crate::show::{columns, filled, grouped, number, seconds};
use proctor_files::output::Summary;
use proctor_files::output::checkpoint::CHECKPOINT;
use proctor_files::output::history::HISTORY;
use proctor_files::output::pvd::LIST;
use proctor_files::output::summary::{OVERLAP, SUMMARY, Status, SummaryEnergy, VOLUME_RATIO};
use std::collections::BTreeMap;
use std::fmt::{self, Write as _};
use std::path::Path;
use std::time::Duration;

/// Events that are shown one by one; the summary file holds all.
const SHOWN_EVENTS: usize = 3;
/// Cells by which a vertex of mortar contact may be off its body before a person is told. A disc that was squeezed and has
/// settled with half more than its pressure is off by more (`kernel/tests/physics/mortar_drift.rs`), *rings* by less.
const FAR_OFF: f64 = 0.1;

/// Columns of the names of rows.
const BESIDE: usize = 16;

/// A short table of a run.
pub struct Report<'a> {
    pub summary: &'a Summary,
    /// Number of steps that each bound ruled.
    pub bounds: &'a BTreeMap<&'static str, u64>,
    /// Number of steps before the restart; zero without one.
    pub first_step: u64,
    pub folder: Option<&'a Path>,
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let s = self.summary;
        let status = match s.status {
            Status::Finished => "finished",
            Status::Failed => "failed",
            Status::Interrupted => "interrupted",
        };
        row(f, "scene", &format!("{}, {status}", s.scene))?;
        row(f, "particles", &grouped(s.particles))?;
        let mut steps = grouped(s.steps);
        if self.first_step > 0 {
            let before = grouped(self.first_step);
            write!(steps, ", {before} of them before the restart")?;
        }
        row(f, "steps", &steps)?;
        row(
            f,
            "time",
            &format!("{} s", s.time.map_or_else(String::new, number)),
        )?;
        if let Some(text) = self.time_step() {
            row(f, "time step", &text)?;
        }
        if let (Some(wall), Some(cpu)) = (s.wall_seconds, s.cpu_seconds) {
            let threads = match s.threads {
                1 => "1 thread".to_owned(),
                n => format!("{n} threads"),
            };
            let threads = match s.ranks {
                None => threads,
                Some(ranks) => format!("{ranks} ranks, each {threads}"),
            };
            let messages = s.message_seconds.filter(|_| wall > 0.0);
            let messages = messages.map_or_else(String::new, |messages| {
                format!(", messages {:.0} % of the first", 100.0 * messages / wall)
            });
            let text = format!(
                "{} wall, {} CPU ({threads}, {} lanes{messages})",
                seconds(wall),
                seconds(cpu),
                s.lanes
            );
            row(f, "stepping", &text)?;
        }
        if let Some(times) = self.busy() {
            let text = format!(
                "the machine was busy: {times:.1} times as long by the clock as on the processors"
            );
            row(f, "attention", &text)?;
        }
        if let Some(ns) = s.ns_per_particle_step {
            row(
                f,
                "cost",
                &format!("{ns:.0} ns of CPU per particle and step"),
            )?;
        }
        let e = &s.energy;
        for (name, value) in [
            ("kinetic energy", e.kinetic),
            ("strain energy", e.strain),
            ("contact energy", e.contact.filter(|stored| *stored != 0.0)),
            ("external work", e.external_work),
        ] {
            if let Some(value) = value {
                row(f, name, &format!("{} J", number(value)))?;
            }
        }
        if let Some(text) = dissipated(e) {
            row(f, "dissipated", &text)?;
        }
        row(f, "state hash", &format!("{:016x}", s.state_hash))?;
        if let Some(doubt) = &s.not_to_be_trusted {
            row(f, "attention", doubt)?;
        }
        for warning in &s.warnings {
            row(f, "attention", &warning.message)?;
        }
        if let Some(text) = self.far_off() {
            row(f, "attention", &text)?;
        }
        let alarms = |kind: &str| [VOLUME_RATIO, OVERLAP].contains(&kind);
        for alarm in s.events.iter().filter(|event| alarms(&event.kind)) {
            let time = alarm.time.map_or_else(String::new, number);
            let text = format!("step {}, {time} s: {}", alarm.step, alarm.message);
            row(f, "attention", &text)?;
        }
        if s.particles == 0 {
            row(f, "attention", "all particles have left the mesh")?;
        }
        let others = || s.events.iter().filter(|event| !alarms(&event.kind));
        for event in others().take(SHOWN_EVENTS) {
            let text = format!("step {}: {}", event.step, event.message);
            row(f, "event", &text)?;
        }
        if others().count() > SHOWN_EVENTS {
            let more = others().count() - SHOWN_EVENTS;
            row(f, "event", &format!("and {more} more"))?;
        }
        let Some(folder) = self.folder else {
            return row(f, "results", "nothing was written, as there was no --out");
        };
        row(f, "written", &written(folder))?;
        let checkpoint = folder.join(CHECKPOINT);
        if s.status == Status::Interrupted && checkpoint.is_file() {
            let text = format!(
                "--restart {}, from the last output on",
                checkpoint.display()
            );
            row(f, "to go on", &text)?;
        }
        Ok(())
    }
}

impl Report<'_> {
    /// Ratio of clock time to processor time, where it shows a busy machine.
    fn busy(&self) -> Option<f64> {
        let time = |seconds: Option<f64>| Duration::try_from_secs_f64(seconds?).ok();
        measure::busy([Spent {
            wall: time(self.summary.wall_seconds)?,
            cpu: time(self.summary.cpu_seconds)?,
        }])
    }

    /// The vertex of mortar contact that is farthest off its body, where that is far.
    fn far_off(&self) -> Option<String> {
        let drift = self.summary.boundary_drift?;
        let cells = drift.in_cells.filter(|cells| *cells > FAR_OFF)?;
        Some(format!(
            "vertex {} of the boundary of body {} is {} cells off the body, whose pressure may be another one there; \
             \"boundary_follows\": \"material\" keeps it on the body",
            drift.vertex,
            drift.body,
            number(cells)
        ))
    }

    /// The time steps taken and what decided most of them.
    fn time_step(&self) -> Option<String> {
        let (least, most) = (self.summary.dt_min?, self.summary.dt_max?);
        let range = if (most - least).abs() <= 1e-6 * most {
            format!("{} s", number(most))
        } else {
            format!("{} to {} s", number(least), number(most))
        };
        let all: u64 = self.bounds.values().sum();
        let ruled = self.bounds.iter().max_by_key(|(_, count)| **count);
        let ruled = ruled.map_or_else(String::new, |(words, count)| {
            let share = if *count == all { "" } else { "mostly " };
            format!(", {share}{words}")
        });
        let critical = self
            .summary
            .dt_critical
            .map_or_else(String::new, |critical| {
                format!("; bound of stability from {} s", number(critical))
            });
        Some(format!("{range}{ruled}{critical}"))
    }
}

/// Energy that is missing, by its destination: the channels that took some, and the rest that none of them accounts for.
fn dissipated(e: &SummaryEnergy) -> Option<String> {
    let mut text = format!("{} J", number(e.dissipated?));
    let channels = [
        ("damping", e.damping),
        ("friction", e.friction),
        ("impact", e.impact),
        ("plastic work", e.plastic),
        ("with removed particles", e.removed),
        ("through absorbing planes", e.absorbed),
    ];
    let took = |(name, value): (&str, Option<f64>)| {
        let value = value.filter(|value| *value != 0.0)?;
        Some(format!("{name} {}", number(value)))
    };
    let mut parts: Vec<String> = channels.into_iter().filter_map(took).collect();
    parts.extend(
        e.remainder
            .map(|rest| format!("remainder {}", number(rest))),
    );
    if !parts.is_empty() {
        text.push_str(": ");
        text.push_str(&parts.join(", "));
    }
    Some(text)
}

/// The folder, and what to look at in it.
fn written(folder: &Path) -> String {
    let mut files = vec![];
    if folder.join(LIST).is_file() {
        files.push(format!("{LIST} (its frames, for ParaView)"));
    }
    let others = [HISTORY, CHECKPOINT].into_iter();
    files.extend(
        others
            .filter(|name| folder.join(name).is_file())
            .map(str::to_owned),
    );
    files.push(SUMMARY.to_owned());
    format!("{}: {}", folder.display(), files.join(", "))
}

/// A row of a name and a text.
pub(in crate::verbs) fn row(f: &mut fmt::Formatter<'_>, name: &str, text: &str) -> fmt::Result {
    // A line that is too long goes on below its text.
    let mut heading = name;
    for line in filled(text.split(' '), columns() - BESIDE) {
        writeln!(f, "{heading:<15} {line}")?;
        heading = "";
    }
    Ok(())
}
