//! A path that a user gives row by row: of each component either the strain or the stress.

use super::{ElementError, State};
use nalgebra::{DMatrix, DVector};
use proctor_kernel::laws::{AnyLaw, Point};

/// Most corrections of the strain that meets the stresses of a step.
const CORRECTIONS: usize = 100;
/// Most halvings of a correction that makes it worse.
const HALVINGS: usize = 30;
/// Share of the largest stress by which one may be missed.
const MISS: f64 = 1e-9;
/// Strain by which the slope of the stress is felt for.
const FEELER: f64 = 1e-8;

/// A row of a path: the time \[s\], and of components xx, yy, zz, yz, xz, xy the logarithmic strain or the stress \[Pa\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Time \[s\].
    pub time: f64,
    /// Totals: strains, or stresses \[Pa\], where [`Path::stress`] says so.
    pub values: [f64; 6],
}

/// A path from time 0 and no strain through rows, straight from one to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Which components are driven by their stress.
    pub stress: [bool; 6],
    /// Rows in order of their times, the first later than 0.
    pub rows: Vec<Row>,
}

/// Takes a point of a law from an isotropic pressure \[Pa\] along a path, in `steps` equal steps from each row to the next;
/// times \[s\] and states from the start to the end, or to where it broke off, and why it did.
pub fn follow(
    law: &AnyLaw,
    density: f64,
    pressure: f64,
    path: &Path,
    steps: usize,
) -> (Vec<f64>, Vec<State>, Result<(), ElementError>) {
    let start = [-pressure, -pressure, -pressure, 0.0, 0.0, 0.0];
    let mut point = Point::new(law, density, start);
    let mut strain = [0.0; 6];
    let (mut times, mut states) = (vec![0.0], vec![State::of(&point, strain)]);
    let mut before = Row {
        time: 0.0,
        values: std::array::from_fn(|i| if path.stress[i] { start[i] } else { 0.0 }),
    };
    let driven: Vec<usize> = (0..6).filter(|i| path.stress[*i]).collect();
    let mut increment = [0.0; 6];
    for row in &path.rows {
        let dt = (row.time - before.time) / steps as f64;
        for i in (0..6).filter(|i| !path.stress[*i]) {
            increment[i] = (row.values[i] - before.values[i]) / steps as f64;
        }
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            let meeting = Meeting {
                point: &point,
                driven: &driven,
                target: std::array::from_fn(|i| {
                    before.values[i] + share * (row.values[i] - before.values[i])
                }),
                // A strain of round-off.
                least: 1e-15 * law.young(),
                dt,
                step: states.len(),
            };
            if let Err(error) = meeting.solve(&mut increment) {
                return (times, states, Err(error));
            }
            if let Err(fault) = point.strain(&increment, dt) {
                let step = states.len();
                return (times, states, Err(ElementError::Fault { step, fault }));
            }
            for (sum, one) in strain.iter_mut().zip(increment) {
                *sum += one;
            }
            times.push(before.time + share * (row.time - before.time));
            states.push(State::of(&point, strain));
        }
        before = *row;
    }
    (times, states, Ok(()))
}

/// The step that is to be taken, and the stresses that it must meet.
struct Meeting<'a> {
    point: &'a Point,
    driven: &'a [usize],
    target: [f64; 6],
    /// Least stress that counts \[Pa\].
    least: f64,
    dt: f64,
    step: usize,
}

impl Meeting<'_> {
    /// By how much stresses are missed with this strain increment \[Pa\], and by how much they may be.
    fn missed(&self, increment: &[f64; 6]) -> Result<(DVector<f64>, f64), ElementError> {
        let mut ahead = self.point.clone();
        let step = self.step;
        let fault = |fault| ElementError::Fault { step, fault };
        ahead.strain(increment, self.dt).map_err(fault)?;
        let stress = ahead.stress();
        let size = stress.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
        let missed = self.driven.iter().map(|i| stress[*i] - self.target[*i]);
        let missed = DVector::from_iterator(self.driven.len(), missed);
        Ok((missed, (MISS * size).max(self.least)))
    }

    /// Newton's method, its slopes felt for, each correction halved until it helps.
    fn solve(&self, increment: &mut [f64; 6]) -> Result<(), ElementError> {
        if self.driven.is_empty() {
            return Ok(());
        }
        let (mut missed, mut enough) = self.missed(increment)?;
        for _ in 0..CORRECTIONS {
            if missed.amax() <= enough {
                return Ok(());
            }
            let n = self.driven.len();
            let mut slopes = DMatrix::zeros(n, n);
            for (column, i) in self.driven.iter().enumerate() {
                let mut beside = *increment;
                beside[*i] += FEELER;
                let (there, _) = self.missed(&beside)?;
                slopes.set_column(column, &((there - &missed) / FEELER));
            }
            let Some(way) = slopes.lu().solve(&missed) else {
                break;
            };
            let mut share = 1.0;
            let better = (0..HALVINGS).find_map(|_| {
                let mut next = *increment;
                for (i, w) in self.driven.iter().zip(way.iter()) {
                    next[*i] -= share * w;
                }
                share *= 0.5;
                // A law that breaks here may not break half way.
                let (there, may) = self.missed(&next).ok()?;
                (there.amax() < missed.amax()).then_some((next, there, may))
            });
            let Some(better) = better else { break };
            (*increment, missed, enough) = better;
        }
        if missed.amax() <= enough {
            return Ok(());
        }
        Err(ElementError::NotHeld {
            step: self.step,
            missed: missed.amax(),
        })
    }
}
