//! Places of the slopes of orders 1 and 2 beside logarithmic lines, clear of them.

use crate::show::chart::{Guide, Series};

/// Length of a slope as share of the horizontal axis.
const LENGTH: f64 = 0.2;
/// Room for a label, as shares of the axes.
const LABEL: [f64; 2] = [0.17, 0.03];
/// Least distance from the lines, as share of the axes.
const CLEAR: f64 = 0.03;
/// Places tried along each axis.
const TRIED: u32 = 24;
/// Points looked at along a line from one run to the next.
const SAMPLES: u32 = 12;

/// Slopes of orders 1 and 2 from one point, `slope(p)` being that of order p in logarithmic axes; none where every place
/// is too near to the series or the slopes too flat to be told apart.
#[must_use]
pub fn slopes(series: &[Series], slope: impl Fn(i32) -> f64) -> Vec<Guide> {
    let Some(range) = Range::of(series) else {
        return vec![];
    };
    let lines = range.samples(series);
    // Ends of the two slopes over their beginning, as shares of the vertical axis.
    let ratio = LENGTH * range.span[0];
    let ends = [1, 2].map(|order| slope(order) * ratio / range.span[1]);
    if (ends[1] - ends[0]).abs() < 1.5 * LABEL[1] {
        return vec![];
    }
    let low = ends[0].min(ends[1]).min(0.0) - LABEL[1];
    let high = ends[0].max(ends[1]).max(0.0) + LABEL[1];
    let mut best: Option<([f64; 2], f64)> = None;
    for i in 0..=TRIED {
        for j in 0..=TRIED {
            let at = [i, j].map(|n| f64::from(n) / f64::from(TRIED));
            let over = [at[0], at[0] + LENGTH + LABEL[0]];
            let up = [at[1] + low, at[1] + high];
            if over[1] > 1.0 || up[0] < 0.0 || up[1] > 1.0 {
                continue;
            }
            let clear = lines
                .iter()
                .map(|p| outside(p[0], over).hypot(outside(p[1], up)))
                .fold(f64::INFINITY, f64::min);
            if clear > best.map_or(CLEAR, |(_, most)| most) {
                best = Some((at, clear));
            }
        }
    }
    let Some((at, _)) = best else {
        return vec![];
    };
    [1, 2]
        .into_iter()
        .zip(ends)
        .map(|(order, end)| Guide {
            from: range.value(at),
            to: range.value([at[0] + LENGTH, at[1] + end]),
            label: format!("order {order}"),
        })
        .collect()
}

/// Distance of a number from an interval.
fn outside(x: f64, [low, high]: [f64; 2]) -> f64 {
    (low - x).max(x - high).max(0.0)
}

/// Range of the points in logarithms.
struct Range {
    low: [f64; 2],
    span: [f64; 2],
}

impl Range {
    /// `None` where there are no two values apart on both axes.
    fn of(series: &[Series]) -> Option<Self> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in series.iter().flat_map(|s| &s.points) {
            for (axis, value) in [Some(point.x), point.y].into_iter().enumerate() {
                let log = value.map_or(f64::NAN, f64::ln);
                if log.is_finite() {
                    low[axis] = low[axis].min(log);
                    high[axis] = high[axis].max(log);
                }
            }
        }
        let span = [high[0] - low[0], high[1] - low[1]];
        (span[0] > 0.0 && span[1] > 0.0).then_some(Self { low, span })
    }

    /// Places along all lines, as shares of the range.
    fn samples(&self, series: &[Series]) -> Vec<[f64; 2]> {
        let place = |x: f64, y: f64| {
            [
                (x.ln() - self.low[0]) / self.span[0],
                (y.ln() - self.low[1]) / self.span[1],
            ]
        };
        let mut samples = vec![];
        for series in series {
            let mut before: Option<[f64; 2]> = None;
            for point in &series.points {
                let here = point.y.map(|y| place(point.x, y));
                if let Some(here) = here {
                    let from = before.unwrap_or(here);
                    samples.extend((0..=SAMPLES).map(|i| {
                        let share = f64::from(i) / f64::from(SAMPLES);
                        [0, 1].map(|axis| from[axis] + share * (here[axis] - from[axis]))
                    }));
                }
                before = here;
            }
        }
        samples
    }

    /// The values at shares of the range.
    fn value(&self, share: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (self.low[axis] + share[axis] * self.span[axis]).exp())
    }
}
