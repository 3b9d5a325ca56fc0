//! Pieces of HTML. Text from outside is escaped here and nowhere else.

use crate::record::details::Figure;
use crate::show::chart::{Chart, Scale, Series, Strength};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Text with the characters of markup escaped.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Characters from which on a cell may be broken into lines.
const SHORT: usize = 24;
/// The same of a heading.
const SHORT_HEAD: usize = 12;

/// A paragraph of text; what stands between two backticks is code.
#[must_use]
pub fn paragraph(text: &str) -> String {
    // A number is not parted from its sign of percent.
    let text = &text.replace(" %", "\u{a0}%");
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return format!("<p>{}</p>\n", prose(text));
    }
    let mut html = String::from("<p>");
    for (number, part) in parts.into_iter().enumerate() {
        if number.is_multiple_of(2) {
            html.push_str(&prose(part));
        } else {
            let _ = write!(html, "<code>{}</code>", escape(part));
        }
    }
    html.push_str("</p>\n");
    html
}

/// Escaped text, in which no line ends between the sign of an exponent and its digits.
fn prose(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let number = word.trim_matches(|c: char| c.is_ascii_punctuation());
        if number.contains("e-") && number.parse::<f64>().is_ok() {
            format!("<span class=\"whole\">{}</span>", escape(word))
        } else {
            escape(word)
        }
    });
    words.collect::<Vec<_>>().join(" ")
}

/// A part of the page that can be linked to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Section {
    /// Anchor, one word.
    pub id: &'static str,
    /// Heading.
    pub title: String,
    /// HTML below the heading.
    pub body: String,
}

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    text: String,
    link: Option<String>,
    share: Option<f64>,
}

impl Cell {
    /// Text that leads to an anchor of the page.
    pub fn linked(text: impl Into<String>, anchor: impl Into<String>) -> Self {
        Self {
            link: Some(anchor.into()),
            ..text.into().into()
        }
    }

    /// Text with a bar behind it, so long a share of the cell.
    pub(crate) fn with_share(text: impl Into<String>, share: f64) -> Self {
        Self {
            share: share.is_finite().then_some(share.clamp(0.0, 1.0)),
            ..text.into().into()
        }
    }

    fn inner(&self) -> String {
        let text = escape(&self.text);
        let text = match &self.link {
            Some(anchor) => format!("<a href=\"#{}\">{text}</a>", escape(anchor)),
            None => text,
        };
        match self.share {
            Some(share) => format!(
                "<span class=\"bar\"><i style=\"width:{:.1}%\"></i></span>{text}",
                100.0 * share
            ),
            None => text,
        }
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self {
            text,
            ..Self::default()
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

/// A table; the first column holds the names of the rows. Where the page is narrow each row becomes a list of its cells with
/// the headings beside them, so that nothing is cut.
pub struct Table {
    caption: String,
    head: Vec<String>,
    rows: Vec<(Option<&'static str>, Vec<Cell>)>,
}

impl Table {
    /// An empty table with these headings.
    #[must_use]
    pub fn new(caption: &str, head: &[&str]) -> Self {
        Self {
            caption: caption.to_owned(),
            head: head.iter().map(|&cell| cell.to_owned()).collect(),
            rows: vec![],
        }
    }

    /// True if it has no rows.
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Adds a row.
    pub fn push<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        self.rows
            .push((None, cells.into_iter().map(Into::into).collect()));
    }

    /// Adds a row of a class of its own, such as `failed`.
    pub fn push_as<C: Into<Cell>>(
        &mut self,
        class: &'static str,
        cells: impl IntoIterator<Item = C>,
    ) {
        self.rows
            .push((Some(class), cells.into_iter().map(Into::into).collect()));
    }

    /// True for a column with a number in it.
    fn is_of_numbers(&self, column: usize) -> bool {
        let mut cells = self.rows.iter().filter_map(|(_, cells)| cells.get(column));
        cells.any(|cell| is_number(&cell.text))
    }

    /// The table, in a frame that scrolls sideways by keyboard, touch or mouse should the page be narrower than it.
    #[must_use]
    pub fn html(&self) -> String {
        let caption = escape(&self.caption);
        let mut html = format!(
            "<div class=\"scroll\" role=\"region\" aria-label=\"{caption}\" tabindex=\"0\">\n<table>\n\
             <caption>{caption}</caption>\n<thead><tr>"
        );
        for (column, cell) in self.head.iter().enumerate() {
            let is_short = cell.chars().count() < SHORT_HEAD;
            let class = match (is_short, column > 0 && self.is_of_numbers(column)) {
                (true, true) => " class=\"short number\"",
                (true, false) => " class=\"short\"",
                (false, true) => " class=\"number\"",
                (false, false) => "",
            };
            let _ = write!(html, "<th scope=\"col\"{class}>{}</th>", escape(cell));
        }
        html.push_str("</tr></thead>\n<tbody>\n");
        for (class, cells) in &self.rows {
            match class {
                Some(class) => {
                    let _ = write!(html, "<tr class=\"{class}\">");
                }
                None => html.push_str("<tr>"),
            }
            for (column, cell) in cells.iter().enumerate() {
                let inner = cell.inner();
                if column == 0 {
                    let _ = write!(html, "<th scope=\"row\">{inner}</th>");
                    continue;
                }
                let class = match cell.text.chars().count() {
                    _ if is_number(&cell.text) => " class=\"number\"",
                    // What a column of numbers lacks stands where they stand.
                    _ if cell.text == "-" && self.is_of_numbers(column) => " class=\"number\"",
                    0..SHORT => " class=\"short\"",
                    _ => "",
                };
                let head = self.head.get(column).map_or("", String::as_str);
                let label = escape(head);
                let _ = write!(html, "<td{class} data-label=\"{label}\">{inner}</td>");
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</tbody>\n</table>\n</div>\n");
        html
    }
}

/// True if a cell is a number, with its unit or out of another, and is to be aligned as one.
fn is_number(cell: &str) -> bool {
    let first = cell.split_whitespace().next().unwrap_or_default();
    let of_number = |c: char| c.is_ascii_digit() || ".,+-e×%".contains(c);
    let words = cell.split_whitespace();
    let others = words.filter(|word| !word.chars().all(of_number)).count();
    first.contains(|c: char| c.is_ascii_digit())
        && first.chars().all(of_number)
        && others <= 1
        && cell.len() < SHORT
}

/// Content behind a line that unfolds it.
#[must_use]
pub(crate) fn folded(summary: &str, body: &str) -> String {
    format!(
        "<details><summary>{}</summary>\n{body}</details>\n",
        escape(summary)
    )
}

/// The pictures of a page, each with a title of its own.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    titles: BTreeSet<String>,
}

impl Pictures {
    /// Pictures that belong to something of that name, side by side where the page is wide enough.
    #[must_use]
    pub fn several(&mut self, of: &str, all: &[Figure]) -> String {
        if all.is_empty() {
            return String::new();
        }
        let inner: String = all.iter().map(|figure| self.one(of, figure)).collect();
        format!("<div class=\"pair\">\n{inner}</div>\n")
    }

    /// A picture with its caption, and the numbers behind it to be unfolded. Its title says what it belongs to, and is not
    /// that of another picture.
    #[must_use]
    pub fn one(&mut self, of: &str, shown: &Figure) -> String {
        let mut chart = shown.chart.clone();
        if !chart.title.contains(of) {
            chart.title = format!("{of}: {}", chart.title);
        }
        if self.titles.contains(&chart.title) {
            // What tells two runs apart stands in the caption.
            let (_, run) = shown.caption.rsplit_once(", ").unwrap_or_default();
            chart.title = format!("{}, {}", chart.title, run.trim_end_matches('.'));
        }
        let title = chart.title.clone();
        let mut number = 1;
        while self.titles.contains(&chart.title) {
            number += 1;
            chart.title = format!("{title} ({number})");
        }
        self.titles.insert(chart.title.clone());
        html_of(&chart, &shown.caption)
    }
}

fn html_of(chart: &Chart, caption: &str) -> String {
    let mut table = Table::new(&chart.title, &["point", &chart.x.label, &chart.y.label]);
    let bands = |series: &&Series| series.strength != Strength::Band;
    for point in chart.series.iter().filter(bands).flat_map(|s| &s.points) {
        let y = match (&chart.y.scale, point.y) {
            (Scale::Names(names), Some(y)) => names.get(y as usize).cloned().unwrap_or_default(),
            (_, Some(y)) => chart.y.format.written(y),
            (_, None) => "failed".to_owned(),
        };
        let x = chart.x.format.written(point.x);
        table.push([point.title.replace('\n', ", "), x, y]);
    }
    let numbers = format!(
        "<details class=\"numbers\"><summary>the numbers</summary>\n{}</details>\n",
        table.html()
    );
    figure(chart, caption, &numbers)
}

fn figure(chart: &Chart, caption: &str, more: &str) -> String {
    format!(
        "<figure>\n{}\n<figcaption>{}</figcaption>\n{more}</figure>\n",
        chart.to_svg(),
        escape(caption),
    )
}

/// Pictures side by side where the page is wide enough, without the numbers behind them, which a file beside the page has.
#[must_use]
pub(crate) fn drawn(charts: &[Chart]) -> String {
    let inner: String = charts
        .iter()
        .map(|chart| figure(chart, &chart.description, ""))
        .collect();
    format!("<div class=\"pair\">\n{inner}</div>\n")
}
