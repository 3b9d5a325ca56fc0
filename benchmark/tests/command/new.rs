//! `proctor new`: scenes to start from that run as they are.

use crate::command::support::{Desk, code, command, stderr, stdout};
use std::fs;
use std::process::Output;

/// The command in the folder of the desk.
fn here(desk: &Desk, arguments: &[&str]) -> Output {
    command(arguments)
        .current_dir(desk.path(""))
        .output()
        .expect("the command starts")
}

/// The history of a run.
struct History {
    text: String,
}

impl History {
    /// History in a folder of the desk.
    fn read(desk: &Desk, folder: &str) -> Self {
        let text = fs::read_to_string(desk.path(folder).join("history.csv")).expect("a history");
        Self { text }
    }

    /// A column by its name, a value per row.
    fn column(&self, name: &str) -> Vec<f64> {
        let mut lines = self.text.lines();
        let at = (lines.next().expect("a head").split(','))
            .position(|column| column == name)
            .unwrap_or_else(|| panic!("no column {name}"));
        lines
            .map(|line| {
                let cell = line.split(',').nth(at).expect("a cell");
                cell.parse().expect("a number")
            })
            .collect()
    }
}

/// The kinds that the command lists.
fn kinds() -> Vec<String> {
    let output = here(&Desk::new(), &["new"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    let lines = text.lines().filter(|line| line.starts_with("  "));
    lines
        .map(|line| line.split_whitespace().next().expect("a name").to_owned())
        .collect()
}

#[test]
fn the_kinds_are_listed_with_what_happens_in_each() {
    let output = here(&Desk::new(), &["new"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    insta::assert_snapshot!(stdout(&output));
}

#[test]
#[ignore = "takes 7 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn each_is_written_planned_and_run_without_a_warning() {
    let kinds = kinds();
    assert!(kinds.len() >= 5, "{kinds:?}");
    for kind in kinds {
        let desk = Desk::new();
        let output = here(&desk, &["new", &kind]);
        assert_eq!(code(&output), 0, "{kind}: {}", stderr(&output));
        let file = format!("{kind}.json");
        assert!(desk.path(&file).is_file());
        // What is said to be next is what is done here.
        let said = stdout(&output);
        let plan = format!("proctor plan {file}");
        let run = format!("proctor run {file} --out {kind}");
        assert!(said.contains(&plan) && said.contains(&run), "{said}");
        let output = here(&desk, &["plan", &file]);
        assert_eq!(code(&output), 0, "{kind}: {}", stderr(&output));
        assert_eq!(stderr(&output), "", "{kind}");
        let output = here(&desk, &["run", &file, "--out", &kind]);
        assert_eq!(code(&output), 0, "{kind}: {}", stderr(&output));
        // A busy machine is told, and is no fault of the scene.
        let said_aside = stderr(&output);
        let mut warnings = said_aside
            .lines()
            .filter(|line| !line.contains("the machine was busy"));
        assert_eq!(warnings.next(), None, "{kind}");
        for doubt in ["attention", "event"] {
            let text = stdout(&output);
            let mut lines = text
                .lines()
                .filter(|line| !line.contains("the machine was busy"));
            let doubtful = lines.any(|line| line.starts_with(doubt));
            assert!(!doubtful, "{kind}: {text}");
        }
        // Seconds on any machine, however busy it is: a step of a particle takes a microsecond or less.
        let opened = said.split("then open ").nth(1).expect("a list of frames");
        let folder = opened.split("/particles.pvd").next().expect("its folder");
        let summary = desk.summary(folder);
        let steps = summary["steps"].as_f64().expect("steps");
        let work = steps * summary["particles"].as_f64().expect("particles");
        assert!(work < 3e6, "{kind}: {work} particle steps");
        let frames = desk.path(folder).join("particles.pvd");
        assert!(frames.is_file(), "{kind}");
        // The field that is said to show most is in the frames.
        let field = said
            .split("coloured by ")
            .nth(1)
            .and_then(|rest| rest.lines().next())
            .expect("a field");
        let frame = fs::read(desk.path(folder).join("particles_000001.vtu")).expect("a frame");
        let named = format!("Name=\"{field}\"");
        assert!(
            frame.windows(named.len()).any(|at| at == named.as_bytes()),
            "{kind}: {field}"
        );
    }
}

/// Comments of a scene say what comes out; they are not to say more than it does.
#[test]
fn what_the_comments_promise_happens() {
    let desk = Desk::new();
    for kind in [
        "column",
        "incline",
        "drop",
        "soil",
        "earthquake",
        "dam-slope",
    ] {
        assert_eq!(code(&here(&desk, &["new", kind])), 0);
        let output = here(&desk, &["run", &format!("{kind}.json"), "--out", kind]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    let column = |kind: &str, name: &str| History::read(&desk, kind).column(name);
    let sunk = -column("column", "top_uy").last().expect("a row");
    assert!((sunk - 0.029).abs() < 0.001, "{sunk}");
    let slid = column("incline", "body2_x");
    let slid = slid.last().expect("a row") - slid[0];
    assert!((slid - 0.25).abs() < 0.02, "{slid}");
    let speed = column("drop", "body1_vz");
    let fastest = |of: fn(f64, f64) -> f64| speed.iter().copied().fold(0.0, of);
    assert!(
        fastest(f64::min) < -1.6 && fastest(f64::max) > 1.4,
        "{speed:?}"
    );
    let most = |kind: &str, name: &str| {
        let all = column(kind, name);
        all.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let goes = |name: &str| most("soil", name);
    assert!(
        goes("crest_ux") > 1.2 * goes("base_ux"),
        "{}",
        goes("base_ux")
    );
    let fastest = |name: &str| most("earthquake/2-shake", name);
    assert!(
        fastest("crest_vx") > 1.2 * fastest("front_vx"),
        "{} {}",
        fastest("crest_vx"),
        fastest("front_vx")
    );
    // The reservoir begins to sink after a second, six frames of thirty.
    let face = column("dam-slope", "face_ux");
    let stood = face[..=6].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(stood < 0.02, "{stood}");
    assert!(*face.last().expect("a row") > 1.0, "{face:?}");
    let last = *column("earthquake/2-shake", "base_vx")
        .last()
        .expect("a row");
    assert!(last.abs() < 0.02, "{last}");
}

/// The starter is a scene to refine: on smaller cells the block slides as far, and no energy comes from nowhere. With FLIP and
/// MUSL it would gain 1.5 % of the work on these cells, and slide 4.6 % farther on a quarter of them.
#[test]
fn the_block_on_an_incline_slides_as_far_on_smaller_cells() {
    let desk = Desk::new();
    assert_eq!(code(&here(&desk, &["new", "incline"])), 0);
    let text = fs::read_to_string(desk.path("incline.json")).expect("a scene");
    let mut slid = vec![];
    for finer in [1.0, 4.0] {
        let mut scene: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        scene["mesh"]["cells_dimension"] = [0.1 / finer; 2].into();
        scene["mesh"]["cells_number"] = [24.0 * finer, 8.0 * finer].into();
        fs::write(desk.path("finer.json"), scene.to_string()).expect("the folder can be written");
        let out = format!("out{finer}");
        let output = here(&desk, &["run", "finer.json", "--out", &out]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let history = History::read(&desk, &out);
        let way = history.column("body2_x");
        slid.push(way.last().expect("a row") - way[0]);
        let last = |name: &str| *history.column(name).last().expect("a row");
        let gained = -last("energy_remainder") / last("energy_external_work");
        assert!(gained < 0.005, "{finer}: {gained}");
    }
    assert!((slid[1] / slid[0] - 1.0).abs() < 0.005, "{slid:?}");
}

#[test]
fn each_is_formatted() {
    for kind in kinds() {
        let desk = Desk::new();
        assert_eq!(code(&here(&desk, &["new", &kind])), 0);
        let text = fs::read_to_string(desk.path(&format!("{kind}.json"))).expect("a scene");
        assert!(text.ends_with("}\n") && !text.contains('\t'), "{kind}");
        let mut depth = 0_usize;
        for line in text.lines() {
            let blanks = line.len() - line.trim_start().len();
            let count = |these: [char; 2]| line.matches(these).count();
            let (opened, closed) = (count(['{', '[']), count(['}', ']']));
            let first_closes = line.trim_start().starts_with(['}', ']']);
            assert_eq!(
                blanks,
                2 * (depth - usize::from(first_closes)),
                "{kind}: {line}"
            );
            assert!(
                line.len() <= 110 && line == line.trim_end(),
                "{kind}: {line}"
            );
            depth = depth + opened - closed;
        }
        assert!(
            text.contains("\"comment\""),
            "{kind} says nothing of itself"
        );
    }
}

#[test]
fn no_file_is_overwritten() {
    let desk = Desk::new();
    fs::write(desk.path("column.json"), "mine").expect("written");
    let output = here(&desk, &["new", "column"]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(
        said.contains("column.json: found a file") && said.contains("--out"),
        "{said}"
    );
    assert_eq!(
        fs::read_to_string(desk.path("column.json")).expect("read"),
        "mine"
    );
    assert_eq!(stdout(&output), "");
    let output = here(&desk, &["new", "column", "--out", "mine.json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("proctor run mine.json --out mine"));
    // Where the record is taken, the scene is not written either.
    fs::write(desk.path("soil.csv"), "mine").expect("written");
    assert_eq!(code(&here(&desk, &["new", "soil"])), 2);
    assert!(!desk.path("soil.json").exists());
    assert_eq!(
        code(&here(&desk, &["new", "beam", "--out", "no/such/beam.json"])),
        2
    );
}

#[test]
fn an_unknown_kind_is_answered_with_the_nearest_and_all() {
    let output = here(&Desk::new(), &["new", "colum"]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    let nearest = said.find("did you mean `column`?").expect("the nearest");
    let list = said.find("accepted: ").expect("all");
    assert!(nearest < list && said.contains("incline"), "{said}");
}
