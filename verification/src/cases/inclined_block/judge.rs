//! Gates of the inclined block, and lines for the record.

use super::{ACCELERATION, CREEP, GRAVITY, Kind, Problem, TIME, WAY, by_elements};
use crate::cases::prelude::*;

/// A line for the record of a block that walks, beside finite elements.
fn walks(runs: &Runs<'_>, rung: &Rung) -> Option<String> {
    let (problem, run) = (rung.problem::<Problem>(), runs.run(&rung.label)?);
    let elements = by_elements(rung, problem).map(|slid| {
        let creep = slid.creep / (GRAVITY * TIME);
        format!("; finite elements {creep:.1e}, {:.2} m", slid.way)
    });
    Some(format!(
        "{}: creeps with {:.1e} of the free velocity, {:.2} m in 2 s{}",
        rung.label,
        run.error(CREEP),
        run.value(WAY),
        elements.unwrap_or_default(),
    ))
}

/// A line for the record of the manual's own scene.
fn printed(runs: &Runs<'_>, rung: &Rung) -> Option<String> {
    let (problem, run) = (rung.problem::<Problem>(), runs.run(&rung.label)?);
    Some(format!(
        "as printed, mu = {}: displacement at 2 s off by {:+.2} %, fitted acceleration by {:.2} %",
        problem.friction,
        100.0 * (runs.share(&rung.label, WAY) - 1.0),
        100.0 * run.error(ACCELERATION),
    ))
}

/// Gates and lines of each variant on each mesh, in the order of the ladder.
pub fn verdict(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    verdict.curves.extend(picture(runs));
    let kind = |rung: &Rung| rung.problem::<Problem>().kind;
    let walking = |rung: &Rung| matches!(kind(rung), Kind::Walk(_));
    for group in (runs.rungs).chunk_by(|a, b| (a.variant, a.cell) == (b.variant, b.cell)) {
        let lines =
            (group.iter().filter(|rung| walking(rung))).filter_map(|rung| walks(runs, rung));
        verdict.for_the_record.extend(lines);
        let own: Vec<&Rung> = group.iter().filter(|rung| !walking(rung)).collect();
        let Some(first) = own.first() else {
            continue;
        };
        let mut gate = |quantity: &str, of: &str, bound, reason| {
            let (variant, cell) = (first.variant, first.cell);
            let name = format!("{variant} h={cell}: {quantity}, largest of {of}");
            let worst = largest(own.iter().map(|rung| runs.error(&rung.label, quantity)));
            let gate = Gate::at_most(name, worst, bound, reason);
            verdict.gates.push(gate);
        };
        match kind(first) {
            Kind::Settled => {
                let reason = "the project promises half a percent for every friction";
                gate(ACCELERATION, "all mu", 5e-3, reason);
                gate(WAY, "all mu", 5e-3, reason);
            }
            Kind::Printed => {
                let lines = own.iter().filter_map(|rung| printed(runs, rung));
                verdict.for_the_record.extend(lines);
            }
            Kind::Stick | Kind::StickMirrored | Kind::StickAtOnce | Kind::Walk(_) => {
                let both = "tilted both ways and released at once";
                let swings = "a block that sticks swings about its place: no mean velocity is left";
                let shears =
                    "it shears and swings by about rho g H²/G = 2e-3 m, the free block slides 14 m";
                gate(CREEP, both, 1e-4, swings);
                gate(WAY, both, 5e-3, shears);
            }
        }
    }
    verdict
}

/// Displacement over time for all frictions in one picture, of the first variant that slides on its finest mesh.
fn picture(runs: &Runs<'_>) -> Option<Curve> {
    let variant = runs.rungs.first()?.variant;
    let own = || {
        runs.solved
            .iter()
            .filter(|(rung, _)| rung.variant == variant)
    };
    let finest = own().map(|(rung, _)| rung.cell).reduce(f64::min)?;
    let finest_runs = own().filter(|(rung, _)| rung.cell == finest);
    let mut lines = finest_runs.filter_map(|(_, run)| run.curve.as_ref());
    let mut all = lines.next()?.clone();
    for line in lines {
        let begin = line.points.first().map_or(0.0, |p| p.at);
        all.points.push(CurvePoint {
            at: begin,
            ..PARTED
        });
        all.points.extend_from_slice(&line.points);
    }
    all.title = format!("sliding block, mu = 0 (top) to 0.5, {variant}, h = {finest} m");
    Some(all)
}
