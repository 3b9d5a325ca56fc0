//! The keys of a scene file, as written: flat, all optional, nothing checked but types.
//!
//! The text of a key here is its only text: its description, unit, default, range and example are in the JSON Schema, in
//! `proctor keys`, and held against the reader by a test. Beside the words of JSON Schema (`default`, `minimum`, `examples`,
//! ...) there are
//!
//! | word | says |
//! |---|---|
//! | `x-unit` | SI unit; `1` of a plain number |
//! | `x-default` | what holds where the key is missing, if that is no value |
//! | `x-needed` | there is no default: the key must be there |
//! | `x-needs` | what else must be in the scene for the key to mean something |
//! | `x-also` | the key of which this is another spelling |
//! | `x-file` | the text names a file, relative to the folder of the scene |
//!
//! "The manuals" are the technical manual of 2026 and the contact manual v0.1; "their program" is MPM-Geomechanics, whose
//! defaults hold where the manuals give none.

mod bodies;
mod contact;
mod ground;
mod mesh;
mod water;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

use super::lists::{Comment, Contacts, Counts, Entries, Terrains};
use super::material_keys::RawMaterial;

pub(super) use self::bodies::{
    RawBody, RawBoxLoad, RawDistributedLoad, RawHeldBox, RawInitialStress, RawProbe, RawTraction,
};
pub(super) use self::contact::{
    RawContact, RawContactManager, RawRigidLine, RawRigidSurface, RawTerrainContact,
};
pub(super) use self::ground::{RawLayer, RawZone};
pub(super) use self::mesh::{RawEarthquake, RawMesh, RawPlanes};
pub(super) use self::water::{
    RawMaterialPressure, RawPressureBox, RawStandingWater, RawWaterLevels, RawWaterPlanes,
    RawWaterPressures,
};

/// A scene: what is simulated, in SI units.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object in braces: a scene is an object with keys such as `mesh`, `material` and `body`"
)]
pub(super) struct RawScene {
    /// Number of dimensions: 3, or 2, plane strain in x-y with vectors of length 2.
    #[schemars(extend("enum" = [2, 3], "default" = 3, "examples" = [2]))]
    pub dimension: Option<u64>,
    /// End time.
    #[schemars(extend(
        "x-unit" = "s", "x-needed" = true, "exclusiveMinimum" = 0, "examples" = [1.5]
    ))]
    pub time: Option<f64>,
    /// Constant time step, at most the time of the run.
    #[schemars(extend(
        "x-unit" = "s", "x-default" = "the largest safe one, chosen anew in each step", "exclusiveMinimum" = 0,
        "examples" = [1e-4]
    ))]
    pub time_step: Option<f64>,
    /// Time step as a factor on min(h) / max(c + |v|).
    #[schemars(extend(
        "x-unit" = "1", "x-default" = "the largest safe step, chosen anew in each step", "exclusiveMinimum" = 0,
        "examples" = [0.4]
    ))]
    pub critical_time_step_multiplier: Option<f64>,
    /// Another spelling of `critical_time_step_multiplier`, that of the technical manual.
    #[schemars(extend(
        "x-unit" = "1", "x-also" = "critical_time_step_multiplier", "exclusiveMinimum" = 0, "examples" = [0.4]
    ))]
    pub time_step_multiplier: Option<f64>,
    /// Run even where the time step is above the bound of the scheme.
    #[schemars(extend(
        "x-needs" = "`time_step` or `critical_time_step_multiplier`", "default" = false, "examples" = [true]
    ))]
    pub allow_unstable: Option<bool>,
    /// Acceleration of gravity, one number per axis.
    #[schemars(extend(
        "x-unit" = "m/s²", "x-default" = "zero, as in the manuals' program", "examples" = [[0, -9.81], [0, 0, -9.81]]
    ))]
    pub gravity: Option<Vec<f64>>,
    /// Number of threads; the command line overrides it.
    #[schemars(extend(
        "x-default" = "one for 8192 particles, at most all of the machine", "minimum" = 1, "examples" = [2]
    ))]
    pub n_threads: Option<usize>,
    /// Number of phases: 2 where materials have water in their pores.
    #[schemars(extend("enum" = [1, 2], "default" = 1, "examples" = [2]))]
    pub n_phases: Option<u64>,
    /// Place of the stress update in the cycle: before the momentum (USF), after it (USL), or after it with velocities mapped
    /// again (MUSL). The default is that of the manuals' program.
    #[schemars(extend("enum" = ["USF", "USL", "MUSL"], "default" = "USL", "examples" = ["MUSL"]))]
    pub stress_scheme_update: Option<String>,
    /// Weighting function; GIMP and uGIMP are the same. The default is that of the manuals' program.
    #[schemars(extend(
        "enum" = ["linear", "GIMP", "uGIMP", "cpGIMP", "quadratic_bspline"], "default" = "GIMP",
        "examples" = ["cpGIMP"]
    ))]
    pub shape_function: Option<String>,
    /// Update of the particle domain of cpGIMP from the deformation.
    #[schemars(extend(
        "enum" = ["determinant", "stretch", "left_stretch"], "x-needs" = "`shape_function` \"cpGIMP\"",
        "default" = "determinant", "examples" = ["stretch"]
    ))]
    pub domain_update: Option<String>,
    /// Transfer of velocity between particles and nodes. The manuals have the same default.
    /// MLS is for quadratic B-splines.
    #[schemars(extend(
        "enum" = ["FLIP", "APIC", "TPIC", "MLS"], "default" = "FLIP", "examples" = ["APIC"]
    ))]
    pub transfer: Option<String>,
    /// Share of the nodal velocity in the particle velocity.
    #[schemars(extend(
        "x-unit" = "1", "x-default" = "0 with FLIP, 1 with APIC, TPIC and MLS", "minimum" = 0, "maximum" = 1,
        "examples" = [0.01]
    ))]
    pub pic_fraction: Option<f64>,
    /// Averaging of the volumetric strain. With `cell_average` nearly incompressible material does not lock.
    #[schemars(extend(
        "enum" = ["particle", "cell_average"], "default" = "particle", "examples" = ["cell_average"]
    ))]
    pub volumetric_strain: Option<String>,
    /// Particles per cell and axis, at most 100, one number or one per axis; a body may say otherwise. The default is that
    /// of the manuals' program.
    #[schemars(extend("default" = 2, "examples" = [3]))]
    pub particles_per_cell: Option<Counts>,
    /// Numerical damping.
    #[schemars(extend("x-default" = "none", "examples" = [{"type": "local", "value": 0.05}]))]
    pub damping: Option<RawDamping>,
    /// Results that are written.
    #[schemars(extend(
        "x-default" = "ten frames with identifier and displacement",
        "examples" = [{"print": 20, "fields": ["id", "stress"]}]
    ))]
    pub results: Option<RawResults>,
    /// Background mesh.
    #[schemars(extend(
        "x-needed" = true, "examples" = [{"cells_dimension": [0.1, 0.1, 0.1], "cells_number": [20, 20, 20]}]
    ))]
    pub mesh: Option<RawMesh>,
    /// Motion of a boundary plane from a record.
    #[schemars(extend(
        "x-default" = "no plane moves", "examples" = [{"active": true, "file": "record.csv"}]
    ))]
    pub earthquake: Option<RawEarthquake>,
    /// Thickness of the ground beyond `absorbing` planes for which springs stand beside the dashpots: they bring the planes back
    /// after loads that stay.
    #[schemars(extend(
        "x-unit" = "m", "x-default" = "no springs", "exclusiveMinimum" = 0, "examples" = [100]
    ))]
    pub absorbing_springs: Option<f64>,
    /// Materials, as a list or by name.
    #[schemars(extend(
        "x-needed" = true, "examples" = [[{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 1000}]]
    ))]
    pub material: Option<Entries<RawMaterial>>,
    /// Another spelling of `material`.
    #[schemars(extend(
        "x-also" = "material",
        "examples" = [[{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 1000}]]
    ))]
    pub materials: Option<Entries<RawMaterial>>,
    /// Bodies, as a list or by name.
    #[schemars(extend(
        "x-needed" = true,
        "examples" = [[{"type": "sphere", "id": 1, "material_id": 1, "center": [0.5, 0.5, 0.5], "radius": 0.4}]]
    ))]
    pub body: Option<Entries<RawBody>>,
    /// Another spelling of `body`.
    #[schemars(extend(
        "x-also" = "body",
        "examples" = [[{"type": "sphere", "id": 1, "material_id": 1, "center": [0.5, 0.5, 0.5], "radius": 0.4}]]
    ))]
    pub bodies: Option<Entries<RawBody>>,
    /// Level of the water table, a coordinate along the axis of gravity: pore pressures at the start are those of water at rest below
    /// it, and zero above. Pressures of materials and boxes have the last word.
    #[schemars(extend(
        "x-unit" = "m", "x-needs" = "`n_phases` 2, `gravity`", "x-default" = "none", "examples" = [1]
    ))]
    pub water_table: Option<f64>,
    /// Waters at rest that stand beside bodies and press on their surfaces, wherever these go. In a body with water in its pores
    /// that water meets the same pressure at the surface; above the level it is zero there.
    #[schemars(extend(
        "x-needs" = "`gravity`", "x-default" = "none", "examples" = [[{"level": 3}]]
    ))]
    pub standing_water: Option<Vec<RawStandingWater>>,
    /// Pore pressures at the start, each of all particles of a material.
    #[schemars(extend(
        "x-needs" = "`n_phases` 2", "x-default" = "none", "examples" = [[{"material_id": 1, "pressure": 1000}]]
    ))]
    pub initial_pressure_material: Option<Entries<RawMaterialPressure>>,
    /// Pore pressures at the start, each of the particles whose centres lie in a box; a later box has the last word.
    #[schemars(extend(
        "x-needs" = "`n_phases` 2", "x-default" = "none",
        "examples" = [[{"point_p1": [0, 0], "point_p2": [1, 1], "pressure": 1000}]]
    ))]
    pub initial_pressure_box: Option<Entries<RawPressureBox>>,
    /// Pore pressures that stay: each of the particles whose centres lie in a box at the start, wherever they go, as at a
    /// drained surface; a later box has the last word.
    #[schemars(extend(
        "x-needs" = "`n_phases` 2", "x-default" = "none",
        "examples" = [[{"point_p1": [0, 0.9], "point_p2": [1, 1], "pressure": 0}]]
    ))]
    pub prescribed_pressure_box: Option<Entries<RawPressureBox>>,
    /// Run from whose end bodies begin, each as the body of the same `id` there: positions, stresses, deformations and
    /// internal variables. Other bodies begin as they are given, and bodies of that run that the scene lacks are left out.
    #[schemars(extend(
        "x-default" = "bodies begin as they are given", "examples" = [{"file": "checkpoint.bin"}]
    ))]
    pub initial_state: Option<RawInitialState>,
    /// Stages that follow each other, each from the end of the one before: objects with a `name`, the `velocity` that bodies
    /// begin with (`zero` or `kept`) and the keys of the scene that the stage changes. `time` is the time of the stage.
    #[schemars(extend(
        "x-default" = "the scene is one stage",
        "examples" = [[{"name": "settle", "damping": {"type": "local", "value": 0.7}}, {"name": "shake", "time": 20}]]
    ))]
    pub stages: Option<Vec<BTreeMap<String, Value>>>,
    /// End before `time`, once forces are in balance.
    #[schemars(extend("x-default" = "the run goes on to `time`", "examples" = [{"unbalanced_force": 1e-3}]))]
    pub until: Option<RawUntil>,
    /// Boxes in which all nodes of the mesh stand still.
    #[schemars(extend(
        "x-default" = "none", "examples" = [[{"point_p1": [0, 0, 0], "point_p2": [0.5, 0, 0]}]]
    ))]
    pub held_box: Option<Vec<RawHeldBox>>,
    /// Forces on nodes: pairs of a position and a force.
    #[schemars(extend(
        "x-unit" = "m, N", "x-default" = "none", "examples" = [[[[0.5, 0.5, 1.0], [0, 0, -100]]]]
    ))]
    pub nodal_point_load: Option<Vec<Vec<Vec<f64>>>>,
    /// Tractions on rectangles fixed in space.
    #[schemars(extend(
        "x-default" = "none",
        "examples" = [[{"point_p1": [0, 0, 1], "point_p2": [1, 1, 1], "traction": [0, 0, -1000]}]]
    ))]
    pub traction: Option<Vec<RawTraction>>,
    /// Forces spread over the particles that lie in a box at the start.
    #[schemars(extend(
        "x-default" = "none", "examples" = [[{"point_p1": [0, 0, 0], "point_p2": [1, 1, 0.5], "force": [10, 0, 0]}]]
    ))]
    pub box_load: Option<Vec<RawBoxLoad>>,
    /// The same as `box_load`, in the words of MPM-Geomechanics: as a list or by name, with `load` for the total force.
    #[schemars(extend(
        "x-default" = "none",
        "examples" = [{"cap": {"point_p1": [0, 0, 0.5], "point_p2": [1, 1, 1], "load": [0, 0, -1000]}}]
    ))]
    pub load_distributed_box: Option<Entries<RawDistributedLoad>>,
    /// Treatment of a particle that leaves the mesh.
    #[schemars(extend("enum" = ["stop", "remove"], "default" = "stop", "examples" = ["remove"]))]
    pub outside: Option<String>,
    /// Reaction to an imbalance of energy, momentum or a strain increment: the run tells it at its end, or stops.
    #[schemars(extend("enum" = ["tell", "stop"], "default" = "tell", "examples" = ["stop"]))]
    pub on_imbalance: Option<String>,
    /// Columns of the history that follow particles or bodies.
    #[schemars(extend(
        "x-default" = "none", "examples" = [[{"name": "top", "point": [0.5, 0.5, 1]}]]
    ))]
    pub probes: Option<Vec<RawProbe>>,
    /// Contact between bodies, as a list or by name.
    #[schemars(extend(
        "x-default" = "none: bodies share one velocity field and stick",
        "examples" = [[{"master_id": 1, "slave_id": 2, "friction": 0.3}]]
    ))]
    pub contact: Option<Contacts>,
    /// Rigid polylines without particles, for mortar contact in two dimensions.
    #[schemars(extend(
        "x-needs" = "`dimension` 2", "x-default" = "none",
        "examples" = [{"floor": {"id": 9, "points": [[1, 0], [0, 0]]}}]
    ))]
    pub rigid_line: Option<Entries<RawRigidLine>>,
    /// Rigid surfaces of triangles without particles, for mortar contact in three dimensions.
    #[schemars(extend(
        "x-needs" = "`dimension` 3", "x-default" = "none", "examples" = [{"floor": {"id": 9, "stl_mesh": "floor.stl"}}]
    ))]
    pub rigid_surface: Option<Entries<RawRigidSurface>>,
    /// Settings of all contacts.
    #[schemars(extend("x-default" = "contacts act", "examples" = [{"active": false}]))]
    pub contact_manager: Option<RawContactManager>,
    /// Contact with a rigid surface, or a list of them.
    #[schemars(extend(
        "x-needs" = "`dimension` 3", "x-default" = "none",
        "examples" = [{"active": true, "stl_mesh": "floor.stl", "friction": 0.3}]
    ))]
    pub terrain_contact: Option<Terrains>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Numerical damping.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `type` and `value`")]
pub(super) struct RawDamping {
    /// Kind of damping: on the unbalanced force, by stopping at peaks of kinetic energy, or by drag.
    #[schemars(extend(
        "enum" = ["none", "local", "kinetic", "viscous"], "x-needed" = true, "examples" = ["local"]
    ))]
    pub r#type: Option<String>,
    /// Factor alpha, 0 to 1 for local damping; for viscous damping 0 or greater: forces are -c m v with the rate c = alpha
    /// sqrt(E/rho)/h [1/s], E Young's modulus and rho the density of a body, h the shortest side of a cell.
    #[schemars(extend(
        "x-unit" = "1", "x-needs" = "`type` \"local\" or \"viscous\"", "x-needed" = true, "minimum" = 0,
        "examples" = [0.05]
    ))]
    pub value: Option<f64>,
    /// Another spelling of `value`.
    #[schemars(extend(
        "x-unit" = "1", "x-also" = "value", "minimum" = 0, "examples" = [0.05]
    ))]
    pub alpha: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// End of a run before its time.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `unbalanced_force`")]
pub(super) struct RawUntil {
    /// Sum of the unbalanced forces at the nodes over the weight, or over the force of the stress where nothing weighs.
    #[schemars(extend("x-unit" = "1", "x-needed" = true, "exclusiveMinimum" = 0, "examples" = [1e-3]))]
    pub unbalanced_force: Option<f64>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Start from the end of another run.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `file`")]
pub(super) struct RawInitialState {
    /// Checkpoint, or folder of a run with one; a path relative to the folder of the scene.
    #[schemars(extend("x-needed" = true, "x-file" = true, "examples" = ["checkpoint.bin"]))]
    pub file: Option<String>,
    /// Velocity of the bodies at the start.
    #[schemars(extend("enum" = ["zero", "kept"], "default" = "zero", "examples" = ["kept"]))]
    pub velocity: Option<String>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}

/// Results that are written.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `print` and `fields`")]
pub(super) struct RawResults {
    /// Number of frames after the first one, one every `time`/`print` seconds; 0 writes none. The default is that of the
    /// manuals' program.
    #[schemars(extend("default" = 10, "minimum" = 0, "maximum" = 999_999, "examples" = [40]))]
    pub print: Option<usize>,
    /// Interval of the rows of `history.csv`. A row holds the state of the step nearest to a multiple of it; no step is cut
    /// for it.
    #[schemars(extend(
        "x-unit" = "s", "x-default" = "a row with each frame", "exclusiveMinimum" = 0, "examples" = [0.005]
    ))]
    pub history_interval: Option<f64>,
    /// Particle fields in the frames, `all` or `none`. The default is that of the manuals' program. With `n_phases` 2 `stress` writes
    /// the effective and the total stress, `pressure` the mean effective stress and the pore pressure, both positive in
    /// compression, and `velocity` that of the water, too.
    #[schemars(extend(
        "default" = ["id", "displacement"], "examples" = [["id", "velocity", "stress"]],
        "x-words" = [
            "id", "material", "body", "active", "mass", "volume", "density", "displacement", "velocity", "stress", "pressure",
            "deformation_gradient", "external_force", "internal_variables", "all", "none",
        ]
    ))]
    pub fields: Option<Vec<String>>,
    /// Another spelling of `fields`.
    #[schemars(extend("x-also" = "fields", "examples" = [["id", "velocity", "stress"]]))]
    pub material_point_results: Option<Vec<String>>,
    /// Nodal fields in the grid frames, `all` or `none`; without any there are no grid frames.
    #[schemars(extend(
        "default" = ["none"], "examples" = [["mass", "velocity"]],
        "x-words" = ["mass", "velocity", "body", "contact_force", "contact_gap", "all", "none"]
    ))]
    pub grid_nodal_results: Option<Vec<String>>,
    /// Write a checkpoint with each frame.
    #[schemars(extend("default" = true, "examples" = [false]))]
    pub checkpoint: Option<bool>,
    /// Words for people, in every object: one text or a list of them. Nothing reads them.
    #[schemars(extend("x-default" = "none", "examples" = ["stiffer than the soil"]))]
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<Comment>,
}
