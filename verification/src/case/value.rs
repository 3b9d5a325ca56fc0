//! A case: one value that holds the question, the ladder, the method, the scene, the comparison, the gates, and the references that
//! must fail.
//!
//! A case is written as a constant by the functions of [`Case`], each of which adds one part. What it does not add has a default: the
//! default method, no options, no study, no guest.

use proctor_scene::Scene;
use proctor_scene::simulation::Options;

use super::gates::{GateRule, Runs, Scope, TableRule};
use super::ladder::Ladder;
use super::run::Run;
use super::wrong::{Reference, Wrong};
use super::{Measurements, Rung, RungResult, Size, Verdict};
use crate::guest::Guest;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer};

/// The function that builds a scene.
#[derive(Clone, Copy)]
pub(super) enum Build {
    Always(fn(&Rung, &Settings) -> Scene),
    /// Wrong where the reference is: what is wrong is the scene.
    ByReference(fn(&Rung, &Settings, Reference) -> Scene),
    /// A scene from a value that might not be sound, such as a surface.
    Tried(fn(&Rung, &Settings) -> Result<Scene, Failure>),
}

/// The functions that solve a rung.
#[derive(Clone, Copy)]
pub(super) enum Solve {
    /// Steps a simulation of the scene, then compares it with one reference or several.
    Compare {
        step: fn(&mut Run<'_>) -> Result<(), Failure>,
        compare: fn(&mut Run<'_>) -> Result<Measurements, Failure>,
    },
    /// Compares while it steps.
    Run(fn(Run<'_>) -> Result<Measurements, Failure>),
    /// All by itself, with the reference.
    Own(fn(&Rung, Reference, &Options, &mut dyn Observer) -> Result<RungResult, Failure>),
}

/// A study of error against run time: the path of refinement and the errors that are studied.
#[derive(Clone, Copy)]
pub struct Plan {
    /// Name where a case has several studies; else that of the case.
    pub name: Option<&'static str>,
    /// The path of refinement of each size, coarse to fine.
    pub path: Ladder,
    /// Finer rungs, with which the method of the case alone goes on.
    pub own_path: Ladder,
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
            own_path: Ladder::NONE,
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

    /// The same where the method of the case goes on with finer rungs, which would take too long with every method.
    #[must_use]
    pub const fn going_on(mut self, own_path: Ladder) -> Self {
        self.own_path = own_path;
        self
    }

    /// The same with the methods that a size tries.
    #[must_use]
    pub const fn trying(mut self, tries: fn(Size, Method) -> bool) -> Self {
        self.tries = tries;
        self
    }
}

/// The default reason for which no other solver runs a case.
pub(super) const NO_WORD_OF_GUESTS: &str = "the case says nothing of other solvers";

/// The problem of a rung as other solvers can run it, or why there is none.
pub(super) type GuestOf = fn(&Rung) -> Result<Guest, &'static str>;

/// All equal steps of a run.
fn all_steps(run: &mut Run<'_>) -> Result<(), Failure> {
    run.advance()
}

/// A scene with an answer, judged by gates.
#[derive(Clone, Copy)]
pub struct Case {
    pub(super) name: &'static str,
    pub(super) question: &'static str,
    pub(super) ladder: Ladder,
    pub(super) method: fn(&Rung) -> Settings,
    pub(super) scene: Build,
    pub(super) displacements: bool,
    pub(super) residual: bool,
    pub(super) options: fn(&Rung, Reference, Options) -> Options,
    pub(super) prepare: fn(&Rung, Reference),
    pub(super) solve: Solve,
    pub(super) gates: &'static [GateRule],
    pub(super) scope: Scope,
    pub(super) tables: &'static [TableRule],
    pub(super) judge: Option<fn(&Runs<'_>) -> Verdict>,
    pub(super) line: Option<fn(&Rung, &RungResult) -> Option<String>>,
    pub(super) wrong: &'static [Wrong],
    pub(super) refer: Option<fn(&Rung, Reference, &mut RungResult)>,
    pub(super) reference: Reference,
    pub(super) studies: Result<&'static [Plan], &'static str>,
    pub(super) guest_path: Option<&'static Plan>,
    pub(super) guest: Result<GuestOf, &'static str>,
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
            line: None,
            wrong: &[],
            refer: None,
            reference: Reference::CORRECT,
            studies: Err("the case names no path of refinement"),
            guest_path: None,
            guest: Err(NO_WORD_OF_GUESTS),
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
    pub const fn compare(self, compare: fn(&mut Run<'_>) -> Result<Measurements, Failure>) -> Self {
        self.compare_after(all_steps, compare)
    }

    /// Compares a simulation of the scene with the reference after it was stepped by `step`, which knows no reference.
    #[must_use]
    pub const fn compare_after(
        mut self,
        step: fn(&mut Run<'_>) -> Result<(), Failure>,
        compare: fn(&mut Run<'_>) -> Result<Measurements, Failure>,
    ) -> Self {
        self.solve = Solve::Compare { step, compare };
        self
    }

    /// Steps a simulation of the scene to its end, and compares it on the way.
    #[must_use]
    pub const fn run(mut self, run: fn(Run<'_>) -> Result<Measurements, Failure>) -> Self {
        self.solve = Solve::Run(run);
        self
    }

    /// Solves a rung without a simulation of its scene, or with more than one.
    #[must_use]
    pub const fn solve_by(
        mut self,
        solve: fn(&Rung, Reference, &Options, &mut dyn Observer) -> Result<RungResult, Failure>,
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

    /// A line for the record of each run that has one, which judges nothing.
    #[must_use]
    pub const fn line_of_each(mut self, line: fn(&Rung, &RungResult) -> Option<String>) -> Self {
        self.line = Some(line);
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
    pub const fn refer_by(mut self, refer: fn(&Rung, Reference, &mut RungResult)) -> Self {
        self.refer = Some(refer);
        self
    }

    /// Studies of error against run time.
    #[must_use]
    pub const fn studies(mut self, studies: &'static [Plan]) -> Self {
        self.studies = Ok(studies);
        self
    }

    /// Reason for which nothing of it can be studied with other settings.
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

    /// The path along which other solvers run it, where nothing of it is studied with other settings.
    #[must_use]
    pub const fn guests_along(mut self, path: &'static Plan) -> Self {
        self.guest_path = Some(path);
        self
    }

    /// Reason for which no other solver can run it, in words that follow the name of the case.
    #[must_use]
    pub const fn no_guest(mut self, reason: &'static str) -> Self {
        self.guest = Err(reason);
        self
    }
}
