//! The choice of the time step.

use super::Simulation;
use super::error::{StepError, StepErrorKind, Unstable};
use super::interaction::Interaction;
use super::phase::Phase;
use super::step::Watcher;
use crate::scene::{StressScheme, TimeStep, TransferKind, Weighting};

/// Share of the critical step that an automatic step takes.
const AUTOMATIC_SHARE: f64 = 0.8;
/// Share of the step in which a gap of mortar contact closes as far as it may: surfaces speed up within a step, most of
/// all where light nodes carry them.
const CLOSING_SHARE: f64 = 0.5;
/// Cells that a particle may cross in one step.
const MOST_CELLS_PER_STEP: f64 = 0.5;

/// Time and step counter of a simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Steps done.
    pub step: u64,
    /// Time of positions and stresses \[s\].
    pub time: f64,
    /// Last time step \[s\]; 0 at the start and after velocities were reset, when they are at `time`.
    pub dt_before: f64,
    /// Smallest step so far \[s\].
    pub dt_min: f64,
    /// Largest step so far \[s\].
    pub dt_max: f64,
    /// Smallest critical step so far \[s\].
    pub dt_critical: f64,
}

/// What decided the time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The stability bound of the scheme, C min(h)/(c + |v|).
    Stability,
    /// No particle crosses more than half a cell.
    Travel,
    /// The multiplier of the scene.
    Multiplier,
    /// The stiffness of mortar contact.
    Contact,
    /// No gap of mortar contact closes by more than half the critical gap.
    Closing,
    /// The scene's constant step.
    Fixed,
    /// Equal steps up to a time at which something is written.
    OutputTime,
}

/// A successful step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepInfo {
    /// Number of the step, from 1.
    pub step: u64,
    /// Time reached \[s\].
    pub time: f64,
    /// Time step \[s\].
    pub dt: f64,
    /// Critical time step \[s\].
    pub dt_critical: f64,
    /// What decided the time step.
    pub bound: Bound,
    /// Kinetic energy at the nodes \[J\] and norm of the unbalanced nodal forces \[N\], where measured.
    pub measured: Option<(f64, f64)>,
    /// Number of nodes at which a contact force acts.
    pub contact_nodes: usize,
}

/// Largest stable C = (c + |v|) dt / min(h) of a scheme, weighting function and transfer.
///
/// Measured: blocks of 3^d cells with 1, 2 and 4 particles per cell and axis, twelve offsets on the grid, velocity
/// noise, 400 steps without growth, two and three dimensions; corners of a body are lighter than its edges and
/// lower the bounds of one dimension. The numbers are the smallest over all of these:
///
/// | | USL | USF, MUSL with FLIP | USF, MUSL with APIC, TPIC |
/// |---|---|---|---|
/// | GIMP | 0.44 | 1.3 | 0.65 |
/// | quadratic B-spline | 0.55 | 1.3 | 0.8 |
/// | linear | none | 0.7 | none |
///
/// The second mapping of USF and MUSL keeps light nodes at the edge of a body calm because the particles hardly feel
/// them; an affine velocity feels them through its gradient and carries them back. GIMP bounds of the first and last
/// column fall like sqrt(`l_p`) below four particles per cell: an almost empty node carries w² = c²/(h `l_p`). Linear
/// functions have no bound in these columns, because a node that only the edge of a body reaches is as light as one
/// likes; 0.7 holds where no node is nearly empty.
///
/// `half_length` is the smallest half-length of a particle domain in cells.
#[must_use]
pub fn stability_number(
    weighting: Weighting,
    scheme: StressScheme,
    transfer: TransferKind,
    half_length: f64,
) -> f64 {
    let small = (8.0 * half_length).sqrt().min(1.0);
    let light_nodes_act = scheme == StressScheme::Usl;
    let affine = transfer != TransferKind::Flip;
    match weighting {
        Weighting::Linear => 0.7,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) if light_nodes_act => 0.44 * small,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) if affine => 0.65 * small,
        Weighting::QuadraticBSpline if light_nodes_act => 0.55,
        Weighting::QuadraticBSpline if affine => 0.8,
        _ => 1.3,
    }
}

/// Whether [`stability_number`] holds for every body. It does not where the bound is `none` in its table: linear
/// functions with USL or an affine transfer, which a nearly empty node can make unstable at any step.
#[must_use]
pub fn has_safe_step(weighting: Weighting, scheme: StressScheme, transfer: TransferKind) -> bool {
    weighting != Weighting::Linear
        || (scheme != StressScheme::Usl && transfer == TransferKind::Flip)
}

impl Simulation {
    /// Critical time step \[s\], its bound, and the numbers behind it.
    fn critical(&self) -> (f64, Bound, f64, f64) {
        let mut wave_speed = 0.0_f64;
        let mut square = 0.0_f64;
        for body in &self.bodies {
            wave_speed = wave_speed.max(body.found.wave_speed());
            square = square.max(body.found.speed_squared);
        }
        let particle_speed = square.sqrt();
        let h = self.scene.mesh.cell[..self.plan.axes]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let stable = self.stability_number() * h / (wave_speed + particle_speed);
        let travel = MOST_CELLS_PER_STEP * h / particle_speed;
        let (critical, bound) = if travel < stable {
            (travel, Bound::Travel)
        } else {
            (stable, Bound::Stability)
        };
        let steps = self.interactions().map(Interaction::time_step);
        let contact = steps.fold(f64::INFINITY, f64::min);
        let (critical, bound) = if contact < critical {
            (contact, Bound::Contact)
        } else {
            (critical, bound)
        };
        (critical, bound, wave_speed, particle_speed)
    }

    /// [`stability_number`] of the scene.
    #[must_use]
    pub fn stability_number(&self) -> f64 {
        let smallest = self
            .bodies
            .iter()
            .flat_map(|body| &body.mapping.half_length[..self.plan.axes])
            .copied()
            .fold(f64::INFINITY, f64::min);
        stability_number(
            self.scene.weighting,
            self.scene.scheme,
            self.scene.transfer.kind,
            smallest,
        )
    }

    /// The step that would be taken now without regard to output times, or why it is refused.
    pub(super) fn propose(&self) -> Result<(f64, f64, Bound), Unstable> {
        let (critical, bound, wave_speed, particle_speed) = self.critical();
        let steps = self.interactions().map(Interaction::closing_step);
        let closing = CLOSING_SHARE * steps.fold(f64::INFINITY, f64::min);
        let (dt, bound, allow) = match self.scene.time_step {
            TimeStep::Automatic if closing < AUTOMATIC_SHARE * critical => {
                (closing, Bound::Closing, false)
            }
            TimeStep::Automatic => (AUTOMATIC_SHARE * critical, bound, false),
            TimeStep::Multiplier {
                multiplier,
                allow_unstable,
            } => {
                let h = self.scene.mesh.cell[..self.plan.axes]
                    .iter()
                    .copied()
                    .fold(f64::INFINITY, f64::min);
                let dt = multiplier * h / (wave_speed + particle_speed);
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
            return Err(Unstable {
                dt,
                critical,
                wave_speed,
                particle_speed,
            });
        }
        Ok((dt, critical, bound))
    }

    /// Time step towards `stop`: a constant one as it is, others so that `stop` is reached in equal steps.
    pub(super) fn choose_time_step(
        &mut self,
        stop: f64,
        ended: Watcher<'_>,
    ) -> Result<StepInfo, StepError> {
        let (most, dt_critical, bound) = self
            .propose()
            .map_err(|unstable| self.error(StepErrorKind::UnstableTimeStep(unstable)))?;
        let clock = &mut self.clock;
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
        // Not a number is no later time either.
        let moves_on = time > clock.time;
        if !moves_on {
            return Err(self.error(StepErrorKind::TimeStands { dt }));
        }
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
        for one in self.interactions() {
            one.refuse_leaps(self, dt)?;
        }
        ended(Phase::TimeStep);
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

    /// Smallest, largest and smallest critical time step so far \[s\].
    #[must_use]
    pub fn time_steps(&self) -> (f64, f64, f64) {
        (self.clock.dt_min, self.clock.dt_max, self.clock.dt_critical)
    }

    pub(super) fn error(&self, kind: StepErrorKind) -> StepError {
        StepError {
            step: self.clock.step + 1,
            time: self.clock.time,
            kind,
        }
    }
}
