//! The box on rollers: tabulated values, boundary conditions, equilibrium, and agreement of its two summations.

use approx::assert_relative_eq;
use proctor_verification::exact::boussinesq_box::{BoxProblem, BoxSolution};
use proctor_verification::exact::boussinesq_half_space::vertical_displacement;
use proctor_verification::exact::special::gauss_legendre;

/// The manual's box: a unit cube, E = 200 MPa, nu = 0.25, 1 N in the middle.
fn manual(patch: Option<f64>) -> BoxSolution {
    solution(BoxProblem {
        a: 1.0,
        b: 1.0,
        height: 1.0,
        young: 200e6,
        poisson: 0.25,
        load: 1.0,
        position: [0.5, 0.5],
        patch,
    })
}

/// Nothing symmetric: unequal sides, load off the middle.
fn skew(patch: Option<f64>) -> BoxSolution {
    solution(BoxProblem {
        a: 1.3,
        b: 0.9,
        height: 0.7,
        young: 3e6,
        poisson: 0.31,
        load: 40.0,
        position: [0.4, 0.55],
        patch,
    })
}

fn solution(problem: BoxProblem) -> BoxSolution {
    BoxSolution::new(problem).expect("the problem of a test is valid")
}

#[track_caller]
fn assert_table(solution: &BoxSolution, table: &[([f64; 3], f64)], digits: f64) {
    for &(point, expected) in table {
        let u_z = 1e9 * solution.displacement(point)[2];
        assert!(
            (u_z - expected).abs() <= 0.51 * digits,
            "u_z{point:?} is {u_z:.8}e-9, the table has {expected}e-9"
        );
    }
}

/// Verification notes, section 2: all values of the point load, below and on the surface.
#[test]
fn point_load_has_the_tabulated_displacements() {
    let table = [
        ([0.5, 0.5, 0.95], -48.035_974),
        ([0.5, 0.5, 0.90], -23.132_286),
        ([0.5, 0.5, 0.80], -10.654_591),
        ([0.5, 0.5, 0.70], -6.490_505),
        ([0.5, 0.5, 0.50], -3.135_443),
        ([0.5, 0.5, 0.25], -1.280_970),
        ([0.5, 0.5, 0.10], -0.490_591),
        ([0.6, 0.5, 0.90], -12.366_181),
        ([0.75, 0.5, 0.75], -4.068_711),
        ([1.0, 1.0, 0.5], -1.489_271),
        ([1.0, 0.5, 0.5], -1.916_325),
        ([0.55, 0.5, 1.0], -28.196_615),
        ([0.60, 0.5, 1.0], -13.301_513),
        ([0.65, 0.5, 1.0], -8.371_679),
        ([0.70, 0.5, 1.0], -5.948_226),
        ([0.75, 0.5, 1.0], -4.541_278),
        ([0.80, 0.5, 1.0], -3.656_514),
        ([0.90, 0.5, 1.0], -2.725_295),
        ([1.0, 0.5, 1.0], -2.462_178),
        ([1.0, 1.0, 1.0], -1.756_713),
    ];
    assert_table(&manual(None), &table, 1e-6);
}

/// The same for the patches of side 0.25 m and 0.2 m.
///
/// Two surface values of the notes, -4.80687 at (0.75, 0.5, 1) and -24.6704 at the centre of the patch of 0.2 m, come
/// from series cut at some 800 and 1200 modes per axis. Such sums, computed apart from this code, err like
/// 1/modes^2 (-4.806875, -4.806848 and -24.670195, -24.670448 for 800 and 1200 modes); extrapolated they give
/// -4.80683 and -24.67065.
#[test]
fn patch_loads_have_the_tabulated_displacements() {
    let quarter = [
        ([0.5, 0.5, 0.75], -6.992_00),
        ([0.5, 0.5, 0.5], -2.993_49),
        ([0.75, 0.5, 0.75], -4.081_58),
        ([1.0, 0.5, 0.5], -1.942_83),
        ([1.0, 1.0, 0.5], -1.531_09),
        ([0.75, 0.5, 1.0], -4.806_83),
        ([1.0, 1.0, 1.0], -1.822_83),
    ];
    assert_table(&manual(Some(0.25)), &quarter, 1e-5);
    let fifth = [
        ([0.5, 0.5, 1.0], -24.670_65),
        ([0.5, 0.5, 0.9], -15.332_87),
        ([0.5, 0.5, 0.75], -7.354_33),
    ];
    assert_table(&manual(Some(0.2)), &fifth, 1e-5);
    assert_table(&manual(Some(0.2)), &[([0.5, 0.5, 0.5], -3.0422)], 1e-4);
}

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

/// Close to the load the box is a half-space up to a bounded displacement: `(box - half-space)/half-space -> 0`.
#[test]
fn near_the_load_it_is_the_half_space() {
    let solution = manual(None);
    for (r, d) in [(1e-4, 0.0), (0.0, 1e-4), (1e-4, 1e-4)] {
        let u_z = solution.displacement([0.5 + r, 0.5, 1.0 - d])[2];
        assert_relative_eq!(
            u_z,
            vertical_displacement(200e6, 0.25, 1.0, r, d),
            max_relative = 2e-4
        );
    }
    let under = solution.displacement([0.5, 0.5, 1.0]);
    assert!(
        under[0].abs() < 1e-20 && under[1].abs() < 1e-20 && under[2] == f64::NEG_INFINITY,
        "{under:?}"
    );
}

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

#[test]
fn a_problem_without_a_solution_is_refused_by_field() {
    let good = manual(None).problem().clone();
    let refused = |problem: BoxProblem| {
        BoxSolution::new(problem)
            .expect_err("must be refused")
            .field
    };
    assert_eq!(
        refused(BoxProblem {
            a: 0.0,
            ..good.clone()
        }),
        "a"
    );
    assert_eq!(
        refused(BoxProblem {
            height: f64::NAN,
            ..good.clone()
        }),
        "height"
    );
    assert_eq!(
        refused(BoxProblem {
            poisson: 0.5,
            ..good.clone()
        }),
        "poisson"
    );
    assert_eq!(
        refused(BoxProblem {
            load: f64::INFINITY,
            ..good.clone()
        }),
        "load"
    );
    assert_eq!(
        refused(BoxProblem {
            position: [0.5, 1.2],
            ..good.clone()
        }),
        "position y"
    );
    assert_eq!(
        refused(BoxProblem {
            position: [0.1, 0.5],
            patch: Some(0.25),
            ..good.clone()
        }),
        "position x"
    );
    assert_eq!(
        refused(BoxProblem {
            patch: Some(-1.0),
            ..good
        }),
        "patch"
    );
}

/// The particles of a cube at h = 1/32 with two per axis and cell: 262 144 points, the upper layer a quarter cell deep.
#[test]
fn a_lattice_of_particles_takes_seconds() {
    let solution = manual(Some(0.25));
    let n = 64;
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    let points: Vec<[f64; 3]> = (0..n * n * n)
        .map(|i| [at(i % n), at(i / n % n), at(i / (n * n))])
        .collect();
    let start = std::time::Instant::now();
    let displacements = solution.displacement_many(&points);
    let elapsed = start.elapsed();
    println!("{} points in {elapsed:.2?}", points.len());
    assert!(displacements.iter().flatten().all(|c| c.is_finite()));
    // A wide limit: it guards against losing the grouping (hours), not against a slow machine.
    assert!(elapsed.as_secs() < 60, "{elapsed:?}");
}
