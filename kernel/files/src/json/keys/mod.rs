//! The keys of a scene file, as written: flat, all optional, nothing checked but types.
//!
//! The documentation of a key is its description in the JSON Schema. "The manuals" are the technical manual of
//! 2026 and the contact manual v0.1; "their program" is MPM-Geomechanics, whose defaults hold where the manuals
//! give none.

use schemars::JsonSchema;
use serde::Deserialize;

use super::lists::{Contacts, Counts, Entries, Terrains, VectorOrTable};
use super::material_keys::RawMaterial;

/// A scene: what is simulated, in SI units.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys of a scene")]
pub(super) struct RawScene {
    /// Number of dimensions: 3 (the default) or 2, plane strain in x-y with vectors of length 2.
    #[schemars(extend("enum" = [2, 3]))]
    pub dimension: Option<u64>,
    /// End time [s].
    pub time: Option<f64>,
    /// Constant time step [s]. Without it and without a multiplier the step is automatic.
    pub time_step: Option<f64>,
    /// Time step as a factor on min(h) / max(c + |v|).
    pub critical_time_step_multiplier: Option<f64>,
    /// Another spelling of `critical_time_step_multiplier`, used by the technical manual.
    pub time_step_multiplier: Option<f64>,
    /// Run even where the time step is above the bound of the scheme. Default: false.
    pub allow_unstable: Option<bool>,
    /// Acceleration of gravity [m/s²]. Default: zero, as in the manuals' program.
    pub gravity: Option<Vec<f64>>,
    /// Number of threads; the command line overrides it. Default: all.
    pub n_threads: Option<usize>,
    /// Number of phases; only 1, the default, is built.
    pub n_phases: Option<u64>,
    /// When the stress is updated. Default: USL, as in the manuals' program.
    #[schemars(extend("enum" = ["USF", "USL", "MUSL"]))]
    pub stress_scheme_update: Option<String>,
    /// Weighting function. Default: GIMP, as in the manuals' program; GIMP and uGIMP are the same.
    #[schemars(extend("enum" = ["linear", "GIMP", "uGIMP", "cpGIMP", "quadratic_bspline"]))]
    pub shape_function: Option<String>,
    /// How the particle domain of cpGIMP follows the deformation. Default: determinant.
    #[schemars(extend("enum" = ["determinant", "stretch", "left_stretch"]))]
    pub domain_update: Option<String>,
    /// How velocity is carried between particles and nodes. Default: FLIP, as in the manuals.
    #[schemars(extend("enum" = ["FLIP", "APIC", "TPIC"]))]
    pub transfer: Option<String>,
    /// Share of the nodal velocity in the particle velocity, 0 to 1. Default: 0 with FLIP, 1 with APIC and TPIC.
    pub pic_fraction: Option<f64>,
    /// Where the volumetric strain is taken. Default: particle. With `cell_average` nearly incompressible material does not
    /// lock.
    #[schemars(extend("enum" = ["particle", "cell_average"]))]
    pub volumetric_strain: Option<String>,
    /// Particles per cell and axis, one number or one per axis; a body may say otherwise. Default: 2 per axis, as
    /// in the manuals' program.
    pub particles_per_cell: Option<Counts>,
    /// Numerical damping. Default: none.
    pub damping: Option<RawDamping>,
    /// What is written.
    pub results: Option<RawResults>,
    /// Background mesh.
    pub mesh: Option<RawMesh>,
    /// Motion of a boundary plane from a record.
    pub earthquake: Option<RawEarthquake>,
    /// Materials, as a list or by name.
    pub material: Option<Entries<RawMaterial>>,
    /// Another spelling of `material`.
    pub materials: Option<Entries<RawMaterial>>,
    /// Bodies, as a list or by name.
    pub body: Option<Entries<RawBody>>,
    /// Another spelling of `body`.
    pub bodies: Option<Entries<RawBody>>,
    /// Boxes in which all nodes of the mesh stand still.
    pub held_box: Option<Vec<RawHeldBox>>,
    /// Forces on nodes: pairs of a position [m] and a force [N].
    pub nodal_point_load: Option<Vec<Vec<Vec<f64>>>>,
    /// Tractions on rectangles fixed in space.
    pub traction: Option<Vec<RawTraction>>,
    /// Forces spread over the particles that lie in a box at the start.
    pub box_load: Option<Vec<RawBoxLoad>>,
    /// What happens to a particle that leaves the mesh. Default: stop.
    #[schemars(extend("enum" = ["stop", "remove"]))]
    pub outside: Option<String>,
    /// What happens when energy, momentum or a strain increment is out of balance: the run tells it at its end, or
    /// stops. Default: tell.
    #[schemars(extend("enum" = ["tell", "stop"]))]
    pub on_imbalance: Option<String>,
    /// Particles whose history is written.
    pub probes: Option<Vec<RawProbe>>,
    /// Contact between bodies.
    pub contact: Option<Contacts>,
    /// Rigid polylines without particles, for mortar contact in two dimensions.
    pub rigid_line: Option<Entries<RawRigidLine>>,
    /// Rigid surfaces of triangles without particles, for mortar contact in three dimensions.
    pub rigid_surface: Option<Entries<RawRigidSurface>>,
    /// Settings of all contacts.
    pub contact_manager: Option<RawContactManager>,
    /// Contact with a rigid surface, or a list of them (3D).
    pub terrain_contact: Option<Terrains>,
}

/// Numerical damping.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `type` and `value`")]
pub(super) struct RawDamping {
    /// Kind of damping.
    #[schemars(extend("enum" = ["none", "local", "kinetic", "viscous"]))]
    pub r#type: Option<String>,
    /// Factor: 0 to 1 for local, 0 or greater for viscous damping.
    pub value: Option<f64>,
    /// Another spelling of `value`.
    pub alpha: Option<f64>,
}

/// What is written.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `print` and `fields`")]
pub(super) struct RawResults {
    /// Number of outputs after the initial one. Default: 10, as in the manuals' program.
    pub print: Option<usize>,
    /// Particle fields in the frames, `all` or `none`. Default: id and displacement, as in the manuals' program.
    pub fields: Option<Vec<String>>,
    /// Another spelling of `fields`.
    pub material_point_results: Option<Vec<String>>,
    /// Nodal fields in the grid frames, `all` or `none`. Default: none, and then there are no grid frames.
    pub grid_nodal_results: Option<Vec<String>>,
    /// Write a checkpoint with each frame. Default: true.
    pub checkpoint: Option<bool>,
}

/// Background mesh.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys of a mesh")]
pub(super) struct RawMesh {
    /// Edges of a cell [m].
    pub cells_dimension: Option<Vec<f64>>,
    /// Number of cells per axis.
    pub cells_number: Option<Vec<usize>>,
    /// Lower corner [m]. Default: zero, as in the manuals' program.
    pub origin: Option<Vec<f64>>,
    /// Conditions on the planes; a plane that is not named is sliding.
    pub boundary_conditions: Option<RawPlanes>,
}

/// Conditions on the planes of the mesh: `free`, `sliding` or `fixed`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the planes of the mesh"
)]
pub(super) struct RawPlanes {
    /// Lower plane of x.
    #[serde(rename = "plane_X0")]
    #[schemars(extend("enum" = ["free", "sliding", "fixed"]))]
    pub x0: Option<String>,
    /// Lower plane of y.
    #[serde(rename = "plane_Y0")]
    #[schemars(extend("enum" = ["free", "sliding", "fixed"]))]
    pub y0: Option<String>,
    /// Lower plane of z.
    #[serde(rename = "plane_Z0")]
    #[schemars(extend("enum" = ["free", "sliding", "fixed"]))]
    pub z0: Option<String>,
    /// Upper plane of x.
    #[serde(rename = "plane_Xn")]
    #[schemars(extend("enum" = ["free", "sliding", "fixed"]))]
    pub xn: Option<String>,
    /// Upper plane of y.
    #[serde(rename = "plane_Yn")]
    #[schemars(extend("enum" = ["free", "sliding", "fixed"]))]
    pub yn: Option<String>,
    /// Upper plane of z.
    #[serde(rename = "plane_Zn")]
    #[schemars(extend("enum" = ["free", "sliding", "fixed"]))]
    pub zn: Option<String>,
}

/// Motion of a boundary plane from a record.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of an earthquake"
)]
pub(super) struct RawEarthquake {
    /// Whether it acts; nothing else here is read where it does not.
    pub active: Option<bool>,
    /// Record with the columns t, ax, ay, az; a path relative to the scene's folder.
    pub file: Option<String>,
    /// Whether the record has a header. Default: found by looking.
    pub header: Option<bool>,
    /// What the record holds. Default: acceleration, as in the manuals.
    #[schemars(extend("enum" = ["acceleration", "velocity"]))]
    pub quantity: Option<String>,
    /// Plane that moves. Default: the lower plane of the last axis.
    #[schemars(extend("enum" = ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"]))]
    pub plane: Option<String>,
}

/// A body. Which keys its shape needs depends on its type.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys of a body")]
pub(super) struct RawBody {
    /// Shape: cuboid (2D and 3D), sphere, cylinder, `extruded_polygon` (3D), rectangle, disc, ring, polygon (2D),
    /// particles (2D and 3D).
    #[schemars(extend("enum" = ["cuboid", "rectangle", "sphere", "disc", "ring", "cylinder", "polygon",
        "extruded_polygon", "particles"]))]
    pub r#type: Option<String>,
    /// Identifier.
    pub id: Option<i64>,
    /// Identifier of the material.
    pub material_id: Option<i64>,
    /// Lower corner of a cuboid or rectangle; centre of the first end face of a cylinder [m].
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner of a cuboid or rectangle; centre of the other end face of a cylinder [m].
    pub point_p2: Option<Vec<f64>>,
    /// Centre of a sphere, disc or ring [m].
    pub center: Option<Vec<f64>>,
    /// Radius of a sphere, disc or cylinder [m].
    pub radius: Option<f64>,
    /// Inner radius of a ring [m].
    pub inner_radius: Option<f64>,
    /// Outer radius of a ring [m].
    pub outer_radius: Option<f64>,
    /// Corners of a polygon, or of an extruded polygon in the plane of its two other axes [m].
    pub points: Option<Vec<Vec<f64>>>,
    /// Axis along which a polygon is extruded.
    #[schemars(extend("enum" = ["x", "y", "z"]))]
    pub axis: Option<String>,
    /// Lower and upper coordinate of an extruded polygon along its axis [m].
    pub range: Option<Vec<f64>>,
    /// Particles: rows of position [m] and volume [m³].
    pub particles: Option<Vec<Vec<f64>>>,
    /// Particles from a text file with the columns x, y, z, volume; a path relative to the scene's folder.
    pub file: Option<String>,
    /// Longest segment of the boundary made from the shape, for mortar contact; in three dimensions of the edges of its
    /// triangles, but for diagonals [m].
    pub boundary_segment: Option<f64>,
    /// Vertices of the boundary, the body on their left, instead of one made from the shape [m].
    pub boundary: Option<Vec<Vec<f64>>>,
    /// Whether the last of these vertices is joined to the first; one that is open covers a part of the body alone.
    /// Default: true.
    pub boundary_closed: Option<bool>,
    /// STL file with the triangles of the boundary, closed and with its normals out of the body, instead of one made from
    /// the shape (3D) [m].
    pub boundary_stl_mesh: Option<String>,
    /// How the boundary follows the body. Default: spin.
    #[schemars(extend("enum" = ["unaugmented", "velocity", "spin", "gradient"]))]
    pub boundary_follows: Option<String>,
    /// Particles per cell and axis. Default: that of the scene.
    pub particles_per_cell: Option<Counts>,
    /// Initial velocity [m/s]. Default: zero.
    pub initial_velocity: Option<Vec<f64>>,
    /// Prescribed velocity [m/s]: a vector, or rows of time [s] and velocity.
    pub prescribed_velocity: Option<VectorOrTable>,
}

/// Constant traction on a rectangle (a segment in 2D) that is fixed in space.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `traction`"
)]
pub(super) struct RawTraction {
    /// Lower corner [m].
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner [m], equal to `point_p1` along exactly one axis.
    pub point_p2: Option<Vec<f64>>,
    /// Traction [Pa].
    pub traction: Option<Vec<f64>>,
}

/// Total force spread by volume over the particles that lie in a box at the start.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1`, `point_p2` and `force`"
)]
pub(super) struct RawBoxLoad {
    /// Lower corner [m].
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner [m].
    pub point_p2: Option<Vec<f64>>,
    /// Total force [N].
    pub force: Option<Vec<f64>>,
}

/// A box in which all nodes of the mesh stand still.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `point_p1` and `point_p2`"
)]
pub(super) struct RawHeldBox {
    /// Lower corner [m].
    pub point_p1: Option<Vec<f64>>,
    /// Upper corner [m].
    pub point_p2: Option<Vec<f64>>,
}

/// A particle whose history is written.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `name` and `point`")]
pub(super) struct RawProbe {
    /// Prefix of the columns.
    pub name: Option<String>,
    /// The particle nearest to this position at the start is followed [m].
    pub point: Option<Vec<f64>>,
}

/// Contact between two bodies.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a contact"
)]
pub(super) struct RawContact {
    /// Identifier. Default: the place in the list, from 1.
    pub id: Option<i64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Identifier of the master body.
    pub master_id: Option<i64>,
    /// Identifier of the slave body.
    pub slave_id: Option<i64>,
    /// How the normal is found. Default: collinear.
    #[schemars(extend("enum" = ["master", "slave", "collinear"]))]
    pub normal_type: Option<String>,
    /// Method of contact. Default: grid.
    #[schemars(extend("enum" = ["grid", "mortar"]))]
    pub method: Option<String>,
    /// Mortar: gap at which contact begins [m].
    pub critical_gap: Option<f64>,
    /// Mortar: stiffness of the normal law [Pa/m].
    pub normal_stiffness: Option<f64>,
    /// Mortar: stiffness of the tangential spring [Pa/m]. Default: so that a round body lags behind its way by 0.5 % at most.
    pub tangential_stiffness: Option<f64>,
    /// Mortar: normal law. Default: barrier.
    #[schemars(extend("enum" = ["barrier", "penalty"]))]
    pub enforcement: Option<String>,
    /// Mortar: how contact is found. Default: mortar.
    #[schemars(extend("enum" = ["mortar", "node_to_segment"]))]
    pub detection: Option<String>,
}

/// A rigid polyline.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a rigid line"
)]
pub(super) struct RawRigidLine {
    /// Identifier; no body may have it.
    pub id: Option<i64>,
    /// Vertices, material on the left of their direction [m].
    pub points: Option<Vec<Vec<f64>>>,
    /// Whether the last vertex is joined to the first. Default: false.
    pub closed: Option<bool>,
    /// Prescribed velocity: a vector, or rows of time and velocity [s, m/s]. Default: at rest.
    pub prescribed_velocity: Option<VectorOrTable>,
}

/// A rigid surface of triangles.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a rigid surface"
)]
pub(super) struct RawRigidSurface {
    /// Identifier; no body may have it.
    pub id: Option<i64>,
    /// STL file with the triangles, touched from the side to which their normals point [m].
    pub stl_mesh: Option<String>,
    /// Prescribed velocity: a vector, or rows of time and velocity [s, m/s]. Default: at rest.
    pub prescribed_velocity: Option<VectorOrTable>,
}

/// Settings of all contacts.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a contact manager"
)]
pub(super) struct RawContactManager {
    /// Whether contacts act. Default: true where there are any.
    pub active: Option<bool>,
    /// Factor lambda on the cell size in the real-distance correction; 0 for none. Default: the sum of the
    /// half-lengths of the particles, in cells: 0.5, as in the manual, with two particles per cell and axis.
    pub real_distance_correction_coefficient: Option<f64>,
}

/// Contact of all bodies with a rigid surface, from the side to which the normals of its triangles point.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a terrain contact"
)]
pub(super) struct RawTerrainContact {
    /// Whether it acts.
    pub active: Option<bool>,
    /// File of the surface, STL, ASCII or binary, in metres; looked for in the folder of the scene.
    pub stl_mesh: Option<String>,
    /// Coefficient of friction. Default: 0, as in the manuals' program.
    pub friction: Option<f64>,
    /// Gap below which contact is looked for, and the longest way towards the surface in one step [m]. Default: the
    /// smallest edge of a cell.
    pub distance_threshold: Option<f64>,
    /// Whether the penalty force acts. Default: true where a stiffness is given.
    pub penalty_contact_active: Option<bool>,
    /// Stiffness of a force that pushes penetrating particles out, per particle [N/m]. Default: no such force.
    pub penalty_stiffness: Option<f64>,
    /// Prescribed velocity of the surface [m/s]: a vector, or rows of time [s] and velocity. Default: it stands.
    pub prescribed_velocity: Option<VectorOrTable>,
}
