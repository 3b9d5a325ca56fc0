//! The details of a record beside its flat rows: gates with their reasons, pictures, and plans, so that a page can be
//! made from the record alone.

pub use super::refined::{BandDetail, RefinedDetail};
use super::{key, renamed};
use crate::precision::findings::LineFindings;
use crate::precision::{CaseStudy, Findings};
use crate::show::chart::Chart;
use crate::show::{figures, precision as show};
use crate::stability::StabilityDetail;
use crate::suite::CaseRun;
use proctor_files::run::plan_value;
use proctor_scene::plan::Plan;
use proctor_verification::case::{Curve, Gate, Relation};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Details of a record, in the order in which they were measured. Tools that read Google Benchmark pass over them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Details {
    /// Verification cases.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cases: Vec<CaseDetail>,
    /// Error against run time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub studies: Vec<StudyDetail>,
    /// Plans of scenes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plans: Vec<PlanDetail>,
    /// Stability of each method.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stability: Option<StabilityDetail>,
    /// Scenes with error bars.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub refined: Vec<RefinedDetail>,
}

/// The question of a case and its judgement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseDetail {
    /// Name of the case.
    pub name: String,
    /// The question it answers.
    pub question: String,
    /// Quantities that were compared: the end of their keys in the rows (`error_…`), and their names.
    pub quantities: Vec<[String; 2]>,
    /// Its bounds.
    pub gates: Vec<GateDetail>,
    /// Computed against exact, and errors over the refinements.
    pub figures: Vec<Figure>,
    /// Lines that judge nothing.
    pub for_the_record: Vec<String>,
}

/// A bound, and what was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GateDetail {
    /// The bounded quantity.
    pub name: String,
    /// The value; none where it could not be computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// `at most` or `at least`.
    pub relation: String,
    /// The bound.
    pub bound: f64,
    /// Reason of the bound.
    pub reason: String,
    /// True if it holds.
    pub passed: bool,
}

/// Share of its bound above which a gate that holds is marked as near to failing.
pub const NEAR: f64 = 0.95;

impl GateDetail {
    /// True if the gate holds and uses up nearly all of its bound.
    #[must_use]
    pub fn is_near(&self) -> bool {
        self.passed && self.used() >= NEAR
    }

    /// Share of its bound that the gate uses up, 0 to 1; more where it does not hold, and nothing where the value lies on
    /// the far side of zero or nothing is allowed.
    #[must_use]
    pub fn used(&self) -> f64 {
        let Some(value) = self.value else {
            return f64::INFINITY;
        };
        let (low, high) = if self.relation == Relation::AtLeast.words() {
            (self.bound, value)
        } else {
            (value, self.bound)
        };
        // Of two negative numbers the lower one has the larger magnitude.
        let share = if low < 0.0 && high < 0.0 {
            high / low
        } else {
            low / high
        };
        match (self.passed, share) {
            (true, share) if share > 0.0 => share.min(1.0),
            (true, _) => 0.0,
            (false, share) if share > 1.0 => share,
            (false, _) => f64::INFINITY,
        }
    }
}

/// A picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// Caption of the picture.
    pub caption: String,
    /// Its points, axes and legend.
    pub chart: Chart,
}

/// Error against run time of one error of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyDetail {
    /// Name of the case.
    pub case: String,
    /// The question it answers.
    pub question: String,
    /// Error that is measured.
    pub measure: String,
    /// Error against run time, and convergence of the best lines.
    pub figures: Vec<Figure>,
    /// Lines by their cost, the best first; the headings are the first line.
    pub table: Vec<Vec<String>>,
    /// Best method for each error.
    pub findings: Vec<String>,
}

/// The plan of a scene, as `summary.json` has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanDetail {
    /// Name of the scene.
    pub scene: String,
    /// `kept`, `left_out`, `bytes_per_particle`, `bytes_per_node`.
    pub plan: Value,
}

/// Caption of the chart of error against time.
fn caption(studied: &CaseStudy, measure: usize) -> String {
    let methods = "Error against the time of the stepping loop. Lines refine the mesh, dots change the Courant number or \
                   the particles per cell, the broad band joins the runs that no other beats in both.";
    if studied.peers_of(measure).is_empty() {
        methods.to_owned()
    } else {
        format!(
            "{methods} Diamonds are whole processes, this program's own and those of other solvers."
        )
    }
}

impl Details {
    /// True if there is nothing to print.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cases.is_empty()
            && self.studies.is_empty()
            && self.plans.is_empty()
            && self.stability.is_none()
            && self.refined.is_empty()
    }

    /// Gives gates and quantities their names of today.
    pub(super) fn rename(&mut self) {
        for case in &mut self.cases {
            for [key, name] in &mut case.quantities {
                *key = renamed::key_of_row(key).into_owned();
                *name = renamed::name(name).into_owned();
            }
            for gate in &mut case.gates {
                gate.name = renamed::name(&gate.name).into_owned();
            }
        }
    }

    /// Adds a case that was run. Of each variant the curve of the finest run is kept.
    pub fn push_case(&mut self, ran: &CaseRun) {
        let mut curves: Vec<Figure> = vec![];
        let mut drawings: Vec<Figure> = vec![];
        let mut variant = None;
        let mut quantities: Vec<[String; 2]> = vec![];
        for run in &ran.rungs {
            let Ok(solved) = &run.solved else { continue };
            for q in solved.quantities.iter().filter(|q| q.error.is_some()) {
                let entry = [key(q.name), q.name.to_owned()];
                if !quantities.contains(&entry) {
                    quantities.push(entry);
                }
            }
            drawings.extend(solved.drawings.iter().map(|drawing| Figure {
                caption: format!("{}.", drawing.title),
                chart: figures::drawing(drawing),
            }));
            let Some(curve) = &solved.curve else { continue };
            if variant == Some(run.rung.variant) {
                curves.pop();
            }
            variant = Some(run.rung.variant);
            curves.push(Figure {
                caption: format!(
                    "{} over {}: {}, run {}.",
                    curve.ordinate,
                    curve.abscissa,
                    shown(curve),
                    run.rung.label
                ),
                chart: figures::curve(curve),
            });
        }
        curves.extend(ran.verdict.curves.iter().map(|curve| Figure {
            caption: format!(
                "{} over {}: {}, several runs.",
                curve.ordinate,
                curve.abscissa,
                shown(curve)
            ),
            chart: figures::curve(curve),
        }));
        let refined = ran.verdict.tables.iter();
        let refined = refined.filter(|(_, table)| table.rows().len() > 1);
        let convergence = refined.map(|(title, table)| Figure {
            caption: format!("{title}: errors over the refinements."),
            chart: figures::convergence(&format!("{title}: error against cell size"), table),
        });
        self.cases.push(CaseDetail {
            name: ran.case.name().to_owned(),
            question: ran.case.question().to_owned(),
            quantities,
            gates: ran.verdict.gates.iter().map(gate).collect(),
            figures: curves
                .into_iter()
                .chain(drawings)
                .chain(convergence)
                .collect(),
            for_the_record: ran.verdict.for_the_record.clone(),
        });
    }

    /// Adds error against run time of a case, one study per error that the case tells.
    pub fn push_study(&mut self, studied: &CaseStudy) {
        for (number, measure) in studied.study.measures().iter().enumerate() {
            let findings = Findings::new(studied, number);
            let best: Vec<&LineFindings> = findings.ranked();
            let summary = show::summary(studied, number, false);
            self.studies.push(StudyDetail {
                case: studied.study.name().to_owned(),
                question: studied.study.case.question().to_owned(),
                measure: measure.word.to_owned(),
                figures: vec![
                    Figure {
                        caption: caption(studied, number),
                        chart: figures::error_against_time(studied, number),
                    },
                    Figure {
                        caption: "The cheapest combinations: error over the refinements."
                            .to_owned(),
                        chart: figures::convergence_of_lines(
                            &format!(
                                "{}: {} error against cell size",
                                studied.study.name(),
                                measure.word
                            ),
                            &best,
                            &studied.peers_of(number),
                        ),
                    },
                ],
                table: summary.table.lines().to_vec(),
                findings: summary.best,
            });
        }
    }

    /// Adds the plan of a scene.
    pub fn push_plan(&mut self, scene: &str, plan: &Plan) {
        self.plans.push(PlanDetail {
            scene: scene.to_owned(),
            plan: plan_value(plan),
        });
    }
}

/// A gate as a record keeps it.
#[must_use]
pub fn gate(gate: &Gate) -> GateDetail {
    GateDetail {
        name: gate.name.clone(),
        value: gate.value.is_finite().then_some(gate.value),
        relation: gate.relation.words().to_owned(),
        bound: gate.bound,
        reason: gate.reason.to_owned(),
        passed: gate.passed(),
    }
}

/// Caption of a chart of a curve.
fn shown(curve: &Curve) -> &'static str {
    if curve.has_exact() {
        "computed against exact"
    } else {
        "as computed"
    }
}
