//! Histories in time: prescribed velocities and accelerations, and their integrals.

use crate::scene::{History, Motion, Vector};

/// Value of a history, linear between its times and constant outside.
#[must_use]
pub fn value(history: &History, time: f64) -> Vector {
    let times = &history.times;
    let next = times.partition_point(|t| *t <= time);
    if next == 0 {
        return history.values.first().copied().unwrap_or_default();
    }
    if next == times.len() {
        return history.values[next - 1];
    }
    let share = (time - times[next - 1]) / (times[next] - times[next - 1]);
    std::array::from_fn(|axis| {
        let (a, b) = (history.values[next - 1][axis], history.values[next][axis]);
        a + share * (b - a)
    })
}

/// Integral of a history from time zero \[m\] for a velocity in m/s: exact, because the history is linear between
/// its times.
#[must_use]
pub(super) fn integral(history: &History, time: f64) -> Vector {
    let mut sum = [0.0; 3];
    let mut from = (0.0, value(history, 0.0));
    let inner = history
        .times
        .iter()
        .copied()
        .filter(|t| (0.0..time).contains(t));
    for t in inner.chain(std::iter::once(time)) {
        let to = (t, value(history, t));
        for axis in 0..3 {
            sum[axis] += 0.5 * (from.1[axis] + to.1[axis]) * (to.0 - from.0);
        }
        from = to;
    }
    sum
}

/// Velocity of a moving plane.
#[derive(Clone, Debug)]
pub struct BaseVelocity {
    motion: Motion,
    /// Velocity at the times of an acceleration record, by the trapezoidal rule, which is exact for a
    /// piecewise linear record.
    at_times: Vec<Vector>,
}

impl BaseVelocity {
    /// Integrates the record once.
    #[must_use]
    pub fn new(motion: &Motion) -> Self {
        let mut at_times = vec![];
        if let Motion::Acceleration(record) = motion {
            let mut v = [0.0; 3];
            at_times.push(v);
            for (t, a) in record.times.windows(2).zip(record.values.windows(2)) {
                for axis in 0..3 {
                    v[axis] += 0.5 * (a[0][axis] + a[1][axis]) * (t[1] - t[0]);
                }
                at_times.push(v);
            }
        }
        Self {
            motion: motion.clone(),
            at_times,
        }
    }

    /// Velocity \[m/s\] at a time. Before the record it is zero (acceleration) or the first value (velocity);
    /// after it the last one is kept.
    #[must_use]
    pub fn at(&self, time: f64) -> Vector {
        match &self.motion {
            Motion::Velocity(history) => value(history, time),
            Motion::Acceleration(record) => {
                let next = record.times.partition_point(|t| *t <= time);
                if next == 0 {
                    return [0.0; 3];
                }
                let v = self.at_times[next - 1];
                if next == record.times.len() {
                    return v;
                }
                let (dt, a, b) = (
                    time - record.times[next - 1],
                    record.values[next - 1],
                    value(record, time),
                );
                std::array::from_fn(|axis| v[axis] + 0.5 * (a[axis] + b[axis]) * dt)
            }
        }
    }

    /// Last time of the record \[s\].
    #[must_use]
    pub fn end(&self) -> f64 {
        let (Motion::Acceleration(history) | Motion::Velocity(history)) = &self.motion;
        history.times.last().copied().unwrap_or(0.0)
    }
}
