//! `proctor keys`: every key in a table, one in full, the nearest where there is none.

use crate::support::{code, proctor, stderr, stdout};

#[test]
fn all_keys_are_in_one_table_by_their_blocks() {
    let output = proctor(&["keys"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for line in text.lines() {
        assert!(line.chars().count() <= 110, "{line}");
    }
    insta::assert_snapshot!(text);
}

#[test]
fn one_key_is_told_in_full() {
    let told = |word: &str| {
        let output = proctor(&["keys", word]);
        assert_eq!(code(&output), 0, "{word}: {}", stderr(&output));
        stdout(&output)
    };
    insta::assert_snapshot!(
        [
            "cells_dimension",
            "young",
            "cpGIMP",
            "body.radius",
            "critical_gap"
        ]
        .map(told)
        .join("----\n")
    );
    // Every block that has it.
    let text = told("prescribed_velocity");
    for path in ["body", "rigid_line", "rigid_surface", "terrain_contact"] {
        assert!(
            text.contains(&format!("{path}.prescribed_velocity")),
            "{text}"
        );
    }
    // A block is told with its keys, a part of a name finds all that have it.
    assert!(told("mesh").contains("cells_number"));
    assert!(told("stiffness").contains("contact.normal_stiffness"));
    assert!(told("plane_x0").contains("mesh.boundary_conditions.plane_X0"));
}

#[test]
fn usual_words_lead_to_their_keys() {
    for (word, key) in [
        ("E", "material.young"),
        ("rho", "material.density"),
        ("dt", "time_step"),
        ("frames", "results.print"),
        ("stress", "results.fields"),
    ] {
        let output = proctor(&["keys", word]);
        let text = stdout(&output);
        assert!(text.starts_with(key), "{word}: {text}");
    }
}

#[test]
fn a_word_that_is_no_key_is_answered_with_the_nearest() {
    let output = proctor(&["keys", "yuong"]);
    assert_eq!(code(&output), 2);
    assert_eq!(stdout(&output), "");
    let said = stderr(&output);
    assert!(said.contains("did you mean `young`"), "{said}");
    let output = proctor(&["keys", "qqqqqqqq"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("`proctor keys` lists them"));
}
