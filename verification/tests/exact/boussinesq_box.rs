//! The box on rollers: tabulated values, limits and refusals; its fields and its two summations in the submodules.

mod balance;
mod summation;

use approx::assert_relative_eq;
use proctor_verification::exact::boussinesq_box::{BoxProblem, BoxSolution};
use proctor_verification::exact::boussinesq_half_space::vertical_displacement;

/// The manual's box: a unit cube, E = 200 `MPa`, nu = 0.25, 1 N in the middle.
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
