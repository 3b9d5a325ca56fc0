//! Changes of a restart: the run goes on under other planes and other loads.

use std::path::Path;

use proctor_files::json::read;
use proctor_files::run::{Run, RunControl, RunError};
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{BoxLoad, Damping, PlaneCondition, Scene, TimeStep, Weighting};

/// Mass of the column \[kg\].
const MASS: f64 = 4000.0;

/// A column that swings under its weight. Linear functions reach no node beyond a plane, where a load is mirrored and a weight is not.
fn column(gravity: [f64; 3], time: f64) -> Scene {
    let path = Path::new("../../fixtures/scenes/column_gravity_2d.json");
    let mut scene = read(path).unwrap_or_else(|error| panic!("{error}"));
    scene.damping = Damping::None;
    scene.weighting = Weighting::Linear;
    scene.time_step = TimeStep::Fixed {
        dt: 5e-4,
        allow_unstable: true,
    };
    scene.results.print = 1;
    scene.gravity = gravity;
    scene.time = time;
    scene
}

/// Runs to the end, in a folder and from a checkpoint where they are given.
fn run(scene: &Scene, folder: Option<&Path>, from: Option<&Path>) -> Run {
    let from = from.map(|folder| folder.join("checkpoint.bin"));
    let mut run = Run::start(scene, &Options::default(), folder, from.as_deref())
        .unwrap_or_else(|error| panic!("{error}"));
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On)
            .expect("the steps are sound");
        run.write().expect("the files are written");
    }
    run
}

/// Positions and velocities of the particles in the order of their identifiers.
fn motion(simulation: &Simulation) -> Vec<[f64; 3]> {
    let set = &simulation.sets()[0];
    let mut order: Vec<usize> = (0..set.len()).collect();
    order.sort_unstable_by_key(|p| set.id[*p]);
    let of = |p: &usize| [simulation.position(0, *p), set.velocity(*p)];
    order.iter().flat_map(of).collect()
}

/// On a smooth base nothing but the weight acts along it: momentum grows by m g t.
#[test]
fn a_base_that_lets_go_holds_nothing_back() {
    let mut scene = column([1.0, -9.81, 0.0], 0.1);
    (scene.mesh.origin[0], scene.mesh.cells[0]) = (-0.5, 20);
    scene.mesh.planes = [
        [PlaneCondition::Free; 2],
        [PlaneCondition::Fixed, PlaneCondition::Free],
        [PlaneCondition::Sliding; 2],
    ];
    let folder = tempfile::tempdir().unwrap();
    let before = run(&scene, Some(folder.path()), None);
    let state = |run: &Run| {
        let simulation = run.simulation();
        (simulation.momentum()[0], simulation.velocity_time())
    };
    let (p_0, t_0) = state(&before);
    drop(before);
    scene.time = 0.2;
    let gain = |scene: &Scene| {
        let run = run(scene, None, Some(folder.path()));
        let (p, t) = state(&run);
        let changes = run.changes().join("\n");
        ((p - p_0) / (MASS * (t - t_0)), changes)
    };
    let (held, changes) = gain(&scene);
    assert!((held - 1.0).abs() > 0.1, "{held}");
    assert_eq!(changes, "");
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    let (free, changes) = gain(&scene);
    assert!((free - 1.0).abs() < 1e-10, "{free}");
    assert_eq!(changes, "plane_Y0 sliding, fixed until then");
}

/// A load on all particles of a body of one density is its weight by another name, and the books go on as well.
#[test]
fn a_box_load_takes_the_place_of_the_weight() {
    let weight = [0.0, -9.81, 0.0];
    let everywhere = BoxLoad {
        p1: [-1.0; 3],
        p2: [3.0; 3],
        force: [0.0, -9.81 * MASS, 0.0],
    };
    let folder = tempfile::tempdir().unwrap();
    drop(run(&column(weight, 0.1), Some(folder.path()), None));
    let check = |run: &Run, time: f64, words: &str| {
        let mut scene = column(weight, time);
        // As many outputs as the run in parts has ends.
        scene.results.print = (time / 0.1).round() as usize;
        let mut whole = self::run(&scene, None, None);
        let pairs = motion(whole.simulation()).into_iter();
        for (a, b) in pairs.zip(motion(run.simulation())) {
            for axis in 0..3 {
                assert!((a[axis] - b[axis]).abs() < 1e-10, "{a:?} {b:?}");
            }
        }
        assert!(
            run.changes().join("\n").contains(words),
            "{:?}",
            run.changes()
        );
        whole.energy()
    };
    let mut scene = column([0.0; 3], 0.2);
    scene.box_loads = vec![everywhere];
    let mut loaded = run(&scene, Some(folder.path()), Some(folder.path()));
    let words = "box loads of [0.0, -39240.0] N in all, no box load until then";
    let (whole, own) = (check(&loaded, 0.2, words), loaded.energy());
    let off = |a: f64, b: f64| (a - b).abs() / whole.external_work;
    assert!(off(own.external_work, whole.external_work) < 1e-10);
    assert!(off(own.remainder, whole.remainder) < 1e-10);
    drop(loaded);
    let mut unloaded = run(&column(weight, 0.3), None, Some(folder.path()));
    let words = "no box load, box loads of [0.0, -39240.0] N in all until then";
    let (whole, own) = (check(&unloaded, 0.3, words), unloaded.energy());
    assert!(off(own.external_work, whole.external_work) < 1e-10);
}

/// Forces that planes take over at the start of a stage are none that a restart knows.
#[test]
fn a_plane_that_begins_to_absorb_needs_a_stage() {
    let mut scene = column([0.0, -9.81, 0.0], 0.01);
    let folder = tempfile::tempdir().unwrap();
    drop(run(&scene, Some(folder.path()), None));
    let checkpoint = folder.path().join("checkpoint.bin");
    for plane in [PlaneCondition::Absorbing, PlaneCondition::Antisymmetric] {
        scene.mesh.planes[1][0] = plane;
        let refused = Run::start(&scene, &Options::default(), None, Some(&checkpoint));
        let Err(RunError::Refused(problem)) = refused else {
            panic!("{plane:?} is taken");
        };
        assert_eq!(problem.path, "mesh.boundary_conditions.plane_Y0");
        let found = format!("\"{}\" after \"sliding\" in a restart", plane.word());
        assert_eq!(problem.found, found);
        assert!(problem.accepted.contains("`stages`"), "{problem}");
    }
}
