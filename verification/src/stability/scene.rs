//! The limit of a scene that a user gives, what rules it, and what would allow more.

use proctor_scene::simulation::{Bound, Options};
use proctor_scene::{Scene, Transfer};

use super::StabilityError;
use super::frozen::fastest_wave;
use super::map::{SCHEMES, pairs};
use super::predicted::{Limit, predict};
use super::tension::TensionReport;
use crate::settings::Method;

/// Particles up to which other methods, other cells and single bodies are tried.
pub const MOST_PARTICLES: usize = 20_000;
/// Bodies up to which each is left out once.
const MOST_BODIES: usize = 12;
/// Factor that an alternative must allow to be worth a line.
const WORTH: f64 = 1.02;

/// Findings of a scene.
#[derive(Clone, Debug)]
pub struct Report {
    /// Method of the scene.
    pub method: Method,
    /// Number of particles.
    pub particles: usize,
    /// The predicted limit; `None` where nothing can become unstable.
    pub predicted: Option<Limit>,
    /// The step that the kernel takes first \[s\].
    pub dt: f64,
    /// The kernel's own bound \[s\].
    pub critical: f64,
    /// Bound that decided its step.
    pub bound: Bound,
    /// Alternatives that would allow a larger step, the largest first; `None` where the scene is too large to try.
    pub alternatives: Option<Vec<Alternative>>,
    /// Growth of a start in the tension that the scene will have; `None` where it will have none.
    pub tension: Option<TensionReport>,
}

/// A change, and the step that it would allow.
#[derive(Clone, Debug, PartialEq)]
pub struct Alternative {
    /// Setting that is changed.
    pub what: String,
    /// Predicted time step \[s\]; infinite where nothing could become unstable.
    pub dt: f64,
}

/// Method of a scene.
#[must_use]
pub fn method_of(scene: &Scene) -> Method {
    Method {
        weighting: scene.weighting,
        scheme: scene.scheme,
        transfer: scene.transfer.kind,
    }
}

/// Asks a scene.
///
/// # Errors
/// A scene that is refused, a first step that fails, or an iteration that does not come to an end.
pub fn ask(scene: &Scene) -> Result<Report, StabilityError> {
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = scene.simulate(&options)?;
    let particles = simulation.particles();
    // No output time shortens this step.
    let info = simulation.step(f64::INFINITY)?;
    let predicted = predict_fields(scene)?;
    let own = predicted.as_ref().map_or(f64::INFINITY, |limit| limit.dt);
    let alternatives = if particles > MOST_PARTICLES || !own.is_finite() {
        None
    } else {
        let mut all: Vec<Alternative> = changes(scene, predicted.as_ref())
            .into_iter()
            .filter_map(|(what, scene)| {
                // A change that this scene does not take is none.
                scene.check().ok()?;
                let limit = predict_fields(&scene).ok()?;
                let dt = limit.map_or(f64::INFINITY, |limit| limit.dt);
                (dt > WORTH * own).then_some(Alternative { what, dt })
            })
            .collect();
        all.sort_by(|a, b| b.dt.total_cmp(&a.dt));
        Some(all)
    };
    Ok(Report {
        method: method_of(scene),
        particles,
        predicted,
        dt: info.dt,
        critical: info.dt_critical,
        bound: info.bound,
        alternatives,
        tension: super::tension::ask(scene, info.dt)?,
    })
}

/// The smallest prediction of all velocity fields that contact may make: each body of a pair is taken alone, since it has
/// a field of its own beside its partner; the others are taken together.
///
/// # Errors
/// As [`predict`].
pub fn predict_fields(scene: &Scene) -> Result<Option<Limit>, StabilityError> {
    let pairs = scene.contacts.iter().flat_map(|c| [c.master, c.slave]);
    let boundaries = scene.mortar.boundaries.iter().map(|b| b.body);
    let alone: Vec<i64> = pairs.chain(boundaries).collect();
    let (single, together): (Vec<_>, Vec<_>) = scene
        .bodies
        .iter()
        .cloned()
        .partition(|body| alone.contains(&body.id));
    let mut groups: Vec<Vec<_>> = single.into_iter().map(|body| vec![body]).collect();
    if !together.is_empty() {
        groups.push(together);
    }
    let mut smallest: Option<Limit> = None;
    for bodies in groups {
        let mut part = without_loads(scene);
        part.bodies = bodies;
        if let Some(limit) = predict(&part)? {
            let smaller = smallest.as_ref().is_none_or(|s| limit.dt < s.dt);
            if smaller {
                smallest = Some(limit);
            }
        }
    }
    // Of the wave that is fastest in the whole scene, not in one of its parts.
    Ok(smallest.map(|mut limit| {
        limit.courant = limit.dt * fastest_wave(scene) / super::frozen::smallest_cell(scene);
        limit
    }))
}

/// Without what names bodies that may be left out.
fn without_loads(scene: &Scene) -> Scene {
    let mut part = scene.clone();
    part.contacts.clear();
    part.mortar = proctor_scene::Mortar::default();
    part.probes.clear();
    part.box_loads.clear();
    part.standing_waters.clear();
    part.surfaces.clear();
    part
}

/// The same scene with one thing changed each.
fn changes(scene: &Scene, ruled: Option<&Limit>) -> Vec<(String, Scene)> {
    let mut all = vec![];
    let own = method_of(scene);
    for (weighting, transfer) in pairs() {
        for scheme in SCHEMES {
            let method = Method {
                weighting,
                scheme,
                transfer,
            };
            let mut other = scene.clone();
            other.weighting = weighting;
            other.scheme = scheme;
            if transfer != own.transfer {
                other.transfer = Transfer::new(transfer);
            }
            if method.weighting_word() != own.weighting_word()
                || (scheme, transfer) != (own.scheme, own.transfer)
            {
                all.push((method.to_string(), other));
            }
        }
    }
    let axes = scene.dimension.axes();
    let mut coarse = scene.clone();
    for axis in 0..axes {
        coarse.mesh.cell[axis] *= 2.0;
        coarse.mesh.cells[axis] = coarse.mesh.cells[axis].div_ceil(2);
        for body in &mut coarse.bodies {
            body.particles_per_cell[axis] *= 2;
        }
    }
    all.push((
        "cells twice as large, the same particles".to_owned(),
        coarse,
    ));
    let mut coarser = scene.clone();
    for axis in 0..axes {
        coarser.mesh.cell[axis] *= 2.0;
        coarser.mesh.cells[axis] = coarser.mesh.cells[axis].div_ceil(2);
    }
    all.push((
        "cells twice as large, as many particles in each".to_owned(),
        coarser,
    ));
    if (2..=MOST_BODIES).contains(&scene.bodies.len()) {
        for i in 0..scene.bodies.len() {
            let mut fewer = without_loads(scene);
            let gone = fewer.bodies.remove(i);
            all.push((format!("without the body {}", gone.id), fewer));
        }
    }
    let ruler = ruled.and_then(|limit| scene.bodies.iter().find(|b| b.id == limit.ruler.body));
    if let Some(body) = ruler.filter(|_| scene.materials.len() > 1) {
        let material = &scene.materials[body.material];
        let mut heavier = scene.clone();
        heavier.materials[body.material].density *= 4.0;
        let what = format!("four times the density of the material {}", material.id);
        all.push((what, heavier));
    }
    all
}
