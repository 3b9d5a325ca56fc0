//! Keys of bodies, of what acts on them, and of the particles whose history is written.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::json::lists::{Comment, Counts, VectorOrTable};
use crate::json::sheets::RawSheet;

use super::{RawLayer, RawZone};

/// A body. Which keys its shape needs depends on its type.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys of a body")]
pub(in crate::json) struct RawBody {
    /// Shape: cuboid (2D and 3D), sphere, cylinder, `extruded_polygon`, solid (3D), rectangle, disc, ring, polygon (2D),
    /// between and particles (2D and 3D).
    #[schemars(extend(
        "enum" = [
            "cuboid", "rectangle", "sphere", "disc", "ring", "cylinder", "polygon", "extruded_polygon", "between", "solid",
            "particles",
        ],
        "x-needed" = true, "examples" = ["cuboid", "rectangle"]
    ))]
    pub r#type: Option<String>,
    /// Identifier, to which contacts refer.
    #[schemars(extend("x-needed" = true, "examples" = [1]))]
    pub id: Option<i64>,
    /// Identifier of the material.
    #[schemars(extend("x-needs" = "no `layers`", "x-needed" = true, "examples" = [1]))]
    pub material_id: Option<i64>,
    /// Lower corner of a cuboid or rectangle; centre of the first end face of a cylinder.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"cuboid\", \"rectangle\" or \"cylinder\"", "x-needed" = true,
        "examples" = [[0, 0], [0, 0, 0]]
    ))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner of a cuboid or rectangle; centre of the other end face of a cylinder.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"cuboid\", \"rectangle\" or \"cylinder\"", "x-needed" = true,
        "examples" = [[1, 1], [1, 1, 1]]
    ))]
    pub point_p2: Option<Vec<f64>>,
    /// Centre of a sphere, disc or ring.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"sphere\", \"disc\" or \"ring\"", "x-needed" = true,
        "examples" = [[1, 1], [1, 1, 1]]
    ))]
    pub center: Option<Vec<f64>>,
    /// Radius of a sphere, disc or cylinder.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"sphere\", \"disc\" or \"cylinder\"", "x-needed" = true,
        "exclusiveMinimum" = 0, "examples" = [0.4]
    ))]
    pub radius: Option<f64>,
    /// Inner radius of a ring.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"ring\"", "x-needed" = true, "exclusiveMinimum" = 0, "examples" = [0.2]
    ))]
    pub inner_radius: Option<f64>,
    /// Outer radius of a ring.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"ring\"", "x-needed" = true, "exclusiveMinimum" = 0, "examples" = [0.5]
    ))]
    pub outer_radius: Option<f64>,
    /// Corners of a polygon, or of an extruded polygon in the plane of its two other axes.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"polygon\" or \"extruded_polygon\"", "x-needed" = true,
        "examples" = [[[0, 0], [1, 0], [0, 1]]]
    ))]
    pub points: Option<Vec<Vec<f64>>>,
    /// Axis along which a polygon is extruded.
    #[schemars(extend(
        "enum" = ["x", "y", "z"], "x-needs" = "`type` \"extruded_polygon\"", "x-needed" = true, "examples" = ["z"]
    ))]
    pub axis: Option<String>,
    /// Lower and upper coordinate of an extruded polygon along its axis.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"extruded_polygon\"", "x-needed" = true, "examples" = [[0, 1]]
    ))]
    pub range: Option<Vec<f64>>,
    /// Surface below the body: a level, a list of points x, y in ascending order of x (2D), or a file. A file is in two
    /// dimensions a table of x, y; in three an ESRI ASCII grid, a table of x, y, z on a regular grid, or an STL surface.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"between\"", "x-needed" = true, "x-file" = true, "examples" = [0, "rock.asc"]
    ))]
    pub lower: Option<RawSheet>,
    /// Surface above the body, in the forms of `lower`.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"between\"", "x-needed" = true, "x-file" = true,
        "examples" = [1, [[0, 1], [2, 0.5]], "terrain.asc"]
    ))]
    pub upper: Option<RawSheet>,
    /// Part of the plan that the body covers: a row of the lower and the upper coordinate for x, and in three dimensions
    /// for y.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"between\"", "x-default" = "the whole mesh",
        "examples" = [[[0, 1]], [[0, 1], [0, 1]]]
    ))]
    pub plan: Option<Vec<Vec<f64>>>,
    /// Layers of the body from the top to the bottom. Each becomes a body of its own; all move as one.
    #[schemars(extend(
        "x-needs" = "`type` \"between\", \"rectangle\" or \"cuboid\"", "x-default" = "one material",
        "examples" = [[{"material_id": 1, "base": 0.5}, {"material_id": 1}]]
    ))]
    pub layers: Option<Vec<RawLayer>>,
    /// Boxes of the body with another material or other particles. Each becomes a body of its own; all move as one.
    #[schemars(extend(
        "x-needs" = "`type` \"between\", \"rectangle\" or \"cuboid\"", "x-default" = "none",
        "examples" = [
            [{"point_p1": [0, 0], "point_p2": [0.5, 0.5], "material_id": 1}],
            [{"point_p1": [0, 0, 0], "point_p2": [0.5, 0.5, 0.5], "particles_per_cell": 3}]
        ]
    ))]
    pub zones: Option<Vec<RawZone>>,
    /// STL file with the closed surface of a solid.
    #[schemars(extend(
        "x-needs" = "`type` \"solid\"", "x-needed" = true, "x-file" = true, "examples" = ["block.stl"]
    ))]
    pub stl_mesh: Option<String>,
    /// Particles: rows of position and volume.
    #[schemars(extend(
        "x-unit" = "m, m³", "x-needs" = "`type` \"particles\" without `file`", "x-needed" = true,
        "examples" = [[[0.25, 0.25, 0.25], [0.75, 0.25, 0.25]], [[0.25, 0.25, 0.25, 0.125], [0.75, 0.25, 0.25, 0.125]]]
    ))]
    pub particles: Option<Vec<Vec<f64>>>,
    /// Particles from a file: a table with the columns x, y, z, volume, separated by `,`, `;`, tabs or blanks, or rows of
    /// these numbers in JSON; a path relative to the folder of the scene.
    #[schemars(extend(
        "x-unit" = "m, m³", "x-needs" = "`type` \"particles\" without `particles`", "x-needed" = true, "x-file" = true,
        "examples" = ["particles.csv"]
    ))]
    pub file: Option<String>,
    /// Longest segment of the boundary made from the shape, for mortar contact; in three dimensions of the edges of
    /// its triangles, but for diagonals.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "no boundary", "exclusiveMinimum" = 0, "examples" = [0.25]
    ))]
    pub boundary_segment: Option<f64>,
    /// Vertices of the boundary, the body on their left, instead of one made from the shape.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`dimension` 2", "x-default" = "no boundary",
        "examples" = [[[0, 0], [1, 0], [1, 1], [0, 1]]]
    ))]
    pub boundary: Option<Vec<Vec<f64>>>,
    /// True joins the last of these vertices to the first; an open boundary covers a part of the body alone.
    #[schemars(extend("x-needs" = "`boundary`", "default" = true, "examples" = [false]))]
    pub boundary_closed: Option<bool>,
    /// STL file with the triangles of the boundary, closed and with its normals out of the body, instead of one made
    /// from the shape.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`dimension` 3", "x-default" = "no boundary", "x-file" = true,
        "examples" = ["block.stl"]
    ))]
    pub boundary_stl_mesh: Option<String>,
    /// Mode in which the boundary follows the body. With `material` a vertex is where the particles that were around it at the
    /// start say; the others integrate velocities of the nodes, and drift.
    #[schemars(extend(
        "enum" = ["unaugmented", "velocity", "spin", "gradient", "material"],
        "x-needs" = "`boundary_segment`, `boundary` or `boundary_stl_mesh`", "default" = "spin",
        "examples" = ["material"]
    ))]
    pub boundary_follows: Option<String>,
    /// Particles per cell and axis, at most 100.
    #[schemars(extend("x-default" = "that of the scene", "examples" = [3]))]
    pub particles_per_cell: Option<Counts>,
    /// Initial velocity.
    #[schemars(extend("x-unit" = "m/s", "x-default" = "zero", "examples" = [[1, 0], [1, 0, 0]]))]
    pub initial_velocity: Option<Vec<f64>>,
    /// Stress at the start.
    #[schemars(extend(
        "x-default" = "none", "examples" = [{"type": "at_rest", "ratio": 0.5, "level": 1}, {"type": "isotropic", "value": -1e4}]
    ))]
    pub initial_stress: Option<RawInitialStress>,
    /// Prescribed velocity: a vector, or rows of time and velocity.
    #[schemars(extend(
        "x-unit" = "m/s; s, m/s", "x-default" = "the body moves as it is pushed", "examples" = [[1, 0], [1, 0, 0]]
    ))]
    pub prescribed_velocity: Option<VectorOrTable>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Stress that a body has at the start.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of an initial stress"
)]
pub(in crate::json) struct RawInitialStress {
    /// The same stress in all directions, or ground at rest: the weight above along gravity, and a share of it across.
    #[schemars(extend(
        "enum" = ["isotropic", "at_rest"], "x-needed" = true, "examples" = ["at_rest"]
    ))]
    pub r#type: Option<String>,
    /// The stress; tension is positive.
    #[schemars(extend(
        "x-unit" = "Pa", "x-needs" = "`type` \"isotropic\"", "x-needed" = true, "examples" = [-1e4]
    ))]
    pub value: Option<f64>,
    /// Coefficient of earth pressure at rest.
    #[schemars(extend(
        "x-unit" = "1", "x-needs" = "`type` \"at_rest\"", "x-needed" = true, "minimum" = 0, "examples" = [0.5]
    ))]
    pub ratio: Option<f64>,
    /// Surface of the ground: its coordinate along gravity, or a surface in the forms of `lower` of the body. The weight
    /// above a point is then that of the layers of the body below this surface.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`type` \"at_rest\"", "x-file" = true,
        "x-default" = "the upper surface of a body of type \"between\" or with layers, else needed",
        "examples" = [2, [[0, 1], [2, 1.5]]]
    ))]
    pub level: Option<RawSheet>,
    /// Pressure on the surface.
    #[schemars(extend(
        "x-unit" = "Pa", "x-needs" = "`type` \"at_rest\"", "default" = 0, "minimum" = 0, "examples" = [1e4]
    ))]
    pub surcharge: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Traction on a rectangle (a segment in 2D) that is fixed in space.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `traction`"
)]
pub(in crate::json) struct RawTraction {
    /// Lower corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0, 1], [0, 0, 1]]))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner, equal to `point_p1` along exactly one axis.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[1, 1], [1, 1, 1]]))]
    pub point_p2: Option<Vec<f64>>,
    /// Traction, constant or as rows of a time and its components, linear between them and constant outside.
    #[schemars(extend(
        "x-unit" = "Pa, or s and Pa", "x-needed" = true,
        "examples" = [[0, -1000], [[0, 0, 0], [2, 0, -1000]], [0, 0, -1000]]
    ))]
    pub traction: Option<VectorOrTable>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Total force spread by volume over the particles that lie in a box at the start.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `force`"
)]
pub(in crate::json) struct RawBoxLoad {
    /// Lower corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0, 0], [0, 0, 0]]))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[1, 0.5], [1, 1, 0.5]]))]
    pub point_p2: Option<Vec<f64>>,
    /// Total force.
    #[schemars(extend("x-unit" = "N", "x-needed" = true, "examples" = [[10, 0], [10, 0, 0]]))]
    pub force: Option<Vec<f64>>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Total force spread by volume over the particles that lie in a box at the start.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `load`"
)]
pub(in crate::json) struct RawDistributedLoad {
    /// Lower corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0, 0], [0, 0, 0]]))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[1, 0.5], [1, 1, 0.5]]))]
    pub point_p2: Option<Vec<f64>>,
    /// Total force.
    #[schemars(extend("x-unit" = "N", "x-needed" = true, "examples" = [[10, 0], [10, 0, 0]]))]
    pub load: Option<Vec<f64>>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// A box in which all nodes of the mesh stand still.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1` and `point_p2`"
)]
pub(in crate::json) struct RawHeldBox {
    /// Lower corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[0, 0], [0, 0, 0]]))]
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner.
    #[schemars(extend("x-unit" = "m", "x-needed" = true, "examples" = [[1, 0.5], [1, 1, 0.5]]))]
    pub point_p2: Option<Vec<f64>>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Columns of `history.csv` that follow a particle, particles along a line, or a body.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `name` and one of `point`, `line` and `body`"
)]
pub(in crate::json) struct RawProbe {
    /// Prefix of the columns in `history.csv`: letters, digits, `_`, `-` and `.`.
    #[schemars(extend("x-needed" = true, "examples" = ["top"]))]
    pub name: Option<String>,
    /// The particle nearest to this position at the start is followed.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "needed where there is neither `line` nor `body`",
        "examples" = [[0.5, 1], [0.5, 0.5, 1]]
    ))]
    pub point: Option<Vec<f64>>,
    /// Two ends of a line: the particles nearest to evenly spaced points of it at the start are followed. Their columns have
    /// the name of the probe and a number from 1.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "needed where there is neither `point` nor `body`",
        "examples" = [[[0.5, 0], [0.5, 1]], [[0.5, 0.5, 0], [0.5, 0.5, 1]]]
    ))]
    pub line: Option<Vec<Vec<f64>>>,
    /// Number of points of the line, its ends included.
    #[schemars(extend(
        "x-needs" = "`line`", "default" = 11, "minimum" = 2, "maximum" = 1000, "examples" = [5]
    ))]
    pub count: Option<usize>,
    /// Identifier of a body: means over its particles, or the particle with the largest value.
    #[schemars(extend("x-default" = "needed where there is neither `point` nor `line`", "examples" = [1]))]
    pub body: Option<i64>,
    /// The value whose largest one over the body is written, with its particle and where that is.
    #[schemars(extend(
        "enum" = ["displacement", "velocity", "mises_stress", "pressure", "plastic_strain"], "x-needs" = "`body`",
        "x-default" = "means of displacement, velocity and stress", "examples" = ["displacement"]
    ))]
    pub largest: Option<String>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}
