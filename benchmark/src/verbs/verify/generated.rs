//! `proctor verify --generated`: scenes made of random choices, judged by what holds of every scene.

use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::side_by_side::processors;
use proctor_files::json;
use proctor_files::output::atomic;
use proctor_scene::{Field, Scene};
use proctor_verification::generated::{self, Answer, QUESTIONS};
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;
use std::thread;

/// The choices of the user.
pub struct GeneratedChoices<'a> {
    /// Number of scenes.
    pub count: u64,
    /// Seed of all of them.
    pub seed: u64,
    /// Threads, each with a scene of its own.
    pub threads: Option<usize>,
    /// Folder for scenes that violate their property.
    pub folder: &'a Path,
    /// File of the result as JSON.
    pub json: Option<&'a Path>,
    /// A table beside the verdict.
    pub table: bool,
}

/// Results of a question so far.
#[derive(Clone, Default)]
struct Tally {
    scenes: u64,
    violations: u64,
    /// Scenes beyond their bounds of which the plan warns.
    foreseen: u64,
    /// The largest share of a bound, with its distance, the bound and the scene.
    worst: Option<(f64, String, f64, f64, u64)>,
}

impl GeneratedChoices<'_> {
    /// Runs them.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if let Some(path) = self.json {
            write(path, &json!({}))?;
        }
        let interrupt = Interrupt::listen()?;
        let mut tallies = vec![Tally::default(); QUESTIONS.len()];
        let mut violations: Vec<Value> = vec![];
        let mut done = 0;
        let mut progress = Progress::new("generated scenes");
        let threads = self.threads.unwrap_or_else(processors);
        let next = AtomicU64::new(0);
        let (sender, answers) = mpsc::channel::<Answer>();
        thread::scope(|scope| -> Result<(), Failure> {
            for _ in 0..threads {
                let (sender, next, interrupt) = (sender.clone(), &next, &interrupt);
                scope.spawn(move || {
                    while !interrupt.raised() {
                        let number = next.fetch_add(1, Ordering::Relaxed);
                        if number >= self.count {
                            return;
                        }
                        if sender.send(generated::answer(self.seed, number)).is_err() {
                            return;
                        }
                    }
                });
            }
            drop(sender);
            for answer in answers {
                done += 1;
                progress.at(f64::from(done) / self.count as f64);
                tally(&mut tallies, &answer);
                if answer.violates() {
                    violations.push(self.violation(&answer)?);
                }
            }
            Ok(())
        })?;
        drop(progress);
        // In order of the scenes, whichever thread was the first to finish.
        violations.sort_by_key(|violation| violation["number"].as_u64());
        for violation in &violations {
            told(violation, out)?;
        }
        if self.table {
            table(&tallies, out)?;
        }
        let count = violations.len();
        writeln!(
            out,
            "{}: {count} violations in {done} generated scenes, seed {}",
            if count > 0 {
                "FAIL"
            } else if interrupt.raised() {
                "INCOMPLETE"
            } else {
                "PASS"
            },
            self.seed
        )?;
        if let Some(path) = self.json {
            let rows = QUESTIONS
                .iter()
                .zip(&tallies)
                .map(|(question, tally)| row(question, tally));
            let all = json!({
                "seed": self.seed, "scenes": done, "asked": self.count,
                "questions": rows.collect::<Vec<_>>(), "violations": violations,
            });
            write(path, &all)?;
            writeln!(out, "result in {}", path.display())?;
        }
        Ok(if interrupt.raised() {
            interrupt.outcome()
        } else if count > 0 {
            Outcome::Failed
        } else {
            Outcome::Fine
        })
    }

    /// A violation, with its scene in a file.
    fn violation(&self, answer: &Answer) -> Result<Value, Failure> {
        let (what, value, bound) = match (&answer.found, answer.worst()) {
            (Ok(_), Some(worst)) => (worst.what.clone(), Some(worst.value), Some(worst.bound)),
            (Ok(_), None) => ("nothing was compared".to_owned(), None, None),
            (Err(error), _) => (error.clone(), None, None),
        };
        let file = scene_file(self.folder, &answer.scene)?;
        let cause = generated::cause(self.seed, answer);
        Ok(json!({
            "question": answer.question.name, "holds": answer.question.holds, "number": answer.number,
            "what": what, "value": value, "bound": bound, "scene": file.ok().map(|p| p.display().to_string()),
            "holds_with": cause,
        }))
    }
}

/// Writes the scene of a violation: its path, or why the scene cannot be written.
fn scene_file(folder: &Path, scene: &Scene) -> Result<Result<PathBuf, String>, Failure> {
    let mut shown = scene.clone();
    // One interval, so that steps are those of the comparison.
    shown.results.print = 1;
    shown.results.fields = vec![
        Field::Id,
        Field::Body,
        Field::Displacement,
        Field::Velocity,
        Field::Stress,
    ];
    let written = match json::write_own(&shown) {
        Ok(written) => written,
        Err(error) => return Ok(Err(error.to_string())),
    };
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::BadInput(format!("{}: {e}", folder.display())))?;
    let path = folder.join(format!("{}.json", scene.name));
    write(&path, &written.scene)?;
    for (name, text) in &written.files {
        std::fs::write(folder.join(name), text)
            .map_err(|e| Failure::BadInput(format!("{name}: {e}")))?;
    }
    Ok(Ok(path))
}

fn write(path: &Path, value: &Value) -> Result<(), Failure> {
    let text = format!("{value:#}\n");
    atomic::write(path, |file| file.write_all(text.as_bytes())).map_err(Failure::bad_input)
}

fn tally(tallies: &mut [Tally], answer: &Answer) {
    let Some(index) = QUESTIONS
        .iter()
        .position(|q| q.name == answer.question.name)
    else {
        return;
    };
    let tally = &mut tallies[index];
    tally.scenes += 1;
    tally.violations += u64::from(answer.violates());
    tally.foreseen += u64::from(answer.deviates() && answer.foreseen);
    if let Some(worst) = answer.worst() {
        let share = worst.share();
        if tally.worst.as_ref().is_none_or(|known| share > known.0) {
            let what = worst.what.clone();
            tally.worst = Some((share, what, worst.value, worst.bound, answer.number));
        }
    }
}

fn row(question: &generated::Question, tally: &Tally) -> Value {
    let mut row = json!({
        "question": question.name, "holds": question.holds, "because": question.because,
        "scenes": tally.scenes, "violations": tally.violations, "foreseen": tally.foreseen,
    });
    if let Some((_, what, value, bound, number)) = &tally.worst {
        row["largest"] = json!({ "what": what, "value": value, "bound": bound, "number": number });
    }
    row
}

/// A line for each violation: what, how far, and the scene.
fn told(found: &Value, out: &mut dyn Write) -> std::io::Result<()> {
    let text = |key: &str| found[key].as_str().unwrap_or_default().to_owned();
    write!(
        out,
        "✗ {} {}: {}",
        text("question"),
        found["number"],
        text("what")
    )?;
    if let (Some(value), Some(bound)) = (found["value"].as_f64(), found["bound"].as_f64()) {
        write!(out, " {value:.3e}, bound {bound:.3e}")?;
    }
    if let Some(cause) = found["holds_with"].as_str() {
        write!(out, "; holds with {cause}")?;
    }
    match found["scene"].as_str() {
        Some(path) => writeln!(out, "; scene in {path}")?,
        None => writeln!(
            out,
            "; the language of scenes has no word for something in it"
        )?,
    }
    Ok(())
}

/// A line for each question.
fn table(tallies: &[Tally], out: &mut dyn Write) -> std::io::Result<()> {
    writeln!(
        out,
        "{:<10} {:>7} {:>11} {:>9} {:>10} {:>10}  of what",
        "question", "scenes", "violations", "foreseen", "largest", "bound"
    )?;
    for (question, tally) in QUESTIONS.iter().zip(tallies) {
        write!(
            out,
            "{:<10} {:>7} {:>11} {:>9}",
            question.name, tally.scenes, tally.violations, tally.foreseen
        )?;
        match &tally.worst {
            Some((_, what, value, bound, number)) => {
                writeln!(
                    out,
                    " {value:>10.2e} {bound:>10.2e}  {what} (scene {number})"
                )?;
            }
            None => writeln!(out)?,
        }
    }
    Ok(())
}
