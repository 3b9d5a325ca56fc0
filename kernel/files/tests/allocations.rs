//! Allocations of the warm steps of scenes of every kind: loads, bodies that are driven, a base that
//! moves, laws that yield, contact on the grid, of boundaries and on surfaces.

use proctor_files::json;
use proctor_scene::simulation::{Options, Simulation};
use std::path::{Path, PathBuf};

/// Steps that are counted together.
const STEPS: usize = 10;
/// Most of these.
const MOST: usize = 60;
/// Number of steps in a row that take nothing. A list that still grows doubles: the more it holds, the longer it is enough.
const IN_A_ROW: usize = 4;

/// Scenes of the fixtures in which no particle leaves the mesh, which is an event and takes memory.
fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/scenes");
    let mut scenes = vec![];
    for folder in [folder.clone(), folder.join("manual")] {
        let files = folder.read_dir().expect("the scenes are there");
        let files = files.map(|file| file.expect("a file").path());
        scenes.extend(files.filter(|file| file.extension().is_some_and(|e| e == "json")));
    }
    scenes.retain(|file| !file.ends_with("leaving_cylinder_3d.json"));
    scenes.sort();
    scenes
}

/// Requests of each of some numbers of steps, until enough in a row took nothing or no step is left.
fn requests(file: &Path) -> Vec<u64> {
    let scene = json::read(file).expect("a sound scene");
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("a sound scene");
    let mut counts = vec![];
    let mut in_a_row = 0;
    while counts.len() < MOST && in_a_row < IN_A_ROW {
        let mut steps = 0;
        let info = allocation_counter::measure(|| {
            // Beyond its end a scene may reach the walls of its mesh.
            while steps < STEPS && simulation.step(f64::INFINITY).is_ok() {
                steps += 1;
            }
        });
        if steps < STEPS {
            break;
        }
        in_a_row = if info.count_total == 0 {
            in_a_row + 1
        } else {
            0
        };
        counts.push(info.count_total);
    }
    counts
}

#[test]
fn steps_of_no_scene_take_memory() {
    let scenes = scenes();
    assert!(scenes.len() > 15, "{scenes:?}");
    for file in scenes {
        let counts = requests(&file);
        let last = counts.iter().rev().take(IN_A_ROW);
        assert!(
            counts.len() >= IN_A_ROW && last.sum::<u64>() == 0,
            "{}: {counts:?} requests in {STEPS} steps each",
            file.display()
        );
    }
}
