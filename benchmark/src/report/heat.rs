//! The time to an error of 1 % of each case with each method, as a map.

use super::cheapest::Costs;
use super::html::escape;
use crate::precision::costs::TIE;
use std::fmt::Write as _;

/// Times over the least of a case up to which a cell has each shade, the darkest first.
const SHADES: [f64; 3] = [TIE, 2.0, 4.0];

/// The map, of the first error of each case that some method brings to 1 %.
#[must_use]
pub(super) fn map(all: &[&Costs]) -> Option<String> {
    let mut methods: Vec<&str> = vec![];
    for line in all.iter().flat_map(|costs| &costs.lines) {
        if !methods.contains(&line.method.as_str()) {
            methods.push(&line.method);
        }
    }
    let mut rows: Vec<(f64, &Costs)> = all
        .iter()
        .filter_map(|costs| Some((costs.cheapest(0)?.1, *costs)))
        .collect();
    rows.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    if rows.is_empty() {
        return None;
    }
    let mut html = "<table class=\"map heat\"><caption>Milliseconds of processor time to an error of 1 %, the darker the \
                    nearer to the least of the case; –: not reached</caption>\n<thead><tr><th></th>"
        .to_owned();
    for method in &methods {
        let words: Vec<String> = method.split(' ').map(escape).collect();
        let _ = write!(
            html,
            "<th scope=\"col\">{}</th>",
            words.join("<br>").replace("<br>!", "&nbsp;!")
        );
    }
    html.push_str("</tr></thead><tbody>\n");
    for (least, costs) in rows {
        let name = escape(&costs.case);
        let _ = write!(
            html,
            "<tr><th scope=\"row\"><a href=\"#case-{name}\">{name}</a></th>"
        );
        for method in &methods {
            let line = costs.lines.iter().find(|line| line.method == *method);
            match line.and_then(|line| line.seconds[0]) {
                None => html.push_str("<td class=\"none\">–</td>"),
                Some(seconds) => {
                    let shade = SHADES
                        .iter()
                        .position(|most| seconds <= most * least)
                        .unwrap_or(SHADES.len());
                    let times = seconds / least;
                    let _ = write!(
                        html,
                        "<td class=\"heat-{shade}\" title=\"{name}, {}: {times:.1} times the least\">{}</td>",
                        escape(method),
                        milliseconds(seconds)
                    );
                }
            }
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table>\n");
    Some(html)
}

/// A time, given in seconds, as milliseconds in two or three digits.
#[must_use]
pub fn milliseconds(seconds: f64) -> String {
    let ms = 1e3 * seconds;
    match ms {
        _ if ms < 1.0 => format!("{ms:.2}").trim_start_matches('0').to_owned(),
        _ if ms < 10.0 => format!("{ms:.1}"),
        _ if ms < 1e4 => format!("{ms:.0}"),
        _ => format!("{:.0}k", 1e-3 * ms),
    }
}
