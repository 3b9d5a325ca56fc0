//! The bar of a value on the finest of three meshes, and the verdict on how the values settle.
//!
//! MPM has no formal order: displacements are of order 2, stresses of 1 to 1.5, impacts of 0.6 to 0.75, limit loads of
//! 0.75 to 0.9. Orders also fall on the way, as particles cross cells. So the order is taken from the three meshes, capped at
//! [`HIGHEST_USED`], and one above [`HIGHEST_SEEN`] counts as 1.

use std::fmt;

/// Least order seen of values that settle.
pub const LEAST: f64 = 0.5;
/// Highest order that the width of a bar uses.
pub const HIGHEST_USED: f64 = 1.5;
/// Highest order seen that is believed.
pub const HIGHEST_SEEN: f64 = 2.3;
/// Highest order that an extrapolation uses.
pub const HIGHEST_EXTRAPOLATED: f64 = 2.0;
/// Differences below this part of the scale are round-off.
pub const ROUND_OFF: f64 = 1e-9;
/// Orders beyond this are not told apart.
const BOUND: f64 = 20.0;

/// The way in which values on finer and finer meshes settle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The values agree to round-off.
    Same,
    /// Differences fall with an order from [`LEAST`] to [`HIGHEST_SEEN`].
    Asymptotic,
    /// Differences fall faster than the method can; the bar takes order 1.
    TooFast,
    /// Differences fall with an order below [`LEAST`], or grow.
    TooSlow,
    /// Differences change their sign.
    Swings,
}

impl Verdict {
    /// True where a bar is claimed to hold the answer of an infinitely fine mesh.
    #[must_use]
    pub fn claims(self) -> bool {
        matches!(self, Self::Same | Self::Asymptotic | Self::TooFast)
    }

    /// The verdict in a word or a few.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Same => "same on all meshes",
            Self::Asymptotic => "asymptotic",
            Self::TooFast => "too fast, takes 1",
            Self::TooSlow => "settles too slowly",
            Self::Swings => "swings",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// Constants of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Safety factor F on the estimated error.
    pub factor: f64,
    /// Order above which order 1 is taken.
    pub too_fast: f64,
}

impl Rule {
    /// The rule for a value, and for a curve by time.
    pub const VALUE: Self = Self {
        factor: 1.5,
        too_fast: HIGHEST_SEEN,
    };
    /// The rule for the norm of a difference, over a field or in time.
    pub const NORM: Self = Self {
        factor: 2.0,
        ..Self::VALUE
    };
    /// The rule before its line for high orders, which was added after the misses in the held-out half were seen.
    pub const WITHOUT_CEILING: Self = Self {
        too_fast: f64::INFINITY,
        ..Self::VALUE
    };

    /// The bar at the finest of three meshes with cells `h` \[m\], coarse to fine, for the differences
    /// `f(h1) - f(h2)` and `f(h2) - f(h3)` of a quantity whose size is `scale`, all in the unit of the quantity.
    #[must_use]
    pub fn estimate(&self, h: [f64; 3], differences: [f64; 2], scale: f64) -> Estimate {
        let [d1, d2] = differences;
        let r = h[1] / h[2];
        let fall = (h[1] * h[1] - h[2] * h[2]) / (h[0] * h[0] - h[1] * h[1]);
        // The coarse pair guards against a difference that is small by chance.
        let guarded = d2.abs().max(d1.abs() * fall);
        let order = order(h, differences);
        let verdict = if d1.abs().max(d2.abs()) <= ROUND_OFF * scale.abs() {
            Verdict::Same
        } else {
            match order {
                None => Verdict::Swings,
                Some(p) if p > self.too_fast => Verdict::TooFast,
                Some(p) if p >= LEAST => Verdict::Asymptotic,
                Some(_) => Verdict::TooSlow,
            }
        };
        let at = |p: f64| guarded / (libm::pow(r, p) - 1.0);
        let width = match verdict {
            Verdict::Same => guarded,
            Verdict::Asymptotic => {
                self.factor * at(order.unwrap_or(HIGHEST_USED).min(HIGHEST_USED))
            }
            Verdict::TooFast => self.factor * at(1.0),
            Verdict::TooSlow | Verdict::Swings => 2.0 * self.factor * at(LEAST),
        };
        Estimate {
            verdict,
            order,
            width,
            difference: guarded,
            to_limit: match (verdict, order) {
                (Verdict::Asymptotic, Some(p)) => {
                    Some(-d2 / (libm::pow(r, p.min(HIGHEST_EXTRAPOLATED)) - 1.0))
                }
                _ => None,
            },
            ratio: r,
        }
    }
}

/// The estimate of a quantity on the finest of three meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The way in which the values settle.
    pub verdict: Verdict,
    /// Order seen; `None` where the differences change their sign.
    pub order: Option<f64>,
    /// Half-width of the bar around the value on the finest mesh, in the unit of the quantity. It is claimed only where
    /// [`Verdict::claims`] says so.
    pub width: f64,
    /// Difference of the two finest meshes, or that of the coarser two reduced by order 2 where it is larger.
    pub difference: f64,
    /// Difference from the value on the finest mesh to the extrapolated one, where the values are asymptotic.
    pub to_limit: Option<f64>,
    /// Ratio of the two finest cell sizes.
    pub ratio: f64,
}

impl Estimate {
    /// Cell size \[m\] at which the error is `error`, in the unit of the quantity, foretold from the finest cell size `h`
    /// \[m\]; `None` where no bar is claimed by the order seen.
    #[must_use]
    pub fn cell_for(&self, h: f64, error: f64) -> Option<f64> {
        if self.verdict != Verdict::Asymptotic {
            return None;
        }
        let p = self.order?.clamp(LEAST, HIGHEST_EXTRAPOLATED);
        let now = self.difference / (libm::pow(self.ratio, p) - 1.0);
        (error > 0.0 && now > 0.0).then(|| h * libm::pow(error / now, 1.0 / p))
    }
}

/// The order p with `D1/D2 = (h1^p - h2^p)/(h2^p - h3^p)`, from -20 to 20; `None` where the differences change their sign or
/// are both zero.
#[must_use]
pub fn order(h: [f64; 3], [d1, d2]: [f64; 2]) -> Option<f64> {
    if d1 * d2 < 0.0 || (d1 == 0.0 && d2 == 0.0) || d1.is_nan() || d2.is_nan() {
        return None;
    }
    if d2 == 0.0 {
        return Some(BOUND);
    }
    let (coarse, fine) = (h[0] / h[1], h[1] / h[2]);
    let ratio = |p: f64| {
        if p.abs() < 1e-9 {
            return libm::log(coarse) / libm::log(fine);
        }
        (libm::pow(coarse, p) - 1.0) / (1.0 - libm::pow(fine, -p))
    };
    let seen = d1 / d2;
    let (mut low, mut high) = (-BOUND, BOUND);
    // The ratio grows with p: bisection to the last digits.
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if ratio(middle) < seen {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}
