//! Keys of the mesh and of the motion of its planes.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{RawWaterLevels, RawWaterPlanes, RawWaterPressures};
use crate::json::lists::Comment;

/// Background mesh.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys of a mesh")]
pub(in crate::json) struct RawMesh {
    /// Edges of a cell, one number per axis.
    #[schemars(extend(
        "x-unit" = "m", "x-needed" = true, "items" = {"type": "number", "exclusiveMinimum": 0},
        "examples" = [[0.1, 0.1], [0.1, 0.1, 0.1]]
    ))]
    pub cells_dimension: Option<Vec<f64>>,
    /// Number of cells per axis.
    #[schemars(extend(
        "x-needed" = true, "items" = {"type": "integer", "minimum": 1}, "examples" = [[20, 10], [20, 10, 10]]
    ))]
    pub cells_number: Option<Vec<usize>>,
    /// Lower corner of the mesh.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "zero, as in the manuals' program", "examples" = [[-1, 0], [-1, -1, 0]]
    ))]
    pub origin: Option<Vec<f64>>,
    /// True where x is the radius and y the height of a body of revolution. Masses, forces and energies are then those of the full
    /// circle, and the stress ZZ is the hoop stress.
    #[schemars(extend(
        "x-needs" = "`dimension` 2", "default" = false, "examples" = [true]
    ))]
    pub axisymmetric: Option<bool>,
    /// Conditions on the planes; a plane that is not named is sliding.
    #[schemars(extend(
        "x-default" = "all planes are sliding", "examples" = [{"plane_X0": "fixed", "plane_Yn": "free"}]
    ))]
    pub boundary_conditions: Option<RawPlanes>,
    /// Conditions on the planes for the pore water; a plane that is not named is sliding and lets none through.
    #[schemars(extend(
        "x-needs" = "`n_phases` 2", "x-default" = "no plane lets water through", "examples" = [{"plane_Yn": "free"}]
    ))]
    pub boundary_conditions_fluid: Option<RawWaterPlanes>,
    /// Pressures of the pore water at planes, through which it flows freely. Tractions stay total: what the pressure pushes
    /// the water with it takes from the skeleton.
    #[schemars(extend(
        "x-needs" = "`n_phases` 2", "x-default" = "none", "examples" = [{"plane_Y0": 1000}]
    ))]
    pub boundary_pressures_fluid: Option<RawWaterPressures>,
    /// Levels of water at rest beyond planes, through which the pore water flows freely: its pressure there is that below the
    /// level, and none above it. A level is a coordinate along the axis that most of gravity is along, constant or as rows of a time
    /// and a level, linear between them and constant outside. The weight of that water on the skeleton is a traction of its own.
    #[schemars(extend(
        "x-needs" = "`n_phases` 2, `gravity`", "x-default" = "none", "examples" = [{"plane_X0": 3}]
    ))]
    pub boundary_levels_fluid: Option<RawWaterLevels>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Conditions on the planes of the mesh: `free`, `sliding`, `fixed`, `antisymmetric` or `absorbing`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the planes of the mesh"
)]
pub(in crate::json) struct RawPlanes {
    /// Lower plane of x.
    #[serde(rename = "plane_X0")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed", "antisymmetric", "absorbing"], "default" = "sliding", "examples" = ["fixed"]
    ))]
    pub x0: Option<String>,
    /// Lower plane of y.
    #[serde(rename = "plane_Y0")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed", "antisymmetric", "absorbing"], "default" = "sliding", "examples" = ["fixed"]
    ))]
    pub y0: Option<String>,
    /// Lower plane of z.
    #[serde(rename = "plane_Z0")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed", "antisymmetric", "absorbing"], "x-needs" = "`dimension` 3", "default" = "sliding",
        "examples" = ["fixed"]
    ))]
    pub z0: Option<String>,
    /// Upper plane of x.
    #[serde(rename = "plane_Xn")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed", "antisymmetric", "absorbing"], "default" = "sliding", "examples" = ["fixed"]
    ))]
    pub xn: Option<String>,
    /// Upper plane of y.
    #[serde(rename = "plane_Yn")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed", "antisymmetric", "absorbing"], "default" = "sliding", "examples" = ["fixed"]
    ))]
    pub yn: Option<String>,
    /// Upper plane of z.
    #[serde(rename = "plane_Zn")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed", "antisymmetric", "absorbing"], "x-needs" = "`dimension` 3", "default" = "sliding",
        "examples" = ["fixed"]
    ))]
    pub zn: Option<String>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Motion of a boundary plane from a record.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of an earthquake"
)]
pub(in crate::json) struct RawEarthquake {
    /// True if it acts; nothing else here is read where it is false.
    #[schemars(extend("x-needed" = true, "examples" = [true]))]
    pub active: Option<bool>,
    /// Record with the columns t, ax, ay, az, separated by `,`, `;`, tabs or blanks; a path relative to the folder of the scene.
    #[schemars(extend(
        "x-unit" = "s, m/s² or m/s", "x-needed" = true, "x-file" = true, "examples" = ["record.csv"]
    ))]
    pub file: Option<String>,
    /// True if the record has a header.
    #[schemars(extend("x-default" = "found by looking", "examples" = [true]))]
    pub header: Option<bool>,
    /// Quantity of the record. The default is that of the manuals.
    #[schemars(extend(
        "enum" = ["acceleration", "velocity"], "default" = "acceleration", "examples" = ["velocity"]
    ))]
    pub quantity: Option<String>,
    /// Plane that moves.
    #[schemars(extend(
        "enum" = ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"], "x-default" = "the lower plane of the last axis",
        "examples" = ["X0"]
    ))]
    pub plane: Option<String>,
    /// Base under the ground: a rigid one moves its plane as the record says; a compliant one lets waves leave through its plane,
    /// which must be `absorbing`, while the recorded wave comes in.
    #[schemars(extend("enum" = ["rigid", "compliant"], "default" = "rigid", "examples" = ["compliant"]))]
    pub base: Option<String>,
    /// Motion that the record is of: that of a free surface of the rock, of which the incoming wave is half, or that of the
    /// incoming wave alone.
    #[schemars(extend(
        "enum" = ["outcrop", "incoming"], "x-needs" = "`base` \"compliant\"", "default" = "outcrop",
        "examples" = ["incoming"]
    ))]
    pub motion: Option<String>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}
