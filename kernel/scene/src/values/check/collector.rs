//! Collects problems, and knows how to say each kind of range.

use crate::values::Problem;
use proctor_geometry::number::Number;
use proctor_kernel::model::{Dimension, Vector};

/// Largest magnitude of a number: squares, and products of five of them, are finite.
const LARGEST: f64 = 1e30;
/// Smallest number that has to be greater than zero: what is divided by a product of three of them is finite.
const SMALLEST: f64 = 1e-30;

/// Problems found so far.
pub(super) struct Collector {
    dimension: Dimension,
    /// Faults in the order in which they were found.
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
        let accepted = if !(value.is_finite() && value > 0.0) {
            "a finite number greater than 0".to_owned()
        } else if (SMALLEST..=LARGEST).contains(&value) {
            return;
        } else {
            format!("a number from {SMALLEST:e} to {LARGEST:e}")
        };
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" [{unit}]")
        };
        self.add(path, Number(value).to_string(), accepted + &unit);
    }

    /// Finite and zero or greater.
    pub(super) fn not_negative(&mut self, path: impl Into<String>, value: f64) {
        if !(value.is_finite() && value >= 0.0) {
            self.add(
                path,
                Number(value).to_string(),
                "a finite number, 0 or greater",
            );
        } else if value > LARGEST {
            let accepted = format!("a number from 0 to {LARGEST:e}");
            self.add(path, Number(value).to_string(), accepted);
        }
    }

    /// Finite; whether it is.
    pub(super) fn finite(&mut self, path: impl Into<String>, value: f64) -> bool {
        let accepted = if !value.is_finite() {
            "a finite number".to_owned()
        } else if value.abs() > LARGEST {
            format!("a number from -{LARGEST:e} to {LARGEST:e}")
        } else {
            return true;
        };
        self.add(path, Number(value).to_string(), accepted);
        false
    }

    /// Checks a number from `low` to `high`, both included.
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
            if !self.finite(format!("{path}[{axis}]"), *x) {
                continue;
            }
            if axis >= self.dimension.axes() && *x != 0.0 {
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
