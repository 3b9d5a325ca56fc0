//! Findings from the frames of a free fall, compared with their exact values.

use super::calibration::{CELL, CELLS, GRAVITY, PER_CELL, STEP, STEPS, VELOCITY};
use crate::bench::config::TimeLabel;
use crate::show::number;
use std::fmt;

/// Relative deviation of a length above which it is in another unit or of another body.
const LENGTH: f64 = 0.01;
/// Steps by which a label may be off.
const LABEL: f64 = 0.25;
/// Steps by which a solver may stop beside the end of the scene.
const END: f64 = 1.5;
/// Factor on the time above which it is another unit and no other time.
const CLOCK: f64 = 5.0;
/// Relative deviation of a way and a fall from those of another unit of length.
const UNIT: f64 = 0.2;
/// Relative deviation of gravity: a cycle that kicks before it moves is ahead by half a step, twice of it in gravity.
const FALL: f64 = 1.5 / STEPS;

/// Something that a solver does otherwise than the scene and its configuration say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// Another number of particles.
    Particles {
        /// Number found.
        found: usize,
        /// Number in the scene.
        expected: usize,
    },
    /// Lengths in another unit.
    Length {
        /// Positions over those of the scene.
        factor: f64,
    },
    /// Particles at other places than those of the scene, in its unit.
    Places {
        /// Their extent over that of the scene.
        factor: f64,
    },
    /// `initial_velocity` does not act.
    Velocity {
        /// Way along x \[m\].
        way: f64,
    },
    /// Displacements in another unit, positions in metres.
    Displacement {
        /// Displacements over those that are due.
        factor: f64,
    },
    /// Times in another unit.
    Clock {
        /// Label of the frame over the time of its particles.
        factor: f64,
    },
    /// The label of a frame is not what the configuration says.
    Label {
        /// Steps by which the particles are ahead of it.
        ahead: f64,
        /// Label of the configuration.
        declared: TimeLabel,
    },
    /// Another end than that of the scene.
    End {
        /// Time of the last particles \[s\].
        found: f64,
    },
    /// Another gravity.
    Gravity {
        /// Along the last axis \[m/s²\].
        found: f64,
    },
}

impl Finding {
    /// The label that would fit what was found, where there is one.
    #[must_use]
    pub fn fitting(&self) -> Option<TimeLabel> {
        let Self::Label { ahead, .. } = self else {
            return None;
        };
        let labels = TimeLabel::ALL.iter().map(|(_, label)| *label);
        labels
            .into_iter()
            .find(|l| (l.ahead() - ahead).abs() <= LABEL)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Particles { found, expected } => write!(
                f,
                "{found} particles where the scene has {expected}, {PER_CELL} per cell and axis"
            ),
            Self::Length { factor } => write!(
                f,
                "its positions are {} times the lengths of the scene, which are in metres",
                number(factor)
            ),
            Self::Places { factor } => write!(
                f,
                "its particles begin at other places: they extend over {} times the length of those of the scene, as those at \
                 Gauss points do",
                number(factor)
            ),
            Self::Velocity { way } => write!(
                f,
                "`initial_velocity` does not act: a way of {} m where {} m are due",
                number(way),
                number(VELOCITY * STEPS * STEP)
            ),
            Self::Displacement { factor } => write!(
                f,
                "its displacements are {} times those of the scene, which are in metres as its positions: another unit",
                number(factor)
            ),
            Self::Clock { factor } => write!(
                f,
                "the times of its frames are {} times the time of their particles, which is in seconds",
                number(factor)
            ),
            Self::Label { ahead, declared } => {
                let steps = (ahead.abs() * 100.0).round() / 100.0;
                let plural = if steps == 1.0 { "" } else { "s" };
                let side = if ahead < 0.0 { "behind" } else { "ahead of" };
                write!(
                    f,
                    "the particles are {} step{plural} {side} the time of their frame, and the configuration says \
                     \"time_label\": \"{}\"; ",
                    number(steps),
                    declared.word()
                )?;
                match self.fitting() {
                    Some(label) => write!(f, "\"time_label\": \"{}\" fits", label.word()),
                    None => write!(f, "no `time_label` fits"),
                }
            }
            Self::End { found } => write!(
                f,
                "its last particles are at {} s where the scene ends at {} s",
                number(found),
                number(STEPS * STEP)
            ),
            Self::Gravity { found } => write!(
                f,
                "it falls with {} m/s² where `gravity` is {} m/s²",
                number(found),
                number(-GRAVITY)
            ),
        }
    }
}

/// Everything that is wrong with the last frame of the free fall, from its positions \[m\], displacements \[m\] and
/// label \[s\]; and the time of its particles \[s\].
pub(super) fn findings(
    points: &[[f64; 3]],
    u: &[[f64; 3]],
    label: Option<f64>,
    declared: TimeLabel,
    axes: usize,
) -> (Vec<Finding>, f64) {
    let mut all = vec![];
    let expected = (CELLS * PER_CELL).pow(axes as u32);
    if points.len() != expected {
        all.push(Finding::Particles {
            found: points.len(),
            expected,
        });
    }
    let mut metre = length_factor(points, u, axes);
    // What is not a number is within nothing, and so is found.
    let within = |value: f64, bound: f64| value.abs() <= bound;
    if within(metre - 1.0, LENGTH) {
        metre = 1.0;
    } else if within(metre - 1.0, UNIT) {
        all.push(Finding::Places { factor: metre });
        metre = 1.0;
    } else {
        all.push(Finding::Length { factor: metre });
    }
    let mean = |axis: usize| u.iter().map(|u| u[axis]).sum::<f64>() / u.len() as f64 / metre;
    let end = STEPS * STEP;
    let label = label.unwrap_or(end);
    // A label that is right and a way and a fall that are wrong by one power of ten: the unit is wrong, not the time.
    let (way, fall) = (
        mean(0) / (VELOCITY * end),
        mean(axes - 1) / (-0.5 * GRAVITY * end * end),
    );
    let unit = 10f64.powf(way.abs().log10().round());
    let is_unit = unit != 1.0 && within(way / unit - 1.0, UNIT) && within(fall / unit - 1.0, UNIT);
    let unit = if is_unit && within(label / end - 1.0, UNIT) {
        unit
    } else {
        1.0
    };
    if unit != 1.0 {
        all.push(Finding::Displacement { factor: unit });
    }
    let time = mean(0) / unit / VELOCITY;
    let flies = time > STEP;
    if !flies {
        all.push(Finding::Velocity { way: mean(0) });
        return (all, time);
    }
    let ahead = (time - label) / STEP;
    let same_unit = label < CLOCK * time && time < CLOCK * label;
    if !same_unit {
        all.push(Finding::Clock {
            factor: label / time,
        });
    } else if !within(ahead - declared.ahead(), LABEL) {
        all.push(Finding::Label { ahead, declared });
    }
    if !within(time - end, END * STEP) {
        all.push(Finding::End { found: time });
    }
    let fall = 2.0 * mean(axes - 1) / unit / (time * time);
    if !within(fall + GRAVITY, FALL * GRAVITY) {
        all.push(Finding::Gravity { found: fall });
    }
    (all, time)
}

/// Extent of the places where the particles began over that of the scene, along the axis where it is nearest to 1: a
/// layer too many is no other unit.
fn length_factor(points: &[[f64; 3]], u: &[[f64; 3]], axes: usize) -> f64 {
    let due = CELL * (CELLS as f64 - 1.0 / PER_CELL as f64);
    let extent = |axis: usize| {
        let starts = points.iter().zip(u).map(|(x, u)| x[axis] - u[axis]);
        let (low, high) = starts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        (high - low) / due
    };
    let distance = |factor: f64| factor.ln().abs();
    (0..axes)
        .map(extent)
        .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        .unwrap_or(f64::NAN)
}
