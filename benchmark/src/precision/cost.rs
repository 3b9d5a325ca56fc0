//! The cost of an accuracy: interpolation along lines of error against time, and the front of the best points.

/// Error and run time \[s\] of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    /// Relative error.
    pub error: f64,
    /// Run time \[s\].
    pub time: f64,
}

/// Time that brings the error down to a level along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cost {
    /// About this run time \[s\], interpolated between two runs.
    Time(f64),
    /// At most this run time \[s\]: the first run that has the accuracy has no run before it to interpolate from.
    AtMost(f64),
    /// No run of the line is accurate enough. Nothing is extrapolated.
    NotReached,
}

impl Cost {
    /// The run time \[s\], where the level is reached.
    #[must_use]
    pub fn seconds(self) -> Option<f64> {
        match self {
            Self::Time(time) | Self::AtMost(time) => Some(time),
            Self::NotReached => None,
        }
    }
}

/// Cost of an error of `level` along a line of refinement, coarse to fine; `None` stands for a run that failed.
///
/// Between two neighbours of which the second is accurate enough and the first is not, `ln T` is linear in `ln e`. The
/// cheapest of several such places counts. A run that is accurate enough after one that failed, or as first of the
/// line, gives an upper bound.
#[must_use]
pub fn cost(line: &[Option<At>], level: f64) -> Cost {
    let mut best = Cost::NotReached;
    let mut before: Option<At> = None;
    for here in line {
        if let Some(here) = here
            && here.error <= level
        {
            let found = match before {
                Some(before) if before.error <= level => None,
                Some(before) => Some(Cost::Time(interpolated(before, *here, level))),
                None => Some(Cost::AtMost(here.time)),
            };
            if let Some(found) = found
                && found.seconds() < best.seconds().or(Some(f64::INFINITY))
            {
                best = found;
            }
        }
        before = *here;
    }
    best
}

/// Time at which the error is `level` on the line through two points in logarithmic axes.
fn interpolated(before: At, here: At, level: f64) -> f64 {
    if here.error <= 0.0 {
        // An error of zero has no logarithm; the run that has it bounds the cost.
        return here.time;
    }
    let share = (before.error / level).ln() / (before.error / here.error).ln();
    (before.time.ln() + share * (here.time / before.time).ln()).exp()
}

/// Points that no other point beats in both error and time, by increasing time.
#[must_use]
pub fn pareto(points: &[Option<At>]) -> Vec<usize> {
    let mut order: Vec<(usize, At)> = points
        .iter()
        .enumerate()
        .filter_map(|(i, at)| Some((i, (*at)?)))
        .filter(|(_, at)| at.error.is_finite() && at.time.is_finite())
        .collect();
    order.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    order.retain(|(_, at)| {
        let better = at.error < least;
        least = least.min(at.error);
        better
    });
    order.into_iter().map(|(i, _)| i).collect()
}
