//! Words of scenes that a solver reads over: each is found on the last frame of its own small problem.

use proctor_benchmark::bench::children::Word;
use proctor_benchmark::frames::Frame;
use proctor_files::json::from_json;
use std::collections::BTreeMap;

const ALL: [Word; 6] = [
    Word::Planes,
    Word::NodalLoads,
    Word::KineticDamping,
    Word::MovingBase,
    Word::Contact,
    Word::Surface,
];

/// A frame of particles that began at the first and went by the second (m).
fn frame(moved: &[([f64; 3], [f64; 3])]) -> Frame {
    let points = moved
        .iter()
        .map(|(x, u)| std::array::from_fn(|a| x[a] + u[a]));
    let u = moved.iter().flat_map(|(_, u)| *u).collect();
    Frame {
        time: None,
        points: points.collect(),
        arrays: BTreeMap::from([("Displacement".to_owned(), (3, u))]),
    }
}

#[test]
fn the_problems_of_words_are_sound_scenes_that_use_them() {
    for word in ALL {
        for axes in [2, 3] {
            let Some(scene) = word.scene(axes) else {
                assert!(matches!(word, Word::MovingBase | Word::Surface) && axes == 2);
                continue;
            };
            let folder = tempfile::tempdir().expect("a folder");
            if let Some((_, name, text)) = word.file() {
                std::fs::write(folder.path().join(name), text).expect("written");
            }
            let scene = from_json(&scene.to_string(), "word", folder.path())
                .unwrap_or_else(|error| panic!("{word:?}: {error}"));
            assert!(Word::of(&scene).contains(&word), "{word:?}");
            scene
                .check()
                .unwrap_or_else(|error| panic!("{word:?}: {error}"));
        }
    }
}

/// A word, particles with their ways, and the fault that they show.
type Case<'a> = (Word, Vec<([f64; 3], [f64; 3])>, Option<&'a str>);

/// Of each word what is due, and what a solver leaves that does not know it.
#[test]
fn a_word_that_does_not_act_is_told_from_one_that_does() {
    // Thrown with 0.25 m/s for 0.04 s.
    let flown = [0.01, 0.0, 0.0];
    let rests = [0.0; 3];
    let (low, high) = ([0.4, 0.05, 0.4], [0.4, 0.85, 0.4]);
    // Two forces of 20 and 40 N on 27 kg for 0.04 s.
    let pushed = 0.5 * 60.0 / 27.0 * 0.04 * 0.04;
    let first = pushed / 3.0;
    // Thrown up with 1 m/s, and stopped after at most two steps of 1 ms.
    let fallen = 0.002 - 0.5 * 9.81 * 0.038 * 0.038;
    let free = 0.04 - 0.5 * 9.81 * 0.04 * 0.04;
    // The base goes with 2 m/s².
    let shaken = 0.04 * 0.04;
    let upper = [0.4, 0.15, 0.4];
    let cases: [Case<'_>; 15] = [
        (
            Word::Planes,
            vec![(low, flown), (high, [1e-4, 0.0, 0.0])],
            None,
        ),
        (
            Word::Planes,
            vec![(low, flown), (high, flown)],
            Some("`fixed` does not act"),
        ),
        (
            Word::Planes,
            vec![(low, rests), (high, rests)],
            Some("`sliding` does not act"),
        ),
        (Word::NodalLoads, vec![(low, [pushed, pushed, 0.0])], None),
        (
            Word::NodalLoads,
            vec![(low, [pushed, first, 0.0])],
            Some("not every `nodal_point_load` acts: two of them along y"),
        ),
        (
            Word::NodalLoads,
            vec![(low, [f64::NAN; 3])],
            Some("not every `nodal_point_load`"),
        ),
        (Word::KineticDamping, vec![(low, [0.0, fallen, 0.0])], None),
        (
            Word::KineticDamping,
            vec![(low, [0.0, free, 0.0])],
            Some("`damping` of the type `kinetic` does not act"),
        ),
        (Word::MovingBase, vec![(low, [shaken, 0.0, 0.0])], None),
        (
            Word::MovingBase,
            vec![(low, rests)],
            Some("`earthquake` does not act"),
        ),
        (Word::Contact, vec![(low, rests), (upper, flown)], None),
        (
            Word::Contact,
            vec![(low, rests), (upper, [0.002, 0.0, 0.0])],
            Some("`contact` does not act"),
        ),
        (Word::Surface, vec![(upper, [0.01, -1e-4, 0.0])], None),
        (
            Word::Surface,
            vec![(upper, [0.01, -0.5 * 9.81 * 0.04 * 0.04, 0.0])],
            Some("`terrain_contact` does not act: a body on triangles falls by 0.007848 m"),
        ),
        (
            Word::Surface,
            vec![(upper, rests)],
            Some("`terrain_contact` holds a body"),
        ),
    ];
    for (word, moved, fault) in cases {
        let found = word.judge(&frame(&moved), 3);
        match fault {
            None => assert_eq!(found, Ok(()), "{word:?}"),
            Some(words) => {
                let found = found.expect_err(words);
                assert!(found.contains(words), "{word:?}: {found}");
            }
        }
    }
}
