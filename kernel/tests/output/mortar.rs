//! Mortar contact in the files of a run: forces in the history, and a restart that keeps the bits.

use std::fs;
use std::path::Path;

use proctor_kernel::run::{Go, Run};
use proctor_kernel::scene::read;
use proctor_kernel::simulation::Options;

#[test]
fn a_restart_keeps_vertices_and_slip() {
    restart("../fixtures/scenes/rolling_disc_2d.json", 1);
}

#[test]
fn a_restart_keeps_triangles_and_slip() {
    restart("../fixtures/scenes/rolling_ball_3d.json", 2);
}

/// Runs a fixture at once and in two parts; `up` is the axis along which a body is carried.
fn restart(file: &str, up: usize) {
    let mut scene = read(Path::new(file)).unwrap_or_else(|error| panic!("{error}"));
    scene.time = 0.12;
    scene.results.print = 3;
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let [whole, cut] = [folders[0].path(), folders[1].path()];
    let go = |run: &mut Run, stops: usize| {
        for _ in 0..stops {
            let Some(stop) = run.next_stop() else { return };
            run.advance(stop, |_| Go::On).expect("the steps are sound");
            run.write().expect("the files are written");
        }
    };
    let mut run = Run::start(&scene, &options, Some(whole), None).unwrap();
    go(&mut run, usize::MAX);
    let mut half = Run::start(&scene, &options, Some(cut), None).unwrap();
    go(&mut half, 2);
    drop(half);
    let checkpoint = cut.join("checkpoint.bin");
    let mut rest = Run::start(&scene, &options, Some(cut), Some(&checkpoint)).unwrap();
    go(&mut rest, usize::MAX);
    let [a, b] = [run.simulation(), rest.simulation()];
    assert_eq!(a.state_hash(), b.state_hash());
    assert_eq!(a.boundary_vertices(1), b.boundary_vertices(1));
    assert_eq!(a.mortar_vertices(1), b.mortar_vertices(1));
    // It rests on the plane by then, and the force is in the history.
    assert!(a.mortar_force(1).unwrap()[up] > 0.0);
    let history = fs::read_to_string(whole.join("history.csv")).unwrap();
    assert!(history.lines().next().unwrap().contains("body1_contact_fy"));
    assert_eq!(
        history,
        fs::read_to_string(cut.join("history.csv")).unwrap()
    );
}
