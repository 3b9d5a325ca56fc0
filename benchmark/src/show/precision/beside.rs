//! Cases beside each other: what the first level of an error costs that several of them study.

use super::words as cost_words;
use crate::precision::cost::Cost;
use crate::precision::findings::LEVELS;
use crate::precision::{CaseStudy, Findings};
use crate::show::{Table, number, percent};
use std::io::{self, Write};

/// Words of the errors that at least two cases study, in the order of the first of them.
#[must_use]
pub fn words(studied: &[CaseStudy]) -> Vec<&'static str> {
    let all = studied.iter().flat_map(|studied| studied.study.measures());
    let mut words: Vec<&'static str> = vec![];
    for measure in all {
        if of(studied, measure.word).len() > 1 && !words.contains(&measure.word) {
            words.push(measure.word);
        }
    }
    words
}

/// The cases that study an error, each with the number of the measure.
#[must_use]
pub fn of<'a>(studied: &'a [CaseStudy], word: &str) -> Vec<(&'a CaseStudy, usize)> {
    let number = |studied: &'a CaseStudy| {
        let mut measures = studied.study.measures().iter();
        Some((studied, measures.position(|measure| measure.word == word)?))
    };
    studied.iter().filter_map(number).collect()
}

/// A table of the errors that cases share: what 1 % costs with each, how many times the least cost that is, and the error of the
/// finest run, which tells whether the path stays below. The last lines have the cost of all errors that every case brings so far
/// down.
///
/// # Errors
/// If `out` cannot be written.
pub fn cases(studied: &[CaseStudy], out: &mut dyn Write) -> io::Result<()> {
    let words = words(studied);
    if words.is_empty() {
        return Ok(());
    }
    let mut table = Table::new([
        "error",
        "case",
        "combination",
        "for 1 %",
        "over the least",
        "finest",
    ]);
    let over = |seconds: Option<f64>, least: f64| {
        seconds.map_or_else(
            || "-".to_owned(),
            |seconds| number((10.0 * seconds / least).round() / 10.0),
        )
    };
    // Of each case that has a line, the seconds for all errors that every case brings down.
    let mut all: Vec<(&str, f64)> = vec![];
    let mut reached: Vec<&str> = vec![];
    for word in words {
        let found: Vec<(&str, Findings)> = of(studied, word)
            .into_iter()
            .map(|(studied, measure)| (studied.study.name(), Findings::new(studied, measure)))
            .collect();
        let lines: Vec<_> = (found.iter())
            .flat_map(|(case, found)| found.lines.iter().map(move |line| (*case, line)))
            .collect();
        let costs = || lines.iter().map(|(_, line)| line.costs[0].seconds());
        let least = costs().flatten().fold(f64::INFINITY, f64::min);
        if costs().all(|cost| cost.is_some()) {
            reached.push(word);
            for (case, line) in &lines {
                let seconds = line.costs[0].seconds().unwrap_or(f64::NAN);
                match all.iter_mut().find(|(name, _)| name == case) {
                    Some((_, most)) => *most = most.max(seconds),
                    None => all.push((case, seconds)),
                }
            }
        }
        for (case, line) in lines {
            table.push([
                word.to_owned(),
                case.to_owned(),
                line.method.to_string(),
                cost_words(line.costs[0]),
                over(line.costs[0].seconds(), least),
                percent(line.finest()),
            ]);
        }
    }
    if reached.len() > 1 {
        let least = all.iter().map(|(_, seconds)| *seconds);
        let least = least.fold(f64::INFINITY, f64::min);
        for (case, seconds) in all {
            table.push([
                reached.join(", "),
                case.to_owned(),
                String::new(),
                cost_words(Cost::Time(seconds)),
                over(Some(seconds), least),
                String::new(),
            ]);
        }
    }
    writeln!(
        out,
        "Cost of an error of {} beside each other",
        percent(LEVELS[0])
    )?;
    writeln!(out, "{table}")
}
