//! One step of the explicit cycle.

mod interaction_passes;
mod motion;
mod passes;
pub(super) mod rehearsal;
mod relaxation;

use super::Cycle;
use super::interactions::Interaction;
use super::phase::{Phase, PhaseObserver, PhaseTimer};
use crate::laws::tensor::Configuration;
use crate::layout::Layout;
use crate::model::StressScheme;
use crate::simulation::context::Remap;
use crate::simulation::values::{Drift, StepError, StepInfo};
use crate::stage::g2p::{Affine, Task};
use crate::team::{ItemCost, Team};
use std::sync::Arc;

/// The lane of a node at which velocities begin: those of the equation of motion, and those that were mapped again.
const SOLVED: usize = 1;
const REMAPPED: usize = 4;

/// A G2P pass: the part of the update of the particles that it does.
#[derive(Clone, Copy)]
enum Pass {
    /// Velocities, positions, strain and stress.
    All,
    /// Velocities alone.
    Kick,
    /// Positions, and strain from the velocities that were mapped again to the upper lanes.
    MoveAndStrain,
    /// Velocities and positions.
    KickAndMove,
    /// Strain from the velocities that were mapped again at the new positions.
    Strain,
}

impl Cycle {
    /// One step of the cycle, at most to the time `stop` (a constant time step may pass it by less than half a
    /// step).
    ///
    /// Velocities live at half-steps: the first step kicks them by dt/2, later ones by the mean of the two
    /// steps that they join, which is second order also where the step changes.
    ///
    /// # Errors
    /// See [`StepErrorKind`](super::StepErrorKind). The state is not to be used after an error; where particles are such
    /// that no step can go on, each further one gives the same error.
    pub fn step(&mut self, stop: f64) -> Result<StepInfo, StepError> {
        if let Some(error) = &self.work.failed {
            return Err(error.clone());
        }
        let result = self.led(|all| all.step_of_rank(|simulation| simulation.cycle(stop)));
        if let Err(error) = &result
            && error.kind.breaks_particles()
        {
            self.work.failed = Some(error.clone());
        }
        result
    }

    /// Reports the end of each phase of the steps that follow to an observer, or no longer. No bit depends on it.
    pub fn observe_phases(&mut self, observer: Option<PhaseObserver>) {
        self.work.phase_timer = PhaseTimer::new(observer);
    }

    /// The threads that step. Each step hands itself over to a thread of its team and waits for it; a caller that takes many
    /// steps in a row does so within [`Team::lead`], and waits once.
    #[must_use]
    pub fn team(&self) -> Arc<Team> {
        Arc::clone(&self.work.grid.team)
    }

    /// Gives `work` to a thread of the team; the caller does it where there is one slab, and so nothing to share.
    pub(super) fn led<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        if self.work.grid.slabs.len() == 1 {
            return work(self);
        }
        let team = self.team();
        team.lead(|| work(self))
    }

    /// The cycle of a step.
    fn cycle(&mut self, stop: f64) -> Result<StepInfo, StepError> {
        if self.sort_if_stale() {
            self.require_memory_of_nodes()?;
        }
        self.evaluate_body_force();
        if self.has_separate_p2g() {
            self.p2g();
            self.detect_contact()?;
        }
        let mut info = self.choose_time_step(stop)?;
        let mut conditions = self.nodal_conditions(info.dt);
        info.contact_nodes = if self.has_separate_p2g() {
            self.solve(&conditions)?
        } else {
            self.p2g_and_solve(&conditions)?
        };
        let drift = self.drift(&mut info);
        self.move_boundaries(&conditions, &drift);
        self.move_absorbing_planes(&conditions, &drift)?;
        match self.model.plan.scheme {
            StressScheme::Usl => {
                self.g2p(Pass::All, &drift)?;
            }
            StressScheme::Musl => {
                self.g2p(Pass::Kick, &drift)?;
                self.remap(&mut conditions, Remap::OldPositions)?;
                self.g2p(Pass::MoveAndStrain, &drift)?;
            }
            StressScheme::Usf => {
                self.g2p(Pass::KickAndMove, &drift)?;
                self.remap(&mut conditions, Remap::NewPositions)?;
                self.g2p(Pass::Strain, &drift)?;
            }
        }
        self.work.nodal = conditions;
        self.finish(&info, &drift)
    }

    /// A G2P pass: nodal values to the particles, those of the pore water first.
    fn g2p(&mut self, pass: Pass, drift: &Drift) -> Result<(), StepError> {
        self.g2p_of_water(pass, drift)?;
        let time = Some(drift.time);
        let remap = Task {
            affine: Affine::Leave,
            ..self.g2p_task(None, None)
        };
        self.run_g2p(match pass {
            Pass::All => Task {
                kick: true,
                mesh_shift: drift.mesh_shift,
                ..self.g2p_task(time, time)
            },
            Pass::Kick => Task {
                kick: true,
                ..self.g2p_task(None, None)
            },
            Pass::MoveAndStrain => Task {
                gradient_of_upper: true,
                affine: Affine::Leave,
                mesh_shift: drift.mesh_shift,
                ..self.g2p_task(time, time)
            },
            Pass::KickAndMove => Task {
                kick: true,
                mesh_shift: drift.mesh_shift,
                ..self.g2p_task(time, None)
            },
            Pass::Strain => Task {
                strain: Some((drift.time, Configuration::End)),
                ..remap
            },
        })?;
        self.work.phase_timer.end(Phase::G2p);
        Ok(())
    }

    /// The pore water's part of a G2P pass: its velocities, and its pressure by the velocities by which the skeleton is strained.
    fn g2p_of_water(&mut self, pass: Pass, drift: &Drift) -> Result<(), StepError> {
        match pass {
            Pass::All => self.gather_water(true, Some((drift.time, SOLVED))),
            Pass::Kick => self.gather_water(true, None),
            Pass::MoveAndStrain => self.gather_water(false, Some((drift.time, REMAPPED))),
            // No water goes with USF.
            Pass::KickAndMove | Pass::Strain => Ok(()),
        }
    }

    /// The task of a G2P pass that moves particles over `drift` and strains them over `strain` \[s\].
    pub(super) fn g2p_task(&self, drift: Option<f64>, strain: Option<f64>) -> Task {
        Task {
            kick: false,
            pic_fraction: self.model.settings.transfer.pic_fraction,
            drift,
            mesh_shift: [0.0; 3],
            strain: strain.map(|dt| (dt, Configuration::Beginning)),
            gradient_of_upper: false,
            affine: self.model.plan.affine,
        }
    }

    /// The displacement increment of this step: over its time, or back to a peak of kinetic energy. Notes the kinetic energy
    /// and residual norm of the step, where measured.
    fn drift(&mut self, info: &mut StepInfo) -> Drift {
        let sums = self.work.sums;
        let measured = (sums.kinetic, sums.unbalanced_squared.sqrt());
        info.measured = self.model.plan.measure.then_some(measured);
        self.work.momentum = self.momentum_to_watch(info.step);
        let relaxed = self.peak_of_kinetic_energy(info);
        let time = relaxed.unwrap_or(info.dt);
        Drift {
            time,
            mesh_shift: self.mesh_velocity(info).map(|v| v * time),
            reset: relaxed.is_some(),
        }
    }

    /// Evaluates the body force at the positions of this step.
    pub(super) fn evaluate_body_force(&mut self) {
        let Some(body_force) = &self.model.body_force else {
            return;
        };
        let (time, start_origin, origin) = (
            self.state.clock.time,
            self.model.settings.mesh.origin,
            self.origin(),
        );
        for set in &mut self.state.sets {
            let axes = set.layout.axes;
            let (Some(force), Some(start)) = (set.layout.force, set.layout.displacement_origin)
            else {
                continue;
            };
            let evaluate = |p: usize| {
                let global = |x: [f64; 3], origin: [f64; 3]| {
                    std::array::from_fn(|axis| x[axis] + origin[axis])
                };
                body_force(
                    &global(set.vector(start, p), start_origin),
                    &global(set.position(p), origin),
                    time,
                )
            };
            let (team, values) = (&self.work.grid.team, &mut self.work.forces);
            team.fill(0..set.len(), ItemCost::Small, evaluate, &[0.0; 3], values);
            for axis in 0..axes {
                let mut out = std::mem::take(&mut set.columns[force + axis]);
                let masses = &set.columns[Layout::MASS];
                for ((out, value), m) in out.iter_mut().zip(&*values).zip(masses) {
                    *out = m * value[axis];
                }
                set.columns[force + axis] = out;
            }
        }
    }

    /// Ends a step: moves driven bodies and the mesh, updates the energy balance and the clock, resets velocities at a peak of
    /// kinetic energy, and checks the invariants.
    fn finish(&mut self, info: &StepInfo, drift: &Drift) -> Result<StepInfo, StepError> {
        self.move_driven_bodies(info, &drift.mesh_shift)?;
        self.state.mesh_shift =
            std::array::from_fn(|axis| self.state.mesh_shift[axis] + drift.mesh_shift[axis]);
        self.update_energy(drift);
        if self.state.clock.step == 0 {
            // Gaps are first measured in the first step, at the positions of the start.
            let stored: f64 = self.interactions().map(Interaction::energy).sum();
            self.state.ledger.initial_energy += stored;
        }
        self.note_end_of_record(info);
        self.state.clock.step = info.step;
        self.state.clock.time = info.time;
        self.state.clock.dt_before = info.dt;
        if drift.reset {
            self.state.ledger.damping += self.kinetic_energy();
            self.stop_motion();
        }
        self.watch(info, drift)?;
        self.watch_tension(info)?;
        self.compare_ghosts(info.step)?;
        self.work.phase_timer.end(Phase::Finish);
        Ok(*info)
    }
}
