//! `proctor judge`: frames of any solver against the exact solution of a case.

use super::names;
use crate::exit::{Failure, Outcome};
use crate::precision::bounds::Bound;
use crate::precision::problems::{self, FrameErrors};
use crate::record::key;
use crate::show::{arena as show, percent};
use clap::Args;
use proctor_verification::case::{Rung, Size};
use proctor_verification::study;
use std::io::Write;
use std::path::PathBuf;

/// Bound where none is given.
const BOUND: f64 = 0.01;

/// Judge frames that a solver left, without running it.
///
/// The frames are those of a problem that `proctor export --format problems DIR` has written: `.vtu` files with point data
/// `Displacement`, and `Velocity` where a case compares it, with a `.pvd` of their times; with `Stress_XX` to
/// `Stress_XY` some cases have a second error. Nothing is known of the solver: no
/// free fall says whether its times are those of its particles.
#[derive(Args)]
#[command(after_help = "Example: proctor judge step-bar frames --run l_h_32 --bound 2%")]
pub struct Judge {
    /// Case, one of those that `proctor precision --guests` lists
    case: String,
    /// Folder of the frames
    frames: PathBuf,
    /// Run of the case, as its folder is called [default: the finest of the short study]
    #[arg(long, value_name = "RUN")]
    run: Option<String>,
    /// Largest relative error; of a case that is a report, the share by which the number may be off its reference
    /// [default: 1%, of a report none]
    #[arg(long, value_name = "SHARE")]
    bound: Option<String>,
}

/// A share such as 2%.
fn share(text: &str) -> Result<f64, Failure> {
    let bound = format!("case={text}").parse::<Bound>();
    let accepted = |_| {
        Failure::BadInput(format!(
            "--bound: found {text:?}; accepted: a share such as 2%"
        ))
    };
    bound.map(|bound| bound.error).map_err(accepted)
}

impl Judge {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let chosen = std::slice::from_ref(&self.case);
        let studies = names::chosen(chosen, &study::open(), "case", |study| study.name())?;
        let [study] = studies.as_slice() else {
            return Err(Failure::BadInput("found no case; accepted: one".to_owned()));
        };
        let path = study.path(Size::Quick);
        let rung: Option<&Rung> = match &self.run {
            None => path.last(),
            Some(run) => path.iter().find(|rung| key(&rung.label) == *run),
        };
        let Some(rung) = rung else {
            let names: Vec<String> = path.iter().map(|rung| key(&rung.label)).collect();
            return Err(Failure::BadInput(format!(
                "--run {}: no run of {}; accepted: {}",
                self.run.as_deref().unwrap_or_default(),
                self.case,
                names.join(", ")
            )));
        };
        let bound = self.bound.as_deref().map(share).transpose()?;
        let FrameErrors {
            error,
            stress,
            reported,
        } = problems::judge(*study, rung, &self.frames)
            .map_err(|reason| Failure::BadInput(format!("{}: {reason}", self.frames.display())))?;
        if let Some(reported) = reported {
            let words = show::reported(&reported);
            let head = format!("{}, {}: {words}", self.case, rung.label);
            let Some(bound) = bound else {
                writeln!(out, "REPORT  {head}")?;
                return Ok(Outcome::Fine);
            };
            let holds = error <= bound;
            let word = if holds { "PASS" } else { "FAIL" };
            writeln!(out, "{word}  {head}; off by at most {}", percent(bound))?;
            return Ok(if holds {
                Outcome::Fine
            } else {
                Outcome::Failed
            });
        }
        let bound = bound.unwrap_or(BOUND);
        let holds = error <= bound;
        let word = if holds { "PASS" } else { "FAIL" };
        writeln!(
            out,
            "{word}  {}, {}: relative error {}, at most {}",
            self.case,
            rung.label,
            percent(error),
            percent(bound)
        )?;
        if let Some(stress) = stress {
            let found = percent(stress);
            writeln!(out, "      and of the stress {found}, without a bound")?;
        }
        Ok(if holds {
            Outcome::Fine
        } else {
            Outcome::Failed
        })
    }
}
