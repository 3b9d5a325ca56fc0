//! Warnings of the plan: scenes that are allowed but have a known error.

use crate::values::{Body, MOST_CREEP, Material, Scene};
use proctor_contact::MortarContact;
use proctor_kernel::model::{Damping, StressScheme, Transfer, TransferKind, VolumetricStrain};

mod beside;
mod between;
mod coarse;
mod driven;
mod ground;
mod layer;
mod light;
mod places;
mod resting;
mod rows;
mod sides;
mod strain;
mod water;

/// Normal stiffness times cell over Young's modulus above which the layer of a mortar contact is stiffer than the cells
/// behind it.
const STIFFEST: f64 = 10.0;

/// Poisson's ratio above which strain at the particles locks.
const LOCKS: f64 = 0.49;

/// Warnings about a scene, each with its reason.
pub(super) fn warnings(scene: &Scene) -> Vec<String> {
    let mut all = locking(scene);
    all.extend(stiff_contacts(scene));
    all.extend(creeping_contacts(scene));
    all.extend(gains_in_turns(scene));
    all.extend(compressed_by_speed(scene));
    all.extend(sides::held_by_sides(scene));
    all.extend(sides::pressed(scene));
    all.extend(sides::sink_through_dashpots(scene));
    all.extend(sides::carried_by_sides(scene));
    all.extend(beside::stiff_beside_soft(scene));
    all.extend(beside::inside_cells(scene));
    all.extend(layer::layers_off(scene));
    all.extend(rows::uneven(scene));
    all.extend(light::on_lines(scene));
    all.extend(light::at_sides(scene));
    all.extend(light::swings(scene));
    all.extend(between::at_nodes(scene));
    all.extend(coarse::collide_on_few_cells(scene));
    all.extend(driven::hold_nodes(scene));
    all.extend(ground::overlaps(scene));
    all.extend(strain::large_strain(scene));
    all.extend(water::shut_in(scene));
    all.extend(super::tension::warnings(scene));
    for material in &scene.materials {
        let own = material.law.warnings().into_iter();
        all.extend(own.map(|warning| format!("{}: {warning}", material.name)));
    }
    all
}

/// Share of PIC above which velocities are smoothed enough that FLIP is FLIP no more.
const HARDLY_PIC: f64 = 0.01;

/// FLIP with strains before the forces of a second mapping, where nothing takes the energy that a turning body gains.
/// `kernel/tests/physics/rotation.rs` has the figures.
fn gains_in_turns(scene: &Scene) -> Option<String> {
    let Transfer { kind, pic_fraction } = scene.transfer;
    let damped = match scene.damping {
        Damping::None => false,
        Damping::Local { alpha } | Damping::Viscous { alpha } => alpha != 0.0,
        Damping::Kinetic => true,
    };
    (kind == TransferKind::Flip
        && pic_fraction < HARDLY_PIC
        && scene.scheme == StressScheme::Usf
        && !damped)
        .then(|| {
            "FLIP with USF: a body that turns gains energy, 61 % of its kinetic energy in three turns with uGIMP and 3 x 3 \
             particles per cell, 7 % with B-splines; APIC and TPIC do not gain, nor does FLIP with USL"
                .to_owned()
        })
}

/// Speed of sound over that of a flow below which the density of a fluid changes by more than one percent.
const HARDLY_COMPRESSED: f64 = 10.0;

/// Fluids that begin so fast that they are not nearly incompressible: the density changes by half of (v/c)².
fn compressed_by_speed(scene: &Scene) -> Vec<String> {
    let of = |body: &Body| {
        let material = scene.materials.get(body.material)?;
        let sound = material.law.wave_speed(material.density);
        let speed = body.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        (material.law.is_fluid() && sound < HARDLY_COMPRESSED * speed).then(|| {
            format!(
                "{}: sound runs at {sound:.3} m/s in {}, less than {HARDLY_COMPRESSED} times as fast as the body at {speed:.3} \
                 m/s: its density changes by more than one percent",
                body.name, material.name
            )
        })
    };
    scene.bodies.iter().filter_map(of).collect()
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
                 it, and details smaller than the gap are blurred"
            ));
        }
        let softest = scene.softest(contact).unwrap_or(f64::INFINITY);
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

/// Contacts whose tangential spring lets a round body roll less far than it should.
fn creeping_contacts(scene: &Scene) -> Vec<String> {
    let of = |contact: &MortarContact| {
        let creep = scene.rolling_creep(contact)?;
        let usual = scene.usual_tangential_stiffness(contact)?;
        (creep > MOST_CREEP * (1.0 + 1e-9)).then(|| {
            format!(
                "{}: the tangential spring lets a round body lag behind the way that it rolls by up to {:.2} %, as traction \
                 builds up along the contact; {usual:.3e} Pa/m keep it within {} %",
                contact.name,
                100.0 * creep,
                100.0 * MOST_CREEP
            )
        })
    };
    scene.mortar.contacts.iter().filter_map(of).collect()
}
