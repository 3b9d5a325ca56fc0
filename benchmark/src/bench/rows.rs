//! Samples as rows of a record.

use super::machine::Peaks;
use super::plan::Slot;
use super::sample::{Sample, Work};
use crate::record::Row;
use proctor_scene::simulation::Phase;

/// The name of a slot in a record, which tells it from all others.
pub(super) fn name(slot: &Slot) -> String {
    let Work {
        name,
        ranks,
        threads,
        ..
    } = &slot.work;
    if *ranks == 1 {
        format!("{name}/threads:{threads}")
    } else {
        format!("{name}/ranks:{ranks}/threads:{threads}")
    }
}

/// A row without results.
pub(super) fn blank(slot: &Slot, repetition: u64) -> Row {
    let mut row = Row::sample(name(slot), repetition, slot.work.processors());
    row.label("scene", slot.scene.clone());
    for (key, word) in ["shape_function", "stress_scheme_update", "transfer"]
        .into_iter()
        .zip(&slot.method)
    {
        row.label(key, word.clone());
    }
    row.label("stage", slot.stage.unwrap_or("step"));
    row
}

/// The row of a sample.
pub(super) fn row(slot: &Slot, repetition: u64, sample: &Sample, peaks: Option<&Peaks>) -> Row {
    let mut row = blank(slot, repetition).timed(sample.spent);
    let particle_steps = sample.particles as f64 * sample.steps as f64;
    let wall = sample.spent.wall.as_secs_f64();
    let rate = particle_steps / wall;
    row.label("lanes", sample.lanes.name());
    row.count("particles", sample.particles as f64);
    row.count("steps", sample.steps as f64);
    row.count("wall_ns_per_particle_step", wall * 1e9 / particle_steps);
    if let Some(cpu) = sample.spent.ns_per(particle_steps) {
        row.count("cpu_ns_per_particle_step", cpu);
    }
    row.count("particle_steps_per_second", rate);
    row.count("bytes_per_particle", sample.bytes_per_particle as f64);
    row.count("node_bytes", sample.node_bytes as f64);
    if let Some(peak) = sample.peak_rss {
        row.count("peak_rss_bytes", peak as f64);
    }
    for (phase, time) in Phase::ALL.iter().zip(sample.phases.iter().flatten()) {
        let ns = time.as_secs_f64() * 1e9 / particle_steps;
        row.count(format!("ns_{}", phase.name()), ns);
    }
    if let (None, Some(least), Some(peaks)) = (slot.stage, sample.least, peaks) {
        row.count("share_of_bandwidth", rate * least.bytes / peaks.bandwidth);
        row.count(
            "share_of_arithmetic",
            rate * least.operations / peaks.arithmetic,
        );
    }
    row
}

/// The row of the machine's peaks.
pub(super) fn peaks_row(peaks: &Peaks) -> Row {
    let name = format!("machine/threads:{}", peaks.threads);
    let mut row = Row::aggregate(name, "peaks", peaks.threads);
    row.count("triad_bytes_per_second", peaks.bandwidth);
    row.count("multiply_add_flops_per_second", peaks.arithmetic);
    row
}
