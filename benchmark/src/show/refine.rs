//! A refined scene as text: a line for each quantity with its bar, and what stands in the way of bars.

use super::paint::{Mark, Paint};
use super::{number, seconds, shortened};
use crate::refine::judge::{Claim, FieldBar, QuantityBar, SceneBars};
use crate::refine::quantity::QuantityTime;
use crate::refine::work::Runs;
use proctor_verification::refine::Verdict;
use std::io::{self, Write};

/// Characters of a name.
const NAME: usize = 20;
/// Significant digits of a bar.
const DIGITS: i32 = 2;

/// The meshes and gates, a line for each quantity, and what it cost.
///
/// # Errors
/// If `out` cannot be written.
pub fn table(
    refined: &SceneBars,
    runs: &Runs,
    paint: Paint,
    out: &mut dyn Write,
) -> io::Result<()> {
    let findings = findings(refined, runs, paint);
    let (last, first) = findings
        .split_last()
        .map_or((None, &[][..]), |(l, f)| (Some(l), f));
    for finding in first {
        writeln!(out, "{finding}")?;
    }
    for (k, cells) in cells(refined).iter().enumerate() {
        let [mark, name, value, width, share, order, verdict, more] = &cells[..] else {
            continue;
        };
        let marks = [Mark::Held, Mark::Failed, Mark::Attention];
        let known = marks.into_iter().find(|known| known.symbol() == mark);
        let mark = known.map_or_else(|| " ".to_owned(), |known| paint.symbol(known));
        let name = shortened(name, NAME);
        let line = format!(
            "  {mark} {name:<NAME$} {value:>13} {width:>7} {share:>6} {order:>5}  {verdict}"
        );
        writeln!(out, "{}", line.trim_end())?;
        if !more.is_empty() && k > 0 {
            writeln!(out, "      {more}")?;
        }
    }
    match last {
        Some(last) => writeln!(out, "{last}"),
        None => Ok(()),
    }
}

/// Lines about the meshes, the orders of the energies, the effect of the mesh's place, and last the cost.
#[must_use]
pub fn findings(refined: &SceneBars, runs: &Runs, paint: Paint) -> Vec<String> {
    let cells: Vec<String> = runs.meshes.iter().map(|run| number(run.cell)).collect();
    let orders = refined.gates.map(|gate| match gate.order {
        Some(order) => one_decimal(order),
        None => "– (the same)".to_owned(),
    });
    let mut lines = vec![format!(
        "{}: h = {} m; kinetic and strain energy of order {} and {}",
        refined.scene,
        cells.join(", "),
        orders[0],
        orders[1]
    )];
    if let Some(until) = refined.until() {
        let symbol = paint.symbol(Mark::Failed);
        lines.push(if until > 0.0 {
            let until = number(until);
            format!(
                "{symbol} the energies settle until {until} s only: no bar is claimed (try --until {until})"
            )
        } else {
            format!("{symbol} the energies do not settle from the start on: no bar is claimed")
        });
    }
    if !runs.moved.is_empty() {
        let ratios = refined.judged.iter().filter_map(QuantityBar::place_ratio);
        let mut ratios: Vec<f64> = ratios.collect();
        ratios.sort_by(f64::total_cmp);
        let middle = ratios.get(ratios.len() / 2).copied().unwrap_or(0.0);
        lines.push(format!(
            "mesh moved along {}: {:.0} % of the difference of meshes, in the median",
            runs.along.join(" and "),
            100.0 * middle
        ));
    }
    let [meshes, moved] = runs.seconds();
    let times = meshes / runs.finest_seconds();
    let mut took = format!(
        "all meshes took {}, {times:.2} times the finest",
        seconds(meshes)
    );
    if moved > 0.0 {
        took = format!("{took}; the moved ones {}", seconds(moved));
    }
    lines.push(took);
    lines
}

/// Several scenes in one line: of each how many bars it has, and the first of them.
#[must_use]
pub fn short(all: &[&SceneBars], paint: Paint) -> String {
    let of = |refined: &&SceneBars| {
        let bars = || {
            refined
                .judged
                .iter()
                .filter(|judged| judged.bar().is_some())
        };
        let mark = if refined.until().is_none() {
            Mark::Held
        } else {
            Mark::Failed
        };
        let first = bars().next().and_then(|judged| {
            let (value, width) = with_bar(judged.value(), judged.bar()?);
            let unit = judged.quantity.unit();
            Some(format!(
                ", {} {value} ± {width} {unit}",
                judged.quantity.name
            ))
        });
        format!(
            "{} {} {} of {} bars{}",
            paint.symbol(mark),
            refined.scene,
            bars().count(),
            refined.judged.len(),
            first.unwrap_or_default()
        )
    };
    let scenes: Vec<String> = all.iter().map(of).collect();
    format!("Error bars from three meshes: {}", scenes.join("; "))
}

/// A line of cells for each quantity; the headings are the first.
#[must_use]
pub fn cells(refined: &SceneBars) -> Vec<Vec<String>> {
    let end = refined.times.last().copied().unwrap_or(0.0);
    let at = format!("at {} s", number(end));
    let head = [
        "",
        &at,
        "value",
        "± 95 %",
        "change",
        "order",
        "verdict     1 % at",
        "",
    ];
    let head = head.map(str::to_owned).to_vec();
    let quantities = refined.judged.iter();
    let quantities = quantities.map(|judged| cells_of(judged, refined.cells[2]));
    std::iter::once(head)
        .chain(quantities)
        .chain(refined.fields.iter().map(cells_of_field))
        .collect()
}

/// A field: its root mean square, and the bar of that of its error.
fn cells_of_field(field: &FieldBar) -> Vec<String> {
    let (mark, width, part) = if field.claimed {
        let (_, width) = with_bar(field.size, field.estimate.width);
        (Mark::Held, width, share(field.estimate.width / field.size))
    } else {
        (Mark::Failed, "none".to_owned(), String::new())
    };
    let more = if field.field.claims() {
        String::new()
    } else {
        format!(
            "bars of stress hold too seldom to be claimed; it would be {} {}",
            number(field.estimate.width),
            field.field.unit()
        )
    };
    let (value, _) = with_bar(field.size, field.estimate.width);
    vec![
        mark.symbol().to_owned(),
        format!("rms {}", field.field.word()),
        format!("{value} {}", field.field.unit()),
        width,
        part,
        (field.estimate.order).map_or_else(|| "–".to_owned(), one_decimal),
        field.estimate.verdict.word().to_owned(),
        more,
    ]
}

/// A quantity: symbol, name, value, bar, the bar over its change, order, verdict with the cells for an error of 1 %, and
/// what else there is to know where it has no bar.
fn cells_of(judged: &QuantityBar, finest: f64) -> Vec<String> {
    let quantity = &judged.quantity;
    let unit = quantity.unit();
    let mark = match judged.claim {
        Claim::Bar if judged.estimate.verdict == Verdict::TooFast => Mark::Attention,
        Claim::Bar => Mark::Held,
        _ => Mark::Failed,
    };
    let name = match quantity.when {
        QuantityTime::End | QuantityTime::LateRate => quantity.name.clone(),
        when => format!("{}, {when}", quantity.name),
    };
    let order = (judged.estimate.order)
        .filter(|_| judged.estimate.verdict != Verdict::Same)
        .map_or_else(|| "–".to_owned(), one_decimal);
    let mut verdict = judged.verdict().to_owned();
    let mut more = String::new();
    let (value, width, share) = match judged.bar() {
        Some(_) if judged.estimate.verdict == Verdict::Same => {
            let none = "–".to_owned();
            (number(judged.value()), none.clone(), none)
        }
        Some(bar) => {
            if let Some(cell) = judged.cell_for_one_percent(finest) {
                verdict = format!("{verdict}  {} m", two_digits(cell));
            }
            let (value, width) = with_bar(judged.value(), bar);
            let share = if judged.change > 0.0 {
                share(bar / judged.change)
            } else {
                "–".to_owned()
            };
            (value, width, share)
        }
        None => {
            match (judged.claim, judged.offset_range) {
                (Claim::Place, Some(range)) => {
                    more = format!(
                        "the places of the mesh change it by {} {unit}",
                        number(range)
                    );
                }
                (Claim::DoesNotSettle, _) => {
                    let (_, coarser) = judged.values.split_last().unwrap_or((&0.0, &[]));
                    let coarser: Vec<String> = coarser.iter().map(|v| number(*v)).collect();
                    more = format!("on the coarser meshes {} {unit}", coarser.join(", "));
                }
                _ => {}
            }
            (number(judged.value()), "none".to_owned(), String::new())
        }
    };
    let value = format!("{value} {unit}").trim_end().to_owned();
    let symbol = mark.symbol().to_owned();
    vec![symbol, name, value, width, share, order, verdict, more]
}

/// A value with its bar: the bar has two significant digits, the value as many decimals.
#[must_use]
pub fn with_bar(value: f64, bar: f64) -> (String, String) {
    if bar <= 0.0 || !bar.is_finite() {
        return (number(value), number(bar));
    }
    let decimals = DIGITS - 1 - libm::floor(libm::log10(bar)) as i32;
    if !(-3..=7).contains(&decimals) || value.abs() >= 1e7 {
        return (format!("{value:.4e}"), format!("{bar:.1e}"));
    }
    let places = decimals.max(0) as usize;
    (format!("{value:.places$}"), format!("{bar:.places$}"))
}

/// A share in per cent with two digits.
#[must_use]
pub fn share(share: f64) -> String {
    let per_cent = 100.0 * share;
    if per_cent > 999.0 {
        ">999 %".to_owned()
    } else if per_cent >= 10.0 {
        format!("{per_cent:.0} %")
    } else if per_cent >= 0.01 {
        format!("{per_cent:.*} %", if per_cent >= 1.0 { 1 } else { 2 })
    } else {
        "0.00 %".to_owned()
    }
}

/// An order; none that is nearly zero has a sign.
#[must_use]
pub fn one_decimal(order: f64) -> String {
    let tenths = (10.0 * order).round();
    format!("{:.1}", if tenths == 0.0 { 0.0 } else { 0.1 * tenths })
}

/// A cell size \[m\] with two significant digits.
#[must_use]
pub fn two_digits(x: f64) -> String {
    if x < 1e-4 {
        return format!("{x:.0e}");
    }
    let decimals = (1 - libm::floor(libm::log10(x.abs())) as i32).max(0) as usize;
    format!("{x:.decimals$}")
}
