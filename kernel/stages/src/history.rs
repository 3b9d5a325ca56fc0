//! Histories in time: prescribed velocities and accelerations, and their integrals.

use crate::model::{History, Motion, Vector};

/// Value of a history, linear between its times and constant outside.
#[must_use]
pub fn value(history: &History, time: f64) -> Vector {
    let times = &history.times;
    let next = times.partition_point(|&row| row <= time);
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

/// Displacement of a surface that moves with a prescribed velocity: the integral of the velocity from time zero, exact,
/// because the velocity is linear between its times. Integrals up to the times are summed once, in their order.
#[derive(Clone, Debug)]
pub struct Displacement {
    velocity: History,
    /// Number of the first row at time zero or later.
    first: usize,
    /// Displacements at that row and those after it \[m\].
    at_rows: Vec<Vector>,
}

impl Displacement {
    /// Sums the integrals up to each row once.
    #[must_use]
    pub fn new(velocity: &History) -> Self {
        let times = &velocity.times;
        let first = times.partition_point(|&row| row < 0.0);
        let mut sum = [0.0; 3];
        let mut from = (0.0, value(velocity, 0.0));
        let rows = times.iter().zip(&velocity.values).skip(first);
        let at_rows = rows.map(|(&time, &value)| {
            add_trapezoid(&mut sum, from, (time, value));
            from = (time, value);
            sum
        });
        Self {
            first,
            at_rows: at_rows.collect(),
            velocity: velocity.clone(),
        }
    }

    /// Displacement since time zero \[m\].
    #[must_use]
    pub fn at(&self, time: f64) -> Vector {
        let times = &self.velocity.times;
        let next = times.partition_point(|&row| row < time);
        let to = (time, value(&self.velocity, time));
        let (from, mut sum) = match next.checked_sub(self.first) {
            None | Some(0) => ((0.0, value(&self.velocity, 0.0)), [0.0; 3]),
            Some(rows) => (
                (times[next - 1], self.velocity.values[next - 1]),
                self.at_rows[rows - 1],
            ),
        };
        add_trapezoid(&mut sum, from, to);
        sum
    }

    /// Mean velocity from a time on, over `dt` \[m/s\].
    #[must_use]
    #[inline]
    pub fn mean_velocity(&self, time: f64, dt: f64) -> Vector {
        let (from, to) = (self.at(time), self.at(time + dt));
        std::array::from_fn(|axis| (to[axis] - from[axis]) / dt)
    }
}

/// Adds the integral of what is linear between two times.
fn add_trapezoid(sum: &mut Vector, from: (f64, Vector), to: (f64, Vector)) {
    for axis in 0..3 {
        sum[axis] += 0.5 * (from.1[axis] + to.1[axis]) * (to.0 - from.0);
    }
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
                let times = &record.times;
                let next = times.partition_point(|&row| row <= time);
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
    #[inline]
    pub fn end(&self) -> f64 {
        let (Motion::Acceleration(history) | Motion::Velocity(history)) = &self.motion;
        history.times.last().copied().unwrap_or(0.0)
    }
}
