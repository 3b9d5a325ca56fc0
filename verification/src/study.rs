//! Studies: cases that are run with settings other than their own, for error against run time.

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{StressScheme, TransferKind, Weighting};

use std::error::Error;

use crate::case::{self, Case, CaseError, Measurements, Plan, Rung, RungResult, Size};
use crate::guest::Guest;
use crate::settings::{Method, Settings};

/// The phases of a run; run time means [`Phase::Stepping`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Time from the scene to the first step.
    SetUp,
    /// The explicit cycle and nothing else.
    Stepping,
    /// Comparison with the exact solution, also between steps.
    Comparing,
}

/// Watches a run. Cases know no clocks: who wants times takes them where a phase begins.
pub trait Observer {
    /// A phase begins, and with it the one before ends. A run begins with [`Phase::SetUp`].
    fn phase(&mut self, _phase: Phase) {}

    /// Called from time to time with the share done, 0 to 1.
    fn progress(&mut self, _share: f64) {}

    /// True where the run shall end at the next step, with an error.
    fn stop(&self) -> bool {
        false
    }
}

/// A function of the share done is an observer of progress alone.
impl<F: FnMut(f64)> Observer for F {
    fn progress(&mut self, share: f64) {
        self(share);
    }
}

/// The reason of a run that ended because its observer stopped it.
pub const STOPPED: &str = "stopped";

/// An error that is studied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    /// One word for tables, records and file names: `displacement`, `stress`, `velocity`.
    pub word: &'static str,
    /// Name of the quantity in [`RungResult::quantities`] whose relative error it is.
    pub quantity: &'static str,
}

impl Measure {
    /// The error of a quantity, by one word.
    #[must_use]
    pub const fn new(word: &'static str, quantity: &'static str) -> Self {
        Self { word, quantity }
    }
}

/// Result of a run with chosen settings.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyResult {
    /// Errors, numbers of particles and steps.
    pub solved: RungResult,
    /// Largest time step \[s\].
    pub dt: f64,
    /// Smallest critical time step of the kernel's bound \[s\].
    pub dt_critical: f64,
}

impl StudyResult {
    /// The result of a simulation that has run, with the time steps that it took.
    #[must_use]
    pub fn new(found: Measurements, simulation: &Simulation) -> Self {
        let clock = simulation.clock();
        Self {
            solved: RungResult::new(found, simulation),
            dt: clock.dt_max,
            dt_critical: clock.dt_critical,
        }
    }
}

/// Reason for which a run has no answer, in words; [`CaseError`] says of which case and rung.
pub type Failure = Box<dyn Error>;

/// A problem of a case that can be solved with any settings.
#[derive(Clone, Copy)]
pub struct Study {
    /// The case.
    pub case: &'static Case,
    /// The path of refinement and the errors.
    pub plan: &'static Plan,
}

impl Study {
    /// Its name: that of its case where the case has one study.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.plan.name.unwrap_or(self.case.name())
    }

    /// The path of refinement, coarse to fine; what an accuracy costs is interpolated between rungs, so no rung has less than half
    /// the cell size of the one before.
    #[must_use]
    pub fn path(&self, size: Size) -> Vec<Rung> {
        self.plan.path.rungs(size)
    }

    /// The method of the case.
    #[must_use]
    pub fn own_method(&self, size: Size) -> Option<Method> {
        let rung = self.path(size).into_iter().next()?;
        Some(self.case.own_settings(&rung).method)
    }

    /// The path of refinement of a method: that of the case goes on beyond the others where the plan says so.
    #[must_use]
    pub fn path_of(&self, size: Size, method: Method) -> Vec<Rung> {
        let mut path = self.path(size);
        if self.own_method(size) == Some(method) {
            path.extend(self.plan.own_path.rungs(size));
        }
        path
    }

    /// Errors that are studied: displacement (or velocity) first.
    #[must_use]
    pub fn measures(&self) -> &'static [Measure] {
        self.plan.measures
    }

    /// True for a method that a study of a size tries. Where runs take long, the short study keeps to a few ([`few`]).
    #[must_use]
    pub fn tries(&self, size: Size, method: Method) -> bool {
        (self.plan.tries)(size, method)
    }

    /// Number of axes that refinement multiplies cells along: cost grows like `h^-(d+1)`.
    #[must_use]
    pub fn refined_axes(&self) -> usize {
        self.plan.axes
    }

    /// The problem of a rung of the path as other solvers can run it, judged by the first of [`Study::measures`].
    ///
    /// # Errors
    /// The reason why none can, in words that follow the name of the case.
    pub fn guest(&self, rung: &Rung) -> Result<Guest, &'static str> {
        self.case.guest_of(rung)
    }

    /// Runs a rung of the path with settings and compares it with the exact solution.
    ///
    /// # Errors
    /// [`CaseError`] if the scene is refused, a step fails, a static answer is not reached, or the observer stops the run.
    pub fn solve_with(
        &self,
        rung: &Rung,
        settings: &Settings,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<StudyResult, CaseError> {
        let studied = self.case.solve_with(rung, settings, options, observer);
        studied.map_err(|error| CaseError {
            case: self.name(),
            ..error
        })
    }
}

/// Settings for [`Study::tries`] where runs take long: the full study tries every method, the short one the default and MUSL
/// with APIC, on uGIMP and on B-splines.
#[must_use]
pub fn few(size: Size, method: Method) -> bool {
    let apic = |weighting| Method {
        weighting,
        scheme: StressScheme::Musl,
        transfer: TransferKind::Apic,
    };
    size == Size::Full
        || [
            Method::DEFAULT,
            apic(Weighting::UniformGimp),
            apic(Weighting::QuadraticBSpline),
        ]
        .contains(&method)
}

/// All studies, in the order in which their cases are shown.
#[must_use]
pub fn all() -> Vec<Study> {
    let studies = case::all().iter().filter_map(|case| case.studied().ok());
    studies.flatten().collect()
}

/// All studies, and with them the paths of cases that other solvers run and no study does.
#[must_use]
pub fn open() -> Vec<Study> {
    case::all().iter().flat_map(|case| case.open()).collect()
}
