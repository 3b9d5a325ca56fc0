//! The fields of the box obey the rollers, Hooke's law, equilibrium and the load.

use approx::assert_relative_eq;
use proctor_verification::exact::boussinesq_box::BoxSolution;

use super::{manual, skew};

/// Midpoint sums over a plane are exact for the modes that reach it.
#[test]
fn every_plane_carries_the_load() {
    for solution in [manual(None), skew(Some(0.3))] {
        let problem = solution.problem().clone();
        let n = 32;
        for z in [0.0, 0.4 * problem.height, 0.75 * problem.height] {
            let points: Vec<[f64; 3]> = (0..n * n)
                .map(|i| {
                    let x = (f64::from(i % n) + 0.5) / f64::from(n) * problem.a;
                    let y = (f64::from(i / n) + 0.5) / f64::from(n) * problem.b;
                    [x, y, z]
                })
                .collect();
            let area = problem.a * problem.b / f64::from(n * n);
            let force: f64 = solution
                .stress_many(&points)
                .iter()
                .map(|s| s.map_or(f64::NAN, |s| s[2] * area))
                .sum();
            assert_relative_eq!(force, -problem.load, max_relative = 1e-9);
        }
    }
}

/// Rollers: no normal displacement and no shear on the base and the four sides.
#[test]
fn rollers_hold_and_do_not_drag() {
    for solution in [skew(None), skew(Some(0.3))] {
        let (a, b) = (solution.problem().a, solution.problem().b);
        let scale = solution.displacement([0.4, 0.5, 0.5]);
        let stress_scale = solution
            .stress_zz([0.4, 0.5, 0.5])
            .expect("below the surface")
            .abs();
        // (point, axis of the normal, the two shears on the face in xx, yy, zz, xy, yz, zx)
        let faces = [
            ([0.0, 0.3, 0.5], 0, [3, 5]),
            ([a, 0.3, 0.5], 0, [3, 5]),
            ([0.3, 0.0, 0.5], 1, [3, 4]),
            ([0.3, b, 0.5], 1, [3, 4]),
            ([0.3, 0.3, 0.0], 2, [4, 5]),
        ];
        for (point, normal, shears) in faces {
            assert!(solution.displacement(point)[normal].abs() < 1e-13 * scale[2].abs());
            let stress = solution.stress_many(&[point])[0].expect("below the surface");
            for shear in shears {
                assert!(
                    stress[shear].abs() < 1e-13 * stress_scale,
                    "shear {shear} at {point:?}: {}",
                    stress[shear]
                );
            }
        }
    }
    // On the sides right at the surface too, where the other summation works.
    let solution = skew(Some(0.3));
    let scale = solution.displacement([0.4, 0.5, 0.7])[2].abs();
    assert!(solution.displacement([1.3, 0.3, 0.7])[0].abs() < 1e-12 * scale);
    assert!(solution.displacement([0.3, 0.0, 0.7])[1].abs() < 1e-12 * scale);
}

/// Central differences of fourth order: `d u_i / d x_j`.
fn gradient(solution: &BoxSolution, point: [f64; 3], step: f64) -> [[f64; 3]; 3] {
    let mut gradient = [[0.0; 3]; 3];
    for j in 0..3 {
        for (offset, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
            let mut shifted = point;
            shifted[j] += offset * step;
            let u = solution.displacement(shifted);
            for i in 0..3 {
                gradient[i][j] += weight * u[i] / (12.0 * step);
            }
        }
    }
    gradient
}

/// Hooke's law on differences of the displacement gives the stress of the series.
#[test]
fn stresses_follow_from_the_displacements() {
    for solution in [skew(None), skew(Some(0.3)), manual(None)] {
        let problem = solution.problem();
        let mu = problem.young / (2.0 * (1.0 + problem.poisson));
        let lambda = 2.0 * mu * problem.poisson / (1.0 - 2.0 * problem.poisson);
        for point in [[0.3, 0.2, 0.3], [0.5, 0.6, 0.5], [0.45, 0.5, 0.6]] {
            let g = gradient(&solution, point, 1e-3);
            let trace = g[0][0] + g[1][1] + g[2][2];
            let expected = [
                lambda * trace + 2.0 * mu * g[0][0],
                lambda * trace + 2.0 * mu * g[1][1],
                lambda * trace + 2.0 * mu * g[2][2],
                mu * (g[0][1] + g[1][0]),
                mu * (g[1][2] + g[2][1]),
                mu * (g[0][2] + g[2][0]),
            ];
            let stress = solution.stress_many(&[point])[0].expect("below the surface");
            for i in 0..6 {
                // Differences over 1e-3: truncation (1e-3 / 0.1)^4 = 1e-8 of the stress.
                assert!(
                    (stress[i] - expected[i]).abs() < 1e-7 * stress[2].abs(),
                    "component {i} at {point:?}: {stress:?} for {expected:?}"
                );
            }
        }
    }
}

/// div sigma = 0 by differences of the stress series.
#[test]
fn stresses_are_in_equilibrium() {
    let solution = skew(None);
    // Row i of the stress tensor in xx, yy, zz, xy, yz, zx.
    let rows = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
    for point in [[0.3, 0.2, 0.3], [0.5, 0.6, 0.45], [1.0, 0.1, 0.6]] {
        let step = 1e-3;
        let mut residual = [0.0; 3];
        let mut terms = 0.0_f64;
        for j in 0..3 {
            for (offset, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
                let mut shifted = point;
                shifted[j] += offset * step;
                let stress = solution.stress_many(&[shifted])[0].expect("below the surface");
                for i in 0..3 {
                    residual[i] += weight * stress[rows[i][j]] / (12.0 * step);
                    terms = terms.max((stress[rows[i][j]] / (12.0 * step)).abs());
                }
            }
        }
        for i in 0..3 {
            assert!(
                residual[i].abs() < 1e-8 * terms,
                "axis {i} at {point:?}: {} of {terms}",
                residual[i]
            );
        }
    }
}

/// The loaded surface: pressure under the patch, none beside it, no shear.
#[test]
fn the_surface_carries_the_patch_pressure() {
    let solution = skew(Some(0.3));
    let pressure = 40.0 / 0.09;
    let depth = 0.002;
    let under = solution.stress_many(&[[0.4, 0.55, 0.7 - depth]])[0].expect("deep enough");
    let beside = solution.stress_many(&[[1.0, 0.3, 0.7 - depth]])[0].expect("deep enough");
    // s_zz leaves its surface value with the third power of depth over distance to the patch's edge: (2/150)^3.
    assert_relative_eq!(under[2], -pressure, max_relative = 1e-5);
    assert!(beside[2].abs() < 1e-5 * pressure);
    for shear in [4, 5] {
        assert!(under[shear].abs() < 1e-3 * pressure && beside[shear].abs() < 1e-3 * pressure);
    }
    assert_eq!(solution.stress_zz([0.4, 0.55, 0.7]), None);
}
