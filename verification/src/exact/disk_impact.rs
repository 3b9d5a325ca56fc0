//! The head-on impact of two equal elastic disks, by finite elements of our own: one disk against its mirror image.
//!
//! A disk is a ring with a hole of 1/16 of its radius, which takes 0.4 % of its mass. The barrier at the plane of symmetry is so
//! thin and stiff that it stands for a hard contact.

use super::fe::{Barrier, Failure, NeoHookean};
use super::ring_impact::{RingImpact, Sample};
use std::f64::consts::PI;

/// Radius of the hole over that of the disk.
const HOLE: f64 = 1.0 / 16.0;
/// Thickness of the barrier over the radius.
const BARRIER: f64 = 5e-3;
/// Pressure of the barrier at half of its thickness, over Young's modulus, about.
const STIFFNESS: f64 = 1.0;

/// Share of that thickness below which the barrier is linear: its pressure there is some times Young's modulus.
const FLOOR: f64 = 0.3;

/// One of the two disks; the other is its image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiskImpact {
    /// Radius \[m\].
    pub radius: f64,
    /// Initial distance of the disk from the plane, half the gap \[m\].
    pub distance: f64,
    /// Speed towards the plane \[m/s\].
    pub speed: f64,
    /// Young's modulus \[Pa\] and Poisson's ratio.
    pub elasticity: [f64; 2],
    /// Density \[kg/m³\].
    pub density: f64,
}

impl DiskImpact {
    fn ring(&self) -> RingImpact {
        let [young, poisson] = self.elasticity;
        let (bulk, shear) = (
            young / (3.0 * (1.0 - 2.0 * poisson)),
            young / (2.0 * (1.0 + poisson)),
        );
        let critical_gap = BARRIER * self.radius;
        RingImpact {
            inner: HOLE * self.radius,
            outer: self.radius,
            distance: self.distance,
            speed: self.speed,
            material: NeoHookean::from_bulk(bulk, shear, self.density),
            barrier: Barrier {
                stiffness: STIFFNESS * young / critical_gap,
                critical_gap,
                floor: FLOOR,
            },
        }
    }

    /// Mass of the ring that stands for a disk \[kg/m\].
    fn mass(&self) -> f64 {
        self.density * PI * self.radius * self.radius * (1.0 - HOLE * HOLE)
    }

    /// Samples of one disk at the end of each of `count` intervals \[s\], the first at the start, with `elements` along the radius.
    ///
    /// # Errors
    /// [`Failure`] if an element turns inside out.
    pub fn history(
        &self,
        elements: usize,
        interval: f64,
        count: usize,
    ) -> Result<Vec<Sample>, Failure> {
        self.ring().history(elements, interval, count)
    }

    /// Speed of the centre after the impact, over that before it, from the impulse of the samples.
    #[must_use]
    pub fn restitution(&self, samples: &[Sample]) -> f64 {
        let impulse: f64 = (samples.windows(2))
            .map(|pair| 0.5 * (pair[0].force + pair[1].force) * (pair[1].time - pair[0].time))
            .sum();
        impulse / (self.mass() * self.speed) - 1.0
    }

    /// Strain energy of each sample over the kinetic energy at the start.
    #[must_use]
    pub fn strain_shares(&self, samples: &[Sample]) -> Vec<f64> {
        let initial = 0.5 * self.mass() * self.speed * self.speed;
        samples.iter().map(|s| s.strain / initial).collect()
    }
}
