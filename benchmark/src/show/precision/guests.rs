//! Other solvers on a terminal: which cases are open to them, and the bounds that they keep.

use crate::show::{Table, filled, paragraph, percent};
use proctor_scene::{Damping, Field};
use proctor_verification::case::{Case, Gate, Size};
use proctor_verification::guest::Guest;
use proctor_verification::study::Study;
use std::io::{self, Write};

/// Columns of a terminal.
const WIDTH: usize = 80;

/// Lists the cases that are open to other solvers with the needs of each, and the reason for which the others are not:
/// of problems, and of cases that have none.
///
/// # Errors
/// If `out` cannot be written.
pub fn list(studies: &[Study], without: &[&'static Case], out: &mut dyn Write) -> io::Result<()> {
    let mut open = Table::new(["case", "runs", "needs"]);
    let mut closed: Vec<(&str, &str)> = vec![];
    let (mut reports, mut second) = (vec![], vec![]);
    for study in studies {
        let path = study.path(Size::Quick);
        match path.first().map(|rung| study.guest(rung)) {
            Some(Ok(guest)) => {
                open.push([
                    study.name().to_owned(),
                    format!(
                        "{} or {}",
                        runs(study, Size::Quick),
                        runs(study, Size::Full)
                    ),
                    needs(&guest).join(", "),
                ]);
                if guest.stress.is_some() {
                    second.push(study.name());
                }
                let reading = guest.reading.as_ref();
                reports
                    .extend(reading.map(|r| format!("{}: {}; {}", study.name(), r.name, r.source)));
            }
            Some(Err(reason)) => closed.push((study.name(), reason)),
            None => {}
        }
    }
    closed.extend(without.iter().map(|case| (case.name(), case.why_closed())));
    let count = open.lines().len() - 1;
    writeln!(
        out,
        "{count} of {} problems are open to other solvers; runs: short or long study\n",
        count + closed.len()
    )?;
    write!(out, "{open}")?;
    if !second.is_empty() {
        let names = second.join(", ");
        writeln!(out)?;
        paragraph(
            &format!("A second error, that of the stress, where frames hold stresses: {names}"),
            0,
            out,
        )?;
    }
    if !reports.is_empty() {
        writeln!(
            out,
            "\nReports: a number beside its reference, without a bound\n"
        )?;
    }
    for report in reports {
        paragraph(&report, 2, out)?;
    }
    if !closed.is_empty() {
        writeln!(out, "\nThe others, and why not\n")?;
    }
    // One reason once, with all that it holds for.
    let mut reasons: Vec<(&str, Vec<&str>)> = vec![];
    for (name, reason) in closed {
        match reasons.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, names)) => names.push(name),
            None => reasons.push((reason, vec![name])),
        }
    }
    for (reason, names) in reasons {
        for line in filled(names.join(", ").split(' '), WIDTH - 2) {
            writeln!(out, "  {line}")?;
        }
        for line in filled(reason.split(' '), WIDTH - 6) {
            writeln!(out, "      {line}")?;
        }
    }
    Ok(())
}

/// Number of runs of a size that a solver gets: the path, but for meshes that no scene file holds.
fn runs(study: &Study, size: Size) -> usize {
    let path = study.path(size);
    path.iter().filter(|rung| study.guest(rung).is_ok()).count()
}

/// Features that a problem needs of a solver, in the words of the manuals.
fn needs(guest: &Guest) -> Vec<String> {
    let scene = &guest.scene;
    let axes = scene.dimension.axes();
    let mut needs = vec![if guest.is_in_plane() {
        format!("2D or {axes}D")
    } else {
        format!("{axes}D")
    }];
    let mut add = |is: bool, what: &str| {
        if is {
            needs.push(what.to_owned());
        }
    };
    add(scene.gravity.iter().any(|g| *g != 0.0), "gravity");
    let yields = scene.materials.iter().any(|material| material.law.yields());
    add(yields, "plasticity");
    add(scene.bodies.len() > 1, "several bodies");
    add(!scene.point_loads.is_empty(), "nodal loads");
    add(!scene.tractions.is_empty(), "tractions");
    add(!scene.box_loads.is_empty(), "loads on boxes");
    add(!scene.contacts.is_empty(), "contact");
    add(!scene.surfaces.is_empty(), "STL");
    add(scene.base_motion.is_some(), "a moving base");
    add(matches!(scene.damping, Damping::Kinetic), "kinetic damping");
    add(
        matches!(scene.damping, Damping::Local { .. }),
        "local damping",
    );
    let read = guest.reading.is_some() && scene.results.fields.contains(&Field::Stress);
    add(read, "stresses");
    needs
}

/// Bounds that other solvers keep; true if all of them hold.
///
/// # Errors
/// If `out` cannot be written.
pub fn gates(gates: &[(String, Gate)], out: &mut dyn Write) -> io::Result<bool> {
    for (of, gate) in gates {
        let word = if gate.passed() { "PASS" } else { "FAIL" };
        let found = if gate.value.is_finite() {
            percent(gate.value)
        } else {
            "nothing".to_owned()
        };
        let bound = percent(gate.bound);
        let text = format!("{word}  {of}: {}: {found}, at most {bound}", gate.name);
        paragraph(&text, 2, out)?;
        paragraph(&format!("({})", gate.reason), 8, out)?;
    }
    if !gates.is_empty() {
        writeln!(out)?;
    }
    Ok(gates.iter().all(|(_, gate)| gate.passed()))
}
