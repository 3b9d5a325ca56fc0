//! A rigid disk that is let go on an inclined plane: rolling, or sliding and turning (Coulomb friction).

/// Disk and plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingDisk {
    /// Gravity \[m/s²\].
    pub gravity: f64,
    /// Inclination of the plane \[rad\].
    pub inclination: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Radius \[m\].
    pub radius: f64,
}

impl RollingDisk {
    /// True if it rolls without slip: tan(theta) <= 3 mu, as friction must give a third of the pull down the plane.
    #[must_use]
    pub fn sticks(&self) -> bool {
        libm::tan(self.inclination) <= 3.0 * self.friction
    }

    /// Acceleration along the plane \[m/s²\] and angular acceleration \[1/s²\] (Liang et al. 2024, eq. 60).
    #[must_use]
    pub fn accelerations(&self) -> (f64, f64) {
        let (sin, cos) = libm::sincos(self.inclination);
        if self.sticks() {
            let a = 2.0 / 3.0 * self.gravity * sin;
            (a, a / self.radius)
        } else {
            (
                self.gravity * (sin - self.friction * cos),
                2.0 * self.friction * self.gravity * cos / self.radius,
            )
        }
    }

    /// Way along the plane \[m\] and turn \[rad\] after a time \[s\].
    #[must_use]
    pub fn way_and_turn(&self, time: f64) -> (f64, f64) {
        let (a, alpha) = self.accelerations();
        (0.5 * a * time * time, 0.5 * alpha * time * time)
    }

    /// Circumferential over translational speed, omega R/v: 1 where it rolls, 2 mu cos/(sin - mu cos) where it slides.
    #[must_use]
    pub fn rolling_ratio(&self) -> f64 {
        let (a, alpha) = self.accelerations();
        alpha * self.radius / a
    }
}
