//! `proctor verify mill`: manufactured solutions of random motions and laws.

mod file;
mod table;

use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::side_by_side::processors;
use proctor_files::output::atomic;
use proctor_verification::mill::expected::Gate;
use proctor_verification::mill::ladder::{Errors, Faults};
use proctor_verification::mill::problem::Problem;
use proctor_verification::mill::{self, Answer};
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Instant;
use table::Table;

/// Name of the mill among the cases.
pub const NAME: &str = "mill";
/// Problems of a run that asks for no number: some seconds.
pub const COUNT: u64 = 30;

/// The choices of the user.
pub struct Mill<'a> {
    /// Number of problems.
    pub count: u64,
    /// Number of the first of them.
    pub first: u64,
    /// Seed of all of them.
    pub seed: u64,
    /// One problem from a file instead.
    pub problem: Option<&'a Path>,
    /// Threads, each with a problem of its own.
    pub threads: Option<usize>,
    /// Folder for problems that miss a gate.
    pub folder: &'a Path,
    /// Problems that hold are written there, too.
    pub keep: bool,
    /// File of the result as JSON.
    pub json: Option<&'a Path>,
    /// A table beside the verdict.
    pub table: bool,
}

/// A problem that was judged, or the reasons for which all draws of its number were refused.
type ProblemAnswer = (u64, Result<Answer, Vec<String>>);

impl Mill<'_> {
    /// Runs them.
    ///
    /// # Errors
    /// If a file cannot be read or written.
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if let Some(path) = self.json {
            write(path, &json!({}))?;
        }
        let begun = Instant::now();
        let interrupt = Interrupt::listen()?;
        let mut answers = match self.problem {
            Some(path) => vec![(0, Ok(of_file(path)?))],
            None => self.answers(&interrupt),
        };
        // In order of the problems, whichever thread was the first to finish.
        answers.sort_by_key(|(number, _)| *number);
        let mut table = Table::default();
        let (mut misses, mut refused, mut rows) = (0, 0, vec![]);
        for (number, answer) in &answers {
            let draws = match answer {
                Ok(answer) => &answer.refused,
                Err(reasons) => reasons,
            };
            refused += draws.len();
            let Ok(answer) = answer else {
                writeln!(
                    out,
                    "- {number}: no draw has a solution; the last {}",
                    draws[draws.len() - 1]
                )?;
                rows.push(json!({ "number": number, "refused": draws }));
                continue;
            };
            table.add(answer);
            let mut row = row(answer);
            if answer.misses() {
                misses += 1;
                let path = self.keep(&answer.problem)?;
                told(answer, &path, out)?;
                row["problem"] = json!(path.display().to_string());
            } else if self.keep {
                let path = self.keep(&answer.problem)?;
                row["problem"] = json!(path.display().to_string());
            }
            rows.push(row);
        }
        if self.table {
            table.write(out)?;
        }
        let groups = table.failed();
        for group in &groups {
            writeln!(out, "✗ {group}")?;
        }
        let failed = misses > 0 || !groups.is_empty();
        let word = match (failed, interrupt.raised()) {
            (true, _) => "FAIL",
            (false, true) => "INCOMPLETE",
            (false, false) => "PASS",
        };
        writeln!(
            out,
            "{word}: {misses} of {} manufactured problems miss a gate, {refused} draws refused, seed {}, {:.1} s",
            answers.len(),
            self.seed,
            begun.elapsed().as_secs_f64()
        )?;
        if let Some(path) = self.json {
            let all = json!({
                "seed": self.seed, "first": self.first, "asked": self.count, "misses": misses, "refused": refused,
                "methods": table.json(), "problems": rows,
            });
            write(path, &all)?;
            writeln!(out, "result in {}", path.display())?;
        }
        Ok(if interrupt.raised() {
            interrupt.outcome()
        } else if failed {
            Outcome::Failed
        } else {
            Outcome::Fine
        })
    }

    /// Answers of all numbers, as they come.
    fn answers(&self, interrupt: &Interrupt) -> Vec<ProblemAnswer> {
        let mut progress = Progress::new("manufactured problems");
        let threads = self.threads.unwrap_or_else(processors);
        let next = AtomicU64::new(self.first);
        let end = self.first.saturating_add(self.count);
        let (sender, receiver) = mpsc::channel::<ProblemAnswer>();
        let mut all = vec![];
        thread::scope(|scope| {
            for _ in 0..threads {
                let (sender, next) = (sender.clone(), &next);
                scope.spawn(move || {
                    while !interrupt.raised() {
                        let number = next.fetch_add(1, Ordering::Relaxed);
                        if number >= end {
                            return;
                        }
                        if sender
                            .send((number, mill::answer(self.seed, number)))
                            .is_err()
                        {
                            return;
                        }
                    }
                });
            }
            drop(sender);
            for answer in receiver {
                all.push(answer);
                progress.at(all.len() as f64 / self.count as f64);
            }
        });
        all
    }

    /// Writes a problem into the folder of those that miss a gate.
    fn keep(&self, problem: &Problem) -> Result<PathBuf, Failure> {
        let folder = self.folder;
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::BadInput(format!("{}: {e}", folder.display())))?;
        let path = folder.join(format!("{}.json", problem.name));
        write(&path, &file::write(problem))?;
        Ok(path)
    }
}

/// The problem of a file, judged.
fn of_file(path: &Path) -> Result<Answer, Failure> {
    let problem = file::read(path)?;
    let judged = mill::judge(&problem, &Faults::default());
    let (found, gates) =
        judged.map_err(|reason| Failure::BadInput(format!("{}: {reason}", path.display())))?;
    Ok(Answer {
        number: 0,
        problem,
        found,
        gates,
        refused: vec![],
    })
}

fn write(path: &Path, value: &Value) -> Result<(), Failure> {
    let text = format!("{value:#}\n");
    atomic::write(path, |file| file.write_all(text.as_bytes())).map_err(Failure::bad_input)
}

/// A problem in the result.
fn row(answer: &Answer) -> Value {
    let problem = &answer.problem;
    let errors = |errors: &Errors| {
        json!({
            "displacement": errors.displacement, "stress": errors.stress,
            "variable": errors.variable,
        })
    };
    let gate = |gate: &Gate| {
        json!({
            "what": gate.what, "value": gate.value, "bound": gate.bound,
            "least": gate.at_least, "holds": gate.holds(),
        })
    };
    let mut row = json!({
        "number": answer.number, "family": problem.family.word(), "axes": problem.axes(),
        "law": problem.material.kind.word(), "method": problem.method.to_string(),
        "cells": problem.ladder, "refused": answer.refused,
        "gates": answer.gates.iter().map(gate).collect::<Vec<_>>(),
    });
    match &answer.found {
        Ok(found) => row["errors"] = found.iter().map(errors).collect(),
        Err(reason) => row["failed"] = json!(reason),
    }
    row
}

/// A line for a problem that misses a gate: what, how far, and the file.
fn told(answer: &Answer, path: &Path, out: &mut dyn Write) -> std::io::Result<()> {
    let problem = &answer.problem;
    write!(
        out,
        "✗ {}: {}, {}D, {}, {}:",
        answer.number,
        problem.family.word(),
        problem.axes(),
        problem.material.kind.word(),
        problem.method
    )?;
    match &answer.found {
        Err(reason) => write!(out, " {reason}")?,
        Ok(_) => {
            for gate in answer.gates.iter().filter(|gate| !gate.holds()) {
                let (what, value, bound) = (gate.what, gate.value, gate.bound);
                if gate.at_least {
                    write!(out, " {what} {value:.2}, at least {bound};")?;
                } else {
                    write!(out, " {what} {value:.2e}, at most {bound:.2e};")?;
                }
            }
        }
    }
    writeln!(out, " proctor verify mill --problem {}", path.display())
}
