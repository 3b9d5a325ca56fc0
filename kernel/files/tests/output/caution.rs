//! Reasons for caution in the summary: told once of each kind, and not lost by a restart.

use std::path::Path;

use proctor_files::json::from_json;
use proctor_files::output::Summary;
use proctor_files::run::{Run, RunControl};
use proctor_scene::Scene;
use proctor_scene::simulation::Options;

/// A soft elastic block that is thrown at a plane and parts from it again.
fn thrown(time: f64) -> Scene {
    let text = format!(
        r#"{{"dimension": 2, "time": {time}, "stress_scheme_update": "MUSL",
        "mesh": {{"cells_dimension": [0.1, 0.1], "cells_number": [12, 4]}},
        "material": [{{"id": 0, "type": "elastic", "young": 1e5, "poisson": 0, "density": 1000}}],
        "body": [{{"type": "rectangle", "id": 7, "material_id": 0, "point_p1": [0.1, 0], "point_p2": [0.5, 0.4],
            "initial_velocity": [-4, 0]}}],
        "results": {{"print": 4}}}}"#
    );
    from_json(&text, "thrown.json", Path::new(".")).unwrap_or_else(|e| panic!("{e}"))
}

fn ran(time: f64, folder: &Path, restart: Option<&Path>) -> Summary {
    let mut run = Run::start(&thrown(time), &Options::default(), Some(folder), restart).unwrap();
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On)
            .expect("the steps are sound");
        run.write().expect("the files are written");
    }
    run.summary()
}

#[test]
fn large_strain_is_in_the_summary_and_outlives_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let kinds = |summary: &Summary| -> Vec<String> {
        summary
            .warnings
            .iter()
            .map(|warning| warning.kind.clone())
            .collect()
    };
    let first = ran(0.1, folder.path(), None);
    assert!(
        kinds(&first).contains(&"strain".to_owned()),
        "{:?}",
        first.warnings
    );
    // Goes on from the end, long after the block was squeezed.
    let checkpoint = folder.path().join("checkpoint.bin");
    let later = ran(0.12, folder.path(), Some(&checkpoint));
    let message = |summary: &Summary| {
        let strain = summary
            .warnings
            .iter()
            .find(|warning| warning.kind == "strain");
        strain.map(|warning| warning.message.clone())
    };
    assert_eq!(message(&later), message(&first));
    let free = tempfile::tempdir().unwrap();
    assert_eq!(ran(0.002, free.path(), None).warnings, []);
}
