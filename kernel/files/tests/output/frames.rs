//! Frames: XML whose offsets point at what it says, and a list with true times.

use std::collections::HashMap;
use std::fs;
use std::io::Read;

use proctor_files::output::pvd::LIST;
use proctor_files::output::{
    Array, ArrayData, Compression, Frame, OutputError, OutputFolder, Series, vtu,
};

use super::names;

/// A value with all bits of the mantissa in use.
fn odd(i: usize) -> f64 {
    (i as f64 + 0.1).sqrt()
}

fn frame(n: usize) -> Frame {
    Frame {
        time: 0.1 + 0.2,
        step: 42,
        points: (0..n).map(|i| [odd(i), odd(i + 1), -odd(i)]).collect(),
        arrays: vec![
            Array::new(
                "Particle Id",
                ArrayData::Integer((0..n as i64).map(|i| i - 1).collect()),
            ),
            Array::new(
                "a<b> & \"c\" 'd' µ",
                ArrayData::Scalar((0..n).map(odd).collect()),
            ),
            Array::new(
                "Velocity",
                ArrayData::Vector((0..n).map(|i| [0.0, odd(i), f64::NAN]).collect()),
            ),
        ],
        lines: vec![],
    }
}

fn written(frame: &Frame, compression: Compression) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.vtu");
    vtu::write(&path, frame, compression).unwrap();
    fs::read(&path).unwrap()
}

/// A reader that knows only what the VTK file format says: name to (type, components, bytes).
pub(super) fn arrays(file: &[u8]) -> HashMap<String, (String, usize, Vec<u8>)> {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = file
        .windows(marker.len())
        .position(|window| window == marker)
        .unwrap();
    let head = std::str::from_utf8(&file[..start]).unwrap();
    let data = &file[start + marker.len()..];
    assert!(data.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
    check_tags(head);
    let compressed = head.contains("compressor=\"vtkZLibDataCompressor\"");
    let mut end = 0;
    let mut arrays = HashMap::new();
    for line in head
        .lines()
        .filter(|line| line.contains("format=\"appended\""))
    {
        let attribute = |name: &str| {
            let (_, rest) = line.split_once(&format!(" {name}=\"")).unwrap();
            rest.split_once('"').unwrap().0.to_owned()
        };
        let offset: usize = attribute("offset").parse().unwrap();
        assert_eq!(
            offset, end,
            "arrays follow each other without a gap: {line}"
        );
        let (bytes, size) = if compressed {
            inflate(&data[offset..])
        } else {
            plain(&data[offset..])
        };
        end = offset + size;
        let components = attribute("NumberOfComponents").parse().unwrap();
        let earlier = arrays.insert(attribute("Name"), (attribute("type"), components, bytes));
        assert!(earlier.is_none());
    }
    assert_eq!(&data[end..], b"\n</AppendedData>\n</VTKFile>\n");
    arrays
}

/// Every tag is closed by its own name.
fn check_tags(head: &str) {
    let mut open = Vec::new();
    for tag in head.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').unwrap();
        let name = tag.split_whitespace().next().unwrap();
        if let Some(closed) = name.strip_prefix('/') {
            assert_eq!(open.pop(), Some(closed));
        } else if !tag.ends_with('/') && !tag.starts_with('?') {
            open.push(name);
        }
    }
    assert_eq!(
        open,
        ["VTKFile"],
        "only the file itself is open where the appended data start"
    );
}

fn word(bytes: &[u8], index: usize) -> usize {
    u64::from_le_bytes(bytes[8 * index..8 * (index + 1)].try_into().unwrap()) as usize
}

fn plain(data: &[u8]) -> (Vec<u8>, usize) {
    let size = word(data, 0);
    (data[8..8 + size].to_vec(), 8 + size)
}

fn inflate(data: &[u8]) -> (Vec<u8>, usize) {
    let [blocks, size, last] = [0, 1, 2].map(|index| word(data, index));
    let mut at = 8 * (3 + blocks);
    let mut bytes = Vec::new();
    for block in 0..blocks {
        let next = at + word(data, 3 + block);
        let before = bytes.len();
        flate2::read::ZlibDecoder::new(&data[at..next])
            .read_to_end(&mut bytes)
            .unwrap();
        let expected = if block + 1 == blocks && last > 0 {
            last
        } else {
            size
        };
        assert_eq!(bytes.len() - before, expected);
        at = next;
    }
    (bytes, at)
}

fn bytes_of(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(f64::to_le_bytes).collect()
}

/// Lines have two points each: what a reader finds between two offsets.
#[test]
fn lines_end_after_two_points_each() {
    let lines = [[0, 1], [1, 2], [2, 0]];
    let frame = Frame {
        lines: lines.to_vec(),
        ..frame(3)
    };
    let arrays = arrays(&written(&frame, Compression::None));
    let words = |name: &str| -> Vec<usize> {
        let (_, components, bytes) = &arrays[name];
        assert_eq!(*components, 1);
        (0..bytes.len() / 8).map(|i| word(bytes, i)).collect()
    };
    let points = words("connectivity");
    let mut begin = 0;
    let mut found = vec![];
    for end in words("offsets") {
        found.push(points[begin..end].to_vec());
        begin = end;
    }
    assert_eq!(
        found,
        lines.map(|line| line.map(|point| point as usize).to_vec())
    );
    assert_eq!(begin, points.len());
}

#[test]
fn offsets_and_bytes_are_as_declared() {
    // 0; a few; more than one block of a compressed array (1 MiB); a number of bytes that fills its blocks.
    for n in [0, 3, 50_000, 1 << 17] {
        let frame = frame(n);
        for compression in [
            Compression::None,
            Compression::Zlib(1),
            Compression::Zlib(99),
        ] {
            let file = written(&frame, compression);
            let found = arrays(&file);
            let check = |name: &str, kind: &str, components: usize, bytes: Vec<u8>| {
                assert!(
                    found[name] == (kind.to_owned(), components, bytes),
                    "{name}, {n} points, {compression:?}"
                );
            };
            check(
                "Points",
                "Float64",
                3,
                bytes_of(frame.points.iter().copied().flatten()),
            );
            check(
                "Particle Id",
                "Int64",
                1,
                (0..n as i64).flat_map(|i| (i - 1).to_le_bytes()).collect(),
            );
            check(
                "a&lt;b&gt; &amp; &quot;c&quot; &apos;d&apos; µ",
                "Float64",
                1,
                bytes_of((0..n).map(odd)),
            );
            check(
                "Velocity",
                "Float64",
                3,
                bytes_of((0..n).flat_map(|i| [0.0, odd(i), f64::NAN])),
            );
            check(
                "connectivity",
                "Int64",
                1,
                (0..n as i64).flat_map(i64::to_le_bytes).collect(),
            );
            check(
                "offsets",
                "Int64",
                1,
                (1..=n as i64).flat_map(i64::to_le_bytes).collect(),
            );
            check("types", "UInt8", 1, vec![1; n]);
            assert_eq!(found.len(), 7);
            let head = String::from_utf8_lossy(&file[..600]).into_owned();
            assert!(
                head.contains(&format!("NumberOfPoints=\"{n}\" NumberOfCells=\"{n}\"")),
                "{head}"
            );
            assert!(head.contains(
                "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.30000000000000004<"
            ));
            assert!(head.contains("Name=\"Step\" NumberOfTuples=\"1\" format=\"ascii\">42<"));
        }
    }
}

#[test]
fn a_frame_that_does_not_fit_together_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.vtu");
    let refused = |change: &dyn Fn(&mut Frame)| {
        let mut frame = frame(3);
        change(&mut frame);
        vtu::write(&path, &frame, Compression::None).unwrap_err()
    };
    let short = refused(&|frame| frame.arrays[1].data = ArrayData::Scalar(vec![1.0]));
    assert!(
        matches!(
            short,
            OutputError::Length {
                expected: 3,
                found: 1,
                ..
            }
        ),
        "{short:?}"
    );
    for name in ["", "Particle Id", "a\0b", "a\nb"] {
        let error = refused(&|frame| frame.arrays[1].name = name.to_owned());
        assert!(
            matches!(error, OutputError::Name { .. }),
            "{name:?}: {error:?}"
        );
    }
    let time = refused(&|frame| frame.time = f64::NAN);
    assert!(matches!(time, OutputError::Time { .. }), "{time:?}");
    assert_eq!(names(folder.path()), [""; 0]);
}

fn at(time: f64) -> Frame {
    Frame { time, ..frame(2) }
}

fn listed(series: &Series) -> Vec<(&str, f64)> {
    series
        .entries()
        .iter()
        .map(|entry| (entry.file.as_str(), entry.time))
        .collect()
}

#[test]
fn the_list_grows_with_the_frames_and_drops_later_ones_on_restart() {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::create(parent.path()).unwrap();
    let mut series = Series::create(folder.clone(), Compression::None).unwrap();
    for time in [0.0, 0.1, 0.1 + 0.2, 1e-9 + 0.5] {
        series.write_frame(&at(time)).unwrap();
    }
    for time in [0.5, 0.1, f64::NAN] {
        assert!(matches!(
            series.write_frame(&at(time)),
            Err(OutputError::Time { .. })
        ));
    }
    let list = fs::read_to_string(folder.file(LIST)).unwrap();
    assert!(list.contains(
        "<DataSet timestep=\"0.30000000000000004\" part=\"0\" file=\"particles_000002.vtu\"/>"
    ));
    assert_eq!(names(folder.path()).len(), 5);
    drop(series);

    // The restart time is that of a state, bit by bit: its own frame stays.
    let mut series = Series::resume(folder.clone(), Compression::None, 0.1 + 0.2).unwrap();
    assert_eq!(series.last_time(), Some(0.1 + 0.2));
    assert_eq!(series.entries().len(), 3);
    series.write_frame(&at(0.4)).unwrap();
    let again = Series::resume(folder, Compression::None, 9.0).unwrap();
    assert_eq!(listed(&again), listed(&series));
    assert_eq!(listed(&again)[3], ("particles_000003.vtu", 0.4));
}

#[test]
fn a_frame_that_fails_is_not_listed() {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::create(parent.path()).unwrap();
    let mut series = Series::create(folder.clone(), Compression::None).unwrap();
    series.write_frame(&at(0.0)).unwrap();
    let list = fs::read(folder.file(LIST)).unwrap();
    let mut broken = at(1.0);
    broken.points.pop();
    series.write_frame(&broken).unwrap_err();
    assert_eq!(fs::read(folder.file(LIST)).unwrap(), list);
    assert_eq!(names(folder.path()), [LIST, "particles_000000.vtu"]);
    series.write_frame(&at(1.0)).unwrap();
    assert_eq!(listed(&series)[1], ("particles_000001.vtu", 1.0));
}

#[test]
fn a_list_that_is_none_is_refused() {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::create(parent.path()).unwrap();
    let entry = |time: &str| format!("<DataSet timestep=\"{time}\" part=\"0\" file=\"p.vtu\"/>\n");
    let list = |entries: &str| format!("<VTKFile type=\"Collection\">\n{entries}</VTKFile>\n");
    for (text, line) in [
        ("nonsense".to_owned(), 1),
        (list(&entry("abc")), 2),
        (list(&entry("NaN")), 2),
        (list(&(entry("1.0") + &entry("1.0"))), 3),
        (list("<DataSet timestep=\"1.0\"/>\n"), 2),
    ] {
        fs::write(folder.file(LIST), &text).unwrap();
        let error = Series::resume(folder.clone(), Compression::None, 9.0).unwrap_err();
        assert!(
            matches!(error, OutputError::Malformed { line: found, .. } if found == line),
            "{text}: {error:?}"
        );
        assert_eq!(fs::read_to_string(folder.file(LIST)).unwrap(), text);
    }
}

#[test]
fn a_line_to_a_point_that_is_not_there_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.vtp");
    for lines in [vec![[0, 2]], vec![[0, 1], [-1, 0]]] {
        let wrong = Frame { lines, ..frame(2) };
        let error = vtu::write(&path, &wrong, Compression::None).unwrap_err();
        assert!(error.to_string().contains("no such point"), "{error}");
        assert!(!path.exists());
    }
}
