//! The head-on impact of two equal elastic rings, by finite elements of our own: one ring against its mirror image
//! (Liang et al. 2024, section 4.4, with the lengths that its times belong to; Nguyen et al. 2020).
//!
//! The barrier between the rings is that of the paper, so that what is compared is the method, not the law of contact.

use super::fe::{Barrier, Failure, Mesh, Model, NeoHookean};
use std::f64::consts::PI;

/// One of the two rings; the other is its image behind x = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingImpact {
    /// Inner radius \[m\].
    pub inner: f64,
    /// Outer radius \[m\].
    pub outer: f64,
    /// Initial distance of the ring's surface from the plane, half the gap \[m\].
    pub distance: f64,
    /// Speed towards the plane \[m/s\].
    pub speed: f64,
    /// Material.
    pub material: NeoHookean,
    /// Contact.
    pub barrier: Barrier,
}

/// State of one ring at a time; per 1 m of thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time \[s\].
    pub time: f64,
    /// Contact force \[N\].
    pub force: f64,
    /// Kinetic energy \[J\].
    pub kinetic: f64,
    /// Strain energy \[J\].
    pub strain: f64,
    /// Half the energy of the barrier \[J\].
    pub barrier: f64,
}

/// Sums of the contact forces of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// First time with more than a share of the largest force \[s\].
    pub begin: f64,
    /// Last such time \[s\].
    pub end: f64,
    /// Impulse \[N s\].
    pub impulse: f64,
}

/// Share of the largest force below which there is no contact.
pub const THRESHOLD: f64 = 1e-3;

impl Contact {
    /// Contact from times \[s\] and forces \[N\], which are joined by straight lines; `None` without any force.
    #[must_use]
    pub fn of(history: &[(f64, f64)]) -> Option<Self> {
        let largest = history.iter().map(|h| h.1).fold(0.0, f64::max);
        let mut within = history.iter().filter(|h| h.1 > THRESHOLD * largest);
        let begin = within.next()?.0;
        Some(Self {
            begin,
            end: within.next_back().map_or(begin, |h| h.0),
            impulse: history
                .windows(2)
                .map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0))
                .sum(),
        })
    }
}

impl RingImpact {
    /// Samples at the end of each of `count` intervals \[s\], and the state at the start before them, with `elements`
    /// along the radius and as many around as make them about square at the outer radius.
    ///
    /// # Errors
    /// [`Failure`] if an element turns inside out.
    pub fn history(
        &self,
        elements: usize,
        interval: f64,
        count: usize,
    ) -> Result<Vec<Sample>, Failure> {
        let height = (self.outer - self.inner) / elements as f64;
        let around = (PI * self.outer / height).round() as usize;
        let center = [-self.distance - self.outer, 0.0];
        let mesh = Mesh::half_ring(center, self.inner, self.outer, [elements, around]);
        let mut model = Model::new(mesh, self.material)?;
        model.velocities.fill([self.speed, 0.0]);
        // The lower half mirrors the upper one.
        for end in [0, around * (elements + 1)] {
            for held in &mut model.held[end..=end + elements] {
                held[1] = true;
            }
        }
        model.mirror = Some(self.barrier);
        let sample = |model: &Model| Sample {
            time: model.time(),
            force: 2.0 * model.barrier_force(),
            kinetic: 2.0 * model.kinetic_energy(),
            strain: 2.0 * model.strain_energy(),
            barrier: 2.0 * model.barrier_energy(),
        };
        let mut samples = vec![sample(&model)];
        for k in 1..=count {
            model.advance_to(interval * k as f64)?;
            samples.push(sample(&model));
        }
        Ok(samples)
    }
}
