//! A bar that is drawn slowly and parts in one band: equilibrium of an elastic bar with a cohesive crack (Hillerborg 1976).
//!
//! The stress is uniform. Up to the strength f the bar is elastic; from then on a band opens by w and carries f (1 - w/w_f),
//! so that the end has moved by w + s L/E. The band takes G_f = f w_f/2 per area until it has parted.

/// A bar with a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SofteningBar {
    /// Length L, m.
    pub length: f64,
    /// Young's modulus E, Pa; no strain across.
    pub young: f64,
    /// Strength f, Pa.
    pub strength: f64,
    /// Opening w_f at which the band carries nothing any more, m; greater than f L/E, or the end would have to move back.
    pub opening: f64,
}

impl SofteningBar {
    /// Energy that the band takes per area until it has parted, J/m².
    #[must_use]
    pub fn fracture_energy(&self) -> f64 {
        0.5 * self.strength * self.opening
    }

    /// Displacement of the end, m, at which the band begins to open.
    #[must_use]
    pub fn elastic_end(&self) -> f64 {
        self.strength * self.length / self.young
    }

    /// Stress, Pa, where the end has moved by a displacement (m) that never fell.
    #[must_use]
    pub fn stress(&self, displacement: f64) -> f64 {
        let elastic = self.elastic_end();
        if displacement <= elastic {
            return self.young * displacement / self.length;
        }
        let opened = (displacement - elastic) / (1.0 - elastic / self.opening);
        self.strength * (1.0 - opened / self.opening).max(0.0)
    }
}
