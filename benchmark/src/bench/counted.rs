//! Counted items: scenes, methods, parts of a step, laws, and features that do nothing.

use super::scenes;
use super::sources::{Digest, KeptDigests, Sources};
use crate::record::{Record, Row};
use proctor_scene::simulation::Part;
use serde_json::{Value, json};
use std::error::Error;
use std::path::Path;

/// Steps, or plays of a part, that are counted.
pub const TIMES: usize = 12;

/// Particles of a scene: enough that a step is the work on particles.
const PARTICLES: usize = 8000;
/// Start of the names of scenes whose rows are those of laws.
const SLABS: &str = "slabs-";

/// Something that is counted: a scene, and `step` or the part of a step that is played.
pub struct Item {
    /// Scene and methods, as in `moving-3d/step`.
    pub name: String,
    /// The scene, in the language of scenes.
    pub scene: Value,
    /// `step`, or the name of a part of a step.
    pub what: &'static str,
}

impl Item {
    /// The name of its row in a record.
    #[must_use]
    pub fn row(&self) -> String {
        format!("instructions/{}", self.name)
    }
}

/// Scenes with whole steps, methods and single parts.
///
/// # Errors
/// If a scene of that name is missing.
pub fn scenes_and_parts() -> Result<Vec<Item>, Box<dyn Error>> {
    let make = |name: &str| -> Result<Value, Box<dyn Error>> {
        let (scene, axes) = scenes::find(name).ok_or("no such scene")?;
        let mut scene = scene.make(axes, PARTICLES).scene;
        scene["results"] = json!({ "print": 0 });
        Ok(scene)
    };
    let mut items = vec![];
    let mut push = |name: String, scene: Value, what| items.push(Item { name, scene, what });
    for name in scenes::names().filter(|name| !name.starts_with(SLABS)) {
        // What water costs is seen beside the same scene without.
        let row = name.replace("consolidation_dry-2d", "consolidation-2d/dry");
        let row = row.replace("consolidation_dry-3d", "consolidation-3d/dry");
        push(format!("{row}/step"), make(&name)?, "step");
    }
    let moving = make("moving-3d")?;
    for (weighting, scheme, transfer) in [
        ("linear", "USL", "FLIP"),
        ("cpGIMP", "USL", "FLIP"),
        ("quadratic_bspline", "USL", "FLIP"),
        ("uGIMP", "MUSL", "FLIP"),
        ("uGIMP", "USF", "FLIP"),
        ("uGIMP", "USL", "APIC"),
        ("uGIMP", "USL", "TPIC"),
    ] {
        let mut scene = moving.clone();
        scene["shape_function"] = weighting.into();
        scene["stress_scheme_update"] = scheme.into();
        scene["transfer"] = transfer.into();
        let name = format!("moving-3d/{weighting}/{scheme}/{transfer}/step");
        push(name, scene, "step");
    }
    for part in Part::ALL {
        let name = format!("moving-3d/{}", part.name());
        push(name, moving.clone(), part.name());
    }
    for name in scenes::names() {
        // Such as slabs-von_mises-below-3d: laws of one elasticity.
        if let Some((law, axes)) = name
            .strip_prefix(SLABS)
            .and_then(|name| name.rsplit_once('-'))
        {
            let law = law.replace('-', "/");
            push(format!("laws-{axes}/{law}/step"), make(&name)?, "step");
        }
    }
    Ok(items)
}

/// Features that do nothing, and the scene without them.
pub struct Group {
    /// The scene without a feature.
    pub base: Item,
    /// The same scene with one feature each.
    pub features: Vec<Item>,
}

impl Group {
    fn new(base: (&str, Value), features: Vec<(&str, Value)>) -> Self {
        let item = |(name, scene)| Item {
            name: format!("feature/{name}"),
            scene,
            what: "step",
        };
        Self {
            base: item(base),
            features: features.into_iter().map(item).collect(),
        }
    }
}

/// All features that do nothing.
#[must_use]
pub fn features() -> Vec<Group> {
    let plain = plain();
    let with = |key: &str, value: Value| {
        let mut scene = plain.clone();
        scene[key] = value;
        scene
    };
    let mut far_plane = plain.clone();
    far_plane["mesh"]["boundary_conditions"]["plane_Xn"] = "sliding".into();
    let mut second = plain["material"][0].clone();
    second["id"] = 2.into();
    let mut two_bodies = plain.clone();
    let mut far = plain["body"][0].clone();
    for (key, value) in [
        ("id", json!(2)),
        ("point_p1", json!([1.7, 1.7, 1.7])),
        ("point_p2", json!([1.8, 1.8, 1.8])),
        ("initial_velocity", json!([0, 0, 0])),
    ] {
        far[key] = value;
    }
    two_bodies["body"] = json!([plain["body"][0], far]);
    let mut contact = two_bodies.clone();
    contact["contact"] = json!([{ "id": 1, "friction": 0.3, "master_id": 1, "slave_id": 2 }]);
    vec![
        Group::new(
            ("none", plain.clone()),
            vec![
                (
                    "local-damping",
                    with("damping", json!({ "type": "local", "value": 0 })),
                ),
                (
                    "viscous-damping",
                    with("damping", json!({ "type": "viscous", "value": 0 })),
                ),
                (
                    "second-material",
                    with("material", json!([plain["material"][0], second])),
                ),
                ("far-plane", far_plane),
                (
                    "zero-load",
                    with("nodal_point_load", json!([[[0.7, 0.7, 0.7], [0, 0, 0]]])),
                ),
            ],
        ),
        Group::new(("far-body", two_bodies), vec![("far-contact", contact)]),
    ]
}

/// A block that flies and falls clear of all planes, which are free.
fn plain() -> Value {
    let planes =
        ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"].map(|p| (format!("plane_{p}"), json!("free")));
    json!({
        "dimension": 3,
        "time": 1.0,
        "gravity": [0, 0, -10],
        "results": { "print": 0 },
        "mesh": {
            "cells_dimension": [0.1, 0.1, 0.1],
            "cells_number": [18, 18, 18],
            "boundary_conditions": planes.into_iter().collect::<serde_json::Map<_, _>>(),
        },
        "material": [{ "type": "elastic", "id": 1, "young": 1e6, "density": 1000, "poisson": 0.3 }],
        "body": [{
            "type": "cuboid", "id": 1, "material_id": 1,
            "point_p1": [0.2, 0.2, 0.2], "point_p2": [1.2, 1.2, 1.2],
            "initial_velocity": [1, 0.5, 0],
        }],
    })
}

/// Counts of an earlier record, with the digests of the sources that were counted then and of those of today.
pub struct Earlier {
    rows: Vec<Row>,
    before: KeptDigests,
    sources: Sources,
}

impl Earlier {
    /// Reads the sources below the folder of the workspace, and the record with its digests, where there is one.
    ///
    /// # Errors
    /// That of a file that cannot be read.
    pub fn read(
        root: &Path,
        compiler: &str,
        record: Option<&Path>,
    ) -> Result<Self, Box<dyn Error>> {
        let (rows, before) = match record {
            Some(path) => (
                Record::read(path)?.rows,
                KeptDigests::read(&KeptDigests::beside(path))?,
            ),
            None => (vec![], KeptDigests::default()),
        };
        Ok(Self {
            rows,
            before,
            sources: Sources::read(root, compiler)?,
        })
    }

    /// The sources of today.
    #[must_use]
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The digest of what an item depends on today, and its count where it is still that of these sources.
    #[must_use]
    pub fn count(&self, item: &Item) -> (Digest, Option<&Row>) {
        let name = item.row();
        let digest = (self.sources).of(&item.scene, &format!("{} {TIMES}", item.what));
        let row = self.rows.iter().find(|row| row.name == name);
        (digest, row.filter(|_| self.before.has(&name, digest)))
    }

    /// Names of all items that must be counted anew, features included.
    ///
    /// # Errors
    /// If a scene is missing.
    pub fn uncounted(&self) -> Result<Vec<String>, Box<dyn Error>> {
        let features = features().into_iter().flat_map(|group| group.features);
        let items = scenes_and_parts()?.into_iter().chain(features);
        let changed = items.filter(|item| self.count(item).1.is_none());
        Ok(changed.map(|item| item.name).collect())
    }
}
