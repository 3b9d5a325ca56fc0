//! The strip footing.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Footing;

#[test]
fn gates_hold() {
    let verdict = holds(&Footing::GIVEN);
    let locked = |line: &String| line.contains("locked") && line.contains("no limit");
    assert!(verdict.for_the_record.iter().any(locked), "{verdict:?}");
}

/// Every load notices ground that is a quarter weaker or stronger, and every load of a ground with friction another angle.
#[test]
fn wrong_references_break_the_gates() {
    let solved = solve(&Footing::GIVEN);
    // What was solved does not depend on the reference, but for the exact value beside it.
    let judged = |case: Footing| {
        let mut solved = solved.clone();
        for (rung, run) in &mut solved {
            for q in &mut run.quantities {
                let Some(exact) = q.exact.as_mut() else {
                    continue;
                };
                *exact = case.exact_load(rung);
                q.error = Some((q.value / *exact - 1.0).abs());
            }
        }
        case.judge(Size::Quick, &solved)
    };
    let all = judged(Footing::GIVEN);
    assert_eq!(failing(&all), Vec::<String>::new());
    let weak = judged(Footing {
        reference_strength: 0.75,
        ..Footing::GIVEN
    });
    let strong = judged(Footing {
        reference_strength: 1.4,
        ..Footing::GIVEN
    });
    for (verdict, of) in [(&weak, false), (&strong, true)] {
        for gate in &verdict.gates {
            if gate.name.contains("over the exact one") == of && gate.name.contains("footing") {
                let order = gate.name.contains("order");
                assert!(order || !gate.passed(), "{}: {}", gate.name, gate.value);
            }
        }
    }
    let slippery = judged(Footing {
        reference_friction: 0.9,
        ..Footing::GIVEN
    });
    let failed = failing(&slippery);
    assert!(
        failed.iter().any(|line| line.contains("20 deg")),
        "{failed:?}"
    );
    assert!(
        failed.iter().any(|line| line.contains("30 deg")),
        "{failed:?}"
    );
    assert!(
        !failed.iter().any(|line| line.contains("Tresca")),
        "{failed:?}"
    );
}
