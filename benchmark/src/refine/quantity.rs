//! Quantities of a run: which columns at which time, their units, and those that are taken where the user names none.

use super::run::{LETTERS, MeshRun};
use std::fmt;

/// A quantity of every mesh of a refinement.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Name in the table.
    pub name: String,
    /// Column of the history.
    pub column: String,
    /// The time or part of the history that gives the number.
    pub when: QuantityTime,
}

/// The time or part of a history that gives a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum QuantityTime {
    /// The end of the judged time.
    End,
    /// Its largest value.
    Max,
    /// Its mean in time.
    Mean,
    /// Its mean over the last fifth.
    Late,
    /// The growth over the last fifth over its time: of an impulse the mean force \[N\].
    LateRate,
    /// A time \[s\].
    At(f64),
}

impl QuantityTime {
    /// True where the bar is that of a window in time, not of the number alone.
    #[must_use]
    pub fn is_local(self) -> bool {
        matches!(self, Self::End | Self::At(_))
    }
}

impl fmt::Display for QuantityTime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::End => write!(f, "end"),
            Self::Max => write!(f, "max"),
            Self::Mean => write!(f, "mean"),
            Self::Late | Self::LateRate => write!(f, "last fifth"),
            Self::At(time) => write!(f, "{time} s"),
        }
    }
}

impl Quantity {
    /// A column at the end, under its own name.
    fn at_end(column: &str) -> Self {
        Self {
            name: column.to_owned(),
            column: column.to_owned(),
            when: QuantityTime::End,
        }
    }

    /// Parses `NAME=COLUMN@WHEN`.
    ///
    /// # Errors
    /// The accepted forms.
    pub fn parse(text: &str) -> Result<Self, String> {
        let accepted = || {
            format!(
                "found {text:?}; accepted: NAME=COLUMN@end, @max, @mean or @T with a time in seconds"
            )
        };
        let (name, rest) = text.split_once('=').ok_or_else(accepted)?;
        let (column, when) = rest.rsplit_once('@').ok_or_else(accepted)?;
        let when = match when {
            "end" => QuantityTime::End,
            "max" => QuantityTime::Max,
            "mean" => QuantityTime::Mean,
            time => {
                let time: f64 = time
                    .trim_end_matches('s')
                    .trim()
                    .parse()
                    .map_err(|_| accepted())?;
                if !(time >= 0.0 && time.is_finite()) {
                    return Err(accepted());
                }
                QuantityTime::At(time)
            }
        };
        if name.is_empty() || column.is_empty() {
            return Err(accepted());
        }
        Ok(Self {
            name: name.to_owned(),
            column: column.to_owned(),
            when,
        })
    }

    /// True for the extent of a body that flows.
    #[must_use]
    pub fn is_extent(&self) -> bool {
        let words = ["_front_", "_back_", "_height"];
        words.iter().any(|word| self.column.contains(word))
    }

    /// Its unit, from the name of its column.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        if self.when == QuantityTime::LateRate {
            return "N";
        }
        unit(&self.column)
    }

    /// Its value on a mesh, for the first `count` output times; not a number where the mesh did not come so far.
    #[must_use]
    pub fn value(&self, run: &MeshRun, count: usize) -> f64 {
        let Some(values) = run.columns.get(&self.column) else {
            return f64::NAN;
        };
        let count = count.min(values.len());
        if count == 0 {
            return f64::NAN;
        }
        let (values, times) = (&values[..count], &run.times[..count]);
        let end = times[count - 1];
        let late = times.partition_point(|time| *time < 0.8 * end - 1e-9 * end);
        match self.when {
            QuantityTime::End => values[count - 1],
            QuantityTime::Max => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            QuantityTime::Mean => mean(times, values),
            QuantityTime::Late => mean(&times[late..], &values[late..]),
            QuantityTime::LateRate => (values[count - 1] - values[late]) / (end - times[late]),
            QuantityTime::At(time) => values[nearest(times, time)],
        }
    }
}

/// The place of the output time nearest to a time.
#[must_use]
pub fn nearest(times: &[f64], time: f64) -> usize {
    let next = times.partition_point(|t| *t < time).min(times.len() - 1);
    match next.checked_sub(1) {
        Some(before) if time - times[before] < times[next] - time => before,
        _ => next,
    }
}

/// Mean in time, by the trapezoidal rule.
fn mean(times: &[f64], values: &[f64]) -> f64 {
    let [Some(first), Some(last)] = [times.first(), times.last()] else {
        return f64::NAN;
    };
    if times.len() == 1 {
        return values[0];
    }
    let pieces = times.windows(2).zip(values.windows(2));
    let area: f64 = pieces
        .map(|(t, v)| 0.5 * (v[0] + v[1]) * (t[1] - t[0]))
        .sum();
    area / (last - first)
}

/// The unit of a column of the history, by its name; empty where the name tells none.
#[must_use]
pub fn unit(column: &str) -> &'static str {
    let ends = |words: &[&str]| {
        words.iter().any(|word| {
            LETTERS
                .iter()
                .any(|letter| column.ends_with(&format!("_{word}{letter}")))
        })
    };
    if column.contains("energy") {
        "J"
    } else if column.contains("impulse") {
        "N s"
    } else if column.starts_with("momentum_") {
        "kg m/s"
    } else if column.ends_with("_displacement") {
        "m"
    } else if column.ends_with("_velocity") {
        "m/s"
    } else if column.ends_with("_mises_stress") || column.ends_with("_pressure") {
        "Pa"
    } else if column.ends_with("_mass") {
        "kg"
    } else if ends(&["contact_f"]) {
        "N"
    } else if column.ends_with("_time") {
        "s"
    } else if ends(&["v"]) {
        "m/s"
    } else if ends(&["u", ""])
        || column.ends_with("_height")
        || ["_front_", "_back_"]
            .iter()
            .any(|part| column.contains(part))
    {
        "m"
    } else if ["xx", "yy", "zz", "yz", "xz", "xy"]
        .iter()
        .any(|pair| column.ends_with(&format!("_s{pair}")))
    {
        "Pa"
    } else {
        ""
    }
}

/// The quantities of a scene where the user names none: centres, velocities and extents of the bodies, probes, energies,
/// impulses of contact and the mean of its force over the last fifth. Forces at one time depend on chance, stresses of probes
/// have wide bars, and the remainder of the energy and `…_algorithmic` measure the method: none of them is taken.
#[must_use]
pub fn usual(run: &MeshRun) -> Vec<Quantity> {
    let mut all = vec![];
    // The particle with the largest value is another one on each mesh.
    let is_place_of_largest = |column: &str| {
        let probe = column.rsplit_once('_').map(|(probe, _)| probe);
        probe.is_some_and(|probe| run.columns.contains_key(&format!("{probe}_particle")))
            && unit(column) == "m"
            && LETTERS.iter().any(|letter| column.ends_with(letter))
    };
    let left_out = |column: &str| {
        column.ends_with("_mass")
            || column.starts_with("momentum_")
            || column == "velocity_time"
            || column == "kinetic_energy"
            || column == "energy_remainder"
            || column.ends_with("_algorithmic")
            || column.starts_with("boundary_drift")
            || is_place_of_largest(column)
            || matches!(unit(column), "Pa" | "N" | "")
    };
    for column in run.columns.keys().filter(|column| !left_out(column)) {
        all.push(Quantity::at_end(column));
        if column.contains("_impulse_") {
            all.push(Quantity {
                name: column.replace("_impulse_", "_late_force_"),
                column: column.clone(),
                when: QuantityTime::LateRate,
            });
        }
    }
    // Lengths first, then velocities, impulses and forces, energies.
    let rank = |quantity: &Quantity| {
        let order = ["m", "m/s", "N s", "N", "J"];
        order.iter().position(|unit| *unit == quantity.unit())
    };
    // Of two columns that are one, the scene's stands before the body's.
    let of_body =
        |quantity: &Quantity| quantity.unit() == "J" && quantity.column.starts_with("body");
    all.sort_by_key(|quantity| {
        (
            rank(quantity),
            !is_probe(&quantity.column),
            of_body(quantity),
        )
    });
    all
}

/// True for a column of a probe.
fn is_probe(column: &str) -> bool {
    !(column.starts_with("body") || column.starts_with("surface") || column.contains("energy"))
}
