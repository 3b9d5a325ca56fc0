//! The output of a scene with contact: forces in the history, grid frames, checkpoints that keep the bits.

use std::fs;
use std::path::Path;

use proctor_files::json::read;
use proctor_files::run::{Run, RunControl};
use proctor_scene::simulation::Options;
use proctor_scene::{Scene, StressScheme};

fn scene(scheme: StressScheme) -> Scene {
    let mut scene = read(Path::new("../../fixtures/scenes/sliding_block_2d.json"))
        .unwrap_or_else(|error| panic!("{error}"));
    scene.scheme = scheme;
    scene.time = 0.04;
    scene.results.print = 4;
    scene
}

fn options(threads: usize) -> Options {
    Options {
        threads: Some(threads),
        least_share: Some(1),
        ..Options::default()
    }
}

/// Runs to the end, or to the output number `stops`.
fn go(run: &mut Run, stops: usize) {
    for _ in 0..stops {
        let Some(stop) = run.next_stop() else { return };
        run.advance(stop, |_| RunControl::On)
            .expect("the steps are sound");
        run.write().expect("the files are written");
    }
}

#[test]
fn a_restart_keeps_every_bit() {
    for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
        let scene = scene(scheme);
        let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let [whole, cut] = [folders[0].path(), folders[1].path()];
        let mut run = Run::start(&scene, &options(1), Some(whole), None).unwrap();
        go(&mut run, usize::MAX);
        let mut half = Run::start(&scene, &options(2), Some(cut), None).unwrap();
        go(&mut half, 2);
        drop(half);
        let checkpoint = cut.join("checkpoint.bin");
        let mut rest = Run::start(&scene, &options(1), Some(cut), Some(&checkpoint)).unwrap();
        go(&mut rest, usize::MAX);
        assert_eq!(
            run.simulation().state_hash(),
            rest.simulation().state_hash(),
            "{scheme:?}"
        );
        for file in [
            "history.csv",
            "grid.pvd",
            "grid_000003.vtu",
            "particles_000004.vtu",
        ] {
            let of = |folder: &Path| fs::read(folder.join(file)).unwrap();
            assert!(of(whole) == of(cut), "{scheme:?}: {file} differs");
        }
    }
}

#[test]
fn the_history_has_the_force_on_each_body_and_the_nodes_add_up_to_it() {
    let scene = scene(StressScheme::Musl);
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &options(1), Some(folder.path()), None).unwrap();
    go(&mut run, usize::MAX);
    let text = fs::read_to_string(folder.path().join("history.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let last: Vec<f64> = lines
        .next_back()
        .unwrap()
        .split(',')
        .map(|x| x.parse().unwrap())
        .collect();
    let value = |name: &str| {
        last[names
            .iter()
            .position(|n| *n == name)
            .unwrap_or_else(|| panic!("no {name}"))]
    };
    for axis in ["x", "y"] {
        let (base, block) = (
            value(&format!("body1_contact_f{axis}")),
            value(&format!("body2_contact_f{axis}")),
        );
        assert_eq!(base, -block);
    }
    assert!(value("body2_contact_fy") > 0.0);
    let nodes = run.simulation().node_values();
    for (set, id) in [(0, 1), (1, 2)] {
        let force = run.simulation().contact_force(set);
        let of_nodes = nodes
            .iter()
            .filter(|n| n.body == Some(id))
            .fold([0.0; 3], |sum: [f64; 3], n| {
                std::array::from_fn(|axis| sum[axis] + n.contact_force[axis])
            });
        for axis in 0..2 {
            assert!((force[axis] - of_nodes[axis]).abs() < 1e-9 * force[1].abs());
        }
        assert!(
            nodes
                .iter()
                .any(|n| n.body == Some(id) && n.contact_gap <= 0.0)
        );
    }
    // One frame per output but the first, when no step was done yet.
    let frames = (0..5).filter(|n| folder.path().join(format!("grid_{n:06}.vtu")).exists());
    assert_eq!(frames.count(), 4);
}
