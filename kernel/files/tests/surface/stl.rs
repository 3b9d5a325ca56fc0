//! STL files.

use proctor_contact::geometry::surface::SurfaceErrorKind;
use proctor_files::stl::{StlErrorKind, parse, read};
use std::path::Path;

const ASCII: &str = "solid two words
  facet normal 0 0 1
    outer loop
      vertex 0 0 0
      vertex 1.5e0 0 0
      vertex 0 1000000.125 0
    endloop
  endfacet
endsolid two words
";

fn binary(header: &[u8], triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes[..header.len()].copy_from_slice(header);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0.0_f32; 3].iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(corners.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([7, 0]);
    }
    bytes
}

const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1_000_000.125, 0.0]];

#[test]
fn ascii_keeps_64_bits() {
    assert_eq!(parse(ASCII.as_bytes()), Ok(vec![CORNERS]));
}

#[test]
fn ascii_in_any_layout() {
    let loud = ASCII.to_uppercase().replace('\n', "\r\n\r\n");
    assert_eq!(parse(loud.as_bytes()), Ok(vec![CORNERS]));
    let nameless = ASCII.replace(" two words", "");
    assert_eq!(parse(nameless.as_bytes()), Ok(vec![CORNERS]));
}

#[test]
fn several_solids_are_one_surface() {
    let twice = format!("{ASCII}{ASCII}");
    assert_eq!(parse(twice.as_bytes()), Ok(vec![CORNERS; 2]));
}

#[test]
fn binary_whatever_its_header_says() {
    let triangle = [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 0.25, -3.0]];
    for header in [&b""[..], b"solid is what some programs write"] {
        let corners = parse(&binary(header, &[triangle; 3]));
        assert_eq!(corners, Ok(vec![triangle.map(|x| x.map(f64::from)); 3]));
    }
}

#[test]
fn files_without_a_triangle() {
    let empty = Err(StlErrorKind::Surface(SurfaceErrorKind::Empty));
    assert_eq!(parse(b""), empty);
    assert_eq!(parse(b"solid nothing\nendsolid nothing\n"), empty);
    assert_eq!(parse(&binary(b"", &[])), empty);
}

#[test]
fn a_binary_file_that_is_cut_off() {
    let whole = binary(b"", &[[[0.0; 3]; 3]; 4]);
    assert_eq!(
        parse(&whole[..whole.len() - 1]),
        Err(StlErrorKind::Length {
            triangles: 4,
            expected: 284,
            found: 283,
        })
    );
    assert!(matches!(
        parse(&whole[..40]),
        Err(StlErrorKind::Unreadable(_))
    ));
}

/// Line and triangle of the fault.
#[track_caller]
fn fault(text: &str, expected: (usize, usize)) {
    match parse(text.as_bytes()) {
        Err(StlErrorKind::Line { line, triangle, .. }) => {
            assert_eq!((line, triangle), expected);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn faults_of_ascii_files_have_line_and_triangle() {
    fault(&ASCII.replace("1.5e0", "1,5"), (5, 1));
    fault(&ASCII.replace("1.5e0", "nan"), (5, 1));
    fault(&ASCII.replace("1.5e0", "inf"), (5, 1));
    fault(&ASCII.replace("vertex 1.5e0 0 0", "vertex 1.5e0 0"), (5, 1));
    fault(&ASCII.replace("outer loop", "loop"), (3, 1));
    let second = ASCII.replace("endsolid two words", "") + &ASCII[16..];
    assert_eq!(parse(second.as_bytes()).map(|c| c.len()), Ok(2));
    let (head, tail) = second.rsplit_once("endloop").expect("there");
    fault(&format!("{head}{tail}"), (16, 2));
    // Cut off in the middle, and just before the end.
    let cut = &ASCII[..ASCII.find("endloop").expect("there")];
    fault(cut, (7, 1));
    fault(&ASCII[..ASCII.find("endsolid").expect("there")], (8, 2));
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = read(Path::new("nowhere.stl")).expect_err("no file");
    let text = error.to_string();
    assert!(text.starts_with("nowhere.stl: found "), "{text}");
    assert!(text.contains("accepted: an STL file"), "{text}");
}
