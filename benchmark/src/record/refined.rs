//! A refined scene as a record keeps it beside its flat rows, for the page and for whoever reads its curves.

use super::Record;
use super::details::Figure;
use crate::refine::judge::{QuantityBar, SceneBars};
use crate::refine::work::Runs;
use crate::show::figures::refine as figures;
use crate::show::paint::Paint;
use crate::show::refine as show;
use serde::{Deserialize, Serialize};

/// A scene with error bars.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RefinedDetail {
    /// Name of the scene.
    pub scene: String,
    /// Number of quantities with a bar, and of all.
    pub bars: [usize; 2],
    /// The meshes, the gates and what the bars cost, each a line.
    pub findings: Vec<String>,
    /// A line for each quantity; the headings are the first.
    pub table: Vec<Vec<String>>,
    /// Each quantity over the meshes and over time.
    pub figures: Vec<Figure>,
    /// Histories on the finest mesh, with the bars at each time.
    pub curves: Vec<BandDetail>,
}

/// A history with the bars around it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BandDetail {
    /// Column of `history.csv`.
    pub column: String,
    /// Its unit.
    pub unit: String,
    /// Output times \[s\].
    pub times: Vec<f64>,
    /// Values on the finest mesh.
    pub values: Vec<f64>,
    /// Half-widths of the bars; none where no bar is claimed.
    pub widths: Vec<Option<f64>>,
}

impl Record {
    /// Adds a refined scene: its runs and bars as rows, its table, pictures and curves beside them.
    pub fn push_refined(&mut self, refined: &SceneBars, runs: &Runs, threads: usize) {
        crate::refine::rows::push(self, &refined.scene, runs, Some(refined), threads);
        let mut all: Vec<Figure> = vec![];
        let mut curves: Vec<BandDetail> = vec![];
        for judged in &refined.judged {
            all.push(Figure {
                caption: format!(
                    "{} over the meshes; a straight line is asymptotic.",
                    judged.quantity.name
                ),
                chart: figures::settling(refined, judged, runs),
            });
            if curves
                .iter()
                .any(|curve| curve.column == judged.quantity.column)
            {
                continue;
            }
            all.extend(figures::history(refined, judged, runs).map(|chart| Figure {
                caption: format!("{} over time on all meshes.", judged.quantity.column),
                chart,
            }));
            curves.extend(band(refined, judged, runs));
        }
        let findings = show::findings(refined, runs, Paint::NONE);
        self.details.refined.push(RefinedDetail {
            scene: refined.scene.clone(),
            bars: [
                refined
                    .judged
                    .iter()
                    .filter(|judged| judged.bar().is_some())
                    .count(),
                refined.judged.len(),
            ],
            findings,
            table: show::cells(refined),
            figures: all,
            curves,
        });
    }
}

/// The history of a quantity; `None` where it is not all numbers.
fn band(refined: &SceneBars, judged: &QuantityBar, runs: &Runs) -> Option<BandDetail> {
    let column = &judged.quantity.column;
    let values = runs.meshes.last()?.columns.get(column)?;
    let values = values.get(..refined.times.len())?;
    let claimed = judged.bar().is_some();
    values
        .iter()
        .all(|value| value.is_finite())
        .then(|| BandDetail {
            column: column.clone(),
            unit: crate::refine::quantity::unit(column).to_owned(),
            times: refined.times.clone(),
            values: values.to_vec(),
            widths: (judged.curve.iter())
                .map(|bar| (claimed && bar.verdict.claims()).then_some(bar.width))
                .collect(),
        })
}
