//! Scenes that begin from the end of another run: bodies by their identifiers, with all that their laws remember.

use std::path::Path;

use proctor_files::json::from_json;
use proctor_files::run::{Run, RunControl, RunError};
use proctor_scene::Scene;
use proctor_scene::simulation::{Options, Simulation};
use serde_json::{Value, json};

/// Ground of two layers that settles between sliding sides.
fn settling() -> Value {
    json!({
        "dimension": 2, "time": 0.6, "gravity": [0, -10], "damping": {"type": "local", "value": 0.7},
        "mesh": {"cells_dimension": [0.5, 0.5], "cells_number": [4, 12],
            "boundary_conditions": {"plane_Yn": "free"}},
        "material": [
            {"id": 0, "type": "drucker_prager", "young": 1e7, "poisson": 0.3, "density": 2000, "friction": 30, "cohesion": 1e4},
            {"id": 1, "type": "elastic", "young": 1e7, "poisson": 0.3, "density": 1500}
        ],
        "body": [
            {"type": "rectangle", "id": 7, "material_id": 0, "point_p1": [0, 0], "point_p2": [2, 2]},
            {"type": "rectangle", "id": 8, "material_id": 1, "point_p1": [0, 2], "point_p2": [2, 4]}
        ],
        "results": {"print": 1}
    })
}

/// The same scene without damping, from the state of the folder.
fn next(folder: &Path) -> Value {
    let mut scene = settling();
    scene["damping"] = json!({"type": "none"});
    scene["initial_state"] = json!({"file": folder});
    scene
}

fn parsed(scene: &Value) -> Result<Scene, String> {
    from_json(&scene.to_string(), "next.json", Path::new(".")).map_err(|error| error.to_string())
}

/// A run in a folder, to its end.
fn ran(scene: &Scene, folder: Option<&Path>, restart: Option<&Path>) -> Run {
    let mut run = Run::start(scene, &Options::default(), folder, restart).expect("a run");
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On).expect("all steps");
        run.write().expect("the files are written");
    }
    run
}

fn settled() -> (tempfile::TempDir, Run) {
    let folder = tempfile::tempdir().expect("a folder");
    let run = ran(
        &parsed(&settling()).expect("sound"),
        Some(folder.path()),
        None,
    );
    (folder, run)
}

fn began(scene: &Value) -> Result<Run, RunError> {
    let scene = parsed(scene).unwrap_or_else(|error| panic!("{error}"));
    Run::start(&scene, &Options::default(), None, None)
}

/// The particles of a body by identifier: position and stress.
fn particles(simulation: &Simulation, body: usize) -> Vec<([f64; 3], [f64; 6])> {
    let set = &simulation.sets()[body];
    let mut all: Vec<usize> = (0..set.len()).collect();
    all.sort_by_key(|p| set.id[*p]);
    all.iter()
        .map(|p| (simulation.position(body, *p), set.stress(*p)))
        .collect()
}

#[test]
fn bodies_begin_as_the_run_before_left_them() {
    let (folder, before) = settled();
    let run = began(&next(folder.path())).expect("a run");
    let (was, is) = (before.simulation(), run.simulation());
    assert!((is.time(), is.steps()) == (0.0, 0), "it begins anew");
    for body in 0..2 {
        assert_eq!(particles(was, body), particles(is, body), "body {body}");
        let variables = |s: &Simulation| s.sets()[body].layout.components().count();
        assert_eq!(variables(was), variables(is));
        let set = &is.sets()[body];
        let still =
            |p: usize| set.velocity(p) == [0.0; 3] && is.displacement(body, p) == Some([0.0; 3]);
        assert!((0..set.len()).all(still), "at rest, and nothing has moved");
    }
}

/// Bodies stay where they are in space on a mesh that begins elsewhere.
#[test]
fn a_mesh_that_begins_elsewhere_holds_bodies_at_their_places() {
    let (folder, before) = settled();
    let mut scene = next(folder.path());
    scene["mesh"]["origin"] = json!([-1.0, -1.5]);
    scene["mesh"]["cells_number"] = json!([8, 16]);
    let run = began(&scene).expect("a run");
    for body in 0..2 {
        let was = particles(before.simulation(), body);
        let is = particles(run.simulation(), body);
        assert_eq!(was.len(), is.len());
        for ((was, _), (is, _)) in was.iter().zip(&is) {
            // A place of 4 m is rounded to 9e-16 m, twice.
            let off = (0..2).map(|axis| (was[axis] - is[axis]).abs());
            assert!(off.fold(0.0, f64::max) < 4e-15, "{was:?}, {is:?}");
        }
    }
}

/// Settled ground stays where it is, on a base that has become absorbing as well.
#[test]
fn settled_ground_stays() {
    let (folder, _) = settled();
    for plane in ["sliding", "absorbing"] {
        let mut scene = next(folder.path());
        scene["mesh"]["boundary_conditions"]["plane_Y0"] = plane.into();
        let run = ran(&parsed(&scene).expect("sound"), None, None);
        let most = (0..2).map(|body| {
            let set = &run.simulation().sets()[body];
            (0..set.len())
                .map(|p| set.velocity(p)[1].abs())
                .fold(0.0_f64, f64::max)
        });
        // Free fall over the same time would give 6 m/s, and the weight let go at once some 0.5 m/s.
        let most = most.fold(0.0_f64, f64::max);
        assert!(most < 2e-3, "{plane}: {most} m/s");
    }
}

#[test]
fn velocities_are_kept_where_that_is_asked_for() {
    let mut first = settling();
    first["time"] = json!(0.05);
    let folder = tempfile::tempdir().expect("a folder");
    let before = ran(&parsed(&first).expect("sound"), Some(folder.path()), None);
    let mut scene = next(folder.path());
    scene["initial_state"]["velocity"] = "kept".into();
    let run = began(&scene).expect("a run");
    let momentum = [before.simulation().momentum(), run.simulation().momentum()];
    assert!(momentum[0][1] < -1.0, "{momentum:?}");
    assert!(
        (momentum[0][1] - momentum[1][1]).abs() < 1e-9 * momentum[0][1].abs(),
        "{momentum:?}"
    );
}

/// A structure that is built on settled ground, and a layer that is dug away.
#[test]
fn bodies_come_and_go() {
    let (folder, before) = settled();
    let mut scene = next(folder.path());
    let bodies = scene["body"].as_array_mut().expect("bodies");
    bodies.remove(1);
    bodies.push(json!(
        {"type": "rectangle", "id": 9, "material_id": 1, "point_p1": [0.5, 2], "point_p2": [1, 3]}
    ));
    let run = began(&scene).expect("a run");
    assert_eq!(
        particles(before.simulation(), 0),
        particles(run.simulation(), 0)
    );
    let new = &run.simulation().sets()[1];
    assert_eq!(new.len(), 8);
    assert!((0..8).all(|p| new.stress(p) == [0.0; 6]));
    let mut ids: Vec<u64> = run
        .simulation()
        .sets()
        .iter()
        .flat_map(|set| set.id.clone())
        .collect();
    ids.sort_unstable();
    let count = ids.len();
    ids.dedup();
    assert_eq!(ids.len(), count, "identifiers are unique");
}

/// A restart of the second run needs the first no more.
#[test]
fn a_restart_goes_on_with_the_second_run() {
    let (folder, _) = settled();
    let scene = parsed(&next(folder.path())).expect("sound");
    let whole = ran(&scene, None, None);
    let second = tempfile::tempdir().expect("a folder");
    let half = Scene {
        time: 0.3,
        ..scene.clone()
    };
    ran(&half, Some(second.path()), None);
    drop(folder);
    let checkpoint = second.path().join("checkpoint.bin");
    let rest = ran(&scene, None, Some(&checkpoint));
    assert_eq!(rest.simulation().steps(), whole.simulation().steps());
}

#[test]
fn states_that_do_not_fit_are_refused_by_name() {
    let (folder, _) = settled();
    let refused = |change: &dyn Fn(&mut Value), words: [&str; 2]| {
        let mut scene = next(folder.path());
        change(&mut scene);
        let error = match parsed(&scene) {
            Err(error) => error,
            Ok(scene) => {
                let run = Run::start(&scene, &Options::default(), None, None);
                let error = run.err().expect("refused");
                assert!(error.is_bad_input(), "{error}");
                error.to_string()
            }
        };
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    };
    refused(
        &|scene| scene["body"][1]["material_id"] = 0.into(),
        ["initial_state", "accepted: a state of the same law"],
    );
    refused(
        &|scene| {
            scene["mesh"]["cells_dimension"] = json!([0.25, 0.5]);
            scene["mesh"]["cells_number"] = json!([8, 12]);
        },
        ["cells", "accepted: cells of the same size"],
    );
    refused(
        &|scene| {
            scene["body"][0]["initial_stress"] = json!({"type": "isotropic", "value": -1});
        },
        ["initial_stress", "accepted: one of them"],
    );
    refused(
        &|scene| scene["mesh"]["origin"] = json!([0, 1]),
        ["outside the mesh", "y ="],
    );
    refused(
        &|scene| scene["initial_state"]["file"] = "nowhere".into(),
        ["initial_state.file", "no file"],
    );
    refused(
        &|scene| scene["initial_state"] = json!({"velocity": "kept"}),
        ["initial_state.file", "missing"],
    );
    let history = folder.path().join("history.csv");
    refused(
        &|scene| scene["initial_state"]["file"] = json!(history),
        ["history.csv", "checkpoint"],
    );
}
