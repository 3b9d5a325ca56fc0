//! A disk that rolls on a plane through a layer that transmits pressure across a gap, and on a tangential spring: it creeps.
//!
//! The brush of tyre mechanics (Johnson, Contact Mechanics, section 8.7; Pacejka), here with the turn of the rim. A
//! point of the rim at x in front of the middle moves along its own tangent with v cos(x/R) - omega R over the plane. With the creep
//! xi = (v - omega R)/v the spring at it is stretched by du/dx = xi - x²/(2 R²) as it passes, from nothing at the leading
//! edge, and held to the friction that the pressure there allows. The sum of the tractions is the force that rolls the
//! disk. Without a layer and with a stiff spring the creep is none.

use super::hertz_layer::LayerContact;

/// State of the contact of the disk and the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct RollingCreep {
    /// Pressure under the disk.
    pub contact: LayerContact,
    /// Radius \[m\].
    pub radius: f64,
    /// Stiffness of the tangential spring \[Pa/m\].
    pub stiffness: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl RollingCreep {
    /// Friction force per thickness at a creep \[N/m\].
    #[must_use]
    pub fn force(&self, creep: f64) -> f64 {
        let LayerContact { cell, pressure, .. } = &self.contact;
        let half = pressure.iter().enumerate();
        let half = half.map(|(k, p)| ((k as f64 + 0.5) * cell, *p));
        let passed = half.clone().rev().chain(half.map(|(x, p)| (-x, p)));
        let (mut stretch, mut force) = (0.0, 0.0);
        for (x, p) in passed {
            stretch += (creep - 0.5 * (x / self.radius).powi(2)) * cell;
            let most = self.friction * p;
            let traction = (self.stiffness * stretch).clamp(-most, most);
            stretch = traction / self.stiffness;
            force += traction * cell;
        }
        force
    }

    /// Creep at which the friction is a force per thickness \[N/m\]; `None` where friction cannot be so large.
    #[must_use]
    pub fn creep(&self, force: f64) -> Option<f64> {
        let (mut low, mut high) = (0.0, 1.0);
        if self.force(high) < force {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.force(middle) < force {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// Mean of the pressure over the force \[Pa\], int p² dx/int p dx.
    #[must_use]
    pub fn mean_pressure(&self) -> f64 {
        let p = &self.contact.pressure;
        p.iter().map(|p| p * p).sum::<f64>() / p.iter().sum::<f64>()
    }

    /// Half-width over which there is pressure \[m\].
    #[must_use]
    pub fn half_width(&self) -> f64 {
        let touching = self.contact.pressure.iter().filter(|p| **p > 0.0);
        touching.count() as f64 * self.contact.cell
    }
}
