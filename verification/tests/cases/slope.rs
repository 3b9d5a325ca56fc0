//! The slope that fails.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Slope;

#[test]
fn gates_hold() {
    let verdict = holds(&Slope::GIVEN);
    let said = |line: &String| line.contains("proportional to h: not converged");
    assert_eq!(verdict.for_the_record.iter().filter(|l| said(l)).count(), 1);
    assert_eq!(verdict.curves.len(), 2);
}

/// Books that miss some of the work of gravity find energy from nowhere in every run; and five frames are there of each.
#[test]
fn work_that_is_not_counted_is_missed() {
    let wrong = Slope {
        reference_work: 0.5,
    };
    let solved = solve(&wrong);
    let failed = failing(&wrong.judge(Size::Quick, &solved));
    assert_eq!(failed.len(), solved.len(), "{failed:?}");
    assert!(
        failed.iter().all(|line| line.contains("from nowhere")),
        "{failed:?}"
    );
    for (rung, run) in &solved {
        // Five frames, each with its planes.
        let planes: usize = run.drawings.iter().map(|d| d.lines.len()).sum();
        assert_eq!(planes, 5, "{}", rung.label);
    }
}
