//! Changes that were accepted, and the best value that a number ever had.

use crate::judge::synthetic::record;
use proctor_benchmark::judge::ledger::{ChangeKind, Ledger, Line};
use proctor_benchmark::judge::{self, Comparison, Rules, Verdict};
use proctor_benchmark::record::{Record, Row};
use tempfile::TempDir;

fn with(key: &str, value: f64) -> Record {
    let mut row = Row::sample("a", 0, 1);
    row.count("error_other", 1.0);
    row.count(key, value);
    let mut record = record([row]);
    record.context["ladders"] = "quick".into();
    record
}

fn line(number: &str, from: f64, to: f64, what: ChangeKind) -> Line {
    Line {
        ladder: "quick".to_owned(),
        case: "a".to_owned(),
        number: number.to_owned(),
        from: format!("{from:?}"),
        to: format!("{to:?}"),
        what,
        reason: "there is a reason".to_owned(),
        commit: "0123456789".to_owned(),
    }
}

fn compared(base: &Record, head: &Record, lines: Vec<Line>, strict: bool) -> Comparison {
    let ledger = Ledger::new(lines);
    let rules = Rules {
        ignore_time: true,
        ledger: Some(&ledger),
        strict,
        ..Rules::default()
    };
    judge::compare(base, head, &rules)
}

#[test]
fn an_accepted_change_is_fine_and_another_is_not() {
    let (base, head) = (with("error_u", 0.1), with("error_u", 0.2));
    let judged = |lines| compared(&base, &head, lines, false).verdict();
    assert_eq!(judged(vec![]), Verdict::Worse);
    assert_eq!(
        judged(vec![line("error_u", 0.1, 0.2, ChangeKind::Worse)]),
        Verdict::Fine
    );
    for other in [
        line("error_v", 0.1, 0.2, ChangeKind::Worse),
        line("error_u", 0.1, 0.19, ChangeKind::Worse),
        line("error_u", 0.11, 0.2, ChangeKind::Worse),
        Line {
            case: "b".to_owned(),
            ..line("error_u", 0.1, 0.2, ChangeKind::Worse)
        },
        Line {
            ladder: "full".to_owned(),
            ..line("error_u", 0.1, 0.2, ChangeKind::Worse)
        },
    ] {
        assert_eq!(judged(vec![other]), Verdict::Worse);
    }
    // Over several commits the lines lead from one to the other.
    let two = vec![
        line("error_u", 0.1, 0.15, ChangeKind::Worse),
        line("error_u", 0.15, 0.2, ChangeKind::Worse),
    ];
    assert_eq!(judged(two), Verdict::Fine);
}

#[test]
fn many_small_steps_do_not_slip_through() {
    // Each step is 0.9e-6 of itself, which sums in another order may do; each is in the ledger.
    let mut lines = vec![];
    let mut value: f64 = 0.1;
    let mut verdicts = vec![];
    for _ in 0..4 {
        let next = value * (1.0 + 0.9e-6);
        lines.push(line("error_u", value, next, ChangeKind::Better));
        let (base, head) = (with("error_u", value), with("error_u", next));
        verdicts.push(compared(&base, &head, lines.clone(), true).verdict());
        value = next;
    }
    assert_eq!(verdicts[0], Verdict::Fine);
    assert_eq!(verdicts[1..], [Verdict::Worse; 3]);
    // Until somebody takes it as what it is.
    lines.last_mut().expect("a line").what = ChangeKind::Worse;
    let before: f64 = lines[3].from.parse().expect("a number");
    let (base, head) = (with("error_u", before), with("error_u", value));
    assert_eq!(compared(&base, &head, lines, true).verdict(), Verdict::Fine);
}

#[test]
fn a_gain_is_kept() {
    // Better first, then back to where it was: equal to the first, but not to the best.
    let lines = vec![
        line("error_u", 0.2, 0.1, ChangeKind::Better),
        line("error_u", 0.1, 0.2, ChangeKind::Better),
    ];
    let comparison = compared(
        &with("error_u", 0.1),
        &with("error_u", 0.2),
        lines.clone(),
        false,
    );
    assert_eq!(comparison.verdict(), Verdict::Worse);
    let reasons = comparison.findings[0].reasons.join("; ");
    assert!(
        reasons.contains("worse than the best value ever accepted, 0.1"),
        "{reasons}"
    );
    // Even against a record that has it.
    let same = compared(&with("error_u", 0.2), &with("error_u", 0.2), lines, false);
    assert_eq!(same.verdict(), Verdict::Worse);
}

#[test]
fn a_value_is_judged_by_its_error_where_it_has_one() {
    let with_value = |value: f64, error: f64| {
        let mut record = with("error_u", error);
        record.rows[0].count("value_u", value);
        record
    };
    // The ledger knows other values; the error became better, and the value with it.
    let lines = vec![
        line("error_u", 0.2, 0.1, ChangeKind::Better),
        line("value_u", 1.2, 1.1, ChangeKind::Better),
    ];
    let comparison = compared(&with_value(1.1, 0.1), &with_value(1.05, 0.05), lines, false);
    assert_eq!(comparison.verdict(), Verdict::Fine);
    assert_eq!(comparison.findings[0].told.len(), 1);
}

#[test]
fn strictly_every_difference_needs_a_line() {
    let base = with("error_u", 0.1);
    for head in [
        with("error_u", 0.05),
        with("error_u", 0.1 * (1.0 + 1e-12)),
        with("error_v", 0.1),
    ] {
        assert_ne!(
            compared(&base, &head, vec![], true).verdict(),
            Verdict::Fine
        );
    }
    assert_eq!(
        compared(&base, &base, vec![], true).verdict(),
        Verdict::Fine
    );
    let better = line("error_u", 0.1, 0.05, ChangeKind::Better);
    assert_eq!(
        compared(&base, &with("error_u", 0.05), vec![better], true).verdict(),
        Verdict::Fine
    );
}

#[test]
fn a_ledger_reads_as_it_was_written_and_only_grows() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("ledger.csv");
    let empty = Ledger::default();
    empty.write(&path).expect("written");
    assert_eq!(Ledger::read(&path).expect("read"), empty);
    let with_reason = |reason: &str| Line {
        reason: reason.to_owned(),
        ..line("error_u", 1e-300, 0.1 + 0.2, ChangeKind::Worse)
    };
    let ledger = Ledger::new(vec![with_reason("a comma, a \"quote\"")]);
    ledger.write(&path).expect("written");
    let read = Ledger::read(&path).expect("read");
    assert_eq!(read, ledger);
    assert!(read.continues(&empty) && read.continues(&ledger));
    assert!(!read.continues(&Ledger::new(vec![with_reason("another")])));
    assert!(!empty.continues(&read));
}

#[test]
fn a_line_without_a_reason_is_refused() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("ledger.csv");
    let mut bare = line("error_u", 0.1, 0.2, ChangeKind::Worse);
    bare.reason = " ".to_owned();
    let ledger = Ledger::new(vec![line("error_u", 0.1, 0.2, ChangeKind::Worse), bare]);
    ledger.write(&path).expect("written");
    let error = Ledger::read(&path).expect_err("refused").to_string();
    assert!(
        error.contains("ledger.csv: line 3: no reason is given"),
        "{error}"
    );
    std::fs::write(&path, "a,b\n1,2\n").expect("written");
    let error = Ledger::read(&path).expect_err("refused").to_string();
    assert!(error.contains("accepted: lines of ladder, case"), "{error}");
}
