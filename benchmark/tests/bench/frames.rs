//! Frames as different programs write them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::write::ZlibEncoder;
use proctor_benchmark::frames::{last, parse, read};
use std::io::Write;

const POINTS: [f64; 6] = [0.5, 1.25, -2.0, 3.0, 1e-3, 7.5];
const IDS: [i32; 2] = [7, -9];

fn file(attributes: &str, points: &str, ids: &str, behind: &[u8]) -> Vec<u8> {
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<!-- a comment -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" {attributes}>\n\
         <UnstructuredGrid><FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
         format=\"ascii\"> 0.25 </DataArray></FieldData>\n<Piece NumberOfPoints=\"2\" NumberOfCells=\"0\">\n\
         <PointData>{ids}</PointData>\n<Points>{points}</Points>\n\
         <Cells><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">1 1</DataArray></Cells>\n\
         </Piece></UnstructuredGrid>\n"
    )
    .into_bytes();
    text.extend(behind);
    text.extend(b"</VTKFile>\n");
    text
}

fn array(kind: &str, name: &str, components: usize, rest: &str) -> String {
    format!("<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" {rest}")
}

fn check(bytes: &[u8]) {
    let frame = parse(bytes).unwrap_or_else(|error| panic!("{error}"));
    let flat: Vec<f64> = frame.points.iter().flatten().copied().collect();
    assert_eq!(flat, POINTS);
    assert_eq!(frame.arrays["a < b"], (1, IDS.map(f64::from).to_vec()));
    assert_eq!(frame.time, Some(0.25));
}

fn little(points: &[f64]) -> Vec<u8> {
    points.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn id_bytes() -> Vec<u8> {
    IDS.iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn ascii() {
    let points = array(
        "Float64",
        "Points",
        3,
        "format=\"ascii\">\n0.5 1.25 -2\n 3 1e-3 7.5\n</DataArray>",
    );
    let ids = array("Int32", "a &lt; b", 1, "format=\"ascii\">7 -9</DataArray>");
    check(&file("", &points, &ids, b""));
}

#[test]
fn inline_base64_with_header_and_data_in_one_stream_and_in_two() {
    for together in [true, false] {
        let encode = |data: Vec<u8>| {
            let header = (data.len() as u32).to_le_bytes().to_vec();
            if together {
                STANDARD.encode([header, data].concat())
            } else {
                STANDARD.encode(header) + &STANDARD.encode(data)
            }
        };
        let points = format!(
            "format=\"binary\">\n{}\n</DataArray>",
            encode(little(&POINTS))
        );
        let ids = format!("format=\"binary\">{}</DataArray>", encode(id_bytes()));
        check(&file(
            "byte_order=\"LittleEndian\"",
            &array("Float64", "Points", 3, &points),
            &array("Int32", "a &lt; b", 1, &ids),
            b"",
        ));
    }
}

#[test]
fn big_endian() {
    let data: Vec<u8> = POINTS.iter().flat_map(|x| x.to_be_bytes()).collect();
    let text = STANDARD.encode([(data.len() as u64).to_be_bytes().to_vec(), data].concat());
    let points = format!("format=\"binary\">{text}</DataArray>");
    let ids = array("Int32", "a &lt; b", 1, "format=\"ascii\">7 -9</DataArray>");
    let head = "byte_order=\"BigEndian\" header_type=\"UInt64\"";
    check(&file(
        head,
        &array("Float64", "Points", 3, &points),
        &ids,
        b"",
    ));
}

fn appended(raw: bool, long: bool, compressed: bool) -> Vec<u8> {
    let number = |n: usize| {
        if long {
            (n as u64).to_le_bytes().to_vec()
        } else {
            (n as u32).to_le_bytes().to_vec()
        }
    };
    let encode = |data: Vec<u8>| {
        let (header, body) = if compressed {
            // Blocks of 16 bytes, the last of which may be short.
            let blocks: Vec<Vec<u8>> = data
                .chunks(16)
                .map(|chunk| {
                    let mut encoder = ZlibEncoder::new(vec![], flate2::Compression::default());
                    encoder.write_all(chunk).expect("in memory");
                    encoder.finish().expect("in memory")
                })
                .collect();
            let mut header = [number(blocks.len()), number(16), number(data.len() % 16)].concat();
            header.extend(blocks.iter().flat_map(|block| number(block.len())));
            (header, blocks.concat())
        } else {
            (number(data.len()), data)
        };
        match (raw, compressed) {
            (true, _) => [header, body].concat(),
            (false, true) => (STANDARD.encode(header) + &STANDARD.encode(body)).into_bytes(),
            (false, false) => STANDARD.encode([header, body].concat()).into_bytes(),
        }
    };
    let (ids, points) = (encode(id_bytes()), encode(little(&POINTS)));
    let mut behind = format!(
        "<AppendedData encoding=\"{}\">\n _",
        if raw { "raw" } else { "base64" }
    )
    .into_bytes();
    behind.extend(&ids);
    behind.extend(&points);
    behind.extend(b"\n</AppendedData>\n");
    let head = format!(
        "byte_order=\"LittleEndian\" header_type=\"{}\"{}",
        if long { "UInt64" } else { "UInt32" },
        if compressed {
            " compressor=\"vtkZLibDataCompressor\""
        } else {
            ""
        }
    );
    let at = |offset: usize| format!("format=\"appended\" offset=\"{offset}\"/>");
    file(
        &head,
        &array("Float64", "Points", 3, &at(ids.len())),
        &array("Int32", "a &lt; b", 1, &at(0)),
        &behind,
    )
}

#[test]
fn appended_raw_and_base64_short_and_long_headers_compressed_or_not() {
    for raw in [true, false] {
        for long in [true, false] {
            for compressed in [true, false] {
                check(&appended(raw, long, compressed));
            }
        }
    }
}

#[test]
fn what_cannot_be_read_is_said() {
    let sound = appended(true, true, false);
    let cut = &sound[..sound.len() - 60];
    for (bytes, word) in [
        (&b"no XML at all"[..], "VTKFile"),
        (&b"<VTKFile type=\"PolyData\">"[..], "PolyData"),
        (
            &b"<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\">"[..],
            "vtkLZ4DataCompressor",
        ),
        (cut, "cut short"),
    ] {
        let error = parse(bytes).expect_err("not a frame");
        assert!(error.contains(word), "{error}");
    }
    let short = file(
        "",
        &array(
            "Float64",
            "Points",
            3,
            "format=\"ascii\">0 0 0 1 1 1</DataArray>",
        ),
        &array("Int32", "Id", 1, "format=\"ascii\">1 2 3</DataArray>"),
        b"",
    );
    assert!(
        parse(&short)
            .expect_err("three values for two points")
            .contains("Id")
    );
}

#[test]
fn the_last_frame_is_that_of_the_series_or_of_the_largest_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    for name in ["p_2.vtu", "p_10.vtu", "p_9.vtu"] {
        std::fs::write(path(name), "").expect("written");
    }
    assert_eq!(last(folder.path()), Some((path("p_10.vtu"), None)));
    let series = "<VTKFile type=\"Collection\"><Collection>\
                  <DataSet timestep=\"0.5\" file=\"p_9.vtu\"/><DataSet timestep=\"0.1\" file=\"p_2.vtu\"/>\
                  </Collection></VTKFile>";
    std::fs::write(path("p.pvd"), series).expect("written");
    assert_eq!(last(folder.path()), Some((path("p_9.vtu"), Some(0.5))));
    assert!(read(&path("none.vtu")).is_err());
}
