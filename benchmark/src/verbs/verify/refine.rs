//! `proctor verify refine`: the calibration of the error bars of `proctor refine`.

use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::record::Record;
use crate::refine::judge::SceneBars;
use crate::refine::kept::SCENES;
use crate::refine::ladders;
use crate::show::paint::{Mark, Paint};
use crate::show::{Table, percent};
use proctor_scene::simulation::Options;
use proctor_verification::refine::calibration::{Calibration, Coverage};
use proctor_verification::refine::{Rule, Verdict};
use std::io::Write;
use std::path::Path;

/// Name of the calibration among the cases.
pub const NAME: &str = "refine";
/// The kept full ladders of all cases.
const LADDERS: &str = "fixtures/expected/full.json";

/// Judges the rule on the ladders of a record, by default those that are kept, and the gate of a scene on kept scenes.
///
/// # Errors
/// A record that cannot be read or holds no ladder.
pub fn run(
    record: Option<&Path>,
    options: &Options,
    table: bool,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    let path = record.unwrap_or(Path::new(LADDERS));
    if !path.is_file() {
        return Err(Failure::BadInput(format!(
            "{}: no such file; accepted: a record of `proctor verify`, with --ladders FILE; a checkout has {LADDERS}",
            path.display()
        )));
    }
    let record = Record::read(path).map_err(Failure::bad_input)?;
    let calibration = Calibration::new(&ladders::of(&record));
    if calibration.triples.is_empty() {
        return Err(Failure::BadInput(format!(
            "{}: found no ladder of three meshes; accepted: a record of full ladders",
            path.display()
        )));
    }
    if table {
        shown(&calibration, out)?;
    }
    let paint = Paint::of_standard_output();
    let gates = calibration.gates();
    for gate in &gates {
        let mark = if gate.passed() {
            Mark::Held
        } else {
            Mark::Failed
        };
        writeln!(
            out,
            "{} {}: {:.3}, {} {}",
            paint.symbol(mark),
            gate.name,
            gate.value,
            gate.relation.words(),
            gate.bound
        )?;
    }
    let mut failed = gates.iter().filter(|gate| !gate.passed()).count();
    let interrupt = Interrupt::listen()?;
    for scene in SCENES {
        let (held, found) = match scene.refined(options, &interrupt) {
            Ok(None) => return Ok(interrupt.outcome()),
            Ok(Some((refined, _))) => {
                (refined.until().is_none() == scene.settles, orders(&refined))
            }
            Err(reason) => (false, reason),
        };
        failed += usize::from(!held);
        let mark = if held { Mark::Held } else { Mark::Failed };
        let must = if scene.settles {
            "must settle"
        } else {
            "must not settle"
        };
        writeln!(
            out,
            "{} {}: {found}; {must}",
            paint.symbol(mark),
            scene.name
        )?;
    }
    let word = if failed == 0 { "PASS" } else { "FAIL" };
    let all = gates.len() + SCENES.len();
    writeln!(out, "{word}: {failed} of {all} gates miss")?;
    Ok(if failed == 0 {
        Outcome::Fine
    } else {
        Outcome::Failed
    })
}

/// The orders of the energies of a scene, and until when they settle where they do not to the end.
fn orders(refined: &SceneBars) -> String {
    let orders = refined.gates.map(|gate| gate.order.unwrap_or(f64::NAN));
    let until = refined
        .until()
        .map(|until| format!(", until {until:.3} s only"));
    format!(
        "kinetic and strain energy of order {:.1} and {:.1}{}",
        orders[0],
        orders[1],
        until.unwrap_or_default()
    )
}

/// Coverage and width by group, verdicts, and every bar that does not hold the truth.
fn shown(calibration: &Calibration, out: &mut dyn Write) -> std::io::Result<()> {
    let all = calibration.triples.len();
    let kept = calibration.kept().count();
    writeln!(
        out,
        "{all} bars from three meshes with a known error; in {} the reference hides it, {kept} judge the rule.",
        all - kept
    )?;
    writeln!(
        out,
        "Coverage and median width over the true error, cases weighed equally and all bars alike:"
    )?;
    let mut table = Table::new(["", "bars", "cases", "by case", "width", "by bar", "width"]);
    let mut push = |name: &str, of: Coverage| {
        table.push([
            name.to_owned(),
            of.rows.to_string(),
            of.cases.to_string(),
            percent(of.by_case),
            format!("{:.2}", of.width_by_case),
            percent(of.by_row),
            format!("{:.2}", of.width_by_row),
        ]);
    };
    for (name, triples) in calibration.groups() {
        if triples.is_empty() {
            continue;
        }
        push(name, Coverage::of(triples.iter().copied(), Rule::VALUE));
        if name == "held out" {
            let without = Coverage::of(triples, Rule::WITHOUT_CEILING);
            push("held out, p > 2.3 believed", without);
        }
    }
    push(
        "with hidden errors",
        Coverage::of(&calibration.triples, Rule::VALUE),
    );
    write!(out, "{table}")?;
    writeln!(
        out,
        "verdicts: {} asymptotic, {} too fast, {} others",
        calibration.count(&[Verdict::Asymptotic]),
        calibration.count(&[Verdict::TooFast]),
        calibration.count(&[Verdict::TooSlow, Verdict::Swings, Verdict::Same])
    )?;
    for (triple, over) in calibration.misses() {
        writeln!(
            out,
            "  misses: {} {}, finest h = {}: {over:.2} of the error",
            triple.ladder,
            triple.quantity,
            crate::show::number(triple.cells[2])
        )?;
    }
    Ok(())
}
