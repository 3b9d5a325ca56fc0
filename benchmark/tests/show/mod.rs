//! Numbers, words and tables for people.

mod case;
mod chart;
mod comparison;
mod drawing;
mod figures;
mod histogram;
mod paint;
mod particles;
mod refine;
mod summary;

use proctor_benchmark::show::{
    Table, bytes, filled, grouped, in_words, number, percent, rounded, seconds, shortened,
};

#[test]
fn numbers_read_well() {
    assert_eq!(grouped(0), "0");
    assert_eq!(grouped(999), "999");
    assert_eq!(grouped(1_000_000), "1 000 000");
    assert_eq!(number(0.0), "0");
    assert_eq!(number(0.278_746), "0.2787");
    assert_eq!(number(-12.5), "-12.5");
    assert_eq!(number(99_999.0), "99999");
    assert_eq!(number(1.0e-5), "1.000e-5");
    assert_eq!(number(f64::NAN), "NaN");
    assert_eq!(seconds(0.012_34), "12.3 ms");
    assert_eq!(seconds(125.0), "125 s");
    assert_eq!(bytes(1536), "1.5 KiB");
}

#[test]
fn errors_are_in_per_cent_with_three_digits() {
    assert_eq!(percent(0.004_567), "0.457 %");
    assert_eq!(percent(0.123_4), "12.3 %");
    assert_eq!(percent(2.5), "250 %");
    assert_eq!(percent(1e-9), "1.0e-7 %");
    assert_eq!(percent(0.0), "0 %");
    assert_eq!(percent(-0.123_4), "-12.3 %");
    assert_eq!(percent(-1e-9), "-1.0e-7 %");
    assert_eq!(percent(f64::NAN), "-");
}

#[test]
fn text_is_broken_at_blanks_alone() {
    let words = "a word that is longer than a line";
    assert_eq!(
        filled(words.split(' '), 6),
        ["a word", "that", "is", "longer", "than a", "line"]
    );
    assert_eq!(filled(words.split(' '), 100), [words]);
    assert_eq!(filled(["of two words", "of two words"], 5).len(), 2);
    assert_eq!(filled([], 5), [""]);
}

#[test]
fn long_numbers_of_a_sentence_are_rounded_and_nothing_else() {
    let said = "step 49, time 23.5 s: 2 closes on 1 by 0.023364106467191550 m, since 6.99999999999999e-3 s.";
    assert_eq!(
        rounded(said),
        "step 49, time 23.5 s: 2 closes on 1 by 0.02336 m, since 0.007 s."
    );
    for kept in [
        "12345678901234 particles",
        "h=0.25, v1.2.3-rc, 1e-5",
        "",
        "none",
    ] {
        assert_eq!(rounded(kept), kept);
    }
}

#[test]
fn long_names_lose_their_middle() {
    let name = "whole-step/two-bodies-3d/uGIMP/USL/FLIP/64000";
    let short = shortened(name, 29);
    assert_eq!(short.chars().count(), 29);
    let (head, tail) = short.split_once('…').expect("something is left out");
    assert!(name.starts_with(head) && name.ends_with(tail), "{short}");
    assert!(head.len().abs_diff(tail.len()) <= 1, "{short}");
    assert_eq!(shortened("short", 29), "short");
}

#[test]
fn long_sentences_end_after_a_word() {
    let sentence = "stress less that of the closed form, over it";
    assert_eq!(in_words(sentence, 32), "stress less that of the closed …");
    assert_eq!(in_words(sentence, 31), "stress less that of the …");
    assert_eq!(in_words("short", 5), "short");
}

#[test]
fn a_table_loses_the_columns_that_are_named() {
    let mut table = Table::new(["h", "steps", "error"]);
    table.push(["1/8", "7", "0.5"]);
    table.push(["1/16"]);
    let narrow = table.without(&["steps", "none"]);
    assert_eq!(narrow.to_string(), "  h     error\n  1/8     0.5\n  1/16\n");
}

#[test]
fn a_table_aligns_numbers_to_the_right() {
    let mut table = Table::new(["h", "error"]);
    table.push(["1/8", "0.5"]);
    table.push(["1/16"]);
    assert_eq!(table.to_string(), "  h     error\n  1/8     0.5\n  1/16\n");
}
