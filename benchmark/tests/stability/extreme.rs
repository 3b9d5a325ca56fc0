//! Rows of extreme scenes, and what a record keeps of them.

use proctor_benchmark::measure::Spent;
use proctor_benchmark::record::details::GateDetail;
use proctor_benchmark::stability::extreme::{ExtremeDetail, RowResult, try_all};
use proctor_verification::stability::extreme::{Extreme, Finding};

static ROWS: [Extreme; 2] = [
    Extreme {
        name: "panics",
        what: "a row with a fault of its own",
        required: "the others go on",
        cause: Some("it was made so"),
        judge: || panic!("out of {}", "bounds"),
    },
    Extreme {
        name: "refused",
        what: "nothing",
        required: "a reason",
        cause: Some("not shown where nothing fails"),
        judge: || {
            Ok(Finding {
                refusals: vec!["no".to_owned()],
                ..Finding::default()
            })
        },
    },
];

#[test]
fn a_row_that_panics_has_failed_and_the_others_go_on() {
    let rows: Vec<&'static Extreme> = ROWS.iter().collect();
    let mut details: Vec<ExtremeDetail> = vec![];
    try_all(&rows, 1, &|| true, |tried| details.push((&tried).into()));
    let [panicked, refused] = &details[..] else {
        panic!("{details:?}");
    };
    assert!(!panicked.passed && refused.passed);
    assert_eq!(
        panicked.unexpected.as_deref(),
        Some("panicked: out of bounds")
    );
    assert_eq!(panicked.cause.as_deref(), Some("it was made so"));
    assert_eq!(
        (refused.ending.as_str(), &refused.cause),
        ("refused", &None)
    );
}

#[test]
fn the_worst_gate_is_the_nearest_to_its_bound() {
    let gate = |name: &str, value: Option<f64>, relation: &str, bound: f64| GateDetail {
        name: name.to_owned(),
        value,
        relation: relation.to_owned(),
        bound,
        reason: String::new(),
        passed: true,
    };
    let mut detail = ExtremeDetail::from(&RowResult {
        row: &ROWS[1],
        outcome: Ok(Finding::default()),
        spent: Spent::default(),
    });
    assert_eq!(detail.worst(), None);
    detail.gates = vec![
        gate("nothing of nothing", Some(0.0), "at most", 0.0),
        gate("half", Some(0.5), "at most", 1.0),
        gate("four fifths", Some(5.0), "at least", 4.0),
    ];
    assert_eq!(
        detail.worst().map(|gate| gate.name.as_str()),
        Some("four fifths")
    );
    detail.gates.push(gate("no number", None, "at most", 1.0));
    assert_eq!(
        detail.worst().map(|gate| gate.name.as_str()),
        Some("no number")
    );
}
