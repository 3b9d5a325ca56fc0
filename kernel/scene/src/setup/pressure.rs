//! Pore pressures at the start.

use crate::values::{InitialPressure, Scene};
use proctor_kernel::particles::ParticleSet;

/// Gives the particles of a body the pore pressures of the start: those of its material, then those of boxes, in their order.
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
