//! Bodies of several parts from their keys: layers, and boxes of other material or other particles.
//!
//! Each part becomes a body of its own. Bodies that are in no contact share one velocity field, so the parts move as one.

use std::sync::Arc;

use super::build::Build;
use super::keys::{RawBody, RawScene, RawZone};
use super::sheets::forms;
use super::words::{ShapeKind, meaning, shapes};
use proctor_kernel::sheet::Sheet;
use proctor_kernel::stratum::Stratum;
use proctor_scene::{Body, InitialStress, Material, Mesh, Overburden, Shape, Vector};

/// Share of the volume of a body below which a part of it is round-off.
const NO_VOLUME: f64 = 1e-12;

/// Stands for an identifier that is not chosen yet. Before it come those of entries without one, which are refused.
const NO_ID: i64 = i64::MAX;

/// Ground with one material and one earth pressure at rest.
struct Part {
    key: String,
    id: Option<i64>,
    material: usize,
    ratio: Option<f64>,
    counts: [usize; 3],
    ground: Stratum,
}

/// A box of a body.
pub(super) struct Zone<'a> {
    path: String,
    pub corners: [Vector; 2],
    pub material: Option<usize>,
    raw: &'a RawZone,
}

impl Build<'_> {
    /// The bodies of one entry: its parts, or itself.
    pub(super) fn parts(
        &mut self,
        path: &str,
        body: Body,
        raw: &RawBody,
        (mesh, materials): (&Mesh, &[Material]),
    ) -> Vec<Body> {
        let has_parts = raw.layers.is_some() || raw.zones.is_some();
        let stratum = match &body.shape {
            Shape::Stratum(stratum) => Some(stratum.as_ref().clone()),
            Shape::Cuboid { p1, p2 } if has_parts => self.boxed(p1, p2),
            _ => None,
        };
        let Some(whole) = stratum else {
            let word = raw.r#type.as_deref().unwrap_or("");
            let kind = meaning(word, shapes(self.dimension));
            let can_have = [ShapeKind::Between, ShapeKind::Cuboid, ShapeKind::Rectangle];
            if has_parts && kind.is_some_and(|kind| !can_have.contains(&kind)) {
                let key = if raw.layers.is_some() {
                    "layers"
                } else {
                    "zones"
                };
                self.add(
                    format!("{path}.{key}"),
                    format!("`{key}` in a body of the type {word:?}"),
                    "a body of the type \"between\", \"rectangle\" or \"cuboid\"",
                );
            }
            let mut body = body;
            if raw.layers.is_some() {
                // Each layer would have its own.
                self.stands_in(format!("{path}.material_id"));
            }
            if kind == Some(ShapeKind::Between) {
                // The message names the fault of its surface alone, from which others would follow.
                body.initial_stress = InitialStress::None;
                return vec![body];
            }
            let density = materials
                .get(body.material)
                .map(|material| material.density);
            if let Some(rest) = self.rest_below(path, raw, mesh, &body.shape, density) {
                body.initial_stress = InitialStress::Overburden(rest);
            }
            return vec![body];
        };
        let before = self.problem_count();
        let bases = self.bases(path, raw, &whole);
        let zones = self.zones(path, raw, materials);
        let layers = self.layer_materials(path, raw, body.material, materials);
        if self.problem_count() > before {
            // Its shape alone is checked further.
            if raw.layers.is_some() {
                self.stands_in(format!("{path}.material_id"));
            }
            return vec![body];
        }
        let parts = self.divided(path, &body, raw, &whole, (&bases, &layers, &zones));
        let rest = self.at_rest(path, raw, &whole, (&bases, &layers, &zones), materials);
        if parts.len() > 1 {
            self.divided_bodies.push(body.id);
            let boundary = [
                ("boundary_segment", raw.boundary_segment.is_some()),
                ("boundary", raw.boundary.is_some()),
                ("boundary_stl_mesh", raw.boundary_stl_mesh.is_some()),
            ];
            if let Some((key, _)) = boundary.into_iter().find(|(_, given)| *given) {
                self.add(
                    format!("{path}.{key}"),
                    "a boundary of a body with layers or zones",
                    "a body of one material",
                );
            }
        }
        let single = parts.len() == 1 && matches!(body.shape, Shape::Cuboid { .. });
        let mut bodies = vec![];
        for part in parts {
            let initial_stress = match &rest {
                None => body.initial_stress.clone(),
                Some(rest) => InitialStress::Overburden(Overburden {
                    ratio: part.ratio.unwrap_or(rest.ratio),
                    ..rest.clone()
                }),
            };
            let key = if part.key.is_empty() {
                String::new()
            } else {
                format!(".{}", part.key)
            };
            bodies.push(Body {
                name: format!("{}{key}", body.name),
                id: part.id.unwrap_or(NO_ID),
                material: part.material,
                shape: if single {
                    body.shape.clone()
                } else {
                    Shape::Stratum(Arc::new(part.ground))
                },
                particles_per_cell: part.counts,
                initial_stress,
                ..body.clone()
            });
        }
        bodies
    }

    /// A box as ground, unless its corners are not in order.
    fn boxed(&self, p1: &Vector, p2: &Vector) -> Option<Stratum> {
        let axes = self.dimension.axes();
        let sound = (0..axes).all(|axis| p1[axis] < p2[axis] && p2[axis].is_finite());
        (sound && p1.iter().all(|x| x.is_finite())).then(|| Stratum::of_box(axes, p1, p2))
    }

    /// The surfaces between the layers, from the top to the bottom.
    fn bases(&mut self, path: &str, raw: &RawBody, whole: &Stratum) -> Vec<Sheet> {
        let layers = raw.layers.as_deref().unwrap_or(&[]);
        let mut bases: Vec<Sheet> = vec![];
        for (i, layer) in layers.iter().enumerate() {
            let key = format!("{path}.layers[{i}].base");
            let is_last = i + 1 == layers.len();
            match &layer.base {
                None if is_last => {}
                None => self.missing(key, forms(self.dimension)),
                Some(_) if is_last => self.add(
                    key,
                    "the base of the last layer",
                    "no `base`: the last layer reaches down to the end of the body",
                ),
                Some(base) => {
                    let Some(sheet) = self.sheet(&key, base, whole.range()) else {
                        continue;
                    };
                    if let Some((at, [low, high])) = bases
                        .last()
                        .and_then(|above| sheet.above(above, whole.range()))
                    {
                        let place = self.plan_place(at);
                        self.add(
                            key,
                            format!("{low} m at {place}, above the base of the layer before with {high} m there"),
                            "layers from the top to the bottom, whose bases do not cross",
                        );
                    }
                    bases.push(sheet);
                }
            }
        }
        if raw.layers.as_ref().is_some_and(Vec::is_empty) {
            self.add(
                format!("{path}.layers"),
                "an empty list",
                "at least one layer",
            );
        }
        bases
    }

    /// The boxes whose corners are in order.
    fn zones<'r>(&mut self, path: &str, raw: &'r RawBody, materials: &[Material]) -> Vec<Zone<'r>> {
        let mut zones = vec![];
        for (i, zone) in raw.zones.iter().flatten().enumerate() {
            let path = format!("{path}.zones[{i}]");
            let corners =
                [("point_p1", &zone.point_p1), ("point_p2", &zone.point_p2)].map(|(key, value)| {
                    self.vector(&format!("{path}.{key}"), value.as_ref(), "a corner [m]")
                });
            let axes = self.dimension.axes();
            if let Some(axis) = (0..axes).find(|axis| corners[1][*axis] <= corners[0][*axis]) {
                let [low, high] = corners.map(|corner| corner[axis]);
                self.add(
                    format!("{path}.point_p2[{axis}]"),
                    format!("{high}, which makes the box empty"),
                    format!("a number greater than point_p1[{axis}] = {low} [m]"),
                );
            }
            if zone.material_id.is_none() && zone.particles_per_cell.is_none() {
                self.missing(
                    format!("{path}.material_id"),
                    "`material_id` or `particles_per_cell`: a box with the values that differ in it",
                );
            }
            let key = format!("{path}.material_id");
            let material =
                (zone.material_id).map(|id| self.material_index(&key, Some(id), materials));
            zones.push(Zone {
                path,
                corners,
                material,
                raw: zone,
            });
        }
        zones
    }

    /// Materials of the layers from the top to the bottom; that of the body where it has none.
    fn layer_materials(
        &mut self,
        path: &str,
        raw: &RawBody,
        own: usize,
        materials: &[Material],
    ) -> Vec<usize> {
        let Some(layers) = &raw.layers else {
            return vec![own];
        };
        if raw.material_id.is_some() {
            self.add(
                format!("{path}.material_id"),
                "`material_id` and `layers` together",
                "the material of each layer in `layers`",
            );
        }
        let of = |(i, id): (usize, Option<i64>)| {
            self.material_index(&format!("{path}.layers[{i}].material_id"), id, materials)
        };
        let ids = layers.iter().map(|layer| layer.material_id);
        ids.enumerate().map(of).collect()
    }

    /// The parts of a body with their particles, none of them empty.
    fn divided(
        &mut self,
        path: &str,
        body: &Body,
        raw: &RawBody,
        whole: &Stratum,
        (bases, layers, zones): (&[Sheet], &[usize], &[Zone<'_>]),
    ) -> Vec<Part> {
        let nothing = NO_VOLUME * whole.volume();
        let boxes: Vec<[Vector; 2]> = zones.iter().map(|zone| zone.corners).collect();
        let mut parts = vec![];
        let raw_layers = raw.layers.as_deref().unwrap_or(&[]);
        let counts_of = |build: &mut Self, k: usize| match raw_layers.get(k) {
            Some(layer) => {
                layer
                    .particles_per_cell
                    .as_ref()
                    .map_or(body.particles_per_cell, |given| {
                        let key = format!("{path}.layers[{k}].particles_per_cell");
                        build.counts(&key, given, body.particles_per_cell)
                    })
            }
            None => body.particles_per_cell,
        };
        for (k, material) in layers.iter().enumerate() {
            let ground = layer(whole, bases, k, None, &boxes);
            let is_layer = raw.layers.is_some();
            if is_layer && layer(whole, bases, k, None, &[]).volume() <= nothing {
                self.add(
                    format!("{path}.layers[{k}]"),
                    "a layer that lies nowhere in the body",
                    "a layer with a volume",
                );
                continue;
            }
            if ground.volume() <= nothing {
                continue;
            }
            let counts = counts_of(self, k);
            parts.push(Part {
                key: if is_layer {
                    format!("layers[{k}]")
                } else {
                    String::new()
                },
                id: raw_layers.get(k).and_then(|layer| layer.id),
                material: *material,
                ratio: raw_layers.get(k).and_then(|layer| layer.ratio),
                counts,
                ground,
            });
        }
        for (z, zone) in zones.iter().enumerate() {
            let before = parts.len();
            let later = &boxes[z + 1..];
            for (k, own) in layers.iter().enumerate() {
                let ground = if zone.material.is_some() {
                    whole.part(&[], &[], Some(&zone.corners), later)
                } else {
                    layer(whole, bases, k, Some(&zone.corners), later)
                };
                if ground.volume() > nothing {
                    let mut counts = counts_of(self, k);
                    if let Some(given) = &zone.raw.particles_per_cell {
                        counts = self.counts(
                            &format!("{}.particles_per_cell", zone.path),
                            given,
                            counts,
                        );
                    }
                    parts.push(Part {
                        key: match (zone.material, layers.len()) {
                            (None, 2..) => format!("zones[{z}] of layers[{k}]"),
                            _ => format!("zones[{z}]"),
                        },
                        id: zone.raw.id.filter(|_| parts.len() == before),
                        material: zone.material.unwrap_or(*own),
                        ratio: raw_layers.get(k).and_then(|layer| layer.ratio),
                        counts,
                        ground,
                    });
                }
                if zone.material.is_some() {
                    break;
                }
            }
            if parts.len() == before {
                self.add(
                    zone.path.clone(),
                    "a box in which nothing of the body lies",
                    "a box that holds a part of the body, and that no later one covers",
                );
            }
        }
        if let Some(first) = parts.first_mut() {
            first.id = Some(body.id);
        }
        parts
    }

    /// Gives the parts without an identifier the next ones that nothing in the scene has.
    pub(super) fn number_parts(raw: &RawScene, bodies: &mut [Body]) {
        let entries = [raw.body.as_ref(), raw.bodies.as_ref()]
            .into_iter()
            .flatten();
        let mut last = 0;
        for (_, entry) in entries.flat_map(|entries| &entries.0) {
            let layers = entry.layers.iter().flatten().filter_map(|layer| layer.id);
            let zones = entry.zones.iter().flatten().filter_map(|zone| zone.id);
            for id in entry.id.into_iter().chain(layers).chain(zones) {
                last = last.max(id);
            }
        }
        let rigid = raw.rigid_line.iter().flat_map(|lines| &lines.0);
        last = rigid.filter_map(|(_, line)| line.id).fold(last, i64::max);
        let surfaces = raw.rigid_surface.iter().flat_map(|all| &all.0);
        last = surfaces.filter_map(|(_, one)| one.id).fold(last, i64::max);
        for body in bodies.iter_mut().filter(|body| body.id == NO_ID) {
            last = last.saturating_add(1);
            body.id = last;
        }
    }
}

/// A layer of ground, or the part of it in a box, less some boxes.
pub(super) fn layer(
    whole: &Stratum,
    bases: &[Sheet],
    index: usize,
    inside: Option<&[Vector; 2]>,
    outside: &[[Vector; 2]],
) -> Stratum {
    let above = bases.get(index).map_or(&[][..], std::slice::from_ref);
    let below = if index == 0 {
        &[]
    } else {
        &bases[index - 1..index]
    };
    whole.part(above, below, inside, outside)
}
