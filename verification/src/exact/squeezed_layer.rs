//! A layer that consolidates at large strain, with water that can be compressed: the equation of Xie and Leo 2004, and one term
//! more.
//!
//! The skeleton has `sigma' = E_c ln J`, the conductivity is `k J²`, nothing has weight, and the load q(t) is borne by both: p = q +
//! `E_c ln J`. With a the height at the start, n = 1 - (1 - `n_0`)/J and the balance of the water
//! `p_t = -(K_w/n) (J_t/J - (c/J) J_aa)`, `c = E_c k/(rho_w g)`,
//!
//! `(1 + n E_c/K_w) J_t = c J_aa - (n/K_w) q_t J`,  `J = e^(-q/E_c)` at the drained top, `J_a = 0` at the shut base.
//!
//! Without the terms of `K_w` it is linear, and `exact/consolidation.rs` has its series. Solved by central differences of second
//! order in both. `q = Q (10 s³ - 15 s⁴ + 6 s⁵)`, `s = t/t_r`.

/// The layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SqueezedLayer {
    /// Height H at the start, m.
    pub height: f64,
    /// Confined modulus of the skeleton `E_c`, Pa.
    pub confined_modulus: f64,
    /// Bulk modulus of the water `K_w`, Pa; infinite for water that keeps its volume.
    pub bulk_water: f64,
    /// Porosity at the start `n_0`.
    pub porosity: f64,
    /// Hydraulic conductivity at the start over the weight of water `k/(rho_w g)`, m⁴/(N s).
    pub mobility: f64,
    /// Load Q, Pa.
    pub load: f64,
    /// Time in which it comes on, s.
    pub ramp: f64,
}

/// The layer at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct SqueezedState {
    layer: SqueezedLayer,
    /// Load that acts, Pa.
    load: f64,
    /// J at points of equal distance, from the base to the top.
    volumes: Vec<f64>,
}

/// Intervals of the height.
const INTERVALS: usize = 400;
/// Steps of the time in which the load comes on, and of the time after it.
const STEPS: [usize; 2] = [1000, 3000];
/// Iterations of the porosity in a step: each gains the digits of its change.
const ITERATIONS: usize = 4;

impl SqueezedLayer {
    /// The layer at a time (s).
    #[must_use]
    pub fn at(&self, t: f64) -> SqueezedState {
        let mut volumes = vec![1.0; INTERVALS + 1];
        let mut from = 0.0;
        for (until, steps) in [(t.min(self.ramp), STEPS[0]), (t, STEPS[1])] {
            let dt = (until - from) / steps as f64;
            if dt > 0.0 {
                for step in 0..steps {
                    let now = from + step as f64 * dt;
                    self.step(&mut volumes, now, dt);
                }
            }
            from = until;
        }
        SqueezedState {
            layer: *self,
            load: self.load_at(t),
            volumes,
        }
    }

    fn load_at(&self, t: f64) -> f64 {
        let s = (t / self.ramp).clamp(0.0, 1.0);
        self.load * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
    }

    /// One step of the trapezoidal rule.
    fn step(&self, volumes: &mut Vec<f64>, t: f64, dt: f64) {
        let spacing = self.height / INTERVALS as f64;
        let half = 0.5 * dt * self.mobility * self.confined_modulus / (spacing * spacing);
        let [before, after] = [t, t + dt].map(|t| self.load_at(t));
        let top = libm::exp(-after / self.confined_modulus);
        let bend = |of: &[f64], i: usize| {
            let below = if i == 0 { of[1] } else { of[i - 1] };
            below - 2.0 * of[i] + of[i + 1]
        };
        let mut next = volumes.clone();
        for _ in 0..ITERATIONS {
            // Elimination from the base up: J_i = a_i J_(i+1) + b_i.
            let (mut a, mut b) = (vec![0.0; INTERVALS], vec![0.0; INTERVALS]);
            for i in 0..INTERVALS {
                let middle = 0.5 * (volumes[i] + next[i]);
                let pores = (1.0 - (1.0 - self.porosity) / middle) / self.bulk_water;
                let inertia = 1.0 + pores * self.confined_modulus;
                let known = inertia * volumes[i] + half * bend(volumes, i)
                    - pores * (after - before) * middle;
                let diagonal = inertia + 2.0 * half;
                if i == 0 {
                    (a[0], b[0]) = (2.0 * half / diagonal, known / diagonal);
                } else {
                    let left = diagonal - half * a[i - 1];
                    (a[i], b[i]) = (half / left, (known + half * b[i - 1]) / left);
                }
            }
            next[INTERVALS] = top;
            for i in (0..INTERVALS).rev() {
                next[i] = a[i] * next[i + 1] + b[i];
            }
        }
        *volumes = next;
    }
}

impl SqueezedState {
    /// Volume over that at the start, of the soil that was at the height `z` (m).
    #[must_use]
    pub fn volume(&self, z: f64) -> f64 {
        let at = (z / self.layer.height).clamp(0.0, 1.0) * INTERVALS as f64;
        let below = (at as usize).min(INTERVALS - 1);
        let share = at - below as f64;
        (1.0 - share) * self.volumes[below] + share * self.volumes[below + 1]
    }

    /// Pressure of the water, Pa, of the soil that was at the height `z` (m).
    #[must_use]
    pub fn pressure(&self, z: f64) -> f64 {
        self.load + self.layer.confined_modulus * libm::log(self.volume(z))
    }

    /// Displacement of the soil that was at the height `z` (m), m: the integral of J - 1, piece by piece.
    #[must_use]
    pub fn displacement(&self, z: f64) -> f64 {
        let spacing = self.layer.height / INTERVALS as f64;
        let whole = ((z / spacing) as usize).min(INTERVALS);
        let mean = |i: usize| 0.5 * (self.volumes[i] + self.volumes[i + 1]) - 1.0;
        let below: f64 = (0..whole).map(mean).sum::<f64>() * spacing;
        let rest = z - whole as f64 * spacing;
        let edge = 0.5 * (self.volume(whole as f64 * spacing) + self.volume(z)) - 1.0;
        below + edge * rest
    }
}
