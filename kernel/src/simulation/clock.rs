//! The choice of the time step.

use super::Cycle;
use super::interactions::Interaction;
use super::phase::Phase;
use crate::laws::UNPRESSED;
use crate::layout::Layout;
use crate::model::{Damping, TimeStep, Vector};
use crate::plan::{AUTOMATIC_SHARE, stability_number};
use crate::simulation::values::{Bound, StepError, StepErrorKind, StepInfo, TimeStepAboveCritical};

/// Share of the step in which a gap of contact closes as far as it may: surfaces speed up within a step, most of
/// all where light nodes carry them.
const CLOSING_SHARE: f64 = 0.5;
/// Share of the critical step under damping that an automatic step takes at most.
const DAMPED_SHARE: f64 = 0.9;
/// Largest step over the one before where interactions bound steps: a contact that lets go for a moment is met again at
/// speeds that it has changed.
const GROWTH: f64 = 2.0;
/// Cells that a particle may cross in one step.
const MOST_CELLS_PER_STEP: f64 = 0.5;

/// The largest stable step where `stable` is that without viscous damping of rate c \[s\]. The force is that of the velocity
/// half a step before, so that v' = (1 - c dt) v - w² dt x, x' = x + dt v', with both roots in the unit circle for
/// w² dt² + 2 c dt <= 4; w is the frequency for which `stable` is 2/w.
fn damped_step(stable: f64, rate: f64) -> f64 {
    if rate > 0.0 {
        4.0 / (rate + (rate * rate + 16.0 / (stable * stable)).sqrt())
    } else {
        stable
    }
}

/// The largest stable step where `stable` is that without local damping of a factor alpha \[s\]. In the fastest motion velocity
/// and force change their signs from step to step, and the force is against the velocity of half a step before, so that
/// -alpha |f| sign(v) is alpha f: it adds to the force, and w² rises to (1 + alpha) w².
fn locally_damped_step(stable: f64, alpha: f64) -> f64 {
    stable / (1.0 + alpha).sqrt()
}

/// The largest stable step where `stable` is that without viscosity \[s\], `speed` the speed of waves and particles \[m/s\]
/// and `diffusivity` the longitudinal viscosity over density \[m²/s\]. The viscous force is that of the velocity half a step
/// before: with w² = c² k² and a rate nu k², w² dt² + 2 nu k² dt <= 4; k is the wave number for which `stable` is 2/(c k), so
/// that dt = (h/c)(sqrt(1 + x²) - x) with x = nu/(c h) and h = c times `stable`.
fn viscous_step(stable: f64, speed: f64, diffusivity: f64) -> f64 {
    if diffusivity > 0.0 {
        let way = speed * stable;
        let both = diffusivity * diffusivity + (speed * way) * (speed * way);
        way * way / (diffusivity + both.sqrt())
    } else {
        stable
    }
}

/// The largest step in which nothing moves by more than `way` \[m\] that has this speed and acceleration: v dt + a dt² is
/// the way.
fn travel_step(way: f64, speed: f64, acceleration: f64) -> f64 {
    if acceleration > 0.0 {
        2.0 * way / (speed + (speed * speed + 4.0 * acceleration * way).sqrt())
    } else {
        way / speed
    }
}

/// Length of a vector.
pub(super) fn length(v: &Vector) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Bounds of a step, and the numbers behind them.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// Critical step without damping \[s\].
    undamped: f64,
    /// Bound that decides.
    bound: Bound,
    /// Critical step of the scheme with it \[s\].
    damped: f64,
    /// Largest wave speed \[m/s\].
    wave_speed: f64,
    /// Largest particle speed \[m/s\].
    particle_speed: f64,
}

impl Limits {
    /// Critical step \[s\].
    fn critical(&self) -> f64 {
        self.undamped.min(self.damped)
    }

    /// The automatic step \[s\]. Light damping leaves it as it would be without.
    fn automatic(&self) -> f64 {
        (AUTOMATIC_SHARE * self.undamped).min(DAMPED_SHARE * self.damped)
    }

    /// Bound that decides the automatic step.
    fn automatic_bound(&self) -> Bound {
        if self.automatic() < AUTOMATIC_SHARE * self.undamped {
            Bound::Damping
        } else {
            self.bound
        }
    }

    /// The step of a multiplier \[s\].
    fn multiple(&self, multiplier: f64, simulation: &Cycle) -> f64 {
        multiplier * simulation.smallest_cell() / (self.wave_speed + self.particle_speed)
    }
}

impl Cycle {
    /// The shortest side of a cell \[m\].
    pub(super) fn smallest_cell(&self) -> f64 {
        let cell = &self.model.settings.mesh.cell[..self.model.plan.axes];
        cell.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The step that would be taken now if nothing interacted \[s\].
    pub(super) fn free_step(&self) -> f64 {
        let limits = self.free_limits();
        match self.model.settings.time_step {
            TimeStep::Automatic => limits.automatic(),
            TimeStep::Multiplier { multiplier, .. } => limits.multiple(multiplier, self),
            TimeStep::Fixed { dt, .. } => dt,
        }
    }

    /// All bounds of a step.
    fn limits(&self) -> Limits {
        let mut limits = self.free_limits();
        let beside = self.free_ground_step();
        if beside < limits.undamped {
            limits = Limits {
                undamped: beside,
                bound: Bound::Stability,
                damped: (limits.damped).min(locally_damped_step(beside, self.local_damping())),
                ..limits
            };
        }
        let steps = self.interactions().map(Interaction::time_step);
        let contact = steps.fold(f64::INFINITY, f64::min);
        if contact < limits.undamped {
            Limits {
                undamped: contact,
                bound: Bound::Contact,
                // Forces of contact are part of what local damping acts on.
                damped: (limits.damped).min(locally_damped_step(contact, self.local_damping())),
                ..limits
            }
        } else {
            limits
        }
    }

    /// The same without interactions.
    fn free_limits(&self) -> Limits {
        let mut wave_speed = 0.0_f64;
        let mut square = 0.0_f64;
        for (index, found) in self.state.found.iter().enumerate() {
            wave_speed = wave_speed.max(match &self.model.bodies[index].water {
                None => found.wave_speed(),
                Some(water) => self.fast_speed(index, water),
            });
            square = square.max(found.speed_squared);
        }
        let particle_speed = square.sqrt();
        let h = self.smallest_cell();
        let stable = self.stability_number() * h / (wave_speed + particle_speed);
        let travel = travel_step(MOST_CELLS_PER_STEP * h, particle_speed, self.acceleration());
        let viscous = viscous_step(
            stable,
            wave_speed + particle_speed,
            self.diffusivity_of_all(),
        );
        let (undamped, bound) = if travel < viscous {
            (travel, Bound::Travel)
        } else if viscous < stable {
            (viscous, Bound::Viscosity)
        } else {
            (stable, Bound::Stability)
        };
        Limits {
            undamped,
            bound,
            damped: locally_damped_step(
                damped_step(viscous, self.viscous_rate()),
                self.local_damping(),
            ),
            wave_speed,
            particle_speed,
        }
    }

    /// Largest rate of viscous damping of a body that moves freely \[1/s\].
    fn viscous_rate(&self) -> f64 {
        let free = self.model.bodies.iter().filter(|b| b.motion.is_none());
        free.map(|body| body.viscous_rate).fold(0.0, f64::max)
    }

    /// Factor of local damping; 0 without.
    fn local_damping(&self) -> f64 {
        match self.model.settings.damping {
            Damping::Local { alpha } => alpha,
            Damping::None | Damping::Viscous { .. } | Damping::Kinetic => 0.0,
        }
    }

    /// Largest longitudinal viscosity of a particle here over its density \[m²/s\].
    pub(super) fn own_diffusivity(&self) -> f64 {
        let mut most = 0.0_f64;
        for (body, set) in self.model.bodies.iter().zip(&self.state.sets) {
            let viscosity = body.law.viscosity();
            if viscosity > 0.0 && body.motion.is_none() {
                let [mass, volume] =
                    [Layout::MASS, Layout::VOLUME].map(|column| &set.columns[column]);
                let specific = volume.iter().zip(mass).map(|(v, m)| v / m);
                let mut specific = specific.fold(0.0, f64::max);
                if body.law.parts() {
                    // Shear stress of what has parted is carried by its share of fluid alone.
                    let unpressed = set.column(UNPRESSED.name).unwrap_or(&[1.0]);
                    let unpressed = unpressed.iter().copied().fold(0.0, f64::max);
                    specific = specific.min(unpressed / body.density);
                }
                most = most.max(viscosity * specific);
            }
        }
        most
    }

    /// Largest acceleration of a particle by gravity and box loads \[m/s²\].
    fn acceleration(&self) -> f64 {
        length(&self.model.settings.gravity) + self.work.load_acceleration
    }

    /// [`stability_number`] of the scene, or the share of it that its bodies bear.
    #[must_use]
    pub fn stability_number(&self) -> f64 {
        let smallest = self
            .model
            .bodies
            .iter()
            .flat_map(|body| &body.mapping.half_length[..self.model.plan.axes])
            .copied()
            .fold(f64::INFINITY, f64::min);
        let bodies = self.model.bodies.iter();
        let share = bodies.map(|body| body.step_share).fold(1.0, f64::min);
        share
            * stability_number(
                self.model.settings.weighting,
                self.model.settings.scheme,
                self.model.settings.transfer.kind,
                smallest,
            )
    }

    /// The longest step after the one before, where an interaction bounds steps by `closing` \[s\].
    fn grown(&self, closing: f64) -> f64 {
        let before = self.state.clock.dt_before;
        if closing < f64::INFINITY && before > 0.0 {
            GROWTH * before
        } else {
            f64::INFINITY
        }
    }

    /// The step that would be taken now without regard to output times, or why it is refused.
    pub(super) fn propose(&self) -> Result<(f64, f64, Bound), TimeStepAboveCritical> {
        let limits = self.limits();
        let (critical, automatic) = (limits.critical(), limits.automatic());
        let steps = self.interactions().map(Interaction::closing_step);
        let closing = CLOSING_SHARE * steps.fold(f64::INFINITY, f64::min);
        let (dt, bound, allow) = match self.model.settings.time_step {
            TimeStep::Automatic if closing < automatic => (closing, Bound::Closing, false),
            TimeStep::Automatic if self.grown(closing) < automatic => {
                (self.grown(closing), Bound::Contact, false)
            }
            TimeStep::Automatic => (automatic, limits.automatic_bound(), false),
            TimeStep::Multiplier {
                multiplier,
                allow_unstable,
            } => {
                let dt = limits.multiple(multiplier, self);
                if closing < dt {
                    (closing, Bound::Closing, allow_unstable)
                } else {
                    (dt, Bound::Multiplier, allow_unstable)
                }
            }
            TimeStep::Fixed { dt, allow_unstable } => (dt, Bound::Fixed, allow_unstable),
        };
        // Round-off must not refuse a step that was chosen to be exactly critical.
        if dt > critical * (1.0 + 1e-9) && !allow {
            return Err(TimeStepAboveCritical {
                dt,
                critical,
                wave_speed: limits.wave_speed,
                particle_speed: limits.particle_speed,
                acceleration: self.acceleration(),
                viscous_rate: self.viscous_rate(),
                local_damping: self.local_damping(),
            });
        }
        Ok((dt, critical, bound))
    }

    /// Time step towards `stop`: a constant one as it is, others so that `stop` is reached in equal steps.
    pub(super) fn choose_time_step(&mut self, stop: f64) -> Result<StepInfo, StepError> {
        let (most, dt_critical, bound) = self
            .propose()
            .map_err(|unstable| self.error(StepErrorKind::UnstableTimeStep(unstable)))?;
        let clock = self.state.clock;
        let step = clock.step + 1;
        let (dt, time, bound) = if bound == Bound::Fixed {
            (most, step as f64 * most, bound)
        } else {
            let remaining = stop - clock.time;
            let steps = (remaining / most * (1.0 - 1e-12)).ceil().max(1.0);
            // A stop so far away that it cannot be counted in steps, or that is past, is no stop.
            let dt = if steps.is_finite() && remaining > 0.0 {
                remaining / steps
            } else {
                most
            };
            let bound = if dt < 0.999 * most {
                Bound::OutputTime
            } else {
                bound
            };
            let last = steps == 1.0 && remaining > 0.0;
            (dt, if last { stop } else { clock.time + dt }, bound)
        };
        // Nothing bounds a step without particles but the time that it is to reach.
        if dt.is_infinite() && self.particles() == 0 {
            return Err(self.error(StepErrorKind::NothingLeft));
        }
        // Not a number is no later time either.
        let moves_on = time > clock.time;
        if !moves_on {
            let kind = self.endless_speed();
            return Err(self.error(kind.unwrap_or(StepErrorKind::TimeStands { dt })));
        }
        let clock = &mut self.state.clock;
        clock.dt_min = if clock.step == 0 {
            dt
        } else {
            clock.dt_min.min(dt)
        };
        clock.dt_max = clock.dt_max.max(dt);
        clock.dt_critical = if clock.step == 0 {
            dt_critical
        } else {
            clock.dt_critical.min(dt_critical)
        };
        let view = self.view();
        self.interactions()
            .try_for_each(|one| one.check_time_step(&view, dt))
            .map_err(|error| self.error(StepErrorKind::Interaction(error)))?;
        self.work.phase_timer.end(Phase::TimeStep);
        Ok(StepInfo {
            step,
            time,
            dt,
            dt_critical,
            bound,
            measured: None,
            contact_nodes: 0,
        })
    }

    /// The particle whose velocity is not finite, if that is why there is no step.
    fn endless_speed(&self) -> Option<StepErrorKind> {
        for (index, set) in self.state.sets.iter().enumerate() {
            let endless = |p: &usize| set.velocity(*p).iter().any(|v| !v.is_finite());
            if let Some(p) = (0..set.len()).find(endless) {
                return Some(StepErrorKind::NotFinite(self.particle_at(index, p)));
            }
        }
        None
    }

    pub(super) fn error(&self, kind: StepErrorKind) -> StepError {
        StepError {
            step: self.state.clock.step + 1,
            time: self.state.clock.time,
            kind,
        }
    }
}
