//! Mortar contact, boundaries, rigid lines and rigid surfaces from their keys.

use super::build::{Build, join};
use super::keys::{RawBody, RawContact, RawScene};
use super::materials::entry_path;
use super::words::{DETECTIONS, ENFORCEMENTS, FOLLOWS};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::{
    BodyBoundary, Enforcement, MortarContact, RigidFacets, RigidLine, Scene, Vertices,
};

impl Build<'_> {
    /// Boundaries of the bodies, rigid lines and rigid surfaces.
    pub(super) fn boundaries(&mut self, raw: &RawScene, scene: &mut Scene) {
        let bodies = [("body", &raw.body), ("bodies", &raw.bodies)]
            .into_iter()
            .find_map(|(key, list)| Some((key, list.as_ref()?)));
        if let Some((key, entries)) = bodies {
            for (i, (name, body)) in entries.0.iter().enumerate() {
                let path = entry_path(key, i, name.as_deref());
                let Some(id) = scene.bodies.get(i).map(|b| b.id) else {
                    continue;
                };
                if let Some(boundary) = self.boundary(&path, id, body) {
                    scene.mortar.boundaries.push(boundary);
                }
            }
        }
        for (i, (name, line)) in raw.rigid_line.iter().flat_map(|l| &l.0).enumerate() {
            let path = entry_path("rigid_line", i, name.as_deref());
            self.spelt(format!("rigid_line[{i}]"), path.clone());
            let points = join(&path, "points");
            let side = if line.closed == Some(true) {
                BoundarySide::Outer
            } else {
                BoundarySide::Open
            };
            let chain = if let Some(given) = &line.points {
                self.chain(&points, given, side)
            } else {
                self.missing(points.clone(), "a list of points, material on their left");
                None
            };
            if chain.is_none() {
                self.stands_in(points);
            }
            scene.mortar.lines.push(RigidLine {
                name: name.clone().unwrap_or_else(|| path.clone()),
                id: self.id(&path, line.id, i),
                chains: chain.into_iter().collect(),
                motion: line
                    .prescribed_velocity
                    .as_ref()
                    .map(|given| self.motion(&join(&path, "prescribed_velocity"), given)),
            });
        }
        self.rigid_surfaces(raw, scene);
    }

    fn rigid_surfaces(&mut self, raw: &RawScene, scene: &mut Scene) {
        for (i, (name, rigid)) in raw.rigid_surface.iter().flat_map(|l| &l.0).enumerate() {
            let path = entry_path("rigid_surface", i, name.as_deref());
            let key = |key: &str| join(&path, key);
            let motion = rigid
                .prescribed_velocity
                .as_ref()
                .map(|given| self.motion(&key("prescribed_velocity"), given));
            let (file, triangles) = (rigid.stl_mesh.as_deref(), rigid.triangles.as_deref());
            let Some(surface) = self.facets(&path, file, triangles) else {
                continue;
            };
            if file.is_none() {
                let checked = format!("rigid_surface[{}].stl_mesh", scene.mortar.facets.len());
                self.spelt(checked, key("triangles"));
            }
            self.spelt(
                format!("rigid_surface[{}]", scene.mortar.facets.len()),
                path.clone(),
            );
            scene.mortar.facets.push(RigidFacets {
                name: name.clone().unwrap_or_else(|| path.clone()),
                id: self.id(&path, rigid.id, i),
                surface,
                motion,
            });
        }
    }

    fn boundary(&mut self, path: &str, id: i64, raw: &RawBody) -> Option<BodyBoundary> {
        let given = [
            ("boundary_segment", raw.boundary_segment.is_some()),
            ("boundary", raw.boundary.is_some()),
            ("boundary_stl_mesh", raw.boundary_stl_mesh.is_some()),
        ];
        let given: Vec<&str> = given.iter().filter(|g| g.1).map(|g| g.0).collect();
        if let [_, second, ..] = given[..] {
            self.add(
                join(path, second),
                format!("`{}` together", given.join("` and `")),
                "one of them",
            );
            return None;
        }
        if raw.boundary_closed.is_some() && raw.boundary.is_none() {
            self.add(
                join(path, "boundary_closed"),
                "whether a list of vertices is closed, without one",
                "`boundary` beside it",
            );
        }
        let vertices = match (raw.boundary_segment, &raw.boundary, &raw.boundary_stl_mesh) {
            (Some(length), ..) => Vertices::Spacing(length),
            (_, Some(points), _) => {
                let path = join(path, "boundary");
                let side = if raw.boundary_closed == Some(false) {
                    BoundarySide::Open
                } else {
                    BoundarySide::Outer
                };
                Vertices::Given(vec![self.chain(&path, points, side)?])
            }
            (_, _, Some(file)) => {
                Vertices::Surface(self.triangles(join(path, "boundary_stl_mesh"), file)?)
            }
            _ => {
                if raw.boundary_follows.is_some() {
                    self.add(
                        join(path, "boundary_follows"),
                        "how a boundary follows, without a boundary",
                        "`boundary_segment`, `boundary` or `boundary_stl_mesh` beside it",
                    );
                }
                return None;
            }
        };
        let follow = self.word_or(
            &join(path, "boundary_follows"),
            raw.boundary_follows.as_ref(),
            FOLLOWS,
            FollowMode::Spin,
        );
        Some(BodyBoundary {
            body: id,
            vertices,
            follow,
        })
    }

    fn chain(&mut self, path: &str, given: &[Vec<f64>], side: BoundarySide) -> Option<Chain> {
        let axes = self.dimension.axes();
        let mut points = vec![];
        for (i, point) in given.iter().enumerate() {
            let path = format!("{path}[{i}]");
            if self.length(&path, point, axes) {
                let [x, y, _] = self.components(&path, point);
                points.push(Point::new(x, y));
            }
        }
        (points.len() == given.len()).then_some(Chain { points, side })
    }

    /// A contact entry with the method `mortar`; `ends` are its master and slave.
    pub(super) fn mortar_contact(
        &mut self,
        path: &str,
        raw: &RawContact,
        id: i64,
        friction: f64,
        ends: [Option<i64>; 2],
        scene: &mut Scene,
    ) {
        let key = |key: &str| join(path, key);
        self.spelt(
            format!("mortar[{}]", scene.mortar.contacts.len()),
            path.to_owned(),
        );
        if raw.normal_type.is_some() {
            self.add(
                key("normal_type"),
                "a normal from mass gradients, which the method mortar does not use",
                "no `normal_type`: normals are those of the slave's boundary",
            );
        }
        let critical_gap = self.number(
            &key("critical_gap"),
            raw.critical_gap,
            "the gap at which contact begins, greater than 0 [m]",
        );
        let normal_stiffness = self.number(
            &key("normal_stiffness"),
            raw.normal_stiffness,
            "the stiffness of the barrier, greater than 0 [Pa/m]",
        );
        if ends.contains(&None) {
            self.stands_in(path);
        }
        let mut contact = MortarContact {
            name: path.to_owned(),
            id,
            master: ends[0].unwrap_or(i64::MIN),
            slave: ends[1].unwrap_or(i64::MAX),
            friction,
            critical_gap,
            normal_stiffness,
            tangential_stiffness: raw.tangential_stiffness.unwrap_or(0.0),
            enforcement: self.word_or(
                &key("enforcement"),
                raw.enforcement.as_ref(),
                ENFORCEMENTS,
                Enforcement::Barrier,
            ),
            detection: self.word_or(
                &key("detection"),
                raw.detection.as_ref(),
                DETECTIONS,
                Detection::Mortar,
            ),
        };
        if friction > 0.0 && raw.tangential_stiffness.is_none() {
            match scene.usual_tangential_stiffness(&contact) {
                Some(usual) => contact.tangential_stiffness = usual,
                None => self.missing(
                    key("tangential_stiffness"),
                    "the stiffness of the tangential spring, greater than 0 [Pa/m]",
                ),
            }
        }
        scene.mortar.contacts.push(contact);
    }

    /// Keys of mortar contact in an entry of another method.
    pub(super) fn refuse_mortar_keys(&mut self, path: &str, raw: &RawContact) {
        let given = [
            ("critical_gap", raw.critical_gap.is_some()),
            ("normal_stiffness", raw.normal_stiffness.is_some()),
            ("tangential_stiffness", raw.tangential_stiffness.is_some()),
            ("enforcement", raw.enforcement.is_some()),
            ("detection", raw.detection.is_some()),
        ];
        for (key, _) in given.into_iter().filter(|(_, given)| *given) {
            self.add(
                join(path, key),
                "a key of mortar contact in a contact on the grid",
                format!("no `{key}`, or `method` \"mortar\""),
            );
        }
    }
}
