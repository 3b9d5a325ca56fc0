//! A study as rows of a record, and as a table of comma-separated values.

use super::choices::Choice;
use super::findings::{Findings, LEVELS};
use super::peers::{PeerLine, PeerRun};
use super::run::{CaseStudy, Run, STRESS, Sample, minimum_and_median};
use crate::record::{LADDER, Record, Row, key};
use proctor_verification::settings::Method;
use proctor_verification::study::Study;

/// Name of the rows of a line.
fn line_name(case: &str, method: Method) -> String {
    format!(
        "precision/{case}/{}-{}-{}",
        method.weighting_word(),
        method.scheme_word(),
        method.transfer_word()
    )
}

/// Name of the rows of a choice: the same choice is the same name in every record.
fn name(case: &str, choice: &Choice) -> String {
    let line = line_name(case, choice.settings.method);
    format!("{line}/h={:.4e}/{}", choice.rung.cell, numbers(choice))
}

/// Name of the runs that differ in resolution alone.
fn ladder(case: &str, choice: &Choice) -> String {
    let line = line_name(case, choice.settings.method);
    format!("{line}/{}", numbers(choice))
}

fn numbers(choice: &Choice) -> String {
    let settings = &choice.settings;
    format!(
        "C={:.4}/ppc={}",
        settings.courant_or_automatic(),
        settings.particles_per_cell
    )
}

/// Labels and numbers of the settings.
fn describe(row: &mut Row, case: &str, method: Method) {
    row.label("case", case);
    row.label("weighting", method.weighting_word());
    row.label("scheme", method.scheme_word());
    row.label("transfer", method.transfer_word());
    let safe = if method.has_safe_step() { "yes" } else { "no" };
    row.label("has_safe_step", safe);
}

impl Record {
    /// Adds a row per repetition of a study, and one per line and measure for what it costs.
    pub fn push_study(&mut self, studied: &CaseStudy, threads: usize) {
        let case = studied.study.name();
        for (choice, run) in studied.plan.choices.iter().zip(&studied.runs) {
            if run.samples.is_empty() {
                self.push(blank_row(studied, choice, run, 0, threads));
            }
            for (repetition, sample) in run.samples.iter().enumerate() {
                let blank = blank_row(studied, choice, run, repetition, threads);
                self.push(sample_row(blank, run, sample));
            }
        }
        for (number, measure) in studied.study.measures().iter().enumerate() {
            for line in &Findings::new(studied, number).lines {
                let name = line_name(case, line.method);
                let mut row = Row::aggregate(name, &format!("cost_{}", measure.word), threads);
                describe(&mut row, case, line.method);
                for (level, cost) in LEVELS.iter().zip(line.costs) {
                    if let Some(seconds) = cost.seconds() {
                        row.count(format!("seconds_for_error_{level}"), seconds);
                    }
                }
                if let Some(order) = line.order() {
                    row.count("observed_order", order);
                }
                if let Some(best) = line.best {
                    row.count("smallest_error", best.error);
                } else {
                    row.fail("no run of this line gave an error below 1");
                }
                self.push(row);
            }
        }
        for peer in &studied.peers {
            for run in &peer.runs {
                for row in peer_rows(studied.study, peer, run, threads) {
                    self.push(row);
                }
            }
        }
        self.details.push_study(studied);
    }
}

/// A repetition with its times.
fn sample_row(blank: Row, run: &Run, sample: &Sample) -> Row {
    let mut row = blank.timed(sample.stepping);
    row.count("seconds_set_up", sample.set_up.wall.as_secs_f64());
    row.count("seconds_comparing", sample.comparing.wall.as_secs_f64());
    if let Ok(found) = &run.found {
        let rate = found.particles as f64 * found.steps as f64 / sample.stepping.wall.as_secs_f64();
        row.count("particle_steps_per_second", rate);
    }
    row
}

/// Row of a repetition without its times.
fn blank_row(
    studied: &CaseStudy,
    choice: &Choice,
    run: &Run,
    repetition: usize,
    threads: usize,
) -> Row {
    let case = studied.study.name();
    let mut row = Row::sample(name(case, choice), repetition as u64, threads);
    describe(&mut row, case, choice.settings.method);
    row.label(LADDER, ladder(case, choice));
    row.count("cell_size", choice.rung.cell);
    row.count("courant", choice.settings.courant_or_automatic());
    row.count(
        "particles_per_cell",
        choice.settings.particles_per_cell as f64,
    );
    if let Ok(found) = &run.found {
        row.count("particles", found.particles as f64);
        row.count("steps", found.steps as f64);
        row.count("dt", found.dt);
        row.count("dt_over_critical", found.dt_over_critical);
        for (measure, error) in studied.study.measures().iter().zip(&found.errors) {
            row.count(format!("error_{}", measure.word), *error);
        }
    }
    if let Err(reason) = run.error(0) {
        row.fail(reason);
    }
    row
}

/// A run of another solver in the columns of [`csv`]; it has a process and no settings.
fn peer_values(
    studied: &CaseStudy,
    measure: usize,
    peer: &PeerLine,
    run: &PeerRun,
) -> [String; 21] {
    let measure = studied.study.measures().get(measure).map(|m| m.word);
    let mut values: [String; 21] = Default::default();
    studied.study.name().clone_into(&mut values[0]);
    values[1] = peer.method.clone().unwrap_or_default();
    values[5] = format!("{:e}", run.rung.cell);
    values[8] = run.particles.map_or_else(String::new, |n| n.to_string());
    measure.unwrap_or_default().clone_into(&mut values[12]);
    match &run.error {
        Ok(error) => values[13] = format!("{error:e}"),
        Err(reason) => values[19].clone_from(reason),
    }
    for (at, time) in [
        (14, minimum_and_median(run.samples.iter().map(|s| s.wall))),
        (16, minimum_and_median(run.samples.iter().map(|s| s.cpu))),
    ] {
        if let Some([least, middle]) = time {
            values[at] = format!("{least:e}");
            values[at + 1] = format!("{middle:e}");
        }
    }
    values[18] = run.samples.len().to_string();
    values[20].clone_from(&peer.name);
    values
}

/// A row per repetition of a run of another solver; one for a run that failed before it was timed.
pub(crate) fn peer_rows(study: Study, peer: &PeerLine, run: &PeerRun, threads: usize) -> Vec<Row> {
    let case = study.name();
    let line = format!("precision/{case}/peer/{}", key(&peer.name));
    let name = format!("{line}/h={:.4e}", run.rung.cell);
    let blank = |repetition: usize| {
        let mut row = Row::sample(name.clone(), repetition as u64, threads);
        row.label("case", case);
        row.label("executable", peer.name.clone());
        row.label("stage", "process");
        row.label(LADDER, line.clone());
        row.count("cell_size", run.rung.cell);
        if let Some(particles) = run.particles {
            row.count("particles", particles as f64);
        }
        match (&run.error, study.measures().first(), &run.reported) {
            (Ok(_), Some(measure), Some(reported)) => row.report(measure.word, reported),
            (Ok(error), Some(measure), None) => {
                row.count(format!("error_{}", measure.word), *error);
                if let Some(error) = run.stress {
                    row.count(format!("error_{STRESS}"), error);
                }
            }
            (Ok(_), None, _) => {}
            (Err(reason), _, _) => row.fail(reason.clone()),
        }
        row
    };
    if run.samples.is_empty() {
        return vec![blank(0)];
    }
    let samples = run.samples.iter().enumerate();
    samples
        .map(|(repetition, spent)| blank(repetition).timed(*spent))
        .collect()
}

/// A study as comma-separated values, one line per choice; `heading` for the first study of a file.
///
/// # Errors
/// If `out` cannot be written.
pub fn csv(studied: &CaseStudy, heading: bool, out: &mut dyn std::io::Write) -> csv::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    if heading {
        table.write_record([
            "case",
            "weighting",
            "scheme",
            "transfer",
            "has_safe_step",
            "cell_size_m",
            "courant",
            "particles_per_cell",
            "particles",
            "steps",
            "dt_s",
            "dt_over_critical",
            "measure",
            "error",
            "wall_min_s",
            "wall_median_s",
            "cpu_min_s",
            "cpu_median_s",
            "repetitions",
            "failure",
            "executable",
        ])?;
    }
    for (choice, run) in studied.plan.choices.iter().zip(&studied.runs) {
        for (number, measure) in studied.study.measures().iter().enumerate() {
            let method = choice.settings.method;
            let found = run.found.as_ref().ok();
            let wall = run.minimum_and_median(|s| s.stepping.wall);
            let cpu = run.minimum_and_median(|s| s.stepping.cpu);
            let number_or_empty = |value: Option<f64>| match value {
                Some(value) if value.is_finite() => format!("{value:e}"),
                _ => String::new(),
            };
            table.write_record([
                studied.study.name().to_owned(),
                method.weighting_word().to_owned(),
                method.scheme_word().to_owned(),
                method.transfer_word().to_owned(),
                method.has_safe_step().to_string(),
                format!("{:e}", choice.rung.cell),
                number_or_empty(Some(choice.settings.courant_or_automatic())),
                choice.settings.particles_per_cell.to_string(),
                found.map_or_else(String::new, |f| f.particles.to_string()),
                found.map_or_else(String::new, |f| f.steps.to_string()),
                number_or_empty(found.map(|f| f.dt)),
                number_or_empty(found.map(|f| f.dt_over_critical)),
                measure.word.to_owned(),
                number_or_empty(found.map(|f| f.errors[number])),
                number_or_empty(wall.map(|w| w[0])),
                number_or_empty(wall.map(|w| w[1])),
                number_or_empty(cpu.map(|c| c[0])),
                number_or_empty(cpu.map(|c| c[1])),
                run.samples.len().to_string(),
                run.error(number).err().unwrap_or_default(),
                String::new(),
            ])?;
        }
    }
    for measure in 0..studied.study.measures().len() {
        for peer in studied.peers_of(measure) {
            for run in &peer.runs {
                table.write_record(peer_values(studied, measure, &peer, run))?;
            }
        }
    }
    table.flush()?;
    Ok(())
}
