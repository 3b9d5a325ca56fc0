//! The language of scenes for other solvers: each of its words is in the table of the manual.

use super::text_of;
use proctor_files::json::write;
use proctor_verification::case::Size;
use proctor_verification::study;
use std::collections::BTreeSet;

/// Lists whose entries have words of their own.
const LISTS: [&str; 2] = ["body", "contact"];
/// Blocks with words of their own.
const BLOCKS: [&str; 5] = [
    "mesh",
    "damping",
    "earthquake",
    "results",
    "terrain_contact",
];

#[test]
fn every_word_of_scenes_for_other_solvers_is_in_their_table() {
    let manual = text_of("docs/src/howto/other-solvers.md");
    let (_, table) = manual.split_once("\n## The scene\n").expect("a section");
    let (table, _) = table.split_once("\n## ").expect("the next section");
    let mut words = BTreeSet::new();
    for study in study::open() {
        for rung in study.path(Size::Quick).iter().take(1) {
            let Ok(guest) = study.guest(rung) else {
                continue;
            };
            let scene =
                write(&guest.scene).unwrap_or_else(|error| panic!("{}: {error}", study.name()));
            let scene = scene.scene;
            let mut add = |value: &serde_json::Value| {
                words.extend(
                    value
                        .as_object()
                        .into_iter()
                        .flatten()
                        .map(|(word, _)| word.clone()),
                );
            };
            add(&scene);
            for block in BLOCKS {
                add(&scene[block]);
            }
            for list in LISTS {
                scene[list]
                    .as_array()
                    .into_iter()
                    .flatten()
                    .for_each(&mut add);
            }
        }
    }
    // What is handed over has the word of the manuals in its place.
    assert!(words.remove("fields") && words.len() > 25, "{words:?}");
    words.insert("material_point_results".to_owned());
    for word in words {
        assert!(
            table.contains(&format!("`{word}`")),
            "{word} is not in the table"
        );
    }
}
