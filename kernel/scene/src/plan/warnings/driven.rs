//! Driven bodies that move and act at nodes.

use super::places::{free_box, gap, name};
use crate::values::{Body, Scene};
use proctor_kernel::model::StressScheme;

/// Driven bodies that move beside a free body and prescribe the velocity of each node that they reach: those without a contact, and
/// all with USF.
///
/// A face within a cell then holds what lies up to a cell beyond it, so that a bar between such grips is as stiff as a shorter one.
/// Where a body stands still, or pushes in contact with USL or MUSL, its shape acts (`kernel/tests/physics/driven_shapes.rs`). A
/// shape that moves and is bonded to what it moves would take energy from it, with MUSL 9 % of the work on a bar.
pub(super) fn hold_nodes(scene: &Scene) -> Vec<String> {
    let axes = scene.dimension.axes();
    let moves = |body: &&Body| {
        let motion = body.motion.iter().flat_map(|motion| &motion.values);
        motion.into_iter().any(|v| *v != [0.0; 3])
    };
    let of = |driven: &Body| {
        let bounds = driven.shape.bounds()?;
        let is_near = |other: &&Body| {
            free_box(other).is_some_and(|near| {
                (0..axes).all(|axis| gap(&bounds, &near, axis) < scene.mesh.cell[axis])
            })
        };
        let held = |other: &&Body| {
            let meet = |master: i64, slave: i64| {
                [(master, slave), (slave, master)].contains(&(driven.id, other.id))
            };
            let on_grid = scene.contacts.iter().any(|c| meet(c.master, c.slave));
            let mortar = (scene.mortar.contacts.iter()).any(|c| meet(c.master, c.slave));
            !mortar && (!on_grid || scene.scheme == StressScheme::Usf)
        };
        let other = scene.bodies.iter().filter(is_near).find(held)?;
        let instead = if scene.scheme == StressScheme::Usf {
            "a contact with USL or MUSL"
        } else {
            "a contact"
        };
        Some(format!(
            "{}: it moves and prescribes the velocity of each node that it reaches, up to a cell beyond its faces: {} is held \
             there as well, and is as stiff as a body that is shorter by that much; {instead} acts where the faces are, and half \
             the cell halves what is held",
            name(driven),
            name(other)
        ))
    };
    scene.bodies.iter().filter(moves).filter_map(of).collect()
}
