//! Tension that FLIP does not hold with MUSL or USF: watched, and a run stops before a body is torn.
//!
//! Positions move with the velocity of the equation of motion, while strain follows the one that was mapped to the particles
//! and back. Particles so go a part of their way that no strain sees. A tensile stress sigma changes the forces at the nodes
//! in the direction of that way (a negative geometric stiffness), so that in each step it grows by up to sigma/rho (dt/h)²
//! of itself: at any step, since a smaller one only delays it. Compression takes it back. With USL strain sees all of the
//! way, and an affine velocity leaves hardly any of it out; both hold.
//!
//! The growth of each particle is summed, less what compression takes back. Once it has grown by e, the kinetic energy that
//! no node sees is measured. The run stops where that is a share of all energy, still grows, the particle is in tension, and the
//! energy balance shows energy from nowhere, or the share is large and grows fast. Particles are looked at when the strains since
//! the last look may have let the growth rise, so that a calm run does not pay. Two kinds of runs are not watched, as they make energy for another reason: linear
//! functions, whose particles cross cells, and steps beyond the critical one. The sums are in no checkpoint: they begin anew.

use super::Cycle;
use crate::exact_sum::ExactSum;
use crate::layout::Layout;
use crate::model::{CycleSettings, StressScheme, Weighting};
use crate::particles::ParticleSet;
use crate::plan::loses_tension;
use crate::simulation::values::{
    MOST_UNSEEN, ParticleAt, StepError, StepErrorKind, StepInfo, Tension,
};
use nalgebra::Matrix3;

/// Growth, as a logarithm, that may be missed between two looks at the particles.
const MISSED: f64 = 0.25;
/// Growth, as a logarithm, from which on the energy that no node sees is measured.
const BEGUN: f64 = 1.0;
/// Growth, as a logarithm, from which on a run may be stopped.
const GROWN: f64 = 3.0;
/// Share of the energy in motion that no node sees above which a run is stopped without energy from nowhere, which damping and
/// a load on what is torn hide; only where tension drives it by [`FAST`], as bodies that turn have such shares, too.
const TORN: f64 = 0.15;
/// Growth in a step from which a large share stops a run by itself. Turning and colliding bodies have 0.01.
const FAST: f64 = 0.05;
/// Energy from nowhere, over the energy that there was to turn over, above which a run is stopped: FLIP gains up to 0.03 in
/// sound scenes that turn or collide.
pub(crate) const MOST_CREATED: f64 = 0.05;
/// Factor over the least share since the growth began above which it is taken to grow: noise of an impact stays what it is.
const RISEN: f64 = 2.0;
/// Growth, as a logarithm, within which the share must rise so: a share that rises more slowly than tension drives it has another
/// cause, as that of a disc that spins with USF.
const MEANWHILE: f64 = 2.0;
/// Largest change of a principal stress over density, for a unit of strain, over the square of the wave speed.
const STIFFEST: f64 = 1.5;

/// The growth of the particles of a body, as logarithms, by identifier from the first. Zeros take no memory before they
/// are first written.
#[derive(Debug)]
struct Growth {
    first: u64,
    logarithm: Vec<f64>,
}

/// The growth of all particles, and what happened since they were looked at.
#[derive(Debug)]
pub(crate) struct TensionWatch {
    bodies: Vec<Growth>,
    /// Largest principal stress over density at the last look \[m²/s²\]; infinite before the first.
    tension: f64,
    /// The rise that strains may have added since \[m²/s²\].
    risen: f64,
    /// Sum of (dt/h)² since \[s²/m²\].
    time: f64,
    /// Bound of the growth since.
    bound: f64,
    /// Least share of energy that no node saw since the growth began, and the growth at that time.
    least: LeastShares,
}

/// The least share of energy that no node saw of late, and the largest growth of a particle, as a logarithm, at that time.
#[derive(Clone, Copy, Debug)]
struct LeastShares {
    unseen: f64,
    logarithm: f64,
}

impl LeastShares {
    /// Before the growth began.
    const NONE: Self = Self {
        unseen: f64::INFINITY,
        logarithm: 0.0,
    };

    /// True where the share has risen since; takes a share that is less, and one behind which too much growth lies.
    fn rises(&mut self, unseen: f64, logarithm: f64) -> bool {
        let risen = unseen > RISEN * self.unseen;
        if unseen < self.unseen || logarithm > self.logarithm + MEANWHILE {
            *self = Self { unseen, logarithm };
        }
        risen
    }
}

impl TensionWatch {
    /// Growth of a particle of a body, as a logarithm.
    pub(super) fn growth(&self, body: usize, id: u64) -> f64 {
        let Growth { first, logarithm } = &self.bodies[body];
        let place = id.wrapping_sub(*first) as usize;
        logarithm.get(place).copied().unwrap_or(0.0)
    }

    /// Sets it, for a particle that comes from another rank.
    pub(super) fn set_growth(&mut self, body: usize, id: u64, growth: f64) {
        let Growth { first, logarithm } = &mut self.bodies[body];
        if let Some(own) = logarithm.get_mut(id.wrapping_sub(*first) as usize)
            && *own != growth
        {
            *own = growth;
        }
    }

    /// The watch of bodies at the start; `None` where the method holds, and with linear functions.
    /// Bodies by their first and last identifier.
    pub(super) fn new(settings: &CycleSettings, bodies: &[[u64; 2]]) -> Option<Self> {
        let of = |&[first, last]: &[u64; 2]| Growth {
            first,
            logarithm: vec![0.0; (last + 1).saturating_sub(first) as usize],
        };
        let watched = loses_tension(settings.transfer, settings.scheme)
            && settings.weighting != Weighting::Linear;
        watched.then(|| Self {
            bodies: bodies.iter().map(of).collect(),
            tension: f64::INFINITY,
            risen: 0.0,
            time: 0.0,
            bound: 0.0,
            least: LeastShares::NONE,
        })
    }
}

/// The particle whose way has grown most.
#[derive(Clone, Copy)]
pub(super) struct LargestStretch {
    pub(super) set: usize,
    pub(super) particle: ParticleAt,
    pub(super) logarithm: f64,
    pub(super) stress: f64,
    /// Stress over density \[m²/s²\].
    pub(super) specific: f64,
}

impl Cycle {
    /// Looks at the tension after a step, where the method may lose it.
    pub(super) fn watch_tension(&mut self, info: &StepInfo) -> Result<(), StepError> {
        let Some(mut watch) = self.work.tension.take() else {
            return Ok(());
        };
        let result = self.look_at_tension(&mut watch, info);
        self.work.tension = Some(watch);
        result
    }

    fn look_at_tension(
        &mut self,
        watch: &mut TensionWatch,
        info: &StepInfo,
    ) -> Result<(), StepError> {
        let courant = info.dt / self.smallest_cell();
        let rate = courant * courant;
        let rises = self.state.found.iter();
        let rises = rises.map(|f| f.increment_squared.sqrt() * f.wave_speed_squared);
        watch.risen += STIFFEST * rises.fold(0.0, f64::max);
        watch.time += rate;
        watch.bound += (watch.tension + watch.risen) * rate;
        // Not a number is looked at, too.
        if watch.bound <= MISSED || info.dt > info.dt_critical {
            return Ok(());
        }
        let worst = self.grow(watch);
        let Some(worst) = worst.filter(|worst| worst.logarithm >= BEGUN) else {
            watch.least = LeastShares::NONE;
            return Ok(());
        };
        let unseen = self.unseen_share();
        let risen = watch.least.rises(unseen, worst.logarithm);
        let grows = worst.logarithm >= GROWN && worst.stress > 0.0;
        if !grows || unseen <= MOST_UNSEEN || !risen {
            return Ok(());
        }
        let created = self.created_share();
        let torn = unseen > TORN && worst.specific * rate > FAST;
        if created <= MOST_CREATED && !torn {
            return Ok(());
        }
        Err(self.error(StepErrorKind::Tension(Tension {
            particle: worst.particle,
            scheme: self.model.plan.scheme,
            stress: worst.stress,
            growth: worst.specific * rate,
            unseen,
            created,
        })))
    }

    /// Energy from nowhere over the energy that there was to turn over; 0 where not all work is known, and where a law without an energy
    /// at large strain makes it.
    fn created_share(&mut self) -> f64 {
        let strained = self.exceeded_range(&self.extremes()).is_some();
        if strained || !self.knows_all_work() {
            return 0.0;
        }
        let energy = self.energy();
        -energy.remainder / self.scale_of_energy(&energy)
    }

    /// Adds the growth since the last look; the particle that has grown most, the first of them by its identifier.
    fn grow(&self, watch: &mut TensionWatch) -> Option<LargestStretch> {
        let mut worst: Option<(usize, LargestStretch)> = None;
        let mut most = 0.0_f64;
        for (set, growth) in watch.bodies.iter_mut().enumerate() {
            if self.model.bodies[set].motion.is_some() {
                continue;
            }
            let particles = &self.state.sets[set];
            for p in 0..particles.len() {
                // Ghosts, too: they grow as their owners do.
                let stress = largest_principal(particles, p);
                let [volume, mass] =
                    [Layout::VOLUME, Layout::MASS].map(|column| particles.columns[column][p]);
                let specific = stress * volume / mass;
                most = most.max(specific);
                let place = particles.id[p].wrapping_sub(growth.first) as usize;
                let Some(logarithm) = growth.logarithm.get_mut(place) else {
                    continue;
                };
                let grown = (*logarithm + specific * watch.time).max(0.0);
                if grown != *logarithm {
                    *logarithm = grown;
                }
                let more = worst.is_none_or(|(at, w)| {
                    let same = *logarithm == w.logarithm && set == w.set;
                    *logarithm > w.logarithm || same && particles.id[p] < particles.id[at]
                });
                if more {
                    let stretch = LargestStretch {
                        set,
                        particle: self.particle_at(set, p),
                        logarithm: *logarithm,
                        stress,
                        specific,
                    };
                    worst = Some((p, stretch));
                }
            }
        }
        self.join_most(std::slice::from_mut(&mut most));
        watch.tension = most;
        (watch.risen, watch.time, watch.bound) = (0.0, 0.0, 0.0);
        self.join_stretch(worst.map(|(_, stretch)| stretch))
    }

    /// Share of kinetic and strain energy in velocities of particles that a mapping to the nodes takes away.
    fn unseen_share(&self) -> f64 {
        let kinetic = self.kinetic_energy();
        let all = kinetic + self.strain_energy();
        let unseen = kinetic - self.kinetic_energy_after_second_mapping();
        if all > 0.0 {
            unseen.max(0.0) / all
        } else {
            0.0
        }
    }

    /// Kinetic energy at the nodes of the velocities that were mapped a second time \[J\].
    fn kinetic_energy_after_second_mapping(&self) -> f64 {
        let first = match self.model.plan.scheme {
            StressScheme::Musl => 4,
            StressScheme::Usl | StressScheme::Usf => 1,
        };
        let shape = &self.work.grid.shape;
        let mut sum = ExactSum::ZERO;
        for (_, rows, lines) in self.fields() {
            for plane in self.work.grid.owned.clone() {
                for row in self.work.grid.block().rows {
                    let start = shape.index([plane, row, 0]);
                    for k in rows.span(plane, row) {
                        let line = &lines[start + k];
                        if line[0] > 0.0 && !self.is_ghost([plane, row, k]) {
                            let square: f64 = line[first..first + 3].iter().map(|v| v * v).sum();
                            sum.add(0.5 * line[0] * square);
                        }
                    }
                }
            }
        }
        self.join_sums(std::slice::from_mut(&mut sum));
        sum.value()
    }
}

/// The largest principal stress of a particle in the axes along which it moves \[Pa\].
fn largest_principal(set: &ParticleSet, p: usize) -> f64 {
    let axes = set.layout.axes;
    let at = |i: usize| set.columns[Layout::stress(axes) + i][p];
    if axes == 2 {
        let (mean, half) = (0.5 * (at(0) + at(1)), 0.5 * (at(0) - at(1)));
        return mean + (half * half + at(3) * at(3)).sqrt();
    }
    let [xx, yy, zz, yz, xz, xy] = std::array::from_fn(at);
    // The largest sum of a row is a bound, and compression that it shows needs no more.
    let bound = (xx + xy.abs() + xz.abs())
        .max(yy + xy.abs() + yz.abs())
        .max(zz + xz.abs() + yz.abs());
    if bound <= 0.0 || !bound.is_finite() {
        return bound;
    }
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
        .symmetric_eigenvalues()
        .max()
}
