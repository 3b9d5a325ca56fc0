//! Constants of laws, as scene files spell them.

/// A number that a law needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    /// Key in scene files.
    pub key: &'static str,
    /// Meaning of the constant.
    pub meaning: &'static str,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Accepted values.
    pub accepted: ConstantRange,
    /// Value if the scene gives none.
    pub given: ConstantDefault,
}

/// Default of a constant that a scene leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConstantDefault {
    /// Nothing: the scene must say.
    Needed,
    /// A number.
    Or(f64),
    /// Value of an earlier constant of the law, by its key.
    As(&'static str),
}

/// Range of the accepted values of a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConstantRange {
    /// Finite and greater than zero.
    Positive,
    /// Finite, zero or greater.
    NotNegative,
    /// Between two numbers, neither included.
    Between(f64, f64),
    /// The first number or greater, and less than the second.
    From(f64, f64),
    /// Any finite number.
    Finite,
}

/// Rows of a curve.
pub type Rows = Vec<[f64; 2]>;

/// A curve that a law may be given: rows of two numbers, none where a scene does not say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// Key in scene files.
    pub key: &'static str,
    /// Meaning of the constant.
    pub meaning: &'static str,
    /// SI units of both columns; empty for a plain number.
    pub units: [&'static str; 2],
    /// Rows that it may have.
    pub example: &'static [[f64; 2]],
}

/// A constant that is invalid beside the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidConstant {
    /// Its key.
    pub key: &'static str,
    /// Value that was found.
    pub found: String,
    /// Values that are accepted.
    pub accepted: String,
}

impl ConstantRange {
    /// True if a value is accepted.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Positive => value > 0.0,
                Self::NotNegative => value >= 0.0,
                Self::Between(low, high) => low < value && value < high,
                Self::From(low, high) => low <= value && value < high,
                Self::Finite => true,
            }
    }
}

impl Constant {
    /// The values in words: "a number greater than 0 \[Pa\]".
    #[must_use]
    pub fn words(&self) -> String {
        let number = match self.accepted {
            ConstantRange::Positive => "a number greater than 0".to_owned(),
            ConstantRange::NotNegative => "a number, 0 or greater".to_owned(),
            ConstantRange::Between(low, high) => {
                format!("a number greater than {low} and less than {high}")
            }
            ConstantRange::From(low, high) => {
                format!("a number, {low} or greater and less than {high}")
            }
            ConstantRange::Finite => "a finite number".to_owned(),
        };
        match self.unit {
            "" => number,
            unit => format!("{number} [{unit}]"),
        }
    }
}
