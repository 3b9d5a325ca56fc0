//! The adapter of MPM-Geomechanics, with a program in its place that moves bodies as theory says.

use crate::command::guests::{errors, precision};
use crate::command::support::{Desk, fixture};
use serde_json::{Value, json};
use std::fs;
use std::process::Command;

/// A program that reads what the adapter writes and leaves frames as MPM-Geomechanics does: labels of the step before,
/// ASCII, and nothing of the mesh but that it begins at 0. Bodies fall freely, slide on the surface with Coulomb's
/// friction, or rest at a fixed upper plane.
const PROGRAM: &str = r#"
import json, os, sys
scene = json.load(open(sys.argv[1]))
assert scene["mesh"]["origin"] == [0, 0, 0] and scene.get("shape_function", "GIMP") == "GIMP"
assert scene["n_threads"] == 1 and "fields" not in scene["results"] and "contact" not in scene
h, dt = scene["mesh"]["cells_dimension"][0], scene["time_step"]
top = h * scene["mesh"]["cells_number"][1]
held = scene["mesh"]["boundary_conditions"].get("plane_Yn") == "fixed"
steps = int(scene["time"] / dt)
g, surface = list(scene["gravity"]), scene.get("terrain_contact")
if surface:
    assert surface["active"] and open(surface["stl_mesh"]).read().startswith("solid")
    g = [g[0] - surface["friction"] * abs(g[1]), 0, 0]
os.makedirs("particles", exist_ok=True)
names = []
def write(number, taken):
    t, at, moved = taken * dt, [], []
    for body in scene["body"]:
        low, high, v = body["point_p1"], body["point_p2"], body["initial_velocity"]
        n = [round((b - a) / h * 2) for a, b in zip(low, high)]
        rests = held and abs(high[1] - top) < 1e-9
        u = [0 if rests else v[a] * t + 0.5 * g[a] * t * t for a in range(3)]
        for i in range(n[0]):
            for j in range(n[1]):
                for k in range(n[2]):
                    at.append([low[a] + (x + 0.5) * h / 2 + u[a] for a, x in enumerate((i, j, k))])
                    moved.append(u)
    rows = lambda values: "\n".join("%.9e %.9e %.9e" % tuple(row) for row in values)
    array = '<DataArray type="Float64"%s NumberOfComponents="3" Format="ascii">\n%s\n</DataArray>\n'
    name = "particles_%d.vtu" % number
    open("particles/" + name, "w").write(
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
        + '<Piece NumberOfPoints="%d" NumberOfCells="0">\n<Points>\n' % len(at) + array % ("", rows(at))
        + "</Points>\n<PointData>\n" + array % (' Name="Displacement"', rows(moved))
        + "</PointData>\n<Cells></Cells></Piece></UnstructuredGrid></VTKFile>")
    names.append('<DataSet timestep="%.15g" file="%s"/>' % (max(taken - 1, 0) * dt, name))
write(1, 0)
for taken in range(1, steps + 1):
    if taken % (steps // scene["results"]["print"]) == 0:
        write(len(names) + 1, taken)
open("particles/particleTimeSerie.pvd", "w").write(
    '<VTKFile type="Collection" version="0.1"><Collection>' + "".join(names) + "</Collection></VTKFile>")
"#;

/// The program as a file that can be started; none where there is no Python.
fn program(desk: &Desk) -> Option<String> {
    use std::os::unix::fs::PermissionsExt;
    let python = Command::new("python3").arg("--version").output();
    if !python.is_ok_and(|output| output.status.success()) {
        println!("left out: no python3");
        return None;
    }
    let text = format!("#!/usr/bin/env python3{PROGRAM}");
    fs::write(desk.path("program"), text).expect("written");
    let mode = fs::Permissions::from_mode(0o755);
    fs::set_permissions(desk.path("program"), mode).expect("executable");
    Some(desk.name("program"))
}

fn adapter() -> String {
    fixture("fixtures/guests/geomechanics_mpm.py")
}

/// One body on a held one becomes a body on triangles, and the frames have the particles of both.
#[test]
#[ignore = "takes 8 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn a_block_on_a_held_base_slides_on_a_surface() {
    let desk = Desk::new();
    let Some(program) = program(&desk) else {
        return;
    };
    let script = format!("MPM_GEOMECHANICS={program} exec python3 $0 $1 $2 $3");
    let command = json!([
        "sh",
        "-c",
        script,
        adapter(),
        "{scene}",
        "{out}",
        "{threads}"
    ]);
    let guests = json!({ "geo": { "command": command, "time_label": "one step late" } });
    let (exit, text, record) = precision(&desk, "inclined-block", &guests);
    assert_eq!(exit, 0, "{text}");
    let found = errors(&record, "inclined-block", "geo", "displacement");
    assert_eq!(found.len(), 2, "{text}");
    // The digits of its frames.
    assert!(found.iter().all(|error| *error < 1e-6), "{found:?}");
}

/// The adapter on a scene in a folder: exit code, what it said, and what it handed on.
fn handed(desk: &Desk, scene: &Value, program: Option<&str>) -> (i32, String, Option<Value>) {
    let file = desk.scene("scene.json", scene);
    let out = desk.path("out");
    let _ = fs::remove_dir_all(&out);
    fs::create_dir_all(&out).expect("a folder");
    let mut command = Command::new("python3");
    command.args([adapter(), file, desk.name("out"), "1".to_owned()]);
    match program {
        Some(program) => command.env("MPM_GEOMECHANICS", program),
        None => command.env_remove("MPM_GEOMECHANICS"),
    };
    let output = command.output().expect("python runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let text = fs::read_to_string(out.join("geomechanics.json")).ok();
    let handed = text.map(|text| serde_json::from_str(&text).expect("JSON"));
    (output.status.code().expect("an end"), said, handed)
}

fn falling() -> Value {
    json!({
        "dimension": 3, "time": 0.04, "time_step": 0.001, "gravity": [0.0, 0.0, -10.0],
        "shape_function": "GIMP", "stress_scheme_update": "USL", "results": { "print": 1 },
        "mesh": { "cells_dimension": [0.1, 0.1, 0.1], "cells_number": [9, 9, 9], "origin": [0.5, -1.0, 2.0],
                  "boundary_conditions": { "plane_Y0": "sliding" } },
        "material": [{ "type": "elastic", "id": 1, "young": 1e4, "poisson": 0.25, "density": 1000.0 }],
        "body": [{ "type": "cuboid", "id": 1, "material_id": 1, "point_p1": [0.8, -0.7, 2.3],
                   "point_p2": [1.1, -0.4, 2.6], "initial_velocity": [1.0, 0.0, 0.0] }],
    })
}

#[test]
fn a_mesh_that_begins_elsewhere_is_moved_and_the_frames_are_moved_back() {
    let desk = Desk::new();
    let Some(program) = program(&desk) else {
        return;
    };
    let mut shaken = falling();
    shaken["earthquake"] = json!({ "active": true, "file": "base.csv", "header": true });
    fs::write(desk.path("base.csv"), "t,ax,ay,az\n0,0,0,1\n").expect("written");
    let (exit, said, handed) = handed(&desk, &shaken, Some(&program));
    assert_eq!(exit, 0, "{said}");
    let handed = handed.expect("a scene");
    let corner = handed["body"][0]["point_p1"][0].as_f64().expect("a number");
    assert!((corner - 0.3).abs() < 1e-12, "{handed}");
    let frame = desk.path("out/particles/particles_2.vtu");
    let frame = proctor_benchmark::frames::read(&frame).expect("a frame");
    assert_eq!(frame.points.len(), 216);
    let lowest = frame
        .points
        .iter()
        .map(|x| x[0])
        .fold(f64::INFINITY, f64::min);
    assert!((lowest - (0.825 + 0.04)).abs() < 1e-6, "{lowest}");
    // A base moves on where its record ends, and takes the scheme in which it moves as it is to.
    assert_eq!(handed["stress_scheme_update"], "MUSL");
    let record = fs::read_to_string(desk.path("out/base.csv")).expect("a record");
    assert_eq!(record, "t,ax,ay,az\n0,0,0,1\n0.08,0,0,0\n");
}

#[test]
fn what_the_program_lacks_is_skipped_with_its_reason() {
    let desk = Desk::new();
    let Some(program) = program(&desk) else {
        return;
    };
    let with = |change: &dyn Fn(&mut Value)| {
        let mut scene = falling();
        change(&mut scene);
        scene
    };
    for (scene, words) in [
        (
            with(&|s| s["material"][0]["type"] = json!("neo_hookean")),
            "neo_hookean: ",
        ),
        (
            with(&|s| s["body"][0]["point_p2"][0] = json!(1.05)),
            "bodies of whole cells alone",
        ),
        (with(&|s| s["dimension"] = json!(2)), "dimension 2: "),
        (
            with(&|s| s["shape_function"] = json!("cpGIMP")),
            "shape_function cpGIMP: ",
        ),
        (with(&|s| s["tractions"] = json!([1])), "tractions: "),
        (
            with(&|s| {
                s["nodal_point_load"] = json!([[[1, 0, 0], [1, 0, 0]], [[1, 0, 1], [1, 0, 0]]]);
            }),
            "several nodal loads",
        ),
        (
            with(&|s| s["contact"] = json!([{ "master_id": 1, "slave_id": 1, "friction": 0 }])),
            "contact: ",
        ),
    ] {
        let (exit, said, _) = handed(&desk, &scene, Some(&program));
        assert_eq!(exit, 77, "{words}: {said}");
        assert!(
            said.starts_with("error: ") && said.contains(words),
            "{said}"
        );
    }
    let (exit, said, _) = handed(&desk, &falling(), None);
    if exit != 0 {
        assert_eq!(exit, 77, "{said}");
        assert!(said.contains("MPM_GEOMECHANICS"), "{said}");
    }
}
