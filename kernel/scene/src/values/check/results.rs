//! Check of what is written.

use super::body;
use super::collector::Collector;
use crate::values::{Probe, ProbeTarget, ProbedQuantity, Results, Scene};
use proctor_geometry::number::Number;
use proctor_kernel::model::Vector;

/// Checks what is written and how often.
pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    let results = &scene.results;
    if results.print > Results::MOST {
        problems.add(
            "results.print",
            results.print.to_string(),
            format!("a whole number, at most {}", Results::MOST),
        );
    }
    if let Some(interval) = results.history_interval {
        let path = "results.history_interval";
        if interval.is_finite() && interval > scene.time {
            problems.add(
                path,
                format!("{} s", Number(interval)),
                format!("at most the time of the run, {} s", Number(scene.time)),
            );
        } else {
            problems.positive(path, interval, "s");
        }
    }
    for (i, probe) in scene.probes.iter().enumerate() {
        let path = format!("probes[{i}]");
        check_target(scene, probe, &path, problems);
        // The name becomes the prefix of columns in history.csv.
        let is_plain = |c: char| c.is_alphanumeric() || "_-.".contains(c);
        if probe.name.is_empty() || !probe.name.chars().all(is_plain) {
            problems.add(
                format!("{path}.name"),
                format!("{:?}", probe.name),
                "letters, digits, `_`, `-` and `.`, at least one",
            );
        }
        let own = probe.prefixes();
        let shares = |other: &Probe| other.prefixes().iter().any(|name| own.contains(name));
        if let Some(first) = scene.probes[..i].iter().position(shares) {
            problems.add(
                format!("{path}.name"),
                format!("{:?}, the name of probes[{first}] too", probe.name),
                "a name that no other probe has",
            );
        }
    }
}

fn check_target(scene: &Scene, probe: &Probe, path: &str, problems: &mut Collector) {
    match &probe.target {
        ProbeTarget::Point(position) => place(scene, position, &format!("{path}.point"), problems),
        ProbeTarget::Line { from, to, count } => {
            place(scene, from, &format!("{path}.line[0]"), problems);
            place(scene, to, &format!("{path}.line[1]"), problems);
            if !(2..=Probe::MOST).contains(count) {
                problems.add(
                    format!("{path}.count"),
                    count.to_string(),
                    format!("a whole number from 2 to {}", Probe::MOST),
                );
            }
        }
        ProbeTarget::Body(id) => {
            body_of(scene, *id, path, problems);
        }
        ProbeTarget::Largest { body, quantity } => {
            let Some(place) = body_of(scene, *body, path, problems) else {
                return;
            };
            let of_law = *quantity == ProbedQuantity::PlasticStrain;
            let materials = scene.bodies[place].material < scene.materials.len();
            if of_law && materials && !has_plastic_strain(scene, place) {
                problems.add(
                    format!("{path}.largest"),
                    format!("\"{}\" of a law that does not yield", quantity.word()),
                    "`displacement`, `velocity`, `mises_stress` or `pressure`",
                );
            }
        }
    }
}

fn has_plastic_strain(scene: &Scene, place: usize) -> bool {
    let law = scene.law_of(&scene.bodies[place]);
    law.variables()
        .iter()
        .any(|variable| variable.name == ProbedQuantity::PLASTIC_STRAIN)
}

/// A position that must lie in the mesh.
fn place(scene: &Scene, position: &Vector, path: &str, problems: &mut Collector) {
    problems.vector(path, position);
    for axis in 0..scene.dimension.axes() {
        let at = format!("{path}[{axis}]");
        body::outside(&scene.mesh, axis, position[axis], &at, problems);
    }
}

/// The place of the body with this identifier.
fn body_of(scene: &Scene, id: i64, path: &str, problems: &mut Collector) -> Option<usize> {
    let place = scene.bodies.iter().position(|body| body.id == id);
    if place.is_none() {
        let ids: Vec<String> = scene.bodies.iter().map(|b| b.id.to_string()).collect();
        problems.add(
            format!("{path}.body"),
            format!("{id}, which no body has as its id"),
            format!("the id of a body: {}", ids.join(", ")),
        );
    }
    place
}
