//! Columns that are let go.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::{Collapse, cell_outlines};
use std::collections::BTreeSet;

#[test]
fn gates_hold() {
    let verdict = holds(&Collapse::GIVEN);
    let shown = |what: &str| {
        verdict
            .for_the_record
            .iter()
            .filter(|l| l.contains(what))
            .count()
    };
    assert_eq!([shown("experiments"), shown("Ritter")], [4, 1]);
}

/// Books that miss some of the work of gravity find energy from nowhere in every column.
#[test]
fn work_that_is_not_counted_is_missed() {
    let wrong = Collapse {
        reference_work: 0.5,
    };
    let solved = solve(&wrong);
    let failed = failing(&wrong.judge(Size::Quick, &solved));
    assert_eq!(failed.len(), solved.len(), "{failed:?}");
    assert!(
        failed.iter().all(|line| line.contains("from nowhere")),
        "{failed:?}"
    );
}

/// Taller columns come farther, as widths go, and none of sand is higher at the end than at the start.
#[test]
fn taller_columns_come_farther() {
    let solved = solve(&Collapse::GIVEN);
    let far: Vec<f64> = (solved.iter())
        .filter(|(rung, _)| rung.variant != "water")
        .map(|(_, run)| run.value("run-out over width"))
        .collect();
    assert_eq!(far.len(), 4);
    assert!(far.windows(2).all(|pair| pair[0] < pair[1]), "{far:?}");
    for (rung, run) in &solved {
        // Five frames, each with its planes.
        let planes: usize = run.drawings.iter().map(|d| d.lines.len()).sum();
        assert_eq!(planes, 5, "{}", rung.label);
    }
}

/// Lines around cells have the cells on their left: their areas add up to the number of cells, whatever holes there are.
#[test]
fn lines_around_cells_enclose_them() {
    let area = |line: &Vec<[i64; 2]>| {
        let next = line.iter().cycle().skip(1);
        let parts = line
            .iter()
            .zip(next)
            .map(|(a, b)| a[0] * b[1] - b[0] * a[1]);
        parts.sum::<i64>() / 2
    };
    let one: BTreeSet<[i64; 2]> = [[3, -2]].into();
    assert_eq!(cell_outlines(&one).len(), 1);
    assert_eq!(cell_outlines(&one)[0].len(), 4);
    let square = (0..3).flat_map(|i| (0..3).map(move |j| [i, j]));
    let ring: BTreeSet<[i64; 2]> = square.filter(|cell| *cell != [1, 1]).collect();
    let mut areas: Vec<i64> = cell_outlines(&ring).iter().map(area).collect();
    areas.sort_unstable();
    assert_eq!(areas, [-1, 9]);
    // Two cells that touch at a corner, and one apart.
    let touching: BTreeSet<[i64; 2]> = [[0, 0], [1, 1], [5, 0]].into();
    let areas: i64 = cell_outlines(&touching).iter().map(area).sum();
    assert_eq!(areas, 3);
    assert!(cell_outlines(&BTreeSet::new()).is_empty());
}
