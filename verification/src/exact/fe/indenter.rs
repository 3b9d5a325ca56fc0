//! A rigid circle that presses on a body through a barrier.

use super::barrier::Barrier;
use super::model::GAUSS;

/// A rigid circle with a prescribed way. The pressure of the barrier at a gap acts along the radius, on each length of the
/// circle: a surface that stands off by the gap g is longer than the circle by (R + g)/R.
#[derive(Clone, Copy, Debug)]
pub struct Indenter {
    /// Law of contact.
    pub barrier: Barrier,
    /// Radius R \[m\].
    pub radius: f64,
    /// Center \[m\] at a time \[s\].
    pub center: fn(f64) -> [f64; 2],
}

impl Indenter {
    /// Forces at a time \[s\] on the two ends of an edge that faces the circle \[N/m\], the body on the left of its
    /// direction.
    #[must_use]
    pub fn push(&self, time: f64, edge: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let [p, q] = edge;
        let center = (self.center)(time);
        let along = [q[0] - p[0], q[1] - p[1]];
        let mut forces = [[0.0; 2]; 2];
        for s in [0.5 - 0.5 * GAUSS, 0.5 + 0.5 * GAUSS] {
            let out: [f64; 2] = std::array::from_fn(|i| p[i] + s * along[i] - center[i]);
            let distance = libm::hypot(out[0], out[1]);
            let gap = distance - self.radius;
            if gap >= self.barrier.critical_gap {
                continue;
            }
            // Twice the area of the triangle over the edge, by the distance: what the edge covers of a circle through it.
            let across = (along[0] * out[1] - along[1] * out[0]).max(0.0) / distance;
            let (_, pressure, _) = self.barrier.at(gap);
            let push = 0.5 * pressure * across * self.radius / distance;
            for i in 0..2 {
                let force = push * out[i] / distance;
                forces[0][i] += (1.0 - s) * force;
                forces[1][i] += s * force;
            }
        }
        forces
    }
}
