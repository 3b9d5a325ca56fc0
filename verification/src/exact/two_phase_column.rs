//! A column of soil and water under a load that comes on: the exact series with the inertia of both.
//!
//! Biot 1956 in one dimension, with drag D = n² rho_w g/k. Base at `z = 0`, fixed and shut; at the top `z = H` the
//! total traction is
//! `-q(t)` and the pressure of water 0. Both displacements are sums of `U_m sin(k_m z)`, `k_m = (2m - 1) pi/(2H)`, with
//! `M U'' + C U' + k_m² K U = (2/H) sin(k_m H) (-q, 0)`,
//! `M = diag((1 - n) rho_s, n rho_w)`, `C = D [[1, -1], [-1, 1]]` and
//! `K = [[E_c + (1 - n)² K_w/n, (1 - n) K_w], [(1 - n) K_w, n K_w]]`. The static part (all stress in the skeleton, no
//! pressure) stands
//! in closed form, and the series sums what differs from it: else it rings at the top. `q = Q (10 s³ - 15 s⁴ + 6 s⁵)`,
//! `s = t/t_r`.
//!
//! Terzaghi's solution, both waves of Biot and the undrained limit are limits of this series.

mod sudden;

pub use sudden::{SuddenLoads, SuddenState};

use std::f64::consts::PI;

/// The column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPhaseColumn {
    /// Height H, m.
    pub height: f64,
    /// Confined modulus of the skeleton `E_c`, Pa.
    pub confined_modulus: f64,
    /// Bulk modulus of the water `K_w`, Pa.
    pub bulk_water: f64,
    /// Porosity n.
    pub porosity: f64,
    /// Density of the grains, kg/m³.
    pub density_grains: f64,
    /// Density of the water, kg/m³.
    pub density_water: f64,
    /// Hydraulic conductivity k, m/s.
    pub conductivity: f64,
    /// Gravity with which the conductivity was measured, m/s².
    pub gravity: f64,
    /// Load Q, Pa.
    pub load: f64,
    /// Time in which it comes on, s.
    pub ramp: f64,
}

/// The column at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoPhaseState {
    column: TwoPhaseColumn,
    /// Share of the load that acts.
    share: f64,
    /// Displacements of both, m, that differ from the static ones, of each mode.
    modes: Vec<[f64; 2]>,
}

/// A square matrix.
type Square<const N: usize> = [[f64; N]; N];

impl TwoPhaseColumn {
    /// Density of soil and water together, kg/m³.
    #[must_use]
    pub fn saturated_density(&self) -> f64 {
        (1.0 - self.porosity) * self.density_grains + self.porosity * self.density_water
    }

    /// Speed of the undrained wave, m/s: `sqrt((E_c + K_w/n)/rho)`.
    #[must_use]
    pub fn undrained_speed(&self) -> f64 {
        let modulus = self.confined_modulus + self.bulk_water / self.porosity;
        (modulus / self.saturated_density()).sqrt()
    }

    /// Pressure of water over the load behind the undrained front: `(K_w/n)/(E_c + K_w/n)`.
    #[must_use]
    pub fn undrained_share(&self) -> f64 {
        let of_water = self.bulk_water / self.porosity;
        of_water / (self.confined_modulus + of_water)
    }

    /// The column at a time (s), by so many modes.
    #[must_use]
    pub fn at(&self, t: f64, modes: usize) -> TwoPhaseState {
        let s = (t / self.ramp).clamp(0.0, 1.0);
        TwoPhaseState {
            column: *self,
            share: s * s * s * (10.0 - 15.0 * s + 6.0 * s * s),
            modes: (1..=modes).map(|m| self.mode(m, t, s)).collect(),
        }
    }

    /// Displacements of a mode at `t`, at the share `s` of the ramp, less the static ones.
    fn mode(&self, m: usize, t: f64, s: f64) -> [f64; 2] {
        let system = self.system(m);
        let mut a = [[0.0; 10]; 10];
        for i in 0..4 {
            a[i][..4].copy_from_slice(&system.rates[i]);
        }
        let top = if m % 2 == 1 { 1.0 } else { -1.0 };
        let force = -2.0 / self.height * top * self.load / system.root[0];
        // Powers s^j/j! drive one another, and the load is 60 s³/3! - 360 s⁴/4! + 720 s⁵/5!.
        for (j, factor) in [(3, 60.0), (4, -360.0), (5, 720.0)] {
            a[2][4 + j] = factor * force;
        }
        for j in 1..6 {
            a[4 + j][3 + j] = 1.0 / self.ramp;
        }
        let risen = exponential(&scaled(&a, s * self.ramp));
        let mut state: [f64; 4] = std::array::from_fn(|i| risen[i][4]);
        let at_rest = system.at_rest([force * system.root[0], 0.0]);
        let share = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
        for i in 0..2 {
            state[i] -= share * at_rest[i];
        }
        let left = t - self.ramp;
        if left > 0.0 {
            let decay = exponential(&scaled(&system.rates, left));
            state = std::array::from_fn(|i| (0..4).map(|j| decay[i][j] * state[j]).sum());
        }
        system.displacements([state[0], state[1]])
    }

    fn system(&self, m: usize) -> ModeSystem {
        let (n, water) = (self.porosity, self.bulk_water);
        let k = wave_number(m, self.height);
        // x = k L^T U and y = M^(1/2) V with L L^T = K: the energy is half their square, so that no state grows.
        let stiffness = [
            self.confined_modulus + (1.0 - n) * (1.0 - n) * water / n,
            (1.0 - n) * water,
            n * water,
        ];
        let l00 = stiffness[0].sqrt();
        let l10 = stiffness[1] / l00;
        // The determinant is E_c n K_w.
        let l11 = (self.confined_modulus * n * water).sqrt() / l00;
        let root = [
            ((1.0 - n) * self.density_grains).sqrt(),
            (n * self.density_water).sqrt(),
        ];
        let drag = n * n * self.density_water * self.gravity / self.conductivity;
        let mut rates = [[0.0; 4]; 4];
        let below = [[l00, l10], [0.0, l11]];
        for i in 0..2 {
            for j in 0..2 {
                rates[i][2 + j] = k * below[i][j] / root[j];
                rates[2 + j][i] = -rates[i][2 + j];
                let sign = if i == j { 1.0 } else { -1.0 };
                rates[2 + i][2 + j] = -sign * drag / (root[i] * root[j]);
            }
        }
        ModeSystem {
            k,
            lower: [l00, l10, l11],
            root,
            rates,
        }
    }
}

/// The equations of a mode: of x and y of [`TwoPhaseColumn::system`].
struct ModeSystem {
    /// Wave number, 1/m.
    k: f64,
    /// The factor L of the stiffness: 00, 10, 11.
    lower: [f64; 3],
    /// Roots of the masses of both.
    root: [f64; 2],
    /// Rates of x and y over x and y.
    rates: Square<4>,
}

impl ModeSystem {
    /// x under forces that do not change: k² K U = f, and x = k L^T U = L^-1 f/k.
    fn at_rest(&self, force: [f64; 2]) -> [f64; 2] {
        let [l00, l10, l11] = self.lower;
        let [f, second] = force.map(|force| force / self.k);
        [f / l00, second / l11 - l10 / l11 * f / l00]
    }

    /// U of x.
    fn displacements(&self, x: [f64; 2]) -> [f64; 2] {
        let ([l00, l10, l11], k) = (self.lower, self.k);
        let second = x[1] / (k * l11);
        [(x[0] / k - l10 * second) / l00, second]
    }
}

impl TwoPhaseState {
    /// Displacement of the skeleton, m, at the height `z` (m).
    #[must_use]
    pub fn displacement(&self, z: f64) -> f64 {
        let column = &self.column;
        let at_rest = -self.share * column.load * z / column.confined_modulus;
        at_rest + self.sum(|k, u| u[0] * libm::sin(k * z))
    }

    /// Pressure of the water, Pa, compression positive.
    #[must_use]
    pub fn pressure(&self, z: f64) -> f64 {
        let (n, water) = (self.column.porosity, self.column.bulk_water);
        -water / n * self.sum(|k, u| ((1.0 - n) * u[0] + n * u[1]) * k * libm::cos(k * z))
    }

    /// Effective vertical stress, Pa, tension positive.
    #[must_use]
    pub fn effective_stress(&self, z: f64) -> f64 {
        let column = &self.column;
        let rest = self.sum(|k, u| u[0] * k * libm::cos(k * z));
        column.confined_modulus * rest - self.share * column.load
    }

    /// Mean of the pressure of the water between two heights (m), Pa.
    #[must_use]
    pub fn mean_pressure(&self, low: f64, high: f64) -> f64 {
        let (n, water) = (self.column.porosity, self.column.bulk_water);
        let mean = |k: f64| (libm::sin(k * high) - libm::sin(k * low)) / (high - low);
        -water / n * self.sum(|k, u| ((1.0 - n) * u[0] + n * u[1]) * mean(k))
    }

    /// Mean of the effective vertical stress between two heights (m), Pa.
    #[must_use]
    pub fn mean_effective_stress(&self, low: f64, high: f64) -> f64 {
        let column = &self.column;
        let mean = |k: f64| (libm::sin(k * high) - libm::sin(k * low)) / (high - low);
        let rest = self.sum(|k, u| u[0] * mean(k));
        column.confined_modulus * rest - self.share * column.load
    }

    /// The smallest terms first.
    fn sum(&self, term: impl Fn(f64, &[f64; 2]) -> f64) -> f64 {
        let all = self.modes.iter().enumerate().rev();
        all.map(|(i, u)| term(wave_number(i + 1, self.column.height), u))
            .sum()
    }
}

fn wave_number(m: usize, height: f64) -> f64 {
    (2 * m - 1) as f64 * PI / (2.0 * height)
}

fn scaled<const N: usize>(a: &Square<N>, by: f64) -> Square<N> {
    a.map(|row| row.map(|x| x * by))
}

fn product<const N: usize>(a: &Square<N>, b: &Square<N>) -> Square<N> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..N).map(|k| a[i][k] * b[k][j]).sum()))
}

/// e^A by Taylor's series of a small part of A, squared until it is whole. What is squared is e^A - 1, so that a small
/// part
/// keeps its digits.
fn exponential<const N: usize>(a: &Square<N>) -> Square<N> {
    let size = a.iter().map(|row| row.iter().map(|x| x.abs()).sum());
    let size: f64 = size.fold(0.0, f64::max);
    let halvings = libm::log2(size / 0.25).ceil().max(0.0);
    let small = scaled(a, libm::exp2(-halvings));
    let (mut term, mut all) = (small, small);
    for order in 2..=14 {
        term = scaled(&product(&term, &small), 1.0 / f64::from(order));
        for (row, of_term) in all.iter_mut().zip(&term) {
            for (x, t) in row.iter_mut().zip(of_term) {
                *x += t;
            }
        }
    }
    for _ in 0..halvings as u32 {
        let square = product(&all, &all);
        for (row, of_square) in all.iter_mut().zip(&square) {
            for (x, s) in row.iter_mut().zip(of_square) {
                *x = 2.0 * *x + s;
            }
        }
    }
    for (i, row) in all.iter_mut().enumerate() {
        row[i] += 1.0;
    }
    all
}
