//! The classes of bad input: a sound scene, and what makes it bad.

/// A scene in which nothing is wrong.
pub(crate) const SOUND: &str = r#"{
  "time": 1.0,
  "time_step": 1e-4,
  "gravity": [0, 0, -10],
  "damping": {"type": "local", "value": 0.1},
  "mesh": {
    "cells_dimension": [0.5, 0.5, 0.5],
    "cells_number": [4, 4, 4]
  },
  "material": {
    "rock": {"type": "elastic", "id": 1, "young": 1e6, "density": 2000, "poisson": 0.25}
  },
  "body": [
    {"type": "cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
  ],
  "nodal_point_load": [[[0.5, 0.5, 1], [0, 0, -1]]]
}
"#;

/// Name of the class, what is replaced in the sound scene, and by what.
pub(crate) const CASES: &[(&str, &str, &str)] = &[
    ("misspelt key", r#""time": 1.0"#, r#""tmie": 1.0"#),
    ("misspelt key within", r#""young""#, r#""youngs_modulus""#),
    ("unknown key", r#""time": 1.0"#, r#""time": 1.0, "zzz": 1"#),
    ("wrong type", r#""time": 1.0"#, r#""time": "long""#),
    (
        "wrong type in a list",
        "[0.5, 0.5, 0.5]",
        "[0.5, true, 0.5]",
    ),
    (
        "wrong type of an object",
        r#"{"type": "local", "value": 0.1}"#,
        "3",
    ),
    ("fraction for a whole number", "[4, 4, 4]", "[4, 4.5, 4]"),
    ("negative number of cells", "[4, 4, 4]", "[4, -4, 4]"),
    ("not JSON", r#""time": 1.0,"#, r#""time" 1.0,"#),
    ("missing comma", r#""time": 1.0,"#, r#""time": 1.0"#),
    ("missing comma in a list", "[4, 4, 4]", "[4, 4 4]"),
    (
        "missing comma between entries of a list",
        "[1, 1, 1]}",
        r#"[1, 1, 1]} {"type": "sphere"}"#,
    ),
    ("NaN", r#""time": 1.0"#, r#""time": NaN"#),
    ("too great a number", r#""young": 1e6"#, r#""young": 1e999"#),
    (
        "density beyond all numbers",
        r#""density": 2000"#,
        r#""density": 1.8e308"#,
    ),
    ("text behind the scene", "-1]]]\n}", "-1]]]\n} }"),
    ("key twice", r#""time": 1.0"#, r#""time": 1.0, "time": 2.0"#),
    (
        "entry twice",
        r#""rock": {"#,
        r#""rock": {"id": 4}, "rock": {"#,
    ),
    ("missing key", r#""young": 1e6, "#, ""),
    ("negative size", "[0.5, 0.5, 0.5]", "[0.5, -0.5, 0.5]"),
    ("zero cells", "[4, 4, 4]", "[4, 0, 4]"),
    ("E of zero", r#""young": 1e6"#, r#""young": 0"#),
    ("density of zero", r#""density": 2000"#, r#""density": 0"#),
    ("nu of a half", r#""poisson": 0.25"#, r#""poisson": 0.5"#),
    ("nu of -1", r#""poisson": 0.25"#, r#""poisson": -1"#),
    ("time that does not pass", r#""time": 1.0"#, r#""time": 0"#),
    ("negative time step", "1e-4", "-1e-4"),
    (
        "held box without nodes",
        r#""time": 1.0"#,
        r#""time": 1.0, "held_box": [{"point_p1": [0.1, 0, 0], "point_p2": [0.4, 1, 1]}, {"point_p1": [0, 0, 0]}]"#,
    ),
    (
        "held box in a mesh that moves",
        r#""time": 1.0"#,
        r#""time": 1.0, "held_box": [{"point_p1": [0, 0, 0], "point_p2": [0, 1, 1]}], "earthquake": {"active": true, "file": "comma_header.csv"}"#,
    ),
    (
        "time step and multiplier",
        r#""time_step": 1e-4"#,
        r#""time_step": 1e-4, "time_step_multiplier": 0.5"#,
    ),
    (
        "both spellings of the multiplier",
        r#""time_step": 1e-4"#,
        r#""critical_time_step_multiplier": 0.4, "time_step_multiplier": 0.5"#,
    ),
    (
        "multiplier of zero",
        r#""time_step": 1e-4"#,
        r#""time_step_multiplier": 0"#,
    ),
    (
        "unstable by choice of nobody",
        r#""time_step": 1e-4"#,
        r#""allow_unstable": true"#,
    ),
    (
        "undefined material",
        r#""material_id": 1"#,
        r#""material_id": 2"#,
    ),
    (
        "equal ids of materials",
        r#""rock": {"#,
        r#""clay": {"type": "elastic", "id": 1, "young": 1, "density": 1, "poisson": 0}, "rock": {"#,
    ),
    (
        "equal ids of bodies",
        "[1, 1, 1]}",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 1, "material_id": 1, "center": [1, 1, 1], "radius": 0.5}"#,
    ),
    (
        "both spellings of the materials",
        r#""material": {"#,
        r#""materials": [], "material": {"#,
    ),
    ("body outside the mesh", "[1, 1, 1]", "[1, 1, 2.1]"),
    (
        "sphere outside the mesh",
        r#""cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]"#,
        r#""sphere", "id": 1, "material_id": 1, "center": [1, 1, 1], "radius": 1.5"#,
    ),
    ("empty body", "[1, 1, 1]", "[1, 0, 1]"),
    ("inverted body", "[0, 0, 0]", "[0, 1.5, 0]"),
    ("vector too short", "[0, 0, -10]", "[0, -10]"),
    (
        "vector too long for 2D",
        "{\n  \"time\"",
        "{\n  \"dimension\": 2, \"time\"",
    ),
    (
        "four dimensions",
        "{\n  \"time\"",
        "{\n  \"dimension\": 4, \"time\"",
    ),
    ("unknown shape", r#""cuboid""#, r#""cubiod""#),
    ("shape of another dimension", r#""cuboid""#, r#""disc""#),
    (
        "key of another shape",
        r#""point_p1""#,
        r#""radius": 1, "point_p1""#,
    ),
    ("unknown material type", r#""elastic""#, r#""elastc""#),
    ("unknown damping", r#""local""#, r#""locl""#),
    ("alpha too great", r#""value": 0.1"#, r#""value": 1.5"#),
    ("alpha missing", r#", "value": 0.1"#, ""),
    ("alpha for kinetic damping", r#""local""#, r#""kinetic""#),
    (
        "unknown scheme",
        r#""time": 1.0"#,
        r#""time": 1.0, "stress_scheme_update": "USK""#,
    ),
    (
        "unknown weighting",
        r#""time": 1.0"#,
        r#""time": 1.0, "shape_function": "gmip""#,
    ),
    (
        "domain update of uGIMP",
        r#""time": 1.0"#,
        r#""time": 1.0, "domain_update": "stretch""#,
    ),
    (
        "PIC fraction too great",
        r#""time": 1.0"#,
        r#""time": 1.0, "pic_fraction": 1.1"#,
    ),
    (
        "no particles per cell",
        r#""time": 1.0"#,
        r#""time": 1.0, "particles_per_cell": 0"#,
    ),
    (
        "particles per cell of the wrong length",
        r#""type": "cuboid""#,
        r#""type": "cuboid", "particles_per_cell": [2, 2]"#,
    ),
    (
        "unknown plane condition",
        "[4, 4, 4]",
        r#"[4, 4, 4], "boundary_conditions": {"plane_Z0": "slide"}"#,
    ),
    (
        "unknown plane",
        "[4, 4, 4]",
        r#"[4, 4, 4], "boundary_conditions": {"plane_zn": "free"}"#,
    ),
    (
        "unknown field",
        r#""time": 1.0"#,
        r#""time": 1.0, "results": {"fields": ["id", "displacements"]}"#,
    ),
    ("load between nodes", "[[[0.5, 0.5, 1]", "[[[0.5, 0.6, 1]"),
    ("load that is no pair", ", [0, 0, -1]]", "]"),
    (
        "traction on a box",
        r#""time": 1.0"#,
        r#""time": 1.0, "traction": [{"point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "traction": [1, 0, 0]}]"#,
    ),
    (
        "contact of unknown bodies",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [{"id": 1, "friction": 0.2, "master_id": 1, "slave_id": 7}, {"id": 1, "friction": 0.2, "master_id": 8, "slave_id": 9}]"#,
    ),
    (
        "contact of a body with itself",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [{"friction": 0.2, "master_id": 9, "slave_id": 9}]"#,
    ),
    (
        "contact twice, the other way round",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [{"friction": 0.2, "master_id": 1, "slave_id": 9}, {"friction": 0.1, "master_id": 9, "slave_id": 1}]"#,
    ),
    (
        "negative friction",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": {"floor": {"friction": -0.2, "master_id": 1, "slave_id": 9}}"#,
    ),
    (
        "contact that lacks everything",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [{}]"#,
    ),
    (
        "unknown normal",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [{"friction": 0.2, "master_id": 1, "slave_id": 9, "normal_type": "colinear"}]"#,
    ),
    (
        "mortar contact",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [{"friction": 0.2, "master_id": 1, "slave_id": 9, "method": "mortar"}]"#,
    ),
    (
        "bodies in contact that overlap",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.25, 1.25, 1.25], "radius": 0.6}
  ], "contact": [{"friction": 0.2, "master_id": 1, "slave_id": 9}]"#,
    ),
    (
        "contact without bodies",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": true"#,
    ),
    (
        "negative contact distance",
        "[1, 1, 1]}\n  ]",
        r#"[1, 1, 1]}, {"type": "sphere", "id": 9, "material_id": 1, "center": [1.5, 1.5, 1.5], "radius": 0.4}
  ], "contact": [], "contact_manager": {"active": true, "real_distance_correction_coefficient": -0.5}"#,
    ),
    (
        "terrain contact",
        r#""time": 1.0"#,
        r#""time": 1.0, "terrain_contact": {"active": true}"#,
    ),
    (
        "unknown nodal field",
        r#""time": 1.0"#,
        r#""time": 1.0, "results": {"grid_nodal_results": ["contact_gaps"]}"#,
    ),
    (
        "terrain contact that is not switched",
        r#""time": 1.0"#,
        r#""time": 1.0, "terrain_contact": {"stl_mesh": "nowhere.stl"}"#,
    ),
    (
        "terrain that does not exist",
        r#""time": 1.0"#,
        r#""time": 1.0, "terrain_contact": {"active": true, "stl_mesh": "nowhere.stl"}"#,
    ),
    (
        "terrain that is no surface",
        r#""time": 1.0"#,
        r#""time": 1.0, "terrain_contact": {"active": true, "stl_mesh": "../surfaces/degenerate.stl"}"#,
    ),
    (
        "terrain with values out of range",
        r#""time": 1.0"#,
        r#""time": 1.0, "terrain_contact": [{"active": true, "stl_mesh": "../surfaces/slope.stl", "friction": -0.1, "distance_threshold": 0, "penalty_contact_active": true}]"#,
    ),
    (
        "terrain with an unknown key",
        r#""time": 1.0"#,
        r#""time": 1.0, "terrain_contact": {"active": true, "stl_mesh": "../surfaces/slope.stl", "fricton": 0.1}"#,
    ),
    (
        "three phases",
        r#""time": 1.0"#,
        r#""time": 1.0, "n_phases": 3"#,
    ),
    (
        "no threads",
        r#""time": 1.0"#,
        r#""time": 1.0, "n_threads": 0"#,
    ),
    (
        "missing record",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "nowhere.csv"}"#,
    ),
    (
        "malformed record",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "bad/malformed.csv"}"#,
    ),
    (
        "record without a file",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true}"#,
    ),
    (
        "record without a switch",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"file": "comma_header.csv"}"#,
    ),
    (
        "header that is none",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "semicolon_plain.csv", "header": true}"#,
    ),
    (
        "wave through a plane that does not absorb",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "comma_header.csv", "base": "compliant"}"#,
    ),
    (
        "wave of a rigid base",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "comma_header.csv", "motion": "outcrop"}"#,
    ),
    (
        "unknown base",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "comma_header.csv", "base": "soft"}"#,
    ),
    (
        "springs without an absorbing plane",
        r#""time": 1.0"#,
        r#""time": 1.0, "absorbing_springs": -2"#,
    ),
    (
        "absorbing planes with what they do not go with",
        r#""cells_number": [4, 4, 4]"#,
        r#""cells_number": [4, 4, 4], "boundary_conditions": {"plane_Z0": "absorbing"}}, "earthquake": {"active": true, "file": "comma_header.csv"}, "absorbing_springs": 0, "contact_manager": {"active": true"#,
    ),
    (
        "unknown base plane",
        r#""time": 1.0"#,
        r#""time": 1.0, "earthquake": {"active": true, "file": "comma_header.csv", "plane": "Z1"}"#,
    ),
    (
        "motion whose times stand",
        r#""type": "cuboid""#,
        r#""type": "cuboid", "prescribed_velocity": [[0, 1, 0, 0], [0, 2, 0, 0]]"#,
    ),
    (
        "motion of numbers and rows",
        r#""type": "cuboid""#,
        r#""type": "cuboid", "prescribed_velocity": [0, [1, 0, 0]]"#,
    ),
    (
        "particles outside the mesh",
        r#""cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]"#,
        r#""particles", "id": 1, "material_id": 1, "file": "bad/particles_outside.csv""#,
    ),
    (
        "no particles",
        r#""cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]"#,
        r#""particles", "id": 1, "material_id": 1, "particles": []"#,
    ),
    (
        "probe name of a column",
        r#""time": 1.0"#,
        r#""time": 1.0, "probes": [{"name": "a,b", "point": [0, 0, 0]}]"#,
    ),
    (
        "probe outside the mesh",
        r#""time": 1.0"#,
        r#""time": 1.0, "probes": [{"name": "top", "point": [1, 1, 2]}, {"name": "above", "point": [1, -0.1, 2.5]}]"#,
    ),
    (
        "probes that contradict themselves",
        r#""time": 1.0"#,
        r#""time": 1.0, "probes": [
        {"name": "a", "point": [0, 0, 0], "body": 1}, {"name": "b"}, {"name": "c", "point": [0, 0, 0], "count": 3},
        {"name": "d", "point": [0, 0, 0], "largest": "pressure"}, {"name": "e", "body": 7},
        {"name": "f", "body": 1, "largest": "strain"}, {"name": "g", "body": 1, "largest": "plastic_strain"},
        {"name": "h", "line": [[0, 0, 0]]}, {"name": "i", "line": [[0, 0, 0], [1, 1]]},
        {"name": "k", "line": [[0, 0, 0], [1, 1, 3]], "count": 1}, {"name": "k_1", "point": [0, 0, 0]}]"#,
    ),
    (
        "interval of the history",
        r#""time": 1.0"#,
        r#""time": 1.0, "results": {"history_interval": 0}"#,
    ),
    (
        "interval of the history beyond the end",
        r#""time": 1.0"#,
        r#""time": 1.0, "results": {"history_interval": 2}"#,
    ),
    (
        "rate of a neo-Hookean material",
        r#""elastic""#,
        r#""neo_hookean", "objective_rate": "jaumann""#,
    ),
];
