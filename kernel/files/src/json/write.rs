//! A scene as the text of a scene file, for other programs.
//!
//! A written scene is read back as the same scene, but for the names of surfaces, which are those of their files. A feature without a word in the language, or one that is not written yet,
//! is refused by name.

use serde_json::{Map, Value, json};

use super::words::{
    BASES, Base, CONTACT_NORMALS, FIELDS, NODAL_FIELDS, PLANE_CONDITIONS, PLANES, RECORDED_MOTIONS,
    RecordedMotion, SCHEMES, VOLUMETRIC_STRAINS, Words,
};
use crate::records;
use proctor_laws::{self as laws, AnyLaw, LawType};
use proctor_scene::{
    BaseMotion, Body, Damping, Dimension, History, InitialStress, Mesh, Motion, OnImbalance,
    Outside, Scene, Shape, StandingWater, TimeStep, Transfer, Vector, VolumetricStrain,
};
use thiserror::Error;

/// A scene in the language of scene files.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneWriter {
    /// The keys. Every plane is named, and no choice of the method is left to a default.
    pub scene: Value,
    /// Files that the scene names, which belong into its folder: name and text.
    pub files: Vec<(String, String)>,
}

/// Parts of a scene that are not written.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{what} cannot be written into a scene file")]
pub struct Omission {
    /// The part.
    pub what: String,
}

/// Name of the file of a base motion.
const RECORD: &str = "base.csv";

/// The scene as a scene file has it.
///
/// # Errors
/// [`Omission`]: surfaces that move, mortar contact, shapes other than cuboids, laws and transfers that no word stands for,
/// probes.
pub fn write(scene: &Scene) -> Result<SceneWriter, Omission> {
    let moving = scene
        .surfaces
        .iter()
        .any(|surface| surface.motion.is_some());
    refuse(moving, "a rigid surface that moves")?;
    let mortar = &scene.mortar;
    refuse(
        !(mortar.boundaries.is_empty() && mortar.contacts.is_empty()),
        "mortar contact",
    )?;
    refuse(
        !(mortar.lines.is_empty() && mortar.facets.is_empty()),
        "a rigid line or surface of mortar contact",
    )?;
    refuse(scene.has_water(), "water in pores")?;
    refuse(scene.initial_state.is_some(), "a start from another run")?;
    refuse(scene.until.is_some(), "an end by the balance of forces")?;
    refuse(!scene.probes.is_empty(), "a probe")?;
    refuse(scene.outside != Outside::Stop, "removal of particles")?;
    let to = Writer(scene.dimension.axes());
    let mut keys = json!({
        "dimension": to.0,
        "time": scene.time,
        "gravity": to.vector(&scene.gravity),
        "stress_scheme_update": word(SCHEMES, &scene.scheme),
        "damping": damping(scene.damping),
        "mesh": to.mesh(&scene.mesh),
        "material": materials(scene)?,
        "body": list(&scene.bodies, |body| to.body(scene, body))?,
        "results": {
            "print": scene.results.print,
            "fields": scene.results.fields.iter().map(|field| field_word(FIELDS, field)).collect::<Vec<_>>(),
            "checkpoint": scene.results.checkpoint,
        },
    });
    method(scene, &mut keys)?;
    if scene.volumetric_strain != VolumetricStrain::Particle {
        let means = word(VOLUMETRIC_STRAINS, &scene.volumetric_strain);
        keys["volumetric_strain"] = means.into();
    }
    if scene.on_imbalance == OnImbalance::Stop {
        keys["on_imbalance"] = "stop".into();
    }
    if let Some(interval) = scene.results.history_interval {
        keys["results"]["history_interval"] = interval.into();
    }
    if !scene.results.nodal_fields.is_empty() {
        let fields = scene.results.nodal_fields.iter();
        let words = fields.map(|field| field_word(NODAL_FIELDS, field));
        keys["results"]["grid_nodal_results"] = words.collect::<Vec<_>>().into();
    }
    let loads = scene.point_loads.iter();
    let loads: Vec<Value> = loads
        .map(|load| json!([to.vector(&load.position), to.vector(&load.force)]))
        .collect();
    let corners = |p1, p2| json!({ "point_p1": to.vector(p1), "point_p2": to.vector(p2) });
    let with = |mut keys: Value, key: &str, value: &Vector| {
        keys[key] = to.vector(value);
        keys
    };
    let tractions = scene.tractions.iter();
    let boxes = scene.box_loads.iter();
    let held = scene.held_boxes.iter();
    for (key, list) in [
        ("nodal_point_load", loads),
        (
            "traction",
            tractions
                .map(|t| {
                    let mut keys = corners(&t.p1, &t.p2);
                    keys["traction"] = match t.traction.constant() {
                        Some(vector) => to.vector(&vector),
                        None => to.rows(&t.traction),
                    };
                    keys
                })
                .collect(),
        ),
        (
            "box_load",
            boxes
                .map(|b| with(corners(&b.p1, &b.p2), "force", &b.force))
                .collect(),
        ),
        ("held_box", held.map(|b| corners(&b.p1, &b.p2)).collect()),
        ("contact", contacts(scene)),
        (
            "standing_water",
            (scene.standing_waters.iter()).map(standing_water).collect(),
        ),
    ] {
        if !list.is_empty() {
            keys[key] = list.into();
        }
    }
    if let Some(distance) = scene.contact_distance {
        keys["contact_manager"] = json!({ "real_distance_correction_coefficient": distance });
    }
    let (terrain, mut files) = terrain(scene);
    if let [one] = terrain.as_slice() {
        keys["terrain_contact"] = one.clone();
    } else if !terrain.is_empty() {
        keys["terrain_contact"] = terrain.into();
    }
    if let Some(base) = &scene.base_motion {
        let (entry, text) = to.base_motion(base);
        keys["earthquake"] = entry;
        files.push((RECORD.to_owned(), text));
    }
    if let Some(wave) = &scene.ground_beyond.incoming {
        let (mut entry, text) = to.base_motion(wave);
        entry["base"] = word(BASES, &Base::Compliant).into();
        entry["motion"] = word(RECORDED_MOTIONS, &RecordedMotion::Incoming).into();
        keys["earthquake"] = entry;
        files.push((RECORD.to_owned(), text));
    }
    if let Some(thickness) = scene.ground_beyond.thickness {
        keys["absorbing_springs"] = thickness.into();
    }
    Ok(SceneWriter { scene: keys, files })
}

pub(super) fn refuse(is: bool, what: &str) -> Result<(), Omission> {
    if is {
        return Err(Omission {
            what: what.to_owned(),
        });
    }
    Ok(())
}

/// The first word of a meaning.
pub(super) fn word<T: PartialEq>(words: Words<T>, meaning: &T) -> &'static str {
    words
        .iter()
        .find(|(_, known)| known == meaning)
        .map_or("", |(word, _)| word)
}

/// The word of one field, of words that stand for lists.
fn field_word<T: PartialEq>(words: Words<&'static [T]>, field: &T) -> &'static str {
    let own = words
        .iter()
        .find(|(_, fields)| matches!(fields, [one] if one == field));
    own.map_or("none", |(word, _)| word)
}

fn damping(damping: Damping) -> Value {
    match damping {
        Damping::None => json!({ "type": "none" }),
        Damping::Local { alpha } => json!({ "type": "local", "value": alpha }),
        Damping::Kinetic => json!({ "type": "kinetic" }),
        Damping::Viscous { alpha } => json!({ "type": "viscous", "value": alpha }),
    }
}

fn standing_water(water: &StandingWater) -> Value {
    let level = &water.level;
    let mut keys = json!({ "density": water.density });
    keys["level"] = if let Some([level, ..]) = level.constant() {
        level.into()
    } else {
        let rows = level.times.iter().zip(&level.values);
        rows.map(|(time, [level, ..])| json!([time, level]))
            .collect()
    };
    if !water.bodies.is_empty() {
        keys["body_ids"] = water.bodies.clone().into();
    }
    if let Some(shore) = &water.shore {
        keys["side"] = word(PLANES, &(shore.axis, shore.side)).into();
        keys["between"] = shore.between.to_vec().into();
    }
    keys
}

fn contacts(scene: &Scene) -> Vec<Value> {
    let contact = scene.contacts.iter();
    contact
        .map(|contact| {
            json!({
                "id": contact.id, "friction": contact.friction, "master_id": contact.master,
                "slave_id": contact.slave, "normal_type": word(CONTACT_NORMALS, &contact.normal),
            })
        })
        .collect()
}

/// Rigid surfaces that stand, and their files: STL texts.
fn terrain(scene: &Scene) -> (Vec<Value>, Vec<(String, String)>) {
    let surfaces = scene.surfaces.iter().enumerate();
    surfaces
        .map(|(i, rigid)| {
            let name = format!("surface-{}.stl", i + 1);
            let mut keys = json!({
                "active": true, "stl_mesh": name, "friction": rigid.friction,
                "distance_threshold": rigid.distance_threshold,
            });
            if let Some(stiffness) = rigid.penalty_stiffness {
                keys["penalty_contact_active"] = true.into();
                keys["penalty_stiffness"] = stiffness.into();
            }
            let mut text = "solid surface\n".to_owned();
            for triangle in 0..rigid.surface.triangle_count() {
                text.push_str("facet normal 0 0 0\nouter loop\n");
                for [x, y, z] in rigid.surface.corners(triangle) {
                    text.push_str("vertex");
                    text.extend([x, y, z].map(|x| format!(" {x:e}")));
                    text.push('\n');
                }
                text.push_str("endloop\nendfacet\n");
            }
            text.push_str("endsolid surface\n");
            (keys, (name, text))
        })
        .unzip()
}

/// Weighting function, transfer and time step.
fn method(scene: &Scene, keys: &mut Value) -> Result<(), Omission> {
    let kind = scene.weighting.kind();
    keys["shape_function"] = kind.word.into();
    if let Some(update) = kind.update {
        keys["domain_update"] = update.into();
    }
    let transfer = scene.transfer.kind.kind().word;
    refuse(transfer.is_empty(), "a transfer without a word")?;
    keys["transfer"] = transfer.into();
    if scene.transfer != Transfer::new(scene.transfer.kind) {
        keys["pic_fraction"] = scene.transfer.pic_fraction.into();
    }
    let (key, value, allow) = match scene.time_step {
        TimeStep::Automatic => return Ok(()),
        TimeStep::Fixed { dt, allow_unstable } => ("time_step", dt, allow_unstable),
        TimeStep::Multiplier {
            multiplier,
            allow_unstable,
        } => ("critical_time_step_multiplier", multiplier, allow_unstable),
    };
    keys[key] = value.into();
    if allow {
        keys["allow_unstable"] = true.into();
    }
    Ok(())
}

/// Each entry of a list, or the first that cannot be written.
fn list<T>(
    entries: &[T],
    write: impl Fn(&T) -> Result<Value, Omission>,
) -> Result<Vec<Value>, Omission> {
    entries.iter().map(write).collect()
}

fn materials(scene: &Scene) -> Result<Vec<Value>, Omission> {
    list(&scene.materials, |material| {
        let mut keys = law(&material.law)?;
        keys["id"] = material.id.into();
        keys["density"] = material.density.into();
        Ok(keys)
    })
}

/// Writes vectors of so many axes.
struct Writer(usize);

impl Writer {
    fn vector(&self, vector: &Vector) -> Value {
        vector[..self.0].to_vec().into()
    }

    fn mesh(&self, mesh: &Mesh) -> Value {
        let mut planes = Map::new();
        for (name, (axis, side)) in PLANES.iter().filter(|(_, (axis, _))| *axis < self.0) {
            let condition = word(PLANE_CONDITIONS, &mesh.planes[*axis][*side]);
            planes.insert(format!("plane_{name}"), condition.into());
        }
        let mut keys = json!({
            "cells_dimension": self.vector(&mesh.cell),
            "cells_number": mesh.cells[..self.0].to_vec(),
            "origin": self.vector(&mesh.origin),
            "boundary_conditions": planes,
        });
        if mesh.axisymmetric {
            keys["axisymmetric"] = true.into();
        }
        keys
    }

    fn body(&self, scene: &Scene, body: &Body) -> Result<Value, Omission> {
        let Shape::Cuboid { p1, p2 } = &body.shape else {
            return Err(Omission {
                what: format!("the shape of body {}", body.id),
            });
        };
        let material = scene.materials.get(body.material).map(|m| m.id);
        let mut keys = json!({
            "type": "cuboid", "id": body.id, "material_id": material, "point_p1": self.vector(p1),
            "point_p2": self.vector(p2), "particles_per_cell": body.particles_per_cell[..self.0].to_vec(),
            "initial_velocity": self.vector(&body.velocity),
        });
        if let Some(motion) = &body.motion {
            keys["prescribed_velocity"] = self.rows(motion);
        }
        match &body.initial_stress {
            InitialStress::None => {}
            InitialStress::Isotropic(value) => {
                keys["initial_stress"] = json!({ "type": "isotropic", "value": value });
            }
            InitialStress::AtRest {
                ratio,
                level,
                surcharge,
            } => {
                keys["initial_stress"] = json!({
                    "type": "at_rest", "ratio": ratio, "level": level, "surcharge": surcharge,
                });
            }
            InitialStress::Overburden(_) => refuse(true, "stress at rest below a surface")?,
        }
        Ok(keys)
    }

    /// Rows of a time and a vector.
    fn rows(&self, history: &History) -> Value {
        let rows = history.times.iter().zip(&history.values);
        rows.map(|(t, v)| [&[*t], &v[..self.0]].concat())
            .collect::<Vec<_>>()
            .into()
    }

    /// The entry of a base motion, and its record.
    fn base_motion(&self, base: &BaseMotion) -> (Value, String) {
        let (quantity, history) = match &base.motion {
            Motion::Acceleration(history) => ("acceleration", history),
            Motion::Velocity(history) => ("velocity", history),
        };
        let mut entry = json!({
            "active": true, "file": RECORD, "header": true, "quantity": quantity,
        });
        // The plane that is meant where none is named is left out: the manuals do not know the key.
        if (base.axis, base.side) != (self.0 - 1, 0) {
            entry["plane"] = word(PLANES, &(base.axis, base.side)).into();
        }
        (entry, self.record(history))
    }

    /// A record with a column per axis.
    fn record(&self, history: &History) -> String {
        let text = records::to_csv(history);
        if self.0 == Dimension::Three.axes() {
            return text;
        }
        let two = |line: &str| {
            let columns: Vec<&str> = line.split(',').take(1 + self.0).collect();
            columns.join(",") + "\n"
        };
        text.lines().map(two).collect()
    }
}

/// The keys of a law that a scene file names.
fn law(law: &AnyLaw) -> Result<Value, Omission> {
    let values: Vec<f64> = law
        .constants()
        .into_iter()
        .map(|(_, value)| value)
        .collect();
    let curves: Vec<laws::Rows> = law.curves().into_iter().map(|(_, rows)| rows).collect();
    // The words are not known to a law of any type: those are its own with which it reads the same.
    let found = laws::ALL.iter().find_map(|kind| {
        let of_kind = |words: &Vec<usize>| {
            kind.constants.len() == values.len() && (kind.read)(&values, words, &curves) == *law
        };
        Some((kind, choices_of(kind).into_iter().find(of_kind)?))
    });
    let Some((kind, words)) = found else {
        return Err(Omission {
            what: format!("the law {law:?}"),
        });
    };
    let mut keys = json!({ "type": kind.name });
    for (constant, value) in kind.constants.iter().zip(values) {
        keys[constant.key] = value.into();
    }
    for (curve, rows) in kind.curves.iter().zip(curves) {
        if !rows.is_empty() {
            keys[curve.key] = json!(rows);
        }
    }
    for (choice, word) in kind.choices.iter().zip(words) {
        if word > 0 {
            keys[choice.key] = match choice.words[word] {
                "true" => true.into(),
                word => word.into(),
            };
        }
    }
    Ok(keys)
}

/// All combinations of the words that a law may be given, those of its first words first.
fn choices_of(kind: &LawType) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for choice in kind.choices {
        all = (all.iter())
            .flat_map(|words: &Vec<usize>| {
                (0..choice.words.len()).map(|word| {
                    let mut words = words.clone();
                    words.push(word);
                    words
                })
            })
            .collect();
    }
    all
}
