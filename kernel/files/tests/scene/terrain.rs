//! Ground between surfaces: lines, rasters, tables and triangles, and each fault of them with its place.

use std::f64::consts::PI;

use proctor_files::json::from_json;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Scene, SceneError};
use tempfile::TempDir;

/// A folder with files.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a file");
    }
    folder
}

fn read(axes: usize, body: &str, files: &[(&str, &str)]) -> Result<Scene, SceneError> {
    let (cells, counts) = if axes == 2 {
        ("[0.5, 0.5]", "[20, 12]")
    } else {
        ("[1, 1, 1]", "[10, 10, 6]")
    };
    let text = format!(
        r#"{{"dimension": {axes}, "time": 1, "mesh": {{"cells_dimension": {cells}, "cells_number": {counts}}},
        "material": [{{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 2000}}],
        "body": [{{"id": 1, "material_id": 1, {body}}}]}}"#
    );
    from_json(&text, "ground.json", folder(files).path())
}

/// Volume of the particles of the first body.
fn volume(scene: &Scene) -> f64 {
    let simulation = Simulation::new(scene, &Options::default()).expect("a sound scene");
    simulation.sets()[0].columns[1].iter().sum()
}

fn refused(axes: usize, body: &str, files: &[(&str, &str)]) -> String {
    read(axes, body, files).expect_err("a fault").to_string()
}

/// Heights z(x, y) at the centres of an ESRI grid of `count` cells of `size` from (0, 0).
fn raster(count: usize, size: f64, z: impl Fn(f64, f64) -> f64) -> String {
    let mut text = format!(
        "ncols {count}\nnrows {count}\nxllcorner 0\nyllcorner 0\ncellsize {size}\nNODATA_value -9999\n"
    );
    for row in (0..count).rev() {
        let at = |i: usize| (i as f64 + 0.5) * size;
        let values: Vec<String> = (0..count).map(|i| z(at(i), at(row)).to_string()).collect();
        text += &(values.join(" ") + "\n");
    }
    text
}

#[test]
fn ground_below_a_line_has_the_area_of_its_trapezia() {
    let line = "[[0, 4], [3, 4], [7, 1], [10, 2]]";
    let exact = 12.0 + 10.0 + 4.5;
    let inline = read(
        2,
        &format!(r#""type": "between", "lower": 0, "upper": {line}"#),
        &[],
    );
    let file = [("top.csv", "x;y\n0;4\n3;4\n7;1\n10;2\n")];
    let from_file = read(
        2,
        r#""type": "between", "lower": 0, "upper": "top.csv""#,
        &file,
    );
    for scene in [inline.expect("a line"), from_file.expect("a file")] {
        assert!((volume(&scene) / exact - 1.0).abs() < 1e-13);
    }
    let part = format!(r#""type": "between", "lower": 0, "upper": {line}, "plan": [[3, 7]]"#);
    let part = read(2, &part, &[]).expect("a part");
    assert!((volume(&part) / 10.0 - 1.0).abs() < 1e-13);
}

/// A raster of a plane is that plane out to its edges; a curved one comes to its volume as the square of its cells.
#[test]
fn ground_below_a_raster_has_the_volume_of_its_surface() {
    let plane = raster(5, 2.0, |x, y| 2.0 + 0.2 * x - 0.1 * y);
    let body = r#""type": "between", "lower": 0, "upper": "top.asc""#;
    let scene = read(3, body, &[("top.asc", &plane)]).expect("a raster");
    assert!((volume(&scene) / 250.0 - 1.0).abs() < 1e-13);
    let exact = 300.0 + 100.0 * (2.0 / PI).powi(2);
    let error = |count: usize| {
        let size = 10.0 / count as f64;
        let z = |x: f64, y: f64| 3.0 + (PI * x / 10.0).sin() * (PI * y / 10.0).sin();
        let hill = raster(count, size, z);
        let scene = read(3, body, &[("top.asc", &hill)]).expect("a raster");
        (volume(&scene) / exact - 1.0).abs()
    };
    let [coarse, fine] = [error(10), error(20)];
    assert!(fine < 1e-3 && coarse / fine > 3.5, "{coarse} {fine}");
}

#[test]
fn a_table_of_points_may_come_in_any_order() {
    let points = "x, y, z\n10,0,4\n0,0,2\n0,10,2\n10,10,4\n5,0,3\n5,10,3\n";
    let body = r#""type": "between", "lower": 1, "upper": "top.csv""#;
    let scene = read(3, body, &[("top.csv", points)]).expect("a grid");
    assert!((volume(&scene) / 200.0 - 1.0).abs() < 1e-13);
}

/// A sheet over the whole mesh, in two triangles that face down.
const SHEET: &str = "solid s\nfacet normal 0 0 0\nouter loop\nvertex -1 -1 2\nvertex 11 11 2\nvertex 11 -1 2\nendloop\n\
endfacet\nfacet normal 0 0 0\nouter loop\nvertex -1 -1 2\nvertex -1 11 2\nvertex 11 11 2\nendloop\nendfacet\nendsolid s\n";

#[test]
fn an_open_sheet_of_triangles_bounds_ground_and_encloses_none() {
    let files = [("sheet.stl", SHEET)];
    let scene = read(
        3,
        r#""type": "between", "lower": 0, "upper": "sheet.stl""#,
        &files,
    );
    assert!((volume(&scene.expect("a sheet")) / 200.0 - 1.0).abs() < 1e-13);
    let text = refused(3, r#""type": "solid", "stl_mesh": "sheet.stl""#, &files);
    assert!(
        text.contains("4 open edges, the first at triangle"),
        "{text}"
    );
    assert!(text.contains("from ("), "{text}");
}

/// An octahedron of radius 3: volume 4/3 r³.
#[test]
fn a_closed_surface_is_filled() {
    let mut text = "solid o\n".to_owned();
    let at = |axis: usize, sign: f64| {
        let mut x = [5.0, 5.0, 3.0];
        x[axis] += 3.0 * sign;
        format!("vertex {} {} {}\n", x[0], x[1], x[2])
    };
    for (a, b, c) in (0..8).map(|k| (k & 1, k >> 1 & 1, k >> 2)) {
        let sign = |bit: usize| 2.0 * bit as f64 - 1.0;
        let mut corners = [at(0, sign(a)), at(1, sign(b)), at(2, sign(c))];
        if (a + b + c) % 2 == 0 {
            corners.swap(0, 1);
        }
        text += "facet normal 0 0 0\nouter loop\n";
        text += &corners.concat();
        text += "endloop\nendfacet\n";
    }
    text += "endsolid o\n";
    let scene = read(
        3,
        r#""type": "solid", "stl_mesh": "o.stl""#,
        &[("o.stl", &text)],
    );
    let scene = scene.expect("a solid");
    assert!((volume(&scene) / 36.0 - 1.0).abs() < 1e-13);
    let simulation = Simulation::new(&scene, &Options::default()).expect("a sound scene");
    let set = &simulation.sets()[0];
    for p in 0..set.len() {
        let x = set.position(p);
        let norm = (x[0] - 5.0).abs() + (x[1] - 5.0).abs() + (x[2] - 3.0).abs();
        assert!(norm < 3.0, "{x:?}");
    }
    // Sub-cells of 0.5 m: the number of centres inside times their volume, against the exact volume.
    assert!(
        (set.len() as f64 * 0.125 / 36.0 - 1.0).abs() < 0.1,
        "{}",
        set.len()
    );
}

/// A hole is one fault: neither a material nor a level of the surface is missing because of it.
#[test]
fn a_hole_above_layers_is_told_alone() {
    let hole = raster(10, 1.0, |_, _| 3.0).replacen("\n3 3", "\n-9999 3", 1);
    let text = r#"{"dimension": 3, "time": 1, "gravity": [0, 0, -10],
        "mesh": {"cells_dimension": [1, 1, 1], "cells_number": [10, 10, 6]},
        "material": [{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 2000}],
        "body": [{"id": 1, "type": "between", "lower": 0, "upper": "top.asc",
        "layers": [{"material_id": 1, "base": 1}, {"material_id": 1}],
        "initial_stress": {"type": "at_rest", "ratio": 0.5}}]}"#;
    let files = folder(&[("top.asc", &hole)]);
    let found = from_json(text, "ground.json", files.path());
    let text = found.expect_err("a fault").to_string();
    assert!(
        text.contains("body[0].upper: found top.asc: no height at"),
        "{text}"
    );
    assert_eq!(text.lines().count(), 1, "{text}");
}

#[test]
fn each_fault_is_told_with_its_place() {
    let body = r#""type": "between", "lower": 0, "upper": "top.asc""#;
    let mut hole = raster(10, 1.0, |_, _| 3.0);
    // The fourth row from the north, the seventh value.
    let line = hole.lines().nth(9).expect("a row").to_owned();
    hole = hole.replacen(
        &format!("{line}\n{line}\n{line}\n{line}\n"),
        &format!("{line}\n{line}\n{line}\n3 3 3 3 3 3 -9999 3 3 3\n"),
        1,
    );
    let text = refused(3, body, &[("top.asc", &hole)]);
    assert!(
        text.contains("top.asc: no height at x = 6") || text.contains("no height at x = 5"),
        "{text}"
    );
    let ring = "0 0 1\n5 0 1\n10 0 1\n0 5 1\n10 5 1\n0 10 1\n5 10 1\n10 10 1\n";
    let around = r#""type": "between", "lower": 0, "upper": "ring.csv""#;
    let text = refused(3, around, &[("ring.csv", ring)]);
    assert!(
        text.contains("none of its cells has four heights"),
        "{text}"
    );
    let small = raster(4, 2.0, |_, _| 3.0);
    let text = refused(3, body, &[("top.asc", &small)]);
    assert!(
        text.contains("it reaches over x from 0 to 8, y from 0 to 8"),
        "{text}"
    );
    assert!(
        text.contains("the plan of the body, x from 0 to 10, y from 0 to 10"),
        "{text}"
    );
    for (from, to, place) in [
        ("ncols 10", "ncols ten", "top.asc:1:1"),
        ("nrows 10", "nrows 11", "top.asc:16:1"),
        ("nrows 10", "nrows 9", "top.asc:16:1"),
        (
            "3 3 3 3 3 3 3 3 3 3\n",
            "3 3 x 3 3 3 3 3 3 3\n",
            "top.asc:7:5",
        ),
        ("cellsize 1\n", "", "top.asc:6:1"),
        ("cellsize 1", "cellwidth 1", "top.asc:5:1"),
    ] {
        let whole = raster(10, 1.0, |_, _| 3.0);
        assert!(whole.contains(from));
        let text = refused(3, body, &[("top.asc", &whole.replacen(from, to, 1))]);
        assert!(text.contains(place), "{to}: {text}");
    }
    let crossing = r#""type": "between", "lower": [[0, 1], [10, 3]], "upper": 2"#;
    let text = refused(2, crossing, &[]);
    assert!(
        text.contains("body[0].lower") && text.contains("3 m at x = 10, above `upper` with 2 m"),
        "{text}"
    );
    let back = r#""type": "between", "lower": 0, "upper": [[0, 1], [6, 2], [5, 2], [10, 1]]"#;
    let text = refused(2, back, &[]);
    assert!(
        text.contains("body[0].upper[2]") && text.contains("x = 5 after x = 6"),
        "{text}"
    );
    let short = r#""type": "between", "lower": 0, "upper": [[0, 1], [9, 2]]"#;
    let text = refused(2, short, &[]);
    assert!(text.contains("it reaches over x from 0 to 9"), "{text}");
    let high = r#""type": "between", "lower": 0, "upper": [[0, 1], [4, 7], [10, 1]]"#;
    let text = refused(2, high, &[]);
    assert!(text.contains("y = 7, outside the mesh, at x = 4"), "{text}");
    let scattered = "0 0 1\n1 2 1\n2 1 1\n3 5 1\n7 4 1\n9 9 1\n";
    let text = refused(3, body, &[("top.asc", scattered)]);
    assert!(
        text.contains("6 points with 6 different x and 6 different y"),
        "{text}"
    );
}
