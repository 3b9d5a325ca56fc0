//! The plan of each scene: what was kept, what was left out, and why.

use super::html::{Section, Table, escape};
use crate::record::Record;
use crate::record::details::PlanDetail;
use std::fmt::Write as _;

/// The section, where the record holds plans.
pub fn section(record: &Record) -> Option<Section> {
    let plans = &record.details.plans;
    if plans.is_empty() {
        return None;
    }
    let mut body = String::from(
        "<p>A scene pays for what it uses: what is left out is never called, and its fields are never \
         allocated.</p>\n",
    );
    for plan in plans {
        push(&mut body, plan);
    }
    Some(Section {
        id: "plans",
        title: "What each scene needs".to_owned(),
        body,
    })
}

fn push(body: &mut String, detail: &PlanDetail) {
    let plan = &detail.plan;
    let count = |key: &str| plan[key].as_array().map_or(0, Vec::len);
    let _ = writeln!(
        body,
        "<details><summary>{}: {} kept, {} left out, {} bytes per particle, {} per node</summary>",
        escape(&detail.scene),
        count("kept"),
        count("left_out"),
        plan["bytes_per_particle"],
        plan["bytes_per_node"],
    );
    let mut table = Table::new(&detail.scene, &["stage or field", "", "because"]);
    for (key, class, word) in [("kept", "passed", "kept"), ("left_out", "", "left out")] {
        for entry in plan[key].as_array().into_iter().flatten() {
            let said = |key: &str| entry[key].as_str().unwrap_or_default().to_owned();
            let cells = [
                format!("{}: {}", said("group"), said("name")),
                word.to_owned(),
                said("because"),
            ];
            if class.is_empty() {
                table.push(cells);
            } else {
                table.push_as(class, cells);
            }
        }
    }
    body.push_str(&table.html());
    body.push_str("</details>\n");
}
