//! Pieces of HTML. Text from outside is escaped here and nowhere else.

use crate::record::details::Figure;
use crate::show::chart::{Scale, Series, Strength};
use crate::show::number;
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

/// A paragraph of text.
#[must_use]
pub fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// A part of the page that can be linked to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Anchor, one word.
    pub id: &'static str,
    /// Heading.
    pub title: String,
    /// HTML below the heading.
    pub body: String,
}

/// A table; the first column holds the names of the rows.
pub struct Table {
    caption: String,
    head: Vec<String>,
    rows: Vec<(Option<&'static str>, Vec<String>)>,
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

    /// Adds a row of text.
    pub fn push(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push((None, cells.into_iter().collect()));
    }

    /// Adds a row of a class of its own, such as `failed`.
    pub fn push_as(&mut self, class: &'static str, cells: impl IntoIterator<Item = String>) {
        self.rows.push((Some(class), cells.into_iter().collect()));
    }

    /// The table, in a frame that scrolls sideways by keyboard, touch or mouse where the page is narrow.
    #[must_use]
    pub fn html(&self) -> String {
        let caption = escape(&self.caption);
        let mut html = format!(
            "<div class=\"scroll\" role=\"region\" aria-label=\"{caption}\" tabindex=\"0\">\n<table>\n\
             <caption>{caption}</caption>\n<thead><tr>"
        );
        for cell in &self.head {
            let _ = write!(html, "<th scope=\"col\">{}</th>", escape(cell));
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
                let cell = escape(cell);
                if column == 0 {
                    let _ = write!(html, "<th scope=\"row\">{cell}</th>");
                } else {
                    let class = match cell.chars().count() {
                        _ if is_number(&cell) => " class=\"number\"",
                        0..SHORT => " class=\"short\"",
                        _ => "",
                    };
                    let _ = write!(html, "<td{class}>{cell}</td>");
                }
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</tbody>\n</table>\n</div>\n");
        html
    }
}

/// Whether a cell begins like a number, and is to be aligned as one.
fn is_number(cell: &str) -> bool {
    cell.trim_start_matches('-')
        .starts_with(|c: char| c.is_ascii_digit())
        && cell.len() < 24
}

/// Pictures, side by side where the page is wide enough.
#[must_use]
pub fn figures(all: &[Figure]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let inner: String = all.iter().map(figure).collect();
    format!("<div class=\"pair\">\n{inner}</div>\n")
}

/// A picture with its caption, and the numbers behind it to be unfolded.
#[must_use]
pub fn figure(shown: &Figure) -> String {
    let chart = &shown.chart;
    let mut table = Table::new(&chart.title, &["point", &chart.x.label, &chart.y.label]);
    let bands = |series: &&Series| series.strength != Strength::Band;
    for point in chart.series.iter().filter(bands).flat_map(|s| &s.points) {
        let y = match (&chart.y.scale, point.y) {
            (Scale::Names(names), Some(y)) => names.get(y as usize).cloned().unwrap_or_default(),
            (_, Some(y)) => number(y),
            (_, None) => "failed".to_owned(),
        };
        table.push([point.title.replace('\n', ", "), number(point.x), y]);
    }
    format!(
        "<figure>\n{}\n<figcaption>{}</figcaption>\n<details><summary>the numbers</summary>\n{}</details>\n\
         </figure>\n",
        chart.to_svg(),
        escape(&shown.caption),
        table.html()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_markup() {
        assert_eq!(
            escape("<script>\"a\" & 'b'</script>"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;"
        );
        let mut table = Table::new("<b>", &["<i>"]);
        table.push_as("failed", ["<u>".to_owned(), "-1.5".to_owned()]);
        let html = table.html();
        for tag in ["<b>", "<i>", "<u>"] {
            assert!(!html.contains(tag), "{html}");
        }
        assert!(html.contains("<td class=\"number\">-1.5</td>"));
    }
}
