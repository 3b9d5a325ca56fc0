//! Friction, cohesion, dilation and tensile strength, as the laws of soils and rocks share them.

use super::{Constant, ConstantDefault, ConstantRange, InvalidConstant};

/// The angle of friction.
pub(super) const FRICTION: Constant = Constant {
    key: "friction",
    meaning: "Angle of internal friction",
    unit: "°",
    accepted: ConstantRange::From(0.0, 90.0),
    given: ConstantDefault::Needed,
};

/// The cohesion.
pub(super) const COHESION: Constant = Constant {
    key: "cohesion",
    meaning: "Cohesion",
    unit: "Pa",
    accepted: ConstantRange::NotNegative,
    given: ConstantDefault::Needed,
};

/// The angle of dilation.
pub(super) const DILATION: Constant = Constant {
    key: "dilation",
    meaning: "Angle of dilation, at most that of friction",
    unit: "°",
    accepted: ConstantRange::Between(-90.0, 90.0),
    given: ConstantDefault::Or(0.0),
};

/// The tensile strength.
pub(super) const TENSILE: Constant = Constant {
    key: "tensile",
    meaning: "Tensile strength; 0 stands for the greatest that friction and cohesion admit, c cot(phi)",
    unit: "Pa",
    accepted: ConstantRange::NotNegative,
    given: ConstantDefault::Or(0.0),
};

/// Sine and cosine of an angle in degrees.
pub(super) fn sine_and_cosine(degrees: f64) -> (f64, f64) {
    let angle = degrees.to_radians();
    (libm::sin(angle), libm::cos(angle))
}

/// A tension that no stress reaches, small enough to be added and multiplied with moduli.
const NONE: f64 = 1e200;

/// Tension at which friction alone ends, c cot phi \[Pa\].
pub(super) fn apex(sine: f64, cosine: f64, cohesion: f64) -> f64 {
    if sine > 0.0 {
        (cohesion * cosine / sine).min(NONE)
    } else {
        NONE
    }
}

/// The largest tension \[Pa\] of a tensile strength, of which 0 is none.
pub(super) fn largest_tension(tensile: f64, sine: f64, cosine: f64, cohesion: f64) -> f64 {
    let apex = apex(sine, cosine, cohesion);
    if tensile > 0.0 {
        tensile.min(apex)
    } else {
        apex
    }
}

/// Warnings of constants that probably mean something else.
pub(super) fn warnings(friction: f64, dilation: f64) -> Vec<String> {
    let mut all = vec![];
    if friction > 0.0 && friction < std::f64::consts::FRAC_PI_2 {
        all.push(format!(
            "a friction of {friction} degrees looks like radians; {friction} radians are {:.4} degrees",
            friction.to_degrees()
        ));
    }
    if dilation < 0.0 {
        all.push(format!(
            "a dilation of {dilation} degrees: the material shrinks for as long as it is sheared"
        ));
    }
    all
}

/// Constants that do not go together.
pub(super) fn problems(
    friction: f64,
    dilation: f64,
    cohesion: f64,
    tensile: f64,
) -> Vec<InvalidConstant> {
    let mut found = vec![];
    if dilation > friction {
        found.push(InvalidConstant {
            key: DILATION.key,
            found: format!(
                "{dilation}, more than the friction of {friction} [°]: flow would do negative work"
            ),
            accepted: format!("a number up to {friction} [°]"),
        });
    }
    if friction == 0.0 && cohesion == 0.0 {
        found.push(InvalidConstant {
            key: COHESION.key,
            found: "0 with a friction of 0: no strength at all".to_owned(),
            accepted: "a number greater than 0 [Pa], or a friction greater than 0".to_owned(),
        });
    }
    let (sine, cosine) = sine_and_cosine(friction);
    let most = apex(sine, cosine, cohesion);
    // Printed numbers may lie a rounding above it.
    if tensile > most * (1.0 + 1e-9) {
        found.push(InvalidConstant {
            key: TENSILE.key,
            found: format!("{tensile}, more than friction and cohesion admit"),
            accepted: format!("a number up to c cot(phi) = {most} [Pa]"),
        });
    }
    found
}
