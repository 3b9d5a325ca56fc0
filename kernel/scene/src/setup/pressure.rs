//! Pore pressures that are given: of water at rest below a table, of materials, of boxes; and those that are held.

use super::rank_part::RankPart;
use crate::values::{HeldPressure, InitialPressure, Scene};
use proctor_kernel::model::Vector;
use proctor_kernel::particles::ParticleSet;

/// Gives the particles of a body the pore pressures of the start: those that are given, in their order.
pub(super) fn set(set: &mut ParticleSet, scene: &Scene, body: usize) {
    let Some(column) = set.layout.pore_pressure() else {
        return;
    };
    let material = &scene.materials[scene.bodies[body].material];
    for given in &scene.initial_pressures {
        match given {
            InitialPressure::Material { id, pressure } if *id == material.id => {
                set.columns[column].fill(*pressure);
            }
            InitialPressure::Material { .. } => {}
            InitialPressure::Table { level } => {
                let water = scene.water_of(scene.bodies[body].material);
                let density = water.map_or(0.0, |water| water.density);
                for p in 0..set.len() {
                    let x = set.position(p);
                    // Gravity has one component; water stands where it points to.
                    let below = |axis: usize| {
                        let depth = level - (x[axis] + scene.mesh.origin[axis]);
                        -scene.gravity[axis] * depth
                    };
                    let weight: f64 = (0..set.layout.axes).map(below).sum();
                    set.columns[column][p] = density * weight.max(0.0);
                }
            }
            InitialPressure::Box { p1, p2, pressure } => {
                for p in 0..set.len() {
                    if lies_in(set, p, scene, [p1, p2]) {
                        set.columns[column][p] = *pressure;
                    }
                }
            }
        }
    }
}

/// Holds the pore pressure of all particles in a box.
///
/// # Errors
/// No particle lies in the box.
pub(super) fn hold(
    held: &HeldPressure,
    scene: &Scene,
    sets: &mut [ParticleSet],
    part: Option<&RankPart>,
) -> Result<(), String> {
    let corners = [&held.p1, &held.p2];
    let mut count = 0.0;
    for set in sets {
        let (Some(pressure), Some(first)) = (set.layout.pore_pressure(), set.layout.held_pressure)
        else {
            continue;
        };
        let inside = (0..set.len()).filter(|&p| lies_in(set, p, scene, corners));
        let inside: Vec<usize> = inside.collect();
        for &p in &inside {
            set.columns[pressure][p] = held.pressure;
            set.columns[first][p] = 0.0;
        }
        let add = |count: f64| count + inside.len() as f64;
        count = match part {
            None => add(count),
            Some(part) => part.in_turn(count, add),
        };
    }
    if count > 0.0 {
        Ok(())
    } else {
        Err(no_particle(corners))
    }
}

/// True if the centre of a particle lies in a box.
pub(super) fn lies_in(set: &ParticleSet, p: usize, scene: &Scene, [p1, p2]: [&Vector; 2]) -> bool {
    let x = set.position(p);
    (0..set.layout.axes).all(|axis| {
        let x = x[axis] + scene.mesh.origin[axis];
        p1[axis] <= x && x <= p2[axis]
    })
}

/// The words for a box without particles.
pub(super) fn no_particle([p1, p2]: [&Vector; 2]) -> String {
    format!("no particle lies in the box {p1:?} to {p2:?} m")
}
