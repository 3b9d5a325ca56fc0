//! Sound scenes in which keys are put: between them they have every block, and every key that another one needs.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

/// A folder with the files that the examples name.
pub fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let fixtures = Path::new("../../fixtures");
    for (from, to) in [
        ("records/comma_header.csv", "record.csv"),
        ("records/particles.csv", "particles.csv"),
        ("surfaces/plane.stl", "floor.stl"),
        ("surfaces/cube.stl", "block.stl"),
        // Read when the scene runs.
        ("surfaces/cube.stl", "checkpoint.bin"),
    ] {
        std::fs::copy(fixtures.join(from), folder.path().join(to)).expect("a fixture");
    }
    let head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (name, rows) in [
        ("terrain.asc", "1 1.5\n1 1.5\n"),
        ("rock.asc", "0.5 0.75\n0.5 0.75\n"),
    ] {
        let text = format!("{head}{rows}");
        std::fs::write(folder.path().join(name), text).expect("a raster");
    }
    folder
}

/// A scene in so many dimensions with a block of 1 m at the lower corner of a mesh of 2 m.
pub fn block(axes: usize) -> Value {
    let mut scene = json!({
        "time": 1,
        "mesh": {"cells_dimension": vec![0.1; axes], "cells_number": vec![20; axes], "boundary_conditions": {}},
        "results": {},
        "material": [{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 1000}],
        "body": [{
            "type": "cuboid", "id": 1, "material_id": 1,
            "point_p1": vec![0; axes], "point_p2": vec![1; axes]
        }]
    });
    if axes == 2 {
        scene["dimension"] = 2.into();
    }
    scene
}

/// The block with more keys, those of its body first.
fn with(axes: usize, of_body: &Value, more: &Value) -> Value {
    let mut scene = block(axes);
    with_body(&mut scene, of_body);
    for (key, value) in more.as_object().expect("keys") {
        scene[key] = value.clone();
    }
    scene
}

/// The block in another shape.
fn shaped(axes: usize, shape: &Value) -> Value {
    let mut scene = block(axes);
    let body = scene["body"][0].as_object_mut().expect("a body");
    body.remove("point_p1");
    body.remove("point_p2");
    with_body(&mut scene, shape);
    scene
}

fn with_body(scene: &mut Value, keys: &Value) {
    for (key, value) in keys.as_object().expect("keys") {
        scene["body"][0][key] = value.clone();
    }
}

/// Two layers under gravity, and more keys of the body.
fn layered(axes: usize, of_body: &Value) -> Value {
    let mut scene = shaped(axes, &json!({"type": "between", "lower": 0, "upper": 1}));
    scene["body"][0]
        .as_object_mut()
        .expect("a body")
        .remove("material_id");
    scene["body"][0]["layers"] = json!([{"material_id": 1, "base": 0.5}, {"material_id": 1}]);
    let mut gravity = vec![0; axes];
    gravity[axes - 1] = -10;
    scene["gravity"] = gravity.into();
    with_body(&mut scene, of_body);
    scene
}

/// The block of a material with more keys.
fn of_material(axes: usize, keys: &Value) -> Value {
    let mut scene = block(axes);
    for (key, value) in keys.as_object().expect("keys") {
        scene["material"][0][key] = value.clone();
    }
    scene
}

/// The block of clay that is pressed.
fn of_clay(axes: usize) -> Value {
    let mut scene = block(axes);
    scene["material"][0] = json!({
        "type": "cam_clay", "id": 1, "density": 1000, "critical_ratio": 1.2, "compression": 0.25, "swelling": 0.02,
        "poisson": 0.3,
    });
    scene["body"][0]["initial_stress"] = json!({"type": "isotropic", "value": -1e5});
    scene
}

/// The block of clay whose strength is a share of the stress at the start.
fn of_undrained_clay(axes: usize) -> Value {
    let keys = json!({"type": "undrained_clay", "su_vertical_stress": 0.2});
    let mut scene = of_material(axes, &keys);
    scene["body"][0]["initial_stress"] = json!({"type": "isotropic", "value": -1e5});
    scene
}

/// The block with water in its pores.
fn of_wet_soil(axes: usize) -> Value {
    let mut scene = of_material(
        axes,
        &json!({
            "porosity": 0.4, "density_fluid": 1000, "bulk_fluid": 2e8, "hydraulic_conductivity": vec![1e-3; axes],
        }),
    );
    scene["n_phases"] = 2.into();
    // The level of a water table is a coordinate along it.
    scene["gravity"] = [vec![0.0; axes - 1], vec![-9.81]].concat().into();
    scene["mesh"]["boundary_conditions_fluid"] = json!({});
    scene["mesh"]["boundary_pressures_fluid"] = json!({});
    scene["mesh"]["boundary_levels_fluid"] = json!({});
    scene["initial_pressure_material"] = json!([{"material_id": 1, "pressure": 10}]);
    scene["initial_pressure_box"] =
        json!([{"point_p1": vec![0; axes], "point_p2": vec![1; axes], "pressure": 10}]);
    scene["prescribed_pressure_box"] = scene["initial_pressure_box"].clone();
    scene["load_distributed_box"] =
        json!([{"point_p1": vec![0; axes], "point_p2": vec![1; axes], "load": vec![1; axes]}]);
    scene
}

/// The block in water that stands beside it.
fn in_standing_water(axes: usize, keys: &Value) -> Value {
    let mut scene = block(axes);
    scene["gravity"] = [vec![0.0; axes - 1], vec![-9.81]].concat().into();
    scene["standing_water"] = json!([{"level": 0.5}]);
    for (key, value) in keys.as_object().expect("keys") {
        scene["standing_water"][0][key] = value.clone();
    }
    scene
}

/// The block of a fluid with more keys.
fn of_fluid(axes: usize, keys: &Value) -> Value {
    let mut scene = block(axes);
    scene["material"][0] =
        json!({"type": "newtonian", "id": 1, "bulk": 1e6, "viscosity": 1, "density": 1000});
    for (key, value) in keys.as_object().expect("keys") {
        scene["material"][0][key] = value.clone();
    }
    scene
}

/// The block on an absorbing plane, with more keys.
fn on_absorbing(more: &Value) -> Value {
    let mut scene = with(3, &json!({}), more);
    scene["mesh"]["boundary_conditions"]["plane_Z0"] = "absorbing".into();
    scene
}

/// Two blocks that touch.
fn two(axes: usize, more: &Value) -> Value {
    let mut scene = with(axes, &json!({}), more);
    let mut second = scene["body"][0].clone();
    second["id"] = 2.into();
    second["point_p1"][0] = 1.into();
    second["point_p2"][0] = 2.into();
    scene["body"].as_array_mut().expect("a list").push(second);
    scene
}

/// Sound scenes; between them they have every block and every key that another one needs.
pub fn bases() -> Vec<Value> {
    let none = json!({});
    let corner = |axes: usize, z: f64| {
        let mut at = vec![0.0; axes];
        at[axes - 1] = z;
        at
    };
    let mut bases = vec![];
    for axes in [2, 3] {
        let upper = |z: f64| {
            let mut at = vec![1.0; axes];
            at[axes - 1] = z;
            at
        };
        bases.extend([
            block(axes),
            with(axes, &none, &json!({"time_step": 1e-4, "shape_function": "cpGIMP"})),
            with(axes, &none, &json!({"damping": {"type": "local"}})),
            with(axes, &none, &json!({"damping": {"type": "local", "value": 0.1}})),
            with(axes, &none, &json!({
                "traction": [{"point_p1": corner(axes, 1.0), "point_p2": upper(1.0), "traction": corner(axes, -1.0)}],
                "box_load": [{"point_p1": corner(axes, 0.0), "point_p2": upper(0.5), "force": corner(axes, -1.0)}],
                "held_box": [{"point_p1": corner(axes, 0.0), "point_p2": upper(0.0)}],
                "probes": [{"name": "a", "point": corner(axes, 1.0)}],
            })),
            with(axes, &none, &json!({"probes": [{"name": "a", "line": [corner(axes, 0.0), corner(axes, 1.0)]}]})),
            with(axes, &none, &json!({"probes": [{"name": "a", "body": 1}]})),
            two(axes, &json!({
                "contact": [{"friction": 0.2, "master_id": 1, "slave_id": 2}], "contact_manager": {},
            })),
            with(axes, &json!({"boundary_segment": 0.25}), &none),
            with(axes, &json!({"initial_stress": {"type": "isotropic", "value": -1}}), &none),
            with(
                axes,
                &json!({"initial_stress": {"type": "at_rest", "ratio": 0.5, "level": 1}}),
                &json!({"gravity": corner(axes, -10.0)}),
            ),
            layered(axes, &none),
            layered(axes, &json!({"initial_stress": {"type": "at_rest", "ratio": 0.5}})),
            with(
                axes,
                &json!({"zones": [{"point_p1": corner(axes, 0.0), "point_p2": upper(0.5), "particles_per_cell": 3}]}),
                &none,
            ),
            of_material(axes, &json!({"type": "von_mises", "yield_stress": 1e6})),
            of_material(axes, &json!({"type": "von_mises", "yield_stress": 1e6, "hardening.curve": [[0.01, 1.2e6]]})),
            of_material(axes, &json!({
                "type": "von_mises", "yield_stress": 1e6, "hardening": -100, "regularisation": "crack_band",
                "regularisation.width": 0.2,
            })),
            of_clay(axes),
            of_wet_soil(axes),
            in_standing_water(axes, &none),
            in_standing_water(axes, &json!({"side": "Xn", "between": [0.25, 0.75]})),
            of_fluid(axes, &none),
            of_fluid(axes, &json!({"type": "bingham", "yield_stress": 10})),
            of_material(axes, &json!({"type": "tresca", "cohesion": 1e6})),
            of_material(
                axes,
                &json!({
                    "type": "mu_i", "static_friction": 0.2, "largest_friction": 0.6, "grain_diameter": 1e-3,
                }),
            ),
            of_undrained_clay(axes),
            of_material(axes, &json!({"type": "drucker_prager", "friction": 30, "cohesion": 1e6})),
            of_material(axes, &json!({"type": "mohr_coulomb", "friction": 30, "cohesion": 1e6})),
            of_material(
                axes,
                &json!({
                    "type": "mohr_coulomb", "friction": 30, "cohesion": 1e6, "softening": "linear",
                    "softening.linear.to": 0.1
                }),
            ),
        ]);
    }
    let mut spelt = block(3);
    let top = spelt.as_object_mut().expect("an object");
    for (key, other) in [("material", "materials"), ("body", "bodies")] {
        let value = top.remove(key).expect("it is there");
        top.insert(other.to_owned(), value);
    }
    let outline = json!([[0, 0], [1, 0], [1, 1], [0, 1]]);
    let rolling = json!({
        "rigid_line": [{"id": 9, "points": [[2, 0.1], [0, 0.1]]}],
        "contact": [{
            "method": "mortar", "master_id": 9, "slave_id": 1, "friction": 0.3, "critical_gap": 0.02,
            "normal_stiffness": 1e5, "tangential_stiffness": 1e5
        }]
    });
    let mut mortar = shaped(
        2,
        &json!({
            "type": "disc", "center": [1, 1], "radius": 0.5, "boundary_segment": 0.1
        }),
    );
    for (key, value) in rolling.as_object().expect("keys") {
        mortar[key] = value.clone();
    }
    let mut pushed = two(
        2,
        &json!({
            "contact": [{
                "method": "mortar", "master_id": 1, "slave_id": 2, "friction": 0.3, "critical_gap": 0.02,
                "normal_stiffness": 1e5, "tangential_stiffness": 1e5
            }]
        }),
    );
    for i in [0, 1] {
        pushed["body"][i]["boundary_segment"] = json!(0.25);
    }
    let triangles = json!([[[0, 0, 0], [2, 0, 0], [0, 2, 0]]]);
    let mut solid = shaped(3, &json!({"type": "solid", "stl_mesh": "block.stl"}));
    solid["mesh"]["origin"] = json!([-1, -1, -0.5]);
    bases.extend([
        spelt,
        mortar,
        pushed,
        with(2, &json!({"boundary": outline}), &none),
        with(2, &none, &json!({"rigid_line": [{"id": 9, "points": [[1.5, 0], [1, 0.5], [0, 0]]}]})),
        with(3, &none, &json!({"rigid_surface": [{"id": 9, "stl_mesh": "floor.stl"}]})),
        with(3, &none, &json!({"rigid_surface": [{"id": 9, "triangles": triangles}]})),
        with(3, &none, &json!({"terrain_contact": {"active": true, "stl_mesh": "floor.stl"}})),
        with(3, &none, &json!({"terrain_contact": {"active": true, "triangles": triangles}})),
        with(3, &none, &json!({"earthquake": {"active": true, "file": "record.csv"}})),
        on_absorbing(&json!({"earthquake": {"active": true, "file": "record.csv", "base": "compliant"}})),
        on_absorbing(&none),
        with(3, &none, &json!({"initial_state": {"file": "checkpoint.bin"}})),
        with(3, &none, &json!({"until": {"unbalanced_force": 0.01}})),
        shaped(2, &json!({"type": "disc", "center": [1, 1], "radius": 0.5})),
        shaped(3, &json!({"type": "sphere", "center": [1, 1, 1], "radius": 0.5})),
        shaped(3, &json!({"type": "cylinder", "point_p1": [1, 1, 0], "point_p2": [1, 1, 1], "radius": 0.5})),
        shaped(2, &json!({"type": "ring", "center": [1, 1], "inner_radius": 0.25, "outer_radius": 0.5})),
        shaped(2, &json!({"type": "polygon", "points": [[0, 0], [1, 0], [1, 1]]})),
        shaped(3, &json!({
            "type": "extruded_polygon", "points": [[0, 0], [1, 0], [1, 1]], "axis": "y", "range": [0, 1]
        })),
        shaped(
            2,
            &json!({"type": "particles", "particles": [[0.5, 0.5, 0.01]]}),
        ),
        shaped(
            3,
            &json!({"type": "particles", "particles": [[0.5, 0.5, 0.5, 0.001]]}),
        ),
        shaped(3, &json!({"type": "particles", "file": "particles.csv"})),
        shaped(2, &json!({"type": "between", "lower": 0, "upper": 1})),
        shaped(3, &json!({"type": "between", "lower": 0, "upper": 1})),
        solid,
    ]);
    bases
}
