//! Mortar contact in a scene file: its keys, and bad input by name.

use proctor_contact::geometry::mortar::boundary::BoundarySide;
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_files::json::from_json;
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Contact, ContactNormal, Enforcement, Scene, SceneError, Vertices};
use std::path::Path;

const FILE: &str = "../../fixtures/scenes/rolling_disc_2d.json";

/// The fixture with one piece of its text replaced.
fn changed(from: &str, to: &str) -> Result<Scene, SceneError> {
    let text = std::fs::read_to_string(FILE).expect("the fixture is there");
    assert!(text.contains(from), "{from}");
    from_json(&text.replacen(from, to, 1), "rolling.json", Path::new(""))
}

fn message(from: &str, to: &str) -> String {
    changed(from, to).expect_err("is bad input").to_string()
}

#[test]
fn every_key_is_understood() {
    let scene = changed(
        r#""boundary_segment": 0.05"#,
        r#""boundary": [[-0.5, 0.5], [0, 0.01], [0.5, 0.5], [0, 1]], "boundary_follows": "gradient""#,
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let boundary = &scene.mortar.boundaries[0];
    assert!(matches!(&boundary.vertices, Vertices::Given(chains) if chains[0].points.len() == 4));
    assert_eq!((boundary.body, boundary.follow), (1, FollowMode::Gradient));
    let scene = changed(
        r#""friction": 0.3"#,
        r#""friction": 0, "enforcement": "penalty", "detection": "node_to_segment""#,
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let contact = &scene.mortar.contacts[0];
    assert_eq!(contact.name, "contact.disc on plane");
    assert_eq!((contact.master, contact.slave), (2, 1));
    assert_eq!(contact.enforcement, Enforcement::Penalty);
    assert_eq!(contact.detection, Detection::NodeToSegment);
    assert_eq!(contact.critical_gap, 0.04);
    assert_eq!(scene.mortar.lines[0].chains[0].points.len(), 5);
    assert!(scene.contacts.is_empty());
}

#[test]
fn a_boundary_may_be_open() {
    let open = r#""boundary_closed": false, "boundary": [[-0.5, 0.5], [0, 0.01], [0.5, 0.5]]"#;
    let scene = changed(r#""boundary_segment": 0.05"#, open).unwrap_or_else(|e| panic!("{e}"));
    let Vertices::Given(chains) = &scene.mortar.boundaries[0].vertices else {
        panic!("{:?}", scene.mortar.boundaries);
    };
    assert_eq!(chains[0].side, BoundarySide::Open);
    // It runs: what has no vertices touches nothing.
    let mut simulation = Simulation::new(&scene, &Options::default()).expect("sound");
    simulation.step(1.0).expect("runs");
}

/// Without the key the spring is so stiff that this disc, of 250 kPa and a radius of 0.5 m, lags behind its way by half a
/// percent at most; with a softer one the plan says by how much.
#[test]
fn the_tangential_spring_is_stiff_enough_by_default() {
    let given = r#""normal_stiffness": 1e4,
      "tangential_stiffness": 1e6"#;
    let scene = changed(given, r#""normal_stiffness": 1e4"#).unwrap_or_else(|e| panic!("{e}"));
    let contact = &scene.mortar.contacts[0];
    let usual = std::f64::consts::PI / 6.0 * 0.3 * 2.5e5 / 0.5 / 5e-3;
    assert!((contact.tangential_stiffness / usual - 1.0).abs() < 1e-14);
    let warnings = |scene: &Scene| -> Vec<String> {
        let all = proctor_scene::simulation::plan(scene, PlanOptions::default()).warnings;
        all.into_iter()
            .filter(|w| w.contains("lag behind"))
            .collect()
    };
    assert_eq!(warnings(&scene), Vec::<String>::new());
    // 15.7 MPa/m are needed for 0.5 %: 1 MPa/m gives 7.85 %.
    let soft = changed(given, given).unwrap_or_else(|e| panic!("{e}"));
    let said = warnings(&soft).join("");
    assert!(
        said.contains("up to 7.85 %") && said.contains("1.571e7 Pa/m"),
        "{said}"
    );
    // Without friction there is no spring.
    let smooth =
        changed(r#""friction": 0.3"#, r#""friction": 0"#).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(warnings(&smooth), Vec::<String>::new());
}

#[test]
fn bad_input_is_named() {
    for (from, to, expected) in [
        (
            r#""critical_gap": 0.04,"#,
            "",
            "critical_gap: found nothing",
        ),
        (
            r#""critical_gap": 0.04"#,
            r#""critical_gap": 0"#,
            "critical_gap: found 0",
        ),
        (
            r#""normal_stiffness": 1e4"#,
            r#""normal_stiffness": -1"#,
            "normal_stiffness: found -1",
        ),
        (
            r#""normal_stiffness": 1e4"#,
            r#""normal_stifness": 1e4"#,
            "`normal_stiffness`",
        ),
        (
            r#""slave_id": 1"#,
            r#""slave_id": 7"#,
            "7, which no body, rigid line or rigid surface has",
        ),
        (r#""slave_id": 1"#, r#""slave_id": 2"#, "the master itself"),
        (
            r#",
      "boundary_segment": 0.05"#,
            "",
            "a body without a boundary",
        ),
        (
            r#""boundary_segment": 0.05"#,
            r#""boundary_segment": 0"#,
            "boundary_segment",
        ),
        (
            r#""boundary_segment": 0.05"#,
            r#""boundary_segment": 0.05, "boundary_closed": false"#,
            "boundary_closed: found whether a list of vertices is closed, without one",
        ),
        (
            r#""boundary_segment": 0.05"#,
            r#""boundary": [[0, 1], [0.5, 0.5], [0, 0.01], [-0.5, 0.5]]"#,
            "must run counter-clockwise",
        ),
        (
            r#""boundary_segment": 0.05"#,
            r#""boundary": [[-0.5, 0.5], [0.5, 0.5], [0, 0.01], [0.1, 1]]"#,
            "crosses or touches segment",
        ),
        (
            r#""id": 2, "points""#,
            r#""id": 1, "points""#,
            "which another body, line or surface has",
        ),
        (
            r#""method": "mortar""#,
            r#""method": "grid""#,
            "a key of mortar contact",
        ),
        (
            r#""boundary_segment": 0.05"#,
            r#""boundary": [[-0.5, 0.51], [0, 0.01], [0.6, 0.51], [0, 1.01]]"#,
            "vertex 2 of polyline 0 at (0.6, 0.51) m",
        ),
        (
            r#""transfer": "APIC""#,
            r#""transfer": "APIC", "stress_scheme_update": "USF""#,
            "USF with mortar contact",
        ),
        (
            r#""normal_stiffness": 1e4"#,
            r#""normal_stiffness": 0"#,
            "normal_stiffness: found 0",
        ),
        (
            r#""tangential_stiffness": 1e6"#,
            r#""tangential_stiffness": 0"#,
            "tangential_stiffness: found 0",
        ),
    ] {
        let found = message(from, to);
        assert!(found.contains(expected), "{expected}: {found}");
        assert!(found.contains("rolling.json:"), "{found}");
    }
}

const BALL: &str = "../../fixtures/scenes/rolling_ball_3d.json";

/// The same in three dimensions; files lie beside the fixture.
fn changed_ball(from: &str, to: &str) -> Result<Scene, SceneError> {
    let text = std::fs::read_to_string(BALL).expect("the fixture is there");
    assert!(text.contains(from), "{from}");
    let folder = Path::new(BALL).parent().expect("has a folder");
    from_json(&text.replacen(from, to, 1), "ball.json", folder)
}

#[test]
fn triangles_come_from_files() {
    let scene = changed_ball(
        r#""boundary_segment": 0.1"#,
        r#""boundary_stl_mesh": "../surfaces/cube.stl""#,
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let vertices = &scene.mortar.boundaries[0].vertices;
    assert!(matches!(vertices, Vertices::Surface(s) if s.triangle_count() == 12));
    assert_eq!(scene.mortar.facets[0].name, "plane");
    assert_eq!(scene.mortar.facets[0].surface.triangle_count(), 2);
}

/// The triangles of the plane of the ball, as its STL file has them.
const TRIANGLES: &str = r#""triangles": [[[-0.8, -0.8, 0], [2.8, -0.8, 0], [2.8, 0.8, 0]],
    [[-0.8, -0.8, 0], [2.8, 0.8, 0], [-0.8, 0.8, 0]]]"#;
const OF_FILE: &str = r#""stl_mesh": "../surfaces/plane.stl""#;

fn corners(surface: &Surface) -> Vec<[[f64; 3]; 3]> {
    let all = 0..surface.triangle_count();
    all.map(|triangle| surface.corners(triangle)).collect()
}

#[test]
fn triangles_may_stand_in_the_scene() {
    let of_file = changed_ball(OF_FILE, OF_FILE).unwrap_or_else(|e| panic!("{e}"));
    let in_scene = changed_ball(OF_FILE, TRIANGLES).unwrap_or_else(|e| panic!("{e}"));
    let facets = |scene: &Scene| corners(&scene.mortar.facets[0].surface);
    assert_eq!(facets(&in_scene), facets(&of_file));
    let rigid = |surface: &str| {
        let block =
            format!(r#""terrain_contact": {{"active": true, {surface}}}, "transfer": "APIC""#);
        let scene = changed_ball(r#""transfer": "APIC""#, &block);
        scene.unwrap_or_else(|e| panic!("{e}")).surfaces
    };
    let (of_file, in_scene) = (rigid(OF_FILE), rigid(TRIANGLES));
    assert_eq!(corners(&in_scene[0].surface), corners(&of_file[0].surface));
    assert_eq!(in_scene[0].name, "terrain_contact");
}

#[test]
fn bad_triangles_are_named() {
    let both = format!("{OF_FILE}, {TRIANGLES}");
    for (from, to, expected) in [
        (
            OF_FILE,
            both.as_str(),
            "rigid_surface.plane.triangles: found `stl_mesh` and `triangles` together",
        ),
        (
            OF_FILE,
            r#""triangles": [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [1, 0], [0, 1, 0]]]"#,
            "rigid_surface.plane.triangles[1]: found no triangle",
        ),
        (
            OF_FILE,
            r#""triangles": [[[0, 0, 0], [1, 0, 0]]]"#,
            "a list of three corners, each three numbers [m]",
        ),
        (
            OF_FILE,
            r#""triangles": []"#,
            "rigid_surface.plane.triangles: found no triangle",
        ),
        (
            OF_FILE,
            r#""triangles": [[[0, 0, 0], [1, 0, 0], [2, 0, 0]]]"#,
            "rigid_surface.plane.triangles: found",
        ),
        (
            r#""boundary_segment": 0.1"#,
            r#""boundary_segment": 0.1, "boundary_stl_mesh": "../surfaces/cube.stl""#,
            "`boundary_segment` and `boundary_stl_mesh` together",
        ),
        (
            r#""boundary_segment": 0.1"#,
            r#""boundary_stl_mesh": "../surfaces/plane.stl""#,
            "4 open edges",
        ),
        (
            r#""boundary_segment": 0.1"#,
            r#""boundary": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]"#,
            "a polyline in three dimensions",
        ),
        (
            r#""stl_mesh": "../surfaces/plane.stl""#,
            r#""stl_mesh": "../surfaces/nowhere.stl""#,
            "nowhere.stl",
        ),
        (
            r#""id": 2, "stl_mesh": "../surfaces/plane.stl""#,
            r#""id": 2"#,
            "rigid_surface.plane.stl_mesh: found nothing",
        ),
        (
            r#""id": 2, "stl_mesh""#,
            r#""id": 1, "stl_mesh""#,
            "which another body, line or surface has",
        ),
        (
            r#""rigid_surface": {"plane": {"id": 2, "stl_mesh": "../surfaces/plane.stl"}}"#,
            r#""rigid_line": {"plane": {"id": 2, "points": [[1, 0, 0], [0, 0, 0]]}}"#,
            "a polyline in three dimensions",
        ),
        (r#""slave_id": 1"#, r#""slave_id": 7"#, "7, which no body"),
    ] {
        let found = changed_ball(from, to)
            .expect_err("is bad input")
            .to_string();
        assert!(found.contains(expected), "{expected}: {found}");
        assert!(found.contains("ball.json:"), "{found}");
    }
    let flat = message(
        r#""rigid_line": {"plane": {"id": 2, "points": [[2.8, 0], [2, 0], [1, 0], [0, 0], [-0.8, 0]]}}"#,
        r#""rigid_surface": {"plane": {"id": 2, "stl_mesh": "../../fixtures/surfaces/plane.stl"}}"#,
    );
    assert!(flat.contains("triangles in two dimensions"), "{flat}");
}

#[test]
fn a_pair_with_two_methods_of_contact_is_refused() {
    let mut scene = changed("0.3", "0.3").unwrap_or_else(|e| panic!("{e}"));
    let both = &scene.mortar.contacts[0];
    scene.contacts.push(Contact {
        name: "on the grid".into(),
        id: 99,
        friction: 0.0,
        master: both.slave,
        slave: both.master,
        normal: ContactNormal::Master,
    });
    let problems = scene.check().expect_err("is bad input").to_string();
    assert!(
        problems.contains("the pair of on the grid too"),
        "{problems}"
    );
}

/// A scene that may run is warned about with the reason, and one that is sound is not.
#[test]
fn coarse_and_stiff_contacts_are_warned_about() {
    let warnings = |from: &str, to: &str| {
        let mut scene = changed(from, to).unwrap_or_else(|e| panic!("{e}"));
        // Stiff enough to be no reason of its own.
        scene.mortar.contacts[0].tangential_stiffness = 1.6e7;
        proctor_scene::simulation::plan(&scene, PlanOptions::default()).warnings
    };
    assert!(warnings("0.3", "0.3").is_empty());
    let wide = warnings(r#""critical_gap": 0.04"#, r#""critical_gap": 0.11"#);
    assert!(
        wide.len() == 1 && wide[0].starts_with("contact.disc on plane: the critical gap of 0.11 m"),
        "{wide:?}"
    );
    // 10 E/h = 2.5e7 Pa/m.
    let stiff = warnings(r#""normal_stiffness": 1e4"#, r#""normal_stiffness": 2.6e7"#);
    assert!(
        stiff.len() == 1 && stiff[0].contains("oscillates") && stiff[0].contains("25000000 Pa/m"),
        "{stiff:?}"
    );
    assert!(warnings(r#""normal_stiffness": 1e4"#, r#""normal_stiffness": 2.4e7"#).is_empty());
}
