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
        &[
            "water",
            "pore_water",
            "saturated",
            "saturation",
            "two_phase",
            "two_phases",
            "biot",
            "terzaghi",
            "consolidation",
            "coupled",
        ],
        &[
            "n_phases",
            "material.porosity",
            "material.density_fluid",
            "material.bulk_fluid",
            "material.hydraulic_conductivity",
            "mesh.boundary_conditions_fluid",
            "initial_pressure_box",
            "water_table",
        ],
        "here `n_phases` 2, with `porosity`, `density_fluid`, `bulk_fluid` and `hydraulic_conductivity` of the material, whose `density` is that of the grains, and `boundary_conditions_fluid` of the mesh",
    ),
    entry(
        "",
        &[
            "drain",
            "drained",
            "drainage",
            "undrained",
            "permeable",
            "pervious",
            "impermeable",
            "impervious",
        ],
        &[
            "mesh.boundary_conditions_fluid",
            "mesh.boundary_pressures_fluid",
            "prescribed_pressure_box",
        ],
        "here `boundary_conditions_fluid` of the mesh with `n_phases` 2: a plane that is \"free\" drains, a \"sliding\" one lets no water through; a surface inside the mesh drains by itself",
    ),
    entry(
        "",
        &["fluid", "pore_fluid"],
        &["n_phases", "material.type"],
        "here `n_phases` 2 for water in the pores of soil, or `type` \"newtonian\" of a material for a fluid alone",
    ),
    entry(
        "",
        &["bulk_water", "water_bulk", "fluid_bulk", "k_w"],
        &["material.bulk_fluid"],
        "here `bulk_fluid` of a material, with `n_phases` 2",
    ),
    entry(
        "",
        &["water_density", "fluid_density", "density_water", "rho_w"],
        &["material.density_fluid"],
        "here `density_fluid` of a material, with `n_phases` 2",
    ),
    entry(
        "",
        &["effective", "effective_stress", "total_stress"],
        &["results.fields", "probes"],
        "here the field \"stress\" writes both with `n_phases` 2, and a probe has columns of both",
    ),
    entry(
        "",
        &["settlement", "heave"],
        &["probes", "results.fields"],
        "here a displacement: the column NAME_uy or NAME_uz of a probe in history.csv, or the field \"displacement\"",
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
        "here rows of a time and a vector in `traction`; not covered: gravity that grows, for which `initial_stress` of `type` \"at_rest\" stands, or `damping` until the bodies rest",
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
