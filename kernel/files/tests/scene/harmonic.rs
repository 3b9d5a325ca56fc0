//! Accelerograms of a harmonic motion, as the manual prints them.

use proctor_files::records::{Harmonic, accelerogram, to_csv};
use proctor_scene::History;

#[test]
fn numbers_are_spelt_as_in_the_manual() {
    let spelt = |x: f64| {
        let text = to_csv(&History {
            times: vec![x],
            values: vec![[0.0; 3]],
        });
        let row = text.lines().nth(1).expect("a row");
        row.split(',').next().expect("a time").to_owned()
    };
    assert_eq!(spelt(0.0), "0.0");
    assert_eq!(spelt(-0.0), "-0.0");
    assert_eq!(spelt(5e-5), "5e-05");
    assert_eq!(spelt(1e-4), "0.0001");
    assert_eq!(spelt(3.0 * 5e-5), "0.00015000000000000001");
    assert_eq!(spelt(-1.5e-12), "-1.5e-12");
}

#[test]
fn first_rows_are_those_that_the_manual_prints() {
    let text = to_csv(&accelerogram(&Harmonic {
        intervals: 3,
        ..Harmonic::of_the_manual()
    }));
    assert_eq!(
        text,
        "t,ax,ay,az\n\
         0.0,-1.8849555921538759,-0.9424777960769379,-0.0\n\
         5e-05,-1.8849554991350466,-0.9424777844495842,-0.0\n\
         0.0001,-1.884955220078568,-0.9424777495675233,-0.0\n\
         0.00015000000000000001,-1.8849547549844674,-0.9424776914307561,-0.0\n"
    );
}
