//! Axes: what they show, and where values lie on them.

use super::text::superscript;
use serde::{Deserialize, Serialize};

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Scale of the values.
    pub scale: Scale,
    /// Format of the values.
    pub format: Format,
}

/// Scale of the values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// Places by the logarithm.
    Log,
    /// Names at 0, 1, 2 ...; vertically the first is on top.
    Names(Vec<String>),
}

/// Format of the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Format {
    /// Numbers; the exponent of very large and small ones stands at the label or as a power of ten.
    Number,
    /// Per cent of one.
    Percent,
    /// A time given in seconds.
    Seconds,
}

/// A value with what is written there.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Value.
    pub at: f64,
    /// Text.
    pub text: String,
}

/// An axis with its range.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisRange {
    scale: Scale,
    /// Format of the values.
    pub format: Format,
    low: f64,
    high: f64,
    /// Ticks with text.
    pub ticks: Vec<Tick>,
    /// Grid lines without.
    pub minor: Vec<f64>,
    /// Label, with the power of ten that the ticks leave out.
    pub label: String,
}

/// Share of the range left free on both ends.
const MARGIN: f64 = 0.06;

impl Axis {
    /// A range for the values, `from_zero` if zero must be in it. Values that the axis cannot hold do not count.
    pub fn ranged(&self, values: impl Iterator<Item = f64>, from_zero: bool) -> AxisRange {
        let placed: Vec<f64> = values.filter_map(|v| place(&self.scale, v)).collect();
        let low = placed.iter().copied().fold(f64::INFINITY, f64::min);
        let high = placed.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if placed.is_empty() {
            (0.0, 1.0)
        } else {
            (low, high)
        };
        match &self.scale {
            Scale::Names(names) => self.named(names),
            Scale::Log => self.logarithmic(low, high),
            Scale::Linear if from_zero => self.linear(low.min(0.0), high.max(0.0)),
            Scale::Linear => self.linear(low, high),
        }
    }

    fn named(&self, names: &[String]) -> AxisRange {
        let ticks = names.iter().enumerate().map(|(i, name)| Tick {
            at: i as f64,
            text: name.clone(),
        });
        AxisRange {
            scale: self.scale.clone(),
            format: self.format,
            low: -0.5,
            high: names.len().max(1) as f64 - 0.5,
            ticks: ticks.collect(),
            minor: vec![],
            label: self.label.clone(),
        }
    }

    /// `low` and `high` are decimal logarithms.
    fn logarithmic(&self, low: f64, high: f64) -> AxisRange {
        // Values close together get a range wide enough for two ticks.
        let least = if high - low < 0.5 { 0.2 } else { 0.08 };
        let pad = (MARGIN * (high - low)).max(least);
        let (low, high) = (low - pad, high + pad);
        let decades = (low.floor() as i32)..=(high.ceil() as i32);
        let inside = |value: &f64| (low..=high).contains(&value.log10());
        let of = |factors: &[f64]| -> Vec<f64> {
            decades
                .clone()
                .flat_map(|d| factors.iter().map(move |f| f * 10f64.powi(d)))
                .filter(inside)
                .collect()
        };
        let mut majors = of(&[1.0]);
        if majors.len() < 3 {
            majors = of(&[1.0, 2.0, 5.0]);
        }
        if majors.len() < 2 {
            majors = of(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        }
        let every = majors.len().div_ceil(8).max(1);
        let ticks = majors
            .iter()
            .step_by(every)
            .map(|&at| Tick {
                at,
                text: self.format.alone(at),
            })
            .collect();
        let minor = if high - low < 7.0 {
            of(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
        } else {
            vec![]
        };
        AxisRange {
            scale: Scale::Log,
            format: self.format,
            low,
            high,
            ticks,
            minor,
            label: self.label.clone(),
        }
    }

    fn linear(&self, low: f64, high: f64) -> AxisRange {
        let span = if high > low {
            high - low
        } else {
            low.abs().max(1.0)
        };
        let rough = span / 5.0;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|f| f * decade)
            .find(|step| *step >= rough * (1.0 - 1e-9))
            .unwrap_or(rough);
        let first = (low / step + 1e-9).floor();
        let last = (high / step - 1e-9).ceil().max(first + 1.0);
        let largest = (first.abs()).max(last.abs()) * step;
        let (exponent, label) = self.exponent(largest);
        let unit = step / 10f64.powi(exponent);
        let decimals = (-(unit * (1.0 + 1e-9)).log10().floor()).max(0.0) as usize;
        let ticks = (first as i64..=last as i64)
            .map(|i| {
                let at = i as f64 * step;
                let text = match self.format {
                    Format::Percent => format!("{} %", trimmed(100.0 * at)),
                    _ => format!("{:.decimals$}", at / 10f64.powi(exponent)),
                };
                Tick { at, text }
            })
            .collect();
        AxisRange {
            scale: Scale::Linear,
            format: self.format,
            low: first * step,
            high: last * step,
            ticks,
            minor: vec![],
            label,
        }
    }

    /// Power of ten to leave out of ticks up to `largest`, and the label that says so.
    fn exponent(&self, largest: f64) -> (i32, String) {
        if self.format == Format::Percent || (1e-2..1e4).contains(&largest) || largest == 0.0 {
            return (0, self.label.clone());
        }
        let exponent = 3 * (largest.log10() / 3.0).floor() as i32;
        (
            exponent,
            format!("{} / 10{}", self.label, superscript(exponent)),
        )
    }
}

impl Format {
    /// A value as tables write it.
    #[must_use]
    pub fn written(self, value: f64) -> String {
        match self {
            Self::Number => crate::show::number(value),
            Self::Percent => crate::show::percent(value),
            Self::Seconds => crate::show::seconds(value),
        }
    }

    /// A value on its own, as on a logarithmic axis.
    fn alone(self, value: f64) -> String {
        match self {
            Self::Number if (1e-3..1e4).contains(&value) => trimmed(value),
            Self::Number => {
                let exponent = (value * (1.0 + 1e-9)).log10().floor() as i32;
                let factor = value / 10f64.powi(exponent);
                if (factor - 1.0).abs() < 1e-6 {
                    format!("10{}", superscript(exponent))
                } else {
                    format!("{}·10{}", trimmed(factor), superscript(exponent))
                }
            }
            Self::Percent if value >= 1e-5 => format!("{} %", trimmed(100.0 * value)),
            Self::Percent => Self::Number.alone(value),
            Self::Seconds if value >= 0.1 => format!("{} s", trimmed(value)),
            Self::Seconds if value >= 1e-4 => format!("{} ms", trimmed(1e3 * value)),
            Self::Seconds => format!("{} µs", trimmed(1e6 * value)),
        }
    }
}

/// A number without the zeros at its end, to eight decimals.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.8}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Place of a value on a scale; `None` where it has no place.
fn place(scale: &Scale, value: f64) -> Option<f64> {
    let at = match scale {
        Scale::Log => value.log10(),
        _ => value,
    };
    at.is_finite().then_some(at)
}

impl AxisRange {
    /// Share of the axis, 0 to 1, at which a value lies; `None` where it has no place.
    #[must_use]
    pub fn share(&self, value: f64) -> Option<f64> {
        let at = place(&self.scale, value)?;
        let share = (at - self.low) / (self.high - self.low);
        // Names go down a vertical axis; the caller turns it, so only the numbers matter here.
        share.is_finite().then_some(share)
    }

    /// Length of the range, in values of a linear axis.
    #[must_use]
    pub fn span(&self) -> f64 {
        self.high - self.low
    }

    /// True if the axis carries names.
    #[must_use]
    pub fn is_named(&self) -> bool {
        matches!(self.scale, Scale::Names(_))
    }
}
