//! Strain that can be foreseen to be too large for incremental elasticity.

use super::places::{free_box, from_plane, gap, name};
use crate::values::{Body, Scene};
use proctor_kernel::model::Vector;

/// Strain that is foreseen over the largest of the law, from which a run will be off by more than a few percent: what it
/// strains is known to a third.
const LARGE: f64 = 1.5;

/// A strain, and the words for where it comes from.
type Part = (f64, String);

/// Bodies of incremental elasticity that will strain too far for it, by a fall, a blow, their weight or a load on them.
///
/// A bar of speed v that is stopped strains by v/c, one that stands by rho g L/E, one with a load by that over E.
pub(super) fn large_strain(scene: &Scene) -> Vec<String> {
    let of = |body: &Body| {
        let material = scene.materials.get(body.material)?;
        let range = material.law.strain_range()?;
        let bounds = free_box(body)?;
        let (young, density) = (material.law.young(), material.density);
        let large = LARGE * range.most_volume_change;
        let mut parts = vec![blow(scene, body, &bounds, (young / density).sqrt())];
        parts.extend(weight(scene, &bounds, density, young));
        parts.push(load(scene, &bounds, young));
        // Less is part of any strain that waves carry.
        parts.retain(|(strain, _)| *strain > 0.1 * large);
        let strain: f64 = parts.iter().map(|(strain, _)| strain).sum();
        let words: Vec<String> = parts.into_iter().map(|(_, words)| words).collect();
        (strain > large).then(|| {
            format!(
                "{}: strains of about {strain:.2} are to be expected ({}); `elastic` adds up increments of stress and has no energy \
                 there, so that it does not give back the energy that it took; `neo_hookean` and `hencky` have one",
                name(body),
                words.join(", ")
            )
        })
    };
    scene.bodies.iter().filter_map(of).collect()
}

/// The axis of gravity, and the side to which it pulls; `None` where it acts along several axes, as on an incline, on which
/// bodies slide or roll.
fn down(scene: &Scene) -> Option<(usize, usize)> {
    let mut acting = (0..scene.dimension.axes()).filter(|axis| scene.gravity[*axis] != 0.0);
    match (acting.next(), acting.next()) {
        (Some(axis), None) => Some((axis, usize::from(scene.gravity[axis] > 0.0))),
        _ => None,
    }
}

/// Distance that a body can fall: to a plane that stops it, or to a body below \[m\].
fn fall(scene: &Scene, body: &Body, bounds: &[Vector; 2]) -> Option<f64> {
    let (axis, side) = down(scene)?;
    let stops = scene.mesh.planes[axis][side].prescribes(axis, axis);
    let plane = stops.then(|| from_plane(scene, bounds, axis, side).max(0.0));
    let under = |other: &Body| {
        let below = other.shape.bounds()?;
        let across = (0..scene.dimension.axes()).filter(|across| *across != axis);
        let beneath = across
            .into_iter()
            .all(|across| gap(bounds, &below, across) < 0.0);
        let way = if side == 0 {
            bounds[0][axis] - below[1][axis]
        } else {
            below[0][axis] - bounds[1][axis]
        };
        // What overlaps in height is beside it, but for round-off of bodies that rest on each other.
        (other.id != body.id && beneath && way > -0.5 * scene.mesh.cell[axis]).then(|| way.max(0.0))
    };
    let others = scene.bodies.iter().filter_map(under);
    others.chain(plane).reduce(f64::min)
}

/// The strain of a body that is stopped, by the speed that it begins with or falls to.
fn blow(scene: &Scene, body: &Body, bounds: &[Vector; 2], wave_speed: f64) -> Part {
    let axes = scene.dimension.axes();
    let square = |v: &Vector| v.iter().map(|c| c * c).sum::<f64>();
    let planes = (0..axes).any(|axis| [0, 1].iter().any(|side| scene.plane_acts(axis, *side)));
    let meets = scene.bodies.len() > 1 || planes || !scene.surfaces.is_empty();
    let begins = if meets { square(&body.velocity) } else { 0.0 };
    let height = fall(scene, body, bounds).unwrap_or(0.0);
    let speed = (begins + 2.0 * square(&scene.gravity).sqrt() * height).sqrt();
    let strain = speed / wave_speed;
    (strain, format!("stopped from {speed:.3} m/s: {strain:.2}"))
}

/// The strain under its own weight of a body that rests on something.
fn weight(scene: &Scene, bounds: &[Vector; 2], density: f64, young: f64) -> Option<Part> {
    let (axis, _) = down(scene)?;
    let held = [0, 1]
        .iter()
        .any(|side| scene.mesh.planes[axis][*side].prescribes(axis, axis));
    let height = bounds[1][axis] - bounds[0][axis];
    let strain = density * scene.gravity[axis].abs() * height / young;
    held.then(|| (strain, format!("its own weight: {strain:.2}")))
}

/// The strain under box loads and tractions that lie on a body.
fn load(scene: &Scene, bounds: &[Vector; 2], young: f64) -> Part {
    let axes = scene.dimension.axes();
    let on = |p1: &Vector, p2: &Vector| (0..axes).all(|axis| gap(bounds, &[*p1, *p2], axis) <= 0.0);
    let boxes = scene
        .box_loads
        .iter()
        .filter(|load| on(&load.p1, &load.p2))
        .map(|load| {
            let common = |axis: usize| {
                load.p2[axis].min(bounds[1][axis]) - load.p1[axis].max(bounds[0][axis])
            };
            let along = |axis: usize| {
                let across = (0..axes).filter(|other| *other != axis).map(common);
                load.force[axis].abs() / across.product::<f64>()
            };
            (0..axes).map(along).fold(0.0, f64::max)
        });
    let tractions = scene
        .tractions
        .iter()
        .filter(|load| on(&load.p1, &load.p2))
        .map(|load| {
            let values = load.traction.values.iter().flatten();
            values.fold(0.0_f64, |most, t| most.max(t.abs()))
        });
    let most = boxes
        .chain(tractions)
        .filter(|stress| stress.is_finite())
        .fold(0.0, f64::max);
    let strain = most / young;
    (strain, format!("loads on it: {strain:.2}"))
}
