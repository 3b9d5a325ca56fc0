//! The generated files of the book are those that the program writes from the cases and the kept records.

use super::{BOOK, files_below, root, text_of};
use proctor_benchmark::book;
use proctor_benchmark::record::Record;

/// The generated files, of the full ladders where they hold a case, else of the short ones.
fn files() -> Vec<book::BookFile> {
    let kept = |name: &str| {
        Record::read(&root().join("fixtures/expected").join(name)).expect("a kept record")
    };
    book::files(&[kept("full.json"), kept("errors.json")])
}

#[test]
fn generated_files_are_what_the_program_writes() {
    let files = files();
    let differ: Vec<&str> = { files.iter() }
        .filter(|file| {
            let kept = std::fs::read_to_string(root().join(BOOK).join(&file.path));
            kept.ok().as_deref() != Some(file.text.as_str())
        })
        .map(|file| file.path.as_str())
        .collect();
    assert!(
        differ.is_empty(),
        "{differ:?} differ; mend them by `proctor export --format book fixtures/expected/full.json \
         fixtures/expected/errors.json --out docs/src`"
    );
}

#[test]
fn the_folder_of_the_cases_holds_nothing_else() {
    let mut written: Vec<String> = { files().into_iter() }
        .map(|file| format!("{BOOK}/{}", file.path))
        .filter(|path| path.contains("/verification/cases/"))
        .collect();
    written.sort();
    assert_eq!(
        written,
        files_below("docs/src/verification/cases", &["md", "svg"])
    );
}

#[test]
fn every_case_has_a_page_with_gates_that_have_reasons() {
    for case in proctor_verification::case::all() {
        let page = text_of(&format!("{BOOK}/verification/cases/{}.md", case.name()));
        assert!(page.contains(case.question()), "{}", case.name());
        let (_, gates) = page.split_once("why this bound |").expect("gates");
        let gates = gates
            .lines()
            .skip(2)
            .take_while(|line| line.starts_with('|'));
        let mut count = 0;
        for gate in gates {
            let cells: Vec<&str> = gate.trim_matches('|').split(" | ").map(str::trim).collect();
            assert!(
                cells.len() >= 4 && cells.iter().all(|cell| !cell.is_empty()),
                "{gate}"
            );
            count += 1;
        }
        assert!(count > 0, "{}", case.name());
    }
}
