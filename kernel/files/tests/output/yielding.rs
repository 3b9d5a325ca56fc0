//! The output of a scene with a body that yields, beside others: where the work of its strain went.

use std::fs;
use std::path::Path;

use proctor_files::json::from_json;
use proctor_files::output::Summary;
use proctor_files::output::summary::YieldingBody;
use proctor_files::run::{Run, RunControl};
use proctor_scene::simulation::Options;

/// A soft block that hits a plane and a hard one behind it; columns of the history, its last row and the summary.
fn ran(first: &str) -> (Vec<String>, Vec<f64>, Summary) {
    let text = format!(
        r#"{{"dimension": 2, "time": 0.05, "mesh": {{"cells_dimension": [0.1, 0.1], "cells_number": [8, 4],
        "boundary_conditions": {{"plane_X0": "sliding", "plane_Y0": "sliding", "plane_Yn": "sliding"}}}},
        "material": [{{"id": 0, "young": 1e5, "poisson": 0.3, "density": 1000, {first}}},
            {{"id": 1, "type": "elastic", "young": 1e5, "poisson": 0.3, "density": 1000}}],
        "body": [{{"type": "cuboid", "id": 7, "material_id": 0, "point_p1": [0, 0], "point_p2": [0.4, 0.4],
            "initial_velocity": [-1, 0]}},
            {{"type": "cuboid", "id": 3, "material_id": 1, "point_p1": [0.5, 0], "point_p2": [0.7, 0.4]}}],
        "results": {{"print": 2}}}}"#
    );
    let scene = from_json(&text, "hit.json", Path::new(".")).unwrap_or_else(|e| panic!("{e}"));
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On)
            .expect("the steps are sound");
        run.write().expect("the files are written");
    }
    let history = fs::read_to_string(folder.path().join("history.csv")).unwrap();
    let cells = |line: Option<&str>| -> Vec<String> {
        let cells = line.unwrap_or_default().split(',');
        cells.map(str::to_owned).collect()
    };
    let row = cells(history.lines().last());
    let row = row.iter().map(|x| x.parse().expect("a number")).collect();
    (cells(history.lines().next()), row, run.summary())
}

/// Each body that yields has its own columns, which are those of the summary; a body or a scene that does not has none.
#[test]
fn bodies_that_yield_have_channels_of_their_own() {
    let (names, row, summary) =
        ran(r#""type": "von_mises", "yield_stress": 500, "hardening": 2e4"#);
    let channels = ["stored", "plastic", "algorithmic"];
    let at = |channel: &str| {
        let name = format!("body7_energy_{channel}");
        row[names.iter().position(|n| *n == name).expect("a column")]
    };
    let [stored, plastic, algorithmic] = channels.map(|channel| Some(at(channel)));
    let own = YieldingBody {
        body: 7,
        stored,
        plastic,
        algorithmic,
    };
    assert_eq!(summary.yielding, [own]);
    assert_eq!(summary.energy.plastic, plastic);
    assert_eq!(summary.energy.algorithmic, algorithmic);
    assert!(
        plastic > Some(0.0) && algorithmic.is_some_and(|a| a != 0.0),
        "{own:?}"
    );
    assert!(!names.iter().any(|name| name.starts_with("body3_energy")));

    let (names, _, summary) = ran(r#""type": "elastic""#);
    assert!(
        names.iter().all(|name| channels
            .iter()
            .all(|c| !name.ends_with(&format!("energy_{c}")) || name == "energy_plastic")),
        "{names:?}"
    );
    assert_eq!(summary.yielding, []);
    assert_eq!(summary.energy.algorithmic, None);
}
