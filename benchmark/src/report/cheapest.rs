//! Which method brings an error down to 1 % and to 0.1 % at the least cost, case by case, beside the default.

use super::html::{Cell, Table, folded, paragraph};
use crate::precision::findings::LEVELS;
use crate::record::{Kind, Record};
use crate::show::{number, percent};
use crate::statistics::median;
use proctor_verification::settings::Method;
use std::collections::BTreeMap;

/// Beginning of the names of the aggregates that say what a line costs.
const COST: &str = "cost_";

/// What the words of a method mean, for who sees them for the first time.
pub const METHODS: &str = "A method is three choices. Weighting function, by which particles meet the nodes of the grid: \
    linear, uGIMP (each particle a box of its first size), cpGIMP (a box that stretches with its material), B-spline \
    (quadratic). Time of the stress update: USL (last in a step), MUSL (last, from velocities mapped a second time), USF \
    (first). Transfer of velocities back to the particles: FLIP (increments), APIC and TPIC (an affine field per particle). \
    The default is uGIMP USL FLIP.";

/// What the lines of one error of a case cost.
pub struct Costs {
    /// Name of the case.
    pub case: String,
    /// Which error.
    pub measure: String,
    lines: Vec<Line>,
}

struct Line {
    method: String,
    seconds: [Option<f64>; LEVELS.len()],
    smallest: Option<f64>,
}

impl Costs {
    /// The costs of all studies of a record, in its order.
    #[must_use]
    pub fn all(record: &Record) -> Vec<Self> {
        let mut all: Vec<Self> = vec![];
        for row in &record.rows {
            let Kind::Aggregate { name } = &row.kind else {
                continue;
            };
            let (Some(measure), Some(case)) = (name.strip_prefix(COST), row.labels.get("case"))
            else {
                continue;
            };
            let word = |key: &str| row.labels.get(key).map_or("", String::as_str);
            let mark = if word("has_safe_step") == "no" {
                " !"
            } else {
                ""
            };
            let line = Line {
                method: ["weighting", "scheme", "transfer"].map(word).join(" ") + mark,
                seconds: LEVELS.map(|level| {
                    let key = format!("seconds_for_error_{level}");
                    row.counters.get(&key).copied()
                }),
                smallest: row.counters.get("smallest_error").copied(),
            };
            match all
                .iter_mut()
                .find(|costs| costs.case == *case && costs.measure == measure)
            {
                Some(costs) => costs.lines.push(line),
                None => all.push(Self {
                    case: case.clone(),
                    measure: measure.to_owned(),
                    lines: vec![line],
                }),
            }
        }
        all
    }

    /// The method that reaches a level at the least cost, and that cost \[s\].
    fn cheapest(&self, level: usize) -> Option<(&str, f64)> {
        self.lines
            .iter()
            .filter_map(|line| Some((line.method.as_str(), line.seconds[level]?)))
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// How many times as fast as the default the cheapest method is; none where the default does not reach the level.
    fn factor(&self, level: usize) -> Option<f64> {
        let default = Method::DEFAULT.to_string();
        let line = self.lines.iter().find(|line| line.method == default)?;
        let (_, least) = self.cheapest(level)?;
        Some(line.seconds[level]? / least)
    }

    /// The smallest error of any run, and the method that gave it.
    fn smallest(&self) -> Option<(&str, f64)> {
        self.lines
            .iter()
            .filter_map(|line| Some((line.method.as_str(), line.smallest?)))
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// The cheapest method for a level and what it gains over the default, in words.
    pub fn said(&self, level: usize) -> String {
        let Some((method, _)) = self.cheapest(level) else {
            return "not reached".to_owned();
        };
        match self.factor(level) {
            _ if method == Method::DEFAULT.to_string() => format!("{method}, the default"),
            Some(factor) => format!("{method}, {}", times(factor)),
            None => format!("{method}, default misses it"),
        }
    }

    /// The smallest error of any run, in words.
    pub fn at_best(&self) -> String {
        self.smallest().map_or_else(
            || "no run succeeded".to_owned(),
            |(method, error)| format!("{}, {method}", percent(error)),
        )
    }

    /// The name of the case, as a link, with the error where it is not that of the displacement.
    fn link(&self) -> Cell {
        let text = if self.measure == "displacement" {
            self.case.clone()
        } else {
            format!("{} ({})", self.case, self.measure)
        };
        Cell::linked(text, format!("case-{}", self.case))
    }
}

/// A factor, such as `2.8×`.
fn times(factor: f64) -> String {
    format!("{factor:.1}×")
}

/// The first error of each case, in the order of the record.
fn first_of_each(all: &[Costs]) -> Vec<&Costs> {
    let mut first: Vec<&Costs> = vec![];
    for costs in all {
        if !first.iter().any(|known| known.case == costs.case) {
            first.push(costs);
        }
    }
    first
}

/// What all of it says in a number and a sentence.
#[must_use]
pub fn headline(all: &[Costs]) -> Option<[String; 2]> {
    let first = first_of_each(all);
    let reached: Vec<&&Costs> = first.iter().filter(|c| c.cheapest(0).is_some()).collect();
    let factors: Vec<f64> = reached.iter().filter_map(|c| c.factor(0)).collect();
    let mut wins: BTreeMap<&str, usize> = BTreeMap::new();
    for (method, _) in reached.iter().filter_map(|c| c.cheapest(0)) {
        *wins.entry(method).or_default() += 1;
    }
    let (winner, count) = wins.into_iter().max_by_key(|(_, count)| *count)?;
    let rest = format!("most often {winner}, in {count} of {} cases", reached.len());
    Some(match median(&factors) {
        Some(factor) => [
            times(factor),
            format!(
                "as fast as the default, the cheapest method brings the error down to 1 % (median); {rest}"
            ),
        ],
        None => [
            number(reached.len() as f64),
            format!("cases reach an error of 1 %, none of them with the default method; {rest}"),
        ],
    })
}

/// The panel of the first screen: the first error of each case, and the others folded.
#[must_use]
pub fn panel(all: &[Costs]) -> Option<String> {
    let first = first_of_each(all);
    if first.is_empty() {
        return None;
    }
    let (mut reached, mut missed): (Vec<&Costs>, Vec<&Costs>) =
        first.into_iter().partition(|c| c.cheapest(0).is_some());
    reached.sort_by(|a, b| {
        let key = |costs: &Costs| costs.factor(0).unwrap_or(0.0);
        key(b).total_cmp(&key(a))
    });
    let caption = "By case, the largest gain over the default method at 1 % first";
    let head = ["case", "for an error of 1 %", "for 0.1 %"];
    let mut table = Table::new(caption, &head);
    for costs in reached {
        let cells: [Cell; 3] = [costs.link(), costs.said(0).into(), costs.said(1).into()];
        table.push(cells);
    }
    let mut html = table.html();
    html.push_str(&paragraph(
        "2.7×: 2.7 times as fast as the default method (uGIMP USL FLIP) in processor time, each refined until its error is so \
         small. The error is that of the displacement where nothing else is said, relative to the exact solution. !: with this \
         method no time step is safe for every body.",
    ));
    if !missed.is_empty() {
        let mut table = Table::new(
            "Cases that no method brought below 1 % here, the smallest error first",
            &["case", "smallest error, and the method that gave it"],
        );
        missed.sort_by(|a, b| {
            let key = |costs: &Costs| costs.smallest().map_or(f64::INFINITY, |(_, error)| error);
            key(a).total_cmp(&key(b))
        });
        for costs in &missed {
            table.push([costs.link(), costs.at_best().into()]);
        }
        let count = match missed.len() {
            1 => "1 case stays".to_owned(),
            n => format!("{n} cases stay"),
        };
        html.push_str(&folded(
            &format!("{count} above 1 % on the short meshes of this record"),
            &(table.html()
                + &paragraph("`proctor precision CASE` refines the mesh of a case further.")),
        ));
    }
    html.push_str(&folded(
        "what the words of a method mean",
        &paragraph(METHODS),
    ));
    Some(html)
}
