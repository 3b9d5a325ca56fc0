//! What a scene may do, but not well.

use crate::scene::{Material, Scene, VolumetricStrain};

/// Normal stiffness times cell over Young's modulus above which the layer of a mortar contact is stiffer than the cells
/// behind it.
const STIFFEST: f64 = 10.0;

/// Poisson's ratio above which strain at the particles locks.
const LOCKS: f64 = 0.49;

/// Warnings about a scene, each with its reason.
pub(super) fn warnings(scene: &Scene) -> Vec<String> {
    let mut all = locking(scene);
    all.extend(stiff_contacts(scene));
    all
}

/// Materials so nearly incompressible that their bodies do not bend and settle as they should.
fn locking(scene: &Scene) -> Vec<String> {
    if scene.volumetric_strain == VolumetricStrain::CellAverage {
        return vec![];
    }
    let of = |material: &Material| {
        let density = 1.0;
        let confined = density * material.law.wave_speed(density).powi(2);
        let poisson = poisson(confined / material.law.young());
        // Round-off of the wave speed is no reason to warn of 0.49 itself.
        (poisson > LOCKS * (1.0 + 1e-9)).then(|| {
            format!(
                "{}: Poisson's ratio is {poisson:.6}, above {LOCKS}; with the volumetric strain of each particle such material \
                 locks: it settles and bends too little; \"volumetric_strain\": \"cell_average\" does not lock",
                material.name
            )
        })
    };
    scene.materials.iter().filter_map(of).collect()
}

/// Poisson's ratio from the confined modulus over Young's modulus, (1 - nu)/((1 + nu)(1 - 2 nu)), of an isotropic material;
/// 0 where it would be negative.
fn poisson(confined: f64) -> f64 {
    let excess = (confined - 1.0).max(0.0);
    ((excess * excess + 8.0 * confined * excess).sqrt() - excess) / (4.0 * confined)
}

/// Contacts that are stiffer than what they meet.
fn stiff_contacts(scene: &Scene) -> Vec<String> {
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
        let softest = scene
            .softest([contact.master, contact.slave])
            .unwrap_or(f64::INFINITY);
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
