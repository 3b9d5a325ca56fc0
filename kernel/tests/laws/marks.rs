//! Von Mises with a yield stress along straight lines between marks.

use crate::laws::support::{DENSITY, close, midpoint, numbers, point, strain, uniaxial};
use nalgebra::Matrix3;
use proctor_laws::{AnyLaw, Band, Point, VonMises};

const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.3;
const YIELD: f64 = 0.1;
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
const CONFINED: f64 = BULK + 4.0 * SHEAR / 3.0;

/// Rows of three materials: one that hardens in two pieces, one in three, and one that hardens, softens and hardens.
const CURVES: [&[[f64; 2]]; 3] = [
    &[[0.002, 0.15]],
    &[[0.001, 0.13], [0.004, 0.16]],
    &[[0.001, 0.14], [0.003, 0.11], [0.006, 0.12]],
];
/// Slope beyond the last row.
const LAST: f64 = 2.0;

fn bare() -> VonMises {
    VonMises::new(YOUNG, POISSON, YIELD, LAST)
}

fn law(rows: &[[f64; 2]]) -> AnyLaw {
    bare().along(rows).into()
}

/// Corners of the curve from (0, Y_0) on, and a point far on its last piece.
fn corners(rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut all = vec![[0.0, YIELD]];
    all.extend_from_slice(rows);
    let [k, y] = all[all.len() - 1];
    all.push([k + 0.01, y + 0.01 * LAST]);
    all
}

/// Yield stress at a plastic strain, by interpolation.
fn interpolated(rows: &[[f64; 2]], k: f64) -> f64 {
    let all = corners(rows);
    let piece = all.windows(2).find(|pair| k <= pair[1][0]);
    let pair = piece.unwrap_or(&all[all.len() - 2..]);
    let share = (k - pair[0][0]) / (pair[1][0] - pair[0][0]);
    pair[0][1] + share * (pair[1][1] - pair[0][1])
}

/// Strained along one axis, q = 2 G e - 3 G k lies on the curve, so that its corners are at e = (Y + 3 G k)/2G and stress is
/// K e + 2 Y/3 there and linear between them: one slope for each piece. Any number of steps is exact, also one step across
/// all corners; turned back it is elastic for 2 Y(k)/2G.
#[test]
fn an_oedometer_has_a_slope_for_each_piece() {
    for rows in CURVES {
        let exact = |k: f64| {
            let y = interpolated(rows, k);
            let e = (y + 3.0 * SHEAR * k) / (2.0 * SHEAR);
            (e, BULK * e + 2.0 / 3.0 * y)
        };
        let ends: Vec<f64> = corners(rows)
            .windows(2)
            .flat_map(|pair| [0.3, 1.0].map(|share| pair[0][0] + share * (pair[1][0] - pair[0][0])))
            .collect();
        for k in ends {
            let (e, stress) = exact(k);
            for steps in [1, 2, 7, 100] {
                let mut point = point(&law(rows));
                strain(&mut point, &uniaxial(e), steps);
                close(point.stress()[0], stress, 1e-14 * f64::from(steps), stress);
                close(point.variables()[0], k, 1e-13, k);
            }
            let mut point = point(&law(rows));
            strain(&mut point, &uniaxial(e), 3);
            let back = interpolated(rows, k) / SHEAR;
            strain(&mut point, &uniaxial(-back), 2);
            close(point.stress()[0], stress - CONFINED * back, 1e-13, stress);
            close(point.variables()[0], k, 1e-13, k);
        }
    }
}

/// On any path a stress that yields is on the curve, at the plastic strain that it carries.
#[test]
fn what_yields_is_on_the_curve() {
    for rows in CURVES {
        let law = law(rows);
        for seed in 1..20 {
            let mut next = numbers(seed);
            let mut point = Point::new(&law, DENSITY, [0.0; 6]);
            let mut on_curve = 0;
            for _ in 0..60 {
                let before = point.variables()[0];
                let d = Matrix3::from_fn(|_, _| 1e-3 * next());
                point.step(&midpoint(&d), 1.0).expect("a finite stress");
                let (s, k) = (point.stress(), point.variables()[0]);
                let mean = (s[0] + s[1] + s[2]) / 3.0;
                let normal: f64 = s[..3].iter().map(|x| (x - mean).powi(2)).sum();
                let beside: f64 = s[3..].iter().map(|x| x * x).sum();
                let q = (1.5 * normal + 3.0 * beside).sqrt();
                let y = interpolated(rows, k);
                assert!(q < y * (1.0 + 1e-13), "{q} beyond {y} at {k}");
                if k > before {
                    close(q, y, 1e-13, y);
                    on_curve += 1;
                }
            }
            assert!(on_curve > 20, "{on_curve} steps yielded");
        }
    }
}

/// Marks on one line are that line.
#[test]
fn marks_on_a_line_are_linear_hardening() {
    let hardening = 20.0;
    let rows = [0.001, 0.002, 0.005].map(|k| [k, YIELD + hardening * k]);
    let line: AnyLaw = VonMises::new(YOUNG, POISSON, YIELD, hardening).into();
    let marks: AnyLaw = VonMises::new(YOUNG, POISSON, YIELD, hardening)
        .along(&rows)
        .into();
    for seed in 1..10 {
        let mut next = numbers(seed);
        let mut points = [point(&line), point(&marks)];
        for _ in 0..40 {
            let gradient = midpoint(&Matrix3::from_fn(|_, _| 1e-3 * next()));
            for point in &mut points {
                point.step(&gradient, 1.0).expect("a finite stress");
            }
        }
        let [a, b] = points.map(|point| (point.stress(), point.variables()[0]));
        for (a, b) in a.0.iter().zip(b.0) {
            close(*a, b, 1e-12, YIELD);
        }
        close(a.1, b.1, 1e-12, a.1);
        assert!(a.1 > 0.005, "{} passes no mark", a.1);
    }
}

/// In cells twice as wide as the band, plastic strain counts twice where the yield stress falls, and once where it rises.
#[test]
fn falling_pieces_scale_with_the_cell() {
    let rows: [[f64; 2]; 2] = [[0.001, 0.14], [0.003, 0.11]];
    let banded = bare().along(&rows).in_band(Band::of_width(0.1));
    // The order in which a law is told of its band and of its marks does not matter.
    assert_eq!(banded, bare().in_band(Band::of_width(0.1)).along(&rows));
    let banded: AnyLaw = banded.into();
    let wide = banded.in_cells(0.2).expect("it has a band");
    let same = law(&[[0.001, 0.14], [0.002, 0.11]]);
    for e in [0.002, 0.003, 0.004, 0.008] {
        let stress = [&wide, &same].map(|law| {
            let mut point = point(law);
            strain(&mut point, &uniaxial(e), 5);
            point.stress()[0]
        });
        close(stress[0], stress[1], 1e-14, stress[1]);
    }
    assert!(law(&rows).warnings()[0].contains("proportional to the cell size"));
    assert_eq!(banded.warnings(), Vec::<String>::new());
}

#[test]
fn curves_that_are_none_are_refused() {
    let many: Vec<[f64; 2]> = (1..=17).map(|i| [f64::from(i), 1.0]).collect();
    for (rows, found) in [
        (&[[0.0, 0.1]][..], "a plastic strain of 0 in row 0"),
        (
            &[[0.1, 0.1], [0.1, 0.2]],
            "a plastic strain of 0.1 in row 1",
        ),
        (&[[f64::NAN, 0.1]], "a plastic strain of NaN in row 0"),
        (&[[0.1, 0.0]], "a yield stress of 0 in row 0"),
        (&[[0.1, f64::INFINITY]], "a yield stress of inf in row 0"),
        (
            &[[0.001, 0.3], [0.0015, 0.2]],
            "rows with a slope of -199.9",
        ),
        (&many, "17 rows"),
    ] {
        let problems = law(rows).problems();
        assert!(
            matches!(&problems[..], [only] if only.key == "hardening.curve" && only.found.contains(found)),
            "{rows:?}: {problems:?}"
        );
    }
    let both: AnyLaw = bare().saturating(1.0, 2.0).along(&[[0.1, 0.2]]).into();
    assert_eq!(both.problems()[0].key, "hardening.curve");
    // As steep as 3 G lets it, and beyond the widest cell.
    let steep = |fall: f64| bare().along(&[[0.001, 0.3], [0.002, 0.3 - 0.001 * fall]]);
    let most = 3.0 * SHEAR;
    for (share, count) in [(0.999, 0), (1.001, 1)] {
        let law: AnyLaw = steep(share * most).into();
        assert_eq!(law.problems().len(), count, "{share}");
        let law: AnyLaw = steep(0.5 * most).in_band(Band::of_width(0.1)).into();
        let placed = law.in_cells(0.2 * share).expect("it has a band");
        assert_eq!(placed.problems().len(), count, "{share}");
    }
}

/// Softening without an end comes to no strength, and not to one that turns the stress around.
#[test]
fn strength_does_not_fall_below_none() {
    for softens in [
        VonMises::new(YOUNG, POISSON, YIELD, -20.0),
        VonMises::new(YOUNG, POISSON, YIELD, -20.0).along(&[[0.001, 0.12]]),
        VonMises::new(YOUNG, POISSON, YIELD, -20.0).saturating(0.05, 300.0),
    ] {
        let law: AnyLaw = softens.into();
        for steps in [1, 30] {
            let mut point = point(&law);
            strain(&mut point, &uniaxial(0.05), steps);
            // Once more, from a stress without a deviator.
            strain(&mut point, &Matrix3::zeros(), 1);
            let mean = BULK * 0.05;
            for normal in &point.stress()[..3] {
                close(*normal, mean, 1e-13, mean);
            }
            assert!(point.variables()[0] > 0.005);
        }
    }
}
