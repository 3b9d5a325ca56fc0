//! Words of soil mechanics and of the site.

use super::{ForeignWord, entry};

/// Its entries.
pub(super) const ALL: &[ForeignWord] = &[
    entry(
        "",
        &["k0"],
        &["body.initial_stress.ratio", "body.initial_stress.type"],
        "here `initial_stress` of a body with `type` \"at_rest\" and K_0 as its `ratio`",
    ),
    entry(
        "",
        &["geostatic", "in_situ_stress", "initial_stresses"],
        &["body.initial_stress"],
        "here `initial_stress` of a body with `type` \"at_rest\"",
    ),
    entry(
        "",
        &["water_level", "groundwater", "phreatic"],
        &["water_table"],
        "here `water_table`, the level below which water is at rest at the start, with `n_phases` 2",
    ),
    entry(
        "",
        &["dem", "terrain", "topography"],
        &["terrain_contact.stl_mesh", "rigid_surface.stl_mesh"],
        "here a terrain is a surface of triangles, `stl_mesh` of a `terrain_contact` or a `rigid_surface`; rasters of heights are not read, discrete elements not covered",
    ),
    entry(
        "",
        &[
            "base_motion",
            "base_acceleration",
            "base_shaking",
            "vibrational_base",
            "seismic",
            "accelerogram",
        ],
        &["earthquake.file", "earthquake.plane", "earthquake.quantity"],
        "here `earthquake`: its `file` is the record, its `plane` the base that moves",
    ),
    entry(
        "",
        &["stage", "staged", "phase", "phases", "construction"],
        &["stages", "initial_state.file"],
        "here `stages`, a list of the changes of each stage, or `initial_state`, the end of another run",
    ),
    entry(
        "",
        &["gravity_loading", "ramp"],
        &["gravity", "traction"],
        "not covered: gravity that grows; here `initial_stress` of `type` \"at_rest\", or `damping` until the bodies rest",
    ),
    entry(
        "",
        &["rigid_body", "rigid_bodies", "obstacle", "wall", "walls"],
        &[
            "rigid_line",
            "rigid_surface",
            "body.prescribed_velocity",
            "terrain_contact",
        ],
        "here `rigid_line` (2D) or `rigid_surface` (3D) in a contact with `method` \"mortar\", `terrain_contact` (3D), or a body with `prescribed_velocity`",
    ),
    entry(
        "",
        &["units", "unit"],
        &[],
        "not needed: all values are in SI units",
    ),
];
