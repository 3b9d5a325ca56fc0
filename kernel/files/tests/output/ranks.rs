//! The files of ranks that share a run are those of one process, byte by byte; in pieces, those of one frame.

use proctor_files::json::read;
use proctor_files::run::{Run, RunControl};
use proctor_kernel::ranks::{Ranks, of_threads};
use proctor_laws::VonMises;
use proctor_scene::simulation::Options;
use proctor_scene::{
    BoxLoad, Field, NodalField, PlaneCondition, Probe, ProbeTarget, ProbedQuantity, Scene, Shape,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A dam on a moving base with all outputs: frames of particles and nodes, histories with probes, checkpoints.
fn scene() -> Scene {
    with_outputs("shaken_base_2d")
}

/// A scene with all outputs.
fn with_outputs(name: &str) -> Scene {
    let path = format!("../../fixtures/scenes/{name}.json");
    let mut scene = read(Path::new(&path)).unwrap_or_else(|error| panic!("{error}"));
    scene.time = 0.06;
    scene.results.print = 3;
    scene.results.checkpoint = true;
    scene.results.fields = vec![
        Field::Id,
        Field::Velocity,
        Field::Stress,
        Field::Displacement,
    ];
    let mut fields = vec![NodalField::Mass, NodalField::Velocity];
    if !scene.contacts.is_empty() {
        fields.extend([NodalField::ContactForce, NodalField::ContactGap]);
    }
    scene.results.nodal_fields = fields;
    let body = scene.bodies[0].id;
    let probe = |name: &str, target| Probe {
        name: name.to_owned(),
        target,
    };
    scene.probes = vec![
        probe("middle", ProbeTarget::Point([1.0, 0.3, 0.0])),
        probe("mean", ProbeTarget::Body(body)),
        probe(
            "most",
            ProbeTarget::Largest {
                body,
                quantity: ProbedQuantity::Velocity,
            },
        ),
    ];
    scene
}

/// Level ground between absorbing sides, through whose absorbing base the motion of the record comes in.
fn ground() -> Scene {
    let mut scene = scene();
    scene.bodies[0].shape = Shape::Cuboid {
        p1: [0.0; 3],
        p2: [10.0, 4.0, 0.0],
    };
    scene.mesh.planes[0] = [PlaneCondition::Absorbing; 2];
    scene.mesh.planes[1][0] = PlaneCondition::Absorbing;
    scene.ground_beyond.incoming = scene.base_motion.take();
    scene
}

/// A block that yields, on a plate that moves as prescribed and acts by its shape. The history has the energies of bodies that yield.
fn on_a_plate() -> Scene {
    let mut scene = with_outputs("sliding_block_2d");
    scene.materials[0].law = VonMises::new(1e6, 0.3, 2e2, 1e4).into();
    scene.bodies[0].motion = Some([1.0, 0.1, 0.0].into());
    scene
}

/// A cylinder that leaves its mesh in space, where six ranks and more share rows, too.
fn in_space() -> Scene {
    let mut scene = with_outputs("leaving_cylinder_3d");
    scene.time = 0.2;
    scene
}

/// Runs to the end or to an output; the summary's hash.
fn run(scene: &Scene, options: &Options, folder: &Path, from: Option<&Path>, stops: usize) -> u64 {
    let mut run =
        Run::start(scene, options, Some(folder), from).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..stops {
        let Some(stop) = run.next_stop() else { break };
        run.advance(stop, |_| RunControl::On)
            .expect("the steps are sound");
        run.write().expect("the files are written");
    }
    let summary = run.summary();
    assert_eq!(summary.state_hash, run.simulation().state_hash());
    summary.state_hash
}

/// The same on ranks, each a thread.
fn run_on(
    count: usize,
    in_pieces: bool,
    scene: &Scene,
    folder: &Path,
    (from, stops): (Option<&Path>, usize),
) -> u64 {
    std::thread::scope(|scope| {
        let one = |rank| {
            let options = Options {
                threads: Some(1),
                ranks: Some(Arc::new(rank) as Arc<dyn Ranks>),
                in_pieces,
                ..Options::default()
            };
            move || run(scene, &options, folder, from, stops)
        };
        let ranks = of_threads(count).into_iter();
        let all: Vec<_> = ranks.map(|rank| scope.spawn(one(rank))).collect();
        let hashes = all.into_iter().map(|rank| rank.join().expect("no panic"));
        let hashes: Vec<u64> = hashes.collect();
        assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{hashes:?}");
        hashes[0]
    })
}

/// Every file in a folder and below it, with its bytes.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(folder).unwrap().to_path_buf();
            all.insert(name, fs::read(&path).unwrap());
        }
    }
    all
}

fn assert_same(found: &Path, expected: &Path, what: &str) {
    let (found, expected) = (files(found), files(expected));
    let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&expected), "{what}");
    for (name, bytes) in &expected {
        assert!(found[name] == *bytes, "{what}: {} differs", name.display());
    }
}

fn one_process(scene: &Scene, folder: &Path) -> u64 {
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    run(scene, &options, folder, None, 9)
}

#[test]
fn ranks_write_the_files_of_one_process() {
    for scene in [scene(), ground(), on_a_plate()] {
        let alone = tempfile::tempdir().unwrap();
        let hash = one_process(&scene, alone.path());
        assert!(
            files(alone.path()).len() > 10,
            "{:?}",
            files(alone.path()).keys()
        );
        for count in [2, 3] {
            let shared = tempfile::tempdir().unwrap();
            assert_eq!(run_on(count, false, &scene, shared.path(), (None, 9)), hash);
            assert_same(shared.path(), alone.path(), &format!("{count} ranks"));
        }
    }
}

/// A run on two ranks that ends early goes on on three, and on one process; one of one process on two.
#[test]
fn any_number_of_ranks_goes_on() {
    for scene in [scene(), ground(), on_a_plate()] {
        let alone = tempfile::tempdir().unwrap();
        let hash = one_process(&scene, alone.path());
        any_goes_on(&scene, (alone.path(), hash), &[(2, 3), (2, 1), (1, 2)]);
    }
}

/// Runs that end early on the first number of ranks go on on the second, to the files of one process.
fn any_goes_on(scene: &Scene, (alone, hash): (&Path, u64), cuts: &[(usize, usize)]) {
    for (before, after) in cuts {
        let shared = tempfile::tempdir().unwrap();
        let checkpoint = shared.path().join("checkpoint.bin");
        let on = |count: usize, how: (Option<&Path>, usize)| {
            run_on(count, false, scene, shared.path(), how)
        };
        assert_ne!(on(*before, (None, 2)), hash);
        assert_eq!(on(*after, (Some(&checkpoint), 9)), hash);
        let what = format!("{before}, then {after}");
        assert_same(shared.path(), alone, &what);
    }
}

/// Ranks that share rows write the same bytes, and go on from those of other cuts.
#[test]
fn ranks_that_share_rows_write_the_files_of_one_process() {
    let scene = in_space();
    let alone = tempfile::tempdir().unwrap();
    let hash = one_process(&scene, alone.path());
    let number = files(alone.path()).len();
    assert!(number > 10, "{number} files");
    for count in [4, 6, 8] {
        let shared = tempfile::tempdir().unwrap();
        assert_eq!(run_on(count, false, &scene, shared.path(), (None, 9)), hash);
        assert_same(shared.path(), alone.path(), &format!("{count} ranks"));
    }
    let cuts = [(8, 6), (6, 1), (1, 8), (2, 6)];
    any_goes_on(&scene, (alone.path(), hash), &cuts);
}

/// Gravity and box loads change at a restart, on ranks as on one process.
#[test]
fn ranks_change_loads_at_a_restart() {
    let scene = scene();
    let mut heavier = scene.clone();
    heavier.gravity = [0.5, -12.0, 0.0];
    let mut loaded = heavier.clone();
    loaded.box_loads = vec![BoxLoad {
        p1: [-10.0; 3],
        p2: [10.0; 3],
        force: [3.0, 0.0, 0.0],
    }];
    for changed in [heavier, loaded] {
        let expected = tempfile::tempdir().unwrap();
        let checkpoint = expected.path().join("checkpoint.bin");
        let options = Options::default();
        run(&scene, &options, expected.path(), None, 1);
        let hash = run(&changed, &options, expected.path(), Some(&checkpoint), 9);
        let found = tempfile::tempdir().unwrap();
        let checkpoint = found.path().join("checkpoint.bin");
        run_on(2, false, &scene, found.path(), (None, 1));
        let how = (Some(checkpoint.as_path()), 9);
        assert_eq!(run_on(3, false, &changed, found.path(), how), hash);
        assert_same(found.path(), expected.path(), "changed loads");
    }
}

/// A changed byte is found by whichever rank reads it, and all of them refuse the checkpoint.
#[test]
fn all_ranks_refuse_a_broken_checkpoint() {
    let scene = scene();
    let folder = tempfile::tempdir().unwrap();
    let checkpoint = folder.path().join("checkpoint.bin");
    one_process(&scene, folder.path());
    let sound = fs::read(&checkpoint).unwrap();
    for place in [40, sound.len() / 2, sound.len() - 30] {
        let mut broken = sound.clone();
        broken[place] ^= 1;
        fs::write(&checkpoint, broken).unwrap();
        std::thread::scope(|scope| {
            let one = |rank| {
                let options = Options {
                    ranks: Some(Arc::new(rank) as Arc<dyn Ranks>),
                    ..Options::default()
                };
                let (scene, checkpoint) = (&scene, &checkpoint);
                move || Run::start(scene, &options, None, Some(checkpoint)).err()
            };
            let ranks: Vec<_> = of_threads(3)
                .into_iter()
                .map(|rank| scope.spawn(one(rank)))
                .collect();
            for rank in ranks {
                let error = rank.join().expect("no panic").expect("it is broken");
                assert!(error.is_bad_input(), "{error}");
            }
        });
    }
}

/// Values of an array of a frame, by its name, as the file has them.
fn appended(bytes: &[u8], name: &str) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let line = text
        .lines()
        .find(|line| line.contains(&format!("Name=\"{name}\"")));
    let line = line.unwrap_or_else(|| panic!("no array {name}"));
    let offset = line.rsplit_once("offset=\"").unwrap().1;
    let offset: usize = offset.split_once('"').unwrap().0.parse().unwrap();
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes
        .windows(marker.len())
        .position(|w| w == marker)
        .unwrap()
        + marker.len();
    let own = &bytes[start + offset..];
    let length = u64::from_le_bytes(own[..8].try_into().unwrap()) as usize;
    own[8..8 + length].to_vec()
}

/// The particles of all pieces are those of the whole frame.
#[test]
fn pieces_of_a_frame_are_the_whole() {
    let scene = scene();
    let (alone, shared) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    one_process(&scene, alone.path());
    run_on(3, true, &scene, shared.path(), (None, 9));
    let list = fs::read_to_string(shared.path().join("particles.pvd")).unwrap();
    let parallel = fs::read_to_string(shared.path().join("particles_000002.pvtu")).unwrap();
    assert!(list.contains("file=\"particles_000002.pvtu\""), "{list}");
    for name in ["Particle Id", "Velocity", "Stress_XX", "Displacement"] {
        assert!(parallel.contains(&format!("Name=\"{name}\"")), "{parallel}");
    }
    let whole = fs::read(alone.path().join("particles_000002.vtu")).unwrap();
    let pieces: Vec<Vec<u8>> = (0..3)
        .map(|rank| {
            let name = format!("particles_000002/{rank}.vtu");
            assert!(parallel.contains(&format!("<Piece Source=\"{name}\"/>")));
            fs::read(shared.path().join(name)).unwrap()
        })
        .collect();
    let values = |bytes: &[u8], name: &str, width: usize| -> Vec<Vec<u8>> {
        let all = appended(bytes, name);
        all.chunks(width).map(<[u8]>::to_vec).collect()
    };
    for (name, width) in [("Velocity", 24), ("Stress_XX", 8), ("Points", 24)] {
        let by_id = |bytes: &[u8]| -> Vec<(Vec<u8>, Vec<u8>)> {
            let ids = values(bytes, "Particle Id", 8);
            ids.into_iter().zip(values(bytes, name, width)).collect()
        };
        let mut found: Vec<_> = pieces.iter().flat_map(|bytes| by_id(bytes)).collect();
        found.sort_by_key(|(id, _)| i64::from_le_bytes(id[..].try_into().unwrap()));
        assert_eq!(found, by_id(&whole), "{name}");
    }
    // Each rank has some.
    assert!(
        pieces
            .iter()
            .all(|bytes| !values(bytes, "Particle Id", 8).is_empty())
    );
    assert!(shared.path().join("grid_000001.pvtu").exists());
    // A run anew takes them all away.
    one_process(&scene, shared.path());
    assert_same(shared.path(), alone.path(), "anew");
}
