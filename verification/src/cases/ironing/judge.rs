//! Gates of the indenter in the block.

use super::{
    ACROSS, FREE, LEFTWARD, MEAN, OVER, PRESSED, READINGS, RIPPLE, Reading, WRONG_FORCE, pressed,
    reading,
};
use crate::cases::prelude::*;

/// Part of each figure that friction adds, from runs of the other implementation with one and the same slave, and its tolerance
/// \[N\]. Without friction it is none: half of it is the most that tells the two apart.
const ADDED: [(&str, f64, f64); 3] = [
    (PRESSED, 5.4, 2.7),
    (MEAN, -5.0, 2.5),
    (ACROSS, -65.0, 10.0),
];
const ACROSS_OFF: f64 = 10.0; // How far the horizontal force may be off [N]

/// Gates on the whole way of an indenter in a block.
fn gates(runs: &Runs<'_>, rung: &Rung) -> Vec<Gate> {
    let (reading, label, full) = (reading(rung), &rung.label, runs.size == Size::Full);
    let at_most = |name: String, value, bound, reason| {
        Gate::at_most(format!("{label}: {name}"), value, bound, reason)
    };
    let error_at_most = |of: &str, quantity, bound, reason| {
        let name = format!("error of {of}{quantity}");
        at_most(name, runs.error(label, quantity), bound, reason)
    };
    let value_at_most =
        |quantity, bound, reason| runs.value_at_most(label, quantity, bound, reason);
    let figures = "5 % of the result of another implementation of the method";
    let mut gates = vec![error_at_most("the ", PRESSED, 0.05, figures)];
    if full {
        let off = (ACROSS_OFF * reading.stiffness / reading.figures[2]).abs();
        let across = "10 N of the results of another implementation of the method, 20 and 82 N";
        let both = "10 N of the horizontal and 5 % of the vertical force";
        let ripple =
            "0.25 % in the method's reference figures; contact that snaps has tens of percent";
        gates.extend([
            error_at_most("the ", MEAN, 0.05, figures),
            error_at_most("the ", ACROSS, off, across),
            // Both forces may be at the end of what they are allowed.
            error_at_most("", OVER, off + 0.05, both),
            value_at_most(RIPPLE, 0.01, ripple),
        ]);
    }
    let leaves = full && reading.stiffness == 1.0;
    if leaves {
        let reason = "beyond the block nothing touches the indenter";
        gates.push(value_at_most(FREE, 1e-9, reason));
    }
    if reading.friction == 0.0 {
        return gates;
    }
    // The same indenter without friction.
    let smooth = |r: &&Reading| r.stiffness == reading.stiffness && r.friction == 0.0;
    let smooth = READINGS.iter().find(smooth);
    let smooth = smooth.map_or_else(String::new, |r| Rung::new(r.variant, rung.cell).label);
    if leaves {
        let name = format!("{LEFTWARD}, with friction over without");
        let share = runs.value(label, LEFTWARD) / runs.value(&smooth, LEFTWARD);
        let reason = "the paper: more pronounced without friction";
        gates.push(at_most(name, share, 1.0, reason));
    }
    for (quantity, figure, off) in ADDED {
        if !full && quantity != PRESSED {
            continue;
        }
        let added = runs.value(label, quantity) - runs.value(&smooth, quantity);
        let figured = figure * runs.reference.of(&WRONG_FORCE);
        let name = format!("increase by friction of the {quantity}, less {figure} N");
        let reason = "the method's reference figures; without friction nothing is added";
        let beside = (added / reading.stiffness - figured).abs();
        gates.push(at_most(name, beside, off, reason));
    }
    gates
}

/// Gates: those of the way down against finite elements first.
pub fn verdict(runs: &Runs<'_>) -> Verdict {
    let readings = (runs.rungs.iter()).filter(|rung| rung.variant != pressed::VARIANT);
    let of_readings = readings.flat_map(|rung| gates(runs, rung));
    Verdict {
        gates: (pressed::gates(runs).into_iter())
            .chain(of_readings)
            .collect(),
        ..Verdict::default()
    }
}

/// The forces of a run, for the record; a short one ends before the plateau.
pub fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    if rung.variant == pressed::VARIANT {
        return None;
    }
    let down = format!("{}: {:.1} N at 60 s", rung.label, run.value(PRESSED));
    let [mean, across, ripple] = [MEAN, ACROSS, RIPPLE].map(|name| run.value(name));
    Some(if mean.is_nan() {
        down
    } else {
        format!(
            "{down}; from 120 to 180 s {mean:.1} N down and {across:.2} N along, ripple {:.2} %",
            100.0 * ripple,
        )
    })
}
