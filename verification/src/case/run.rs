//! Runs of a case: a rung is set up, stepped and compared, and a ladder is judged.

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{OnImbalance, Scene};

use super::gates::{GateRule, Runs, verdict};
use super::value::{Build, Case, NO_WORD_OF_GUESTS, Solve};
use super::wrong::{Reference, Wrong};
use super::{CaseError, Rung, RungResult, Size, Verdict};
use crate::guest::Guest;
use crate::settings::Settings;
use crate::study::{Failure, Observer, Phase, Study, StudyResult};

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

    /// The description of the case at the head of its file, as Markdown: the question, the set-up, the source and what is expected.
    #[must_use]
    pub fn description(&self) -> String {
        let mut all = crate::cases::ALL.iter().zip(crate::cases::HEADS);
        let head = all.find(|(case, _)| case.name == self.name);
        let lines = head.map_or("", |(_, head)| head).lines();
        let plain = |line: &str| line.trim_start_matches("//!").trim_end().to_owned();
        let lines: Vec<String> = lines
            .map(|line| {
                plain(line)
                    .strip_prefix(' ')
                    .map_or_else(String::new, str::to_owned)
            })
            .collect();
        lines.join("\n")
    }

    /// Name of the file of the case below `verification/src/cases`.
    #[must_use]
    pub fn file(&self) -> &'static str {
        let mut all = crate::cases::ALL.iter().zip(crate::cases::FILES);
        let file = all.find(|(case, _)| case.name == self.name);
        file.map_or("", |(_, file)| file)
    }

    /// Names of the quantities that its studies, tables and gates name, each once.
    #[must_use]
    pub fn named_quantities(&self) -> Vec<&'static str> {
        let studied = self.studies.unwrap_or_default().iter();
        let studied = studied.flat_map(|plan| plan.measures).map(|m| m.quantity);
        let tables = self.tables.iter().flat_map(|table| table.names).copied();
        let gates = self.gates.iter().map(GateRule::quantity);
        let mut names: Vec<&'static str> = vec![];
        for name in studied.chain(tables).chain(gates) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// The reason why no other solver can run it, where the case gives one.
    #[must_use]
    pub fn closed_to_guests(&self) -> Option<&'static str> {
        self.guest
            .err()
            .filter(|reason| *reason != NO_WORD_OF_GUESTS)
    }

    /// The reason why no other solver can run it, or why nothing of it is studied, where it names none of the first
    /// kind.
    #[must_use]
    pub fn why_closed(&'static self) -> &'static str {
        let studied = self.studied().err();
        self.closed_to_guests().or(studied).unwrap_or_default()
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
    /// If it needs a value that is not sound.
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
    ) -> Result<RungResult, CaseError> {
        let mut observer = |share| progress(share);
        if let Solve::Own(solve) = self.solve {
            return solve(rung, self.reference, options, &mut observer)
                .map_err(|reason| CaseError::new(self.name, rung, &reason));
        }
        let settings = self.own_settings(rung);
        let studied = self.solve_with(rung, &settings, options, &mut observer);
        studied.map(|studied| studied.solved)
    }

    /// Runs a rung once with its own settings and compares it with each of several references; `None` where a run is another with
    /// each of them. `progress` is called as by [`Case::solve`].
    ///
    /// # Errors
    /// As [`Case::solve`].
    #[must_use]
    pub fn solve_against(
        &self,
        rung: &Rung,
        options: &Options,
        references: &[Reference],
        progress: &mut dyn FnMut(f64),
    ) -> Option<Result<Vec<RungResult>, CaseError>> {
        if let Some(refer) = self.refer {
            let solved = self.solve(rung, options, progress);
            let again = |reference: &Reference, mut solved: RungResult| {
                refer(rung, *reference, &mut solved);
                solved
            };
            let all = |solved: RungResult| {
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
        let mut observer = |share| progress(share);
        let solved = self.simulate(rung, &settings, options, &mut observer, |mut run| {
            step(&mut run)?;
            let one = |reference: &Reference| {
                run.reference = *reference;
                Ok(RungResult::new(compare(&mut run)?, run.simulation))
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
    ) -> Result<StudyResult, CaseError> {
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
            Ok(StudyResult::new(found, run.simulation))
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
    pub fn judge(&self, size: Size, solved: &[(Rung, RungResult)]) -> Verdict {
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
        if let Some(line) = self.line {
            let lines = solved.iter().filter_map(|(rung, run)| line(rung, run));
            all.for_the_record.extend(lines);
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

    /// The paths of its problems for other solvers: those of its studies, or one of its own.
    #[must_use]
    pub fn open(&'static self) -> Vec<Study> {
        let own = |plan| vec![Study { case: self, plan }];
        self.studied()
            .unwrap_or_else(|_| self.guest_path.map_or(vec![], own))
    }

    /// The problem of a rung as other solvers can run it.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn guest_of(&self, rung: &Rung) -> Result<Guest, &'static str> {
        self.guest?(rung)
    }
}
