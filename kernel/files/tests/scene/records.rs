//! Records and particle lists in text files.

use std::path::{Path, PathBuf};

use proctor_files::records::{read, read_particles};
use proctor_kernel::scene::{Dimension, History};

fn file(name: &str) -> PathBuf {
    Path::new("../../fixtures/records").join(name)
}

#[test]
fn separators_and_headers_are_found() {
    let expected = History {
        times: vec![0.0, 0.5],
        values: vec![[1.0, 2.0, 3.0], [-1e-3, 0.0, 0.25]],
    };
    for (name, headers) in [
        ("comma_header.csv", [None, Some(true)]),
        ("semicolon_plain.csv", [None, Some(false)]),
    ] {
        for header in headers {
            let record = read(&file(name), header, Dimension::Three);
            assert_eq!(record.as_ref(), Ok(&expected), "{name} {header:?}");
        }
    }
    let flat = read(&file("tab_header_2d.csv"), None, Dimension::Two).expect("a record");
    assert_eq!(flat.values, [[1.0, 2.0, 0.0], [-1e-3, 0.0, 0.0]]);
}

#[test]
fn faults_have_line_and_column() {
    let cases = [
        ("bad/malformed.csv", None),
        ("bad/short_row.csv", None),
        ("bad/times_stand.csv", None),
        ("bad/one_row.csv", None),
        ("comma_header.csv", Some(false)),
        ("semicolon_plain.csv", Some(true)),
        ("nowhere.csv", None),
    ];
    let mut shown = Vec::new();
    for (name, header) in cases {
        let error = read(&file(name), header, Dimension::Three).expect_err(name);
        shown.push(error.to_string());
    }
    let error = read_particles(&file("bad/particles.csv"), Dimension::Three).expect_err("a volume");
    shown.push(error.to_string());
    insta::assert_snapshot!(shown.join("\n"));
}
