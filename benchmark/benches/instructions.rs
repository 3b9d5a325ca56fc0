//! Instructions per particle and step, counted by valgrind: the same number on every run, whatever else the machine
//! does.
//!
//! `cargo bench --bench instructions [-- [--features] [--only WORD] [--json FILE]]`. The example `counted` of proctor-files is built
//! for x86-64-v3 and run under callgrind (which runs the AVX2 lanes). Then features that do nothing are counted against the
//! same scene without them: they may cost 0.1 % and must change no bit. `--features` does only that, `--only laws` counts
//! nothing but what has the word in its name.
//!
//! Exit code 0 fine, 1 if a count does not repeat or a feature costs something, and 0 with the words "left out" where
//! valgrind is not installed.

use proctor_benchmark::bench::scenes;
use proctor_benchmark::record::{Record, Row};
use proctor_benchmark::show::{Table, grouped};
use proctor_kernel::simulation::{Options, Part};
use serde_json::{Value, json};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Largest relative difference between two counts of the same, and cost of a feature that does nothing.
const TOLERANCE: f64 = 1e-3;
/// Has the C library fill and copy memory with vector instructions. By itself it takes one string instruction for what is
/// large, of which valgrind counts every byte, so that a count would tell which of the two the compiler called.
const NO_STRING_INSTRUCTIONS: (&str, &str) = (
    "GLIBC_TUNABLES",
    "glibc.cpu.x86_rep_stosb_threshold=1000000000:glibc.cpu.x86_rep_movsb_threshold=1000000000",
);
/// Particles of a scene: enough that a step is the work on particles.
const PARTICLES: usize = 8000;
/// Steps, or plays of a part, that are counted.
const TIMES: usize = 12;
/// How scenes begin whose rows are those of laws.
const SLABS: &str = "slabs-";

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(1)
        }
    }
}

fn run() -> Result<bool, Box<dyn Error>> {
    let mut only_features = false;
    let (mut json, mut only) = (None, None);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--features" => only_features = true,
            "--only" => only = Some(arguments.next().ok_or("--only wants a word")?),
            "--json" => {
                json = Some(PathBuf::from(
                    arguments.next().ok_or("--json wants a file")?,
                ));
            }
            // Cargo says so to every bench target.
            "--bench" => {}
            other => {
                return Err(format!(
                    "unknown argument {other}; accepted: --features, --only WORD, --json FILE"
                )
                .into());
            }
        }
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("left out: valgrind is not installed");
        return Ok(true);
    }
    let counter = Counter {
        binary: build()?,
        folder: tempfile::tempdir()?,
    };
    let mut record = Record::new(&Options::default());
    record.context["counted_for"] = "x86-64-v3".into();
    // Whatever this machine has: valgrind runs no wider ones.
    record.context["lanes"] = "avx2".into();
    let mut sound = true;
    if !only_features {
        sound &= counts(&counter, only.as_deref().unwrap_or(""), &mut record)?;
    }
    if only.is_none() {
        sound &= features(&counter, &mut record)?;
    }
    if let Some(path) = json {
        record.write(&path)?;
        println!("record in {}", path.display());
    }
    Ok(sound)
}

/// The example, built for x86-64-v3 in a folder of its own.
fn build() -> Result<PathBuf, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let target = target.join("x86-64-v3");
    let built = Command::new(env!("CARGO"))
        .args([
            "build",
            "--release",
            "--quiet",
            "--package",
            "proctor-files",
            "--example",
            "counted",
        ])
        .arg("--target-dir")
        .arg(&target)
        .env("RUSTFLAGS", "-C target-cpu=x86-64-v3")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .current_dir(&root)
        .status()?;
    if !built.success() {
        return Err("the example `counted` could not be built".into());
    }
    Ok(target.join("release/examples/counted"))
}

/// Counts instructions of a binary.
struct Counter {
    binary: PathBuf,
    folder: tempfile::TempDir,
}

/// What a run said.
struct Count {
    instructions: u64,
    particles: u64,
    hash: String,
}

impl Count {
    fn per_particle(&self, times: usize) -> f64 {
        self.instructions as f64 / (self.particles as f64 * times as f64)
    }
}

impl Counter {
    fn count(&self, scene: &Value, what: &str, times: usize) -> Result<Count, Box<dyn Error>> {
        let file = self.folder.path().join("scene.json");
        std::fs::write(&file, scene.to_string())?;
        let output = Command::new("valgrind")
            .args([
                "--tool=callgrind",
                "--callgrind-out-file=/dev/null",
                "--toggle-collect=*played*",
            ])
            .arg(&self.binary)
            .arg(&file)
            .args([what, &times.to_string()])
            .env(NO_STRING_INSTRUCTIONS.0, NO_STRING_INSTRUCTIONS.1)
            .output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            return Err(format!("{what}: {said}").into());
        }
        let collected = said.lines().find_map(|line| line.split_once("Collected :"));
        let instructions: u64 = collected
            .and_then(|(_, number)| number.split_whitespace().next()?.parse().ok())
            .filter(|&n| n > 0)
            .ok_or("valgrind counted nothing")?;
        let words = String::from_utf8_lossy(&output.stdout).into_owned();
        let (particles, hash) = words
            .trim()
            .split_once(' ')
            .ok_or("the example said nothing")?;
        Ok(Count {
            instructions,
            particles: particles.parse()?,
            hash: hash.to_owned(),
        })
    }
}

/// Scenes with whole steps, methods and single parts.
fn counts(counter: &Counter, word: &str, record: &mut Record) -> Result<bool, Box<dyn Error>> {
    let make = |name: &str| -> Result<Value, Box<dyn Error>> {
        let (scene, axes) = scenes::find(name).ok_or("no such scene")?;
        let mut scene = scene.make(axes, PARTICLES).scene;
        scene["results"] = json!({ "print": 0 });
        Ok(scene)
    };
    let mut items: Vec<(String, Value, &str)> = vec![];
    for name in scenes::names().filter(|name| !name.starts_with(SLABS)) {
        items.push((format!("{name}/step"), make(&name)?, "step"));
    }
    let moving = make("moving-3d")?;
    for (weighting, scheme, transfer) in [
        ("linear", "USL", "FLIP"),
        ("cpGIMP", "USL", "FLIP"),
        ("quadratic_bspline", "USL", "FLIP"),
        ("uGIMP", "MUSL", "FLIP"),
        ("uGIMP", "USF", "FLIP"),
        ("uGIMP", "USL", "APIC"),
        ("uGIMP", "USL", "TPIC"),
    ] {
        let mut scene = moving.clone();
        scene["shape_function"] = weighting.into();
        scene["stress_scheme_update"] = scheme.into();
        scene["transfer"] = transfer.into();
        items.push((
            format!("moving-3d/{weighting}/{scheme}/{transfer}/step"),
            scene,
            "step",
        ));
    }
    for part in Part::ALL {
        items.push((
            format!("moving-3d/{}", part.name()),
            moving.clone(),
            part.name(),
        ));
    }
    for name in scenes::names() {
        // Such as slabs-von_mises-below-3d: laws of one elasticity.
        if let Some((law, axes)) = name
            .strip_prefix(SLABS)
            .and_then(|name| name.rsplit_once('-'))
        {
            let law = law.replace('-', "/");
            items.push((format!("laws-{axes}/{law}/step"), make(&name)?, "step"));
        }
    }
    items.retain(|(name, ..)| name.contains(word));
    println!("instructions per particle and step, AVX2 lanes\n");
    let mut table = Table::new(["what", "particles", "instructions", "again"]);
    let mut sound = true;
    for (i, (name, scene, what)) in items.iter().enumerate() {
        let count = counter.count(scene, what, TIMES)?;
        let each = count.per_particle(TIMES);
        let mut line = vec![name.clone(), grouped(count.particles), format!("{each:.1}")];
        // That the counts repeat is seen on the first; all of them twice would only take longer.
        if i == 0 {
            let again = counter.count(scene, what, TIMES)?.per_particle(TIMES);
            let repeats = (again - each).abs() <= TOLERANCE * each;
            line.push(format!(
                "{again:.1}{}",
                if repeats { "" } else { " DIFFERS" }
            ));
            sound &= repeats;
        }
        table.push(line);
        let mut row = Row::sample(format!("instructions/{name}"), 0, 1);
        row.count("instructions", each);
        row.count("particles", count.particles as f64);
        record.push(row);
    }
    println!("{table}");
    Ok(sound)
}

/// Features that do nothing, against the scene without them.
fn features(counter: &Counter, record: &mut Record) -> Result<bool, Box<dyn Error>> {
    let plain = plain();
    let with = |key: &str, value: Value| {
        let mut scene = plain.clone();
        scene[key] = value;
        scene
    };
    let mut far_plane = plain.clone();
    far_plane["mesh"]["boundary_conditions"]["plane_Xn"] = "sliding".into();
    let mut second = plain["material"][0].clone();
    second["id"] = 2.into();
    let mut two_bodies = plain.clone();
    let mut far = plain["body"][0].clone();
    for (key, value) in [
        ("id", json!(2)),
        ("point_p1", json!([1.7, 1.7, 1.7])),
        ("point_p2", json!([1.8, 1.8, 1.8])),
        ("initial_velocity", json!([0, 0, 0])),
    ] {
        far[key] = value;
    }
    two_bodies["body"] = json!([plain["body"][0], far]);
    let mut contact = two_bodies.clone();
    contact["contact"] = json!([{ "id": 1, "friction": 0.3, "master_id": 1, "slave_id": 2 }]);
    let groups = [
        (
            ("none", plain.clone()),
            vec![
                (
                    "local-damping",
                    with("damping", json!({ "type": "local", "value": 0 })),
                ),
                (
                    "viscous-damping",
                    with("damping", json!({ "type": "viscous", "value": 0 })),
                ),
                (
                    "second-material",
                    with("material", json!([plain["material"][0], second])),
                ),
                ("far-plane", far_plane),
                (
                    "zero-load",
                    with("nodal_point_load", json!([[[0.7, 0.7, 0.7], [0, 0, 0]]])),
                ),
            ],
        ),
        (("far-body", two_bodies), vec![("far-contact", contact)]),
    ];
    println!("features that do nothing: instructions per particle and step\n");
    let mut table = Table::new(["feature", "instructions", "more", "verdict"]);
    let mut sound = true;
    for ((base_name, base_scene), features) in groups {
        let base = counter.count(&base_scene, "step", TIMES)?;
        let base_each = base.per_particle(TIMES);
        table.push([base_name.to_owned(), format!("{base_each:.2}")]);
        for (name, scene) in features {
            let count = counter.count(&scene, "step", TIMES)?;
            let each = count.per_particle(TIMES);
            let more = each / base_each - 1.0;
            let verdict = if count.hash != base.hash {
                "CHANGES THE RESULT"
            } else if more > TOLERANCE {
                "COSTS MORE THAN 0.1 %"
            } else {
                "ok"
            };
            sound &= verdict == "ok";
            table.push([
                name.to_owned(),
                format!("{each:.2}"),
                format!("{:+.4} %", 100.0 * more),
                verdict.to_owned(),
            ]);
            let mut row = Row::sample(format!("instructions/feature/{name}"), 0, 1);
            row.count("instructions", each);
            record.push(row);
        }
    }
    println!("{table}");
    Ok(sound)
}

/// A block that flies and falls clear of all planes, which are free.
fn plain() -> Value {
    let planes =
        ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"].map(|p| (format!("plane_{p}"), json!("free")));
    json!({
        "dimension": 3,
        "time": 1.0,
        "gravity": [0, 0, -10],
        "results": { "print": 0 },
        "mesh": {
            "cells_dimension": [0.1, 0.1, 0.1],
            "cells_number": [18, 18, 18],
            "boundary_conditions": planes.into_iter().collect::<serde_json::Map<_, _>>(),
        },
        "material": [{ "type": "elastic", "id": 1, "young": 1e6, "density": 1000, "poisson": 0.3 }],
        "body": [{
            "type": "cuboid", "id": 1, "material_id": 1,
            "point_p1": [0.2, 0.2, 0.2], "point_p2": [1.2, 1.2, 1.2],
            "initial_velocity": [1, 0.5, 0],
        }],
    })
}
