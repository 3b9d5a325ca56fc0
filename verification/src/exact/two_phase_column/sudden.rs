//! A column of soil and water under loads that act at once: a traction, a pressure of its water, gravity.
//!
//! With `p = p_0 + p'` the pressure at the start moves nothing but the top, where it is gone at once: the skeleton is pulled there
//! by `(1 - n) p_0` and the water by `n p_0`. Gravity adds `-(1 - n) rho_s g` and `-n rho_w g` per volume. Each mode has forces
//! `(2/H) (sin(k_m H) T + b/k_m)` that stay, and comes to rest at the effective stress of the load and of the buoyant weight, and
//! at the pressure of water at rest.

use super::{TwoPhaseColumn, TwoPhaseState, exponential, scaled};

/// Loads that act from `t = 0` on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SuddenLoads {
    /// Pressure on the top, Pa.
    pub load: f64,
    /// Pressure of the water at the start, Pa; it is 0 at the top from then on.
    pub pressure: f64,
    /// Gravity, downwards, m/s².
    pub gravity: f64,
}

/// The column at a time after that.
#[derive(Clone, Debug, PartialEq)]
pub struct SuddenState {
    loads: SuddenLoads,
    /// Difference from the state at rest.
    apart: TwoPhaseState,
}

impl TwoPhaseColumn {
    /// The column under loads that act at once, at a time (s), by so many modes. Its own load and ramp do not count.
    #[must_use]
    pub fn after(&self, loads: SuddenLoads, t: f64, modes: usize) -> SuddenState {
        let n = self.porosity;
        let tractions = [(1.0 - n) * loads.pressure - loads.load, n * loads.pressure];
        let weights = [(1.0 - n) * self.density_grains, n * self.density_water];
        let mode = |m: usize| {
            let system = self.system(m);
            let top = if m % 2 == 1 { 1.0 } else { -1.0 };
            let force: [f64; 2] = std::array::from_fn(|i| {
                let weight = -weights[i] * loads.gravity;
                2.0 / self.height * (top * tractions[i] + weight / system.k)
            });
            // From rest x differs from that at rest by minus it.
            let at_rest = system.at_rest(force);
            let free = exponential(&scaled(&system.rates, t));
            let apart =
                std::array::from_fn(|i| -(0..2).map(|j| free[i][j] * at_rest[j]).sum::<f64>());
            system.displacements(apart)
        };
        SuddenState {
            loads,
            apart: TwoPhaseState {
                column: *self,
                share: 0.0,
                modes: (1..=modes).map(mode).collect(),
            },
        }
    }
}

impl SuddenState {
    /// Mean of the pressure of the water between two heights (m), Pa, compression positive.
    #[must_use]
    pub fn mean_pressure(&self, low: f64, high: f64) -> f64 {
        let column = &self.apart.column;
        let depth = column.height - 0.5 * (low + high);
        let at_rest = column.density_water * self.loads.gravity * depth;
        at_rest + self.apart.mean_pressure(low, high)
    }

    /// Displacement of the skeleton, m, at the height `z` (m).
    #[must_use]
    pub fn displacement(&self, z: f64) -> f64 {
        let column = &self.apart.column;
        let (n, h) = (column.porosity, column.height);
        let buoyant = (1.0 - n) * (column.density_grains - column.density_water);
        let stresses = self.loads.load * z + buoyant * self.loads.gravity * z * (h - 0.5 * z);
        self.apart.displacement(z) - stresses / column.confined_modulus
    }
}
