//! Texts that once ended the process, or never ended, each with what they were.

use super::outcome::{Outcome, outcome};

#[test]
fn a_billion_cells_are_refused_with_both_numbers() {
    let text = r#"{"time": 1, "mesh": {"cells_dimension": [1, 1, 1], "cells_number": [1000, 1000, 1000]},
"material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
"body": [{"type": "cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [1000, 1000, 1000]}]}"#;
    let Ok(Outcome::NotSetUp(message)) = outcome(text) else {
        panic!("{:?}", outcome(text));
    };
    assert!(
        message.contains("mesh.cells_number")
            && message.contains("60.4 GiB")
            && message.contains("64.0 MiB"),
        "{message}"
    );
}

/// The distance of a vertex from the outline was asked for before the corners were known to lie in the mesh.
#[test]
fn a_corner_so_far_away_that_its_edge_has_no_length_is_refused() {
    let text = r#"{"dimension": 2, "time": 1, "mesh": {"cells_dimension": [0.5, 0.5], "cells_number": [6, 6]},
"material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
"body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [1e200, 1], "point_p2": [2, 2],
"boundary": [[1, 1], [2, 1], [2, 2], [1, 2]]}]}"#;
    assert!(
        matches!(outcome(text), Ok(Outcome::Refused(_))),
        "{:?}",
        outcome(text)
    );
}

#[test]
fn a_segment_of_a_nanometre_is_refused() {
    let text = r#"{"dimension": 2, "time": 1, "mesh": {"cells_dimension": [1, 1], "cells_number": [6, 6]},
"material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
"body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [1, 1], "point_p2": [2, 2],
"boundary_segment": 1e-9}]}"#;
    let Ok(Outcome::Refused(message)) = outcome(text) else {
        panic!("{:?}", outcome(text));
    };
    assert!(message.contains("boundary_segment"), "{message}");
}

/// Each row of the lattice was visited before any memory was asked for: 10^9 of them, without a word.
#[test]
fn rows_of_particles_beyond_all_memory_are_not_visited() {
    let text = |count: u32| {
        format!(
            r#"{{"dimension": 2, "time": 1, "mesh": {{"cells_dimension": [1, 1], "cells_number": [10, 10]}},
"material": [{{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}}],
"body": [{{"type": "disc", "id": 1, "material_id": 1, "center": [5, 5], "radius": 5,
"particles_per_cell": {count}}}]}}"#
        )
    };
    let found = outcome(&text(100));
    let Ok(Outcome::NotSetUp(message)) = found else {
        panic!("{found:?}");
    };
    assert!(
        message.contains("7.8540e5 particles would need"),
        "{message}"
    );
    let found = outcome(&text(100_000_000));
    let Ok(Outcome::Refused(message)) = found else {
        panic!("{found:?}");
    };
    assert!(
        message.contains("a whole number from 1 to 100"),
        "{message}"
    );
}

/// The time plus such a step is the time, so a run would never end.
#[test]
fn a_step_that_does_not_move_the_time_on_is_an_error() {
    let text = r#"{"dimension": 2, "time": 1, "time_step": 5e-324,
"mesh": {"cells_dimension": [1, 1], "cells_number": [10, 10]},
"material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
"body": [{"type": "disc", "id": 1, "material_id": 1, "center": [5, 5], "radius": 2}]}"#;
    assert!(
        matches!(outcome(text), Ok(Outcome::Refused(_))),
        "{:?}",
        outcome(text)
    );
}

/// Every problem was looked for in the text from its beginning: a minute for so many.
#[test]
fn thousands_of_problems_are_told_in_a_moment() {
    let rows = vec!["[99, 99, 1]"; 50_000].join(", ");
    let text = format!(
        r#"{{"dimension": 2, "time": 1, "mesh": {{"cells_dimension": [1, 1], "cells_number": [10, 10]}},
"material": [{{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}}],
"body": [{{"type": "particles", "id": 1, "material_id": 1, "particles": [{rows}]}}]}}"#
    );
    let Ok(Outcome::Refused(message)) = outcome(&text) else {
        panic!("no end, or no refusal");
    };
    assert!(
        message.contains("99900 more"),
        "{}",
        &message[message.len() - 300..]
    );
}

/// A tenth of so short a time is zero, so that the next output was never later than the state.
#[test]
fn outputs_closer_than_the_digits_of_the_time_come_to_an_end() {
    for (time, step) in [
        ("5e-324", ""),
        ("1e-320", ""),
        ("1", r#""time_step": 1e-3, "#),
    ] {
        let print = if step.is_empty() {
            "10"
        } else {
            "1000000000000000000"
        };
        let text = format!(
            r#"{{"dimension": 2, "time": {time}, {step}"results": {{"print": {print}}},
"mesh": {{"cells_dimension": [1, 1], "cells_number": [10, 10]}},
"material": [{{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}}],
"body": [{{"type": "disc", "id": 1, "material_id": 1, "center": [5, 5], "radius": 2}}]}}"#
        );
        let found = outcome(&text);
        assert!(found.is_ok(), "{time}: {found:?}");
    }
}
