//! Words that keys do not accept: types of bodies, materials and damping.

use super::{ForeignWord, entry};

/// Its entries.
pub(super) const ALL: &[ForeignWord] = &[
    entry(
        "body",
        &["polygon_2d", "polygon2d"],
        &["body.type"],
        "here \"extruded_polygon\", with `points` in the plane of its two other axes, `axis` and `range`; in 2D \"polygon\"",
    ),
    entry(
        "body",
        &["particles_list", "particles_from_file", "particle_list"],
        &["body.type"],
        "here \"particles\", with `particles`, rows of x, y, z and volume, or `file`, a text table of them",
    ),
    entry(
        "body",
        &["gmsh"],
        &["body.type"],
        "not covered: bodies from a gmsh mesh; here \"particles\" with `file`, a table of centres and volumes",
    ),
    entry(
        "body",
        &["box", "block", "cube"],
        &["body.type"],
        "here \"cuboid\"",
    ),
    entry("body", &["circle"], &["body.type"], "here \"disc\""),
    entry("body", &["ball"], &["body.type"], "here \"sphere\""),
    entry(
        "material",
        &[
            "linear_elastic",
            "linear_elastic2d",
            "linear_elastic3d",
            "elastic_jaumann",
            "hypoelastic",
        ],
        &["material.type"],
        "here \"elastic\"",
    ),
    entry(
        "material",
        &["mohr_coulomb2d", "mohr_coulomb3d", "mc"],
        &["material.type"],
        "here \"mohr_coulomb\"",
    ),
    entry(
        "material",
        &["newtonian2d", "newtonian3d", "fluid", "water"],
        &["material.type"],
        "here \"newtonian\"",
    ),
    entry(
        "material",
        &["bingham2d", "bingham3d"],
        &["material.type"],
        "here \"bingham\"",
    ),
    entry(
        "material",
        &["neohookean", "hyperelastic"],
        &["material.type"],
        "here \"neo_hookean\"",
    ),
    entry(
        "material",
        &["j2", "mises", "plastic"],
        &["material.type"],
        "here \"von_mises\"",
    ),
    entry(
        "material",
        &[
            "modified_cam_clay",
            "modified_cam_clay2d",
            "modified_cam_clay3d",
            "cam_clay",
            "nor_sand",
            "norsand3d",
            "hypoplastic",
        ],
        &[],
        "not covered: critical-state soils; the nearest here are \"mohr_coulomb\", \"drucker_prager\" and \"tresca\"",
    ),
    entry(
        "material",
        &["rigid"],
        &[],
        "not covered: a rigid material; here a body with `prescribed_velocity`, a `rigid_line` or a `rigid_surface`",
    ),
    entry("damping", &["cundall"], &["damping.type"], "here \"local\""),
    entry(
        "damping",
        &["rayleigh"],
        &["damping.type"],
        "not covered: Rayleigh's damping; here \"viscous\" or \"local\"",
    ),
];
