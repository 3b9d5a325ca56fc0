//! Orders and norms on made-up data whose answer is known.

use approx::assert_relative_eq;
use proctor_verification::convergence::{
    ConvergenceTable, Row, WrongErrorCount, max_norm, relative_l2,
};

/// A table of one quantity with the given errors at h = 1/8, 1/16, ...
fn table(errors: &[f64]) -> ConvergenceTable {
    let mut table = ConvergenceTable::new(["u"]);
    for (level, &error) in errors.iter().enumerate() {
        let h = 0.125 * 0.5_f64.powi(level as i32);
        table
            .push(Row {
                h,
                errors: vec![error],
                particles: 8 << level,
                steps: 10 << level,
            })
            .expect("one error");
    }
    table
}

#[test]
fn orders_of_powers_are_exact() {
    for order in [0.5, 1.0, 2.0, 3.7] {
        let errors: Vec<f64> = (0..4)
            .map(|i| 0.3 * (0.125 * 0.5_f64.powi(i)).powf(order))
            .collect();
        let table = table(&errors);
        assert_eq!(table.order(0, 0), None);
        for row in 1..4 {
            assert_relative_eq!(
                table.order(0, row).expect("an order"),
                order,
                max_relative = 1e-12
            );
        }
        assert_relative_eq!(
            table.fitted_order(0).expect("a fit"),
            order,
            max_relative = 1e-12
        );
    }
}

/// ln e = 0, -1, -3 at equal steps of ln h = ln 2: the least-squares slope is that of the outer rows, 3/(2 ln 2).
#[test]
fn the_fit_takes_the_last_three_rows() {
    let table = table(&[1e9, 1.0, (-1.0_f64).exp(), (-3.0_f64).exp()]);
    assert_relative_eq!(
        table.fitted_order(0).expect("a fit"),
        1.5 / 2.0_f64.ln(),
        max_relative = 1e-12
    );
}

#[test]
fn unequal_refinement_is_taken_into_account() {
    let mut table = ConvergenceTable::new(["u"]);
    for h in [0.3_f64, 0.17, 0.02] {
        table
            .push(Row {
                h,
                errors: vec![5.0 * h.powi(2)],
                particles: 1,
                steps: 1,
            })
            .expect("one error");
    }
    assert_relative_eq!(
        table.order(0, 2).expect("an order"),
        2.0,
        max_relative = 1e-12
    );
    assert_relative_eq!(
        table.fitted_order(0).expect("a fit"),
        2.0,
        max_relative = 1e-12
    );
}

#[test]
fn no_order_where_there_is_none() {
    for errors in [
        [1.0, f64::NAN, 0.1],
        [1.0, 0.0, 0.1],
        [1.0, -0.5, 0.1],
        [1.0, f64::INFINITY, 0.1],
    ] {
        let table = table(&errors);
        assert_eq!(table.order(0, 1), None);
        assert_eq!(table.order(0, 2), None);
        assert_eq!(table.fitted_order(0), None);
    }
    let swinging = table(&[1.0, 0.1, 0.2]);
    assert_relative_eq!(
        swinging.order(0, 2).expect("it grows"),
        -1.0,
        max_relative = 1e-12
    );
    assert_eq!(swinging.fitted_order(0), None);
    assert_eq!(table(&[1.0, 0.5]).fitted_order(0), None);
    assert_eq!(table(&[1.0]).order(0, 7), None);
    assert_eq!(table(&[1.0, 0.5]).order(3, 1), None);

    let mut same = ConvergenceTable::new(["u"]);
    for _ in 0..3 {
        same.push(Row {
            h: 0.1,
            errors: vec![1.0],
            particles: 1,
            steps: 1,
        })
        .expect("one error");
    }
    assert_eq!(same.order(0, 1), None);
    assert_eq!(same.fitted_order(0), None);
}

#[test]
fn a_row_needs_one_error_per_quantity() {
    let mut table = ConvergenceTable::new(["u", "stress"]);
    let row = Row {
        h: 0.1,
        errors: vec![1.0],
        particles: 1,
        steps: 1,
    };
    assert_eq!(
        table.push(row),
        Err(WrongErrorCount {
            expected: 2,
            found: 1
        })
    );
    assert!(table.rows().is_empty());
}

#[test]
fn the_text_table_is_aligned_and_keeps_failures() {
    let text = table(&[4e-2, 1e-2, f64::NAN]).to_string();
    let expected = "         h  particles  steps          u  order
1.2500e-1          8     10   4.000e-2      -
6.2500e-2         16     20   1.000e-2   2.00
3.1250e-2         32     40     failed      -
      fit                                    -
";
    let columns = |s: &str| {
        s.lines()
            .map(|l| l.split_whitespace().map(str::to_owned).collect())
            .collect()
    };
    let (found, wanted): (Vec<Vec<String>>, Vec<Vec<String>>) = (columns(&text), columns(expected));
    assert_eq!(found, wanted);
    let widths: Vec<usize> = text.lines().map(str::len).collect();
    assert!(widths.iter().all(|&w| w == widths[0]), "{text}");
}

#[test]
fn relative_l2_weighs_by_volume() {
    // Errors 1 and 2 with volumes 3 and 1 against a field of 5 and 0: sqrt((3 + 4) / 75).
    let samples = [(3.0, [6.0, 0.0], [5.0, 0.0]), (1.0, [0.0, 2.0], [0.0, 0.0])];
    assert_relative_eq!(
        relative_l2(samples).expect("a field"),
        (7.0_f64 / 75.0).sqrt(),
        max_relative = 1e-15
    );
    assert_eq!(relative_l2::<3>([]), None);
    assert_eq!(relative_l2([(1.0, [1.0], [0.0])]), None);
    assert!(
        relative_l2([(1.0, [f64::NAN], [1.0])])
            .expect("compared")
            .is_nan()
    );
}

#[test]
fn max_norm_takes_the_worst_component() {
    assert_eq!(
        max_norm([([1.0, -3.0], [0.0, 1.0]), ([2.0, 2.0], [0.0, 0.0])]),
        Some(4.0)
    );
    assert_eq!(max_norm::<2>([]), None);
    for samples in [
        [([f64::NAN], [0.0]), ([1.0], [0.0])],
        [([1.0], [0.0]), ([f64::NAN], [0.0])],
    ] {
        assert!(
            max_norm(samples).expect("compared").is_nan(),
            "a NaN is never hidden"
        );
    }
}
