//! Colours of values: from dark blue over green to yellow, each lighter than the one before.

use crate::show::drawing::Rgb;

/// Colours at equal steps of the range, those of the map *viridis*.
const STEPS: [Rgb; 11] = [
    [68, 1, 84],
    [72, 36, 117],
    [65, 68, 135],
    [53, 95, 141],
    [42, 120, 142],
    [33, 145, 140],
    [34, 168, 132],
    [68, 191, 112],
    [122, 209, 81],
    [189, 223, 38],
    [253, 231, 37],
];

/// Colour of what has no value.
const NONE: Rgb = [160, 160, 160];

/// The colour of a value in a range. A value beyond the range has the colour of the nearer end; not-a-number is grey.
#[must_use]
pub fn colour(value: f64, [low, high]: [f64; 2]) -> Rgb {
    if value.is_nan() {
        return NONE;
    }
    let share = if high > low {
        ((value - low) / (high - low)).clamp(0.0, 1.0)
    } else {
        0.5
    };
    let at = share * (STEPS.len() - 1) as f64;
    let below = (at as usize).min(STEPS.len() - 2);
    let part = at - below as f64;
    std::array::from_fn(|i| {
        let [from, to] = [STEPS[below][i], STEPS[below + 1][i]].map(f64::from);
        (from + part * (to - from)).round() as u8
    })
}
