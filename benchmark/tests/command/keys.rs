//! `proctor keys`: every key in a table, one in full, the nearest where there is none.

use crate::command::support::{code, proctor, stderr, stdout};

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

/// Words of other programs, of books and of the command: each says which key or verb does it here.
#[test]
fn words_from_elsewhere_are_answered() {
    for (word, key, answer) in [
        ("k0", "body.initial_stress.ratio", "`ratio`"),
        ("dem", "terrain_contact.stl_mesh", "`terrain_contact`"),
        ("base_motion", "earthquake.file", "`earthquake`"),
        ("restart", "", "--restart"),
        ("load_state", "", "--restart"),
        ("stage", "stages", "`initial_state`"),
        ("diameter", "body.radius", "half of the diameter"),
        ("extrude_direction", "body.axis", "\"extruded_polygon\""),
        ("polygon_2d", "body.type", "\"extruded_polygon\""),
        ("particles_from_file", "body.type", "`file`"),
        ("youngs_modulus", "material.young", "`young`"),
    ] {
        let output = proctor(&["keys", word]);
        assert_eq!(code(&output), 0, "{word}: {}", stderr(&output));
        let text = stdout(&output);
        assert!(
            text.starts_with(if key.is_empty() { "`" } else { key }),
            "{word}: {text}"
        );
        assert!(text.contains(answer), "{word}: {text}");
    }
    // All that are answered in a scene are answered here.
    for other in proctor_files::json::all_elsewhere() {
        for word in other.words {
            let output = proctor(&["keys", word]);
            assert_eq!(code(&output), 0, "{word}: {}", stderr(&output));
        }
    }
}

#[test]
fn a_block_within_another_is_told_with_its_keys() {
    for (word, keys) in [
        (
            "initial_stress",
            &["isotropic", "ratio", "level", "surcharge"][..],
        ),
        ("body.initial_stress", &["ratio", "level", "surcharge"]),
        ("boundary_conditions", &["plane_X0", "plane_Yn"]),
        ("mesh", &["cells_number", "origin"]),
    ] {
        let text = stdout(&proctor(&["keys", word]));
        for key in keys {
            assert!(text.contains(key), "{word}, {key}: {text}");
        }
    }
}

/// A key that laws take for different things shows each of them with its law.
#[test]
fn a_key_with_two_meanings_shows_both() {
    let text = stdout(&proctor(&["keys", "yield_stress"]));
    for said in [
        "yields in uniaxial tension (`type` \"von_mises\")",
        "Shear stress up to which the fluid does not flow (`type` \"bingham\")",
    ] {
        assert!(text.contains(said), "{text}");
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
