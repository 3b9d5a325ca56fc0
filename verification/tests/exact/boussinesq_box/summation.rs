//! The two summations of the box agree with each other and with superposition, however the points are grouped.

use proctor_verification::exact::boussinesq_box::BoxProblem;
use proctor_verification::exact::special::gauss_legendre;

use super::{manual, skew, solution};

/// A patch is a bundle of point loads: Gauss points of the one (which has its own table) give the other, and with it
/// the patch's closed-form image integrals. The points are at least 0.1 m from the patch, or below it.
#[test]
fn a_patch_is_a_bundle_of_point_loads() {
    for (patch, width) in [(manual(Some(0.25)), 0.25), (skew(Some(0.3)), 0.3)] {
        let problem = patch.problem().clone();
        let [x0, y0] = problem.position;
        let h = problem.height;
        let points = [
            [0.75, 0.5, h],
            [0.65, 0.4, h],
            [0.9, 0.9, h],
            [x0, y0, h - 0.25],
            [0.75, 0.3, h - 0.001],
        ];
        let mut bundle = [[0.0; 3]; 5];
        let rule = gauss_legendre(20);
        for (xi, weight_x) in &rule {
            for (eta, weight_y) in &rule {
                let position = [x0 + 0.5 * width * xi, y0 + 0.5 * width * eta];
                let load = 0.25 * weight_x * weight_y * problem.load;
                let part = solution(BoxProblem {
                    position,
                    load,
                    patch: None,
                    ..problem.clone()
                });
                for (sum, u) in bundle.iter_mut().zip(part.displacement_many(&points)) {
                    for axis in 0..3 {
                        sum[axis] += u[axis];
                    }
                }
            }
        }
        for ((point, u), v) in points
            .iter()
            .zip(patch.displacement_many(&points))
            .zip(&bundle)
        {
            println!("{point:?}: u_z {:.12e}", u[2]);
            for axis in 0..3 {
                assert!(
                    (u[axis] - v[axis]).abs() < 1e-7 * u[2].abs(),
                    "axis {axis} at {point:?}: {u:?}, bundle {v:?}"
                );
            }
        }
    }
}

/// Series and Ewald split are different formulas; they meet where both converge.
#[test]
fn series_and_split_agree_below_the_surface() {
    for solution in [
        manual(None),
        skew(None),
        manual(Some(0.25)),
        skew(Some(0.3)),
    ] {
        let h = solution.problem().height;
        let points = [
            [0.31, 0.22, h - 0.004],
            [0.41, 0.56, h - 0.01],
            [0.0, 0.9, h - 0.02],
            [0.5, 0.5, h - 0.05],
            [0.625, 0.5, h - 0.1],
        ];
        let series = solution.displacement_by_series(&points);
        let split = solution.displacement_by_split(&points, 0.1);
        let scale = series[1][2].abs();
        for (point, (u, v)) in points.iter().zip(series.iter().zip(&split)) {
            for axis in 0..3 {
                assert!(
                    (u[axis] - v[axis]).abs() < 1e-12 * scale,
                    "axis {axis} at {point:?}: series {:e}, split {:e}",
                    u[axis],
                    v[axis]
                );
            }
        }
    }
}

#[test]
fn the_split_length_does_not_matter() {
    for solution in [
        manual(None),
        skew(None),
        manual(Some(0.25)),
        skew(Some(0.3)),
    ] {
        let h = solution.problem().height;
        let points = [
            [0.2, 0.3, h],
            [0.55, 0.5, h],
            [0.0, 0.0, h],
            [0.62, 0.41, h - 0.001],
            [0.55, 0.5, h - 0.01],
        ];
        let short = solution.displacement_by_split(&points, 0.06);
        let long = solution.displacement_by_split(&points, 0.17);
        let scale = short[1][2].abs();
        for (u, v) in short.iter().zip(&long) {
            for axis in 0..3 {
                assert!((u[axis] - v[axis]).abs() < 1e-12 * scale, "{u:?} and {v:?}");
            }
        }
    }
}

#[test]
fn a_patch_of_vanishing_side_is_a_point_load() {
    let (point_load, patch) = (skew(None), skew(Some(1e-3)));
    for point in [
        [0.7, 0.3, 0.7],
        [0.5, 0.55, 0.699],
        [0.5, 0.55, 0.65],
        [0.4, 0.55, 0.5],
    ] {
        let (u, v) = (point_load.displacement(point), patch.displacement(point));
        for axis in 0..3 {
            // The second moment of the patch, w^2/24 over the squared distance of 0.1, is 4e-6.
            assert!(
                (u[axis] - v[axis]).abs() < 2e-5 * u[2].abs(),
                "{u:?} and {v:?}"
            );
        }
    }
}

#[test]
fn order_and_grouping_do_not_change_a_value() {
    let solution = skew(None);
    let points = [
        [0.3, 0.2, 0.5],
        [0.1, 0.2, 0.3],
        [0.3, 0.7, 0.5],
        [0.3, 0.2, 0.7],
        [0.1, 0.2, 0.8],
    ];
    let many = solution.displacement_many(&points);
    for (point, u) in points.iter().zip(&many) {
        let alone = solution.displacement(*point);
        if point[2] > 0.7 {
            assert!(u.iter().all(|c| c.is_nan()), "above the box");
        } else {
            assert_eq!(*u, alone);
        }
    }
    assert!(solution.displacement_many(&[]).is_empty());
}

/// The particles of a cube at h = 1/32 with two per axis and cell: 262 144 points, the upper layer a quarter cell
/// deep. The point load is off the middle, so that no mode drops out.
#[test]
fn a_lattice_of_particles_takes_seconds() {
    let off_middle = BoxProblem {
        position: [0.43, 0.56],
        ..manual(None).problem().clone()
    };
    let n = 64;
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    let points: Vec<[f64; 3]> = (0..n * n * n)
        .map(|i| [at(i % n), at(i / n % n), at(i / (n * n))])
        .collect();
    for solution in [manual(Some(0.25)), manual(None), solution(off_middle)] {
        let start = std::time::Instant::now();
        let displacements = solution.displacement_many(&points);
        let elapsed = start.elapsed();
        println!("{} points in {elapsed:.2?}", points.len());
        assert!(displacements.iter().flatten().all(|c| c.is_finite()));
        // A wide limit: it guards against losing the grouping (hours), not against a slow machine.
        assert!(elapsed.as_secs() < 60, "{elapsed:?}");
    }
}
