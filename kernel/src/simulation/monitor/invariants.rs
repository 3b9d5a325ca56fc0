//! The invariant monitor: balances of energy and momentum that hold in every scene, checked during a run.
//!
//! The largest strain of a particle within a step is known after each step, and from it by how much volumes can have
//! changed; the first particle that is crushed or blown up is an event. Energy and momentum are summed in one step
//! of 256 and in the powers of two before, so that the watch costs next to nothing:
//!
//! - what moves and what is strained hold no more energy than the start and the work done have given them; what is
//!   missing was dissipated, what is too much came from nowhere;
//! - the momentum of the particles changes by what the forces at the nodes give them, as long as no body is near a
//!   boundary plane, whose mirror images take part in the mapping.
//!
//! A body force that is a function of position and time does work that nobody sums, and a condition or an interaction of a
//! library user need not tell its work: there the energy is not watched.

use crate::exact_sum::ExactSum;
use crate::layout::Layout;
use crate::model::{OnImbalance, Vector};
use crate::simulation::Cycle;
use crate::simulation::values::{
    Drift, Event, EventKind, Invariant, InvariantMonitor, MOST_GAIN, MOST_INCREMENT,
    MOST_LOST_MOMENTUM, MOST_VOLUME_RATIO, ROUND_OFF, StepError, StepErrorKind, StepInfo,
    Violation,
};

/// Steps from one look at energy and momentum to the next. A look costs about one step, so that this is 0.4 %.
const EVERY: u64 = 256;
/// The first look, which round-off of a start from rest does not disturb.
const FIRST: u64 = 16;

/// The momentum before a step at which is looked, and what the nodes say that it changes by \[kg m/s\].
pub(crate) struct Momentum {
    particles: usize,
    before: Vector,
    change: Vector,
    /// Sum of the magnitudes of all changes.
    scale: f64,
}

impl Cycle {
    /// The invariant monitor.
    #[must_use]
    pub fn invariants(&self) -> &InvariantMonitor {
        &self.state.invariants
    }

    /// True if energy and momentum are checked after a step.
    fn looks_after(step: u64) -> bool {
        let early = (FIRST..EVERY).contains(&step) && step.is_power_of_two();
        early || step.is_multiple_of(EVERY)
    }

    /// Momentum of particles and nodes, for a step at which is looked; velocities of the nodes are final.
    pub(crate) fn momentum_to_watch(&self, step: u64) -> Option<Momentum> {
        (Self::looks_after(step) && !self.near_a_plane()).then(|| {
            let (change, scale) = self.change_at_nodes();
            Momentum {
                particles: self.particles(),
                before: self.free_momentum().0,
                change,
                scale,
            }
        })
    }

    /// Looks at a step that has ended.
    pub(crate) fn watch(&mut self, info: &StepInfo, drift: &Drift) -> Result<(), StepError> {
        let squares = self.state.found.iter().map(|found| found.increment_squared);
        let increment = squares.fold(0.0, f64::max).sqrt();
        self.state.invariants.increment = self.state.invariants.increment.max(increment);
        self.violation(info, Invariant::Increment, increment, MOST_INCREMENT);
        self.watch_volumes(info, increment);
        if Self::looks_after(info.step) {
            self.note_extremes();
            if self.knows_all_work() {
                self.watch_energy(info);
            }
            let count = self.particles();
            let momentum = self.work.momentum.take();
            if let Some(momentum) = momentum.filter(|m| m.particles == count && !drift.reset) {
                self.watch_momentum(info, &momentum);
            }
        }
        match self.state.invariants.violation {
            Some(violation) if self.model.settings.on_imbalance == OnImbalance::Stop => {
                Err(self.error(StepErrorKind::NotTrusted(violation)))
            }
            _ => Ok(()),
        }
    }

    /// True if all work on the bodies is known here.
    pub(crate) fn knows_all_work(&self) -> bool {
        self.model.body_force.is_none() && !self.model.has_own
    }

    /// Notes the first particle that was crushed or blown up. A strain increment G changes a volume by a factor of at least
    /// 1 - D |G|, so that volumes need not be looked at in every step.
    fn watch_volumes(&mut self, info: &StepInfo, increment: f64) {
        let least = 1.0 - self.model.plan.axes as f64 * increment;
        let left = if least > 0.0 {
            self.state.invariants.volume_left + libm::log(least)
        } else {
            f64::NEG_INFINITY
        };
        self.state.invariants.volume_left = left;
        if left > 0.0 {
            return;
        }
        let mut farthest: (f64, Option<(usize, usize)>) = (1.0, None);
        for (index, (set, body)) in self.state.sets.iter().zip(&self.model.bodies).enumerate() {
            let columns = (&set.columns[Layout::VOLUME], &set.columns[Layout::MASS]);
            // What parts may grow as it likes.
            let most = if body.law.parts() { 1.0 } else { f64::INFINITY };
            for (p, (volume, mass)) in columns.0.iter().zip(columns.1).enumerate() {
                let ratio = (volume * body.density / mass).min(most);
                let factor = ratio.max(1.0 / ratio);
                let first =
                    |(_, other): (usize, usize)| set.id[p] < self.state.sets[index].id[other];
                let farther = match farthest {
                    (most, _) if factor > most => true,
                    (most, Some((i, other))) if factor == most && i == index => first((i, other)),
                    _ => false,
                };
                if farther {
                    farthest = (factor, Some((index, p)));
                }
            }
        }
        let at = farthest.1.map(|(set, p)| (set, self.particle_at(set, p)));
        let (factor, at) = self.join_farthest((farthest.0, at));
        self.state.invariants.volume_left = libm::log(MOST_VOLUME_RATIO / factor);
        let Some((set, particle)) = at.filter(|_| factor > MOST_VOLUME_RATIO) else {
            return;
        };
        self.state.invariants.volume_left = f64::INFINITY;
        let ratio = particle.volume * self.model.bodies[set].density / particle.mass;
        self.state.events.push(Event {
            step: info.step,
            time: info.time,
            kind: EventKind::VolumeRatio { particle, ratio },
        });
    }

    fn watch_energy(&mut self, info: &StepInfo) {
        let energy = self.energy_behind();
        let given = self.state.ledger.initial_energy + energy.external_work;
        if self.state.invariants.given == 0.0 {
            let found = self.state.found.iter();
            let waves = found.map(|found| found.wave_speed_squared);
            self.state.invariants.given = ROUND_OFF * self.mass() * waves.fold(0.0, f64::max);
        }
        let invariants = &mut self.state.invariants;
        invariants.given = invariants.given.max(given);
        let gain = -energy.dissipated / invariants.given;
        invariants.gain = invariants.gain.max(gain);
        self.violation(info, Invariant::Energy, gain, MOST_GAIN);
    }

    fn watch_momentum(&mut self, info: &StepInfo, watched: &Momentum) {
        let (after, scale) = self.free_momentum();
        let lost = (0..3)
            .map(|axis| (after[axis] - watched.before[axis] - watched.change[axis]).abs())
            .fold(0.0, f64::max);
        let scale = scale + watched.scale;
        if scale > 0.0 {
            let lost = lost / scale;
            self.state.invariants.lost_momentum = self.state.invariants.lost_momentum.max(lost);
            self.violation(info, Invariant::Momentum, lost, MOST_LOST_MOMENTUM);
        }
    }

    /// Notes the first doubt. A value that is not a number is one.
    fn violation(&mut self, info: &StepInfo, reason: Invariant, value: f64, most: f64) {
        let invariants = &mut self.state.invariants;
        let holds = value <= most;
        if !holds && invariants.violation.is_none() {
            invariants.violation = Some(Violation {
                step: info.step,
                time: info.time,
                reason,
                value,
            });
        }
    }

    /// Momentum of the particles that move freely, and the sum of its magnitudes \[kg m/s\].
    fn free_momentum(&self) -> (Vector, f64) {
        let moves_freely = |index: usize| self.model.bodies[index].motion.is_none();
        let [x, y, z, scale] = self.sums_by_body(moves_freely, |index, p| {
            let set = &self.state.sets[index];
            with_size(set.columns[Layout::MASS][p], set.velocity(p))
        });
        ([x, y, z], scale)
    }

    /// Change of the momentum of all fields that move freely in this step, and the sum of the magnitudes of the changes \[kg
    /// m/s\].
    fn change_at_nodes(&self) -> (Vector, f64) {
        let driven = |body: usize| self.model.bodies[body].motion.is_some();
        let mut sums = [ExactSum::ZERO; 4];
        for (_, line) in self.work.grid.free_nodes(driven) {
            let terms = with_size(line[0], [line[4], line[5], line[6]]);
            for (sum, term) in sums.iter_mut().zip(terms) {
                sum.add(term);
            }
        }
        self.join_sums(&mut sums);
        let [x, y, z, scale] = sums.map(|sum| sum.value());
        ([x, y, z], scale)
    }

    /// True if a particle is so near a boundary plane with a condition that its mirror image takes part in the mapping.
    fn near_a_plane(&self) -> bool {
        let settings = &self.model.settings;
        let mesh = &settings.mesh;
        let axes = self.model.plan.axes;
        let here = (0..axes).any(|axis| {
            let acts = [0, 1].map(|side| settings.plane_acts(axis, side));
            if acts == [false; 2] {
                return false;
            }
            // Half-lengths are at most a cell, and functions reach one cell farther.
            let reach = 2.0 * mesh.cell[axis];
            let low = if acts[0] { reach } else { f64::NEG_INFINITY };
            let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
            let high = if acts[1] {
                extent - reach
            } else {
                f64::INFINITY
            };
            let columns = self.state.sets.iter();
            columns
                .flat_map(|set| &set.columns[Layout::POSITION + axis])
                .any(|x| !(low..=high).contains(x))
        });
        self.holds_anywhere(here)
    }
}

/// The three components of m v and the sum of their magnitudes \[kg m/s\].
fn with_size(mass: f64, velocity: Vector) -> [f64; 4] {
    let [x, y, z] = velocity.map(|v| mass * v);
    [x, y, z, x.abs() + y.abs() + z.abs()]
}
