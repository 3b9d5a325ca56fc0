//! Scenes with error bars: the value of each quantity, its bar, and how it settles.

use super::html::{Pictures, Section, Table, folded, paragraph};
use crate::record::Record;
use crate::record::details::RefinedDetail;
use crate::show::paint::Mark;

/// Mark of a quantity without a bar.
const FAILED: Mark = Mark::Failed;

/// Text above the scenes.
const WHAT: &str = "A bar holds the answer of an infinitely fine mesh in 95 of 100 cases. It is about mesh and step, not \
    about model or data. Order: by which power of the cell size the values settle.";

/// The section of the refined scenes, where the record holds any.
pub fn section(record: &Record, pictures: &mut Pictures) -> Option<Section> {
    let refined = &record.details.refined;
    let body: String = refined.iter().map(|scene| one(scene, pictures)).collect();
    (!refined.is_empty()).then(|| Section {
        id: "bars",
        title: "Error bars of scenes".to_owned(),
        body: paragraph(WHAT) + &body,
    })
}

fn one(detail: &RefinedDetail, pictures: &mut Pictures) -> String {
    let mut html = String::new();
    for finding in &detail.findings {
        html.push_str(&paragraph(finding));
    }
    let mut lines = detail.table.iter();
    if let Some(head) = lines.next() {
        let head: Vec<&str> = head.iter().skip(1).map(String::as_str).collect();
        let mut table = Table::new(&format!("{}: values and bars", detail.scene), &head);
        for line in lines {
            let [mark, name, rest @ ..] = &line[..] else {
                continue;
            };
            let cells = std::iter::once(format!("{mark} {name}")).chain(rest.iter().cloned());
            if mark == FAILED.symbol() {
                table.push_as("failed", cells);
            } else {
                table.push(cells);
            }
        }
        html.push_str(&table.html());
    }
    let drawn = pictures.several(&detail.scene, &detail.figures);
    html + &folded(
        &format!("{}: pictures over the meshes and over time", detail.scene),
        &drawn,
    )
}
