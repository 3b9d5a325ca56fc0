//! The plan of each scene: what was kept, what was left out, and why.

use super::html::{Section, Table, folded, paragraph};
use crate::record::Record;
use crate::record::details::PlanDetail;
use crate::show::rounded;

/// Text above plans.
const WHAT: &str = "A scene pays for what it uses: a stage that is left out is never called, and its fields are \
    never allocated.";

/// The plans of the scenes of a case, folded.
pub fn of_case(record: &Record, case: &str) -> String {
    let plans = record.details.plans.iter();
    plans.filter(|plan| is_of(plan, case)).map(one).collect()
}

/// The section of the plans that belong to no case of the record.
pub fn section(record: &Record) -> Option<Section> {
    let of_a_case = |plan: &&PlanDetail| {
        let cases = record.details.cases.iter();
        cases.clone().any(|case| is_of(plan, &case.name))
    };
    let plans: Vec<&PlanDetail> = record
        .details
        .plans
        .iter()
        .filter(|plan| !of_a_case(plan))
        .collect();
    (!plans.is_empty()).then(|| Section {
        id: "plans",
        title: "What each scene needs".to_owned(),
        body: plans.into_iter().map(one).collect(),
    })
}

/// A plan is called by its case and run.
fn is_of(plan: &PlanDetail, case: &str) -> bool {
    let rest = plan.scene.strip_prefix(case);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(", "))
}

fn one(detail: &PlanDetail) -> String {
    let plan = &detail.plan;
    let count = |key: &str| plan[key].as_array().map_or(0, Vec::len);
    let summary = format!(
        "needs of the scene ({}): {} parts kept, {} left out, {} bytes per particle, {} per node",
        detail.scene,
        count("kept"),
        count("left_out"),
        plan["bytes_per_particle"],
        plan["bytes_per_node"],
    );
    let caption = format!("Plan of {}", detail.scene);
    let mut table = Table::new(&caption, &["stage or field", "", "because"]);
    for (key, class, word) in [("kept", "passed", "kept"), ("left_out", "", "left out")] {
        for entry in plan[key].as_array().into_iter().flatten() {
            let said = |key: &str| entry[key].as_str().unwrap_or_default().to_owned();
            let cells = [
                format!("{}: {}", said("group"), said("name")),
                word.to_owned(),
                rounded(&said("because")),
            ];
            if class.is_empty() {
                table.push(cells);
            } else {
                table.push_as(class, cells);
            }
        }
    }
    folded(&summary, &(paragraph(WHAT) + &table.html()))
}
