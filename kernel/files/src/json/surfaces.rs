//! Rigid surfaces from their keys.

use super::build::{Build, join};
use super::keys::{RawScene, RawTerrainContact};
use super::lists::Terrains;
use crate::stl;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::{Mesh, RigidSurface};
use std::sync::Arc;

impl Build<'_> {
    /// The surfaces that are active and can be read.
    pub(super) fn surfaces(&mut self, raw: &RawScene, mesh: &Mesh) -> Vec<RigidSurface> {
        let given: Vec<(String, &RawTerrainContact)> = match &raw.terrain_contact {
            None => vec![],
            Some(Terrains::One(raw)) => vec![("terrain_contact".into(), raw)],
            Some(Terrains::List(list)) => list
                .iter()
                .enumerate()
                .map(|(i, raw)| (format!("terrain_contact[{i}]"), raw))
                .collect(),
        };
        let mut surfaces = vec![];
        for (path, raw) in given {
            let checked = format!("terrain_contact[{}]", surfaces.len());
            if let Some(surface) = self.surface(&path, raw, mesh) {
                self.spelt(checked, path);
                surfaces.push(surface);
            }
        }
        surfaces
    }

    fn surface(
        &mut self,
        path: &str,
        raw: &RawTerrainContact,
        mesh: &Mesh,
    ) -> Option<RigidSurface> {
        let key = |key: &str| format!("{path}.{key}");
        // As for a record: a surface that is silently not there is worth an error.
        match raw.active {
            Some(true) => {}
            Some(false) => return None,
            None => {
                self.missing(key("active"), "true or false");
                return None;
            }
        }
        let smallest = mesh.cell[..self.dimension.axes()]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let penalty = match (raw.penalty_contact_active, raw.penalty_stiffness) {
            (Some(false), _) | (None, None) => None,
            (Some(true), None) => {
                self.missing(key("penalty_stiffness"), "a number greater than 0 [N/m]");
                None
            }
            (_, Some(stiffness)) => Some(stiffness),
        };
        let motion = raw
            .prescribed_velocity
            .as_ref()
            .map(|given| self.motion(&key("prescribed_velocity"), given));
        let surface = self.facets(path, raw.stl_mesh.as_deref(), raw.triangles.as_deref())?;
        Some(RigidSurface {
            name: raw.stl_mesh.clone().unwrap_or_else(|| path.to_owned()),
            surface,
            friction: raw.friction.unwrap_or(0.0),
            distance_threshold: raw.distance_threshold.unwrap_or(smallest),
            penalty_stiffness: penalty,
            motion,
        })
    }

    /// The surface of a block: that of its STL file, or of the triangles that stand in it.
    pub(super) fn facets(
        &mut self,
        path: &str,
        file: Option<&str>,
        triangles: Option<&[Vec<Vec<f64>>]>,
    ) -> Option<Arc<Surface>> {
        match (file, triangles) {
            (Some(file), None) => self.triangles(join(path, "stl_mesh"), file),
            (None, Some(given)) => self.given_triangles(&join(path, "triangles"), given),
            (None, None) => {
                self.missing(
                    join(path, "stl_mesh"),
                    "the path of an STL file, or `triangles`",
                );
                None
            }
            (Some(_), Some(_)) => {
                let found = "`stl_mesh` and `triangles` together";
                self.add(join(path, "triangles"), found, "one of them");
                None
            }
        }
    }

    /// The surface of triangles that are given as lists of three corners.
    fn given_triangles(&mut self, path: &str, given: &[Vec<Vec<f64>>]) -> Option<Arc<Surface>> {
        let mut corners = vec![];
        for (i, triangle) in given.iter().enumerate() {
            let path = format!("{path}[{i}]");
            let found = match triangle.as_slice() {
                [a, b, c] => [a, b, c].map(|point| <[f64; 3]>::try_from(point.as_slice()).ok()),
                _ => [None; 3],
            };
            if let [Some(a), Some(b), Some(c)] = found {
                corners.push([a, b, c]);
            } else {
                self.add(
                    path,
                    "no triangle",
                    "a list of three corners, each three numbers [m]",
                );
            }
        }
        if corners.len() < given.len() {
            return None;
        }
        match Surface::new(&corners) {
            Ok(surface) => Some(Arc::new(surface)),
            Err(error) => {
                self.add(path, error.kind.to_string(), error.kind.accepted());
                None
            }
        }
    }

    /// The surface in an STL file named by a key.
    pub(super) fn triangles(&mut self, path: String, file: &str) -> Option<Arc<Surface>> {
        match stl::read(&self.folder.join(file)) {
            Ok(surface) => Some(Arc::new(surface)),
            Err(error) => {
                self.add(
                    path,
                    format!("{}: {}", error.file.display(), error.kind),
                    error.kind.accepted(),
                );
                None
            }
        }
    }
}
