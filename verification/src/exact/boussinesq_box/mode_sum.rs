//! Double cosine sums over one horizontal layer of points, one axis after the other.

use std::f64::consts::PI;

use crate::exact::special::{cos_pi, sin_pi, sinc_pi};

/// Variation of a field along an axis: `cos(m pi x / a)` or `sin(m pi x / a)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Parity {
    Cos,
    Sin,
}

impl Parity {
    fn at(self, half_turns: f64) -> f64 {
        match self {
            Self::Cos => cos_pi(half_turns),
            Self::Sin => sin_pi(half_turns),
        }
    }
}

/// Parities of `u_x, u_y, u_z` along x and y.
pub(super) const DISPLACEMENT: [(Parity, Parity); 3] = [
    (Parity::Sin, Parity::Cos),
    (Parity::Cos, Parity::Sin),
    (Parity::Cos, Parity::Cos),
];

/// Modes along one axis whose amplitude is not zero: `(index, amplitude)`, by rising index.
type AxisModes = Vec<(f64, f64)>;

/// Surface pressure of the load, mode by mode, as a product over the axes: `q_mn = mean * x_m * y_n`.
pub(super) struct Amplitudes {
    sides: [f64; 2],
    mean: f64,
    axes: [AxisModes; 2],
    k_max: f64,
}

impl Amplitudes {
    /// Modes up to the wave number `k_max` (1/m) of a force (N) at `position`, spread over a square of side
    /// `width` (m, 0 for a point).
    pub fn new(load: f64, sides: [f64; 2], position: [f64; 2], width: f64, k_max: f64) -> Self {
        let axis = |side: f64, at: f64| -> AxisModes {
            let count = (k_max * side / PI) as usize;
            (0..=count)
                .filter_map(|m| {
                    let m_f = m as f64;
                    let multiplicity = if m == 0 { 1.0 } else { 2.0 };
                    let amplitude =
                        multiplicity * cos_pi(m_f * at / side) * sinc_pi(0.5 * m_f * width / side);
                    (amplitude != 0.0).then_some((m_f, amplitude))
                })
                .collect()
        };
        Self {
            sides,
            mean: load / (sides[0] * sides[1]),
            axes: [axis(sides[0], position[0]), axis(sides[1], position[1])],
            k_max,
        }
    }
}

/// Distinct values in rising order, and for every value its index among them.
fn distinct(values: impl Iterator<Item = f64> + Clone) -> (Vec<f64>, Vec<usize>) {
    let mut sorted: Vec<f64> = values.clone().collect();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|x, y| x.total_cmp(y).is_eq());
    let index = values
        .map(|v| sorted.partition_point(|s| s.total_cmp(&v).is_lt()))
        .collect();
    (sorted, index)
}

/// Sums `q_mn * coefficients(k, c) * parity_x(m pi x/a) * parity_y(n pi y/b)` at every point of a layer.
///
/// `coefficients` sees the wave number `k` (1/m) and the direction `c` of the wave vector (zero for `k = 0`).
/// For each `m` the sum over `n` is done once per distinct `y`, then spread to the points.
pub(super) fn sum<const N: usize>(
    amplitudes: &Amplitudes,
    points: &[[f64; 2]],
    parities: [(Parity, Parity); N],
    coefficients: impl Fn(f64, [f64; 2]) -> [f64; N],
) -> Vec<[f64; N]> {
    let [a, b] = amplitudes.sides;
    let [x_modes, y_modes] = &amplitudes.axes;
    let (xs, x_of) = distinct(points.iter().map(|p| p[0]));
    let (ys, y_of) = distinct(points.iter().map(|p| p[1]));
    let table = |parity: Parity| -> Vec<Vec<f64>> {
        ys.iter()
            .map(|y| y_modes.iter().map(|(n, _)| parity.at(n * y / b)).collect())
            .collect()
    };
    let (cos_y, sin_y) = (table(Parity::Cos), table(Parity::Sin));

    let mut sums = vec![[0.0; N]; points.len()];
    let mut row: [Vec<f64>; N] = std::array::from_fn(|_| Vec::with_capacity(y_modes.len()));
    let mut along_y = vec![[0.0; N]; ys.len()];
    let mut along_x = vec![[0.0; N]; xs.len()];
    for &(m, x_amplitude) in x_modes {
        row.iter_mut().for_each(Vec::clear);
        let kx = m * PI / a;
        for &(n, y_amplitude) in y_modes {
            let ky = n * PI / b;
            let k = libm::hypot(kx, ky);
            if k > amplitudes.k_max {
                break;
            }
            let direction = if k > 0.0 { [kx / k, ky / k] } else { [0.0; 2] };
            let q = amplitudes.mean * x_amplitude * y_amplitude;
            for (entries, coefficient) in row.iter_mut().zip(coefficients(k, direction)) {
                entries.push(q * coefficient);
            }
        }
        for (iy, values) in along_y.iter_mut().enumerate() {
            for field in 0..N {
                let waves = if parities[field].1 == Parity::Cos {
                    &cos_y[iy]
                } else {
                    &sin_y[iy]
                };
                values[field] = dot(&row[field], waves);
            }
        }
        for (&x, values) in xs.iter().zip(&mut along_x) {
            let (cos_x, sin_x) = (cos_pi(m * x / a), sin_pi(m * x / a));
            for field in 0..N {
                values[field] = if parities[field].0 == Parity::Cos {
                    cos_x
                } else {
                    sin_x
                };
            }
        }
        for (i, total) in sums.iter_mut().enumerate() {
            for field in 0..N {
                total[field] += along_x[x_of[i]][field] * along_y[y_of[i]][field];
            }
        }
    }
    sums
}

/// Scalar product over the shorter length, in eight partial sums so that it vectorises.
fn dot(row: &[f64], waves: &[f64]) -> f64 {
    let waves = &waves[..row.len()];
    let mut partial = [0.0; 8];
    let (row_chunks, row_rest) = row.as_chunks::<8>();
    let (wave_chunks, wave_rest) = waves.as_chunks::<8>();
    for (r, w) in row_chunks.iter().zip(wave_chunks) {
        for lane in 0..8 {
            partial[lane] += r[lane] * w[lane];
        }
    }
    let rest: f64 = row_rest.iter().zip(wave_rest).map(|(r, w)| r * w).sum();
    partial.iter().sum::<f64>() + rest
}
