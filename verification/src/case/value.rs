//! A case: one value that holds the question, the ladder, the method, the scene, the comparison, the gates, and the references that
//! must fail.
//!
//! A case is written as a constant by the functions of [`Case`], each of which adds one part. What it does not add has a default: the
//! default method, no options, no study, no guest.

use proctor_scene::{OnImbalance, Scene};
use proctor_scene::simulation::{Options, Simulation};

use super::gates::{GateRule, Runs, Scope, TableRule, verdict};
use super::ladder::Ladder;
use super::wrong::{Reference, Wrong};
use super::{CaseError, Found, Rung, Size, Solved, Verdict};
use crate::guest::Guest;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer, Phase, Studied, Study};

/// One run of a rung with settings, from its first step to its comparison.
pub struct Run<'a> {
    /// The rung.
    pub rung: &'a Rung,
    /// The settings, its own or those of a study.
    pub settings: &'a Settings,
    /// The reference that it is compared with: the correct one, or a wrong one.
    pub reference: Reference,
    /// The simulation, set up and not yet stepped.
    pub simulation: &'a mut Simulation,
    /// Watches the run.
    pub observer: &'a mut dyn Observer,
    /// Unbalanced force over load that a relaxation left.
    pub residual: f64,
}

impl Run<'_> {
    /// The same run as that of another rung.
    #[must_use]
    pub fn as_rung<'b>(&'b mut self, rung: &'b Rung) -> Run<'b> {
        Run {
            rung,
            settings: self.settings,
            reference: self.reference,
            simulation: self.simulation,
            observer: self.observer,
            residual: self.residual,
        }
    }
}

/// How a scene is built.
#[derive(Clone, Copy)]
enum Build {
    Always(fn(&Rung, &Settings) -> Scene),
    /// Wrong where the reference is: what is wrong is the scene.
    ByReference(fn(&Rung, &Settings, Reference) -> Scene),
    /// From something that might not be sound, such as a surface.
    Tried(fn(&Rung, &Settings) -> Result<Scene, Failure>),
}

/// How a rung is solved.
#[derive(Clone, Copy)]
enum Solve {
    /// Steps a simulation of the scene, then compares it: with several references where that is asked for.
    Compare {
        step: fn(&mut Run<'_>) -> Result<(), Failure>,
        compare: fn(&mut Run<'_>) -> Result<Found, Failure>,
    },
    /// Compares while it steps.
    Run(fn(Run<'_>) -> Result<Found, Failure>),
    /// All by itself, with the reference.
    Own(fn(&Rung, Reference, &Options, &mut dyn Observer) -> Result<Solved, Failure>),
}

/// A study of error against run time: the path of refinement and the errors that are studied.
#[derive(Clone, Copy)]
pub struct Plan {
    /// Name where a case has several studies; else that of the case.
    pub name: Option<&'static str>,
    /// The path of refinement of each size, coarse to fine.
    pub path: Ladder,
    /// Errors that are studied: displacement (or velocity) first.
    pub measures: &'static [Measure],
    /// Number of axes that refinement multiplies cells along.
    pub axes: usize,
    /// The methods that a study of a size tries.
    pub tries: fn(Size, Method) -> bool,
}

impl Plan {
    /// A study along a path that refines along so many axes.
    #[must_use]
    pub const fn new(path: Ladder, measures: &'static [Measure], axes: usize) -> Self {
        Self {
            name: None,
            path,
            measures,
            axes,
            tries: |_, _| true,
        }
    }

    /// The same by a name of its own.
    #[must_use]
    pub const fn named(mut self, name: &'static str) -> Self {
        self.name = Some(name);
        self
    }

    /// The same with the methods that a size tries.
    #[must_use]
    pub const fn trying(mut self, tries: fn(Size, Method) -> bool) -> Self {
        self.tries = tries;
        self
    }
}

/// The problem of a rung as other solvers can run it, or why there is none.
type GuestOf = fn(&Rung) -> Result<Guest, &'static str>;

/// A scene with an answer, judged by gates.
#[derive(Clone, Copy)]
pub struct Case {
    name: &'static str,
    question: &'static str,
    ladder: Ladder,
    method: fn(&Rung) -> Settings,
    scene: Build,
    displacements: bool,
    residual: bool,
    options: fn(&Rung, Reference, Options) -> Options,
    prepare: fn(&Rung, Reference),
    solve: Solve,
    gates: &'static [GateRule],
    scope: Scope,
    tables: &'static [TableRule],
    judge: Option<fn(&Runs<'_>) -> Verdict>,
    wrong: &'static [Wrong],
    refer: Option<fn(&Rung, Reference, &mut Solved)>,
    reference: Reference,
    studies: Result<&'static [Plan], &'static str>,
    guest: Result<GuestOf, &'static str>,
}

impl Case {
    /// A case by its name, lower case with words joined by `-`, and the question that it answers.
    #[must_use]
    pub const fn new(name: &'static str, question: &'static str) -> Self {
        Self {
            name,
            question,
            ladder: Ladder::NONE,
            method: |_| Settings::new(Method::DEFAULT),
            scene: Build::Tried(|_, _| Err("the case has no scene".into())),
            displacements: false,
            residual: false,
            options: |_, _, options| options,
            prepare: |_, _| (),
            solve: Solve::Own(|_, _, _, _| Err("the case compares nothing".into())),
            gates: &[],
            scope: Scope::Ladder,
            tables: &[],
            judge: None,
            wrong: &[],
            refer: None,
            reference: Reference::CORRECT,
            studies: Err("the case names no path of refinement"),
            guest: Err("the case says nothing of other solvers"),
        }
    }

    /// The runs of each size.
    #[must_use]
    pub const fn ladder(mut self, ladder: Ladder) -> Self {
        self.ladder = ladder;
        self
    }

    /// The settings with which the ladder is run; without them those of a scene that chooses nothing.
    #[must_use]
    pub const fn method(mut self, method: fn(&Rung) -> Settings) -> Self {
        self.method = method;
        self
    }

    /// The scene of a rung with settings.
    #[must_use]
    pub const fn scene(mut self, scene: fn(&Rung, &Settings) -> Scene) -> Self {
        self.scene = Build::Always(scene);
        self
    }

    /// The same where not the reference is wrong, but the scene.
    #[must_use]
    pub const fn scene_by(mut self, scene: fn(&Rung, &Settings, Reference) -> Scene) -> Self {
        self.scene = Build::ByReference(scene);
        self
    }

    /// The same where it takes something that might not be sound, such as a surface.
    #[must_use]
    pub const fn tried_scene(
        mut self,
        scene: fn(&Rung, &Settings) -> Result<Scene, Failure>,
    ) -> Self {
        self.scene = Build::Tried(scene);
        self
    }

    /// The simulation keeps displacements.
    #[must_use]
    pub const fn displacements(mut self) -> Self {
        self.displacements = true;
        self
    }

    /// The simulation measures kinetic energy and residual at the nodes.
    #[must_use]
    pub const fn residual(mut self) -> Self {
        self.residual = true;
        self
    }

    /// More options of the simulation: an initial state, a body force, conditions.
    #[must_use]
    pub const fn options(mut self, options: fn(&Rung, Reference, Options) -> Options) -> Self {
        self.options = options;
        self
    }

    /// Computes a reference that takes long and keeps it, so that the time of no run holds it.
    #[must_use]
    pub const fn prepare(mut self, prepare: fn(&Rung, Reference)) -> Self {
        self.prepare = prepare;
        self
    }

    /// Compares a simulation of the scene with the reference after all its equal steps.
    #[must_use]
    pub const fn compare(self, compare: fn(&mut Run<'_>) -> Result<Found, Failure>) -> Self {
        self.compare_after(|run| run.advance(), compare)
    }

    /// Compares a simulation of the scene with the reference after it was stepped by `step`, which knows no reference.
    #[must_use]
    pub const fn compare_after(
        mut self,
        step: fn(&mut Run<'_>) -> Result<(), Failure>,
        compare: fn(&mut Run<'_>) -> Result<Found, Failure>,
    ) -> Self {
        self.solve = Solve::Compare { step, compare };
        self
    }

    /// Steps a simulation of the scene to its end, and compares it on the way.
    #[must_use]
    pub const fn run(mut self, run: fn(Run<'_>) -> Result<Found, Failure>) -> Self {
        self.solve = Solve::Run(run);
        self
    }

    /// Solves a rung without a simulation of its scene, or with more than one.
    #[must_use]
    pub const fn solve_by(
        mut self,
        solve: fn(&Rung, Reference, &Options, &mut dyn Observer) -> Result<Solved, Failure>,
    ) -> Self {
        self.solve = Solve::Own(solve);
        self
    }

    /// Gates on the finest rung and on the whole ladder.
    #[must_use]
    pub const fn gates(self, gates: &'static [GateRule]) -> Self {
        self.gates_of(Scope::Ladder, gates)
    }

    /// Gates on the finest rung and on the ladder of each variant, variant by variant, whose name each gate has first.
    #[must_use]
    pub const fn gates_of_variants(self, gates: &'static [GateRule]) -> Self {
        self.gates_of(Scope::Variants, gates)
    }

    /// Gates on each rung, rung by rung.
    #[must_use]
    pub const fn gates_of_rungs(self, gates: &'static [GateRule]) -> Self {
        self.gates_of(Scope::Rungs, gates)
    }

    const fn gates_of(mut self, scope: Scope, gates: &'static [GateRule]) -> Self {
        self.scope = scope;
        self.gates = gates;
        self
    }

    /// Tables of errors over the rungs of the variants.
    #[must_use]
    pub const fn tables(mut self, tables: &'static [TableRule]) -> Self {
        self.tables = tables;
        self
    }

    /// More gates, tables and lines than data say, after those.
    #[must_use]
    pub const fn judge_by(mut self, judge: fn(&Runs<'_>) -> Verdict) -> Self {
        self.judge = Some(judge);
        self
    }

    /// Wrong references, each of which must break its gates.
    #[must_use]
    pub const fn wrong_references(mut self, wrong: &'static [Wrong]) -> Self {
        self.wrong = wrong;
        self
    }

    /// Compares a run again, where no more than exact values depend on the reference.
    #[must_use]
    pub const fn refer_by(mut self, refer: fn(&Rung, Reference, &mut Solved)) -> Self {
        self.refer = Some(refer);
        self
    }

    /// Studies of error against run time.
    #[must_use]
    pub const fn studies(mut self, studies: &'static [Plan]) -> Self {
        self.studies = Ok(studies);
        self
    }

    /// Why nothing of it can be studied with other settings.
    #[must_use]
    pub const fn no_study(mut self, reason: &'static str) -> Self {
        self.studies = Err(reason);
        self
    }

    /// The problem of a rung of a path as other solvers can run it.
    #[must_use]
    pub const fn guest(mut self, guest: GuestOf) -> Self {
        self.guest = Ok(guest);
        self
    }

    /// Why no other solver can run it, in words that follow the name of the case.
    #[must_use]
    pub const fn no_guest(mut self, reason: &'static str) -> Self {
        self.guest = Err(reason);
        self
    }
}

impl Case {
    /// Name on the command line.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The question that the case answers, in one sentence.
    #[must_use]
    pub const fn question(&self) -> &'static str {
        self.question
    }

    /// The runs of a size: variant by variant, each coarse to fine.
    #[must_use]
    pub fn rungs(&self, size: Size) -> Vec<Rung> {
        self.ladder.rungs(size)
    }

    /// The wrong references of the case.
    #[must_use]
    pub const fn wrong(&self) -> &'static [Wrong] {
        self.wrong
    }

    /// The same case with a wrong reference.
    #[must_use]
    pub const fn with(mut self, wrong: Wrong) -> Self {
        self.reference = Reference::with(wrong);
        self
    }

    /// The settings with which the ladder is run.
    #[must_use]
    pub fn own_settings(&self, rung: &Rung) -> Settings {
        (self.method)(rung)
    }

    /// The scene of a rung with settings.
    ///
    /// # Errors
    /// Why there is none, where it takes something that is not sound.
    pub fn scene_with(&self, rung: &Rung, settings: &Settings) -> Result<Scene, Failure> {
        match self.scene {
            Build::Always(scene) => Ok(scene(rung, settings)),
            Build::ByReference(scene) => Ok(scene(rung, settings, self.reference)),
            Build::Tried(scene) => scene(rung, settings),
        }
    }

    /// The scene of a rung with its own settings.
    ///
    /// # Errors
    /// As [`Case::scene_with`].
    pub fn scene_of(&self, rung: &Rung) -> Result<Scene, Failure> {
        self.scene_with(rung, &self.own_settings(rung))
    }

    /// Computes what the reference of a rung needs and keeps it. What fails here fails again in [`Case::solve`], and is
    /// reported there.
    pub fn prepare_for(&self, rung: &Rung) {
        (self.prepare)(rung, self.reference);
    }

    /// Runs a rung with its own settings and compares it with the reference.
    ///
    /// `options` gives threads and lanes; the case itself switches on what it needs beyond them. `progress` is called from time
    /// to time with the share done, 0 to 1.
    ///
    /// # Errors
    /// [`CaseError`] if the scene is refused, a step fails, or a static answer is not reached.
    pub fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError> {
        let mut observer = |share| progress(share);
        match self.solve {
            Solve::Own(solve) => solve(rung, self.reference, options, &mut observer)
                .map_err(|reason| CaseError::new(self.name, rung, &reason)),
            _ => {
                let settings = self.own_settings(rung);
                let studied = self.solve_with(rung, &settings, options, &mut observer);
                studied.map(|studied| studied.solved)
            }
        }
    }

    /// Runs a rung once with its own settings and compares it with each of several references; `None` where a run is another with
    /// each of them.
    ///
    /// # Errors
    /// As [`Case::solve`].
    pub fn solve_against(
        &self,
        rung: &Rung,
        options: &Options,
        references: &[Reference],
    ) -> Option<Result<Vec<Solved>, CaseError>> {
        if let Some(refer) = self.refer {
            let solved = self.solve(rung, options, &mut |_| ());
            let again = |reference: &Reference, mut solved: Solved| {
                refer(rung, *reference, &mut solved);
                solved
            };
            let all = |solved: Solved| {
                references
                    .iter()
                    .map(|r| again(r, solved.clone()))
                    .collect()
            };
            return Some(solved.map(all));
        }
        let Solve::Compare { step, compare } = self.solve else {
            return None;
        };
        let settings = self.own_settings(rung);
        let solved = self.simulate(rung, &settings, options, &mut |_| (), |mut run| {
            step(&mut run)?;
            let one = |reference: &Reference| {
                run.reference = *reference;
                Ok(Solved::new(compare(&mut run)?, run.simulation))
            };
            references.iter().map(one).collect()
        });
        Some(solved)
    }

    /// Runs a rung with settings and compares it with the reference.
    ///
    /// # Errors
    /// As [`Case::solve`], and if the case has a solver of its own.
    pub fn solve_with(
        &self,
        rung: &Rung,
        settings: &Settings,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Studied, CaseError> {
        self.simulate(rung, settings, options, observer, |mut run| {
            let found = match self.solve {
                Solve::Compare { step, compare } => {
                    step(&mut run)?;
                    compare(&mut run)?
                }
                Solve::Run(compare) => compare(run.as_rung(rung))?,
                Solve::Own(_) => {
                    return Err("the case has a solver of its own, without settings".into());
                }
            };
            Ok(Studied::new(found, run.simulation))
        })
    }

    /// Sets up a simulation of a rung with settings, for `solve`.
    fn simulate<T>(
        &self,
        rung: &Rung,
        settings: &Settings,
        options: &Options,
        observer: &mut dyn Observer,
        solve: impl FnOnce(Run<'_>) -> Result<T, Failure>,
    ) -> Result<T, CaseError> {
        observer.phase(Phase::SetUp);
        let set_up = || {
            let mut scene = self.scene_with(rung, settings)?;
            // What is not to be trusted is not compared.
            scene.on_imbalance = OnImbalance::Stop;
            scene.check()?;
            let options = Options {
                displacement: options.displacement || self.displacements,
                measure: options.measure || self.residual,
                ..options.clone()
            };
            let options = (self.options)(rung, self.reference, options);
            let mut simulation = Simulation::new(&scene, &options)?;
            solve(Run {
                rung,
                settings,
                reference: self.reference,
                simulation: &mut simulation,
                observer,
                residual: f64::NAN,
            })
        };
        set_up().map_err(|reason: Failure| CaseError::new(self.name, rung, &reason))
    }

    /// Tables and gates over the rungs that were solved, in the order of [`Case::rungs`]. A rung that is missing, because it
    /// failed, makes the gates that need it fail.
    #[must_use]
    pub fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let runs = Runs {
            size,
            rungs: &self.rungs(size),
            solved,
            reference: self.reference,
        };
        let mut all = verdict(&runs, self.scope, self.gates, self.tables);
        if let Some(judge) = self.judge {
            let more = judge(&runs);
            all.tables.extend(more.tables);
            all.gates.extend(more.gates);
            all.for_the_record.extend(more.for_the_record);
            all.curves.extend(more.curves);
        }
        all
    }

    /// Its studies of error against run time.
    ///
    /// # Errors
    /// The reason why there are none.
    pub fn studied(&'static self) -> Result<Vec<Study>, &'static str> {
        let plans = self.studies?.iter();
        Ok(plans.map(|plan| Study { case: self, plan }).collect())
    }

    /// The problem of a rung as other solvers can run it.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn guest_of(&self, rung: &Rung) -> Result<Guest, &'static str> {
        self.guest?(rung)
    }
}
