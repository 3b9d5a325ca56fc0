//! Keys of the parts of a body: layers and boxes of other material or other particles.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::json::lists::{Comment, Counts};
use crate::json::sheets::RawSheet;

/// A layer of a body. Layers are listed from the top to the bottom.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `material_id` and `base`"
)]
pub(in crate::json) struct RawLayer {
    /// Identifier of the material of the layer.
    #[schemars(extend("x-needed" = true, "examples" = [1]))]
    pub material_id: Option<i64>,
    /// Surface below the layer, in the forms of `lower`. It may leave the body.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "needed but for the last layer, which reaches down to the end of the body",
        "x-file" = true, "examples" = [0.5, [[0, 0.5], [2, 0.6]]]
    ))]
    pub base: Option<RawSheet>,
    /// Coefficient of earth pressure at rest in the layer.
    #[schemars(extend(
        "x-unit" = "1", "x-needs" = "`initial_stress` with `type` \"at_rest\"", "x-default" = "`ratio` of the initial stress",
        "minimum" = 0, "examples" = [0.6]
    ))]
    pub ratio: Option<f64>,
    /// Identifier of the part of the body; the first layer has that of the body.
    #[schemars(extend("x-default" = "the next that no body has", "examples" = [11]))]
    pub id: Option<i64>,
    /// Particles per cell and axis, at most 100.
    #[schemars(extend("x-default" = "that of the body", "examples" = [3]))]
    pub particles_per_cell: Option<Counts>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// A box of a body with another material or other particles. Where boxes overlap the last one counts.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `material_id` or `particles_per_cell`"
)]
pub(in crate::json) struct RawZone {
    /// Lower corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0, 0], [0, 0, 0]]))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0.5, 0.5], [0.5, 0.5, 0.5]]))]
    pub point_p2: Option<Vec<f64>>,
    /// Identifier of the material in the box.
    #[schemars(extend("x-default" = "that of the body or its layers", "examples" = [1]))]
    pub material_id: Option<i64>,
    /// Particles per cell and axis, at most 100.
    #[schemars(extend("x-default" = "that of the body or its layers", "examples" = [3]))]
    pub particles_per_cell: Option<Counts>,
    /// Identifier of the part of the body.
    #[schemars(extend("x-default" = "the next that no body has", "examples" = [12]))]
    pub id: Option<i64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}
