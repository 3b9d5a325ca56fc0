//! The lines of cases on a terminal, and the verdict below them.

use proctor_benchmark::show::paint::Paint;
use proctor_benchmark::show::summary::{EarlierCases, Lines, Verdict, is_far, share};
use proctor_benchmark::suite::CaseRun;
use proctor_verification::case::{self, Gate, Verdict as CaseVerdict};
use std::time::Duration;

fn ran(number: usize, found: f64) -> CaseRun {
    let gate = Gate::at_most("error".to_owned(), found, 0.01, "a reason");
    CaseRun {
        case: case::all()[number],
        rungs: vec![],
        verdict: CaseVerdict {
            gates: vec![gate],
            ..CaseVerdict::default()
        },
        faults: vec![],
    }
}

fn said(
    cases: &[CaseRun],
    asked: usize,
    also_failed: &[&'static str],
    interrupted: bool,
) -> String {
    let verdict = Verdict {
        cases,
        kept: EarlierCases::default(),
        asked,
        also_failed,
        worse: false,
        interrupted,
        of_stability: None,
        took: Duration::from_millis(1500),
    };
    let mut text = vec![];
    verdict.line(Paint::NONE, &mut text).expect("written");
    String::from_utf8(text).expect("text")
}

#[test]
fn what_was_interrupted_never_passes() {
    let text = said(&[ran(0, 0.001)], 31, &[], true);
    assert_eq!(
        text,
        "! INTERRUPTED: 1 of 1 gates in 1 of 31 cases; the others were not run, 1.50 s\n"
    );
    let after = said(&[ran(0, 0.001)], 1, &[], true);
    assert!(
        after.contains("in 1 case; the cases after them were not finished"),
        "{after}"
    );
    let failed = said(&[ran(0, 1.0)], 2, &[], true);
    assert!(failed.starts_with("! INTERRUPTED: 0 of 1 gates in 1 of 2 cases"));
    assert!(failed.contains("; failed: boussinesq"), "{failed}");
}

#[test]
fn the_verdict_names_what_failed() {
    assert_eq!(
        said(&[ran(0, 0.001)], 1, &[], false),
        "✓ PASS: 1 of 1 gates in 1 case, 1.50 s\n"
    );
    let text = said(&[ran(0, 0.001), ran(1, 0.1)], 2, &["stability"], false);
    let name = case::all()[1].name();
    assert_eq!(
        text,
        format!("✗ FAIL: 1 of 2 gates in 2 cases; failed: {name}, stability, 1.50 s\n")
    );
    // No gate failed, and still nobody may take it for a pass.
    assert!(said(&[ran(0, 0.001)], 1, &["speed"], false).contains("FAIL: 1 of 1 gates"));
}

#[test]
fn a_case_is_a_line_and_all_of_it_where_it_failed() {
    let lines = Lines::new(Paint::NONE, ["boussinesq"]);
    let text = |found: f64| {
        let mut text = vec![];
        lines.case(&ran(0, found), &mut text).expect("written");
        String::from_utf8(text).expect("text")
    };
    let held = text(0.008);
    assert_eq!(held.lines().count(), 1, "{held}");
    assert!(
        held.starts_with("✓ boussinesq    1 of 1      80 %"),
        "{held}"
    );
    let failed = text(0.02);
    assert!(
        failed.starts_with("✗ boussinesq    0 of 1     200 %"),
        "{failed}"
    );
    for word in ["FAIL  error: 0.02, at most 0.01", "a reason"] {
        assert!(failed.contains(word), "{word}: {failed}");
    }
    let faulty = CaseRun {
        faults: vec!["a wrong stiffness breaks nothing".to_owned()],
        ..ran(0, 0.008)
    };
    let mut text = vec![];
    lines.case(&faulty, &mut text).expect("written");
    let text = String::from_utf8(text).expect("text");
    assert!(text.starts_with("✗ boussinesq    1 of 1"), "{text}");
    assert!(text.contains("a wrong stiffness breaks nothing"), "{text}");
    assert!(said(&[faulty], 1, &[], false).contains("; failed: boussinesq"));
}

#[test]
fn cases_far_from_their_bounds_share_a_paragraph() {
    let all = [ran(0, 0.001), ran(1, 0.0081), ran(2, 0.008), ran(3, 1.0)];
    assert_eq!(
        all.iter().map(is_far).collect::<Vec<_>>(),
        [true, false, true, false]
    );
    let lines = Lines::new(Paint::NONE, ["boussinesq"]);
    let mut text = vec![];
    lines.far(all.iter(), &mut text).expect("written");
    let [first, third] = [0, 2].map(|number| case::all()[number].name());
    assert_eq!(
        String::from_utf8(text).expect("text"),
        format!(
            "✓ 2 more cases, 2 of 2 gates, each within 80 % of its bound: {first},\n  {third}\n"
        )
    );
    let mut none = vec![];
    lines.far(all[1..2].iter(), &mut none).expect("written");
    assert!(none.is_empty());
}

#[test]
fn what_holds_is_never_told_as_the_whole_of_its_bound() {
    assert_eq!(share(0.0), "0 %");
    assert_eq!(share(0.804), "80 %");
    assert_eq!(share(0.998_24), "99.8 %");
    assert_eq!(share(0.999_99), "99.9 %");
    assert_eq!(share(1.0), "100.0 %");
    assert_eq!(share(1.000_1), "101 %");
    assert_eq!(share(12.0), "> 999 %");
    assert_eq!(share(f64::INFINITY), "> 999 %");
}
