//! Rows of a record.

use super::run::{Job, JobResult, Outcome};
use crate::record::{Record, Row};
use proctor_verification::stability::measured::MeasuredLimit;

/// Name of its rows.
fn name(job: &Job) -> String {
    let method = job.method();
    let words = format!(
        "{}-{}-{}",
        method.weighting_word(),
        method.scheme_word(),
        method.transfer_word()
    );
    match job {
        Job::Entry(choice) => format!(
            "stability/map/{words}/{}D/ppc={}",
            choice.dimension.axes(),
            choice.particles_per_cell
        ),
        Job::Nonlinear(scene, ..) => format!("stability/{}/{words}", scene.name),
        Job::Round(choice) => format!("stability/axis/{words}/ppc={}", choice.particles_per_cell),
    }
}

fn measured(row: &mut Row, prefix: &str, measured: &MeasuredLimit) {
    // A side that was not found is left out and said in words.
    for (side, value) in [("stable", measured.stable), ("unstable", measured.unstable)] {
        match value {
            Some(value) => row.count(format!("value_{prefix}{side}"), value),
            None => row.label(format!("{prefix}{side}"), "none in the range"),
        }
    }
    if let Some(class) = measured.class {
        row.label(format!("{prefix}class"), class.words());
    }
    row.count(format!("runs_{prefix}measured"), measured.runs as f64);
}

impl Record {
    /// Adds a row for what was found, and one per gate.
    pub fn push_stability(&mut self, done: &JobResult) {
        let name = name(&done.job);
        let mut row = Row::sample(name, 0, 1).timed(done.spent);
        let method = done.job.method();
        row.label("weighting", method.weighting_word());
        row.label("scheme", method.scheme_word());
        row.label("transfer", method.transfer_word());
        match &done.outcome {
            Ok(Outcome::Entry(entry)) => {
                let choice = &entry.choice;
                row.count("particles_per_cell", choice.particles_per_cell as f64);
                row.count("axes", choice.dimension.axes() as f64);
                row.count("kernel_bound", entry.bound());
                row.count("kernel_step", entry.automatic());
                row.count("value_safe", entry.safe());
                for worst in &entry.forms {
                    let form = crate::record::key(&worst.place.form.words());
                    row.count(format!("value_predicted_{form}"), worst.courant);
                    row.count(format!("offset_{form}"), worst.place.offset);
                }
                for site in &entry.sites {
                    let prefix = match crate::record::key(site.word) {
                        key if key.is_empty() => key,
                        key => format!("{key}_"),
                    };
                    measured(&mut row, &prefix, &site.measured);
                }
            }
            Ok(Outcome::Nonlinear(limit)) => {
                row.count("kernel_step", limit.automatic);
                row.count("value_energy_over_reference", limit.energy);
                measured(&mut row, "over_kernel_", &limit.measured);
                if let Some(refusal) = &limit.refusal {
                    row.label("refusal", refusal);
                }
            }
            Ok(Outcome::Round(entry)) => {
                let per_cell = entry.choice.particles_per_cell;
                row.count("particles_per_cell", per_cell as f64);
                for of in &entry.rows {
                    let kind = of.place.form.kind();
                    row.label(format!("body_{kind}"), of.words());
                    row.count(format!("value_predicted_{kind}"), of.predicted);
                    row.count(format!("kernel_step_{kind}"), of.kernel);
                    measured(&mut row, &format!("{kind}_"), &of.measured);
                }
            }
            Err(error) => row.fail(error.to_string()),
        }
        self.push(row);
        for gate in &done.gates() {
            self.push_gate("stability", gate, 1);
        }
        self.details.push_stability(done);
    }
}
