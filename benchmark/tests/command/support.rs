//! The command as a user starts it, in a folder of its own.

use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// The command with arguments, not yet started.
pub fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_proctor"));
    command.args(arguments);
    command
}

/// The command, run to its end.
pub fn proctor(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the command starts")
}

/// Exit code.
pub fn code(output: &Output) -> i32 {
    output.status.code().expect("not killed")
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A file of the repository.
pub fn fixture(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    root.join(path).display().to_string()
}

/// A folder for scenes and results.
pub struct Desk {
    folder: TempDir,
}

impl Desk {
    pub fn new() -> Self {
        Self {
            folder: TempDir::new().expect("a folder"),
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The same as an argument.
    pub fn name(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }

    /// Writes a scene and returns it as an argument.
    pub fn scene(&self, name: &str, scene: &Value) -> String {
        std::fs::write(self.path(name), format!("{scene:#}")).expect("a scene is written");
        self.name(name)
    }

    /// Runs a scene into the folder `out`.
    pub fn run(&self, scene: &str, out: &str, more: &[&str]) -> Output {
        let out = self.name(out);
        let mut arguments = vec!["run", scene, "--out", &out];
        arguments.extend(more);
        proctor(&arguments)
    }

    /// The summary of a run.
    pub fn summary(&self, out: &str) -> Value {
        let text = std::fs::read_to_string(self.path(out).join("summary.json")).expect("a summary");
        serde_json::from_str(&text).expect("JSON")
    }
}

/// A small block that flies through its mesh: nothing touches it until it leaves at x = 2.
pub fn flying_block() -> Value {
    json!({
        "dimension": 2,
        "time": 0.4,
        "time_step": 0.002,
        "results": { "print": 8 },
        "mesh": {
            "cells_dimension": [0.1, 0.1],
            "cells_number": [20, 10],
            "boundary_conditions": { "plane_Xn": "free" }
        },
        "material": [{ "type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3 }],
        "body": [{
            "type": "rectangle", "id": 1, "material_id": 1,
            "point_p1": [0.3, 0.3], "point_p2": [0.7, 0.6],
            "initial_velocity": [1.0, 0.0]
        }]
    })
}

/// The same, fast enough to leave the mesh after about 0.26 s.
pub fn leaving_block() -> Value {
    let mut scene = flying_block();
    scene["time_step"] = json!(0.001);
    scene["body"][0]["initial_velocity"] = json!([5.0, 0.0]);
    scene
}

/// A column that is set swinging by its weight: every particle feels every step.
pub fn column(method: &Value) -> Value {
    let mut scene = json!({
        "dimension": 3,
        "time": 0.4,
        "gravity": [1.0, 0.0, -9.81],
        "results": { "print": 4, "fields": ["id", "displacement", "stress"] },
        "mesh": {
            "cells_dimension": [0.1, 0.1, 0.1],
            "cells_number": [12, 5, 8],
            "boundary_conditions": { "plane_Z0": "fixed" }
        },
        "material": [{ "type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3 }],
        "body": [{
            "type": "cuboid", "id": 1, "material_id": 1,
            "point_p1": [0.3, 0.1, 0.0], "point_p2": [0.7, 0.4, 0.5]
        }]
    });
    for (key, value) in method.as_object().expect("an object") {
        scene[key] = value.clone();
    }
    scene
}

/// Methods that keep different state: both ends of what a checkpoint must hold.
pub fn methods() -> [Value; 2] {
    [
        json!({ "transfer": "FLIP", "stress_scheme_update": "USF" }),
        json!({
            "transfer": "APIC", "stress_scheme_update": "MUSL", "shape_function": "cpGIMP",
            "material": [{
                "type": "neo_hookean", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3
            }]
        }),
    ]
}
