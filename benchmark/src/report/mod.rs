//! A record as one page: HTML that needs no network and no script to be read.
//!
//! [`page`] is a function of the record alone, or of two records, so that a page can be made again, by `proctor report`,
//! from any record that was kept. The first screen answers: verdict, gates nearest to their bounds, cheapest method,
//! stability, speed, what changed. An index of the cases and each case, folded, follow.

mod arena;
mod cases;
mod cheapest;
mod gates;
mod glance;
mod guests;
mod heat;
mod history;
mod html;
mod machine;
mod mill;
mod packed;
mod plans;
mod refined;
mod since;
mod speed;
mod stability;
mod studies;
mod verdict;
mod whole;

use crate::history::History;
use crate::record::Record;
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
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Proctor: {}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <a class=\"skip\" href=\"#content\">to the results</a>\n<header>\n\
         <h1>Proctor <small>accuracy, stability and speed of a material point method (MPM) program</small></h1>\n\
         <p class=\"whence soft\">{}</p>\n{}{}\
         <nav aria-label=\"sections\"><ul>\n",
        escape(verdict::of(record, since).word()),
        verdict::whence(record),
        verdict::html(record, since),
        glance::html(record, since),
    );
    for section in &sections {
        let _ = writeln!(
            html,
            "<li><a href=\"#{}\">{}</a></li>",
            section.id,
            escape(&section.title)
        );
    }
    html.push_str("</ul></nav>\n</header>\n<main id=\"content\">\n");
    for section in &sections {
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
        "</main>\n<footer><p>SI units. Every number of this page is in the record beside it; \
         <code>proctor report RECORD</code> makes the page again.</p></footer>\n\
         <script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    );
    html
}
