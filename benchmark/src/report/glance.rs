//! The first screen: the answers in a line each, and the panels behind them.

use super::cheapest::{self, Costs};
use super::html::escape;
use super::since::{self, Since};
use super::speed::{self, Speed};
use super::{arena, gates, guests, stability, verdict};
use crate::arena::Board;
use crate::record::Record;
use std::fmt::Write as _;

/// An answer: what it is about, a number or a word, a sentence, and the panel that has more.
struct Answer {
    about: &'static str,
    anchor: &'static str,
    said: [String; 2],
    /// Its look: none, `near` to failing, or `bad`.
    look: &'static str,
}

/// The first screen below the verdict.
#[must_use]
pub fn html(record: &Record, since: Option<&Since<'_>>) -> String {
    let (costs, speeds) = (Costs::all(record), Speed::all(record));
    let board = Board::of(record);
    let mut answers: Vec<Answer> = vec![];
    let mut answer = |about, anchor, found: Option<[String; 2]>, look| {
        answers.extend(found.map(|said| Answer {
            about,
            anchor,
            said,
            look,
        }));
    };
    let ranked = gates::ranked(record);
    let nearest = if ranked.iter().any(|(_, gate)| !gate.passed) {
        "bad"
    } else if ranked.iter().any(|(_, gate)| gate.is_near()) {
        "near"
    } else {
        ""
    };
    answer(
        "Nearest gate",
        "nearest",
        verdict::headline(record),
        nearest,
    );
    answer(
        "Cheapest method",
        "cheapest",
        cheapest::headline(&costs),
        "",
    );
    answer(
        "Other solvers",
        if board.is_some() { "arena" } else { "guests" },
        board.as_ref().map_or_else(
            || guests::headline(record),
            |board| Some(arena::headline(board)),
        ),
        if guests::failing(record) { "bad" } else { "" },
    );
    answer(
        "Stability",
        "stable",
        stability::headline(record),
        if stability::failing(record) {
            "bad"
        } else {
            ""
        },
    );
    answer("Speed", "fast", speed::headline(&speeds), "");
    let (what, look) = since::headline(since);
    answer("Changes", "since", Some(what), look);
    let mut html = String::from("<dl class=\"answers\">\n");
    for Answer {
        about,
        anchor,
        said: [big, text],
        look,
    } in &answers
    {
        let class = if look.is_empty() {
            String::new()
        } else {
            format!(" class=\"{look}\"")
        };
        let _ = writeln!(
            html,
            "<div{class}><dt><a href=\"#{anchor}\">{about}</a></dt><dd><strong>{}</strong> {}</dd></div>",
            escape(big),
            escape(text)
        );
    }
    html.push_str("</dl>\n");
    let columns = [
        vec![(
            "cheapest",
            "Cheapest method for 1 % and 0.1 %",
            cheapest::panel(&costs),
        )],
        vec![
            // An arena has a section of its own.
            (
                "guests",
                "Other solvers",
                guests::panel(record).filter(|_| board.is_none()),
            ),
            (
                "nearest",
                "Gates nearest to their bounds",
                gates::nearest(record).map(|table| table.html()),
            ),
            ("since", "What changed", Some(since::panel(since))),
        ],
        vec![
            ("stable", "Stability at a glance", stability::panel(record)),
            (
                "fast",
                "Speed against the machine's limits",
                speed::panel(&speeds),
            ),
        ],
    ];
    // A column without a panel takes no room.
    let shown = |panels: &&Vec<(&str, &str, Option<String>)>| {
        panels.iter().any(|(.., body)| body.is_some())
    };
    let columns: Vec<_> = columns.iter().filter(shown).collect();
    let _ = writeln!(html, "<div class=\"panels columns-{}\">", columns.len());
    for panels in columns {
        html.push_str("<div>\n");
        for (id, heading, body) in panels {
            let Some(body) = body else { continue };
            let _ = write!(
                html,
                "<section class=\"panel\" aria-labelledby=\"{id}\">\n<h2 id=\"{id}\">{heading}</h2>\n{body}</section>\n"
            );
        }
        html.push_str("</div>\n");
    }
    html.push_str("</div>\n");
    html
}
