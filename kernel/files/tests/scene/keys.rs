//! Every key of ours and every other spelling, once.

use std::path::Path;

use proctor_files::json::{from_json, schema};
use proctor_laws::{LinearElastic, NeoHookean, ObjectiveRate};
use proctor_scene::{
    ContactNormal, Damping, Dimension, DomainUpdate, Field, Motion, NodalField, Outside,
    PlaneCondition, ProbeTarget, ProbedQuantity, Scene, Shape, StressScheme, TimeStep, Transfer,
    TransferKind, Weighting,
};

fn parse(text: &str) -> Scene {
    from_json(text, "keys.json", Path::new("../../fixtures/records"))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A 3D scene with more keys at its top.
fn with(keys: &str) -> Scene {
    parse(&format!(
        r#"{{{keys}
        "time": 1, "mesh": {{"cells_dimension": [0.5, 0.5, 0.5], "cells_number": [4, 4, 4]}},
        "materials": [{{"type": "elastic", "id": 3, "young": 1e6, "poisson": 0.3, "density": 1000}}],
        "bodies": [{{"type": "cuboid", "id": 9, "material_id": 3, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}}]}}"#
    ))
}

/// A 2D scene with one body.
fn flat(body: &str) -> Scene {
    parse(&format!(
        r#"{{"dimension": 2, "time": 1, "particles_per_cell": 3,
        "mesh": {{"cells_dimension": [0.5, 0.25], "cells_number": [4, 8]}},
        "material": {{"a": {{"type": "neo_hookean", "id": 0, "young": 1e6, "poisson": 0.3, "density": 1000}}}},
        "body": {{"b": {{"id": 1, "material_id": 0, {body}}}}}}}"#
    ))
}

/// The shape of the only body of a 3D scene.
fn solid(body: &str) -> Shape {
    let mut scene = parse(&format!(
        r#"{{"time": 1, "mesh": {{"cells_dimension": [1, 1, 1], "cells_number": [4, 4, 4]}},
        "material": [{{"type": "elastic", "id": 0, "young": 1, "poisson": 0, "density": 1}}],
        "body": [{{"id": 1, "material_id": 0, {body}}}]}}"#
    ));
    scene.bodies.remove(0).shape
}

#[test]
fn silence_gives_the_defaults() {
    let scene = with("");
    let new = Scene::new(Dimension::Three, scene.mesh.clone(), 1.0);
    assert_eq!(scene.time_step, TimeStep::Automatic);
    assert_eq!(scene.weighting, new.weighting);
    assert_eq!(scene.scheme, new.scheme);
    assert_eq!(scene.transfer, new.transfer);
    assert_eq!(scene.damping, Damping::None);
    assert_eq!(scene.outside, Outside::Stop);
    assert_eq!(scene.results, new.results);
    assert_eq!(scene.mesh.origin, [0.0; 3]);
    assert_eq!(scene.bodies[0].particles_per_cell, [2; 3]);
    assert_eq!(scene.bodies[0].name, "bodies[0]");
}

#[test]
fn method_words() {
    for (word, weighting) in [
        ("linear", Weighting::Linear),
        ("Linear", Weighting::Linear),
        ("GIMP", Weighting::UniformGimp),
        ("ugimp", Weighting::UniformGimp),
        (
            "cpGIMP",
            Weighting::ContiguousGimp(DomainUpdate::Determinant),
        ),
        ("quadratic_bspline", Weighting::QuadraticBSpline),
    ] {
        let scene = with(&format!(r#""shape_function": "{word}","#));
        assert_eq!(scene.weighting, weighting, "{word}");
    }
    let scene = with(r#""shape_function": "cpGIMP", "domain_update": "stretch","#);
    assert_eq!(
        scene.weighting,
        Weighting::ContiguousGimp(DomainUpdate::Stretch)
    );
    for (word, scheme) in [
        ("USF", StressScheme::Usf),
        ("USL", StressScheme::Usl),
        ("MUSL", StressScheme::Musl),
    ] {
        let scene = with(&format!(r#""stress_scheme_update": "{word}","#));
        assert_eq!(scene.scheme, scheme);
    }
    for (word, kind, pic_fraction) in [
        ("FLIP", TransferKind::Flip, 0.0),
        ("APIC", TransferKind::Apic, 1.0),
        ("TPIC", TransferKind::Tpic, 1.0),
        ("MLS", TransferKind::Mls, 1.0),
    ] {
        let method = format!(r#""shape_function": "quadratic_bspline", "transfer": "{word}","#);
        let scene = with(&method);
        assert_eq!(scene.transfer, Transfer { kind, pic_fraction });
    }
    assert_eq!(with(r#""pic_fraction": 0.01,"#).transfer.pic_fraction, 0.01);
}

#[test]
fn time_steps_and_damping() {
    assert_eq!(
        with(r#""time_step": 1e-3, "allow_unstable": true,"#).time_step,
        TimeStep::Fixed {
            dt: 1e-3,
            allow_unstable: true
        }
    );
    for key in ["critical_time_step_multiplier", "time_step_multiplier"] {
        assert_eq!(
            with(&format!(r#""{key}": 0.5,"#)).time_step,
            TimeStep::Multiplier {
                multiplier: 0.5,
                allow_unstable: false
            }
        );
    }
    for (text, damping) in [
        (r#"{"type": "none"}"#, Damping::None),
        (
            r#"{"type": "local", "value": 0.1}"#,
            Damping::Local { alpha: 0.1 },
        ),
        (
            r#"{"type": "local", "alpha": 0.1}"#,
            Damping::Local { alpha: 0.1 },
        ),
        (r#"{"type": "kinetic"}"#, Damping::Kinetic),
        (
            r#"{"type": "viscous", "alpha": 2}"#,
            Damping::Viscous { alpha: 2.0 },
        ),
    ] {
        assert_eq!(with(&format!(r#""damping": {text},"#)).damping, damping);
    }
}

#[test]
fn probes_follow_points_lines_and_bodies() {
    let scene = with(
        r#""results": {"history_interval": 0.005, "print": 0}, "probes": [
        {"name": "top", "point": [0.5, 0.5, 1]},
        {"name": "axis", "line": [[0, 0, 0], [0, 0, 1]]}, {"name": "edge", "line": [[0, 0, 0], [1, 0, 0]], "count": 3},
        {"name": "block", "body": 9}, {"name": "worst", "body": 9, "largest": "mises_stress"}],"#,
    );
    assert_eq!(scene.results.history_interval, Some(0.005));
    let axis = &scene.probes[1];
    assert_eq!(axis.points().len(), 11);
    assert_eq!(axis.points()[10], ("axis_11".to_owned(), [0.0, 0.0, 1.0]));
    let edge: Vec<f64> = scene.probes[2].points().iter().map(|(_, x)| x[0]).collect();
    assert_eq!(edge, [0.0, 0.5, 1.0]);
    assert_eq!(scene.probes[3].target, ProbeTarget::Body(9));
    assert_eq!(
        scene.probes[4].target,
        ProbeTarget::Largest {
            body: 9,
            quantity: ProbedQuantity::MisesStress
        }
    );
}

#[test]
fn loads_results_and_probes() {
    let scene = with(
        r#""gravity": [0, 0, -9.81], "outside": "remove", "n_threads": 3, "n_phases": 1,
        "traction": [{"point_p1": [0, 0, 1], "point_p2": [1, 0.5, 1], "traction": [0, 0, -5]}],
        "box_load": [{"point_p1": [0, 0, 0], "point_p2": [1, 1, 0.5], "force": [1, 0, 0]}],
        "results": {"print": 0, "fields": ["all", "id"], "checkpoint": false},
        "probes": [{"name": "top", "point": [0.5, 0.5, 1]}],
        "earthquake": {"active": true, "file": "comma_header.csv", "quantity": "velocity", "plane": "Xn"},"#,
    );
    assert_eq!(scene.gravity, [0.0, 0.0, -9.81]);
    assert_eq!(scene.outside, Outside::Remove);
    assert_eq!(scene.threads, Some(3));
    assert_eq!(scene.tractions[0].p2, [1.0, 0.5, 1.0]);
    assert_eq!(
        scene.tractions[0].traction.constant(),
        Some([0.0, 0.0, -5.0])
    );
    assert_eq!(scene.box_loads[0].force, [1.0, 0.0, 0.0]);
    assert_eq!(scene.results.print, 0);
    assert_eq!(scene.results.fields, Field::ALL);
    assert!(!scene.results.checkpoint);
    assert_eq!(scene.probes[0].name, "top");
    let base = scene.base_motion.expect("a base motion");
    assert_eq!((base.axis, base.side), (0, 1));
    let Motion::Velocity(history) = base.motion else {
        panic!("a velocity was asked for");
    };
    assert_eq!(history.times, [0.0, 0.5]);
    assert_eq!(history.values, [[1.0, 2.0, 3.0], [-1e-3, 0.0, 0.25]]);
    let held = with(r#""held_box": [{"point_p1": [0, 0, 0], "point_p2": [0.5, 0, 0]}],"#);
    assert_eq!(held.held_boxes[0].p2, [0.5, 0.0, 0.0]);
    let wave = |motion: &str| {
        let scene = parse(&format!(
            r#"{{"earthquake": {{
                "active": true, "file": "comma_header.csv", "plane": "Xn", "base": "compliant"{motion}
            }},
            "absorbing_springs": 12.5, "time": 1, "mesh": {{
                "cells_dimension": [0.5, 0.5, 0.5], "cells_number": [4, 4, 4],
                "boundary_conditions": {{"plane_Xn": "absorbing"}}
            }},
            "materials": [{{"type": "elastic", "id": 3, "young": 1e6, "poisson": 0.3, "density": 1000}}],
            "bodies": [{{"type": "cuboid", "id": 9, "material_id": 3, "point_p1": [0, 0, 0], "point_p2": [2, 1, 1]}}]}}"#
        ));
        assert_eq!(scene.mesh.planes[0][1], PlaneCondition::Absorbing);
        assert!(scene.base_motion.is_none());
        assert_eq!(scene.ground_beyond.thickness, Some(12.5));
        let wave = scene.ground_beyond.incoming.expect("a wave");
        assert_eq!((wave.axis, wave.side), (0, 1));
        let Motion::Acceleration(history) = wave.motion else {
            panic!("an acceleration is the default");
        };
        history.values[0]
    };
    // Half of the motion of an outcrop comes in.
    assert_eq!(wave(""), [0.5, 1.0, 1.5]);
    assert_eq!(wave(r#", "motion": "incoming""#), [1.0, 2.0, 3.0]);
    // What is switched off is not read.
    let off = with(r#""earthquake": {"active": false, "file": "nowhere.csv"},"#);
    assert!(off.base_motion.is_none());
    let no_contact = with(
        r#""contact": [{"friction": 1, "master_id": 1, "slave_id": 2}], "contact_manager": {"active": false},
        "terrain_contact": {"active": false},"#,
    );
    assert!(no_contact.contacts.is_empty());
}

/// Contacts as a list or by name; ids are any integers, and what is not given has its default.
#[test]
fn contacts_and_their_defaults() {
    let text = |contact: &str| {
        format!(
            r#"{{"dimension": 2, "time": 1, "mesh": {{"cells_dimension": [1, 1], "cells_number": [4, 4]}},
            "material": [{{"type": "elastic", "id": 0, "young": 1, "poisson": 0, "density": 1}}],
            "results": {{"grid_nodal_results": ["contact_gap", "mass", "mass"]}},
            "body": [{{"type": "cuboid", "id": -3, "material_id": 0, "point_p1": [0, 0], "point_p2": [1, 1]}},
                     {{"type": "cuboid", "id": 40, "material_id": 0, "point_p1": [1, 0], "point_p2": [2, 1]}}],
            "contact": {contact}}}"#
        )
    };
    let entry = r#"{"friction": 0.25, "master_id": 40, "slave_id": -3, "method": "grid"}"#;
    for contact in [format!("[{entry}]"), format!(r#"{{"sides": {entry}}}"#)] {
        let scene = parse(&text(&contact));
        let [contact] = scene.contacts.as_slice() else {
            panic!("one contact")
        };
        assert_eq!((contact.id, contact.master, contact.slave), (1, 40, -3));
        assert_eq!(contact.friction, 0.25);
        assert_eq!(contact.normal, ContactNormal::Collinear);
        assert_eq!(scene.contact_distance, None);
        assert_eq!(
            scene.results.nodal_fields,
            [NodalField::ContactGap, NodalField::Mass]
        );
    }
}

#[test]
fn two_dimensions() {
    let scene = flat(
        r#""type": "rectangle", "point_p1": [0, 0], "point_p2": [1, 1], "initial_velocity": [1, 2],
        "particles_per_cell": [2, 4], "prescribed_velocity": [[0, 1, 0], [0.5, 2, 0]]"#,
    );
    assert_eq!(scene.dimension, Dimension::Two);
    assert_eq!(scene.mesh.cell, [0.5, 0.25, 1.0]);
    assert_eq!(scene.mesh.cells, [4, 8, 1]);
    assert_eq!(scene.mesh.planes[2], [PlaneCondition::Free; 2]);
    assert_eq!(scene.mesh.planes[1], [PlaneCondition::Sliding; 2]);
    let body = &scene.bodies[0];
    assert_eq!(body.velocity, [1.0, 2.0, 0.0]);
    assert_eq!(body.particles_per_cell, [2, 4, 1]);
    let motion = body.motion.as_ref().expect("a motion");
    assert_eq!(motion.times, [0.0, 0.5]);
    assert_eq!(motion.values, [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    assert_eq!(scene.materials[0].law, NeoHookean::new(1e6, 0.3).into());
    let disc = flat(r#""type": "disc", "center": [1, 1], "radius": 0.5"#);
    assert_eq!(disc.bodies[0].particles_per_cell, [3, 3, 1]);
    assert_eq!(
        disc.bodies[0].shape,
        Shape::Sphere {
            center: [1.0, 1.0, 0.0],
            radius: 0.5
        }
    );
    let ring = flat(r#""type": "ring", "center": [1, 1], "inner_radius": 0.5, "outer_radius": 1"#);
    assert_eq!(
        ring.bodies[0].shape,
        Shape::Ring {
            center: [1.0, 1.0, 0.0],
            inner: 0.5,
            outer: 1.0
        }
    );
    let polygon = flat(r#""type": "polygon", "points": [[0, 0], [1, 0], [0.5, 2]]"#);
    assert_eq!(
        polygon.bodies[0].shape,
        Shape::Polygon {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.5, 2.0, 0.0]]
        }
    );
    let constant = flat(
        r#""type": "cuboid", "point_p1": [0, 0], "point_p2": [1, 1], "prescribed_velocity": [3, -1]"#,
    );
    let motion = constant.bodies[0].motion.as_ref().expect("a motion");
    assert_eq!(
        (motion.times.as_slice(), motion.values.as_slice()),
        (&[0.0][..], &[[3.0, -1.0, 0.0]][..])
    );
}

#[test]
fn solids() {
    assert_eq!(
        solid(r#""type": "sphere", "center": [2, 2, 2], "radius": 2"#),
        Shape::Sphere {
            center: [2.0; 3],
            radius: 2.0
        }
    );
    assert_eq!(
        solid(r#""type": "cylinder", "point_p1": [2, 2, 0], "point_p2": [2, 2, 4], "radius": 2"#),
        Shape::Cylinder {
            p1: [2.0, 2.0, 0.0],
            p2: [2.0, 2.0, 4.0],
            radius: 2.0
        }
    );
    assert_eq!(
        solid(
            r#""type": "extruded_polygon", "points": [[0, 0], [4, 0], [0, 3]], "axis": "y", "range": [1, 4]"#
        ),
        Shape::ExtrudedPolygon {
            points: vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]],
            axis: 1,
            range: [1.0, 4.0]
        }
    );
    for text in [
        r#""type": "particles", "particles": [[0.25, 0.25, 0.25, 0.125], [0.75, 0.25, 0.25, 0.125]]"#,
        r#""type": "particles", "file": "particles.csv""#,
    ] {
        let Shape::Particles(seeds) = solid(text) else {
            panic!("particles were given");
        };
        assert_eq!(seeds.len(), 2);
        assert_eq!(seeds[1].position, [0.75, 0.25, 0.25]);
        assert_eq!(seeds[1].volume, 0.125);
    }
}

#[test]
fn objective_rates() {
    for (word, rate) in [
        ("hughes_winget", ObjectiveRate::HughesWinget),
        ("jaumann", ObjectiveRate::JaumannForward),
    ] {
        let scene = parse(&format!(
            r#"{{"time": 1, "mesh": {{"cells_dimension": [1, 1, 1], "cells_number": [1, 1, 1]}},
            "material": [{{"type": "elastic", "id": 0, "young": 1, "poisson": 0, "density": 1, "objective_rate": "{word}"}}],
            "body": [{{"type": "cuboid", "id": 1, "material_id": 0, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}}]}}"#
        ));
        let law = scene.materials[0].law.downcast::<LinearElastic>();
        assert_eq!(law.expect("elastic was asked for").rate(), rate);
    }
}

/// The edges of a body may miss those of the mesh by round-off: 3 cells of 0.1 end at 0.30000000000000004.
#[test]
fn round_off_at_the_edge_of_the_mesh_is_no_problem() {
    for origin in [0.0, 1e6] {
        let end = origin + 0.3;
        let scene = parse(&format!(
            r#"{{"dimension": 2, "time": 1,
            "mesh": {{"cells_dimension": [0.1, 0.1], "cells_number": [3, 3], "origin": [{origin:?}, 0]}},
            "material": [{{"type": "elastic", "id": 0, "young": 1, "poisson": 0, "density": 1}}],
            "body": [{{"type": "cuboid", "id": 1, "material_id": 0, "point_p1": [{origin:?}, 0], "point_p2": [{end:?}, 0.30000000000000004]}}],
            "nodal_point_load": [[[{end:?}, 0.3], [0, 1]]]}}"#
        ));
        assert_eq!(scene.point_loads.len(), 1);
    }
}

#[test]
fn the_schema_knows_every_key_and_both_forms_of_a_list() {
    let schema = schema();
    let keys = schema["properties"].as_object().expect("properties");
    for key in [
        "time_step_multiplier",
        "materials",
        "body",
        "box_load",
        "terrain_contact",
    ] {
        assert!(keys.contains_key(key), "{key}");
    }
    assert_eq!(schema["additionalProperties"], false);
    let entries = &schema["$defs"]["EntriesOfRawBody"]["anyOf"];
    assert_eq!(entries[0]["type"], "array");
    assert_eq!(entries[1]["type"], "object");
    assert_eq!(
        schema["$defs"]["RawPlanes"]["properties"]["plane_X0"]["enum"],
        serde_json::json!(["free", "sliding", "fixed", "antisymmetric", "absorbing"])
    );
}
