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

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of order p on a path of refinement in d dimensions, `e = T^(-p/(d+1))`.
    fn path(order: f64, dimensions: f64, runs: u32) -> Vec<Option<At>> {
        (0..runs)
            .map(|i| {
                let time = 2f64.powf((dimensions + 1.0) * f64::from(i));
                Some(At {
                    error: time.powf(-order / (dimensions + 1.0)),
                    time,
                })
            })
            .collect()
    }

    #[test]
    fn costs_of_a_power_law_are_exact() {
        let line = path(2.0, 2.0, 5);
        for level in [0.5, 0.01, 0.004] {
            let Cost::Time(time) = cost(&line, level) else {
                panic!("{level} lies inside the line");
            };
            // e = T^(-2/3), so T = e^(-3/2).
            let exact = level.powf(-1.5);
            assert!((time / exact - 1.0).abs() < 1e-12, "{time} {exact}");
        }
    }

    #[test]
    fn nothing_is_extrapolated() {
        let line = path(1.0, 1.0, 3);
        assert_eq!(cost(&line, 0.2), Cost::NotReached);
        assert_eq!(cost(&line, 2.0), Cost::AtMost(1.0));
        assert_eq!(cost(&[], 0.1), Cost::NotReached);
    }

    #[test]
    fn a_failed_run_is_no_end_to_interpolate_from() {
        let at = |error, time| Some(At { error, time });
        let line = [at(0.1, 1.0), None, at(0.005, 16.0)];
        assert_eq!(cost(&line, 0.01), Cost::AtMost(16.0));
        // An error that grows again is not reached by the finer run, but was by the coarser.
        let stalled = [at(0.1, 1.0), at(0.001, 4.0), at(0.1, 16.0), at(0.001, 64.0)];
        assert_eq!(cost(&stalled, 0.01), Cost::Time(2.0));
        assert_eq!(cost(&[at(0.1, 1.0), at(0.0, 4.0)], 0.01), Cost::Time(4.0));
    }

    #[test]
    fn the_front_has_the_points_that_none_beats() {
        let at = |error, time| Some(At { error, time });
        let points = [
            at(0.1, 1.0),
            at(0.2, 2.0),
            at(0.05, 4.0),
            None,
            at(0.05, 3.0),
            at(f64::NAN, 0.1),
            at(0.01, 9.0),
        ];
        assert_eq!(pareto(&points), [0, 4, 6]);
        assert_eq!(pareto(&[]), Vec::<usize>::new());
    }
}
