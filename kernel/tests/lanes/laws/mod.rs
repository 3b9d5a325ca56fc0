//! Stress and deformation updates against exact solutions and against nalgebra.

use nalgebra::{Matrix3, Rotation3, Vector3};
use proctor_kernel::lanes::{Backend, Kernel, Lanes, SelectedLanes};
use proctor_laws::tensor::{Configuration, Matrix};
use proctor_laws::tensor::{
    determinant, inverse, left_stretch_diagonal, relative_deformation, stretch_diagonal,
    volume_ratio,
};
use proctor_laws::{Increment, Law, LinearElastic, NeoHookean, ObjectiveRate, Stress};
use std::f64::consts::PI;

mod blocks;
mod finite;

/// The stress of a law that asks F alone.
const FINITE: LaneResult = LaneResult::Stress(Configuration::Beginning, [0.0; 6]);

const G: f64 = 1.0;
const ELASTIC: LinearElastic = LinearElastic::new(2.6, 0.3);
const FORWARD: LinearElastic = LinearElastic::with_rate(2.6, 0.3, ObjectiveRate::JaumannForward);
const NEO: NeoHookean = NeoHookean::new(2.6, 0.3);
const DENSITY: f64 = 1.5;

/// Result of the lanes for one particle.
#[derive(Clone, Copy)]
enum LaneResult {
    /// After a step with a stress before it.
    Stress(Configuration, [f64; 6]),
    SpeedSquared,
    Stretch,
    LeftStretch,
    Determinant,
    Inverse,
    Relative(Configuration),
    VolumeRatio(Configuration),
}

struct Call<M, const D: usize> {
    law: M,
    matrix: Matrix3<f64>,
    what: LaneResult,
}

impl<M: Law, const D: usize> Kernel for Call<M, D> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run<B: Backend>(self) -> Vec<f64> {
        let m: Matrix<B::Native> =
            std::array::from_fn(|i| std::array::from_fn(|j| B::Native::splat(self.matrix[(i, j)])));
        let flat = |m: Matrix<B::Native>| m.into_iter().flatten().collect::<Vec<_>>();
        let (at, before) = match self.what {
            LaneResult::Stress(at, s) => (at, s),
            _ => (Configuration::Beginning, [0.0; 6]),
        };
        let jacobian = determinant::<_, D>(&m);
        let increment = Increment {
            gradient: m,
            configuration: at,
            dt: 1.0,
            deformation: m,
            jacobian,
            mass: B::Native::splat(DENSITY),
            volume: B::Native::splat(1.0),
            density: DENSITY,
        };
        let mut stress = Stress::<_, D>::of_packed(before.map(B::Native::splat));
        let speed_squared = self.law.update(&increment, &mut stress, &mut []);
        let values = match self.what {
            LaneResult::Stress(..) => stress.packed().to_vec(),
            LaneResult::SpeedSquared => vec![speed_squared],
            LaneResult::Stretch => stretch_diagonal::<_, D>(&m).to_vec(),
            LaneResult::LeftStretch => left_stretch_diagonal::<_, D>(&m).to_vec(),
            LaneResult::Determinant => vec![determinant::<_, D>(&m)],
            LaneResult::Inverse => flat(inverse::<_, D>(&m)),
            LaneResult::Relative(at) => flat(relative_deformation::<_, D>(&m, at)),
            LaneResult::VolumeRatio(at) => vec![volume_ratio::<_, D>(&m, at)],
        };
        let first = |lanes: B::Native| {
            let mut all = [0.0; 8];
            lanes.store(&mut all);
            all[0]
        };
        values.into_iter().map(first).collect()
    }
}

fn call<M: Law>(axes: usize, law: M, matrix: Matrix3<f64>, what: LaneResult) -> Vec<f64> {
    if axes == 2 {
        SelectedLanes::any().run(Call::<M, 2> { law, matrix, what })
    } else {
        SelectedLanes::any().run(Call::<M, 3> { law, matrix, what })
    }
}

fn six(values: &[f64]) -> [f64; 6] {
    std::array::from_fn(|i| values[i])
}

fn matrix(values: &[f64]) -> Matrix3<f64> {
    Matrix3::from_row_slice(values)
}

/// Stress in the order of the scene from that of the kernel.
fn ordered(axes: usize, s: &[f64]) -> [f64; 6] {
    if axes == 2 {
        [s[0], s[1], s[2], 0.0, 0.0, s[3]]
    } else {
        six(s)
    }
}

fn tensor(s: &[f64; 6]) -> Matrix3<f64> {
    Matrix3::new(s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2])
}

/// Deterministic numbers in [-1, 1].
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A deformation gradient with the given size of its deviation from 1, plane in two dimensions.
fn deformation(axes: usize, seed: u64, size: f64) -> Matrix3<f64> {
    let mut next = numbers(seed);
    let mut f = Matrix3::from_fn(|_, _| size * next()) + Matrix3::identity();
    if axes == 2 {
        (f[(0, 2)], f[(1, 2)], f[(2, 0)], f[(2, 1)], f[(2, 2)]) = (0.0, 0.0, 0.0, 0.0, 1.0);
    }
    f
}

/// Case A8: `s_xy = G sin g, s_xx = -s_yy = G (1 - cos g)` for the Jaumann rate, sheared to g = 3 in n steps.
fn shear_error(axes: usize, law: LinearElastic, at: Configuration, n: u32) -> f64 {
    let g = 3.0;
    let mut step = Matrix3::zeros();
    step[(0, 1)] = g / f64::from(n);
    let mut s = [0.0; 6];
    for _ in 0..n {
        s = six(&call(axes, law, step, LaneResult::Stress(at, s)));
    }
    let s = ordered(axes, &s);
    let exact = [
        G * (1.0 - g.cos()),
        -G * (1.0 - g.cos()),
        0.0,
        0.0,
        0.0,
        G * g.sin(),
    ];
    s.iter()
        .zip(exact)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

#[test]
fn simple_shear_converges() {
    for axes in [2, 3] {
        for at in [Configuration::Beginning, Configuration::End] {
            let (coarse, fine) = (
                shear_error(axes, ELASTIC, at, 250),
                shear_error(axes, ELASTIC, at, 500),
            );
            // The strain increment is added unrotated: first order, whatever the rotation does.
            assert!((coarse / fine - 2.0).abs() < 0.05, "order: {coarse} {fine}");
            assert!(fine < 1.0e-2, "{fine}");
        }
        let at = Configuration::Beginning;
        let (coarse, fine) = (
            shear_error(axes, FORWARD, at, 500),
            shear_error(axes, FORWARD, at, 1000),
        );
        // Forward Euler is first order; its error at 1000 steps is known to be 4.5e-3.
        assert!((coarse / fine - 2.0).abs() < 0.05, "order: {coarse} {fine}");
        assert!((fine - 4.5e-3).abs() < 1.0e-4, "{fine}");
    }
}

/// Half the in-plane deviator, which a rotation keeps.
fn deviator(s: &[f64; 6]) -> f64 {
    (0.25 * (s[0] - s[1]).powi(2) + s[5].powi(2)).sqrt()
}

/// Case A9: one turn in n steps with a skew gradient.
#[test]
fn forward_jaumann_grows_under_rotation() {
    for axes in [2, 3] {
        let n = 1000;
        let w = 2.0 * PI / f64::from(n);
        let mut step = Matrix3::zeros();
        (step[(1, 0)], step[(0, 1)]) = (w, -w);
        let start = if axes == 2 {
            [1.0, -0.5, 0.2, 0.3, 0.0, 0.0]
        } else {
            [1.0, -0.5, 0.2, 0.0, 0.0, 0.3]
        };
        let (mut forward, mut objective) = (start, start);
        for _ in 0..n {
            let at = Configuration::Beginning;
            forward = six(&call(axes, FORWARD, step, LaneResult::Stress(at, forward)));
            // f = 1 + W stretches by w²/2 in each step. The rotation itself is f = R.
            let r = *Rotation3::from_axis_angle(&Vector3::z_axis(), w).matrix();
            let g = r - Matrix3::identity();
            objective = six(&call(axes, ELASTIC, g, LaneResult::Stress(at, objective)));
        }
        let growth = deviator(&ordered(axes, &forward)) / deviator(&ordered(axes, &start));
        // (1 + 16 pi²/n²)^(n/2)
        let predicted = (1.0 + (4.0 * PI / f64::from(n)).powi(2)).powf(0.5 * f64::from(n));
        assert!((growth - predicted).abs() < 1.0e-9, "{growth} {predicted}");
        assert!((growth - 1.082).abs() < 1.0e-3, "{growth}");
        for (a, b) in ordered(axes, &objective).iter().zip(ordered(axes, &start)) {
            // 1000 steps of round-off.
            assert!((a - b).abs() < 1.0e-12, "{objective:?}");
        }
    }
}

/// A rigid rotation of the particles turns the stress and keeps the volume, whatever its size, if the gradient
/// belongs to the positions where it was formed.
#[test]
fn rotation_increments_are_exact() {
    for (axes, axis) in [
        (2, Vector3::z_axis()),
        (3, Vector3::z_axis()),
        (
            3,
            nalgebra::Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5)),
        ),
    ] {
        for angle in [1.0e-6_f64, 0.01, 0.5, 2.0, 3.0] {
            let r = *Rotation3::from_axis_angle(&axis, angle).matrix();
            let s = if axes == 2 {
                [1.0, -0.5, 0.2, 0.3, 0.0, 0.0]
            } else {
                [1.0, -0.5, 0.2, 0.3, -0.7, 0.4]
            };
            let exact = r * tensor(&ordered(axes, &s)) * r.transpose();
            for (at, g) in [
                (Configuration::Beginning, r - Matrix3::identity()),
                (Configuration::End, Matrix3::identity() - r.transpose()),
            ] {
                let turned = call(axes, ELASTIC, g, LaneResult::Stress(at, s));
                let error = (tensor(&ordered(axes, &turned)) - exact).amax();
                // (f + 1)^-1 amplifies round-off by 1/cos²(angle/2), 200 at 3 rad.
                let gain = (0.5 * angle).cos().powi(-2);
                assert!(error < 4.0e-15 * gain, "{axes} {angle} {at:?}: {error}");
                let ratio = call(axes, ELASTIC, g, LaneResult::VolumeRatio(at))[0];
                assert!(
                    (ratio - 1.0).abs() < 1.0e-15 * 4.0,
                    "{axes} {angle} {at:?}: det f {ratio}"
                );
                let f = matrix(&call(axes, ELASTIC, g, LaneResult::Relative(at)));
                let mut difference = f - r;
                if axes == 2 {
                    difference[(2, 2)] = 0.0;
                }
                assert!(difference.amax() < 2.0e-15, "{f}");
            }
        }
    }
}

#[test]
fn two_dimensions_are_plane_strain() {
    for seed in 1..40 {
        let f = deformation(2, seed, 0.3);
        let g = f - Matrix3::identity();
        let (flat, full) = (
            [0.3, -0.4, 0.2, 0.5, 0.0, 0.0],
            [0.3, -0.4, 0.2, 0.0, 0.0, 0.5],
        );
        for law in [ELASTIC, FORWARD] {
            for at in [Configuration::Beginning, Configuration::End] {
                let two = ordered(2, &call(2, law, g, LaneResult::Stress(at, flat)));
                let three = ordered(3, &call(3, law, g, LaneResult::Stress(at, full)));
                assert!(
                    (tensor(&two) - tensor(&three)).amax() < 2.0e-14,
                    "{two:?} {three:?}"
                );
                let ratios = [2, 3].map(|axes| call(axes, law, g, LaneResult::VolumeRatio(at))[0]);
                assert!(
                    (ratios[0] - ratios[1]).abs() < 1.0e-14 * ratios[0],
                    "{ratios:?}"
                );
            }
        }
        let two = ordered(2, &call(2, NEO, f, FINITE));
        let three = ordered(3, &call(3, NEO, f, FINITE));
        assert!(
            (tensor(&two) - tensor(&three)).amax() < 2.0e-14,
            "{two:?} {three:?}"
        );
    }
}

/// Small strains from rest: Hooke's law in plane strain, and the energy of the stress is half stress by strain.
#[test]
fn small_strains_follow_hooke() {
    let law = ELASTIC;
    for seed in 1..20 {
        let mut next = numbers(seed);
        let g = Matrix3::from_fn(|_, _| 1.0e-8 * next());
        let e = 0.5 * (g + g.transpose());
        let exact = law.elasticity().lambda * e.trace() * Matrix3::identity()
            + 2.0 * law.elasticity().shear * e;
        let s = six(&call(
            3,
            ELASTIC,
            g,
            LaneResult::Stress(Configuration::Beginning, [0.0; 6]),
        ));
        // Terms of second order: 1e-16.
        assert!((tensor(&s) - exact).amax() < 1.0e-15, "{s:?} {exact}");
        let energy = 0.5 * exact.component_mul(&e).sum();
        assert!((law.energy_density(&s) - energy).abs() < 1.0e-7 * energy);
    }
}
