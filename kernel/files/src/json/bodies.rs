//! Bodies from their keys.

use super::build::Build;
use super::keys::{RawBody, RawInitialStress, RawScene};
use super::lists::{Counts, VectorOrTable};
use super::materials::entry_path;
use super::sheets::RawSheet;
use super::words::listed;
use proctor_scene::{Body, Dimension, History, InitialStress, Material, Mesh};

impl Build<'_> {
    pub(super) fn bodies(
        &mut self,
        raw_scene: &RawScene,
        mesh: &Mesh,
        materials: &[Material],
    ) -> Vec<Body> {
        let mut counts = [2; 3];
        if self.dimension == Dimension::Two {
            counts[2] = 1;
        }
        if let Some(given) = &raw_scene.particles_per_cell {
            counts = self.counts("particles_per_cell", given, counts);
        }
        let given = self.either(
            "",
            ("body", raw_scene.body.as_ref()),
            ("bodies", raw_scene.bodies.as_ref()),
        );
        let Some((key, entries)) = given else {
            self.missing("body", "a list or an object of bodies");
            self.spelt("bodies", "body");
            return Vec::new();
        };
        self.spelt("bodies", key);
        let mut bodies = Vec::new();
        for (i, (name, raw)) in entries.0.iter().enumerate() {
            let path = entry_path(key, i, name.as_deref());
            let name = name.clone().unwrap_or_else(|| path.clone());
            let body = self.body(&path, name, i, raw, counts, (mesh, materials));
            for part in self.parts(&path, body, raw, (mesh, materials)) {
                self.spelt(format!("bodies[{}]", bodies.len()), path.clone());
                bodies.push(part);
            }
        }
        Self::number_parts(raw_scene, &mut bodies);
        bodies
    }

    fn body(
        &mut self,
        path: &str,
        name: String,
        i: usize,
        raw: &RawBody,
        counts: [usize; 3],
        (mesh, materials): (&Mesh, &[Material]),
    ) -> Body {
        let key = |key: &str| format!("{path}.{key}");
        let particles_per_cell = match &raw.particles_per_cell {
            Some(given) => self.counts(&key("particles_per_cell"), given, counts),
            None => counts,
        };
        Body {
            name,
            id: self.id(path, raw.id, i),
            // Each layer has its own.
            material: if raw.layers.is_some() {
                usize::MAX
            } else {
                self.material_index(&key("material_id"), raw.material_id, materials)
            },
            shape: self.shape(path, raw, mesh),
            particles_per_cell,
            velocity: self.vector_or_zero(&key("initial_velocity"), raw.initial_velocity.as_ref()),
            motion: raw
                .prescribed_velocity
                .as_ref()
                .map(|given| self.motion(&key("prescribed_velocity"), given)),
            initial_stress: (raw.initial_stress.as_ref()).map_or(InitialStress::None, |given| {
                self.initial_stress(&key("initial_stress"), given)
            }),
        }
    }

    fn initial_stress(&mut self, path: &str, raw: &RawInitialStress) -> InitialStress {
        let key = |key: &str| format!("{path}.{key}");
        let words = [("isotropic", false), ("at_rest", true)];
        let kind = if let Some(word) = &raw.r#type {
            self.word(&key("type"), word, &words)
        } else {
            self.missing(key("type"), "`isotropic` or `at_rest`");
            None
        };
        for (name, given, of_rest) in [
            ("value", raw.value, false),
            ("ratio", raw.ratio, true),
            ("level", raw.level.as_ref().map(|_| 0.0), true),
            ("surcharge", raw.surcharge, true),
        ] {
            if given.is_some() && kind == Some(!of_rest) {
                let [other, own] = [of_rest, !of_rest].map(|at_rest| words[usize::from(at_rest)].0);
                self.add(
                    key(name),
                    format!("`{name}`, which means nothing for the type {own:?}"),
                    format!("no `{name}`, or `type` {other:?}"),
                );
            }
        }
        match kind {
            None => InitialStress::None,
            Some(false) => {
                InitialStress::Isotropic(self.number(&key("value"), raw.value, "a number [Pa]"))
            }
            Some(true) => InitialStress::AtRest {
                ratio: self.number(&key("ratio"), raw.ratio, "a number, 0 or greater"),
                // Where it is no number, the surface of the ground takes its place.
                level: match raw.level {
                    Some(RawSheet::Level(level)) => level,
                    _ => 0.0,
                },
                surcharge: raw.surcharge.unwrap_or(0.0),
            },
        }
    }

    /// Particles per cell and axis. The default stands in where they are wrong: there may be no place for them in
    /// the body.
    pub(super) fn counts(&mut self, path: &str, given: &Counts, default: [usize; 3]) -> [usize; 3] {
        let axes = self.dimension.axes();
        let mut counts = [1; 3];
        match given {
            Counts::One(n) => counts[..axes].fill(*n),
            Counts::PerAxis(list) if self.length(path, list, axes) => {
                counts[..axes].copy_from_slice(list);
            }
            Counts::PerAxis(_) => return default,
        }
        if counts.contains(&0) {
            self.add(path, "0", "whole numbers, 1 or more");
            return default;
        }
        counts
    }

    pub(super) fn material_index(
        &mut self,
        path: &str,
        id: Option<i64>,
        materials: &[Material],
    ) -> usize {
        let ids = || {
            materials
                .iter()
                .map(|m| m.id.to_string())
                .collect::<Vec<_>>()
        };
        let Some(id) = id else {
            self.missing(path, "the id of a material");
            return usize::MAX;
        };
        if materials.is_empty() {
            // That there are none is reported once, not for each body.
            self.stands_in(path);
            return usize::MAX;
        }
        materials
            .iter()
            .position(|m| m.id == id)
            .unwrap_or_else(|| {
                let accepted = format!(
                    "the id of a material: {}",
                    listed(ids().iter().map(String::as_str))
                );
                self.add(path, format!("{id}, which no material has"), accepted);
                usize::MAX
            })
    }

    pub(super) fn motion(&mut self, path: &str, given: &VectorOrTable) -> History {
        match given {
            VectorOrTable::Vector(vector) => History {
                times: vec![0.0],
                values: vec![self.components(path, vector)],
            },
            VectorOrTable::Table(rows) => {
                let (mut times, mut values) = (Vec::new(), Vec::new());
                for (i, row) in rows.iter().enumerate() {
                    let path = format!("{path}[{i}]");
                    if self.length(&path, row, self.dimension.axes() + 1) {
                        times.push(row[0]);
                        values.push(self.components(&path, &row[1..]));
                    }
                }
                History { times, values }
            }
        }
    }
}
