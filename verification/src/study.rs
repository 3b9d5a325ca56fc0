//! What a case must offer to be studied with settings other than its own: error against run time.
//!
//! A case says what it needs ([`Study::scene_with`], [`Study::options`]) and what it does ([`Study::run`]); what comes before
//! and after is the same for all and stands here, in [`Study::solve_with`].

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{OnImbalance, Scene, StressScheme, TransferKind, Weighting};

use std::error::Error;

use crate::case::{self, Case, CaseError, Found, Rung, Size, Solved};
use crate::guest::Guest;
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

impl Measure {
    /// The error of a quantity, by one word.
    #[must_use]
    pub const fn new(word: &'static str, quantity: &'static str) -> Self {
        Self { word, quantity }
    }
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
    /// What was found of a simulation that has run, with the time steps that it took.
    #[must_use]
    pub fn new(found: Found, simulation: &Simulation) -> Self {
        let (_, dt, dt_critical) = simulation.time_steps();
        Self {
            solved: Solved::new(found, simulation),
            dt,
            dt_critical,
        }
    }
}

/// Why a run has no answer, in words; [`CaseError`] says of which case and rung.
pub type Failure = Box<dyn Error>;

/// A case whose problem can be solved with any settings.
pub trait Study: Case {
    /// The path of refinement, coarse to fine; what an accuracy costs is interpolated between rungs, so no rung has less than half
    /// the cell size of the one before.
    fn path(&self, size: Size) -> Vec<Rung>;

    /// Errors that are studied: displacement (or velocity) first.
    fn measures(&self) -> Vec<Measure>;

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

    /// The same where it takes something that might not be sound, such as a surface, or why there is none.
    ///
    /// # Errors
    /// What is not sound.
    fn try_scene_with(&self, rung: &Rung, settings: &Settings) -> Result<Scene, Failure> {
        Ok(self.scene_with(rung, settings))
    }

    /// What a run asks of the simulation beyond threads and lanes: displacements, measurements, an initial state.
    fn options(&self, _rung: &Rung, options: Options) -> Options {
        options
    }

    /// Runs a simulation of [`Study::scene_with`] to its end and compares it with the exact solution.
    ///
    /// # Errors
    /// A step that fails, a static answer that is not reached, a reference that there is not, an observer that stops the
    /// run.
    fn run(
        &self,
        rung: &Rung,
        settings: &Settings,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<Found, Failure>;

    /// The problem of a rung of the path as other solvers can run it, judged by the first of [`Study::measures`].
    ///
    /// # Errors
    /// The reason why none can, in words that follow the name of the case.
    fn guest(&self, rung: &Rung) -> Result<Guest, &'static str>;

    /// Sets up [`Study::scene_with`] and does [`Study::run`].
    ///
    /// # Errors
    /// [`CaseError`] if the scene is refused, or for what [`Study::run`] says.
    fn solve_with(
        &self,
        rung: &Rung,
        settings: &Settings,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Studied, CaseError> {
        observer.phase(Phase::SetUp);
        let mut solve = || {
            let mut scene = self.try_scene_with(rung, settings)?;
            // What is not to be trusted is not compared.
            scene.on_imbalance = OnImbalance::Stop;
            scene.check()?;
            let options = self.options(rung, options.clone());
            let mut simulation = Simulation::new(&scene, &options)?;
            let found = self.run(rung, settings, &mut simulation, observer)?;
            Ok(Studied::new(found, &simulation))
        };
        solve().map_err(|reason: Failure| CaseError::new(self.name(), rung, &reason))
    }
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
