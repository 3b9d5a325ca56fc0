//! Strength that falls with plastic strain, and how scene files say it.

use crate::functions;
use crate::{Choice, Constant, ConstantDefault, ConstantRange, InvalidConstant};
use proctor_kernel::lanes::Lanes;

/// Fall of the strength from its peak to the residual strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Softening {
    /// Not at all.
    None,
    /// The share exp(-eta k) of the way is left at a plastic strain k.
    Exponential {
        /// eta.
        eta: f64,
    },
    /// Along a straight line between two plastic strains.
    Linear {
        /// Plastic strain at which it begins.
        from: f64,
        /// Plastic strain at which it ends.
        to: f64,
    },
}

impl Softening {
    /// The share of the way from residual to peak that is left at a plastic strain.
    #[inline(always)]
    pub(super) fn left<L: Lanes>(self, strain: L) -> L {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        match self {
            Self::None => one,
            Self::Exponential { eta } => functions::exp(-(L::splat(eta) * strain)),
            Self::Linear { from, to } => {
                let left = (L::splat(to) - strain) * L::splat(1.0 / (to - from));
                one.min(zero.max(left))
            }
        }
    }
}

impl Softening {
    /// The steepest that the share falls with plastic strain.
    pub(super) fn steepest(self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Exponential { eta } => eta,
            Self::Linear { from, to } => 1.0 / (to - from),
        }
    }
}

/// Residual values of friction, cohesion, dilation and tensile strength; `None` where it stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// Angle of friction \[°\].
    pub friction: Option<f64>,
    /// Cohesion \[Pa\].
    pub cohesion: Option<f64>,
    /// Angle of dilation \[°\].
    pub dilation: Option<f64>,
    /// Tensile strength \[Pa\].
    pub tensile: Option<f64>,
}

/// Words for what softens.
const ELSEWHERE: &str = "softening for a {law} material, which has none";

/// The keys that are words: how it softens, and whether friction, cohesion, dilation and tensile strength do.
pub(super) const CHOICES: [Choice; 5] = [
    Choice {
        key: "softening",
        words: &["none", "exponential", "linear"],
        meaning: "How strength falls with the plastic strain.",
        elsewhere: ELSEWHERE,
    },
    active("softening.friction.active", "Whether friction softens."),
    active("softening.cohesion.active", "Whether cohesion softens."),
    active("softening.dilation.active", "Whether dilation softens."),
    active(
        "softening.tensile.active",
        "Whether the tensile strength softens.",
    ),
];

const fn active(key: &'static str, meaning: &'static str) -> Choice {
    Choice {
        key,
        words: &["false", "true"],
        meaning,
        elsewhere: ELSEWHERE,
    }
}

/// The keys that are numbers: eta, both marks, and the residual values of friction, cohesion, dilation and tensile strength.
pub(super) const CONSTANTS: [Constant; 7] = [
    Constant {
        key: "softening.exponential.eta",
        meaning: "Rate of exponential softening: the share exp(-eta k) of the way is left at a plastic strain k",
        unit: "",
        accepted: ConstantRange::NotNegative,
        given: ConstantDefault::Or(0.0),
    },
    Constant {
        key: "softening.linear.from",
        meaning: "Plastic strain at which linear softening begins",
        unit: "",
        accepted: ConstantRange::NotNegative,
        given: ConstantDefault::Or(0.0),
    },
    Constant {
        key: "softening.linear.to",
        meaning: "Plastic strain at which linear softening ends",
        unit: "",
        accepted: ConstantRange::NotNegative,
        given: ConstantDefault::Or(0.0),
    },
    Constant {
        key: "softening.friction.residual",
        meaning: "Angle of friction that is left",
        unit: "°",
        accepted: ConstantRange::From(0.0, 90.0),
        given: ConstantDefault::As("friction"),
    },
    Constant {
        key: "softening.cohesion.residual",
        meaning: "Cohesion that is left",
        unit: "Pa",
        accepted: ConstantRange::NotNegative,
        given: ConstantDefault::As("cohesion"),
    },
    Constant {
        key: "softening.dilation.residual",
        meaning: "Angle of dilation that is left",
        unit: "°",
        accepted: ConstantRange::Between(-90.0, 90.0),
        given: ConstantDefault::As("dilation"),
    },
    Constant {
        key: "softening.tensile.residual",
        meaning: "Tensile strength that is left",
        unit: "Pa",
        accepted: ConstantRange::NotNegative,
        given: ConstantDefault::As("tensile"),
    },
];

/// Softening of values of [`CONSTANTS`] and of numbers of words of [`CHOICES`].
pub(super) fn read(values: &[f64], choices: &[usize]) -> (Softening, Residual) {
    let softening = match choices[0] {
        0 => Softening::None,
        1 => Softening::Exponential { eta: values[0] },
        _ => Softening::Linear {
            from: values[1],
            to: values[2],
        },
    };
    let left = |i: usize| (choices[1 + i] == 1).then_some(values[3 + i]);
    let residual = Residual {
        friction: left(0),
        cohesion: left(1),
        dilation: left(2),
        tensile: left(3),
    };
    (softening, residual)
}

/// The values of [`CONSTANTS`] for the peak strength of friction, cohesion, dilation and tensile strength.
pub(super) fn values(softening: Softening, residual: &Residual, peak: [f64; 4]) -> Vec<f64> {
    let (eta, from, to) = match softening {
        Softening::None => (0.0, 0.0, 0.0),
        Softening::Exponential { eta } => (eta, 0.0, 0.0),
        Softening::Linear { from, to } => (0.0, from, to),
    };
    let left = [
        residual.friction,
        residual.cohesion,
        residual.dilation,
        residual.tensile,
    ];
    let left = left
        .into_iter()
        .zip(peak)
        .map(|(left, peak)| left.unwrap_or(peak));
    [eta, from, to].into_iter().chain(left).collect()
}

/// Constants that do not go together, for the peak strength of friction, cohesion, dilation and tensile strength.
pub(super) fn problems(
    softening: Softening,
    residual: &Residual,
    peak: [f64; 4],
) -> Vec<InvalidConstant> {
    let mut found = vec![];
    let mut add = |key, is: String, accepted: String| {
        found.push(InvalidConstant {
            key,
            found: is,
            accepted,
        });
    };
    let pairs = [
        (CONSTANTS[3].key, residual.friction, peak[0]),
        (CONSTANTS[4].key, residual.cohesion, peak[1]),
        (CONSTANTS[5].key, residual.dilation, peak[2]),
        (CONSTANTS[6].key, residual.tensile, peak[3]),
    ];
    match softening {
        Softening::None => {
            if let Some((key, ..)) = pairs.iter().find(|pair| pair.1.is_some()) {
                add(
                    CHOICES[0].key,
                    format!("none, and an active {}", key.replace(".residual", "")),
                    "`exponential` or `linear` where something softens".to_owned(),
                );
            }
        }
        Softening::Exponential { eta } => {
            if eta == 0.0 {
                add(
                    CONSTANTS[0].key,
                    "0, with which nothing softens".to_owned(),
                    "a number greater than 0".to_owned(),
                );
            }
        }
        Softening::Linear { from, to } => {
            if to <= from {
                add(
                    CONSTANTS[2].key,
                    format!("{to}, not beyond the beginning at {from}"),
                    format!("a number greater than {from}"),
                );
            }
        }
    }
    for (key, left, peak) in pairs {
        if let Some(left) = left
            && left > peak
        {
            add(
                key,
                format!("{left}, more than the {peak} that it softens from"),
                format!("a number up to {peak}"),
            );
        }
    }
    found
}
