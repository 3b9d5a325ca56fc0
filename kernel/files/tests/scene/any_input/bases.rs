//! Small sound scenes that between them use every part of the language, as a beginning for unsound ones.

/// Folder in which the scenes look for their files.
pub(crate) const FOLDER: &str = "../../fixtures/scenes";

/// Sound scenes of a few hundred particles at most.
pub(crate) const BASES: &[&str] = &[
    // Shapes of the plane, MUSL, APIC, cpGIMP, probes, a wall of each kind.
    r#"{
  "dimension": 2, "time": 0.01, "stress_scheme_update": "MUSL", "transfer": "APIC", "shape_function": "cpGIMP",
  "domain_update": "stretch", "pic_fraction": 0.5, "gravity": [0, -9.81], "n_threads": 1, "outside": "remove",
  "particles_per_cell": [2, 3], "critical_time_step_multiplier": 0.2, "allow_unstable": false,
  "damping": {"type": "local", "value": 0.1},
  "results": {"print": 3, "fields": ["all"], "grid_nodal_results": ["mass", "velocity"], "checkpoint": false},
  "mesh": {"origin": [-1, -1], "cells_dimension": [0.5, 0.5], "cells_number": [10, 8],
    "boundary_conditions": {"plane_X0": "free", "plane_Xn": "sliding", "plane_Y0": "fixed", "plane_Yn": "free"}},
  "material": {"rubber": {"type": "neo_hookean", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}},
  "body": [
    {"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [-1, -1], "point_p2": [0.25, 0.3]},
    {"type": "disc", "id": 2, "material_id": 1, "center": [1, 0.5], "radius": 0.6, "initial_velocity": [1, 0]},
    {"type": "ring", "id": 3, "material_id": 1, "center": [3, 2], "inner_radius": 0.3, "outer_radius": 0.8},
    {"type": "polygon", "id": 4, "material_id": 1, "points": [[2, -1], [3.5, -1], [3, 0], [2.5, -0.5]],
      "particles_per_cell": 3},
    {"type": "particles", "id": 5, "material_id": 1, "particles": [[0.7, -0.5, 0.01], [0.9, -0.5, 0.02]]}],
  "nodal_point_load": [[[0, 0], [1, 0]]],
  "traction": [{"point_p1": [-1, 0], "point_p2": [0, 0], "traction": [0, -1]}],
  "box_load": [{"point_p1": [-1, -1], "point_p2": [0, 0], "force": [1, 1]}],
  "held_box": [{"point_p1": [-1, -1], "point_p2": [0, -1]}],
  "probes": [{"name": "corner", "point": [0, 0]}]
}"#,
    // Contact on the grid with a driven body.
    r#"{
  "dimension": 2, "time": 0.05, "time_step": 1e-4, "stress_scheme_update": "USF", "gravity": [0, -10],
  "damping": {"type": "kinetic"}, "results": {"print": 0},
  "mesh": {"cells_dimension": [0.25, 0.25], "cells_number": [12, 8]},
  "materials": [{"type": "elastic", "id": 7, "young": 1e6, "density": 2000, "poisson": 0.2,
    "objective_rate": "jaumann"}],
  "bodies": {
    "floor": {"type": "rectangle", "id": 1, "material_id": 7, "point_p1": [0, 0], "point_p2": [3, 0.5],
      "prescribed_velocity": [0, 0]},
    "block": {"type": "rectangle", "id": 2, "material_id": 7, "point_p1": [1, 0.5], "point_p2": [2, 1],
      "initial_velocity": [1, 0]},
    "ram": {"type": "rectangle", "id": 3, "material_id": 7, "point_p1": [2, 0.5], "point_p2": [2.5, 1],
      "prescribed_velocity": [[0, 0, 0], [0.1, -1, 0]]}},
  "contact": {"lower": {"id": 1, "friction": 0.3, "master_id": 1, "slave_id": 2, "normal_type": "master"},
    "side": {"id": 2, "friction": 0, "master_id": 2, "slave_id": 3}},
  "contact_manager": {"active": true, "real_distance_correction_coefficient": 0.5}
}"#,
    // Mortar contact in the plane.
    r#"{
  "dimension": 2, "time": 0.05, "transfer": "TPIC", "shape_function": "quadratic_bspline",
  "stress_scheme_update": "MUSL", "damping": {"type": "viscous", "alpha": 0.1},
  "mesh": {"cells_dimension": [0.25, 0.25], "cells_number": [12, 10]},
  "material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
  "body": [
    {"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0.5, 0.5], "point_p2": [2.5, 1],
      "boundary_segment": 0.2, "boundary_follows": "gradient"},
    {"type": "disc", "id": 2, "material_id": 1, "center": [1.5, 1.52], "radius": 0.5, "boundary_segment": 0.1,
      "initial_velocity": [0, -1]}],
  "rigid_line": [{"id": 9, "points": [[3, 0.4], [0, 0.4]], "closed": false, "prescribed_velocity": [0, 0.1]}],
  "contact": [
    {"method": "mortar", "master_id": 1, "slave_id": 2, "friction": 0.3, "critical_gap": 0.05,
      "normal_stiffness": 1e5, "tangential_stiffness": 1e5, "enforcement": "barrier", "detection": "mortar"},
    {"method": "mortar", "id": 5, "master_id": 9, "slave_id": 1, "friction": 0, "critical_gap": 0.05,
      "normal_stiffness": 1e5, "enforcement": "penalty", "detection": "node_to_segment"}]
}"#,
    // A given boundary.
    r#"{
  "dimension": 2, "time": 0.05, "shape_function": "linear", "stress_scheme_update": "MUSL",
  "mesh": {"cells_dimension": [0.5, 0.5], "cells_number": [6, 6]},
  "material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
  "body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [1, 1], "point_p2": [2, 2],
    "boundary": [[1, 1], [1.5, 1], [2, 1], [2, 2], [1, 2]], "boundary_closed": true, "boundary_follows": "velocity"}],
  "rigid_line": {"floor": {"id": 2, "points": [[3, 0.9], [0, 0.9]]}},
  "contact": {"on it": {"method": "mortar", "master_id": 2, "slave_id": 1, "friction": 0, "critical_gap": 0.2,
    "normal_stiffness": 1e4}}
}"#,
    // Mortar contact in space.
    r#"{
  "time": 0.05, "gravity": [0, 0, -10],
  "mesh": {"origin": [-0.8, -0.8, -0.4], "cells_dimension": [0.4, 0.4, 0.4], "cells_number": [6, 4, 5]},
  "material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 300, "poisson": 0.3}],
  "body": [
    {"type": "sphere", "id": 1, "material_id": 1, "center": [0, 0, 0.52], "radius": 0.5, "boundary_segment": 0.4},
    {"type": "extruded_polygon", "id": 3, "material_id": 1, "points": [[0.8, 0.1], [1.4, 0.1], [1.1, 0.6]],
      "axis": "y", "range": [-0.4, 0.4], "boundary_segment": 0.4, "boundary_follows": "gradient"},
    {"type": "particles", "id": 4, "material_id": 1, "file": "../records/particles.csv"}],
  "rigid_surface": {"plane": {"id": 2, "stl_mesh": "../surfaces/plane.stl", "prescribed_velocity": [0, 0, 0.1]}},
  "contact": {"on": {"method": "mortar", "master_id": 2, "slave_id": 1, "friction": 0.3, "critical_gap": 0.04,
    "normal_stiffness": 1e4, "tangential_stiffness": 1e4}}
}"#,
    // Shapes of space on a terrain.
    r#"{
  "time": 0.1, "gravity": [0, 0, -9.81], "particles_per_cell": 2,
  "results": {"print": 2, "fields": ["id", "stress"], "grid_nodal_results": ["all"]},
  "mesh": {"cells_dimension": [0.4, 0.4, 0.4], "cells_number": [5, 5, 4]},
  "material": [{"type": "elastic", "id": 1, "young": 1e6, "density": 1000, "poisson": 0.3}],
  "body": [
    {"type": "cylinder", "id": 1, "material_id": 1, "point_p1": [0.5, 0.5, 1], "point_p2": [0.5, 1, 1],
      "radius": 0.3},
    {"type": "cuboid", "id": 2, "material_id": 1, "point_p1": [1, 1, 1], "point_p2": [1.5, 1.5, 1.5],
      "boundary_stl_mesh": null}],
  "terrain_contact": {"active": true, "stl_mesh": "../surfaces/terrain.stl", "friction": 0.4,
    "distance_threshold": 0.2, "penalty_contact_active": true, "penalty_stiffness": 1e3,
    "prescribed_velocity": [0, 0, 0]}
}"#,
    // A shaken base.
    r#"{
  "dimension": 2, "time": 1, "gravity": [0, -10], "results": {"print": 1},
  "mesh": {"cells_dimension": [0.5, 0.5], "cells_number": [8, 6],
    "boundary_conditions": {"plane_X0": "free", "plane_Xn": "free", "plane_Yn": "free"}},
  "earthquake": {"active": true, "file": "shaken_base_2d.csv", "header": true, "quantity": "acceleration",
    "plane": "Y0"},
  "material": [{"type": "elastic", "id": 1, "young": 2e6, "density": 1800, "poisson": 0.3}],
  "body": [{"type": "polygon", "id": 1, "material_id": 1, "points": [[1, 0], [3, 0], [2, 2]]}],
  "probes": [{"name": "top", "point": [2, 2]}]
}"#,
];
