//! What a case is: a scene with an exact answer, a ladder of resolutions, and gates that its errors must keep.
//!
//! The same case serves `cargo test` (quick), `proctor verify` (full ladder) and `proctor precision`. Cases know
//! no clocks: who wants the run time of a rung times [`Case::solve`].

use std::fmt;

use proctor_scene::Scene;
use proctor_scene::simulation::{Options, Simulation};

use crate::convergence::ConvergenceTable;
use crate::study::Study;

/// How much of the ladder is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Seconds: for tests and for the command without a verb.
    Quick,
    /// The whole ladder of `proctor verify`: minutes.
    Full,
}

/// One run of a case: a resolution of a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// What tables and messages call it; unique within a case and size.
    pub label: String,
    /// Cell size h \[m\].
    pub cell: f64,
    /// Which problem of the case is solved; a word of the case's own.
    pub variant: &'static str,
}

impl Rung {
    /// The rungs of a variant with so many cells over a length \[m\], which labels call `word`.
    #[must_use]
    pub fn counted(variant: &'static str, word: &str, length: f64, counts: &[u32]) -> Vec<Self> {
        let of = |&count: &u32| Self {
            label: format!("{word}={count}"),
            cell: length / f64::from(count),
            variant,
        };
        counts.iter().map(of).collect()
    }

    /// A cell size \[m\] of a variant.
    #[must_use]
    pub fn new(variant: &'static str, cell: f64) -> Self {
        Self {
            label: format!("{variant} h={cell}"),
            cell,
            variant,
        }
    }

    /// The rungs of several ladders, each a variant with its cell sizes \[m\].
    #[must_use]
    pub fn ladders(ladders: &[(&'static str, &[f64])]) -> Vec<Self> {
        ladders
            .iter()
            .flat_map(|&(variant, cells)| cells.iter().map(move |&cell| Self::new(variant, cell)))
            .collect()
    }
}

/// A number that a run gave, with what it should have been: an error where it has a relative one, a balance where it
/// should be zero and nothing scales it, a figure where nothing exact is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// What it is. [`Case::judge`] finds it by this name.
    pub name: &'static str,
    /// As computed, in `unit`.
    pub value: f64,
    /// Exact value, in `unit`, where one number says it.
    pub exact: Option<f64>,
    /// Relative error, dimensionless.
    pub error: Option<f64>,
    /// SI unit; `1` for a ratio.
    pub unit: &'static str,
}

impl Quantity {
    /// A number with its exact value, which is not zero.
    #[must_use]
    pub fn compared(name: &'static str, value: f64, exact: f64, unit: &'static str) -> Self {
        Self {
            name,
            value,
            exact: Some(exact),
            error: Some((value / exact - 1.0).abs()),
            unit,
        }
    }

    /// A ratio that should be zero and so is its own error.
    #[must_use]
    pub fn of_zero(name: &'static str, value: f64) -> Self {
        Self {
            name,
            value,
            exact: Some(0.0),
            error: Some(value.abs()),
            unit: "1",
        }
    }

    /// A number that should be zero and has no scale to be relative to.
    #[must_use]
    pub fn balance(name: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            exact: Some(0.0),
            ..Self::figure(name, value, unit)
        }
    }

    /// A number of which nothing exact is known.
    #[must_use]
    pub fn figure(name: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            name,
            value,
            exact: None,
            error: None,
            unit,
        }
    }

    /// Whether it should be zero and has no scale to be relative to.
    #[must_use]
    pub fn is_balance(&self) -> bool {
        self.exact == Some(0.0) && self.error.is_none()
    }
}

/// Computed against exact along one coordinate, for pictures; or computed alone, where there is nothing exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What is shown, and where.
    pub title: String,
    /// Name and unit of the coordinate.
    pub abscissa: &'static str,
    /// Name and unit of the quantity.
    pub ordinate: &'static str,
    /// Points in order of the coordinate. Where there are several lines, a point that is not a number parts them.
    pub points: Vec<CurvePoint>,
}

impl Curve {
    /// Whether any point says what should be.
    #[must_use]
    pub fn has_exact(&self) -> bool {
        self.points.iter().any(|p| p.exact.is_finite())
    }
}

/// A point of a [`Curve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The coordinate.
    pub at: f64,
    /// As computed.
    pub computed: f64,
    /// As it should be. A curve that has it nowhere is shown alone.
    pub exact: f64,
}

impl CurvePoint {
    /// Puts points in order and keeps one of those that lie within `width` of each other: particles of one layer of a
    /// problem in one dimension.
    pub fn one_per_place(points: &mut Vec<Self>, width: f64) {
        points.sort_by(|p, q| p.at.total_cmp(&q.at));
        points.dedup_by(|p, q| (p.at - q.at).abs() < width);
    }
}

/// Where bodies are at one time of a run in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// What is shown, and when.
    pub title: String,
    /// Outlines of the bodies, closed \[m\].
    pub bodies: Vec<Vec<[f64; 2]>>,
    /// Rigid lines, open \[m\].
    pub lines: Vec<Vec<[f64; 2]>>,
}

/// What a comparison with the exact solution found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Numbers, each named once.
    pub quantities: Vec<Quantity>,
    /// Pictures of the bodies, where the case has them.
    pub drawings: Vec<Drawing>,
    /// Picture, where the case has one.
    pub curve: Option<Curve>,
}

impl Found {
    /// Numbers, and the picture of them where there is one.
    #[must_use]
    pub fn new(quantities: Vec<Quantity>, curve: Option<Curve>) -> Self {
        Self {
            quantities,
            drawings: vec![],
            curve,
        }
    }
}

/// What a run of one rung gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// Number of particles.
    pub particles: usize,
    /// Number of time steps.
    pub steps: u64,
    /// Time that the run reached \[s\].
    pub time: f64,
    /// Numbers, each named once.
    pub quantities: Vec<Quantity>,
    /// Pictures of the bodies, where the case has them.
    pub drawings: Vec<Drawing>,
    /// Picture, where the case has one.
    pub curve: Option<Curve>,
}

impl Solved {
    /// What was found of a simulation that has run.
    #[must_use]
    pub fn new(found: Found, simulation: &Simulation) -> Self {
        Self {
            particles: simulation.particles(),
            steps: simulation.steps(),
            time: simulation.time(),
            quantities: found.quantities,
            drawings: found.drawings,
            curve: found.curve,
        }
    }

    /// The quantity of that name.
    #[must_use]
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        self.quantities.iter().find(|q| q.name == name)
    }

    /// Relative error of the quantity of that name; NaN where there is none, so that a gate on it fails.
    #[must_use]
    pub fn error(&self, name: &str) -> f64 {
        self.quantity(name)
            .and_then(|q| q.error)
            .unwrap_or(f64::NAN)
    }

    /// Value of the quantity of that name; NaN where there is none.
    #[must_use]
    pub fn value(&self, name: &str) -> f64 {
        self.quantity(name).map_or(f64::NAN, |q| q.value)
    }
}

/// On which side of its bound a gate's value must lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `value <= bound`.
    AtMost,
    /// `value >= bound`.
    AtLeast,
}

impl Relation {
    /// In words: `at most`, `at least`.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::AtMost => "at most",
            Self::AtLeast => "at least",
        }
    }
}

/// A bound that a result must keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// What is bounded, of which variant and resolution.
    pub name: String,
    /// What was found; NaN where it could not be computed.
    pub value: f64,
    /// Which side is right.
    pub relation: Relation,
    /// The bound, in the unit of the value.
    pub bound: f64,
    /// Why this bound.
    pub reason: &'static str,
}

impl Gate {
    /// An upper bound.
    #[must_use]
    pub fn at_most(name: String, value: f64, bound: f64, reason: &'static str) -> Self {
        Self {
            name,
            value,
            relation: Relation::AtMost,
            bound,
            reason,
        }
    }

    /// A lower bound.
    #[must_use]
    pub fn at_least(name: String, value: f64, bound: f64, reason: &'static str) -> Self {
        Self {
            relation: Relation::AtLeast,
            ..Self::at_most(name, value, bound, reason)
        }
    }

    /// Whether the value keeps the bound; NaN does not.
    #[must_use]
    pub fn passed(&self) -> bool {
        match self.relation {
            Relation::AtMost => self.value <= self.bound,
            Relation::AtLeast => self.value >= self.bound,
        }
    }
}

/// What a case says of a ladder that was run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Errors and observed orders, each table with its title.
    pub tables: Vec<(String, ConvergenceTable)>,
    /// Gates; the case passes if all of them do.
    pub gates: Vec<Gate>,
    /// Lines that are shown and judge nothing.
    pub for_the_record: Vec<String>,
    /// Pictures of several runs together.
    pub curves: Vec<Curve>,
}

impl Verdict {
    /// Whether there are gates and all of them pass: a verdict that compared nothing is not green.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.gates.is_empty() && self.gates.iter().all(Gate::passed)
    }
}

/// A rung that could not be solved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseError {
    /// Name of the case.
    pub case: &'static str,
    /// Label of the rung.
    pub rung: String,
    /// What went wrong, with where and when.
    pub reason: String,
}

impl CaseError {
    /// Why a rung of the case of that name could not be solved.
    #[must_use]
    pub fn new(case: &'static str, rung: &Rung, reason: &dyn fmt::Display) -> Self {
        Self {
            case,
            rung: rung.label.clone(),
            reason: reason.to_string(),
        }
    }
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}: {}", self.case, self.rung, self.reason)
    }
}

impl std::error::Error for CaseError {}

/// A scene with an exact answer.
pub trait Case: Sync {
    /// Name on the command line: lower case, words joined by `-`.
    fn name(&self) -> &'static str;

    /// The question that the case answers, in one sentence.
    fn question(&self) -> &'static str;

    /// The runs of a size: variant by variant, each coarse to fine.
    fn rungs(&self, size: Size) -> Vec<Rung>;

    /// The scene of a rung. [`Case::solve`] runs this scene and no other.
    fn scene(&self, rung: &Rung) -> Scene;

    /// What of the case can be solved with any settings, most often the case itself.
    ///
    /// # Errors
    /// The reason why nothing of it can.
    fn studies(&self) -> Result<Vec<&dyn Study>, &'static str>;

    /// Computes what the exact solution of a rung needs and keeps it, so that the time of no run holds it. What fails here
    /// fails again in [`Case::solve`], and is reported there.
    fn prepare(&self, _rung: &Rung) {}

    /// Runs a rung and compares it with the exact solution.
    ///
    /// `options` gives threads and lanes; what the case needs beyond them (displacements, measurements) it switches
    /// on itself. `progress` is called from time to time with the share done, 0 to 1.
    ///
    /// # Errors
    /// [`CaseError`] if the scene is refused, a step fails, or a static answer is not reached.
    fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError>;

    /// Tables and gates over the rungs that were solved, in the order of [`Case::rungs`].
    ///
    /// A rung that is missing (because it failed) makes the gates that need it fail.
    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict;
}

/// All cases, in the order in which they are shown.
#[must_use]
pub fn all() -> &'static [&'static dyn Case] {
    crate::cases::ALL
}

/// The case of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static dyn Case> {
    all().iter().copied().find(|case| case.name() == name)
}
