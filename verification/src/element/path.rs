//! A path that a user gives row by row: of each component either the strain or the stress.

use super::held::{self, DrivenComponents};
use super::{ElementError, State};
use proctor_laws::{AnyLaw, Point};

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
    /// True for components that are driven by their stress.
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
    let driven = DrivenComponents::of(law, path.stress);
    let mut increment = [0.0; 6];
    for row in &path.rows {
        let dt = (row.time - before.time) / steps as f64;
        for i in (0..6).filter(|i| !path.stress[*i]) {
            increment[i] = (row.values[i] - before.values[i]) / steps as f64;
        }
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            let target = std::array::from_fn(|i| {
                before.values[i] + share * (row.values[i] - before.values[i])
            });
            let step = states.len();
            if let Err(missed) = held::take(&driven, &mut point, &target, &mut increment, dt) {
                let error = match missed {
                    held::StepFailure::By(missed) => ElementError::NotHeld { step, missed },
                    held::StepFailure::Fault(fault) => ElementError::Fault { step, fault },
                };
                return (times, states, Err(error));
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
