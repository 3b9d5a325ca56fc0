//! Counted items: scenes, methods, parts of a step, laws, and features that do nothing.

use proctor_benchmark::bench::scenes;
use proctor_scene::simulation::Part;
use serde_json::{Value, json};
use std::error::Error;

/// Particles of a scene: enough that a step is the work on particles.
const PARTICLES: usize = 8000;
/// Start of the names of scenes whose rows are those of laws.
const SLABS: &str = "slabs-";

/// Something that is counted: a scene, and `step` or the part of a step that is played.
pub struct Item {
    pub name: String,
    pub scene: Value,
    pub what: &'static str,
}

impl Item {
    /// The name of its row.
    pub fn row(&self) -> String {
        format!("instructions/{}", self.name)
    }
}

/// Scenes with whole steps, methods and single parts.
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
        push(format!("{name}/step"), make(&name)?, "step");
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
    pub base: Item,
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
