//! What a scene may do, but not well.

use crate::scene::Scene;

/// Normal stiffness times cell over Young's modulus above which the layer of a mortar contact is stiffer than the cells
/// behind it.
const STIFFEST: f64 = 10.0;

/// Warnings about the contacts of a scene, each with its reason.
pub(super) fn warnings(scene: &Scene) -> Vec<String> {
    let axes = &scene.mesh.cell[..scene.dimension.axes()];
    let cell = axes.iter().copied().fold(f64::INFINITY, f64::min);
    let mut all = vec![];
    for contact in &scene.mortar.contacts {
        let name = &contact.name;
        let gap = contact.critical_gap;
        if gap > cell {
            all.push(format!(
                "{name}: the critical gap of {gap} m is larger than a cell, {cell} m; the surfaces press on each other across \
                 it, and what is smaller than the gap is blurred"
            ));
        }
        let ends = [contact.master, contact.slave];
        let softest = scene
            .bodies
            .iter()
            .filter(|body| ends.contains(&body.id) && body.motion.is_none())
            .map(|body| scene.materials[body.material].law.young())
            .fold(f64::INFINITY, f64::min);
        let ratio = contact.normal_stiffness * cell / softest;
        if ratio > STIFFEST {
            all.push(format!(
                "{name}: normal stiffness times cell over Young's modulus is {ratio}, above {STIFFEST}; vertices that share \
                 nodes then press in turn, and the pressure oscillates along the surface; {} Pa/m is as stiff as the cells \
                 resolve",
                STIFFEST * softest / cell
            ));
        }
    }
    all
}
