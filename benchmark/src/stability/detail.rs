//! The stability map as a record stores it beside its flat rows, for the picture and the page.

use super::extreme::ExtremeDetail;
use super::run::{JobResult, Outcome};
use crate::record::details::{Details, GateDetail, gate};
use proctor_verification::stability::block::Place;
use proctor_verification::stability::map::Entry;
use serde::{Deserialize, Serialize};

/// Findings on stability.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StabilityDetail {
    /// Cells of the map, plane and space taken together.
    pub cells: Vec<StabilityCell>,
    /// Scenes that are not linear, a line each: name, method, the kernel's step, stable up to and unstable from over it, energy
    /// over that of the reference, why it fails.
    pub nonlinear: Vec<Vec<String>>,
    /// Bodies about the axis of revolution, a line each: method, body, predicted and measured c dt/h, the kernel's step.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub round: Vec<Vec<String>>,
    /// Its bounds.
    pub gates: Vec<GateDetail>,
    /// Parts that could not be done, each with its reason.
    pub failures: Vec<String>,
    /// Stiff and extreme scenes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extreme: Vec<ExtremeDetail>,
}

/// A cell of the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityCell {
    /// Words of the method.
    pub weighting: String,
    /// Scheme.
    pub scheme: String,
    /// Transfer.
    pub transfer: String,
    /// Particles per cell and axis.
    pub particles_per_cell: usize,
    /// Numbers of dimensions that were asked.
    pub axes: Vec<usize>,
    /// Largest c dt/h at which nothing is known to grow.
    pub safe: f64,
    /// Smallest ratio of a measured to a predicted limit; none where nothing was found to compare.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ratio: Option<f64>,
    /// The kernel's automatic step, c dt/h.
    pub kernel: f64,
    /// True if the kernel says that no step is safe for every body.
    pub warned: bool,
    /// True if all its gates hold.
    pub passed: bool,
    /// Body and place that rule.
    pub ruled_by: String,
}

impl StabilityCell {
    fn new(entry: &Entry, passed: bool) -> Self {
        let method = entry.choice.method;
        Self {
            weighting: method.weighting_word().to_owned(),
            scheme: method.scheme_word().to_owned(),
            transfer: method.transfer_word().to_owned(),
            particles_per_cell: entry.choice.particles_per_cell,
            axes: vec![entry.choice.dimension.axes()],
            safe: entry.safe(),
            ratio: entry.ratio(),
            kernel: entry.automatic(),
            warned: !method.has_safe_step(),
            passed,
            ruled_by: ruled_by(entry),
        }
    }

    fn is_of(&self, other: &Self) -> bool {
        self.weighting == other.weighting
            && self.scheme == other.scheme
            && self.transfer == other.transfer
            && self.particles_per_cell == other.particles_per_cell
    }

    /// Takes the worse of both.
    fn join(&mut self, other: Self) {
        self.axes.extend(other.axes);
        if other.safe < self.safe {
            self.safe = other.safe;
            self.ruled_by = other.ruled_by;
        }
        self.ratio = match (self.ratio, other.ratio) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        self.passed &= other.passed;
    }
}

/// The body that becomes unstable first.
fn ruled_by(entry: &Entry) -> String {
    let on_nodes = entry.sites.iter().find(|site| site.predicted.is_none());
    let on_nodes = on_nodes.filter(|_| entry.safe() < entry.worst().courant);
    let axes = entry.choice.dimension.axes();
    if let Some(site) = on_nodes {
        return format!("{}{}, {axes}D", site.place.form.words(), site.word);
    }
    let Place { form, offset } = entry.worst().place;
    // As many digits as a hair's breadth needs.
    let digits = format!("{offset:.6}");
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{} at {digits} of a cell, {axes}D", form.words())
}

impl Details {
    /// Adds what was found.
    pub fn push_stability(&mut self, done: &JobResult) {
        let detail = self.stability.get_or_insert_default();
        detail.gates.extend(done.gates().iter().map(gate));
        match &done.outcome {
            Ok(Outcome::Entry(entry)) => {
                let cell = StabilityCell::new(entry, done.passed());
                match detail.cells.iter_mut().find(|other| other.is_of(&cell)) {
                    Some(other) => other.join(cell),
                    None => detail.cells.push(cell),
                }
            }
            Ok(Outcome::Nonlinear(limit)) => {
                let or_none = |value: Option<f64>| match value {
                    Some(value) => format!("{value:.2}"),
                    None => "none found".to_owned(),
                };
                let class = limit.measured.class.map_or("", |class| class.words());
                let cause = match &limit.refusal {
                    Some(refusal) => format!("{class}: {refusal}"),
                    None => class.to_owned(),
                };
                detail.nonlinear.push(vec![
                    done.job.name(),
                    format!("{:.3}", limit.automatic),
                    or_none(limit.measured.stable),
                    or_none(limit.measured.unstable),
                    format!("{:.2}", limit.energy),
                    cause,
                ]);
            }
            Ok(Outcome::Round(entry)) => {
                let name = done.job.name();
                detail.round.extend(entry.rows.iter().map(|row| {
                    let unstable = row.measured.unstable;
                    let unstable =
                        unstable.map_or_else(|| "none found".to_owned(), |c| format!("{c:.3}"));
                    vec![
                        name.replace(" about the axis", ""),
                        row.words(),
                        format!("{:.3}", row.predicted),
                        unstable,
                        format!("{:.3}", row.kernel),
                    ]
                }));
            }
            Err(error) => detail
                .failures
                .push(format!("{}: {error}", done.job.name())),
        }
    }
}
