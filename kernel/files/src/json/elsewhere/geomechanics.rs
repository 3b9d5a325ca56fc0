//! Keys of the examples and of the reader of MPM-Geomechanics that are not in the manuals.

use super::{ForeignWord, entry};

/// Its entries.
pub(super) const ALL: &[ForeignWord] = &[
    entry(
        "",
        &["load_state"],
        &[],
        "here a command: `proctor run SCENE --out DIR --restart DIR/checkpoint.bin` goes on from a checkpoint",
    ),
    entry(
        "",
        &["save_state"],
        &["results.checkpoint"],
        "here `results.checkpoint`, true by default: the state is written with each frame, and `proctor run --restart` takes it up",
    ),
    entry(
        "",
        &["no_load_distributed_box"],
        &["load_distributed_box"],
        "a `load_distributed_box` that is switched off; leave the key out",
    ),
    entry(
        "",
        &["permeability", "porous"],
        &["material.hydraulic_conductivity"],
        "here `hydraulic_conductivity` of a material, with `n_phases` 2",
    ),
    entry(
        "",
        &["pressure_force_box"],
        &["prescribed_pressure_box", "boundary_pressures_fluid"],
        "not covered: a force on the water in a box; `prescribed_pressure_box` holds the pore pressure there, `boundary_pressures_fluid` of the mesh that at a plane",
    ),
    entry(
        "",
        &["hydro_mechanical_coupling", "pore_pressure_field"],
        &["n_phases"],
        "not covered: pore pressures from a file; `n_phases` 2 has a pore pressure in each particle",
    ),
    entry(
        "",
        &["pore_pressure", "water_pressure", "excess_pore_pressure"],
        &[
            "initial_pressure_box",
            "prescribed_pressure_box",
            "mesh.boundary_pressures_fluid",
            "results.fields",
        ],
        "here `initial_pressure_box` gives that of the start, with `n_phases` 2; the field \"pressure\" writes it, and a probe has its column",
    ),
    entry(
        "",
        &["diameter"],
        &["body.radius"],
        "here `radius`, half of the diameter",
    ),
    entry(
        "",
        &["extrude_direction"],
        &["body.axis"],
        "here `axis` of the `type` \"extruded_polygon\": \"x\", \"y\" or \"z\"",
    ),
    entry(
        "",
        &["extrude_displacement"],
        &["body.range"],
        "here `range` of the `type` \"extruded_polygon\": its lower and upper coordinate along `axis`",
    ),
    entry(
        "",
        &["discretization_length"],
        &["particles_per_cell", "body.particles_per_cell"],
        "here `particles_per_cell`: the cell over this length",
    ),
    entry(
        "body",
        &["mesh_file", "physical_to_material", "particle_distribution"],
        &["body.particles", "body.file"],
        "not covered: bodies from a gmsh mesh; here `type` \"particles\" with `file`, a table of centres and volumes, one body for each material",
    ),
    entry(
        "body",
        &["active"],
        &[],
        "not covered: a switch for a body; leave the body out",
    ),
    entry(
        "body",
        &["position", "volume"],
        &["body.particles", "body.file"],
        "here `particles`, rows of position and volume, or `file` with such a table",
    ),
    entry(
        "",
        &["stl_contact_mesh"],
        &[],
        "not covered: rigid surfaces are not written; a viewer opens their STL files beside particles.pvd",
    ),
    entry(
        "mesh",
        &["type"],
        &[],
        "not needed: every mesh is a regular one; leave the key out",
    ),
];
