//! Keys of contact: between bodies, and with what has no particles.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::json::lists::{Comment, VectorOrTable};

/// Contact between two bodies.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a contact"
)]
pub(in crate::json) struct RawContact {
    /// Identifier.
    #[schemars(extend("x-default" = "the place in the list, from 1", "examples" = [1]))]
    pub id: Option<i64>,
    /// Coefficient of friction.
    #[schemars(extend("x-unit" = "1", "x-needed" = true, "minimum" = 0, "examples" = [0.3]))]
    pub friction: Option<f64>,
    /// Identifier of the master body; for mortar contact also of a rigid line or surface.
    #[schemars(extend("x-needed" = true, "examples" = [1]))]
    pub master_id: Option<i64>,
    /// Identifier of the slave body.
    #[schemars(extend("x-needed" = true, "examples" = [2]))]
    pub slave_id: Option<i64>,
    /// Source of the normal.
    #[schemars(extend(
        "enum" = ["master", "slave", "collinear"], "x-needs" = "`method` \"grid\"", "default" = "collinear",
        "examples" = ["master"]
    ))]
    pub normal_type: Option<String>,
    /// Method of contact: on the grid, or between boundaries.
    #[schemars(extend("enum" = ["grid", "mortar"], "default" = "grid", "examples" = ["mortar"]))]
    pub method: Option<String>,
    /// Gap at which contact begins.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`method` \"mortar\"", "x-needed" = true, "exclusiveMinimum" = 0,
        "examples" = [0.05]
    ))]
    pub critical_gap: Option<f64>,
    /// Stiffness of the normal law.
    #[schemars(extend(
        "x-unit" = "Pa/m", "x-needs" = "`method` \"mortar\"", "x-needed" = true, "exclusiveMinimum" = 0,
        "examples" = [1e6]
    ))]
    pub normal_stiffness: Option<f64>,
    /// Stiffness of the tangential spring.
    #[schemars(extend(
        "x-unit" = "Pa/m", "x-needs" = "`method` \"mortar\"",
        "x-default" = "so that a round body lags behind its way by 0.5 % at most", "exclusiveMinimum" = 0,
        "examples" = [1e6]
    ))]
    pub tangential_stiffness: Option<f64>,
    /// Normal law.
    #[schemars(extend(
        "enum" = ["barrier", "penalty"], "x-needs" = "`method` \"mortar\"", "default" = "barrier",
        "examples" = ["penalty"]
    ))]
    pub enforcement: Option<String>,
    /// Detection of contact.
    #[schemars(extend(
        "enum" = ["mortar", "node_to_segment"], "x-needs" = "`method` \"mortar\"", "default" = "mortar",
        "examples" = ["node_to_segment"]
    ))]
    pub detection: Option<String>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// A rigid polyline.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a rigid line"
)]
pub(in crate::json) struct RawRigidLine {
    /// Identifier; no body may have it.
    #[schemars(extend("x-needed" = true, "examples" = [9]))]
    pub id: Option<i64>,
    /// Vertices, material on the left of their direction.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[[2, 0], [0, 0]]]))]
    pub points: Option<Vec<Vec<f64>>>,
    /// True joins the last vertex to the first.
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub closed: Option<bool>,
    /// Prescribed velocity: a vector, or rows of time and velocity.
    #[schemars(extend("x-unit" = "m/s; s, m/s", "x-default" = "at rest", "examples" = [[0, -0.1]]))]
    pub prescribed_velocity: Option<VectorOrTable>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// A rigid surface of triangles.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a rigid surface"
)]
pub(in crate::json) struct RawRigidSurface {
    /// Identifier; no body may have it.
    #[schemars(extend("x-needed" = true, "examples" = [9]))]
    pub id: Option<i64>,
    /// STL file with the triangles, touched from the side to which their normals point; a path relative to the folder
    /// of the scene.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "needed without `triangles`", "x-file" = true, "examples" = ["floor.stl"]
    ))]
    pub stl_mesh: Option<String>,
    /// The triangles themselves, three corners each, touched from the side from which the corners run counter-clockwise.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "those of `stl_mesh`",
        "examples" = [[[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]]
    ))]
    pub triangles: Option<Vec<Vec<Vec<f64>>>>,
    /// Prescribed velocity: a vector, or rows of time and velocity.
    #[schemars(extend(
        "x-unit" = "m/s; s, m/s", "x-default" = "at rest", "examples" = [[0, 0, 0.1]]
    ))]
    pub prescribed_velocity: Option<VectorOrTable>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Settings of all contacts.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a contact manager"
)]
pub(in crate::json) struct RawContactManager {
    /// True if contacts act.
    #[schemars(extend("default" = true, "examples" = [false]))]
    pub active: Option<bool>,
    /// Factor lambda on the cell size in the real-distance correction; 0 for none.
    #[schemars(extend(
        "x-unit" = "1",
        "x-default" = "the sum of the half-lengths of the particles, in cells: 0.5, as in the manual, with two particles per cell and axis",
        "minimum" = 0, "examples" = [0.5]
    ))]
    pub real_distance_correction_coefficient: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Contact of all bodies with a rigid surface, from the side to which the normals of its triangles point.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a terrain contact"
)]
pub(in crate::json) struct RawTerrainContact {
    /// True if it acts.
    #[schemars(extend("x-needed" = true, "examples" = [true]))]
    pub active: Option<bool>,
    /// File of the surface, STL, ASCII or binary; a path relative to the folder of the scene.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "needed without `triangles`", "x-file" = true, "examples" = ["floor.stl"]
    ))]
    pub stl_mesh: Option<String>,
    /// The triangles themselves, three corners each, touched from the side from which the corners run counter-clockwise.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "those of `stl_mesh`",
        "examples" = [[[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]]
    ))]
    pub triangles: Option<Vec<Vec<Vec<f64>>>>,
    /// Coefficient of friction. The default is that of the manuals' program.
    #[schemars(extend("x-unit" = "1", "default" = 0.0, "minimum" = 0, "examples" = [0.3]))]
    pub friction: Option<f64>,
    /// Gap below which contact is looked for, and the longest way towards the surface in one step.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "the smallest edge of a cell", "exclusiveMinimum" = 0, "examples" = [0.05]
    ))]
    pub distance_threshold: Option<f64>,
    /// True if the penalty force acts.
    #[schemars(extend("x-default" = "true where a stiffness is given", "examples" = [false]))]
    pub penalty_contact_active: Option<bool>,
    /// Stiffness of a force that pushes penetrating particles out, per particle.
    #[schemars(extend(
        "x-unit" = "N/m", "x-default" = "no such force", "exclusiveMinimum" = 0, "examples" = [1e4]
    ))]
    pub penalty_stiffness: Option<f64>,
    /// Prescribed velocity of the surface: a vector, or rows of time and velocity.
    #[schemars(extend(
        "x-unit" = "m/s; s, m/s", "x-default" = "it stands", "examples" = [[0, 0, 0.1]]
    ))]
    pub prescribed_velocity: Option<VectorOrTable>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}
