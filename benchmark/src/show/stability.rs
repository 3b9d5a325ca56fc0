//! Stability as text.

use super::{Table, number};
use crate::record::details::GateDetail;
use crate::stability::{ExtremeDetail, StabilityCell, StabilityDetail};
use proctor_verification::stability::extreme::Ending;
use proctor_verification::stability::scene::Report;
use proctor_verification::stability::table::Number;
use proctor_verification::stability::tension::TensionReport;
use std::io::{self, Write};

/// The map, scenes that are not linear, gates that do not hold, and how many do.
///
/// # Errors
/// If `out` cannot be written.
pub fn map(detail: &StabilityDetail, interrupted: bool, out: &mut dyn Write) -> io::Result<()> {
    for transfer in words(&detail.cells, |cell| &cell.transfer) {
        cells(detail, transfer, out)?;
    }
    if !detail.nonlinear.is_empty() {
        writeln!(
            out,
            "Not linear: the kernel's smallest step (c dt/h), and over it the steps up to which energy stays, from which it\n\
             comes from nowhere; the highest energy at the kernel's step over that at half of it"
        )?;
        let mut table = Table::new(["", "kernel", "stable to", "unstable from", "energy", ""]);
        let mut ended = vec![];
        for line in &detail.nonlinear {
            let mut line = line.clone();
            let cause = line.pop().unwrap_or_default();
            // The table has the class; why a run ended is too long for a column.
            let (class, why) = cause.split_once(": ").unwrap_or((&cause, ""));
            if !why.is_empty() {
                ended.push(format!("{}: {why}", line[0]));
            }
            line.push(class.to_owned());
            table.push(line);
        }
        writeln!(out, "{table}")?;
        for why in ended {
            writeln!(out, "  {why}")?;
        }
    }
    round(detail, out)?;
    verdict(detail, interrupted, out)
}

/// Bodies about the axis of revolution, where there are any.
///
/// # Errors
/// If `out` cannot be written.
pub fn round(detail: &StabilityDetail, out: &mut dyn Write) -> io::Result<()> {
    if detail.round.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "About an axis of revolution: c dt/h of the body whose limit is nearest to the\nkernel's step, of rods, rings and discs; lengths in cells"
    )?;
    let mut table = Table::new(["", "body", "predicted", "unstable", "kernel"]);
    for line in &detail.round {
        table.push(line.clone());
    }
    writeln!(out, "{table}")
}

/// Parts that could not be done and gates that do not hold, and the verdict over all gates.
///
/// # Errors
/// If `out` cannot be written.
pub fn verdict(detail: &StabilityDetail, interrupted: bool, out: &mut dyn Write) -> io::Result<()> {
    for failure in &detail.failures {
        writeln!(out, "failed: {failure}")?;
    }
    gates(detail, interrupted, out)
}

/// Values in the order in which they come first.
pub fn words<'a>(
    cells: &'a [StabilityCell],
    of: impl Fn(&'a StabilityCell) -> &'a str,
) -> Vec<&'a str> {
    let mut all = vec![];
    for cell in cells {
        if !all.contains(&of(cell)) {
            all.push(of(cell));
        }
    }
    all
}

/// Numbers of particles per cell that a map has.
#[must_use]
pub fn sizes(cells: &[StabilityCell]) -> Vec<usize> {
    let mut all: Vec<usize> = cells.iter().map(|cell| cell.particles_per_cell).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// A safe Courant number with two digits behind the point, or as small as it is.
#[must_use]
pub fn courant(safe: f64) -> String {
    match safe {
        _ if !safe.is_finite() => "none".to_owned(),
        _ if safe < 0.01 => format!("{safe:.3}"),
        _ => format!("{:.2}", (safe * 100.0).floor() / 100.0),
    }
}

fn cells(detail: &StabilityDetail, transfer: &str, out: &mut dyn Write) -> io::Result<()> {
    let sizes = sizes(&detail.cells);
    let of_transfer = || detail.cells.iter().filter(|cell| cell.transfer == transfer);
    let axes = of_transfer()
        .flat_map(|cell| &cell.axes)
        .max()
        .copied()
        .unwrap_or(2);
    writeln!(
        out,
        "{transfer}, {}: safe c dt/h by particles per cell and axis, smallest ratio of measured to predicted, the kernel's step",
        if axes == 3 { "2D and 3D" } else { "2D" }
    )?;
    let per_cell = sizes.iter().map(|n| format!("{n} per cell"));
    let mut table = Table::new(
        [String::new()]
            .into_iter()
            .chain(per_cell)
            .chain(["ratio", "kernel", "ruled by"].map(String::from)),
    );
    for weighting in words(&detail.cells, |cell| &cell.weighting) {
        for scheme in words(&detail.cells, |cell| &cell.scheme) {
            let line: Vec<&StabilityCell> = of_transfer()
                .filter(|cell| cell.weighting == weighting && cell.scheme == scheme)
                .collect();
            let Some(worst) = line.iter().min_by(|a, b| a.safe.total_cmp(&b.safe)) else {
                continue;
            };
            let mut cells = vec![format!("{weighting} {scheme}")];
            for &n in &sizes {
                let cell = line.iter().find(|cell| cell.particles_per_cell == n);
                cells.push(cell.map_or_else(String::new, |cell| {
                    let mark = if cell.passed { " " } else { "!" };
                    format!("{}{mark}", courant(cell.safe))
                }));
            }
            let ratio = line.iter().filter_map(|cell| cell.ratio).reduce(f64::min);
            cells.push(ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{ratio:.3}")));
            let warned = if worst.warned { " warned" } else { "" };
            cells.push(format!("{:.3}{warned}", worst.kernel));
            cells.push(worst.ruled_by.clone());
            table.push(cells);
        }
    }
    writeln!(out, "{table}")
}

/// The stiff and extreme scenes; of those that failed all gates that do not hold, and why.
///
/// # Errors
/// If `out` cannot be written.
pub fn extreme(rows: &[ExtremeDetail], interrupted: bool, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new([
        "",
        "ended",
        "found",
        "bound",
        "time",
        "nearest to its bound, or why it is refused",
    ]);
    for row in rows {
        let ended = |found: String, bound: String, what: String| {
            let time = super::seconds(row.seconds);
            [
                row.name.clone(),
                row.ending.clone(),
                found,
                bound,
                time,
                shortened(&what),
            ]
        };
        table.push(match (row.worst(), row.refusals.first()) {
            (Some(gate), _) => {
                let bound = format!("{} {}", gate.relation, number(gate.bound));
                ended(found(gate), bound, gate.name.clone())
            }
            (None, refusal) => {
                let refusal = refusal.cloned().unwrap_or_default();
                ended(String::new(), String::new(), refusal)
            }
        });
    }
    writeln!(out, "{table}")?;
    for row in rows.iter().filter(|row| !row.passed) {
        writeln!(out, "FAIL  {}: {}", row.name, row.what)?;
        for why in row.unexpected.iter().chain(&row.cause) {
            writeln!(out, "        {why}")?;
        }
        failing("        ", &row.gates, out)?;
    }
    let count = |ending: &str| rows.iter().filter(|row| row.ending == ending).count();
    let [held, refused, failed] =
        [Ending::Held, Ending::Refused, Ending::Failed].map(|ending| count(ending.word()));
    let word = match failed {
        _ if interrupted => "INTERRUPTED",
        0 => "PASS",
        _ => "FAIL",
    };
    writeln!(
        out,
        "{word}: {held} stiff and extreme scenes held, {refused} refused with a reason, {failed} failed"
    )
}

/// Most characters of a message in a table.
const LINE: usize = 60;

/// The first line of a message, cut where it is long.
fn shortened(message: &str) -> String {
    let line = message.lines().next().unwrap_or_default();
    match line.char_indices().nth(LINE) {
        Some((end, _)) => format!("{} …", line[..end].trim_end()),
        None => line.to_owned(),
    }
}

fn found(gate: &GateDetail) -> String {
    gate.value.map_or_else(|| "not finite".to_owned(), number)
}

fn gates(detail: &StabilityDetail, interrupted: bool, out: &mut dyn Write) -> io::Result<()> {
    failing("FAIL  ", &detail.gates, out)?;
    let gates = detail.gates.len();
    let passed = detail.gates.iter().filter(|gate| gate.passed).count();
    let word = if interrupted {
        "INTERRUPTED"
    } else if passed == gates && detail.failures.is_empty() {
        "PASS"
    } else {
        "FAIL"
    };
    writeln!(out, "{word}: {passed} of {gates} gates of stability")
}

/// Gates that do not hold, with what was found, each behind a word.
fn failing(word: &str, gates: &[GateDetail], out: &mut dyn Write) -> io::Result<()> {
    for gate in gates.iter().filter(|gate| !gate.passed) {
        writeln!(
            out,
            "{word}{}: {}, {} {}\n        {}",
            gate.name,
            found(gate),
            gate.relation,
            number(gate.bound),
            gate.reason
        )?;
    }
    Ok(())
}

/// The stability of one scene of the user.
///
/// # Errors
/// If `out` cannot be written.
pub fn scene(name: &str, report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new([
        format!("scene {name}"),
        String::new(),
        report.method.to_string(),
    ]);
    let Some(limit) = &report.predicted else {
        write!(out, "{table}")?;
        return writeln!(
            out,
            "  nothing in it can become unstable; the kernel's step is {:.4e} s",
            report.dt
        );
    };
    let courant = limit.courant / limit.dt;
    let step = |what: &str, dt: f64| {
        [
            what.to_owned(),
            format!("{dt:.4e} s"),
            format!("c dt/h = {:.4}", dt * courant),
        ]
    };
    table.push(step("predicted critical step", limit.dt));
    table.push(step("the kernel's bound", report.critical));
    table.push(step("the kernel's step", report.dt));
    table.push([
        "the kernel's step over predicted".to_owned(),
        format!("{:.3}", report.dt / limit.dt),
        format!("decided by: {:?}", report.bound).to_lowercase(),
    ]);
    write!(out, "{table}")?;
    let at = |x: [f64; 3]| format!("({:.6}, {:.6}, {:.6}) m", x[0], x[1], x[2]);
    let ruler = &limit.ruler;
    writeln!(
        out,
        "  ruled by the particle {} of the body {} {:?} at {}, beside the node {}",
        ruler.particle,
        ruler.body,
        ruler.name,
        at(ruler.position),
        at(ruler.node)
    )?;
    writeln!(
        out,
        "  Of bodies at rest with the stiffness that their laws have there; without loads, damping and contact. Each body of\n  \
         a pair was taken alone, as it is beside its partner; what contact itself allows is in the kernel's bound."
    )?;
    if let Some(tension) = &report.tension {
        self::tension(tension, out)?;
    }
    match &report.alternatives {
        None => writeln!(
            out,
            "  {} particles: other methods were not tried",
            super::grouped(report.particles as u64)
        ),
        Some(all) if all.is_empty() => {
            writeln!(out, "  nothing that was tried allows a larger step")
        }
        Some(all) => {
            writeln!(
                out,
                "\n  What would allow a larger step, each computed for this scene:"
            )?;
            let mut table = Table::new(["", "predicted", "times"]);
            for one in all.iter().take(SHOWN) {
                table.push([
                    one.what.clone(),
                    if one.dt.is_finite() {
                        format!("{:.4e} s", one.dt)
                    } else {
                        "no limit".to_owned()
                    },
                    number(one.dt / limit.dt),
                ]);
            }
            write!(out, "{table}")
        }
    }
}

/// The tension that a scene will have, the growth of its method, and the methods that hold it.
fn tension(report: &TensionReport, out: &mut dyn Write) -> io::Result<()> {
    let TensionReport {
        foreseen,
        name,
        growth,
        steps,
        others,
    } = report;
    writeln!(
        out,
        "\n  In tension: {name}, {:.2e} Pa by {}, over the modulus of confined strain {:.2e}.",
        foreseen.stress, foreseen.cause, foreseen.strain
    )?;
    if *growth == 0.0 {
        return writeln!(
            out,
            "  A bar in that tension, with noise, holds at the kernel's step."
        );
    }
    writeln!(
        out,
        "  A bar in that tension, with noise, at the kernel's step: a motion without strain grows by {:.3} % \
         per step, tenfold in\n  \
         {:.0} of {:.0} steps. A smaller step only delays it. The same bar with other methods:",
        100.0 * growth,
        (std::f64::consts::LN_10 / growth).ceil(),
        steps.ceil()
    )?;
    let mut table = Table::new(["", "growth per step", ""]);
    for (method, growth) in others {
        let verdict = if *growth == 0.0 { "holds" } else { "" };
        table.push([
            method.to_string(),
            format!("{:.3} %", 100.0 * growth),
            verdict.to_owned(),
        ]);
    }
    write!(out, "{table}")
}

/// Alternatives that are shown.
const SHOWN: usize = 12;

/// The numbers of the kernel's table, those that it holds beside those that were found.
///
/// # Errors
/// If `out` cannot be written.
pub fn numbers(numbers: &[Number], out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new([
        "",
        "per cell",
        "thick bodies",
        "any body",
        "to hold",
        "held",
        "held is",
    ]);
    for n in numbers {
        let per_cell = n
            .particles_per_cell
            .map_or_else(|| "any".to_owned(), |n| n.to_string());
        table.push([
            n.method.to_string(),
            per_cell,
            number(n.thick),
            number(n.any),
            format!("{:.3}", n.number),
            format!("{:.3}", n.held),
            n.worth().words().to_owned(),
        ]);
    }
    writeln!(out, "{table}")
}
