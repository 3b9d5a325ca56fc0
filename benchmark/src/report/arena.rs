//! The arena, where the record has one: who took part, what an error costs each, and a chart for each case.

use super::html::{Pictures, Section, Table, folded, paragraph};
use crate::arena::{Board, speed};
use crate::record::Record;
use crate::record::details::Figure;
use crate::show;
use crate::show::figures::{arena_charts, arena_legend};

/// Answer of the first screen: who was measured.
#[must_use]
pub fn headline(board: &Board) -> [String; 2] {
    let others: Vec<&str> = board
        .solvers
        .iter()
        .filter(|solver| !Board::is_own(&solver.name) && solver.skipped.is_none())
        .map(|solver| solver.name.as_str())
        .collect();
    [
        format!("{} cases", board.cases.len()),
        format!("beside this program: {}", others.join(", ")),
    ]
}

/// The section.
#[must_use]
pub fn section(record: &Record, pictures: &mut Pictures) -> Option<Section> {
    let mut body = String::new();
    let speeds = speed::speeds(record);
    if !speeds.is_empty() {
        let caption = "CPU per particle and step (ns) of a flying neo-Hookean block";
        body.push_str(&as_html(caption, &show::arena::speed_table(&speeds)));
    }
    if let Some(board) = Board::of(record) {
        body.push_str(&paragraph(
            "Times are CPU times of whole processes, less the CPU of a free fall, which is the start of a solver. All solvers get the \
             same scenes and meshes; errors are those of displacement or velocity against the exact solution.",
        ));
        let caption = "Who took part; over ours: CPU to 1 % over the least of Proctor's methods";
        body.push_str(&as_html(caption, &show::arena::solvers(&board)));
        let charts = arena_charts(&board).into_iter().map(|mut chart| {
            chart.legend = arena_legend(&board);
            Figure {
                caption: chart.description.clone(),
                chart,
            }
        });
        let charts: Vec<Figure> = charts.collect();
        // Pictures first: on a narrow page each line of the table is a block, and a board of all cases has a hundred of them.
        body.push_str(&pictures.several("Arena", &charts));
        if board.judged().next().is_some() {
            let caption = "CPU to an error, and the smallest error reached";
            body.push_str(&as_html(caption, &show::arena::cases(&board, true)));
        }
        if !board.reports.is_empty() {
            body.push_str(&as_html(
                show::arena::REPORTS,
                &show::arena::reports(&board),
            ));
        }
        let reasons: String = show::arena::reasons(&board)
            .iter()
            .map(|reason| paragraph(reason))
            .collect();
        if !reasons.is_empty() {
            body.push_str(&folded("failed or skipped", &reasons));
        }
    }
    (!body.is_empty()).then(|| Section {
        id: "arena",
        title: "Arena: solvers by case".to_owned(),
        body,
    })
}

/// A table of text as one of a page.
fn as_html(caption: &str, table: &show::Table) -> String {
    let mut lines = table.lines().iter();
    let head: Vec<&str> = lines
        .next()
        .map_or_else(Vec::new, |line| line.iter().map(String::as_str).collect());
    let mut html = Table::new(caption, &head);
    let mut case = String::new();
    for line in lines {
        let mut cells = line.clone();
        cells.resize(head.len(), String::new());
        // Rows can be read alone where the page is narrow.
        if line.len() == 1 && head.first().is_some_and(|first| first.starts_with("case")) {
            case.clone_from(&line[0]);
            continue;
        }
        if !case.is_empty() {
            cells[0] = format!("{case}, {}", line[0].trim_start());
        }
        let failed = cells.iter().any(|cell| cell == "failed");
        html.push_as(if failed { "failed" } else { "" }, cells);
    }
    html.html()
}
