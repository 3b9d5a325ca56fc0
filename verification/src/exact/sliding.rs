//! Blocks that slide on an incline under Coulomb friction (contact manual, eq. 9, with stick and lift-off).
//!
//! Blocks that start from rest; rigid, but for [`Slope::elastic_displacement`].

/// A block on an incline, in the frame of the incline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// Gravity along the incline, `g sin(theta)` downhill, m/s².
    pub along: f64,
    /// Gravity into the incline, `g cos(theta)`, m/s²; negative where it lifts the block off.
    pub into: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl Slope {
    /// True if the block stays at rest: `|g sin(theta)| <= mu g cos(theta)`.
    #[must_use]
    pub fn sticks(&self) -> bool {
        self.into >= 0.0 && self.along.abs() <= self.friction * self.into
    }

    /// Normal force over the mass, m/s².
    #[must_use]
    pub fn normal(&self) -> f64 {
        self.into.max(0.0)
    }

    /// Acceleration along the incline, m/s²: `g sin(theta) - mu g cos(theta)`, or zero where the block sticks.
    #[must_use]
    pub fn acceleration(&self) -> f64 {
        if self.sticks() {
            return 0.0;
        }
        self.along - self.friction * self.normal() * self.along.signum()
    }

    /// Displacement along the incline (m) at `t` (s) after a start from rest, eq. (9).
    #[must_use]
    pub fn displacement(&self, t: f64) -> f64 {
        0.5 * self.acceleration() * t * t
    }

    /// Displacement of the centre of mass (m) of a wide elastic block that slides, of `height` (m) and shear wave speed
    /// `shear_speed` (m/s), at `t` (s) after tangential gravity and friction begin to act on it at rest.
    ///
    /// Its base sticks until the shear wave from it has brought the traction rho c_s g_x t to mu rho g_n H, at
    /// t* = mu g_n H/(c_s g_x). Until then friction is smaller than the limit, which leaves the block faster by
    /// mu g_n t*/2 for good. For t >= t* and t* <= 2H/c_s.
    #[must_use]
    pub fn elastic_displacement(&self, t: f64, height: f64, shear_speed: f64) -> f64 {
        if self.sticks() {
            return 0.0;
        }
        let limit = self.friction * self.normal();
        let onset = limit * height / (shear_speed * self.along.abs());
        let gained = 0.5 * limit * onset * self.along.signum();
        self.displacement(t) + gained * (t - onset / 3.0)
    }
}

/// Time (s) at which a block behind runs into the one in front of it, both released at once; `gap` (m) between them.
/// `None` if it never does. Until then each slides as if it were alone.
#[must_use]
pub fn time_of_meeting(behind: &Slope, front: &Slope, gap: f64) -> Option<f64> {
    let closing = behind.acceleration() - front.acceleration();
    (closing > 0.0).then(|| (2.0 * gap / closing).sqrt())
}
