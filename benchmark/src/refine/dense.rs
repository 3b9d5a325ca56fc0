//! A history at the multiples of an interval, linear between the two states around each.
//!
//! Meshes have steps of their own, and a bar compares them at one time. The nearest states would differ by a part of a step,
//! whose size falls with the cell: an error of order 1 that the history does not have.

/// Steps before a multiple from which on states are kept: the next step may be longer than the last.
const AHEAD: f64 = 2.0;
/// Part of the interval by which a time may miss its multiple by round-off.
const ROUND_OFF: f64 = 1e-9;

/// Multiples of an interval that are still without a row.
pub struct Dense {
    /// Interval \[s\].
    interval: f64,
    /// Number of the next multiple.
    next: f64,
    /// The state before: time \[s\] and values.
    before: Option<(f64, Vec<f64>)>,
}

impl Dense {
    /// History whose first row, at the start, is there.
    #[must_use]
    pub fn new(interval: f64) -> Self {
        Self {
            interval,
            next: 1.0,
            before: None,
        }
    }

    /// True where the values of a state at `time` \[s\] are wanted, behind a step of `dt` \[s\].
    #[must_use]
    pub fn is_near(&self, time: f64, dt: f64) -> bool {
        self.next * self.interval <= time + AHEAD * dt
    }

    /// Rows of the multiples up to `time` \[s\], whose values these are.
    #[must_use]
    pub fn rows(&mut self, time: f64, values: Vec<f64>) -> Vec<(f64, Vec<f64>)> {
        let mut rows = vec![];
        while self.next * self.interval <= time + ROUND_OFF * self.interval {
            let at = self.next * self.interval;
            let row = match &self.before {
                Some((before, old)) if *before < at && at < time => {
                    let share = (at - before) / (time - before);
                    let between = old.iter().zip(&values);
                    between.map(|(a, b)| a + share * (b - a)).collect()
                }
                _ => values.clone(),
            };
            rows.push((at, row));
            self.next += 1.0;
        }
        self.before = Some((time, values));
        rows
    }
}
