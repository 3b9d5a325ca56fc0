//! Pore pressures at the start: of water at rest below a table, of materials, of boxes.

use crate::values::{InitialPressure, Scene};
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
                    let x = set.position(p);
                    let inside = (0..set.layout.axes).all(|axis| {
                        let x = x[axis] + scene.mesh.origin[axis];
                        p1[axis] <= x && x <= p2[axis]
                    });
                    if inside {
                        set.columns[column][p] = *pressure;
                    }
                }
            }
        }
    }
}
