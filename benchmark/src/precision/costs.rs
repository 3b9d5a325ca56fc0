//! Cost of each accuracy, from the rows of a record: the page and the terminal take their numbers from here.

use super::findings::LEVELS;
use crate::record::{Kind, Record};
use crate::show::percent;
use proctor_verification::settings::Method;
use std::collections::BTreeMap;

/// Beginning of the names of the aggregates that say what a line costs.
const COST: &str = "cost_";

/// Cost over the least up to which methods tie: times of one program that are taken minutes apart lie so far from each other.
pub const TIE: f64 = 1.1;
/// Methods of a tie that are named.
const NAMED: usize = 3;

/// Label of the rows of another solver.
const SOLVER: &str = "executable";

/// Costs of the lines of one error of a case.
pub struct Costs {
    /// Name of the case.
    pub case: String,
    /// Error that is measured.
    pub measure: String,
    /// The methods, in the order of the record.
    pub lines: Vec<CostLine>,
}

/// A method on one error of a case.
pub struct CostLine {
    /// The method, with `!` behind it where no step is safe for every body.
    pub method: String,
    /// Time to each level \[s\], where it is reached.
    pub seconds: [Option<f64>; LEVELS.len()],
    /// The smallest error of any run.
    pub smallest: Option<f64>,
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
            if row.labels.contains_key(SOLVER) {
                continue;
            }
            let word = |key: &str| row.labels.get(key).map_or("", String::as_str);
            let mark = if word("has_safe_step") == "no" {
                " !"
            } else {
                ""
            };
            let line = CostLine {
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
    #[must_use]
    pub fn cheapest(&self, level: usize) -> Option<(&str, f64)> {
        self.lines
            .iter()
            .filter_map(|line| Some((line.method.as_str(), line.seconds[level]?)))
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// The methods that reach a level at the least cost and those that tie with them ([`TIE`]), the least first.
    #[must_use]
    pub fn tied(&self, level: usize) -> Vec<&str> {
        let Some((_, least)) = self.cheapest(level) else {
            return vec![];
        };
        let reached = self
            .lines
            .iter()
            .filter_map(|line| Some((line.seconds[level]?, line.method.as_str())));
        let mut tied: Vec<(f64, &str)> = reached
            .filter(|(seconds, _)| *seconds <= TIE * least)
            .collect();
        tied.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        tied.into_iter().map(|(_, method)| method).collect()
    }

    /// Speed of the cheapest method over that of the default; none where the default does not reach the level.
    #[must_use]
    pub fn factor(&self, level: usize) -> Option<f64> {
        let default = Method::DEFAULT.to_string();
        let line = self.lines.iter().find(|line| line.method == default)?;
        let (_, least) = self.cheapest(level)?;
        Some(line.seconds[level]? / least)
    }

    /// The smallest error of any run, and the method that gave it.
    #[must_use]
    pub fn smallest(&self) -> Option<(&str, f64)> {
        self.lines
            .iter()
            .filter_map(|line| Some((line.method.as_str(), line.smallest?)))
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// The cheapest method for a level and what it gains over the default, in words.
    #[must_use]
    pub fn said(&self, level: usize) -> String {
        let tied = self.tied(level);
        let names = match tied.len() {
            0 => return "not reached".to_owned(),
            many if many > NAMED => {
                format!(
                    "{} = {} more",
                    tied[..NAMED - 1].join(" = "),
                    many + 1 - NAMED
                )
            }
            _ => tied.join(" = "),
        };
        match self.factor(level) {
            _ if tied == [Method::DEFAULT.to_string()] => format!("{names}, the default"),
            _ if tied.contains(&Method::DEFAULT.to_string().as_str()) => {
                format!("{names}, the default among them")
            }
            Some(factor) => format!("{names}, {}", times(factor)),
            None => format!("{names}, default misses it"),
        }
    }

    /// The smallest error of any run, in words.
    #[must_use]
    pub fn at_best(&self) -> String {
        self.smallest().map_or_else(
            || "no run succeeded".to_owned(),
            |(method, error)| format!("{}, {method}", percent(error)),
        )
    }
}

/// A factor, such as `2.8×`.
#[must_use]
pub fn times(factor: f64) -> String {
    format!("{factor:.1}×")
}

/// Methods that reach a level at the least processor time, with the number of errors, the most first and then by their names;
/// and the number of errors that no method brings so far down. All methods of a tie count.
#[must_use]
pub fn winners(all: &[Costs], level: usize) -> (Vec<(&str, usize)>, usize) {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut never = 0;
    for costs in all {
        let tied = costs.tied(level);
        never += usize::from(tied.is_empty());
        for method in tied {
            *counts.entry(method).or_default() += 1;
        }
    }
    let mut ranked: Vec<(&str, usize)> = counts.into_iter().collect();
    ranked.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    (ranked, never)
}

/// The methods that are first most often, all of them where several are: "A", or "A and B, each".
#[must_use]
pub fn most_often(ranked: &[(&str, usize)]) -> Option<(String, usize)> {
    let (_, most) = *ranked.first()?;
    let first: Vec<&str> = ranked
        .iter()
        .take_while(|(_, count)| *count == most)
        .map(|(method, _)| *method)
        .collect();
    let names = match first.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}, each", others.join(", ")),
        None => return None,
    };
    Some((names, most))
}
