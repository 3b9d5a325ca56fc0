//! Stages of a scene: scenes that follow each other, each from the end of the one before.
//!
//! The file holds what they share and a list of what each changes. A stage is the file without that list, into which the keys
//! of the stage are merged: objects key by key, everything else as a whole (RFC 7396).

use std::path::PathBuf;

use serde_json::{Map, Value};

use super::build::reaches;
use super::source::{SceneSource, SourceMap};
use super::{place, placed, position};
use proctor_scene::simulation::missing_column;
use proctor_scene::{InitialStress, Problem, Scene, SceneError, StateFile};

/// Key of the list.
const STAGES: &str = "stages";
/// Keys of a stage that are none of a scene.
const NAME: &str = "name";
const VELOCITY: &str = "velocity";

/// A stage of a scene.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Its name; empty where the scene has no stages.
    pub name: String,
    /// The scene of the stage. All stages but the first begin from the end of the one before, by its name as a file.
    pub scene: Scene,
    /// Places of its values in the text.
    pub places: SourceMap,
}

impl SceneSource {
    /// The stages of a scene in their order; one without a name where it has none.
    ///
    /// # Errors
    /// As [`from_json`](super::from_json), for the first stage that has problems.
    pub fn stages(self) -> Result<Vec<Stage>, SceneError> {
        let text = self.text().trim_start_matches('\u{feff}');
        let Ok(Value::Object(mut base)) = serde_json::from_str(text) else {
            return Ok(vec![whole(self)?]);
        };
        let Some(list) = base.remove(STAGES) else {
            return Ok(vec![whole(self)?]);
        };
        let objects = objects(&list).map_err(|problem| self.error(vec![*problem]))?;
        let mut stages: Vec<Stage> = vec![];
        for (number, own) in objects.into_iter().enumerate() {
            let before = stages.last();
            let stage = stage(&self, &base, number, own, before)?;
            if stages.iter().any(|other| other.name == stage.name) {
                return Err(self.error(vec![Problem::new(
                    format!("{STAGES}[{number}].{NAME}"),
                    format!("{:?}, the name of an earlier stage", stage.name),
                    "a name for each stage",
                )]));
            }
            stages.push(stage);
        }
        Ok(stages)
    }

    fn error(&self, mut problems: Vec<Problem>) -> SceneError {
        let text = self.text().trim_start_matches('\u{feff}');
        for problem in &mut problems {
            // An unknown key is where it stands, not where its value does.
            if problem.location.is_none()
                && problem.found.starts_with("the unknown key")
                && let Some(span) = position::find(text, &problem.path)
            {
                problem.location = Some(position::location(self.name(), text, span.key));
            }
        }
        place(&mut problems, text, self.name());
        SceneError { problems }
    }
}

/// A scene without stages.
fn whole(source: SceneSource) -> Result<Stage, SceneError> {
    let (scene, places) = source.scene()?;
    Ok(Stage {
        name: String::new(),
        scene,
        places,
    })
}

/// The entries of the list.
fn objects(list: &Value) -> Result<Vec<&Map<String, Value>>, Box<Problem>> {
    let accepted = "a list of objects, each with a `name` and the keys that the stage changes";
    let entries = list.as_array().filter(|entries| !entries.is_empty());
    let refused = |path: String, found: &Value| Box::new(Problem::new(path, kind(found), accepted));
    let entries = entries.ok_or_else(|| refused(STAGES.to_owned(), list))?;
    let objects = entries.iter().enumerate().map(|(i, entry)| {
        let object = entry.as_object();
        object.ok_or_else(|| refused(format!("{STAGES}[{i}]"), entry))
    });
    objects.collect()
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "an empty list",
        Value::Object(_) => "an object",
    }
}

/// One stage.
fn stage(
    source: &SceneSource,
    base: &Map<String, Value>,
    number: usize,
    own: &Map<String, Value>,
    before: Option<&Stage>,
) -> Result<Stage, SceneError> {
    let at = |key: &str| format!("{STAGES}[{number}].{key}");
    let mut own = own.clone();
    let refused = |key: &str, found: &str, accepted: &str| {
        source.error(vec![Problem::new(at(key), found, accepted)])
    };
    let accepted = "a name of letters, digits, `-` and `_`, for the folder of the stage";
    let name = match own.remove(NAME) {
        Some(Value::String(name)) if is_name(&name) => name,
        Some(other) => return Err(refused(NAME, &other.to_string(), accepted)),
        None => return Err(refused(NAME, "nothing: the key is missing", accepted)),
    };
    if before.is_some() && own.contains_key("initial_state") {
        return Err(refused(
            "initial_state",
            "the state of another run, in a stage that begins from the one before it",
            "it in the first stage, or beside the list",
        ));
    }
    if before.is_none() && own.get(VELOCITY).and_then(Value::as_str) == Some("kept") {
        return Err(refused(
            VELOCITY,
            "\"kept\" in the first stage, before which there is none",
            "it in a later stage; `initial_state` has a `velocity` of its own",
        ));
    }
    let velocity = own.remove(VELOCITY);
    let keeps_velocity = match velocity.as_ref().map(Value::as_str) {
        None | Some(Some("zero")) => false,
        Some(Some("kept")) => true,
        Some(_) => {
            let found = velocity.unwrap_or_default().to_string();
            return Err(refused(VELOCITY, &found, "`zero` or `kept`"));
        }
    };
    if own.contains_key(STAGES) {
        return Err(refused(STAGES, "stages in a stage", "the keys of a scene"));
    }
    let mut merged = Value::Object(base.clone());
    merge(&mut merged, &Value::Object(own.clone()));
    if let Some(before) = before {
        leave_out_starts(&mut merged, before);
    }
    let own = Value::Object(own);
    let mut changed = vec![];
    leaves(&own, "", &mut changed);
    let stem = source.name().to_owned();
    let (mut scene, mut spellings) =
        placed(&merged.to_string(), &stem, source.folder()).map_err(|error| {
            let problems = error.problems.into_iter().map(|problem| Problem {
                path: if changes(&own, &problem.path) {
                    at(&problem.path)
                } else {
                    problem.path.clone()
                },
                // The place in the merged text is none in the file.
                location: (problem.location).filter(|location| location.file != stem),
                ..problem
            });
            source.error(problems.collect())
        })?;
    if let Some(before) = before {
        if let Some(mut problem) = contradiction(&changed, &before.scene, &scene) {
            problem.path = if problem.path.is_empty() {
                format!("{STAGES}[{number}]")
            } else {
                at(&problem.path)
            };
            return Err(source.error(vec![problem]));
        }
        scene.initial_state = Some(StateFile {
            file: PathBuf::from(&before.name),
            keeps_velocity,
        });
        for body in &mut scene.bodies {
            // Those of a divided body have no key of their own.
            if before.scene.bodies.iter().any(|old| old.id == body.id) {
                body.initial_stress = InitialStress::None;
            }
        }
    }
    scene.name = format!("{}, {name}", scene.name.trim_matches(['<', '>']));
    spellings.extend(changed.into_iter().map(|path| {
        let written = at(&path);
        (path, written)
    }));
    let places = SourceMap::new(source.clone(), spellings, &scene);
    Ok(Stage {
        name,
        scene,
        places,
    })
}

/// The problem that keeps the bodies of a stage from going on as the stage before left them, by the key among those that it
/// changes; an empty path where none of them is to blame alone.
fn contradiction(changed: &[String], before: &Scene, scene: &Scene) -> Option<Problem> {
    let key = |keys: &[&str]| {
        let begins = |path: &&String| keys.iter().any(|key| reaches(key, path));
        changed.iter().find(begins).cloned().unwrap_or_default()
    };
    let axes = scene.dimension.axes();
    let (cell, was) = (&scene.mesh.cell[..axes], &before.mesh.cell[..axes]);
    if scene.dimension != before.dimension || cell != was {
        return Some(Problem::new(
            key(&["mesh", "dimension"]),
            format!("cells of {cell:?} m after a stage with cells of {was:?} m"),
            "cells of one size in all stages",
        ));
    }
    if let Some(path) = changed.iter().find(|path| path.contains("initial_stress")) {
        let old = before.bodies.iter().any(|old| {
            let mut bodies = scene.bodies.iter();
            bodies.any(|body| body.id == old.id && path.contains(&body.name))
        });
        if old {
            return Some(Problem::new(
                path.clone(),
                "the stress of the start, of a body that has that of the stage before",
                "it in the first stage of the body",
            ));
        }
    }
    let (index, name) = missing_column(before, scene)?;
    let path = if name.contains("half-length") {
        key(&["shape_function", "domain_update"])
    } else {
        key(&[
            "material",
            "materials",
            "body",
            "bodies",
            "shape_function",
            "results",
        ])
    };
    Some(Problem::new(
        path,
        format!(
            "the body {:?} needs \"{name}\" of its particles, which it lacks in the stage before",
            scene.bodies[index].name
        ),
        "the same law and the same `shape_function` in both stages",
    ))
}

/// Takes the stress with which bodies of the stage before began out of a scene: it is in the state by now, and need not go with what
/// the stage changes, such as gravity.
fn leave_out_starts(scene: &mut Value, before: &Stage) {
    let is_old = |body: &Value| {
        let id = body.get("id").and_then(Value::as_i64);
        id.is_some_and(|id| before.scene.bodies.iter().any(|old| old.id == id))
    };
    for key in ["body", "bodies"] {
        let bodies: Vec<&mut Value> = match scene.get_mut(key) {
            Some(Value::Array(bodies)) => bodies.iter_mut().collect(),
            Some(Value::Object(bodies)) => bodies.values_mut().collect(),
            _ => continue,
        };
        for body in bodies.into_iter().filter(|body| is_old(body)) {
            if let Some(body) = body.as_object_mut() {
                body.remove("initial_stress");
            }
        }
    }
}

fn is_name(name: &str) -> bool {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    !name.is_empty() && name.chars().all(allowed)
}

/// Puts the keys of a stage into a scene.
fn merge(into: &mut Value, from: &Value) {
    match (into, from) {
        (Value::Object(into), Value::Object(from)) => {
            for (key, value) in from {
                if value.is_null() {
                    into.remove(key);
                } else {
                    merge(into.entry(key.clone()).or_insert(Value::Null), value);
                }
            }
        }
        (into, from) => *into = from.clone(),
    }
}

/// Paths of the values of a stage that are no objects.
fn leaves(value: &Value, path: &str, all: &mut Vec<String>) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                leaves(value, &super::build::join(path, key), all);
            }
        }
        _ => all.push(path.to_owned()),
    }
}

/// True if a stage changes the value at a path.
fn changes(own: &Value, path: &str) -> bool {
    let mut all = vec![];
    leaves(own, "", &mut all);
    let paths = all.iter();
    paths.clone().any(|changed| reaches(changed, path))
        || (!path.is_empty() && paths.clone().any(|changed| reaches(path, changed)))
}
