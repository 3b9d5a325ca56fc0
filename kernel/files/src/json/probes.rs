//! Probes: columns of the history that follow particles or bodies.

use super::build::Build;
use super::keys::{RawProbe, RawScene};
use super::words::listed;
use proctor_scene::{Probe, ProbeTarget, ProbedQuantity, Scene};

/// Points of a line where the file gives no number.
const POINTS: usize = 11;

impl Build<'_> {
    /// The probes of the scene.
    pub(super) fn probes(&mut self, raw: &RawScene, scene: &mut Scene) {
        for (i, probe) in raw.probes.iter().flatten().enumerate() {
            let path = format!("probes[{i}]");
            let target = self.target(probe, &path);
            if probe.name.is_none() {
                self.missing(format!("{path}.name"), "a text, prefix of the columns");
            }
            scene.probes.push(Probe {
                name: probe.name.clone().unwrap_or_else(|| format!("missing{i}")),
                target,
            });
        }
    }

    fn target(&mut self, probe: &RawProbe, path: &str) -> ProbeTarget {
        let keys = [
            ("point", probe.point.is_some()),
            ("line", probe.line.is_some()),
            ("body", probe.body.is_some()),
        ];
        let given = keys.iter().filter(|(_, is_given)| *is_given);
        let given: Vec<&str> = given.map(|(key, _)| *key).collect();
        if let [_, second, ..] = given[..] {
            self.add(
                format!("{path}.{second}"),
                format!(
                    "{} together",
                    listed(given.clone()).replace(" or ", " and ")
                ),
                "one of them in a probe",
            );
        }
        if probe.count.is_some() && probe.line.is_none() {
            self.add(
                format!("{path}.count"),
                "`count` without `line`",
                "`count` beside `line`",
            );
        }
        if probe.largest.is_some() && probe.body.is_none() {
            self.add(
                format!("{path}.largest"),
                "`largest` without `body`",
                "`largest` beside `body`",
            );
        }
        match (&probe.line, probe.body) {
            (Some(ends), _) => self.line(ends, probe.count.unwrap_or(POINTS), path),
            (None, Some(body)) => {
                let largest = probe.largest.as_ref();
                let path = format!("{path}.largest");
                let quantity =
                    largest.and_then(|word| self.word(&path, word, ProbedQuantity::WORDS));
                quantity.map_or(ProbeTarget::Body(body), |quantity| ProbeTarget::Largest {
                    body,
                    quantity,
                })
            }
            (None, None) => ProbeTarget::Point(self.vector(
                &format!("{path}.point"),
                probe.point.as_ref(),
                "a position [m]",
            )),
        }
    }

    fn line(&mut self, ends: &[Vec<f64>], count: usize, path: &str) -> ProbeTarget {
        let [from, to] = if let [from, to] = ends {
            let mut end =
                |i: usize, end: &[f64]| self.components(&format!("{path}.line[{i}]"), end);
            [end(0, from), end(1, to)]
        } else {
            self.add(
                format!("{path}.line"),
                format!("a list of length {}", ends.len()),
                "two positions, the ends of the line [m]",
            );
            [[f64::NAN; 3]; 2]
        };
        ProbeTarget::Line { from, to, count }
    }
}
