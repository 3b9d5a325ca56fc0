//! A record as one page: HTML that needs no network and no script to be read.
//!
//! [`page`] is a function of the record alone, or of two records, so that a page can be made again, by `proctor report`,
//! from any record that was kept. The first screen answers: verdict, gates nearest to their bounds, cheapest method,
//! stability, speed, what changed. An index of the cases and each case, folded, follow.

mod arena;
pub mod before;
mod cases;
mod cheapest;
pub mod gates;
mod glance;
mod guests;
pub mod heat;
mod history;
pub mod html;
mod machine;
mod mill;
mod packed;
mod plans;
mod refined;
mod runs;
mod since;
mod speed;
mod stability;
mod studies;
mod verdict;
mod whole;

use crate::history::History;
use crate::record::Record;
use crate::runs::RunFolder;
pub(crate) use html::escape;
use html::{Pictures, Section};
pub use mill::MillResult;
pub use since::Since;
use std::fmt::Write as _;

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// The page of a record, with what changed since a base.
#[must_use]
pub fn page(record: &Record, since: Option<&Since<'_>>) -> String {
    page_with(record, since, None, None)
}

/// The same with how the numbers of earlier records went, and with a result of the mill.
#[must_use]
pub fn page_with(
    record: &Record,
    since: Option<&Since<'_>>,
    history: Option<&History>,
    mill: Option<&MillResult>,
) -> String {
    let record = &whole::whole(record);
    let mut pictures = Pictures::default();
    let sections: Vec<Section> = [
        arena::section(record, &mut pictures),
        since.map(|since| since::section(since, &mut pictures)),
        history.map(|history| history::section(history, &mut pictures)),
        cases::section(record, &mut pictures),
        refined::section(record, &mut pictures),
        mill.map(mill::section),
        stability::section(record),
        speed::section(record, &mut pictures),
        plans::section(record),
        machine::section(record),
    ]
    .into_iter()
    .flatten()
    .collect();
    let head = format!(
        "<h1>Proctor <small>accuracy, stability and speed of a material point method (MPM) program</small></h1>\n\
         <p class=\"whence soft\">{}</p>\n{}{}",
        verdict::whence(record),
        verdict::html(record, since),
        glance::html(record, since),
    );
    let foot = "Every number of this page is in the record beside it; <code>proctor report RECORD</code> makes the page again.";
    framed(verdict::of(record, since).word(), &head, &sections, foot)
}

/// The page of runs of one scene: how they ended, how far they are apart, their histories as curves.
#[must_use]
pub fn page_of_runs(runs: &[RunFolder]) -> String {
    let scene = runs.first().map_or("", |run| run.summary.scene.as_str());
    let head = format!(
        "<h1>{} <small>{}</small></h1>\n",
        escape(scene),
        if runs.len() == 1 {
            "a run"
        } else {
            "runs of one scene"
        }
    );
    let foot = "Every number of this page is in <code>summary.json</code> and <code>history.csv</code> of the folders.";
    framed(scene, &head, &runs::sections(runs), foot)
}

/// A page: what stands above, an index of the sections, the sections, and what stands below.
fn framed(title: &str, head: &str, sections: &[Section], foot: &str) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Proctor: {}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <a class=\"skip\" href=\"#content\">to the results</a>\n<header>\n\
         {head}\
         <nav aria-label=\"sections\"><ul>\n",
        escape(title),
    );
    for section in sections {
        let _ = writeln!(
            html,
            "<li><a href=\"#{}\">{}</a></li>",
            section.id,
            escape(&section.title)
        );
    }
    html.push_str("</ul></nav>\n</header>\n<main id=\"content\">\n");
    for section in sections {
        let _ = write!(
            html,
            "<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}</section>\n",
            section.id,
            escape(&section.title),
            section.body
        );
    }
    let _ = write!(
        html,
        "</main>\n<footer><p>SI units. {foot}</p></footer>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    );
    html
}
