//! A scene as other solvers get it: nothing left to a default that programs disagree about.

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Scene, TimeStep};
use serde_json::{Value, json};

/// Digits that every number of a scene is rounded to: as many as a decimal number keeps on its way through a binary one.
const DIGITS: usize = 15;
/// Share of a step by which a time may miss a whole number of steps.
const WHOLE: f64 = 1e-6;
/// Planes of the mesh, as scene files have them.
const PLANES: [&str; 6] = [
    "plane_X0", "plane_Xn", "plane_Y0", "plane_Yn", "plane_Z0", "plane_Zn",
];

/// The scene with every plane named, one constant step that fits a whole number of times between two frames, and short
/// decimals. `values` is what the scene says.
#[must_use]
pub fn written(mut scene: Value, values: &Scene) -> Value {
    if values.results.print == 0 {
        scene["results"]["print"] = 1.into();
    }
    name_planes(&mut scene, values.dimension.axes());
    manual_words(&mut scene);
    if let Some(dt) = constant_step(values) {
        scene["time_step"] = dt.into();
        if let Some(keys) = scene.as_object_mut() {
            keys.remove("time_step_multiplier");
            keys.remove("critical_time_step_multiplier");
        }
    }
    shorten(&mut scene);
    scene
}

/// Words that the manuals' program knows, where this program reads two for one thing.
fn manual_words(scene: &mut Value) {
    if scene["shape_function"] == "uGIMP" {
        scene["shape_function"] = "GIMP".into();
    }
    if let Some(results) = scene["results"].as_object_mut()
        && let Some(fields) = results.remove("fields")
    {
        results.insert("material_point_results".to_owned(), fields);
    }
}

/// A plane that is not named slides in the manuals; some programs refuse it.
fn name_planes(scene: &mut Value, axes: usize) {
    let conditions = &mut scene["mesh"]["boundary_conditions"];
    if conditions.is_null() {
        *conditions = json!({});
    }
    for plane in &PLANES[..2 * axes] {
        if conditions[plane].is_null() {
            conditions[plane] = "sliding".into();
        }
    }
}

/// A step \[s\], no longer than the one that the scene begins with, of which a whole number fits between two frames: a
/// solver that does not know multipliers takes it, and one that does not shorten steps ends where it should. `None`
/// where the scene cannot be set up; its run says why.
fn constant_step(values: &Scene) -> Option<f64> {
    let given = match values.time_step {
        TimeStep::Fixed { dt, .. } => dt,
        TimeStep::Automatic | TimeStep::Multiplier { .. } => {
            let options = Options {
                threads: Some(1),
                ..Options::default()
            };
            let mut simulation = Simulation::new(values, &options).ok()?;
            simulation.step(values.time).ok()?.dt
        }
    };
    let frames = values.results.print.max(1) as f64;
    let between = values.time / frames / given;
    let whole = (between - WHOLE).ceil().max(1.0);
    let fits = (between - whole).abs() <= WHOLE;
    Some(if fits {
        given
    } else {
        values.time / frames / whole
    })
}

/// Rounds every number that is not whole: 3 times 0.1 becomes 0.3, so that a corner lies on the node that is meant.
fn shorten(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            let digits = DIGITS - 1;
            let short = number.as_f64().map(|x| format!("{x:.digits$e}"));
            if let Some(short) = short.and_then(|text| text.parse::<f64>().ok()) {
                *value = short.into();
            }
        }
        Value::Array(list) => list.iter_mut().for_each(shorten),
        Value::Object(entries) => entries.values_mut().for_each(shorten),
        _ => {}
    }
}
