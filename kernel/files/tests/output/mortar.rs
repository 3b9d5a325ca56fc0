//! Mortar contact in the files of a run: forces in the history, and a restart that keeps the bits.

use std::fs;
use std::path::Path;

use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_files::json::read;
use proctor_files::run::{Run, RunControl};
use proctor_scene::simulation::Options;

#[test]
fn a_restart_keeps_vertices_and_slip() {
    restart(
        "../../fixtures/scenes/rolling_disc_2d.json",
        1,
        FollowMode::Spin,
    );
    restart(
        "../../fixtures/scenes/rolling_disc_2d.json",
        1,
        FollowMode::Material,
    );
}

#[test]
fn a_restart_keeps_triangles_and_slip() {
    restart(
        "../../fixtures/scenes/rolling_ball_3d.json",
        2,
        FollowMode::Spin,
    );
    restart(
        "../../fixtures/scenes/rolling_ball_3d.json",
        2,
        FollowMode::Material,
    );
}

/// Runs a fixture at once and in two parts; `up` is the axis along which a body is carried.
fn restart(file: &str, up: usize, follow: FollowMode) {
    let mut scene = read(Path::new(file)).unwrap_or_else(|error| panic!("{error}"));
    scene.time = 0.12;
    scene.results.print = 3;
    for boundary in &mut scene.mortar.boundaries {
        boundary.follow = follow;
    }
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let [whole, cut] = [folders[0].path(), folders[1].path()];
    let go = |run: &mut Run, stops: usize| {
        for _ in 0..stops {
            let Some(stop) = run.next_stop() else { return };
            run.advance(stop, |_| RunControl::On)
                .expect("the steps are sound");
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
    // Frames of the boundaries go on as well, and are those of the run that was not cut.
    let list = fs::read_to_string(whole.join("boundaries.pvd")).unwrap();
    assert_eq!(list.matches("<DataSet ").count(), 4);
    assert_eq!(
        list,
        fs::read_to_string(cut.join("boundaries.pvd")).unwrap()
    );
    for k in 0..4 {
        let name = format!("boundaries_00000{k}.vtp");
        assert!(list.contains(&name));
        let [a, b] = [whole, cut].map(|folder| fs::read(folder.join(&name)).unwrap());
        assert_eq!(a, b, "{name}");
    }
    // It rests on the plane by then, and the force is in the history.
    assert!(a.mortar_force(1).unwrap()[up] > 0.0);
    let history = fs::read_to_string(whole.join("history.csv")).unwrap();
    assert!(history.lines().next().unwrap().contains("body1_contact_fy"));
    assert_eq!(
        history,
        fs::read_to_string(cut.join("history.csv")).unwrap()
    );
    // So is what its vertices drifted, which is nothing where they stay on their body.
    assert!(
        history
            .lines()
            .next()
            .unwrap()
            .ends_with(",boundary_drift,boundary_drift_in_cells")
    );
    let last = history.lines().last().unwrap();
    let [cells, distance] = {
        let mut ends = last.rsplit(',').map(|cell| cell.parse::<f64>().unwrap());
        [ends.next().unwrap(), ends.next().unwrap()]
    };
    let drift = run.summary().boundary_drift.expect("its body moves freely");
    assert_eq!(
        (drift.distance, drift.in_cells),
        (Some(distance), Some(cells))
    );
    assert_eq!(
        cells < 1e-12,
        follow == FollowMode::Material,
        "{follow:?} {cells}"
    );
}

/// The vertices of the file are those of the simulation, and forces on the two surfaces cancel.
#[test]
fn frames_of_boundaries_hold_contact() {
    let mut scene = read(Path::new("../../fixtures/scenes/rolling_disc_2d.json"))
        .unwrap_or_else(|error| panic!("{error}"));
    scene.time = 0.12;
    scene.results.print = 1;
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On)
            .expect("the steps are sound");
        run.write().expect("the files are written");
    }
    let file = fs::read(folder.path().join("boundaries_000001.vtp")).unwrap();
    let head = String::from_utf8_lossy(&file);
    // A disc of 63 segments and a plane of 4.
    assert!(head.contains("<VTKFile type=\"PolyData\""));
    assert!(head.contains("<Piece NumberOfPoints=\"68\" NumberOfVerts=\"0\" NumberOfLines=\"67\""));
    let arrays = super::frames::arrays(&file);
    let reals = |name: &str, components: usize| -> Vec<f64> {
        let (kind, found, bytes) = &arrays[name];
        assert_eq!((kind.as_str(), *found), ("Float64", components));
        let (words, _) = bytes.as_chunks::<8>();
        words.iter().map(|word| f64::from_le_bytes(*word)).collect()
    };
    let simulation = run.simulation();
    let vertices = simulation.mortar_vertices(1).unwrap();
    let pressure = reals("Contact Pressure", 1);
    let gap = reals("Contact Gap", 1);
    for (k, v) in vertices.iter().enumerate() {
        assert_eq!(pressure[k], v.pressure);
        assert!(gap[k] == v.gap || (gap[k].is_nan() && v.gap == f64::INFINITY));
    }
    assert!(pressure[vertices.len()..].iter().all(|p| *p == 0.0));
    let force = reals("Contact Force", 3);
    let (on_disc, on_plane) = force.split_at(3 * vertices.len());
    let sum = |of: &[f64]| of.iter().skip(1).step_by(3).sum::<f64>();
    assert!(sum(on_disc) > 0.0);
    assert!((sum(on_disc) + sum(on_plane)).abs() < 1e-12 * sum(on_disc));
    assert!((sum(on_disc) - simulation.mortar_force(1).unwrap()[1]).abs() < 1e-12 * sum(on_disc));
    let lines = &arrays["connectivity"].2;
    assert_eq!(lines.len(), 8 * 2 * 67);
    assert!(reals("Displacement", 3).iter().any(|u| *u != 0.0));
}
