//! Links of the documents lead to files and headings that there are, and the book has each of its chapters once.

use super::{BOOK, documents, files_below, root, text_of};
use std::path::{Component, Path, PathBuf};

/// Targets of links and pictures in a text, but for those in other places of the network.
fn targets(text: &str) -> Vec<&str> {
    let after = text.split("](").skip(1);
    let targets = after.filter_map(|rest| rest.split(')').next());
    let here = |target: &&str| !target.contains("://") && !target.starts_with("mailto:");
    targets.filter(here).collect()
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => drop(plain.pop()),
            Component::CurDir => {}
            other => plain.push(other),
        }
    }
    plain
}

/// The anchor of a heading: its letters in lower case, with hyphens for blanks.
fn anchor(heading: &str) -> String {
    let heading = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = heading
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

fn fault(document: &str, target: &str) -> Option<String> {
    let (file, part) = target.split_once('#').unwrap_or((target, ""));
    let folder = Path::new(document).parent().unwrap_or(Path::new(""));
    let path = if file.is_empty() {
        PathBuf::from(document)
    } else {
        plain(&folder.join(file))
    };
    if !root().join(&path).exists() {
        return Some(format!("there is no {}", path.display()));
    }
    if document.starts_with(BOOK) && !path.starts_with(BOOK) {
        return Some("it leads out of the book, where a built book has nothing".to_owned());
    }
    let text = || text_of(&path.to_string_lossy());
    let headings = || {
        text()
            .lines()
            .filter(|l| l.starts_with('#'))
            .map(anchor)
            .collect::<Vec<_>>()
    };
    (!part.is_empty() && !headings().iter().any(|h| h == part))
        .then(|| format!("{} has no heading #{part}", path.display()))
}

#[test]
fn every_link_leads_somewhere() {
    let mut all = documents();
    all.extend(files_below(".github", &["md"]));
    all.extend(files_below("fixtures", &["md"]));
    all.push("CODE_OF_CONDUCT.md".to_owned());
    let (mut faults, mut checked) = (vec![], 0);
    for document in all {
        for target in targets(&text_of(&document)) {
            checked += 1;
            faults.extend(
                fault(&document, target).map(|fault| format!("{document}: {target}: {fault}")),
            );
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked > 50, "only {checked} links were found");
}

#[test]
fn links_that_lead_nowhere_are_found() {
    for target in [
        "nowhere.md",
        "start.md#nothing",
        "#nothing",
        "../../README.md",
    ] {
        assert!(
            fault("docs/src/introduction.md", target).is_some(),
            "{target}"
        );
    }
    assert_eq!(fault("docs/src/introduction.md", "start.md"), None);
    assert_eq!(
        anchor("## Files: `history.csv`, and more"),
        "files-historycsv-and-more"
    );
}

#[test]
fn the_summary_lists_each_chapter_once() {
    let summary = text_of("docs/src/SUMMARY.md");
    let mut listed: Vec<String> = targets(&summary)
        .iter()
        .map(|t| format!("{BOOK}/{t}"))
        .collect();
    listed.sort();
    let mut chapters = files_below(BOOK, &["md"]);
    chapters.retain(|chapter| !chapter.ends_with("/SUMMARY.md"));
    assert_eq!(listed, chapters);
}

#[test]
fn each_picture_is_shown() {
    let texts: Vec<String> = documents()
        .iter()
        .map(|document| text_of(document))
        .collect();
    for picture in files_below(BOOK, &["svg", "png"]) {
        let name = picture.rsplit('/').next().unwrap_or_default();
        assert!(texts.iter().any(|text| text.contains(name)), "{picture}");
    }
}

#[test]
fn each_script_is_in_their_index() {
    let index = text_of("scripts/README.md");
    for entry in std::fs::read_dir(root().join("scripts")).expect("scripts") {
        let name = entry.expect("a script").file_name();
        let name = name.to_string_lossy();
        assert!(
            name == "README.md" || index.contains(&format!("`{name}`")),
            "{name}"
        );
    }
}
