//! Gates of the inclined block, and what is said of the manual's own scene.

use super::{ACCELERATION, CREEP, GRAVITY, Kind, Problem, TIME, WAY, by_elements};
use crate::cases::prelude::*;

const SLIDING_GATE: f64 = 5e-3; // Largest relative error of acceleration and displacement
/// Largest mean velocity over the second half of the time, over the velocity of the free block.
const CREEP_GATE: f64 = 1e-4;
const STICK_GATE: f64 = 5e-3; // Largest displacement of a block that sticks over that of a free one

/// Gates over the rungs of a ladder.
pub fn verdict(runs: &Runs<'_>) -> Verdict {
    let with_problem = |rung: &Rung| (rung.clone(), *rung.problem::<Problem>());
    let ladder: Vec<_> = runs.rungs.iter().map(with_problem).collect();
    let (ladder, solved) = (&ladder[..], runs.solved);
    let mut verdict = Verdict::default();
    // One group per variant and cell size, in the order of the ladder.
    let mut groups: Vec<(&'static str, f64)> = vec![];
    for (rung, _) in ladder {
        if !groups.contains(&(rung.variant, rung.cell)) {
            groups.push((rung.variant, rung.cell));
        }
    }
    verdict.curves.extend(picture(ladder, solved));
    for (variant, cell) in groups {
        let of_group = |(r, _): &&(Rung, Problem)| r.variant == variant && r.cell == cell;
        let group = || {
            let all = ladder.iter().filter(of_group);
            all.filter(|(_, problem)| !matches!(problem.kind, Kind::Walk(_)))
        };
        for (rung, problem) in ladder.iter().filter(of_group) {
            if let (Kind::Walk(_), Some(s)) = (problem.kind, runs.run(&rung.label)) {
                let elements = by_elements(rung, problem).map(|slid| {
                    let creep = slid.creep / (GRAVITY * TIME);
                    format!("; finite elements {creep:.1e}, {:.2} m", slid.way)
                });
                verdict.for_the_record.push(format!(
                    "{}: creeps with {:.1e} of the free velocity, {:.2} m in 2 s{}",
                    rung.label,
                    s.error(CREEP),
                    s.value(WAY),
                    elements.unwrap_or_default(),
                ));
            }
        }
        let Some((_, first)) = group().next() else {
            continue;
        };
        let worst = |name: &str| {
            group()
                .map(|(rung, _)| runs.error(&rung.label, name))
                .reduce(|a, b| if a >= b || a.is_nan() { a } else { b })
                .unwrap_or(f64::NAN)
        };
        let mut gate = |quantity: &str, of: &str, bound, reason| {
            let name = format!("{variant} h={cell}: {quantity}, largest of {of}");
            verdict
                .gates
                .push(Gate::at_most(name, worst(quantity), bound, reason));
        };
        let of = "all mu";
        match first.kind {
            Kind::Settled => {
                let reason = "the project promises half a percent for every friction";
                gate(ACCELERATION, of, SLIDING_GATE, reason);
                gate(WAY, of, SLIDING_GATE, reason);
            }
            Kind::Stick | Kind::StickMirrored | Kind::StickAtOnce | Kind::Walk(_) => {
                let both = "tilted both ways and released at once";
                gate(
                    CREEP,
                    both,
                    CREEP_GATE,
                    "a block that sticks swings about its place: no mean velocity is left",
                );
                gate(
                    WAY,
                    both,
                    STICK_GATE,
                    "it shears and swings by about rho g H²/G = 2e-3 m, the free block slides 14 m",
                );
            }
            Kind::Printed => {
                for (rung, problem) in group() {
                    if let Some(s) = runs.run(&rung.label) {
                        verdict.for_the_record.push(format!(
                            "as printed, mu = {}: displacement at 2 s off by {:+.2} %, fitted acceleration by {:.2} %",
                            problem.friction,
                            100.0 * signed(s, WAY),
                            100.0 * s.error(ACCELERATION),
                        ));
                    }
                }
            }
        }
    }
    verdict
}

/// Displacement over time for all frictions in one picture, of the first variant that slides on its finest mesh.
fn picture(ladder: &[(Rung, Problem)], solved: &[(Rung, RungResult)]) -> Option<Curve> {
    let variant = ladder.first()?.0.variant;
    let own = || solved.iter().filter(|(rung, _)| rung.variant == variant);
    let finest = own().map(|(rung, _)| rung.cell).reduce(f64::min)?;
    let lines = own()
        .filter(|(rung, _)| rung.cell == finest)
        .filter_map(|(_, s)| s.curve.as_ref());
    let mut all: Option<Curve> = None;
    for line in lines {
        match &mut all {
            None => all = Some(line.clone()),
            Some(all) => {
                all.points.push(CurvePoint::new(
                    line.points.first().map_or(0.0, |p| p.at),
                    f64::NAN,
                    f64::NAN,
                ));
                all.points.extend_from_slice(&line.points);
            }
        }
    }
    let mut all = all?;
    all.title = format!("sliding block, mu = 0 (top) to 0.5, {variant}, h = {finest} m");
    Some(all)
}

/// Signed relative error.
fn signed(solved: &RungResult, name: &str) -> f64 {
    solved
        .quantity(name)
        .and_then(|q| Some(q.value / q.exact? - 1.0))
        .unwrap_or(f64::NAN)
}
