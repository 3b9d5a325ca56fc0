//! The harmonic accelerogram of the technical manual, section 20.2, and its text.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use proctor_scene::{History, Vector};

/// A harmonic base motion with velocity A sin(2 pi f t + alpha) along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Amplitude A of the velocity \[m/s\].
    pub amplitude: f64,
    /// Phase alpha \[rad\].
    pub phase: f64,
    /// Frequency f along each axis \[Hz\]; 0 along an axis that does not move.
    pub frequency: Vector,
    /// Interval between rows \[s\].
    pub interval: f64,
    /// Number of intervals; there is one row more.
    pub intervals: usize,
}

impl Harmonic {
    /// The record of the manual's base acceleration example. The manual prints the formula and the first rows,
    /// not the constants; the rows decode to these.
    #[must_use]
    pub fn of_the_manual() -> Self {
        Self {
            amplitude: 0.3,
            phase: std::f64::consts::PI,
            frequency: [1.0, 0.5, 0.0],
            interval: 5e-5,
            intervals: 40_000,
        }
    }
}

/// Acceleration a = A 2 pi f cos(2 pi f t + alpha) \[m/s²\] at the rows of `motion`.
#[must_use]
pub fn accelerogram(motion: &Harmonic) -> History {
    let times: Vec<f64> = (0..=motion.intervals)
        .map(|row| row as f64 * motion.interval)
        .collect();
    let values = times
        .iter()
        .map(|t| {
            motion
                .frequency
                .map(|f| motion.amplitude * TAU * f * libm::cos(TAU * f * t + motion.phase))
        })
        .collect();
    History { times, values }
}

/// The text of a record: header `t,ax,ay,az`, comma separated, numbers in their shortest exact form.
///
/// Numbers are spelt as in the manual's printed rows (`5e-05`, `0.0001`, `-0.0`), so that a record made here can
/// be compared with them digit for digit.
#[must_use]
pub fn to_csv(record: &History) -> String {
    let mut text = String::from("t,ax,ay,az\n");
    for (t, [x, y, z]) in record.times.iter().zip(&record.values) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{}",
            spelt(*t),
            spelt(*x),
            spelt(*y),
            spelt(*z)
        );
    }
    text
}

/// Shortest digits that give the number back, with an exponent of two digits below 1e-4.
fn spelt(x: f64) -> String {
    let text = format!("{x:?}");
    match text.split_once("e-") {
        Some((digits, exponent)) => format!("{digits}e-{exponent:0>2}"),
        None => text,
    }
}
