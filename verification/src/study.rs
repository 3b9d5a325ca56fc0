//! What a case must offer to be studied with settings other than its own: error against run time.

use proctor_kernel::scene::{Scene, StressScheme, TransferKind, Weighting};
use proctor_kernel::simulation::{Options, Simulation};

use crate::case::{self, Case, CaseError, Rung, Size, Solved};
use crate::settings::{Method, Settings};

/// What a run is doing; run time means [`Phase::Stepping`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// From the scene to the first step.
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

    /// Whether the run shall end at the next step, with an error.
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

/// Why a run ended that its observer stopped.
pub const STOPPED: &str = "stopped";

/// An error that is studied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    /// One word for tables, records and file names: `displacement`, `stress`, `velocity`.
    pub word: &'static str,
    /// Name of the quantity in [`Solved::quantities`] whose relative error it is.
    pub quantity: &'static str,
}

/// What a run with chosen settings gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Studied {
    /// Errors, numbers of particles and steps.
    pub solved: Solved,
    /// Largest time step \[s\].
    pub dt: f64,
    /// Smallest critical time step of the kernel's bound \[s\].
    pub dt_critical: f64,
}

impl Studied {
    /// With the time steps that the simulation took.
    #[must_use]
    pub fn new(solved: Solved, simulation: &Simulation) -> Self {
        let (_, dt, dt_critical) = simulation.time_steps();
        Self {
            solved,
            dt,
            dt_critical,
        }
    }
}

/// A case whose problem can be solved with any settings.
pub trait Study: Case {
    /// The path of refinement, coarse to fine, each rung half the cell size of the one before.
    fn path(&self, size: Size) -> Vec<Rung>;

    /// Errors that are studied: displacement (or velocity) first.
    fn measures(&self) -> &'static [Measure];

    /// Whether a study of a size tries a method. Where runs take long, the short study keeps to a few ([`few`]).
    fn tries(&self, _size: Size, _method: Method) -> bool {
        true
    }

    /// Number of axes that refinement multiplies cells along: cost grows like `h^-(d+1)`.
    fn refined_axes(&self) -> usize;

    /// The settings with which [`Case::solve`] runs a rung.
    fn own_settings(&self, rung: &Rung) -> Settings;

    /// The scene of a rung with settings.
    fn scene_with(&self, rung: &Rung, settings: &Settings) -> Scene;

    /// Runs [`Study::scene_with`] and compares it with the exact solution.
    ///
    /// # Errors
    /// [`CaseError`] if the scene is refused, a step fails, a static answer is not reached, or the observer stops
    /// the run.
    fn solve_with(
        &self,
        rung: &Rung,
        settings: &Settings,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Studied, CaseError>;
}

/// For [`Study::tries`] where runs take long: the full study tries every method, the short one the default and MUSL
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
pub fn all() -> Vec<&'static dyn Study> {
    let studies = case::all().iter().filter_map(|case| case.studies().ok());
    studies.flatten().collect()
}
