//! Two elastic bars that collide end to end: waves in one dimension (Saint-Venant 1867; Goldsmith, Impact, ch. 4).
//!
//! The interface moves with `(Z1 v1 + Z2 v2)/(Z1 + Z2)`, Z the impedance rho c, under the stress
//! `Z1 Z2/(Z1 + Z2) (v1 - v2)`, until the first reflection from a free end comes back. The solution is closed in two
//! families: *equal transit times*, where both bars are free of stress at that moment and part with the velocities of
//! an elastic impact of points, whatever their masses; and *equal impedances*, where the shorter bar has given its
//! velocity to the part of the longer one that the wave has reached, and the longer one keeps a wave: restitution is
//! the ratio of the lengths.

/// An elastic bar in uniform motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingBar {
    /// Length, m.
    pub length: f64,
    /// Modulus along the bar, Pa.
    pub modulus: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Velocity before the impact, m/s.
    pub velocity: f64,
}

impl MovingBar {
    /// Wave speed, m/s.
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        (self.modulus / self.density).sqrt()
    }

    /// Impedance, Pa s/m.
    #[must_use]
    pub fn impedance(&self) -> f64 {
        self.density * self.wave_speed()
    }

    /// Time that a wave takes along the bar, s.
    #[must_use]
    pub fn transit(&self) -> f64 {
        self.length / self.wave_speed()
    }

    /// Mass per cross-section, kg/m².
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * self.length
    }

    /// What the bar does at a rigid wall that it runs into: the limit of a second bar of any impedance.
    #[must_use]
    pub fn at_a_wall(&self) -> WallImpact {
        WallImpact {
            stress: self.impedance() * self.velocity.abs(),
            duration: 2.0 * self.transit(),
            velocity: -self.velocity,
        }
    }
}

/// The impact of a bar on a rigid wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallImpact {
    /// Pressure on the wall while they touch, Pa: rho c v.
    pub stress: f64,
    /// Time for which they touch, s: twice the transit.
    pub duration: f64,
    /// Velocity after the rebound, m/s.
    pub velocity: f64,
}

/// A bar that runs into another in front of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarImpact {
    /// The two bars, the one behind first.
    pub bars: [MovingBar; 2],
}

impl BarImpact {
    /// Compressive stress at the interface while the bars touch, Pa.
    #[must_use]
    pub fn stress(&self) -> f64 {
        let [a, b] = &self.bars;
        let (z_a, z_b) = (a.impedance(), b.impedance());
        z_a * z_b / (z_a + z_b) * (a.velocity - b.velocity)
    }

    /// Time for which the bars press on each other, s; `None` outside the two families.
    #[must_use]
    pub fn duration(&self) -> Option<f64> {
        let [a, b] = &self.bars;
        let same = |p: f64, q: f64| (p - q).abs() <= 1e-9 * p.max(q);
        let closed = same(a.transit(), b.transit()) || same(a.impedance(), b.impedance());
        (closed && a.velocity > b.velocity).then(|| 2.0 * a.transit().min(b.transit()))
    }

    /// Mean velocities of the bars after the impact, m/s: each changes by the impulse over its mass.
    #[must_use]
    pub fn velocities(&self) -> Option<[f64; 2]> {
        let impulse = self.stress() * self.duration()?;
        let [a, b] = &self.bars;
        Some([
            a.velocity - impulse / a.mass(),
            b.velocity + impulse / b.mass(),
        ])
    }

    /// Coefficient of restitution: speed of parting over speed of approach.
    #[must_use]
    pub fn restitution(&self) -> Option<f64> {
        let [after_a, after_b] = self.velocities()?;
        let [a, b] = &self.bars;
        Some((after_b - after_a) / (a.velocity - b.velocity))
    }
}
