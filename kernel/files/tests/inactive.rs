//! Keys of a scene file that are switched off, or zero: as if they were not there, bit by bit.

use crate::common::{options, run};
use proctor_files::json::from_json;
use proctor_scene::Scene;
use proctor_scene::plan::{Plan, PlanEntry};
use proctor_scene::simulation::Simulation;
use std::path::Path;

/// A key with what is off and what is on, its entry in the plan, and whether what is on changes this scene.
struct Switch {
    key: &'static str,
    off: &'static str,
    on: &'static str,
    entry: &'static str,
    acts: bool,
}

const SWITCHES: [Switch; 8] = [
    Switch {
        key: "earthquake",
        off: r#"{"active": false, "file": "comma_header.csv", "quantity": "velocity", "plane": "X0"}"#,
        on: r#"{"active": true, "file": "comma_header.csv", "quantity": "velocity", "plane": "X0"}"#,
        entry: "base motion",
        acts: true,
    },
    Switch {
        key: "contact",
        off: "false",
        on: r#"[{"id": 1, "friction": 0.3, "master_id": 1, "slave_id": 2}]"#,
        entry: "contact 1",
        acts: true,
    },
    Switch {
        key: "terrain_contact",
        off: r#"{"active": false, "stl_mesh": "../surfaces/plane.stl"}"#,
        on: r#"{"active": true, "stl_mesh": "../surfaces/plane.stl"}"#,
        entry: "contact with rigid surfaces",
        acts: false,
    },
    Switch {
        key: "damping",
        off: r#"{"type": "local", "value": 0}"#,
        on: r#"{"type": "local", "value": 0.1}"#,
        entry: "local damping",
        acts: true,
    },
    Switch {
        key: "damping",
        off: r#"{"type": "viscous", "value": 0}"#,
        on: r#"{"type": "viscous", "value": 0.1}"#,
        entry: "viscous damping",
        acts: true,
    },
    Switch {
        key: "damping",
        off: r#"{"type": "none"}"#,
        on: r#"{"type": "kinetic"}"#,
        entry: "kinetic damping",
        acts: true,
    },
    Switch {
        key: "gravity",
        off: "[0, 0, 0]",
        on: "[0, 0, -10]",
        entry: "gravity",
        acts: true,
    },
    Switch {
        key: "pic_fraction",
        off: "0",
        on: "0.1",
        entry: "PIC blend",
        acts: true,
    },
];

/// Two blocks that fly at each other in a mesh that is free all around, with further keys.
fn scene(keys: &str) -> Scene {
    let text = format!(
        r#"{{
        "dimension": 3, "time": 1.0, "results": {{"print": 0}},
        "mesh": {{
            "cells_dimension": [0.1, 0.1, 0.1], "cells_number": [14, 8, 8],
            "boundary_conditions": {{
                "plane_X0": "free", "plane_Xn": "free", "plane_Y0": "free",
                "plane_Yn": "free", "plane_Z0": "free", "plane_Zn": "free"
            }}
        }},
        "material": [{{"type": "elastic", "id": 1, "young": 1e6, "density": 1000, "poisson": 0.3}}],
        "body": [
            {{"type": "cuboid", "id": 1, "material_id": 1, "initial_velocity": [1, 0.5, 0],
              "point_p1": [0.2, 0.2, 0.2], "point_p2": [0.6, 0.5, 0.5]}},
            {{"type": "cuboid", "id": 2, "material_id": 1, "initial_velocity": [-1, 0, 0],
              "point_p1": [0.61, 0.25, 0.25], "point_p2": [1.0, 0.55, 0.5]}}
        ]{keys}
    }}"#
    );
    from_json(&text, "scene.json", Path::new("../../fixtures/records"))
        .unwrap_or_else(|e| panic!("{keys}: {e}"))
}

fn entry<'a>(plan: &'a Plan, name: &str) -> &'a PlanEntry {
    plan.entries
        .iter()
        .find(|e| e.name == name)
        .unwrap_or_else(|| panic!("no entry {name}"))
}

fn after(scene: &Scene) -> Simulation {
    let mut simulation = Simulation::new(scene, &options()).expect("the scene is sound");
    run(&mut simulation, 25);
    simulation
}

#[test]
fn keys_that_are_off_change_no_bit() {
    let without = after(&scene(""));
    for Switch {
        key,
        off,
        on,
        entry: name,
        acts,
    } in SWITCHES
    {
        let given = |value: &str| after(&scene(&format!(r#", "{key}": {value}"#)));
        let idle = given(off);
        assert_eq!(idle.plan(), without.plan(), "{key}: {off}");
        assert_eq!(idle.state_hash(), without.state_hash(), "{key}: {off}");
        // The same key switched on is one: the plan keeps it, and it acts.
        let acting = given(on);
        assert!(entry(acting.plan(), name).kept, "{key}: {on}");
        let mut entries = idle.plan().entries.iter();
        assert!(!entries.any(|e| e.name == name && e.kept), "{key}: {off}");
        assert_eq!(
            acts,
            acting.state_hash() != without.state_hash(),
            "{key}: {on}"
        );
    }
}

/// The switch of all contacts takes away pairs that are given.
#[test]
fn a_contact_manager_that_is_off_leaves_out_the_pairs() {
    let pair = r#", "contact": [{"id": 1, "friction": 0.3, "master_id": 1, "slave_id": 2}]"#;
    let run = |active: bool| {
        let manager = format!(r#", "contact_manager": {{"active": {active}}}"#);
        after(&scene(&format!("{pair}{manager}")))
    };
    let (off, without) = (run(false), after(&scene("")));
    assert_eq!(off.plan(), without.plan());
    assert_eq!(off.state_hash(), without.state_hash());
    assert_ne!(run(true).state_hash(), without.state_hash());
}
