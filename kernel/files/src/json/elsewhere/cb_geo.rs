//! Keys of CB-Geo mpm and of programs like it that a user would bring.

use super::{ForeignWord, entry};

/// Its entries.
pub(super) const ALL: &[ForeignWord] = &[
    entry(
        "",
        &["analysis"],
        &["time", "time_step", "stress_scheme_update", "transfer"],
        "here its keys stand at the top of the scene: `time`, `time_step`, `stress_scheme_update`, `transfer`, `damping`",
    ),
    entry(
        "",
        &["title", "name"],
        &["comment"],
        "here the name of the file; words for people are a `comment`",
    ),
    entry(
        "",
        &["post_processing", "vtk", "vtk_vars", "vtk_statevars"],
        &["results"],
        "here `results`, with `print` and `fields`; frames are VTU files",
    ),
    entry(
        "",
        &["external_loading_conditions", "loading_conditions"],
        &["gravity", "nodal_point_load", "traction", "box_load"],
        "here `gravity`, `nodal_point_load`, `traction` and `box_load`, at the top of the scene",
    ),
    entry(
        "",
        &[
            "concentrated_nodal_forces",
            "point_load",
            "nodal_force",
            "nodal_forces",
        ],
        &["nodal_point_load"],
        "here `nodal_point_load`, pairs of a position and a force",
    ),
    entry(
        "",
        &[
            "particle_surface_traction",
            "surface_traction",
            "distributed_load",
            "surface_load",
            "pressure_load",
        ],
        &["traction"],
        "here `traction`, on a rectangle that is fixed in space",
    ),
    entry(
        "",
        &["body_force"],
        &["gravity", "box_load"],
        "here `gravity`, or `box_load` for the particles in a box",
    ),
    entry(
        "",
        &["math_functions"],
        &["traction", "prescribed_velocity"],
        "here rows of a time and a vector, in `traction` and `prescribed_velocity`",
    ),
    entry(
        "",
        &["resume", "restart"],
        &[],
        "here a command: `proctor run SCENE --out DIR --restart DIR/checkpoint.bin` goes on from a checkpoint",
    ),
    entry(
        "",
        &["particles"],
        &["body.particles", "body.file"],
        "here `body`, a list of shapes, or of `type` \"particles\" with `particles` or `file`",
    ),
    entry(
        "mesh",
        &[
            "mesh",
            "entity_sets",
            "cell_type",
            "node_type",
            "io_type",
            "isoparametric",
        ],
        &["mesh.cells_dimension", "mesh.cells_number"],
        "not covered: meshes from files; here a regular one by `cells_dimension`, `cells_number` and `origin`",
    ),
    entry(
        "",
        &["particles_volumes"],
        &["body.file"],
        "here the last column of `particles` or `file` of a body",
    ),
    entry(
        "",
        &["velocity_constraints", "friction_constraints"],
        &["mesh.boundary_conditions", "held_box"],
        "here `mesh.boundary_conditions` for planes of the mesh, `held_box` for nodes that stand still",
    ),
    entry(
        "",
        &["boundary", "boundaries", "bc", "boundary_condition"],
        &["mesh.boundary_conditions"],
        "here `mesh.boundary_conditions`, by the names of the planes",
    ),
    entry(
        "",
        &["damping_factor"],
        &["damping.value"],
        "here `value` of the `damping`",
    ),
    entry(
        "",
        &["velocity", "initial_velocities"],
        &["body.initial_velocity", "body.prescribed_velocity"],
        "here `initial_velocity` of a body, or `prescribed_velocity` where it is driven",
    ),
    entry(
        "",
        &["material_sets"],
        &["body.material_id"],
        "here `material_id` of each body",
    ),
];
