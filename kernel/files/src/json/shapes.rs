//! Shapes of bodies from their keys.

use std::sync::Arc;

use super::build::Build;
use super::keys::RawBody;
use super::words::{AXES, ShapeKind, listed, meaning, shapes};
use crate::records;
use proctor_scene::{Dimension, Mesh, ParticleSeed, Shape, Vector};

/// Keys that describe a shape of this kind.
fn keys_of(kind: ShapeKind) -> &'static [&'static str] {
    match kind {
        ShapeKind::Cuboid | ShapeKind::Rectangle => &["point_p1", "point_p2"],
        ShapeKind::Sphere | ShapeKind::Disc => &["center", "radius"],
        ShapeKind::Ring => &["center", "inner_radius", "outer_radius"],
        ShapeKind::Cylinder => &["point_p1", "point_p2", "radius"],
        ShapeKind::Polygon => &["points"],
        ShapeKind::ExtrudedPolygon => &["points", "axis", "range"],
        ShapeKind::Between => &["lower", "upper", "plan"],
        ShapeKind::Solid => &["stl_mesh"],
        ShapeKind::Particles => &["particles", "file"],
    }
}

impl Build<'_> {
    /// Says of the last problem, a shape that is not known, that it exists in another number of dimensions.
    fn hint_at_other_dimension(&mut self, word: &str) {
        let (other, n) = match self.dimension {
            Dimension::Two => (Dimension::Three, 3),
            Dimension::Three => (Dimension::Two, 2),
        };
        if meaning(word, shapes(other)).is_some() {
            self.hint(format!("this shape needs `dimension` {n}"));
        }
    }

    /// A key of another shape would be read and then not used.
    fn refuse_keys_of_other_shapes(
        &mut self,
        path: &str,
        word: &str,
        kind: ShapeKind,
        raw: &RawBody,
    ) {
        let given = [
            ("point_p1", raw.point_p1.is_some()),
            ("point_p2", raw.point_p2.is_some()),
            ("center", raw.center.is_some()),
            ("radius", raw.radius.is_some()),
            ("inner_radius", raw.inner_radius.is_some()),
            ("outer_radius", raw.outer_radius.is_some()),
            ("points", raw.points.is_some()),
            ("axis", raw.axis.is_some()),
            ("range", raw.range.is_some()),
            ("lower", raw.lower.is_some()),
            ("upper", raw.upper.is_some()),
            ("plan", raw.plan.is_some()),
            ("stl_mesh", raw.stl_mesh.is_some()),
            ("particles", raw.particles.is_some()),
            ("file", raw.file.is_some()),
        ];
        let own = keys_of(kind);
        for (key, is_given) in given {
            if is_given && !own.contains(&key) {
                self.add(
                    format!("{path}.{key}"),
                    format!("`{key}`, which means nothing for the type {word:?}"),
                    listed(own.iter().copied()),
                );
            }
        }
    }

    /// The shape; a stand-in without particles where its type is missing or unknown.
    pub(super) fn shape(&mut self, path: &str, raw: &RawBody, mesh: &Mesh) -> Shape {
        let nothing = Shape::Particles(Arc::new(Vec::new()));
        let words = shapes(self.dimension);
        let Some(word) = &raw.r#type else {
            self.missing(format!("{path}.type"), listed(words.iter().map(|w| w.0)));
            self.stands_in(format!("{path}.particles"));
            return nothing;
        };
        let Some(kind) = self.word(&format!("{path}.type"), word, words) else {
            self.hint_at_other_dimension(word);
            self.stands_in(format!("{path}.particles"));
            return nothing;
        };
        self.refuse_keys_of_other_shapes(path, word, kind, raw);
        let key = |key: &str| format!("{path}.{key}");
        match kind {
            ShapeKind::Cuboid | ShapeKind::Rectangle => Shape::Cuboid {
                p1: self.vector(
                    &key("point_p1"),
                    raw.point_p1.as_ref(),
                    "the lower corner [m]",
                ),
                p2: self.vector(
                    &key("point_p2"),
                    raw.point_p2.as_ref(),
                    "the upper corner [m]",
                ),
            },
            ShapeKind::Sphere | ShapeKind::Disc => Shape::Sphere {
                center: self.center(path, raw),
                radius: self.radius(path, "radius", raw.radius),
            },
            ShapeKind::Ring => Shape::Ring {
                center: self.center(path, raw),
                inner: self.radius(path, "inner_radius", raw.inner_radius),
                outer: self.radius(path, "outer_radius", raw.outer_radius),
            },
            ShapeKind::Cylinder => Shape::Cylinder {
                p1: self.vector(
                    &key("point_p1"),
                    raw.point_p1.as_ref(),
                    "the centre of an end face [m]",
                ),
                p2: self.vector(
                    &key("point_p2"),
                    raw.point_p2.as_ref(),
                    "the centre of the other end face [m]",
                ),
                radius: self.radius(path, "radius", raw.radius),
            },
            ShapeKind::Polygon => Shape::Polygon {
                points: self
                    .corners(path, raw)
                    .into_iter()
                    .map(|[x, y]| [x, y, 0.0])
                    .collect(),
            },
            ShapeKind::ExtrudedPolygon => self.extruded(path, raw),
            ShapeKind::Between => {
                let stratum = self.between(path, raw, mesh);
                let shape = stratum.map(|stratum| Shape::Stratum(Arc::new(stratum)));
                self.or_nothing(path, shape)
            }
            ShapeKind::Solid => {
                let shape = self.enclosed(path, raw);
                self.or_nothing(path, shape)
            }
            ShapeKind::Particles => Shape::Particles(Arc::new(self.particles(path, raw))),
        }
    }

    /// A shape, or a stand-in for one whose fault is known.
    fn or_nothing(&mut self, path: &str, shape: Option<Shape>) -> Shape {
        shape.unwrap_or_else(|| {
            self.stands_in(format!("{path}.particles"));
            Shape::Particles(Arc::new(Vec::new()))
        })
    }

    fn center(&mut self, path: &str, raw: &RawBody) -> Vector {
        self.vector(
            &format!("{path}.center"),
            raw.center.as_ref(),
            "the centre [m]",
        )
    }

    fn radius(&mut self, path: &str, key: &str, value: Option<f64>) -> f64 {
        self.number(
            &format!("{path}.{key}"),
            value,
            "a number greater than 0 [m]",
        )
    }

    fn corners(&mut self, path: &str, raw: &RawBody) -> Vec<[f64; 2]> {
        let Some(points) = &raw.points else {
            self.missing(format!("{path}.points"), "three or more corners [m]");
            return Vec::new();
        };
        let mut corners = Vec::new();
        for (i, point) in points.iter().enumerate() {
            if let [x, y] = point[..] {
                corners.push([x, y]);
            } else {
                let found = format!("a list of length {}", point.len());
                self.add(
                    format!("{path}.points[{i}]"),
                    found,
                    "2 numbers, a corner in the plane of the polygon",
                );
            }
        }
        corners
    }

    fn extruded(&mut self, path: &str, raw: &RawBody) -> Shape {
        let points = self.corners(path, raw);
        let axis = if let Some(word) = &raw.axis {
            self.word_or(&format!("{path}.axis"), Some(word), AXES, 2)
        } else {
            self.missing(format!("{path}.axis"), listed(AXES.iter().map(|a| a.0)));
            2
        };
        let accepted = "two numbers, the lower first [m]";
        let range = match raw.range.as_deref() {
            Some([low, high]) => [*low, *high],
            Some(other) => {
                let found = format!("a list of length {}", other.len());
                self.add(format!("{path}.range"), found, accepted);
                [f64::NAN; 2]
            }
            None => {
                self.missing(format!("{path}.range"), accepted);
                [f64::NAN; 2]
            }
        };
        Shape::ExtrudedPolygon {
            points,
            axis,
            range,
        }
    }

    fn particles(&mut self, path: &str, raw: &RawBody) -> Vec<ParticleSeed> {
        let axes = self.dimension.axes();
        match (&raw.particles, &raw.file) {
            (Some(_), Some(_)) => {
                self.add(
                    format!("{path}.file"),
                    "`particles` and `file` together",
                    "one of them",
                );
                self.stands_in(format!("{path}.particles"));
                Vec::new()
            }
            (None, None) => {
                self.missing(
                    format!("{path}.particles"),
                    "rows of position and volume; or `file`",
                );
                Vec::new()
            }
            (None, Some(file)) => {
                let key = format!("{path}.file");
                match records::read_particles(&self.folder.join(file), self.dimension) {
                    Ok(seeds) => {
                        self.spelt(format!("{path}.particles"), key);
                        seeds
                    }
                    Err(error) => {
                        self.add_all(&key, error);
                        self.stands_in(format!("{path}.particles"));
                        Vec::new()
                    }
                }
            }
            (Some(rows), None) => {
                let mut seeds = Vec::new();
                for (i, row) in rows.iter().enumerate() {
                    let path = format!("{path}.particles[{i}]");
                    if self.length(&path, row, axes + 1) {
                        seeds.push(ParticleSeed {
                            position: self.components(&path, &row[..axes]),
                            volume: row[axes],
                        });
                    }
                }
                seeds
            }
        }
    }
}
