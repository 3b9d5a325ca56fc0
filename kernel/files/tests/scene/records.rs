//! Records and particle lists in text files.

use std::path::{Path, PathBuf};

use proctor_files::records::{read, read_particles};
use proctor_scene::{Dimension, History};

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

/// A file of a folder of its own with this text.
fn written(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::TempDir::new().expect("a folder");
    let path = folder.path().join("record.txt");
    std::fs::write(&path, text).expect("a record");
    (folder, path)
}

/// Columns stand apart by commas, semicolons, tabs or blanks, with blanks around each; names in a header may have blanks.
#[test]
fn any_separator_is_read() {
    let expected = History {
        times: vec![0.0, 0.02, 0.04],
        values: vec![[0.5, -1.25, 3.0], [1e-3, 0.0, 0.25], [0.0, 7.0, -0.5]],
    };
    let rows = ["0 0.5 -1.25 3", "0.02 1e-3 0 0.25", "0.04 0 7 -0.5"];
    for separator in [
        ",", ", ", " , ", ";", " ; ", "\t", " \t", " ", "    ", "  \t  ",
    ] {
        for header in [
            "",
            "t ax ay az\n",
            "t,ax,ay,az\n",
            "time [s], a x, a y, a z\n",
        ] {
            for before in ["", "   "] {
                let rows = rows.map(|row| before.to_owned() + &row.replace(' ', separator));
                let text = header.to_owned() + &rows.join(" \r\n") + "\n";
                let (_folder, path) = written(&text);
                let record = read(&path, None, Dimension::Three);
                assert_eq!(record.as_ref(), Ok(&expected), "{text:?}");
                let seeds = rows.join("\n").replace('-', "");
                std::fs::write(&path, &seeds).expect("particles");
                let seeds = read_particles(&path, Dimension::Three);
                assert_eq!(seeds.as_ref().map(Vec::len), Ok(3), "{seeds:?}");
            }
        }
    }
}

/// A table that cannot be read names the separators, and a decimal comma its fault.
#[test]
fn a_record_that_cannot_be_split_names_the_separators() {
    let said = |text: &str| {
        let (_folder, path) = written(text);
        let error = read(&path, None, Dimension::Two).expect_err(text);
        let said = error.to_string();
        said.split_once("record.txt:")
            .expect("a place")
            .1
            .to_owned()
    };
    for text in ["0|1|2\n1|2|3\n", "0:1:2\n1:2:3\n"] {
        let said = said(text);
        assert!(
            said.contains("separated by `,`, `;`, tabs or blanks"),
            "{said}"
        );
    }
    let told = said("0 1\n1 2\n");
    assert!(
        told.starts_with("1:1: found 2 columns, separated by blanks"),
        "{told}"
    );
    for (text, place) in [
        ("0,5 1,0 2,0\n1,5 1,0 2,0\n", "2:1"),
        ("0 1 2\n1  0,5 2\n", "2:4"),
        ("0;0,5;2\n", "1:3"),
    ] {
        let told = said(text);
        assert!(told.starts_with(place), "{told}");
        assert!(told.contains("with a decimal point"), "{told}");
    }
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

/// Rows in JSON, and a header with the columns in another order, are the same list.
#[test]
fn particles_come_as_json_and_by_the_names_of_a_header() {
    let seeds = |text: &str, dimension| {
        let (_folder, path) = written(text);
        read_particles(&path, dimension)
    };
    let plain = seeds("0.25 0.5 0.1\n0.75 0.5 0.2\n", Dimension::Two).expect("a table");
    for text in [
        "[[0.25, 0.5, 0.1],\n [0.75, 0.5, 0.2]]\n",
        "x,y,volume\n0.25,0.5,0.1\n0.75,0.5,0.2\n",
        "Volume;Y;X\n0.1;0.5;0.25\n0.2;0.5;0.75\n",
    ] {
        assert_eq!(seeds(text, Dimension::Two).as_ref(), Ok(&plain), "{text}");
    }
    for (text, place) in [
        (
            "[[0, 0, 0, 1],\n [0, 0, 1, -1]]",
            "2:2: found the volume -1",
        ),
        (
            "[[0, 0, 0, 1],\n\n  [0, 0, 1]]",
            "3:3: found a list of length 3",
        ),
        (
            "[[0, 0, 0, 1], [0, \"a\", 0, 1]]",
            // How serde_json counts the column depends on its features.
            "found invalid type: string \"a\"",
        ),
        ("[[0, 0, 0, 1]", "1:13: found EOF"),
    ] {
        let error = seeds(text, Dimension::Three).expect_err(text).to_string();
        assert!(error.contains(place), "{error}");
    }
}
