//! Finite deformation: neo-Hookean stress, its waves, and the polar decomposition, against nalgebra.

use super::*;

#[test]
fn neo_hookean_stress_is_the_formula_and_the_slope_of_its_energy() {
    let law = NEO;
    for axes in [2, 3] {
        for seed in 1..40 {
            let f = deformation(axes, seed, 0.4);
            let j = f.determinant();
            if j < 0.2 {
                continue;
            }
            let s = tensor(&ordered(axes, &call(axes, NEO, f, FINITE)));
            let b = f * f.transpose();
            let one = Matrix3::identity();
            let exact =
                (law.elasticity().shear * (b - one) + law.elasticity().lambda * j.ln() * one) / j;
            assert!((s - exact).amax() < 1.0e-14 / j, "{s} {exact}");

            // P = dW/dF and sigma = P F^T / J.
            let energy =
                |f: &Matrix3<f64>| law.energy_density((f * f.transpose()).trace(), f.determinant());
            let step = 1.0e-5;
            let p = Matrix3::from_fn(|a, c| {
                let (mut up, mut down) = (f, f);
                up[(a, c)] += step;
                down[(a, c)] -= step;
                (energy(&up) - energy(&down)) / (2.0 * step)
            });
            let from_energy = p * f.transpose() / j;
            // Central difference: step² times third derivatives, of order 1/J³.
            assert!(
                (s - from_energy).amax() < 1.0e-8 / j.powi(3),
                "{s} {from_energy}"
            );
        }
    }
}

/// The speed must bound every wave: the largest eigenvalue of the acoustic tensor over many directions.
#[test]
fn the_wave_speed_is_a_bound() {
    let law = NEO;
    let mut tight = f64::INFINITY;
    for axes in [2, 3] {
        for seed in 1..60 {
            // Some states are strongly stretched: J up to about 30.
            let f = deformation(axes, seed, 0.5) * if seed % 3 == 0 { 3.0 } else { 1.0 };
            let mut f = f;
            if axes == 2 {
                f[(2, 2)] = 1.0;
            }
            if f.determinant() < 0.2 {
                continue;
            }
            let bound = call(axes, NEO, f, LaneResult::SpeedSquared)[0];
            let mut next = numbers(seed + 1000);
            let mut fastest = 0.0_f64;
            for _ in 0..60 {
                let mut n = Vector3::new(next(), next(), next());
                if axes == 2 {
                    n[2] = 0.0;
                }
                let n = n.normalize();
                fastest = fastest.max(acoustic(&law, axes, &f, &n));
            }
            assert!(
                bound >= fastest * (1.0 - 1.0e-6),
                "J {} bound {bound} {fastest}",
                f.determinant()
            );
            tight = tight.min(bound / fastest);
        }
    }
    // And it is no wild guess: some state comes close to it.
    assert!(tight < 1.1, "{tight}");
}

/// Largest c² of a plane wave in the spatial direction n: `rho_0` c² = eigenvalue of `d P_iA/d F_jB N_A N_B` with
/// N = F^T n, by finite differences of the first Piola-Kirchhoff stress mu (F - F^-T) + lambda ln J F^-T.
fn acoustic(law: &NeoHookean, axes: usize, f: &Matrix3<f64>, n: &Vector3<f64>) -> f64 {
    let reference = f.transpose() * n;
    let piola = |f: &Matrix3<f64>| {
        let inverse = f.try_inverse().expect("J is positive").transpose();
        law.elasticity().shear * (f - inverse)
            + law.elasticity().lambda * f.determinant().ln() * inverse
    };
    let step = 1.0e-6;
    let q = Matrix3::from_fn(|i, j| {
        let mut e = Matrix3::zeros();
        for b in 0..3 {
            e[(j, b)] = step * reference[b];
        }
        ((piola(&(f + e)) - piola(&(f - e))) * reference)[i] / (2.0 * step)
    });
    let q = if axes == 2 {
        q.fixed_view::<2, 2>(0, 0).into_owned().resize(3, 3, 0.0)
    } else {
        q.resize(3, 3, 0.0)
    };
    let q = 0.5 * (&q + q.transpose());
    q.symmetric_eigenvalues().max() / DENSITY
}

#[test]
fn stretch_inverse_and_determinant_are_nalgebras() {
    for axes in [2, 3] {
        for seed in 1..60 {
            let f = deformation(axes, seed, 0.45);
            let j = f.determinant();
            if j < 0.2 {
                continue;
            }
            assert!((call(axes, NEO, f, LaneResult::Determinant)[0] - j).abs() < 4.0e-15);
            let mut inverse = matrix(&call(axes, NEO, f, LaneResult::Inverse));
            inverse[(2, 2)] = if axes == 2 { 1.0 } else { inverse[(2, 2)] };
            // Entries of cofactors over J >= 0.2.
            assert!((inverse * f - Matrix3::identity()).amax() < 2.0e-14);
            // Rotate, so that R is not small.
            let turn = *Rotation3::from_axis_angle(&Vector3::z_axis(), 2.5).matrix();
            let svd = f.svd(true, true);
            let v = svd.v_t.expect("asked for");
            let u = v.transpose() * Matrix3::from_diagonal(&svd.singular_values) * v;
            // V of F R is V of F, as U of R F is U of F.
            let w = svd.u.expect("asked for");
            let left = w * Matrix3::from_diagonal(&svd.singular_values) * w.transpose();
            let found = call(axes, NEO, f * turn, LaneResult::LeftStretch);
            for axis in 0..axes {
                assert!(
                    (found[axis] - left[(axis, axis)]).abs() < 1.0e-13,
                    "{found:?} {left}"
                );
            }
            let diagonal = call(axes, NEO, turn * f, LaneResult::Stretch);
            for axis in 0..axes {
                assert!(
                    (diagonal[axis] - u[(axis, axis)]).abs() < 1.0e-13,
                    "{diagonal:?} {u}"
                );
            }
        }
    }
}

/// Stretches of ten and a tenth are the promise of the iteration in three dimensions.
#[test]
fn large_stretches_reach_round_off() {
    let turn = *Rotation3::from_axis_angle(
        &nalgebra::Unit::new_normalize(Vector3::new(1.0, 2.0, 3.0)),
        1.0,
    )
    .matrix();
    for stretch in [
        [10.0, 1.0, 1.0],
        [0.1, 1.0, 1.0],
        [10.0, 0.1, 1.0],
        [10.0, 10.0, 0.1],
    ] {
        let u = Matrix3::from_diagonal(&Vector3::from(stretch));
        let diagonal = call(3, NEO, turn * u, LaneResult::Stretch);
        for axis in 0..3 {
            assert!(
                (diagonal[axis] - stretch[axis]).abs() < 1.0e-13 * 10.0,
                "{diagonal:?} {stretch:?}"
            );
        }
    }
}
