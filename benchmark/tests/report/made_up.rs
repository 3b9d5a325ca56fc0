//! Records that nobody measured, small enough to know every number of their pages.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::DeflateDecoder;
use proctor_benchmark::record::Record;
use proctor_benchmark::report::page;
use serde_json::{Value, json};
use std::io::Read as _;
use tempfile::TempDir;

/// A record as its file says it.
pub struct MadeUp {
    pub rows: Vec<Value>,
    pub cases: Vec<Value>,
    pub studies: Vec<Value>,
}

impl MadeUp {
    /// A case with an error of its run and a gate on it.
    pub fn with_case(mut self, name: &str, error: f64, bound: f64) -> Self {
        let passed = error <= bound;
        self.rows.push(json!({
            "name": format!("{name}/h=1"), "run_name": format!("{name}/h=1"), "run_type": "iteration",
            "repetition_index": 0, "threads": 1, "iterations": 1, "real_time": 1.0, "cpu_time": 1.0, "time_unit": "ms",
            "particles": 64.0, "steps": 10.0, "error_l2_u": error,
        }));
        self.rows.push(json!({
            "name": format!("{name}: error of L2(u)_gate"), "run_name": format!("{name}: error of L2(u)"),
            "run_type": "aggregate", "aggregate_name": "gate", "threads": 1, "iterations": 1,
            "gate_value": error, "gate_bound": bound, "gate_side": "at most",
        }));
        self.cases.push(json!({
            "name": name, "question": format!("Does {name} hold?"), "quantities": [["l2_u", "L2(u)"]],
            "gates": [{
                "name": "error of L2(u)", "value": error, "relation": "at most", "bound": bound, "reason": "a reason",
                "passed": passed,
            }],
            "figures": [figure("error against cell size", "run h=1."), figure("error against cell size", "run h=2.")],
            "for_the_record": [],
        }));
        self
    }

    /// Cost of a line of the study of a case for 1 % \[s\], and its smallest error; none where all of it failed.
    pub fn with_cost(
        mut self,
        case: &str,
        method: [&str; 3],
        cost: Option<f64>,
        smallest: Option<f64>,
    ) -> Self {
        let name = format!("precision/{case}/{}", method.join("-"));
        let mut row = json!({
            "name": format!("{name}_cost_displacement"), "run_name": name, "run_type": "aggregate",
            "aggregate_name": "cost_displacement", "threads": 1, "iterations": 1, "case": case,
            "weighting": method[0], "scheme": method[1], "transfer": method[2],
            "has_safe_step": if method[0] == "linear" { "no" } else { "yes" },
        });
        if let Some(cost) = cost {
            row["seconds_for_error_0.01"] = json!(cost);
        }
        if let Some(error) = smallest {
            row["smallest_error"] = json!(error);
        } else {
            row["error_occurred"] = json!(true);
            row["error_message"] = json!("no run of this line gave an error below 1");
        }
        self.rows.push(row);
        self
    }

    /// A run of a study that failed, with the study in which it stands.
    pub fn with_failed_study(mut self, case: &str, reason: &str) -> Self {
        let name = format!("precision/{case}/linear-USL-FLIP/h=1");
        self.rows.push(json!({
            "name": name, "run_name": name, "run_type": "iteration", "repetition_index": 0, "threads": 1, "iterations": 1,
            "real_time": 1.0, "cpu_time": 1.0, "time_unit": "ms", "case": case, "weighting": "linear", "scheme": "USL",
            "transfer": "FLIP", "cell_size": 1.0, "error_occurred": true, "error_message": reason,
        }));
        self.studies.push(json!({
            "case": case, "question": "Which?", "measure": "displacement",
            "figures": [figure("error against run time", "methods.")],
            "table": [
                ["combination", "C", "finest", "order", "particles", "steps", "wall", "CPU", "for 1 %", "for 0.1 %"],
                ["uGIMP USL FLIP", "0.34", "0.5 %", "2.00", "64", "10", "1 ms", "1 ms", "1 ms", "-"],
                ["linear USL FLIP !", "0.53", "failed", "-", "-", "-", "1 ms", "1 ms", "-", "-"],
            ],
            "findings": ["1 %: best with uGIMP USL FLIP"],
        }));
        self
    }

    /// A whole step: its time by the clock \[ns\], and the shares of the machine's peaks.
    pub fn with_step(self, ns: f64, arithmetic: f64, memory: f64) -> Self {
        self.with_step_of("block", ns, arithmetic, memory)
    }

    /// The same of a scene of that name.
    pub fn with_step_of(mut self, scene: &str, ns: f64, arithmetic: f64, memory: f64) -> Self {
        let name = format!("whole-step/{scene}/threads:1");
        self.rows.push(json!({
            "name": name, "run_name": name, "run_type": "iteration", "repetition_index": 0, "threads": 1, "iterations": 1,
            "real_time": 1.0, "cpu_time": 1.0, "time_unit": "ms", "stage": "step", "scene": scene,
            "particles": 64.0, "wall_ns_per_particle_step": ns, "cpu_ns_per_particle_step": ns,
            "particle_steps_per_second": 1e9 / ns, "share_of_arithmetic": arithmetic, "share_of_bandwidth": memory,
        }));
        self
    }

    pub fn new() -> Self {
        Self {
            rows: vec![],
            cases: vec![],
            studies: vec![],
        }
    }

    /// The record, read from a file as a user's is.
    pub fn record(&self) -> Record {
        let desk = TempDir::new().expect("a folder");
        let path = desk.path().join("record.json");
        let record = json!({
            "context": {
                "schema_version": 1, "library_build_type": "release", "lanes": "avx2", "date": "2026-01-01T00:00:00+00:00",
                "cpu_model": "a processor", "num_cpus": 2, "commit": "0123456789abcdef",
            },
            "benchmarks": self.rows,
            "details": { "cases": self.cases, "studies": self.studies },
        });
        std::fs::write(&path, record.to_string()).expect("a record is written");
        Record::read(&path).expect("a record")
    }

    /// The page as it is with all cases opened.
    pub fn page(&self) -> String {
        unpacked(&page(&self.record(), None))
    }
}

fn figure(title: &str, run: &str) -> Value {
    let axis = |label: &str| json!({ "label": label, "scale": "Log", "format": "Percent" });
    json!({
        "caption": format!("An error: computed against exact, {run}"),
        "chart": {
            "title": title, "description": "", "x": axis("cell size"), "y": axis("relative error"), "guides": [],
            "legend": [],
            "series": [{
                "colour": { "Hue": 0 }, "mark": "Circle", "stroke": "Solid", "strength": "Plain",
                "points": [{ "x": 0.5, "y": 0.02, "title": "a point" }, { "x": 0.25, "y": null, "title": "another" }],
            }],
        },
    })
}

/// A page with the pictures that are loaded when a case is opened.
pub fn unpacked(page: &str) -> String {
    const OPEN: &str = "<div class=\"packed\" data-packed=\"";
    let mut parts = page.split(OPEN);
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (packed, rest) = part.split_once('"').expect("an attribute");
        let bytes = STANDARD.decode(packed).expect("base64");
        let mut html = String::new();
        DeflateDecoder::new(bytes.as_slice())
            .read_to_string(&mut html)
            .expect("deflate");
        let (_, rest) = rest.split_once("</div>").expect("an end");
        whole.push_str(&html);
        whole.push_str(rest);
    }
    whole
}

/// Text between two others, every time.
pub fn between<'a>(page: &'a str, from: &str, to: &str) -> Vec<&'a str> {
    let parts = page.split(from).skip(1);
    parts
        .map(|part| part.split(to).next().unwrap_or_default())
        .collect()
}
