//! Strains with which stresses that are driven are met.
//!
//! Newton's method starts from the strain of the step before, from none and from that of elasticity: where a point unloads,
//! the first is that of the flow before, with the slopes of flow. Its slopes may be none at an edge of a yield surface, so that
//! corrections are the shortest that do; where it comes to a halt, corrections by the elastic stiffness, which no law here is
//! stiffer than, go on; and what a whole step does not meet is gone in parts.

use super::closed_form::constant;
use nalgebra::{DMatrix, DVector};
use proctor_laws::{AnyLaw, Isotropic, Point, PointFault};

/// Most corrections by Newton's method from one start.
const CORRECTIONS: usize = 60;
/// Most halvings of a correction that makes it worse.
const HALVINGS: usize = 30;
/// Most corrections by the elastic stiffness from one start.
const ELASTIC_CORRECTIONS: usize = 2000;
/// Most halvings of a step.
const PARTS: u32 = 7;
/// Share of the largest stress by which one may be missed.
const MISS: f64 = 1e-9;
/// Strain by which the slope of the stress is felt for.
const FEELER: f64 = 1e-8;
/// Slope over the largest one below which it counts as none.
const FLAT: f64 = 1e-7;

/// Components that are driven by their stress.
pub(super) struct DrivenComponents {
    components: Vec<usize>,
    /// Elastic stiffness of all components \[Pa\], of a law that has one.
    stiffness: Option<DMatrix<f64>>,
    /// Least stress that counts \[Pa\]: a strain of round-off.
    least: f64,
}

/// Reason for which a step was not taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StepFailure {
    /// Stresses are missed by so much \[Pa\].
    By(f64),
    /// The law broke.
    Fault(PointFault),
}

impl DrivenComponents {
    /// Specimen of a law, with the components that are driven.
    pub fn of(law: &AnyLaw, stress: [bool; 6]) -> Self {
        let moduli = constant(law, "young").zip(constant(law, "poisson"));
        let stiffness = moduli.map(|(young, poisson)| {
            let elastic = Isotropic::new(young, poisson);
            DMatrix::from_fn(6, 6, |i, j| {
                let swelling = if i < 3 && j < 3 { elastic.lambda } else { 0.0 };
                let own = if i == j { 2.0 * elastic.shear } else { 0.0 };
                swelling + own
            })
        });
        Self {
            components: (0..6).filter(|i| stress[*i]).collect(),
            stiffness,
            least: 1e-15 * law.young(),
        }
    }
}

/// Takes a step of `dt` \[s\] to a stress of the driven components \[Pa\] with the strains of the others in `increment`, into
/// which the strains that were found are written. It is gone in parts where it has to be.
pub(super) fn take(
    driven: &DrivenComponents,
    point: &mut Point,
    target: &[f64; 6],
    increment: &mut [f64; 6],
    dt: f64,
) -> Result<(), StepFailure> {
    let start = point.stress();
    let mut worst = StepFailure::By(f64::INFINITY);
    for halvings in 0..=PARTS {
        let parts = 1_u32 << halvings;
        let part = 1.0 / f64::from(parts);
        let mut ahead = point.clone();
        let mut guess = increment.map(|e| e * part);
        let mut sum = [0.0; 6];
        let gone = (1..=parts).try_for_each(|k| {
            let share = f64::from(k) * part;
            let target = std::array::from_fn(|i| start[i] + share * (target[i] - start[i]));
            let meeting = Meeting {
                driven,
                point: &ahead,
                target,
                dt: dt * part,
            };
            guess = meeting.solve(&guess)?;
            for (sum, one) in sum.iter_mut().zip(guess) {
                *sum += one;
            }
            ahead.strain(&guess, dt * part).map_err(StepFailure::Fault)
        });
        match gone {
            Ok(()) => {
                *point = ahead;
                *increment = sum;
                return Ok(());
            }
            // The whole step says best what is missed.
            Err(missed) if halvings == 0 => worst = missed,
            Err(_) => {}
        }
        if driven.components.is_empty() {
            break;
        }
    }
    Err(worst)
}

/// A step, or a part of one, and the stresses that it must meet.
struct Meeting<'a> {
    driven: &'a DrivenComponents,
    point: &'a Point,
    target: [f64; 6],
    dt: f64,
}

/// Strains, by how much stresses are missed with them \[Pa\], and by how much they may be.
#[derive(Clone)]
struct Trial {
    increment: [f64; 6],
    missed: DVector<f64>,
    enough: f64,
}

impl Trial {
    fn meets(&self) -> bool {
        self.missed.amax() <= self.enough
    }
}

impl Meeting<'_> {
    fn try_out(&self, increment: [f64; 6]) -> Result<Trial, PointFault> {
        let mut ahead = self.point.clone();
        ahead.strain(&increment, self.dt)?;
        let stress = ahead.stress();
        let size = stress.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
        let components = &self.driven.components;
        let missed = components.iter().map(|i| stress[*i] - self.target[*i]);
        Ok(Trial {
            increment,
            missed: DVector::from_iterator(components.len(), missed),
            enough: (MISS * size).max(self.driven.least),
        })
    }

    /// The strains with which the stresses are met.
    fn solve(&self, before: &[f64; 6]) -> Result<[f64; 6], StepFailure> {
        if self.driven.components.is_empty() {
            return Ok(*before);
        }
        let mut none = *before;
        for i in &self.driven.components {
            none[*i] = 0.0;
        }
        let starts = [Some(*before), self.elastic(&none), Some(none)];
        let (mut nearest, mut fault) = (f64::INFINITY, None);
        let mut halted = vec![];
        for start in starts.into_iter().flatten() {
            match self.try_out(start) {
                Ok(trial) => {
                    let found = self.newton(trial.clone());
                    if found.meets() {
                        return Ok(found.increment);
                    }
                    nearest = nearest.min(found.missed.amax());
                    halted.extend([found, trial]);
                }
                Err(broken) => fault = Some(broken),
            }
        }
        for trial in halted {
            let found = self.by_stiffness(trial);
            let found = if found.meets() {
                found
            } else {
                self.newton(found)
            };
            if found.meets() {
                return Ok(found.increment);
            }
            nearest = nearest.min(found.missed.amax());
        }
        Err(match fault {
            Some(fault) if nearest.is_infinite() => StepFailure::Fault(fault),
            _ => StepFailure::By(nearest),
        })
    }

    /// The elastic stiffness of the driven components, with which of them a change of all others goes.
    fn stiffness(&self) -> Option<DMatrix<f64>> {
        let whole = self.driven.stiffness.as_ref()?;
        let of = &self.driven.components;
        Some(DMatrix::from_fn(of.len(), of.len(), |i, j| {
            whole[(of[i], of[j])]
        }))
    }

    /// The strains of elasticity, where those of the driven components are zero in `none`.
    fn elastic(&self, none: &[f64; 6]) -> Option<[f64; 6]> {
        let whole = self.driven.stiffness.as_ref()?;
        let of = &self.driven.components;
        let (stress, others) = (self.point.stress(), whole * DVector::from_row_slice(none));
        let wanted = of.iter().map(|i| self.target[*i] - stress[*i] - others[*i]);
        let wanted = DVector::from_iterator(of.len(), wanted);
        let strain = self.stiffness()?.lu().solve(&wanted)?;
        let mut increment = *none;
        for (i, e) in of.iter().zip(strain.iter()) {
            increment[*i] = *e;
        }
        Some(increment)
    }

    /// Newton's method, its slopes felt for, each correction the shortest and halved until it helps; where it comes to.
    fn newton(&self, mut now: Trial) -> Trial {
        let components = &self.driven.components;
        let n = components.len();
        for _ in 0..CORRECTIONS {
            if now.meets() {
                break;
            }
            let mut slopes = DMatrix::zeros(n, n);
            for (column, i) in components.iter().enumerate() {
                let mut beside = now.increment;
                beside[*i] += FEELER;
                let Ok(there) = self.try_out(beside) else {
                    return now;
                };
                slopes.set_column(column, &((there.missed - &now.missed) / FEELER));
            }
            let parts = slopes.svd(true, true);
            let flat = FLAT * parts.singular_values.amax();
            let Ok(way) = parts.solve(&now.missed, flat) else {
                break;
            };
            let Some(better) = self.shortened(&now, &way) else {
                break;
            };
            now = better;
        }
        now
    }

    /// The first of a correction and its halves that misses less.
    fn shortened(&self, now: &Trial, way: &DVector<f64>) -> Option<Trial> {
        let mut share = 1.0;
        (0..HALVINGS).find_map(|_| {
            let mut next = now.increment;
            for (i, w) in self.driven.components.iter().zip(way.iter()) {
                next[*i] -= share * w;
            }
            share *= 0.5;
            // A law that breaks here may not break half way.
            let there = self.try_out(next).ok()?;
            (there.missed.norm() < now.missed.norm()).then_some(there)
        })
    }

    /// Corrections by the elastic stiffness: slow, but by slopes that no kink of a yield surface changes.
    fn by_stiffness(&self, mut now: Trial) -> Trial {
        let Some(inverse) = self.stiffness().and_then(DMatrix::try_inverse) else {
            return now;
        };
        let mut nearest = now.clone();
        for _ in 0..ELASTIC_CORRECTIONS {
            let way = &inverse * &now.missed;
            let mut next = now.increment;
            for (i, w) in self.driven.components.iter().zip(way.iter()) {
                next[*i] -= w;
            }
            let Ok(there) = self.try_out(next) else {
                break;
            };
            now = there;
            if now.missed.amax() < nearest.missed.amax() {
                nearest = now.clone();
            }
            if nearest.meets() {
                break;
            }
        }
        nearest
    }
}
