//! A number that is read off the frames of a solver and reported, where no field of particles is exact.

use super::Snapshot;

/// Function that reads a number without a unit off frames.
type Read = Box<dyn Fn(&[Snapshot]) -> f64 + Send + Sync>;

/// A number that a case reads off frames, and the reference beside it. It has no bound but that which a user gives.
pub struct Reading {
    /// Its name, as `run-out over width` \[1\].
    pub name: &'static str,
    /// The reference.
    pub reference: f64,
    /// Source of the reference, in words.
    pub source: &'static str,
    read: Read,
}

/// A reading of the frames of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadValue {
    /// Name of the number.
    pub name: String,
    /// The number \[1\].
    pub value: f64,
    /// The reference \[1\].
    pub reference: f64,
    /// Source of the reference.
    pub source: String,
}

impl Reading {
    /// A number that `read` takes from the frames after the start, in the order of their times.
    #[must_use]
    pub fn new(
        name: &'static str,
        reference: f64,
        source: &'static str,
        read: impl Fn(&[Snapshot]) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self {
            name,
            reference,
            source,
            read: Box::new(read),
        }
    }

    /// The number of some frames.
    ///
    /// # Errors
    /// If it is not finite.
    pub fn of(&self, frames: &[Snapshot]) -> Result<ReadValue, String> {
        let value = (self.read)(frames);
        if value.is_finite() {
            Ok(ReadValue {
                name: self.name.to_owned(),
                value,
                reference: self.reference,
                source: self.source.to_owned(),
            })
        } else {
            Err(format!("a field that is not finite, or no {}", self.name))
        }
    }
}

impl ReadValue {
    /// Share by which the number is beyond or below its reference \[1\].
    #[must_use]
    pub fn off(&self) -> f64 {
        (self.value / self.reference - 1.0).abs()
    }
}
