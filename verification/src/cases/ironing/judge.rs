//! Gates and tables of the indenter in the block.

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

/// Tables, gates and lines for the record.
pub fn verdict(runs: &Runs<'_>) -> Verdict {
    let Runs {
        size,
        rungs,
        solved,
        ..
    } = *runs;
    let mut gates = pressed::gates(runs);
    for rung in rungs {
        if rung.variant == pressed::VARIANT {
            continue;
        }
        let reading = reading(rung);
        let found = solved.iter().find(|(other, _)| other == rung);
        let error = |name| found.map_or(f64::NAN, |(_, s)| s.error(name));
        let value =
            |of: Option<&(Rung, RungResult)>, name| of.map_or(f64::NAN, |(_, s)| s.value(name));
        let mut at_most = |name: String, value, bound, reason| {
            let name = format!("{}: {name}", rung.label);
            gates.push(Gate::at_most(name, value, bound, reason));
        };
        let figures = "5 % of the result of another implementation of the method";
        at_most(
            format!("error of the {PRESSED}"),
            error(PRESSED),
            0.05,
            figures,
        );
        if size == Size::Full {
            at_most(format!("error of the {MEAN}"), error(MEAN), 0.05, figures);
            let off = (ACROSS_OFF * reading.stiffness / reading.figures[2]).abs();
            let across = "10 N of the results of another implementation of the method, 20 and 82 N";
            at_most(format!("error of the {ACROSS}"), error(ACROSS), off, across);
            // Both forces may be at the end of what they are allowed.
            at_most(
                format!("error of {OVER}"),
                error(OVER),
                off + 0.05,
                "10 N of the horizontal and 5 % of the vertical force",
            );
            at_most(
                RIPPLE.to_owned(),
                value(found, RIPPLE),
                0.01,
                "0.25 % in the method's reference figures; contact that snaps has tens of percent",
            );
        }
        let leaves = size == Size::Full && reading.stiffness == 1.0;
        if leaves {
            at_most(
                FREE.to_owned(),
                value(found, FREE),
                1e-9,
                "beyond the block nothing touches the indenter",
            );
        }
        if reading.friction == 0.0 {
            continue;
        }
        let without = |r: &&Reading| r.stiffness == reading.stiffness && r.friction == 0.0;
        let without = READINGS.iter().find(without).and_then(|other| {
            let own =
                |(r, _): &&(Rung, RungResult)| r.variant == other.variant && r.cell == rung.cell;
            solved.iter().find(own)
        });
        if leaves {
            at_most(
                format!("{LEFTWARD}, with friction over without"),
                value(found, LEFTWARD) / value(without, LEFTWARD),
                1.0,
                "the paper: more pronounced without friction",
            );
        }
        for (name, figure, off) in ADDED {
            if size == Size::Quick && name != PRESSED {
                continue;
            }
            let added = (value(found, name) - value(without, name)) / reading.stiffness;
            at_most(
                format!("increase by friction of the {name}, less {figure} N"),
                (added - figure * runs.reference.of(&WRONG_FORCE)).abs(),
                off,
                "the method's reference figures; without friction nothing is added",
            );
        }
    }
    Verdict {
        tables: vec![(
            pressed::VARIANT.to_owned(),
            runs.table(Some(pressed::VARIANT), &[pressed::HISTORY]),
        )],
        gates,
        for_the_record: solved
            .iter()
            .filter(|(rung, _)| rung.variant != pressed::VARIANT)
            .map(|(rung, s)| {
                let pressed = format!("{}: {:.1} N at 60 s", rung.label, s.value(PRESSED));
                // A short run ends before the plateau.
                if s.value(MEAN).is_nan() {
                    return pressed;
                }
                format!(
                    "{pressed}; from 120 to 180 s {:.1} N down and {:.2} N along, ripple {:.2} %",
                    s.value(MEAN),
                    s.value(ACROSS),
                    100.0 * s.value(RIPPLE),
                )
            })
            .collect(),
        ..Verdict::default()
    }
}
