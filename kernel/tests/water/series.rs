//! Exact column of soil and water under a load on its top, with inertia of both (Biot, modal).
//!
//! Base at z = 0 held and shut, top z = H drained under a total traction -q(t). Both displacements are sums of
//! `U_m` sin(`k_m` z), `k_m` = (2m-1) pi/2H, with M U'' + C U' + `k_m`² K U = (2/H) sin(`k_m` H) (-q, 0),
//! M = diag((1-n) `rho_s`, n `rho_w`), C = D [[1, -1], [-1, 1]],
//! K = [[`E_c` + (1-n)² `K_w`/n, (1-n) `K_w`], [(1-n) `K_w`, n `K_w`]]. Each mode is advanced by exponentials of its matrix,
//! exactly, since the load is a polynomial of time and then constant.

use std::f64::consts::PI;

/// Values of the column.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    pub height: f64,
    pub modulus: f64,
    pub bulk: f64,
    pub porosity: f64,
    pub grains: f64,
    pub water: f64,
    /// Drag per volume and velocity \[N s/m⁴\].
    pub drag: f64,
    pub load: f64,
    pub ramp: f64,
}

/// Pressures and displacement at one time.
pub struct Answer {
    /// `k_m`, and the coefficients of p (cosine) and of what the displacement is beyond the static one (sine).
    modes: Vec<(f64, f64, f64)>,
    column: Column,
}

type Matrix<const N: usize> = [[f64; N]; N];

fn times<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> Matrix<N> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..N).map(|k| a[i][k] * b[k][j]).sum()))
}

/// e^A by Taylor's series of A/2^s, squared s times.
fn exponential<const N: usize>(a: &Matrix<N>) -> Matrix<N> {
    let norm = |row: &[f64; N]| row.iter().map(|x| x.abs()).sum::<f64>();
    let largest = a.iter().map(norm).fold(0.0, f64::max);
    let squarings = (largest.log2().ceil() + 2.0).max(0.0) as i32;
    let scaled = a.map(|row| row.map(|x| x * 2.0_f64.powi(-squarings)));
    let identity: Matrix<N> =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let (mut sum, mut term) = (identity, identity);
    for order in 1..20 {
        term = times(&term, &scaled).map(|row| row.map(|x| x / f64::from(order)));
        for i in 0..N {
            for j in 0..N {
                sum[i][j] += term[i][j];
            }
        }
    }
    for _ in 0..squarings {
        sum = times(&sum, &sum);
    }
    sum
}

impl Column {
    /// The column at a time after the ramp, from so many modes.
    pub fn at(&self, time: f64, modes: usize) -> Answer {
        let n = self.porosity;
        let [e, q] = [self.modulus, self.bulk];
        let stiffness = [
            [e + (1.0 - n) * (1.0 - n) * q / n, (1.0 - n) * q],
            [(1.0 - n) * q, n * q],
        ];
        let mass = [(1.0 - n) * self.grains, n * self.water];
        let modes = (1..=modes).map(|m| {
            let k = (2 * m - 1) as f64 * PI / (2.0 * self.height);
            let force = -(2.0 / self.height) * (k * self.height).sin() * self.load;
            // In units in which velocities are as large as displacements.
            let unit = k * (e / mass[0]).sqrt();
            let force_over = force / (k * k * e);
            let mut a = [[0.0; 10]; 10];
            for i in 0..2 {
                a[i][2 + i] = unit;
                for j in 0..2 {
                    a[2 + i][j] = -k * k * stiffness[i][j] / (mass[i] * unit);
                    a[2 + i][2 + j] = if i == j { -1.0 } else { 1.0 } * self.drag / mass[i];
                }
            }
            a[2][4] = k * k * e / (mass[0] * unit);
            // The load and its five derivatives, over the ramp: f = 10 s³ - 15 s⁴ + 6 s⁵.
            let during = {
                let mut a = a.map(|row| row.map(|x| x * self.ramp));
                for d in 4..9 {
                    a[d][d + 1] = 1.0;
                }
                a
            };
            let start = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 60.0, -360.0, 720.0];
            let one = |a: &Matrix<10>, x: &[f64; 10]| -> [f64; 10] {
                let e = exponential(a);
                std::array::from_fn(|i| (0..10).map(|j| e[i][j] * x[j]).sum())
            };
            let mut state = one(&during, &start);
            for derivative in &mut state[5..] {
                *derivative = 0.0;
            }
            let rest = time - self.ramp;
            let state = one(&a.map(|row| row.map(|x| x * rest)), &state);
            let [u, w] = [state[0] * force_over, state[1] * force_over];
            let pressure = -(q / n) * k * ((1.0 - n) * u + n * w);
            (k, pressure, u - force_over)
        });
        Answer {
            modes: modes.collect(),
            column: *self,
        }
    }

    /// Pressure at once after a load without inertia.
    pub fn undrained(&self) -> f64 {
        let q = self.bulk / self.porosity;
        self.load * q / (self.modulus + q)
    }
}

impl Answer {
    /// Pressure at a height.
    pub fn pressure(&self, z: f64) -> f64 {
        self.modes.iter().map(|(k, p, _)| p * (k * z).cos()).sum()
    }

    /// Its mean between two heights.
    pub fn mean(&self, low: f64, high: f64) -> f64 {
        let mean = |k: f64| ((k * high).sin() - (k * low).sin()) / (k * (high - low));
        self.modes.iter().map(|(k, p, _)| p * mean(*k)).sum()
    }

    /// Mean of the effective stress between two heights: of the static one beyond, and of k u cos.
    pub fn mean_stress(&self, low: f64, high: f64) -> f64 {
        let mean = |k: f64| ((k * high).sin() - (k * low).sin()) / (k * (high - low));
        let sum: f64 = self.modes.iter().map(|(k, _, u)| k * u * mean(*k)).sum();
        self.column.modulus * sum - self.column.load
    }

    /// Displacement of the top.
    pub fn top(&self) -> f64 {
        let h = self.column.height;
        let sum: f64 = self.modes.iter().map(|(k, _, u)| u * (k * h).sin()).sum();
        sum - self.column.load * h / self.column.modulus
    }
}

/// Values that an independent computation gave: p(0), p(H/2) \[Pa\] and the displacement of the top \[m\].
#[test]
fn the_series_has_the_values_of_another_computation() {
    for (k, time, values) in [
        (1e-2, 0.1, [309.8072, 219.1023, -8.078_276_3e-5]),
        (1e-3, 0.1, [971.1557, 839.8829, -2.865_895_8e-5]),
        (1e-4, 1.0, [938.7917, 735.5004, -3.590_650_9e-5]),
        (1e-5, 10.0, [934.0121, 726.8785, -3.653_032_2e-5]),
    ] {
        let answer = super::support::column(k).at(time, 500);
        // Those are of a load of 1 kPa.
        let found = [answer.pressure(0.0), answer.pressure(0.5), answer.top()].map(|x| 1e3 * x);
        for (found, value) in found.iter().zip(values) {
            assert!(
                (found / value - 1.0).abs() < 1e-6,
                "k = {k}: {found}, {value}"
            );
        }
    }
}
