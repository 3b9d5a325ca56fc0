//! Bodies of all kinds that move, meet and rebound, for comparisons of two runs.

use proctor_scene::{
    Body, BoxLoad, Contact, ContactNormal, Damping, Dimension, DomainUpdate, InitialStress,
    Material, Mesh, PlaneCondition, Scene, StressScheme, Transfer, TransferKind, Vector, Weighting,
};

use super::dice::Dice;
use super::law;
use crate::cases::{NO_RESULTS, body, cuboid};

/// Weighting functions. Linear ones are not among them: a particle on a line of the mesh has one gradient on its left and
/// another on its right, so that round-off of a position decides ("Known limits" of the kernel).
const WEIGHTINGS: [Weighting; 5] = [
    Weighting::UniformGimp,
    Weighting::ContiguousGimp(DomainUpdate::Determinant),
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
    Weighting::ContiguousGimp(DomainUpdate::LeftStretch),
    Weighting::QuadraticBSpline,
];

/// Schemes.
pub const SCHEMES: [StressScheme; 3] = [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf];

/// Normals of contact on the grid.
pub const NORMALS: [ContactNormal; 3] = [
    ContactNormal::Master,
    ContactNormal::Slave,
    ContactNormal::Collinear,
];

/// The choices of a crowd.
#[derive(Clone, Copy, Debug)]
pub struct CrowdChoices {
    /// Conditions on the planes of the mesh, gravity, loads and damping. Without them momentum is kept.
    pub outside: bool,
    /// Damping whose force jumps where a velocity or the growth of the energy changes its sign, and so with round-off.
    pub jumps: bool,
    /// Bodies that are to meet at all.
    pub meet: bool,
    /// Law of each body: any, or elastic alone.
    pub laws: bool,
}

/// All that there is.
pub const ALL: CrowdChoices = CrowdChoices {
    outside: true,
    jumps: true,
    meet: true,
    laws: true,
};

/// Cells that no body reaches around the row of bodies.
const MARGIN: usize = 4;

/// Bodies in a row along an axis.
pub fn scene(dice: &mut Dice, allowed: CrowdChoices) -> Scene {
    let dimension = dimension(dice);
    let axes = dimension.axes();
    let edge = dice.cell();
    let mut cell = [edge; 3];
    if dice.chance(0.3) {
        cell = cell.map(|c| c * dice.between(0.7, 1.4));
    }
    let count = dice.whole(1, 3);
    let most = if axes == 2 { 4.0 } else { 2.5 };
    let row = dice.whole(0, axes - 1);
    let mut next = MARGIN as f64 + dice.place();
    let (mut low, mut high) = (vec![], vec![]);
    let mut cells = [1; 3];
    for _ in 0..count {
        let (mut p1, mut p2) = ([0.0; 3], [0.0; 3]);
        for axis in 0..axes {
            let size = if dice.chance(0.3) {
                dice.whole(1, most as usize) as f64
            } else {
                dice.between(1.1, most)
            };
            let from = if axis == row {
                next
            } else {
                MARGIN as f64 + dice.whole(0, 1) as f64 + dice.place()
            };
            (p1[axis], p2[axis]) = (from, from + size);
            cells[axis] = cells[axis].max((from + size).ceil() as usize + MARGIN);
        }
        // Bodies that touch to the bit approach each other in the first step or in the second, as round-off decides: a gap is
        // a gap.
        next = p2[row] + dice.between(0.05, 0.6);
        low.push(p1);
        high.push(p2);
    }
    let origin = std::array::from_fn(|axis| {
        let cells = dice.pick(&[0.0, 0.0, -3.0, 17.0]) + dice.pick(&[0.0, 0.37]);
        if axis < axes { cells * cell[axis] } else { 0.0 }
    });
    let mesh = Mesh::new(dimension, origin, cell, cells);
    let mut scene = Scene::new(dimension, mesh, 1.0).with_planes(PlaneCondition::Free);
    scene.results = NO_RESULTS;
    method(dice, &mut scene);

    let young = dice.decades(1e3, 1e8);
    let density = dice.decades(10.0, 5e3);
    let shortest = cell[..axes].iter().fold(f64::INFINITY, |a, b| a.min(*b));
    for index in 0..count {
        let contrast = [dice.decades(0.1, 10.0), dice.decades(0.2, 5.0)];
        let (young, density) = (young * contrast[0], density * contrast[1]);
        let law = if allowed.laws {
            law::any(dice, young, density, shortest)
        } else {
            law::elastic(dice, young)
        };
        scene.materials.push(Material {
            name: format!("material {index}"),
            id: index as i64 + 1,
            density,
            law,
        });
    }
    let speeds: Vec<f64> = (scene.materials.iter())
        .map(|material| material.law.wave_speed(material.density))
        .collect();
    let fastest = speeds.iter().fold(0.0_f64, |a, b| a.max(*b));
    let slowest = speeds.iter().fold(f64::INFINITY, |a, b| a.min(*b));
    // Some tens of steps.
    scene.time = dice.between(8.0, 16.0) * shortest / fastest;
    let mach = dice.decades(0.01, 0.2);
    for index in 0..count {
        let at = |p: &Vector| std::array::from_fn(|a| origin[a] + p[a] * cell[a]);
        let mut own = body_of(dice, &scene, index, at(&low[index]), at(&high[index]));
        if allowed.meet || index == 0 {
            // Towards the middle of the row, and a little aside.
            let towards = 1.0 - 2.0 * index as f64 / (count as f64 - 1.0).max(1.0);
            for axis in 0..axes {
                let aside = dice.between(-0.3, 0.3);
                own.velocity[axis] =
                    mach * slowest * (aside + if axis == row { towards } else { 0.0 });
            }
        } else {
            own.velocity = scene.bodies[0].velocity;
        }
        scene.bodies.push(own);
    }
    contacts(dice, &mut scene);
    if allowed.outside {
        outside(dice, &mut scene, allowed, mach * slowest);
    }
    scene
}

/// Two dimensions more often than three, which take longer.
pub fn dimension(dice: &mut Dice) -> Dimension {
    if dice.chance(0.7) {
        Dimension::Two
    } else {
        Dimension::Three
    }
}

/// Weighting function, scheme and transfer.
fn method(dice: &mut Dice, scene: &mut Scene) {
    scene.weighting = dice.pick(&WEIGHTINGS);
    scene.scheme = dice.pick(&SCHEMES);
    scene.transfer =
        Transfer::new(dice.pick(&[TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic]));
    if scene.transfer.kind == TransferKind::Flip {
        scene.transfer.pic_fraction = dice.pick(&[0.0, 0.01, 0.25, 1.0]);
    }
}

/// A body of the material of its number.
fn body_of(dice: &mut Dice, scene: &Scene, index: usize, p1: Vector, p2: Vector) -> Body {
    let axes = scene.dimension.axes();
    let mut own = body(format!("body {index}"), index as i64 + 1, cuboid(p1, p2));
    own.material = index;
    own.particles_per_cell[..axes].fill(dice.pick(&[2, 2, if axes == 2 { 3 } else { 2 }]));
    let law = &scene.materials[index].law;
    // A law whose stress follows from its deformation begins without any.
    if dice.chance(0.2) && !law.needs_deformation() && !law.is_fluid() {
        own.initial_stress = InitialStress::Isotropic(-dice.decades(1e-5, 1e-3) * law.young());
    }
    own
}

/// Contact between neighbours, of some.
fn contacts(dice: &mut Dice, scene: &mut Scene) {
    for index in 1..scene.bodies.len() {
        if !dice.chance(0.7) {
            continue;
        }
        let mut ends = [scene.bodies[index - 1].id, scene.bodies[index].id];
        if dice.chance(0.5) {
            ends.reverse();
        }
        scene.contacts.push(Contact {
            name: format!("contact {index}"),
            id: index as i64,
            friction: dice.pick(&[0.0, 0.2, 0.5, 1.5]),
            master: ends[0],
            slave: ends[1],
            normal: dice.pick(&NORMALS),
        });
    }
}

/// Gravity, planes, loads and damping; `speed` \[m/s\] bounds their changes of velocity.
fn outside(dice: &mut Dice, scene: &mut Scene, allowed: CrowdChoices, speed: f64) {
    let axes = scene.dimension.axes();
    if dice.chance(0.5) {
        scene.gravity[axes - 1] = -dice.between(0.2, 1.0) * speed / scene.time;
        if dice.chance(0.3) {
            scene.gravity[0] = dice.between(-0.5, 0.5) * speed / scene.time;
        }
    }
    for axis in 0..axes {
        for side in 0..2 {
            scene.mesh.planes[axis][side] = dice.pick(&[
                PlaneCondition::Free,
                PlaneCondition::Sliding,
                PlaneCondition::Fixed,
                PlaneCondition::Antisymmetric,
            ]);
        }
    }
    // Bodies that begin on a plane, as the margin goes.
    if dice.chance(0.4) {
        let axis = dice.whole(0, axes - 1);
        scene.mesh.origin[axis] += MARGIN as f64 * scene.mesh.cell[axis];
        scene.mesh.cells[axis] -= MARGIN;
        scene.mesh.planes[axis][0] = dice.pick(&[PlaneCondition::Sliding, PlaneCondition::Fixed]);
    }
    if dice.chance(0.3) {
        let index = dice.whole(0, scene.bodies.len() - 1);
        let (p1, p2) = corners(&scene.bodies[index]);
        let volume: f64 = (0..axes).map(|a| p2[a] - p1[a]).product();
        let mass = volume * scene.materials[index].density;
        let mut force = [0.0; 3];
        for axis in 0..axes {
            force[axis] = dice.between(-0.5, 0.5) * mass * speed / scene.time;
        }
        scene.box_loads.push(BoxLoad { p1, p2, force });
    }
    scene.damping = match dice.whole(0, 5) {
        0 => Damping::Viscous {
            alpha: dice.between(0.01, 0.3),
        },
        1 if allowed.jumps => Damping::Local {
            alpha: dice.between(0.05, 0.8),
        },
        2 if allowed.jumps && scene.scheme == StressScheme::Usl => Damping::Kinetic,
        _ => Damping::None,
    };
}

/// Corners of the cuboid that a body is.
pub fn corners(body: &Body) -> (Vector, Vector) {
    match body.shape {
        proctor_scene::Shape::Cuboid { p1, p2 } => (p1, p2),
        _ => unreachable!("a cuboid"),
    }
}
