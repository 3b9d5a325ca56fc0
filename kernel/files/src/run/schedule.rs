//! The states whose values are rows of a history with an interval of its own.
//!
//! Each multiple of the interval, its nominal time, has a row: that of the nearest state. The step before a state stands for the
//! one behind it, which nobody knows yet, so no step is cut and none is taken back.

use proctor_scene::simulation::Clock;

/// The column of nominal times, the last one of the file.
pub(super) const NOMINAL_TIME: &str = "nominal_time";

/// Times of the rows of a history.
pub(super) struct HistorySchedule {
    /// Interval \[s\].
    interval: f64,
    /// Number of the last multiple of the interval that has a row or lies behind.
    last: f64,
}

impl HistorySchedule {
    /// Goes on at a state, where the file has rows up to `last_time` \[s\].
    pub(super) fn new(interval: f64, clock: &Clock, last_time: Option<f64>) -> Self {
        let number = number(interval, clock);
        let written = last_time.map_or(-1.0, |time| (time / interval).round());
        let is_near = (clock.time - number * interval).abs() <= 0.5 * clock.dt_before;
        Self {
            interval,
            last: if is_near && written < number {
                number - 1.0
            } else {
                number.max(written)
            },
        }
    }

    /// True where a state is to have a row.
    pub(super) fn is_due(&self, clock: &Clock) -> bool {
        number(self.interval, clock) > self.last
    }

    /// The nominal time of the row of a state that is due \[s\], which then has it.
    pub(super) fn take(&mut self, clock: &Clock) -> f64 {
        self.last = number(self.interval, clock);
        self.last * self.interval
    }
}

/// Rows of a history from the start to a state, where no step is longer than the interval.
pub(super) fn rows(interval: f64, clock: &Clock) -> u64 {
    number(interval, clock) as u64 + 1
}

/// Number of the last multiple of an interval that is nearer to a state than to the next one.
fn number(interval: f64, clock: &Clock) -> f64 {
    ((clock.time + 0.5 * clock.dt_before) / interval).floor()
}
