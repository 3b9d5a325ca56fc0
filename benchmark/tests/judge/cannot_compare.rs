//! Whatever cannot be compared is never green.

use crate::judge::synthetic::{compare, record, sample, steady, steady_with};
use proctor_benchmark::judge::{self, Comparison, Rules, Verdict, noise};
use proctor_benchmark::record::{Record, Row};
use serde_json::json;

/// Checks that the comparison is refused, and says these words.
fn refused(comparison: &Comparison, words: &str) {
    assert_eq!(comparison.verdict(), Verdict::CannotCompare, "{words}");
    let reasons = comparison.findings.iter().flat_map(|f| &f.reasons);
    let mut said = comparison.obstacles.iter().chain(reasons);
    assert!(
        said.any(|line| line.contains(words)),
        "{words}: {comparison:?}"
    );
}

fn base() -> Record {
    record(steady_with(
        "a",
        1.0,
        &[("error_l2", 0.1), ("particles", 64.0)],
    ))
}

fn with(key: &str, value: serde_json::Value) -> Record {
    let mut head = base();
    head.context[key] = value;
    head
}

#[test]
fn the_same_record_compares() {
    assert_eq!(compare(&base(), &base()).verdict(), Verdict::Fine);
}

#[test]
fn another_machine() {
    for (key, value) in [
        ("cpu_model", json!("another")),
        ("lanes", json!("none")),
        ("num_cpus", json!(4096)),
        ("cores_physical", json!(4096)),
    ] {
        refused(
            &compare(&base(), &with(key, value.clone())),
            "another machine",
        );
        // Errors do not depend on the machine.
        let rules = Rules {
            ignore_time: true,
            ..Rules::default()
        };
        let errors = judge::compare(&base(), &with(key, value), &rules);
        assert_eq!(errors.verdict(), Verdict::Fine, "{key}");
    }
    let mut unknown = base();
    let context = unknown.context.as_object_mut().expect("an object");
    context.insert("cpu_model".to_owned(), json!("known"));
    let mut silent = unknown.clone();
    silent
        .context
        .as_object_mut()
        .expect("an object")
        .remove("cpu_model");
    refused(&compare(&silent, &unknown), "processor unknown in BASE");
}

#[test]
fn another_build() {
    refused(
        &compare(&base(), &with("library_build_type", json!("other"))),
        "build type",
    );
    let native = with("target_features_compiled", json!("avx512f"));
    refused(&compare(&base(), &native), "target features");
}

#[test]
fn instructions_of_other_lanes() {
    let counted = || record(steady_with("a", 1.0, &[("instructions", 1e6)]));
    let mut other = counted();
    other.context["lanes"] = json!("none");
    let rules = Rules {
        ignore_time: true,
        ..Rules::default()
    };
    refused(&judge::compare(&counted(), &other, &rules), "lanes");
}

#[test]
fn an_interrupted_record() {
    let mut incomplete = base();
    incomplete.set_incomplete(true);
    refused(&compare(&base(), &incomplete), "HEAD is incomplete");
    refused(&compare(&incomplete, &base()), "BASE is incomplete");
}

#[test]
fn a_case_that_is_missing_in_head() {
    let two = record(steady("a", 1.0).into_iter().chain(steady("b", 1.0)));
    refused(&compare(&two, &record(steady("a", 1.0))), "missing in HEAD");
}

#[test]
fn times_of_another_number_of_threads() {
    let mut rows = steady("a", 1.0);
    for row in &mut rows {
        row.threads = 2;
    }
    refused(
        &compare(&record(steady("a", 1.0)), &record(rows)),
        "another number of threads, 1 in BASE, 2 in HEAD",
    );
}

#[test]
fn a_number_that_only_one_of_them_has() {
    let more = record(steady_with(
        "a",
        1.0,
        &[("error_l2", 0.1), ("error_new", 0.1), ("particles", 64.0)],
    ));
    refused(&compare(&base(), &more), "error_new is 0.1 in HEAD");
    refused(&compare(&more, &base()), "error_new is missing in HEAD");
}

#[test]
fn an_error_that_is_missing_in_head() {
    let head = record(steady_with("a", 1.0, &[("particles", 64.0)]));
    refused(&compare(&base(), &head), "error_l2 is missing in HEAD");
}

#[test]
fn another_problem_under_the_same_name() {
    let head = record(steady_with(
        "a",
        1.0,
        &[("error_l2", 0.1), ("particles", 512.0)],
    ));
    refused(&compare(&base(), &head), "another problem: particles");
}

#[test]
fn fewer_than_ten_passes() {
    let nine: Vec<Row> = (0..9).map(|pass| sample("a", pass, 0, 1.0)).collect();
    refused(
        &compare(&record(nine.clone()), &record(nine)),
        "9 passes in common, at least 10 are needed",
    );
    let two: Vec<Row> = (0..2).map(|pass| sample("a", pass, 0, 1.0)).collect();
    refused(
        &compare(&record(two.clone()), &record(two)),
        "2 passes in common",
    );
    let one: Vec<Row> = (0..9).map(|r| sample("a", 0, r, 1.0)).collect();
    refused(
        &compare(&record(one.clone()), &record(one)),
        "1 pass in common",
    );
}

#[test]
fn a_time_on_one_side_only() {
    let untimed = record([Row::sample("a", 0, 1)]);
    refused(
        &compare(&record(steady("a", 1.0)), &untimed),
        "HEAD has no time",
    );
    refused(
        &compare(&untimed, &record(steady("a", 1.0))),
        "BASE has no time",
    );
}

#[test]
fn nothing_in_common() {
    let a = record(steady("a", 1.0));
    refused(&compare(&record([]), &a), "nothing to compare");
    let bare = record([Row::sample("a", 0, 1)]);
    refused(&compare(&bare, &bare), "nothing to compare");
    let mut failed = Row::sample("a", 0, 1);
    failed.fail("as ever");
    let failed = record([failed]);
    refused(&compare(&failed, &failed), "nothing to compare");
}

#[test]
fn it_outranks_what_got_worse() {
    let two = record(steady("a", 1.0).into_iter().chain(steady("b", 1.0)));
    refused(&compare(&two, &record(steady("a", 2.0))), "missing in HEAD");
}

#[test]
fn noise_of_another_machine_or_none_at_all() {
    let judged = |noise: &Record| {
        let rules = Rules {
            noise: Some(noise),
            ..Rules::default()
        };
        judge::compare(&base(), &base(), &rules)
    };
    refused(&judged(&base()), "holds no bands");
    let mut bands = base();
    bands.rows = noise::bands(&[base(), base()], 12).expect("bands");
    assert_eq!(judged(&bands).verdict(), Verdict::Fine);
    bands.context["cpu_model"] = json!("another");
    refused(&judged(&bands), "noise record: another machine");
}

#[test]
fn noise_that_would_hide_anything() {
    let judged = |band: f64| {
        let mut bands = base();
        bands.rows = noise::bands(&[base(), base()], 12).expect("bands");
        bands.rows[0].count("noise_band", band);
        let rules = Rules {
            noise: Some(&bands),
            ..Rules::default()
        };
        judge::compare(&base(), &base(), &rules)
    };
    assert_eq!(judged(0.25).verdict(), Verdict::Fine);
    refused(&judged(0.26), "the noise hides every change below 52 %");
}
