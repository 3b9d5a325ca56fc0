//! Collects problems, and knows how to say each kind of range.

use crate::number::Number;
use crate::scene::{Dimension, Problem, Vector};

/// Problems found so far.
pub(super) struct Collector {
    dimension: Dimension,
    /// In the order in which they were found.
    pub found: Vec<Problem>,
}

impl Collector {
    pub(super) fn new(dimension: Dimension) -> Self {
        Self {
            dimension,
            found: Vec::new(),
        }
    }

    pub(super) fn add(
        &mut self,
        path: impl Into<String>,
        found: impl Into<String>,
        accepted: impl Into<String>,
    ) {
        self.found.push(Problem::new(path, found, accepted));
    }

    /// Finite and greater than zero.
    pub(super) fn positive(&mut self, path: impl Into<String>, value: f64, unit: &str) {
        if !(value.is_finite() && value > 0.0) {
            let unit = if unit.is_empty() {
                String::new()
            } else {
                format!(" [{unit}]")
            };
            self.add(
                path,
                Number(value).to_string(),
                format!("a finite number greater than 0{unit}"),
            );
        }
    }

    /// Finite and zero or greater.
    pub(super) fn not_negative(&mut self, path: impl Into<String>, value: f64) {
        if !(value.is_finite() && value >= 0.0) {
            self.add(
                path,
                Number(value).to_string(),
                "a finite number, 0 or greater",
            );
        }
    }

    /// From `low` to `high`, both included.
    pub(super) fn range(&mut self, path: impl Into<String>, value: f64, low: f64, high: f64) {
        if !(low..=high).contains(&value) {
            self.add(
                path,
                Number(value).to_string(),
                format!("a number from {low} to {high}"),
            );
        }
    }

    /// Finite components, and nothing along an axis that does not exist. Whether the vector is sound.
    pub(super) fn vector(&mut self, path: impl Into<String>, value: &Vector) -> bool {
        let path = path.into();
        let before = self.found.len();
        for (axis, x) in value.iter().enumerate() {
            if !x.is_finite() {
                self.add(
                    format!("{path}[{axis}]"),
                    Number(*x).to_string(),
                    "a finite number",
                );
            } else if axis >= self.dimension.axes() && *x != 0.0 {
                self.add(
                    format!("{path}[{axis}]"),
                    Number(*x).to_string(),
                    "0: there are two dimensions",
                );
            }
        }
        self.found.len() == before
    }
}
