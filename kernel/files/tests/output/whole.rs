//! The files of a run agree with the simulation: the whole state in the checkpoint, the steps in the summary, the
//! values of particles in frames and history.

use std::fs;
use std::path::Path;

use proctor_files::json::read;
use proctor_files::run::{Run, RunControl};
use proctor_scene::simulation::Options;
use proctor_scene::{
    BaseMotion, Damping, DomainUpdate, Field, History, Motion, Probe, Scene, TimeStep, Transfer,
    TransferKind, Weighting,
};

fn scene(name: &str) -> Scene {
    let path = Path::new("../../fixtures/scenes").join(name);
    read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// A dam on a base that rises and goes aside.
fn shaken() -> Scene {
    let mut scene = scene("shaken_base_2d.json");
    scene.gravity = [1.0, -10.0, 0.0];
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    scene.transfer = Transfer::new(TransferKind::Apic);
    scene.base_motion = Some(BaseMotion {
        axis: 1,
        side: 0,
        motion: Motion::Velocity(History {
            times: vec![0.0, 0.1],
            values: vec![[0.0; 3], [3.0, 2.0, 0.0]],
        }),
    });
    scene.time = 0.1;
    scene
}

/// A column that comes to rest.
fn relaxed() -> Scene {
    let mut scene = scene("column_gravity_2d.json");
    scene.damping = Damping::Kinetic;
    scene.time = 0.05;
    scene
}

/// Runs to the end, or to the output number `stops`.
fn go(run: &mut Run, stops: usize, mut see: impl FnMut(f64, f64) + Send) {
    for _ in 0..stops {
        let Some(stop) = run.next_stop() else { return };
        run.advance(stop, |info| {
            see(info.dt, info.dt_critical);
            RunControl::On
        })
        .expect("the steps are sound");
        run.write().expect("the files are written");
    }
}

/// Not only the bits of the end are the same: everything that was saved is there, number by number.
#[test]
fn a_restart_has_the_whole_state() {
    for (mut scene, moves) in [(shaken(), true), (relaxed(), false)] {
        scene.results.print = 5;
        let folder = tempfile::tempdir().unwrap();
        let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
        go(&mut run, 3, |_, _| ());
        let saved = run.simulation().save();
        let state = &saved.state;
        // Numbers that are the same could stand for each other.
        let (clock, ledger) = (&state.clock, &state.ledger);
        assert!(
            clock.dt_before != clock.dt_min && clock.dt_min != clock.dt_max,
            "{} {clock:?}",
            scene.name
        );
        assert!(state.found[0].wave_speed_squared != state.found[0].speed_squared);
        assert!(ledger.dead_load_origin != ledger.external_work);
        let [x, y, z] = state.mesh_shift;
        assert_eq!((x, y != 0.0, z), (0.0, moves, 0.0));
        assert!(moves || state.kinetic[0] != state.kinetic[1]);

        let energy = run.energy();
        // A folder belongs to one run at a time.
        drop(run);
        let checkpoint = folder.path().join("checkpoint.bin");
        let (own, from) = (Some(folder.path()), Some(checkpoint.as_path()));
        let mut resumed = Run::start(&scene, &Options::default(), own, from).unwrap();
        assert!(resumed.simulation().save() == saved, "{}", scene.name);
        assert_eq!(resumed.energy(), energy);
    }
}

#[test]
fn the_summary_has_the_smallest_and_the_largest_step() {
    let mut scene = shaken();
    scene.results.print = 5;
    let mut run = Run::start(&scene, &Options::default(), None, None).unwrap();
    let (mut least, mut most, mut critical) = (f64::INFINITY, 0.0_f64, f64::INFINITY);
    go(&mut run, usize::MAX, |dt, dt_critical| {
        (least, most) = (least.min(dt), most.max(dt));
        critical = critical.min(dt_critical);
    });
    assert!(least < most);
    let summary = run.summary();
    assert_eq!(summary.dt_min, Some(least));
    assert_eq!(summary.dt_max, Some(most));
    assert_eq!(summary.dt_critical, Some(critical));
}

/// A constant step passes the time of an output by less than half of its length, and stops before it by no more.
#[test]
fn a_constant_step_writes_at_the_nearest_time() {
    let mut scene = relaxed();
    scene.damping = Damping::None;
    scene.results.print = 5;
    let dt = 1e-4;
    // No output falls on a step: 167.3 steps lie between them.
    scene.time = 5.0 * 167.3 * dt;
    scene.time_step = TimeStep::Fixed {
        dt,
        allow_unstable: false,
    };
    let mut run = Run::start(&scene, &Options::default(), None, None).unwrap();
    for output in 1..=5 {
        let nominal = f64::from(output) / 5.0 * scene.time;
        go(&mut run, 1, |_, _| ());
        let late = (run.simulation().time() - nominal) / dt;
        assert!(
            late.abs() <= 0.5 + 1e-9,
            "output {output} is {late} steps late"
        );
    }
    assert!(run.next_stop().is_none());
}

/// Numbers of an array of a frame.
fn reals(file: &[u8], name: &str) -> Vec<f64> {
    let (kind, _, bytes) = &super::frames::arrays(file)[name];
    assert_eq!(kind, "Float64", "{name}");
    let (words, _) = bytes.as_chunks::<8>();
    words.iter().map(|word| f64::from_le_bytes(*word)).collect()
}

/// Stresses as the kernel has them, in its order.
const STRESSES: [&str; 6] = ["XX", "YY", "ZZ", "YZ", "XZ", "XY"];

/// A ball in a corner, which has stresses of every direction; and the dam, whose mesh moves.
#[test]
fn frames_and_history_hold_what_the_particles_hold() {
    let mut ball = scene("leaving_cylinder_3d.json");
    ball.bodies[0].velocity = [-1.0, 2.0, -3.0];
    ball.time = 0.2;
    for mut scene in [ball, shaken()] {
        scene.results.print = 2;
        scene.results.fields = Field::ALL.to_vec();
        scene.probes = vec![Probe::at("probe", [4.4, 1.0, 0.0])];
        let folder = tempfile::tempdir().unwrap();
        let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
        go(&mut run, usize::MAX, |_, _| ());
        let simulation = run.simulation();
        let set = &simulation.sets()[0];
        let mut order: Vec<usize> = (0..set.len()).collect();
        order.sort_unstable_by_key(|&p| set.id[p]);
        assert!(!order.is_sorted(), "a sort has changed the order");

        let frame =
            |n: usize| fs::read(folder.path().join(format!("particles_{n:06}.vtu"))).unwrap();
        let (first, last) = (frame(0), frame(2));
        let stresses = STRESSES.map(|name| reals(&last, &format!("Stress_{name}")));
        let pressure = reals(&last, "Pressure");
        let velocity = reals(&last, "Velocity");
        for (k, &p) in order.iter().enumerate() {
            let stress = set.stress(p);
            for (of, exact) in stresses.iter().zip(stress) {
                assert_eq!(of[k], exact);
            }
            assert_eq!(pressure[k], -(stress[0] + stress[1] + stress[2]) / 3.0);
            assert_eq!(velocity[3 * k..3 * k + 3], set.velocity(p));
        }
        // Positions in the scene, from which displacements can be had without the program.
        let (start, end) = (reals(&first, "Points"), reals(&last, "Points"));
        let displacement = reals(&last, "Displacement");
        let round_off = 1.0e-12;
        for (k, u) in displacement.iter().enumerate() {
            assert!((end[k] - start[k] - u).abs() < round_off, "{u} at {k}");
        }

        let history = fs::read_to_string(folder.path().join("history.csv")).unwrap();
        let mut rows = history.lines().map(|line| line.split(','));
        let names: Vec<&str> = rows.next().unwrap().collect();
        let row: Vec<f64> = rows
            .next_back()
            .unwrap()
            .map(|x| x.parse().unwrap())
            .collect();
        let value = |name: &str| row[names.iter().position(|n| *n == name).unwrap()];
        let before = simulation.time() - 0.5 * simulation.save().state.clock.dt_before;
        assert_eq!(
            (value("time"), value("velocity_time")),
            (simulation.time(), before)
        );
        let followed = |p: &&usize| set.velocity(**p)[0] == value("probe_vx");
        let p = *order
            .iter()
            .find(followed)
            .expect("the probe is a particle");
        for (name, exact) in STRESSES.iter().zip(set.stress(p)) {
            assert_eq!(value(&format!("probe_s{}", name.to_lowercase())), exact);
        }
    }
}
