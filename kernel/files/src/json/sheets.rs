//! Surfaces of ground from their keys: a level, a line of points, or a file.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};

use super::build::Build;
use super::keys::RawBody;
use crate::terrain;
use proctor_kernel::enclosed::EnclosedRegion;
use proctor_kernel::number::Number;
use proctor_kernel::sheet::{PlanRange, Sheet, SheetFault};
use proctor_kernel::stratum::Stratum;
use proctor_scene::{Dimension, Mesh, Shape};

/// A level, a line of points or the name of a file.
#[derive(Debug)]
pub(super) enum RawSheet {
    Level(f64),
    Line(Vec<Vec<f64>>),
    File(String),
}

struct RawSheetVisitor;

impl<'de> Visitor<'de> for RawSheetVisitor {
    type Value = RawSheet;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, a list of points, or the name of a file")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<RawSheet, E> {
        Ok(RawSheet::Level(value))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<RawSheet, E> {
        Ok(RawSheet::Level(value as f64))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<RawSheet, E> {
        Ok(RawSheet::Level(value as f64))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<RawSheet, E> {
        Ok(RawSheet::File(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<RawSheet, A::Error> {
        let mut points = Vec::new();
        while let Some(point) = list.next_element()? {
            points.push(point);
        }
        Ok(RawSheet::Line(points))
    }
}

impl<'de> Deserialize<'de> for RawSheet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RawSheetVisitor)
    }
}

impl JsonSchema for RawSheet {
    fn schema_name() -> Cow<'static, str> {
        "Sheet".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "type": "number" },
                { "type": "array", "items": { "type": "array", "items": { "type": "number" } } },
                { "type": "string" },
            ]
        })
    }
}

/// Forms of a surface that are accepted.
pub(super) fn forms(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::Two => "a level [m], a list of points [x, y], or a file of them",
        Dimension::Three => {
            "a level [m], or a file: an ESRI ASCII grid, a table of x, y, z on a regular grid, or an STL surface"
        }
    }
}

impl Build<'_> {
    /// A surface that has one height everywhere above a rectangle of the plan.
    pub(super) fn sheet(&mut self, path: &str, raw: &RawSheet, range: &PlanRange) -> Option<Sheet> {
        let (sheet, of) = match raw {
            RawSheet::Level(level) => (Sheet::Level(*level), String::new()),
            RawSheet::Line(points) => (self.polyline(path, points)?, String::new()),
            RawSheet::File(name) => match terrain::read(&self.folder.join(name), self.dimension) {
                Ok(sheet) => (sheet, format!("{name}: ")),
                Err(error) => {
                    self.add_all(path, error);
                    return None;
                }
            },
        };
        let Some(fault) = sheet.fault(range) else {
            return Some(sheet);
        };
        let (found, at) = match fault {
            SheetFault::Hole(at) => ("no height", at),
            SheetFault::Fold(at) => ("more than one height", at),
        };
        let reach = sheet.extent().map_or_else(String::new, |extent| {
            if extent.iter().flatten().all(|x| x.is_finite()) {
                format!(", it reaches over {}", self.plan_words(&extent))
            } else {
                ", none of its cells has four heights".to_owned()
            }
        });
        let place = self.plan_place(at);
        let whole = self.plan_words(range);
        self.add(
            path,
            format!("{of}{found} at {place}{reach}"),
            format!("one height everywhere above the plan of the body, {whole}"),
        );
        None
    }

    fn polyline(&mut self, path: &str, points: &[Vec<f64>]) -> Option<Sheet> {
        if self.dimension == Dimension::Three {
            self.add(
                path,
                "a list of points in 3 dimensions",
                forms(self.dimension),
            );
            return None;
        }
        let mut line: Vec<[f64; 2]> = vec![];
        for (i, point) in points.iter().enumerate() {
            let path = format!("{path}[{i}]");
            let &[x, y] = point.as_slice() else {
                let found = format!("a list of length {}", point.len());
                self.add(path, found, "2 numbers, x and y [m]");
                return None;
            };
            if let Some([before, _]) = line.last().filter(|last| last[0] >= x) {
                self.add(
                    path,
                    format!("x = {x} after x = {before}"),
                    "x in ascending order [m]: one height above each point",
                );
                return None;
            }
            line.push([x, y]);
        }
        if line.len() < 2 {
            let found = format!("{} point(s)", line.len());
            self.add(path, found, "at least two points [m]");
            return None;
        }
        Some(Sheet::polyline(&line))
    }

    /// The rectangle of the plan of a body: that of its key, or of the mesh.
    pub(super) fn plan_range(
        &mut self,
        path: &str,
        raw: Option<&Vec<Vec<f64>>>,
        mesh: &Mesh,
    ) -> Option<PlanRange> {
        let axes = self.dimension.axes() - 1;
        let upper = mesh.upper();
        let mut range = [[0.0, 1.0]; 2];
        for axis in 0..axes {
            range[axis] = [mesh.origin[axis], upper[axis]];
        }
        let Some(given) = raw else {
            let sound = range
                .iter()
                .all(|[low, high]| low < high && high.is_finite());
            return sound.then_some(range);
        };
        let accepted = match self.dimension {
            Dimension::Two => "one row, the lower and the upper x [m]",
            Dimension::Three => {
                "two rows, each the lower and the upper coordinate, of x and of y [m]"
            }
        };
        if given.len() != axes {
            let found = format!("a list of length {}", given.len());
            self.add(format!("{path}.plan"), found, accepted);
            return None;
        }
        for (axis, row) in given.iter().enumerate() {
            let key = format!("{path}.plan[{axis}]");
            match row[..] {
                [low, high] if low < high => {
                    for (side, x) in [low, high].into_iter().enumerate() {
                        let tolerance = mesh.tolerance(axis);
                        if x < range[axis][0] - tolerance || x > range[axis][1] + tolerance {
                            let name = ["x", "y"][axis];
                            let [from, to] = range[axis].map(Number);
                            self.add(
                                format!("{key}[{side}]"),
                                format!("{name} = {x}, outside the mesh"),
                                format!("{name} from {from} to {to} [m]"),
                            );
                            return None;
                        }
                    }
                }
                _ => {
                    self.add(key, format!("{row:?}"), accepted);
                    return None;
                }
            }
        }
        for (axis, row) in given.iter().enumerate() {
            range[axis] = [row[0], row[1]];
        }
        Some(range)
    }

    /// The ground between two surfaces.
    pub(super) fn between(&mut self, path: &str, raw: &RawBody, mesh: &Mesh) -> Option<Stratum> {
        let range = self.plan_range(path, raw.plan.as_ref(), mesh);
        let mut sheets = [None, None];
        for (side, (key, raw)) in [("lower", &raw.lower), ("upper", &raw.upper)]
            .into_iter()
            .enumerate()
        {
            let path = format!("{path}.{key}");
            match (raw, range) {
                (None, _) => self.missing(path, forms(self.dimension)),
                (Some(raw), Some(range)) => sheets[side] = self.sheet(&path, raw, &range),
                (Some(_), None) => {}
            }
        }
        let [Some(lower), Some(upper)] = sheets else {
            return None;
        };
        let range = range?;
        if let Some((at, [low, high])) = lower.above(&upper, &range) {
            let place = self.plan_place(at);
            self.add(
                format!("{path}.lower"),
                format!("{low} m at {place}, above `upper` with {high} m there"),
                "a surface that is nowhere above `upper`",
            );
            return None;
        }
        let stratum = Stratum::new(self.dimension.axes(), range, lower, upper);
        if stratum.volume() <= 0.0 {
            self.add(
                format!("{path}.upper"),
                "the same as `lower` everywhere: an empty body",
                "a surface above `lower`",
            );
            return None;
        }
        Some(stratum)
    }

    /// The inside of a closed surface.
    pub(super) fn enclosed(&mut self, path: &str, raw: &RawBody) -> Option<Shape> {
        let key = format!("{path}.stl_mesh");
        let Some(file) = &raw.stl_mesh else {
            self.missing(key, "the path of an STL file");
            return None;
        };
        let surface = self.triangles(key.clone(), file)?;
        if let Err(error) = surface.require_closed() {
            let found = format!("{file}: {}", error.kind);
            self.add(key, found, error.kind.accepted());
            return None;
        }
        let (corners, triangles) = (surface.vertices(), surface.triangles());
        let body = EnclosedRegion::new(corners.to_vec(), triangles.to_vec());
        Some(Shape::Enclosed(Arc::new(body)))
    }

    /// Words for a point of the plan.
    pub(super) fn plan_place(&self, at: [f64; 2]) -> String {
        let [x, y] = at.map(|x| (1e6 * x).round() / 1e6);
        match self.dimension {
            Dimension::Two => format!("x = {x}"),
            Dimension::Three => format!("x = {x}, y = {y}"),
        }
    }

    /// Words for a rectangle of the plan.
    fn plan_words(&self, [x, y]: &PlanRange) -> String {
        let words = |name: &str, [low, high]: [f64; 2]| {
            format!("{name} from {} to {}", Number(low), Number(high))
        };
        match self.dimension {
            Dimension::Two => words("x", *x),
            Dimension::Three => format!("{}, {}", words("x", *x), words("y", *y)),
        }
    }
}
