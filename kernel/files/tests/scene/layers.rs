//! Layers and boxes of a body, and the stress of ground at rest below a surface.

use std::path::Path;

use proctor_files::json::from_json;
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Scene, SceneError};

const DENSITIES: [f64; 3] = [1600.0, 1900.0, 2200.0];

/// Ground of three materials in a mesh of 10 m x 6 m, in three dimensions 2 m thick.
fn read(axes: usize, body: &str, more: &str) -> Result<Scene, SceneError> {
    let (cells, counts, gravity) = if axes == 2 {
        ("[0.5, 0.5]", "[20, 12]", "[0, -10]")
    } else {
        ("[0.5, 0.5, 0.5]", "[20, 4, 12]", "[0, 0, -10]")
    };
    let materials: Vec<String> = (DENSITIES.iter().zip(1..))
        .map(|(density, id)| {
            format!(r#"{{"type": "elastic", "id": {id}, "young": 1e7, "poisson": 0.3, "density": {density}}}"#)
        })
        .collect();
    let text = format!(
        r#"{{"dimension": {axes}, "time": 0.1, "gravity": {gravity}, "mesh": {{"cells_dimension": {cells}, "cells_number": {counts}}},
        "material": [{}], {more} "body": [{{"id": 7, {body}}}]}}"#,
        materials.join(", ")
    );
    from_json(&text, "ground.json", Path::new(""))
}

fn refused(body: &str, more: &str) -> String {
    read(2, body, more).expect_err("a fault").to_string()
}

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene, &Options::default()).expect("a sound scene")
}

/// Volumes of the particles by material.
fn volumes(scene: &Scene) -> [f64; 3] {
    let simulation = simulation(scene);
    let mut all = [0.0; 3];
    for (body, set) in scene.bodies.iter().zip(simulation.sets()) {
        all[body.material] += set.columns[Layout::VOLUME].iter().sum::<f64>();
    }
    all
}

/// Volumes of layers are those of their sub-cells, 0.25 m high; that of the body is exact where all have one size.
fn close(found: [f64; 3], exact: [f64; 3], off: f64) {
    for (found, exact) in found.iter().zip(exact) {
        assert!((found - exact).abs() < 0.5, "{found} {exact}");
    }
    let [found, exact] = [found, exact].map(|all| all.iter().sum::<f64>());
    assert!((found / exact - 1.0).abs() < off, "{found} {exact}");
}

/// A slope from 5 m to 2 m; the first base leaves the ground on its face.
const SLOPE: &str = r#""type": "between", "lower": 0, "upper": [[0, 5], [4, 5], [7, 2], [10, 2]],
    "layers": [{"material_id": 1, "base": 4}, {"material_id": 2, "base": [[0, 2], [10, 1]]}, {"material_id": 3}]"#;

#[test]
fn volumes_of_layers_are_those_of_their_polygons() {
    let scene = read(2, SLOPE, "").expect("a slope");
    let (whole, lowest) = (20.0 + 10.5 + 6.0, 15.0);
    let top = 4.0 + 0.5;
    close(volumes(&scene), [top, whole - top - lowest, lowest], 1e-13);
    let names: Vec<_> = scene
        .bodies
        .iter()
        .map(|body| (body.name.as_str(), body.id))
        .collect();
    assert_eq!(
        names,
        [
            ("body[0].layers[0]", 7),
            ("body[0].layers[1]", 8),
            ("body[0].layers[2]", 9)
        ]
    );
}

#[test]
fn boxes_take_their_part_of_every_layer() {
    let zones = r#", "zones": [
        {"point_p1": [1, 3], "point_p2": [3, 4.5], "material_id": 3, "id": 20},
        {"point_p1": [0, 0], "point_p2": [10, 1], "particles_per_cell": 3}]"#;
    let scene = read(2, &format!("{SLOPE}{zones}"), "").expect("a slope");
    close(volumes(&scene), [4.5 - 1.0, 17.0 - 2.0, 15.0 + 3.0], 1e-3);
    let fine: Vec<_> = (scene.bodies.iter())
        .filter(|body| body.particles_per_cell == [3, 3, 1])
        .map(|body| body.name.as_str())
        .collect();
    assert_eq!(fine, ["body[0].zones[1] of layers[2]"]);
    let of_zone = scene
        .bodies
        .iter()
        .find(|body| body.id == 20)
        .expect("the box");
    assert_eq!(of_zone.material, 2);
    let block = r#""type": "cuboid", "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [10, 2, 3],
        "zones": [{"point_p1": [2, 0, 1], "point_p2": [4, 1, 3], "material_id": 2}]"#;
    close(
        volumes(&read(3, block, "").expect("a block")),
        [60.0 - 4.0, 4.0, 0.0],
        1e-13,
    );
}

/// The stress of each particle is the weight of the layers above it, to the bit but for round-off, and nothing moves.
#[test]
fn level_layers_start_at_rest() {
    let layers = r#""layers": [{"material_id": 1, "base": 4}, {"material_id": 2, "base": 2, "ratio": 0.7}, {"material_id": 3}],
        "initial_stress": {"type": "at_rest", "ratio": 0.5, "surcharge": 0}"#;
    for (axes, body) in [
        (2, r#""type": "between", "lower": 0, "upper": 5"#),
        (
            2,
            r#""type": "rectangle", "point_p1": [0, 0], "point_p2": [10, 5]"#,
        ),
        (3, r#""type": "between", "lower": 0, "upper": 5"#),
    ] {
        let scene = read(axes, &format!("{body}, {layers}"), "").expect("level ground");
        let mut simulation = simulation(&scene);
        for (body, set) in scene.bodies.iter().zip(simulation.sets()) {
            let stress = Layout::stress(axes);
            for p in 0..set.len() {
                let z = set.position(p)[axes - 1];
                let weight: f64 = (DENSITIES.iter())
                    .zip([[4.0, 5.0], [2.0, 4.0], [0.0, 2.0]])
                    .map(|(density, [low, high]): (&f64, [f64; 2])| {
                        10.0 * density * (high - z.max(low)).max(0.0)
                    })
                    .sum();
                let along = set.columns[stress + axes - 1][p];
                assert!((along + weight).abs() < 1e-10 * weight, "{along} {weight}");
                let ratio = if body.material == 1 { 0.7 } else { 0.5 };
                assert!((set.columns[stress][p] - ratio * along).abs() < 1e-10 * weight);
            }
        }
        for _ in 0..50 {
            simulation.step(f64::INFINITY).expect("a step");
        }
        let fastest = (simulation.sets().iter())
            .flat_map(|set| &set.columns[Layout::velocity(axes) + axes - 1])
            .fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(fastest < 1e-9, "{axes}: {fastest} m/s");
    }
}

/// Below a level above the ground the first layer counts up to that level; the weight under a slope is that of the column.
#[test]
fn stress_below_a_surface_is_the_weight_of_the_column() {
    let at = |level: &str, x: f64, y: f64| {
        let stress = format!(
            r#", "initial_stress": {{"type": "at_rest", "ratio": 0.5, "surcharge": 100 {level}}}"#
        );
        let scene = read(2, &format!("{SLOPE}{stress}"), "").expect("a slope");
        let body = &scene.bodies[2];
        body.initial_stress
            .at(&[x, y, 0.0], &scene.gravity, 2200.0, 2)
    };
    let [gamma_1, gamma_2, gamma_3] = DENSITIES.map(|density| 10.0 * density);
    let below_crest = -100.0 - gamma_1 - gamma_2 * 2.2 - gamma_3 * 0.8;
    assert!((at("", 2.0, 1.0)[1] - below_crest).abs() < 1e-9 * gamma_1);
    assert!((at("", 2.0, 1.0)[0] - 0.5 * below_crest).abs() < 1e-9 * gamma_1);
    let below_toe = -100.0 - gamma_2 * 0.8 - gamma_3 * 0.2;
    assert!((at("", 8.0, 1.0)[1] - below_toe).abs() < 1e-9 * gamma_1);
    let higher = at(r#", "level": [[0, 6], [10, 6]]"#, 8.0, 1.0)[1];
    assert!((higher - below_toe + gamma_1 * 2.0 + gamma_2 * 2.0).abs() < 1e-9 * gamma_1);
    assert_eq!(at("", 8.0, 3.0), [0.0; 6]);
    let polygon = r#""type": "polygon", "material_id": 2, "points": [[0, 0], [10, 0], [10, 2], [0, 4]],
        "initial_stress": {"type": "at_rest", "ratio": 0.5, "level": [[0, 4], [10, 2]]}"#;
    let scene = read(2, polygon, "").expect("a polygon");
    let stress = scene.bodies[0]
        .initial_stress
        .at(&[5.0, 1.0, 0.0], &scene.gravity, 1900.0, 2);
    assert!((stress[1] + 2.0 * gamma_2).abs() < 1e-9 * gamma_2);
}

#[test]
fn each_fault_is_told_with_its_place() {
    let slope = |layers: &str| {
        format!(r#""type": "between", "lower": 0, "upper": [[0, 5], [10, 2]], "layers": {layers}"#)
    };
    for (layers, words) in [
        ("[]", "body[0].layers: found an empty list"),
        (
            r#"[{"material_id": 1}, {"material_id": 2}]"#,
            "body[0].layers[0].base: found nothing",
        ),
        (
            r#"[{"material_id": 1, "base": 1}]"#,
            "body[0].layers[0].base: found the base of the last layer",
        ),
        (
            r#"[{"material_id": 1, "base": 6}, {"material_id": 2}]"#,
            "body[0].layers[0]: found a layer that lies nowhere in the body",
        ),
        (
            r#"[{"material_id": 1, "base": [[0, 1], [10, 2]]}, {"material_id": 2, "base": 1.5}, {"material_id": 3}]"#,
            "body[0].layers[1].base: found 1.5 m at x = 0, above the base of the layer before with 1 m",
        ),
        (
            r#"[{"material_id": 1, "base": [[0, 1], [9, 2]]}, {"material_id": 2}]"#,
            "no height at x = 9",
        ),
        (
            r#"[{"material_id": 4, "base": 1}, {"material_id": 2}]"#,
            "layers[0].material_id: found 4, which no material has",
        ),
        (
            r#"[{"material_id": 1, "base": 1, "ratio": 0.5}, {"material_id": 2}]"#,
            "`ratio` without `initial_stress`",
        ),
    ] {
        let text = refused(&slope(layers), "");
        assert!(text.contains(words), "{words}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
    }
    let contact = r#""contact": [{"master_id": 7, "slave_id": 8, "friction": 0.3}],"#;
    let text = refused(SLOPE, contact);
    assert!(
        text.contains("contact[0].master_id: found a body with layers or zones"),
        "{text}"
    );
    let text = refused(&format!("{SLOPE}, \"material_id\": 1"), "");
    assert!(
        text.contains("`material_id` and `layers` together"),
        "{text}"
    );
    let text = refused(
        r#""type": "disc", "material_id": 1, "center": [5, 3], "radius": 1, "layers": [{"material_id": 1}]"#,
        "",
    );
    assert!(
        text.contains("`layers` in a body of the type \"disc\""),
        "{text}"
    );
    let outside = r#", "zones": [{"point_p1": [8, 3], "point_p2": [9, 4], "material_id": 1}]"#;
    let text = refused(&format!("{SLOPE}{outside}"), "");
    assert!(
        text.contains("body[0].zones[0]: found a box in which nothing of the body lies"),
        "{text}"
    );
}

#[test]
fn a_plan_tells_of_ground_in_the_place_of_another_body() {
    let two = r#""type": "between", "material_id": 1, "lower": 0, "upper": [[0, 5], [10, 2]]},
        {"type": "rectangle", "id": 8, "material_id": 2, "point_p1": [8, 2], "point_p2": [10, 3]"#;
    let scene = read(2, two, "").expect("two bodies");
    let plan = simulation(&scene).plan().warnings.join("\n");
    assert!(
        plan.contains("body[0] and body[1] overlap by 0.6 m³"),
        "{plan}"
    );
    let apart = two
        .replace("[8, 2]", "[8, 3]")
        .replace("[10, 3]", "[10, 4]");
    let plan = simulation(&read(2, &apart, "").expect("two bodies"))
        .plan()
        .warnings
        .join("\n");
    assert!(!plan.contains("overlap"), "{plan}");
}
