//! `summary.json`: the promised keys, and neither `null` nor not-a-number.

use std::fs;

use proctor_files::output::summary::{
    Status, Summary, SummaryDrift, SummaryEnergy, SummaryEvent, SummaryMesh, Warning, YieldingBody,
    finite,
};
use proctor_files::output::{OutputError, atomic};
use serde_json::{Value, json};

fn complete() -> Summary {
    Summary {
        scene: "boussinesq".to_owned(),
        plan: json!({"kept": ["gravity"], "bytes": 120}),
        mesh: Some(SummaryMesh {
            origin: vec![0.0; 3],
            cell: vec![0.5; 3],
            cells: vec![4; 3],
            axisymmetric: true,
        }),
        particles: 8,
        nodes_active: 27,
        steps: 10,
        time: Some(0.5),
        dt_min: Some(0.0625),
        dt_max: Some(0.125),
        dt_critical: Some(0.25),
        wall_seconds: Some(1.5),
        cpu_seconds: Some(2.5),
        ns_per_particle_step: Some(160.0),
        threads: 2,
        ranks: None,
        message_seconds: None,
        lanes: "avx512".to_owned(),
        mass: Some(2000.0),
        momentum: vec![0.0, 0.0, -1.0],
        energy: SummaryEnergy {
            kinetic: Some(1.0),
            strain: Some(2.0),
            contact: Some(0.5),
            external_work: Some(3.0),
            dissipated: Some(-0.5),
            damping: Some(0.25),
            friction: Some(0.125),
            impact: Some(0.0625),
            absorbed: None,
            removed: Some(0.0),
            plastic: Some(0.0),
            remainder: Some(-0.9375),
            algorithmic: Some(-0.03125),
        },
        yielding: vec![YieldingBody {
            body: 4,
            stored: Some(2.0),
            plastic: Some(1.5),
            algorithmic: Some(-0.03125),
        }],
        boundary_drift: Some(SummaryDrift {
            body: 1,
            vertex: 7,
            distance: Some(1.0e-3),
            in_cells: Some(0.02),
        }),
        not_to_be_trusted: Some("not to be trusted since step 7".into()),
        warnings: vec![Warning {
            kind: "energy".to_owned(),
            message: "3 J came from nowhere".to_owned(),
        }],
        events: vec![SummaryEvent {
            kind: "particle_left".to_owned(),
            message: "particle 3 left the mesh".to_owned(),
            time: Some(0.25),
            step: 5,
            particle: Some(3),
            position: vec![1.0, 2.0, 3.0],
            mass: Some(250.0),
        }],
        state_hash: 0x00ab,
        status: Status::Failed,
        error: Some("inverted particle".to_owned()),
    }
}

const KEYS: [&str; 26] = [
    "scene",
    "plan",
    "mesh",
    "particles",
    "nodes_active",
    "steps",
    "time",
    "dt_min",
    "dt_max",
    "dt_critical",
    "wall_seconds",
    "cpu_seconds",
    "ns_per_particle_step",
    "threads",
    "lanes",
    "mass",
    "momentum",
    "energy",
    "yielding",
    "boundary_drift",
    "not_to_be_trusted",
    "warnings",
    "events",
    "state_hash",
    "status",
    "error",
];

fn round_trip(summary: &Summary) -> (String, Summary) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    summary.write(&path).unwrap();
    (
        fs::read_to_string(&path).unwrap(),
        Summary::read(&path).unwrap(),
    )
}

#[test]
fn it_has_the_promised_keys_and_reads_back() {
    let (text, read) = round_trip(&complete());
    assert_eq!(read, complete());
    let value: Value = serde_json::from_str(&text).unwrap();
    let mut found: Vec<&String> = value.as_object().unwrap().keys().collect();
    let mut expected = KEYS.to_vec();
    found.sort();
    expected.sort_unstable();
    assert_eq!(found, expected);
    assert_eq!(value["state_hash"], "00000000000000ab");
    assert_eq!(value["status"], "failed");
    assert_eq!(value["energy"]["external_work"], 3.0);
    let finished = Summary {
        status: Status::Finished,
        error: None,
        ..complete()
    };
    let (text, _) = round_trip(&finished);
    assert!(
        text.contains("\"status\": \"finished\"") && !text.contains("\"error\""),
        "{text}"
    );
}

#[test]
fn what_is_not_finite_is_left_out() {
    let mut summary = complete();
    for bad in [
        Some(f64::NAN),
        Some(f64::INFINITY),
        Some(f64::NEG_INFINITY),
        None,
        finite(f64::NAN),
    ] {
        summary.time = bad;
        summary.dt_min = bad;
        summary.dt_max = bad;
        summary.dt_critical = bad;
        summary.wall_seconds = bad;
        summary.cpu_seconds = bad;
        summary.ns_per_particle_step = bad;
        summary.mass = bad;
        summary.momentum = vec![0.0, bad.unwrap_or(f64::NAN)];
        summary.energy = SummaryEnergy {
            kinetic: bad,
            strain: bad,
            contact: bad,
            external_work: bad,
            dissipated: bad,
            damping: bad,
            friction: bad,
            impact: bad,
            absorbed: bad,
            removed: bad,
            plastic: bad,
            remainder: bad,
            algorithmic: bad,
        };
        summary.events[0] = SummaryEvent {
            time: bad,
            mass: bad,
            position: vec![f64::NAN],
            ..SummaryEvent::default()
        };
        summary.plan = json!({"left_out": null, "list": [1, null, {"inner": null}]});
        let (text, read) = round_trip(&summary);
        assert!(
            !text.contains("null") && !text.contains("NaN") && !text.contains("inf"),
            "{text}"
        );
        assert_eq!(read.time, None);
        assert_eq!(read.plan, json!({"list": [1, {}]}));
        assert!(read.momentum.is_empty());
    }
    let (text, _) = round_trip(&Summary::default());
    assert!(!text.contains("null"), "{text}");
}

#[test]
fn a_file_that_is_no_summary_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    assert!(matches!(
        Summary::read(&path),
        Err(OutputError::Read { .. })
    ));
    let (whole, _) = round_trip(&complete());
    for bad in [
        "{",
        "{\n\"scene\": 3}",
        &whole.replace("00000000000000ab", "ab"),
        &whole.replace("failed", "done"),
    ] {
        atomic::write(&path, |file| file.write_all(bad.as_bytes())).unwrap();
        let error = Summary::read(&path).unwrap_err();
        assert!(matches!(error, OutputError::Malformed { .. }), "{error:?}");
        assert!(error.to_string().contains("summary.json"), "{error}");
    }
}
