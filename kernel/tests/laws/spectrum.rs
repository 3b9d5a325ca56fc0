//! Principal values and directions, also where values are equal, and functions of lanes against those of a library.

use crate::common::all_lanes;
use crate::laws::support::{numbers, tensor};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proctor_kernel::lanes::{Backend, Kernel, Lanes, SelectedLanes};
use proctor_laws::functions;
use proctor_laws::principal::spectrum;

/// Values and squares of directions of a stress in the order of a law.
struct Of<const D: usize>([f64; 6]);

impl<const D: usize> Kernel for Of<D> {
    type Output = ([f64; 3], [[f64; 6]; 3]);

    #[inline(always)]
    fn run<B: Backend>(self) -> Self::Output {
        let mut lanes = [B::Native::splat(0.0); 6];
        for (lane, value) in lanes.iter_mut().zip(self.0) {
            *lane = B::Native::splat(value);
        }
        let found = spectrum::<B::Native, D>(&lanes);
        let first = |lane: B::Native| {
            let mut all = [0.0; 8];
            lane.store(&mut all);
            all[0]
        };
        (found.values.map(first), found.squares.map(|s| s.map(first)))
    }
}

/// Tensors with values that are apart, nearly equal, equal, and all of a scale.
fn tensors() -> Vec<Matrix3<f64>> {
    let mut next = numbers(7);
    let mut values = vec![[0.0; 3], [1.0; 3], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
    for _ in 0..200 {
        let (a, b, c) = (next(), next(), next());
        values.extend([
            [a, b, c],
            [a, a, b],
            [a, a * (1.0 + 1e-4), b],
            [a, a * (1.0 + 1e-8), b],
            [1000.0 + a, 1000.0 + b, 1000.0 + c],
            [1000.0 + a, 1000.0 + a, 1000.0 + b],
        ]);
    }
    let mut all = vec![];
    for v in values {
        let axis = Vector3::new(next(), next(), next());
        let r = *Rotation3::new(axis * 3.0).matrix();
        let of = r * Matrix3::from_diagonal(&Vector3::from(v)) * r.transpose();
        for scale in [1.0, 1e-200, 1e150] {
            all.push(of * scale);
        }
        all.push(Matrix3::from_diagonal(&Vector3::from(v)));
    }
    all
}

#[test]
fn values_and_directions_are_exact_to_round_off() {
    for matrix in tensors() {
        let matrix = 0.5 * (matrix + matrix.transpose());
        let s = [
            matrix[(0, 0)],
            matrix[(1, 1)],
            matrix[(2, 2)],
            matrix[(1, 2)],
            matrix[(0, 2)],
            matrix[(0, 1)],
        ];
        let scale = s.into_iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let found = all_lanes().into_iter().map(|lanes| lanes.run(Of::<3>(s)));
        let mut found: Vec<_> = found.collect();
        let (values, squares) = found.pop().expect("plain lanes");
        for other in found {
            assert_eq!(other, (values, squares), "other lanes, other bits");
        }
        assert!(
            values[0] >= values[1] && values[1] >= values[2],
            "{values:?}"
        );
        let mut sum = Matrix3::zeros();
        let mut one = Matrix3::zeros();
        for (value, square) in values.iter().zip(squares) {
            // The unscaled sum would overflow nowhere, but an error of it is compared with the scale.
            sum += tensor(square) * *value;
            one += tensor(square);
            // n n^T is a projection.
            let n = tensor(square);
            assert!((n * n - n).amax() < 4e-15, "{n}");
        }
        assert!((sum - matrix).amax() <= 4e-15 * scale, "{sum} {matrix}");
        assert!((one - Matrix3::identity()).amax() < 4e-15, "{one}");
        if scale > 1e-100 && scale < 1e100 {
            let mut exact: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
            exact.sort_by(|a, b| b.total_cmp(a));
            for (value, exact) in values.iter().zip(exact) {
                assert!((value - exact).abs() <= 4e-15 * scale, "{value} {exact}");
            }
        }
    }
}

#[test]
fn a_plane_stress_has_the_spectrum_of_space() {
    let mut next = numbers(11);
    let equal = [
        [1.0, 1.0, 1.0, 0.0],
        [1.0, 1.0, -2.0, 0.0],
        [2.0, 1.0, 2.0, 0.0],
        [0.0; 4],
    ];
    let random = std::iter::repeat_with(|| [next(), next(), next(), next()]).take(500);
    for [xx, yy, zz, xy] in equal.into_iter().chain(random) {
        for scale in [1.0, 1e-200, 1e150] {
            let flat = [xx, yy, zz, xy, 0.0, 0.0].map(|x| x * scale);
            let full = [xx, yy, zz, 0.0, 0.0, xy].map(|x| x * scale);
            let (values, squares) = SelectedLanes::any().run(Of::<2>(flat));
            let (exact, _) = SelectedLanes::any().run(Of::<3>(full));
            for (value, exact) in values.iter().zip(exact) {
                assert!(
                    (value - exact).abs() <= 8e-15 * scale,
                    "{values:?} {exact:?}"
                );
            }
            for slot in 0..4 {
                let sum: f64 = (0..3).map(|i| values[i] / scale * squares[i][slot]).sum();
                assert!((sum - flat[slot] / scale).abs() < 4e-15, "{flat:?} {sum}");
            }
        }
    }
}

/// e^x, sin x, cos x and ln x of a number.
struct Functions(f64);

impl Kernel for Functions {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<B: Backend>(self) -> [f64; 4] {
        let x = B::Native::splat(self.0);
        let (sine, cosine) = functions::sine_and_cosine(x);
        let mut found = [0.0; 4];
        let lanes = [functions::exp(x), sine, cosine, functions::ln(x)];
        for (found, lane) in found.iter_mut().zip(lanes) {
            let mut all = [0.0; 8];
            lane.store(&mut all);
            *found = all[0];
        }
        found
    }
}

#[test]
fn functions_of_lanes_are_those_of_a_library() {
    let mut next = numbers(3);
    let mut arguments = vec![0.0, -0.0, 1.0, -1.0, 700.0, -700.0, 1e-300, -1e-9];
    for _ in 0..2000 {
        arguments.extend([next(), 30.0 * next(), 700.0 * next()]);
    }
    for x in arguments {
        let found = SelectedLanes::any().run(Functions(x));
        for lanes in all_lanes() {
            assert_eq!(
                lanes.run(Functions(x)).map(f64::to_bits),
                found.map(f64::to_bits),
                "{x}"
            );
        }
        let exact = x.exp();
        assert!(
            (found[0] / exact - 1.0).abs() < 5e-16,
            "exp({x}) = {} not {exact}",
            found[0]
        );
        if (0.0..=std::f64::consts::FRAC_PI_2).contains(&x) {
            assert!((found[1] - x.sin()).abs() < 4.5e-16, "sin {x}");
            assert!((found[2] - x.cos()).abs() < 4.5e-16, "cos {x}");
        }
    }
    for _ in 0..2000 {
        let (near, far) = (1.0 + 1e-3 * next(), (700.0 * next()).exp());
        for x in [near, far, 1.0 + next().abs(), 1.0 + 1e-9 * next()] {
            let (found, exact) = (SelectedLanes::any().run(Functions(x))[3], libm::log(x));
            for lanes in all_lanes() {
                let same = lanes.run(Functions(x))[3];
                assert_eq!(same.to_bits(), found.to_bits(), "{x}");
            }
            assert!(
                (found - exact).abs() <= 4.5e-16 * exact.abs(),
                "ln({x}) = {found} not {exact}"
            );
        }
    }
    let ln = |x: f64| SelectedLanes::any().run(Functions(x))[3];
    assert_eq!(
        (ln(1.0), ln(0.0), ln(-1.0)),
        (0.0, ln(f64::MIN_POSITIVE), ln(0.0))
    );
    assert!((ln(f64::MIN_POSITIVE) - libm::log(f64::MIN_POSITIVE)).abs() < 2e-13);
    assert!((ln(f64::INFINITY) - libm::log(f64::MAX)).abs() < 2e-13);
    assert!(ln(f64::NAN).is_nan());
    let far = |x: f64| SelectedLanes::any().run(Functions(x))[0];
    assert_eq!((far(1e9), far(-1e9)), (far(708.0), far(-708.0)));
    assert!(far(f64::NAN).is_nan());
}
