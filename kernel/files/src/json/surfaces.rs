//! Rigid surfaces from their keys.

use super::build::Build;
use super::keys::{RawScene, RawTerrainContact};
use super::lists::Terrains;
use crate::stl;
use proctor_kernel::scene::{Mesh, RigidSurface};
use proctor_kernel::surface::Surface;
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
        let Some(file) = &raw.stl_mesh else {
            self.missing(key("stl_mesh"), "the path of an STL file");
            return None;
        };
        Some(RigidSurface {
            name: file.clone(),
            surface: self.triangles(key("stl_mesh"), file)?,
            friction: raw.friction.unwrap_or(0.0),
            distance_threshold: raw.distance_threshold.unwrap_or(smallest),
            penalty_stiffness: penalty,
            motion,
        })
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
