//! Ladders of several methods as text: a line for each, the cheapest, and bars that do not overlap.

use super::paint::{Mark, Paint};
use super::refine::{one_decimal, share, with_bar};
use super::{in_words, rounded, seconds};
use crate::refine::methods::{Apart, MethodRun, cheapest, word};
use std::io::{self, Write};

/// Characters of the reason why a method failed.
const REASON: usize = 56;

/// A line for each method, and what they say together.
///
/// # Errors
/// If `out` cannot be written.
pub fn table(
    scene: &str,
    all: &[MethodRun],
    apart: &[Apart],
    paint: Paint,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "{scene} with {} methods", all.len())?;
    writeln!(
        out,
        "    {:<20} {:>9} {:>9} {:>12} {:>9} {:>9}",
        "method", "energies", "bars", "median bar", "finest", "1 % in"
    )?;
    for run in all {
        writeln!(out, "{}", line(run, paint))?;
    }
    match cheapest(all) {
        Some((run, time)) => writeln!(
            out,
            "cheapest for an error of 1 %: {}, about {} (median of its quantities)",
            word(run.method),
            seconds(time)
        )?,
        None => writeln!(out, "no method settles in half of its quantities")?,
    }
    for (name, ends) in apart {
        let of = ends.map(|(method, value, bar)| {
            let (value, bar) = with_bar(value, bar);
            format!("{value} ± {bar} with {}", word(method))
        });
        writeln!(
            out,
            "{} {name}: {}, {}: the bars do not overlap",
            paint.symbol(Mark::Failed),
            of[0],
            of[1]
        )?;
    }
    if apart.is_empty() && all.len() > 1 {
        writeln!(out, "{} all bars overlap", paint.symbol(Mark::Held))?;
    }
    Ok(())
}

/// A method: orders of the energies, quantities with a bar, their median width, and what it costs.
fn line(run: &MethodRun, paint: Paint) -> String {
    let name = word(run.method);
    let refined = match &run.refined {
        Ok(refined) => refined,
        Err(reason) => {
            let reason = in_words(&rounded(reason), REASON);
            return format!("  {} {name:<20} {reason}", paint.symbol(Mark::Failed));
        }
    };
    let mark = if refined.until().is_none() {
        Mark::Held
    } else {
        Mark::Failed
    };
    let orders = refined
        .gates
        .map(|gate| gate.order.map_or_else(|| "–".to_owned(), one_decimal));
    let mut widths: Vec<f64> = (refined.judged.iter())
        .filter_map(|judged| Some(judged.bar()? / judged.change))
        .collect();
    widths.sort_by(f64::total_cmp);
    let median = widths.get(widths.len() / 2).map(|width| share(*width));
    let time = run.seconds_for_one_percent();
    format!(
        "  {} {name:<20} {:>9} {:>9} {:>12} {:>9} {:>9}",
        paint.symbol(mark),
        orders.join(", "),
        format!("{} of {}", widths.len(), refined.judged.len()),
        median.unwrap_or_else(|| "–".to_owned()),
        seconds(run.runs.finest_seconds()),
        time.map_or_else(|| "–".to_owned(), seconds)
    )
}
