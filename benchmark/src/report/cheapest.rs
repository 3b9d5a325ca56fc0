//! The cheapest method for an error of 1 % and of 0.1 %, case by case, beside the default.

use super::heat;
use super::html::{Cell, Table, folded, paragraph};
pub use crate::precision::costs::Costs;
use crate::precision::costs::{most_often, times, winners};
use crate::show::number;
use crate::statistics::median;

/// Explanation of the words of a method, for a reader who sees them for the first time.
pub const METHODS: &str = "A method is three choices. Weighting function, by which particles meet the nodes of the grid: \
    linear, uGIMP (each particle a box of its first size), cpGIMP (a box that stretches with its material), B-spline \
    (quadratic). Time of the stress update: USL (last in a step), MUSL (last, from velocities mapped a second time), USF \
    (first). Transfer of velocities back to the particles: FLIP (increments), APIC and TPIC (an affine field per particle). \
    The default is uGIMP USL FLIP.";

/// The name of a case, as a link, with the error where it is not that of the displacement.
fn link(costs: &Costs) -> Cell {
    let text = if costs.measure == "displacement" {
        costs.case.clone()
    } else {
        format!("{} ({})", costs.case, costs.measure)
    };
    Cell::linked(text, format!("case-{}", costs.case))
}

/// The first error of each case, in the order of the record.
fn first_of_each(all: &[Costs]) -> Vec<&Costs> {
    let mut first: Vec<&Costs> = vec![];
    for costs in all {
        if !first.iter().any(|known| known.case == costs.case) {
            first.push(costs);
        }
    }
    first
}

/// Summary of the table in a number and a sentence.
#[must_use]
pub fn headline(all: &[Costs]) -> Option<[String; 2]> {
    let first = first_of_each(all);
    let reached: Vec<&&Costs> = first.iter().filter(|c| c.cheapest(0).is_some()).collect();
    let factors: Vec<f64> = reached.iter().filter_map(|c| c.factor(0)).collect();
    let (ranked, never) = winners(all, 0);
    let (names, count) = most_often(&ranked)?;
    let rest = format!(
        "most often {names} for {count} of {} errors (within 10 %: a tie, all count); none came so far for {never}",
        all.len()
    );
    Some(match median(&factors) {
        Some(factor) => [
            times(factor),
            format!(
                "as fast as the default in processor time, the cheapest method brings the error down to 1 % (median of cases); {rest}"
            ),
        ],
        None => [
            number(reached.len() as f64),
            format!("cases reach an error of 1 %, none of them with the default method; {rest}"),
        ],
    })
}

/// The panel of the first screen: the first error of each case, and the others folded.
#[must_use]
pub fn panel(all: &[Costs]) -> Option<String> {
    let first = first_of_each(all);
    if first.is_empty() {
        return None;
    }
    let mut html = heat::map(&first).unwrap_or_default();
    let (mut reached, mut missed): (Vec<&Costs>, Vec<&Costs>) =
        first.into_iter().partition(|c| c.cheapest(0).is_some());
    reached.sort_by(|a, b| {
        let key = |costs: &Costs| costs.factor(0).unwrap_or(0.0);
        key(b).total_cmp(&key(a))
    });
    let caption = "By case, the largest gain over the default method at 1 % first";
    let head = ["case", "for an error of 1 %", "for 0.1 %"];
    let mut table = Table::new(caption, &head);
    for costs in reached {
        let cells: [Cell; 3] = [link(costs), costs.said(0).into(), costs.said(1).into()];
        table.push(cells);
    }
    let explained = paragraph(
        "2.7×: 2.7 times as fast as the default method (uGIMP USL FLIP) in processor time, each refined until its error is so \
         small. Methods within 10 % of the least tie (=). The error is that of the displacement unless another is named, \
         relative to the exact solution. !: with this \
         method no time step is safe for every body.",
    );
    if !table.is_empty() {
        html.push_str(&folded(
            "the cheapest method of each case, and its gain over the default",
            &(table.html() + &explained),
        ));
    }
    if !missed.is_empty() {
        let mut table = Table::new(
            "Cases that no method brought below 1 % here, the smallest error first",
            &["case", "smallest error, and the method that gave it"],
        );
        missed.sort_by(|a, b| {
            let key = |costs: &Costs| costs.smallest().map_or(f64::INFINITY, |(_, error)| error);
            key(a).total_cmp(&key(b))
        });
        for costs in &missed {
            table.push([link(costs), costs.at_best().into()]);
        }
        let count = match missed.len() {
            1 => "1 case stays".to_owned(),
            n => format!("{n} cases stay"),
        };
        html.push_str(&folded(
            &format!("{count} above 1 % on the short meshes of this record"),
            &(table.html()
                + &paragraph("`proctor precision CASE` refines the mesh of a case further.")),
        ));
    }
    html.push_str(&folded("words of a method", &paragraph(METHODS)));
    Some(html)
}
