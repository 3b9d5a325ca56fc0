//! Hencky's law against its energy, closed forms and the waves that it carries.

use crate::laws::support::{DENSITY, close, midpoint, numbers, point, shear, strain, uniaxial};
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};
use proctor_kernel::lanes::{Backend, Kernel, LaneChoice, Lanes, SelectedLanes};
use proctor_laws::tensor::{Configuration, determinant};
use proctor_laws::{AnyLaw, Hencky, Increment, Law, Stress};

const YOUNG: f64 = 2.6;
const POISSON: f64 = 0.3;
const LAW: Hencky = Hencky::new(YOUNG, POISSON);

/// Stress, ordered as a law is given it, and the square of the wave speed of a deformation.
struct Of<const D: usize>(Matrix3<f64>);

impl<const D: usize> Kernel for Of<D> {
    type Output = ([f64; 6], f64);

    #[inline(always)]
    fn run<B: Backend>(self) -> Self::Output {
        let zero = B::Native::splat(0.0);
        let mut f = [[zero; 3]; 3];
        for (i, row) in f.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = B::Native::splat(self.0[(i, j)]);
            }
        }
        let jacobian = determinant::<_, D>(&f);
        let increment = Increment {
            gradient: f,
            configuration: Configuration::Beginning,
            dt: 1.0,
            deformation: f,
            jacobian,
            mass: B::Native::splat(DENSITY),
            volume: jacobian,
            density: DENSITY,
        };
        let mut stress = Stress::<_, D>::of_packed([zero; 6]);
        let square = LAW.update(&increment, &mut stress, &mut []);
        let first = |lane: B::Native| {
            let mut all = [0.0; 8];
            lane.store(&mut all);
            all[0]
        };
        (stress.packed().map(first), first(square))
    }
}

/// The same, the stress as a matrix.
fn of(axes: usize, f: Matrix3<f64>) -> (Matrix3<f64>, f64) {
    let lanes = SelectedLanes::any();
    let (s, square) = if axes == 2 {
        let (s, square) = lanes.run(Of::<2>(f));
        ([s[0], s[1], s[2], 0.0, 0.0, s[3]], square)
    } else {
        lanes.run(Of::<3>(f))
    };
    (crate::laws::support::tensor(s), square)
}

/// Principal logarithmic strains, and their directions in columns.
fn strains(f: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let of = SymmetricEigen::new(f * f.transpose());
    (of.eigenvalues.map(|b| 0.5 * b.ln()), of.eigenvectors)
}

fn kirchhoff(f: &Matrix3<f64>) -> Matrix3<f64> {
    let (e, n) = strains(f);
    let elastic = LAW.elasticity();
    let tau = e.map(|x| 2.0 * elastic.shear * x + elastic.lambda * e.sum());
    n * Matrix3::from_diagonal(&tau) * n.transpose()
}

fn energy(f: &Matrix3<f64>) -> f64 {
    let (e, _) = strains(f);
    LAW.energy_density(&[e[0], e[1], e[2]])
}

/// Deformation gradients of some size, plane in two dimensions, with det F of at least a fifth.
fn deformations(axes: usize, size: f64) -> Vec<Matrix3<f64>> {
    let mut next = numbers(21);
    (0..60)
        .map(|_| {
            let mut f = Matrix3::from_fn(|_, _| size * next()) + Matrix3::identity();
            if axes == 2 {
                for i in 0..2 {
                    (f[(i, 2)], f[(2, i)]) = (0.0, 0.0);
                }
                f[(2, 2)] = 1.0;
            }
            f
        })
        .filter(|f| f.determinant() > 0.2)
        .collect()
}

/// tau = lambda tr(e) 1 + 2 mu e of e = ln(F F^T)/2, and P = dW/dF with sigma = P F^T/J.
#[test]
fn stress_is_the_formula_and_the_slope_of_its_energy() {
    for axes in [2, 3] {
        for f in deformations(axes, 0.4) {
            let j = f.determinant();
            let (s, _) = of(axes, f);
            let exact = kirchhoff(&f) / j;
            assert!((s - exact).amax() < 2e-13 / j, "{s} {exact}");
            let step = 1e-5;
            let p = Matrix3::from_fn(|a, b| {
                let (mut up, mut down) = (f, f);
                up[(a, b)] += step;
                down[(a, b)] -= step;
                (energy(&up) - energy(&down)) / (2.0 * step)
            });
            let of_energy = p * f.transpose() / j;
            assert!((s - of_energy).amax() < 1e-7 / j.powi(3), "{s} {of_energy}");
        }
    }
}

/// No stress at rest, to the last bit, and none of a rotation.
#[test]
fn rest_and_rotation_bear_nothing() {
    for axes in [2, 3] {
        let (s, square) = of(axes, Matrix3::identity());
        assert_eq!(s, Matrix3::zeros());
        close(square, LAW.wave_speed(DENSITY).powi(2), 1e-14, 1.0);
        let turn = *Rotation3::from_axis_angle(&Vector3::z_axis(), 1.1).matrix();
        assert!(of(axes, turn).0.amax() < 4e-15);
    }
}

/// Oedometer: sigma = M ln(l)/l along the axis and lambda ln(l)/l across, for any stretch l; simple shear of an angle g has
/// principal stretches of exp(+-asinh(g/2)).
#[test]
fn oedometer_and_shear_have_closed_forms() {
    let elastic = LAW.elasticity();
    let law: AnyLaw = LAW.into();
    for e in [-0.7, -0.01, 0.2] {
        let mut point = point(&law);
        strain(&mut point, &uniaxial(e), 1000);
        let l = point.deformation()[0][0];
        let confined = elastic.lambda + 2.0 * elastic.shear;
        close(point.stress()[0], confined * l.ln() / l, 1e-12, 1.0);
        close(point.stress()[1], elastic.lambda * l.ln() / l, 1e-12, 1.0);
        let stored = 0.5 * confined * l.ln().powi(2);
        close(point.energy(), stored, 1e-12, stored);
    }
    for g in [0.1_f64, 1.0, 2.0] {
        let f = Matrix3::identity() + g * Vector3::x() * Vector3::y().transpose();
        let e = (0.5 * g).asinh();
        // tau = 2 mu e along the principal directions, turned from x by half of atan(2/g).
        let (s, _) = of(3, f);
        let (sine, cosine) = (2.0 / g).atan().sin_cos();
        close(s[(0, 1)], 2.0 * elastic.shear * e * sine, 1e-13, 1.0);
        close(s[(0, 0)], 2.0 * elastic.shear * e * cosine, 1e-13, 1.0);
        close(s[(1, 1)], -s[(0, 0)], 1e-13, 1.0);
    }
}

/// A closed way of large strain leaves no stress and gives all work back, whatever the steps.
#[test]
fn a_closed_way_gives_all_work_back() {
    let law: AnyLaw = LAW.into();
    let mut point = point(&law);
    let ways = [uniaxial(-0.4), shear(0.9), uniaxial(0.2), shear(-0.3)];
    for way in &ways {
        strain(&mut point, way, 40);
    }
    assert!(point.energy() > 0.01);
    let f = Matrix3::from_fn(|i, j| point.deformation()[i][j]);
    let back = f.try_inverse().expect("J is positive") - Matrix3::identity();
    let gradient = std::array::from_fn(|i| std::array::from_fn(|j| back[(i, j)]));
    point.step(&gradient, 1.0).expect("a finite stress");
    assert!(point.energy() < 1e-28, "{}", point.energy());
}

/// Small strains are Hooke's.
#[test]
fn small_strains_follow_hooke() {
    let mut next = numbers(2);
    let elastic = LAW.elasticity();
    let e = Matrix3::from_fn(|_, _| 1e-8 * next());
    let e = 0.5 * (e + e.transpose());
    let exact = elastic.lambda * e.trace() * Matrix3::identity() + 2.0 * elastic.shear * e;
    let mut point = point(&LAW.into());
    point.step(&midpoint(&e), 1.0).expect("a finite stress");
    let s = crate::laws::support::tensor(point.stress());
    assert!((s - exact).amax() < 2e-15, "{s} {exact}");
}

/// The speed bounds every wave: the largest eigenvalue of the acoustic tensor over many directions; and it is near one.
#[test]
fn the_wave_speed_is_a_bound() {
    let mut nearest = f64::INFINITY;
    for axes in [2, 3] {
        for size in [0.05, 0.45] {
            for f in deformations(axes, size) {
                let (_, bound) = of(axes, f);
                let mut next = numbers(77);
                let mut fastest = 0.0_f64;
                for _ in 0..60 {
                    let mut n = Vector3::new(next(), next(), next());
                    if axes == 2 {
                        n[2] = 0.0;
                    }
                    fastest = fastest.max(acoustic(axes, &f, &n.normalize()));
                }
                assert!(bound >= fastest * (1.0 - 1e-6), "{f} {bound} {fastest}");
                nearest = nearest.min(bound / fastest);
            }
        }
    }
    assert!(nearest < 1.1, "{nearest}");
}

/// Largest c² of a plane wave in the spatial direction n, by finite differences of P = tau F^-T.
fn acoustic(axes: usize, f: &Matrix3<f64>, n: &Vector3<f64>) -> f64 {
    let reference = f.transpose() * n;
    let piola =
        |f: &Matrix3<f64>| kirchhoff(f) * f.try_inverse().expect("J is positive").transpose();
    let step = 1e-6;
    let q = Matrix3::from_fn(|i, j| {
        let mut e = Matrix3::zeros();
        for b in 0..3 {
            e[(j, b)] = step * reference[b];
        }
        ((piola(&(f + e)) - piola(&(f - e))) * reference)[i] / (2.0 * step)
    });
    let q = 0.5 * (q + q.transpose());
    let most = if axes == 2 {
        q.fixed_view::<2, 2>(0, 0)
            .into_owned()
            .symmetric_eigenvalues()
            .max()
    } else {
        q.symmetric_eigenvalues().max()
    };
    most / DENSITY
}

#[test]
fn all_lanes_have_the_same_bits() {
    let lanes = [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar];
    let lanes: Vec<SelectedLanes> = lanes
        .into_iter()
        .filter_map(|choice| SelectedLanes::new(choice).ok())
        .chain([SelectedLanes::plain()])
        .collect();
    for f in deformations(2, 0.4) {
        let bits = |lanes: &SelectedLanes| lanes.run(Of::<2>(f)).0.map(f64::to_bits);
        assert!(lanes.iter().all(|other| bits(other) == bits(&lanes[0])));
    }
    for f in deformations(3, 0.4) {
        let bits = |lanes: &SelectedLanes| lanes.run(Of::<3>(f)).0.map(f64::to_bits);
        assert!(lanes.iter().all(|other| bits(other) == bits(&lanes[0])));
    }
}
