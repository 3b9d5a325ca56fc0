//! Calibration of the rule: bars from three neighbouring meshes of a ladder with an exact answer, against the true error on
//! the finest of them.
//!
//! The constants of the rule were chosen on [`CHOSEN_ON`] alone. [`HELD_OUT`] judges them: nobody may tune a constant to these
//! cases. A case in neither list has joined since and counts in the total.

mod references;

use super::rule::{Rule, Verdict};
use crate::case::Gate;
pub use references::WITHOUT_MESH;
use references::hidden_by;
use std::collections::BTreeMap;

/// Cases on which the constants of the rule were chosen.
pub const CHOSEN_ON: [&str; 13] = [
    "axis-aligned",
    "bar",
    "base-acceleration",
    "cantilever",
    "colliding-blocks",
    "footing",
    "hertz-slab",
    "ironing",
    "rotation",
    "slipping-disk",
    "softening-bar",
    "staggered-start",
    "sudden-weight",
];

/// Cases that judge the rule and on which no constant may be tuned.
pub const HELD_OUT: [&str; 12] = [
    "axis-aligned-3d",
    "boussinesq",
    "corner-block",
    "fluid",
    "hertz-sphere",
    "plastic-wave",
    "rolling-disk",
    "self-weight",
    "spinning-collision",
    "step-bar",
    "vortex",
    "yielding-column",
];

/// Least coverage, each case weighed equally.
pub const LEAST_COVERAGE: f64 = 0.94;
/// Largest median of the width of the bar over the true error, each case weighed equally.
pub const MOST_WIDTH: f64 = 2.5;

/// A quantity of a kept ladder.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// Name of the case.
    pub case: String,
    /// Case and variant, as in `vortex/large`.
    pub name: String,
    /// Key of the quantity.
    pub quantity: String,
    /// Cell size \[m\], value and exact value of each mesh.
    pub meshes: Vec<[f64; 3]>,
}

/// A bar whose true error is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Triple {
    /// Name of the case.
    pub case: String,
    /// Case and variant.
    pub ladder: String,
    /// Key of the quantity.
    pub quantity: String,
    /// Cell sizes, coarse to fine \[m\].
    pub cells: [f64; 3],
    /// Values on them, over the exact ones where these scale with the mesh.
    pub values: [f64; 3],
    /// True error on the finest mesh, in the unit of the values.
    pub error: f64,
    /// True where the error is below what separates the reference from the problem that the kernel solves.
    pub hidden: bool,
    /// True where the value is the norm of an error, whose exact value is zero.
    pub norm: bool,
}

impl Triple {
    /// The bar of a rule over the true error, and its verdict.
    fn judged(&self, rule: Rule) -> (f64, Verdict) {
        let [a, b, c] = self.values;
        let scale = self.values.iter().fold(0.0, |s: f64, v| s.max(v.abs()));
        let estimate = rule.estimate(self.cells, [a - b, b - c], scale);
        let over = if self.error == 0.0 {
            f64::INFINITY
        } else {
            estimate.width / self.error
        };
        (over, estimate.verdict)
    }
}

/// Every run of three neighbouring meshes of the ladders, coarse to fine. Left out are cases whose "cell size" is a time
/// step, ladders that hold one cell size twice, and values that agree to round-off.
#[must_use]
pub fn triples(ladders: &[Ladder]) -> Vec<Triple> {
    ladders.iter().flat_map(of_ladder).collect()
}

fn of_ladder(ladder: &Ladder) -> Vec<Triple> {
    let mut meshes = ladder.meshes.clone();
    meshes.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let twice = meshes.windows(2).any(|pair| pair[0][0] == pair[1][0]);
    if twice || WITHOUT_MESH.contains(&ladder.case.as_str()) {
        return vec![];
    }
    let exacts = || meshes.iter().map(|mesh| mesh[2]);
    let largest = exacts().fold(0.0, |most: f64, exact| most.max(exact.abs()));
    let spread =
        exacts().fold(f64::NEG_INFINITY, f64::max) - exacts().fold(f64::INFINITY, f64::min);
    // What scales with one cell is divided by its exact value.
    let scales = spread > 1e-9 * largest && exacts().all(|exact| exact != 0.0);
    let of = |window: &[[f64; 3]]| {
        let value = |mesh: &[f64; 3]| if scales { mesh[1] / mesh[2] } else { mesh[1] };
        let exact = if scales { 1.0 } else { meshes[0][2] };
        let values = [0, 1, 2].map(|k| value(&window[k]));
        let [a, b, c] = values;
        let size = exact.abs().max(1.0);
        if (a - b).abs().max((b - c).abs()) <= super::rule::ROUND_OFF * size {
            return None;
        }
        let error = (c - exact).abs();
        let relative = if window[2][2] == 0.0 {
            window[2][1].abs()
        } else {
            (window[2][1] / window[2][2] - 1.0).abs()
        };
        Some(Triple {
            case: ladder.case.clone(),
            ladder: ladder.name.clone(),
            quantity: ladder.quantity.clone(),
            cells: [0, 1, 2].map(|k| window[k][0]),
            values,
            error,
            hidden: relative < hidden_by(&ladder.case, &ladder.name),
            norm: exact == 0.0,
        })
    };
    meshes.windows(3).filter_map(of).collect()
}

/// Share of bars that hold the truth, and their width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Number of bars.
    pub rows: usize,
    /// Number of cases.
    pub cases: usize,
    /// Share that holds the truth, each case weighed equally.
    pub by_case: f64,
    /// Median width over the true error, each case weighed equally.
    pub width_by_case: f64,
    /// Share of all bars that holds the truth.
    pub by_row: f64,
    /// Median width of all bars over the true error.
    pub width_by_row: f64,
}

impl Coverage {
    /// Coverage of these bars by a rule.
    #[must_use]
    pub fn of<'a>(triples: impl IntoIterator<Item = &'a Triple>, rule: Rule) -> Self {
        let mut cases: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        for triple in triples {
            let (over, _) = triple.judged(rule);
            cases.entry(&triple.case).or_default().push(over);
        }
        let held = |overs: &[f64]| overs.iter().filter(|over| **over >= 1.0).count() as f64;
        let share = |overs: &Vec<f64>| held(overs) / overs.len() as f64;
        let all: Vec<f64> = cases.values().flatten().copied().collect();
        let weighed = |overs: &Vec<f64>| {
            let weight = 1.0 / overs.len() as f64;
            overs
                .iter()
                .map(move |over| (*over, weight))
                .collect::<Vec<_>>()
        };
        Self {
            rows: all.len(),
            cases: cases.len(),
            by_case: cases.values().map(share).sum::<f64>() / cases.len() as f64,
            width_by_case: median(cases.values().flat_map(weighed).collect()),
            by_row: held(&all) / all.len() as f64,
            width_by_row: median(all.iter().map(|over| (*over, 1.0)).collect()),
        }
    }

    /// Its gates: least coverage and largest width.
    #[must_use]
    pub fn gates(&self, name: &str) -> [Gate; 2] {
        [
            Gate::at_least(
                format!("{name}: coverage by case"),
                self.by_case,
                LEAST_COVERAGE,
                "a bar is claimed to hold in 95 of 100 cases",
            ),
            Gate::at_most(
                format!("{name}: median width over the true error"),
                self.width_by_case,
                MOST_WIDTH,
                "a wider bar says too little",
            ),
        ]
    }
}

/// The median of values with weights: the mean of two where half of the weight ends between them.
fn median(mut weighed: Vec<(f64, f64)>) -> f64 {
    weighed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * weighed.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut sum = 0.0;
    for (k, (value, weight)) in weighed.iter().enumerate() {
        sum += weight;
        if (sum - half).abs() <= 1e-12 * half
            && let Some((next, _)) = weighed.get(k + 1)
        {
            return 0.5 * (value + next);
        }
        if sum > half {
            return *value;
        }
    }
    f64::NAN
}

/// The calibration of the rule on kept ladders.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Every triple, those too whose reference hides the error.
    pub triples: Vec<Triple>,
}

impl Calibration {
    /// Calibration on these ladders.
    #[must_use]
    pub fn new(ladders: &[Ladder]) -> Self {
        Self {
            triples: triples(ladders),
        }
    }

    /// Triples whose true error is known.
    pub fn kept(&self) -> impl Iterator<Item = &Triple> + Clone {
        self.triples.iter().filter(|triple| !triple.hidden)
    }

    /// The groups that are shown, each with its name: the two halves, what joined since, and all.
    #[must_use]
    pub fn groups(&self) -> Vec<(&'static str, Vec<&Triple>)> {
        let of = |named: &dyn Fn(&str) -> bool| -> Vec<&Triple> {
            self.kept().filter(|triple| named(&triple.case)).collect()
        };
        let chosen = |case: &str| CHOSEN_ON.contains(&case);
        let held_out = |case: &str| HELD_OUT.contains(&case);
        vec![
            ("chosen on", of(&chosen)),
            ("held out", of(&held_out)),
            ("joined since", of(&|case| !chosen(case) && !held_out(case))),
            ("all", of(&|_| true)),
        ]
    }

    /// Bounds of the held-out cases and of all.
    #[must_use]
    pub fn gates(&self) -> Vec<Gate> {
        let judged = self.groups().into_iter();
        let judged = judged.filter(|(name, _)| ["held out", "all"].contains(name));
        judged
            .flat_map(|(name, triples)| Coverage::of(triples, Rule::VALUE).gates(name))
            .collect()
    }

    /// Kept triples whose bar does not hold the truth, each with the width of its bar over the true error.
    #[must_use]
    pub fn misses(&self) -> Vec<(&Triple, f64)> {
        let miss =
            |triple: &'_ Triple| Some(triple.judged(Rule::VALUE).0).filter(|over| *over < 1.0);
        self.kept()
            .filter_map(|triple| Some((triple, miss(triple)?)))
            .collect()
    }

    /// Number of kept triples with one of these verdicts.
    #[must_use]
    pub fn count(&self, verdicts: &[Verdict]) -> usize {
        let judged = self.kept().map(|triple| triple.judged(Rule::VALUE).1);
        judged.filter(|verdict| verdicts.contains(verdict)).count()
    }
}
