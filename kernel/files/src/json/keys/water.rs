//! Keys of pore water, but for those of materials.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::json::lists::{Comment, NumberOrTable};

/// Conditions on the planes of the mesh for pore water: `free` drains, `sliding` lets none through, `fixed` holds it.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the planes of the mesh"
)]
pub(in crate::json) struct RawWaterPlanes {
    /// Lower plane of x.
    #[serde(rename = "plane_X0")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed"], "default" = "sliding", "examples" = ["free"]
    ))]
    pub x0: Option<String>,
    /// Upper plane of x.
    #[serde(rename = "plane_Xn")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed"], "default" = "sliding", "examples" = ["free"]
    ))]
    pub xn: Option<String>,
    /// Lower plane of y.
    #[serde(rename = "plane_Y0")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed"], "default" = "sliding", "examples" = ["free"]
    ))]
    pub y0: Option<String>,
    /// Upper plane of y.
    #[serde(rename = "plane_Yn")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed"], "default" = "sliding", "examples" = ["free"]
    ))]
    pub yn: Option<String>,
    /// Lower plane of z.
    #[serde(rename = "plane_Z0")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed"], "x-needs" = "`dimension` 3", "default" = "sliding", "examples" = ["free"]
    ))]
    pub z0: Option<String>,
    /// Upper plane of z.
    #[serde(rename = "plane_Zn")]
    #[schemars(extend(
        "enum" = ["free", "sliding", "fixed"], "x-needs" = "`dimension` 3", "default" = "sliding", "examples" = ["free"]
    ))]
    pub zn: Option<String>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Pressures of the pore water at planes of the mesh, compression positive.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the planes of the mesh"
)]
pub(in crate::json) struct RawWaterPressures {
    /// Lower plane of x.
    #[serde(rename = "plane_X0")]
    #[schemars(extend("x-unit" = "Pa", "x-default" = "none", "examples" = [1000]))]
    pub x0: Option<f64>,
    /// Upper plane of x.
    #[serde(rename = "plane_Xn")]
    #[schemars(extend("x-unit" = "Pa", "x-default" = "none", "examples" = [1000]))]
    pub xn: Option<f64>,
    /// Lower plane of y.
    #[serde(rename = "plane_Y0")]
    #[schemars(extend("x-unit" = "Pa", "x-default" = "none", "examples" = [1000]))]
    pub y0: Option<f64>,
    /// Upper plane of y.
    #[serde(rename = "plane_Yn")]
    #[schemars(extend("x-unit" = "Pa", "x-default" = "none", "examples" = [1000]))]
    pub yn: Option<f64>,
    /// Lower plane of z.
    #[serde(rename = "plane_Z0")]
    #[schemars(extend("x-needs" = "`dimension` 3", "x-unit" = "Pa", "x-default" = "none", "examples" = [1000]))]
    pub z0: Option<f64>,
    /// Upper plane of z.
    #[serde(rename = "plane_Zn")]
    #[schemars(extend("x-needs" = "`dimension` 3", "x-unit" = "Pa", "x-default" = "none", "examples" = [1000]))]
    pub zn: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Levels of water that stands beyond planes of the mesh.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the planes of the mesh"
)]
pub(in crate::json) struct RawWaterLevels {
    /// Lower plane of x.
    #[serde(rename = "plane_X0")]
    #[schemars(extend("x-unit" = "m, or s and m", "x-default" = "none", "examples" = [3, [[0, 3], [60, 1]]]))]
    pub x0: Option<NumberOrTable>,
    /// Upper plane of x.
    #[serde(rename = "plane_Xn")]
    #[schemars(extend("x-unit" = "m, or s and m", "x-default" = "none", "examples" = [3, [[0, 3], [60, 1]]]))]
    pub xn: Option<NumberOrTable>,
    /// Lower plane of y.
    #[serde(rename = "plane_Y0")]
    #[schemars(extend("x-unit" = "m, or s and m", "x-default" = "none", "examples" = [3, [[0, 3], [60, 1]]]))]
    pub y0: Option<NumberOrTable>,
    /// Upper plane of y.
    #[serde(rename = "plane_Yn")]
    #[schemars(extend("x-unit" = "m, or s and m", "x-default" = "none", "examples" = [3, [[0, 3], [60, 1]]]))]
    pub yn: Option<NumberOrTable>,
    /// Lower plane of z.
    #[serde(rename = "plane_Z0")]
    #[schemars(extend("x-needs" = "`dimension` 3", "x-unit" = "m, or s and m", "x-default" = "none", "examples" = [3, [[0, 3], [60, 1]]]))]
    pub z0: Option<NumberOrTable>,
    /// Upper plane of z.
    #[serde(rename = "plane_Zn")]
    #[schemars(extend("x-needs" = "`dimension` 3", "x-unit" = "m, or s and m", "x-default" = "none", "examples" = [3, [[0, 3], [60, 1]]]))]
    pub zn: Option<NumberOrTable>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Water at rest that stands beside bodies and presses on their surfaces.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `level`")]
pub(in crate::json) struct RawStandingWater {
    /// Level, a coordinate along the axis of gravity: constant, or rows of a time and a level, linear between them and constant
    /// outside.
    #[schemars(extend(
        "x-unit" = "m, or s and m", "x-needs" = "`gravity`", "x-needed" = true, "examples" = [3, [[0, 3], [60, 1]]]
    ))]
    pub level: Option<NumberOrTable>,
    /// Density.
    #[schemars(extend("x-unit" = "kg/m³", "exclusiveMinimum" = 0, "default" = 1000, "examples" = [1025]))]
    pub density: Option<f64>,
    /// Identifiers of the bodies that it presses on.
    #[schemars(extend("x-default" = "all bodies", "examples" = [[1]]))]
    pub body_ids: Option<Vec<i64>>,
    /// Side of the bodies on which it stands.
    #[schemars(extend(
        "enum" = ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"], "x-needs" = "`between`",
        "x-default" = "all around the bodies", "examples" = ["X0"]
    ))]
    pub side: Option<String>,
    /// Coordinates across that side between which the pressure fades from all of it to none. There the bodies must have no surface
    /// below the level but at planes of the mesh.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`side`", "x-default" = "none", "examples" = [[0.4, 0.6]]
    ))]
    pub between: Option<Vec<f64>>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Pore pressure of a material at the start.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `material_id` and `pressure`"
)]
pub(in crate::json) struct RawMaterialPressure {
    /// Identifier of the material.
    #[schemars(extend("x-needed" = true, "examples" = [1]))]
    pub material_id: Option<i64>,
    /// Pore pressure.
    #[schemars(extend("x-unit" = "Pa", "x-needed" = true, "examples" = [1000]))]
    pub pressure: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Pore pressure of the particles whose centres lie in a box at the start.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `pressure`"
)]
pub(in crate::json) struct RawPressureBox {
    /// Lower corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0, 0], [0, 0, 0]]))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[1, 0.5], [1, 1, 0.5]]))]
    pub point_p2: Option<Vec<f64>>,
    /// Pore pressure.
    #[schemars(extend("x-unit" = "Pa", "x-needed" = true, "examples" = [1000]))]
    pub pressure: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}
