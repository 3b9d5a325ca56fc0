//! One step of the explicit cycle.

use super::Simulation;
use super::clock::StepInfo;
use super::error::StepError;
use super::interactions::{Again, Interaction};
use super::phase::{Phase, Watcher};
use crate::laws::tensor::Configuration;
use crate::layout::Layout;
use crate::scene::StressScheme;
use crate::stage::g2p::{Affine, Task};
use crate::team::{OfItem, Team};
use std::sync::Arc;

/// How far positions move in a step.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Time over which they move \[s\].
    pub time: f64,
    /// Way of the mesh, to which positions are relative \[m\].
    pub mesh_shift: [f64; 3],
    /// Whether velocities are set to zero after it.
    pub reset: bool,
}

/// What a pass over the particles does with the nodal values.
#[derive(Clone, Copy)]
enum Gather {
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

impl Simulation {
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
        self.step_watched(stop, &mut |_| ())
    }

    /// [`Simulation::step`] with a watcher, who is told of each phase when it has ended.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn step_watched(&mut self, stop: f64, ended: Watcher<'_>) -> Result<StepInfo, StepError> {
        if let Some(error) = &self.work.failed {
            return Err(error.clone());
        }
        let result = self.led(|simulation| simulation.cycle(stop, ended));
        if let Err(error) = &result
            && error.kind.breaks_particles()
        {
            self.work.failed = Some(error.clone());
        }
        result
    }

    /// Who steps. Each step hands itself over to a thread of its team and waits for it; a caller that takes many steps in a
    /// row does so within [`Team::lead`], and waits once.
    #[must_use]
    pub fn team(&self) -> Arc<Team> {
        Arc::clone(&self.work.grid.team)
    }

    /// Has a thread of the team do `work`; the caller does it where there is one slab, and so nothing to share.
    pub(super) fn led<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        if self.work.grid.slabs.len() == 1 {
            return work(self);
        }
        let team = self.team();
        team.lead(|| work(self))
    }

    fn cycle(&mut self, stop: f64, ended: Watcher<'_>) -> Result<StepInfo, StepError> {
        self.sort_if_stale(ended);
        self.map_to_nodes();
        self.find(ended)?;
        let mut info = self.choose_time_step(stop, ended)?;
        let mut acting = self.acting(info.dt);
        info.contact_nodes = self.solve_nodes(&acting, ended)?;
        let way = self.way(&mut info);
        self.advance(&acting, &way, ended);
        match self.decided.plan.scheme {
            StressScheme::Usl => self.gather(Gather::All, &way, ended)?,
            StressScheme::Musl => {
                self.gather(Gather::Kick, &way, ended)?;
                self.map_again(&mut acting, Again::OldPositions, ended)?;
                self.gather(Gather::MoveAndStrain, &way, ended)?;
            }
            StressScheme::Usf => {
                self.gather(Gather::KickAndMove, &way, ended)?;
                self.map_again(&mut acting, Again::NewPositions, ended)?;
                self.gather(Gather::Strain, &way, ended)?;
            }
        }
        self.work.acting = acting;
        self.finish(&info, &way, ended)
    }

    /// A pass over the particles.
    fn gather(&mut self, what: Gather, way: &Way, ended: Watcher<'_>) -> Result<(), StepError> {
        let time = Some(way.time);
        let again = Task {
            affine: Affine::Leave,
            ..self.task(None, None)
        };
        self.interpolate(match what {
            Gather::All => Task {
                kick: true,
                mesh_shift: way.mesh_shift,
                ..self.task(time, time)
            },
            Gather::Kick => Task {
                kick: true,
                ..self.task(None, None)
            },
            Gather::MoveAndStrain => Task {
                gradient_of_upper: true,
                affine: Affine::Leave,
                mesh_shift: way.mesh_shift,
                ..self.task(time, time)
            },
            Gather::KickAndMove => Task {
                kick: true,
                mesh_shift: way.mesh_shift,
                ..self.task(time, None)
            },
            Gather::Strain => Task {
                strain: Some((way.time, Configuration::End)),
                ..again
            },
        })?;
        ended(Phase::ParticlesFromNodes);
        Ok(())
    }

    /// A pass over the particles that moves them by `drift` and strains them by `strain` \[s\].
    pub(super) fn task(&self, drift: Option<f64>, strain: Option<f64>) -> Task {
        Task {
            kick: false,
            pic_fraction: self.decided.scene.transfer.pic_fraction,
            drift,
            mesh_shift: [0.0; 3],
            strain: strain.map(|dt| (dt, Configuration::Beginning)),
            gradient_of_upper: false,
            affine: self.decided.plan.affine,
        }
    }

    /// How far positions move in this step: over its time, or back to a peak of kinetic energy. Notes the kinetic energy
    /// and residual norm of the step, where measured.
    fn way(&mut self, info: &mut StepInfo) -> Way {
        let sums = self.work.sums;
        let measured = (sums.kinetic, sums.unbalanced_squared.sqrt());
        info.measured = self.decided.plan.measure.then_some(measured);
        self.work.momentum = self.momentum_to_watch(info.step);
        let relaxed = self.peak_of_kinetic_energy(info);
        let time = relaxed.unwrap_or(info.dt);
        Way {
            time,
            mesh_shift: self.mesh_velocity(info).map(|v| v * time),
            reset: relaxed.is_some(),
        }
    }

    /// Evaluates the body force at the positions of this step.
    pub(super) fn set_body_force(&mut self) {
        let Some(body_force) = &self.decided.body_force else {
            return;
        };
        let (time, start_origin, origin) = (
            self.state.clock.time,
            self.decided.scene.mesh.origin,
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
            team.fill(0..set.len(), OfItem::Small, evaluate, &[0.0; 3], values);
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

    /// Moves what is driven, advances the clock, keeps the books, looks at the balances, and after a peak of kinetic energy sets velocities to
    /// zero.
    fn finish(
        &mut self,
        info: &StepInfo,
        way: &Way,
        ended: Watcher<'_>,
    ) -> Result<StepInfo, StepError> {
        self.move_driven_bodies(info, &way.mesh_shift)?;
        self.state.mesh_shift =
            std::array::from_fn(|axis| self.state.mesh_shift[axis] + way.mesh_shift[axis]);
        self.keep_books(way);
        if self.state.clock.step == 0 {
            // Gaps are first measured in the first step, at the positions of the start.
            let stored: f64 = self.interactions().map(Interaction::energy).sum();
            self.state.books.initial_energy += stored;
        }
        self.note_end_of_record(info);
        self.state.clock.step = info.step;
        self.state.clock.time = info.time;
        self.state.clock.dt_before = info.dt;
        if way.reset {
            self.state.books.damping += self.kinetic_energy();
            self.stop_motion();
        }
        self.watch(info, way)?;
        self.watch_tension(info)?;
        ended(Phase::Finish);
        Ok(*info)
    }
}
