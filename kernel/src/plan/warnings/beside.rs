//! Stiff bodies beside soft ones on common nodes.

use super::places::{free_box, gap, name};
use crate::scene::{Body, Scene};

/// Ratio of confined moduli from which the stress of the rows at an interface is far off.
const CONTRAST: f64 = 10.0;

/// Pairs of bodies that meet on common nodes, in contact on the grid or without any, of which one is much stiffer.
///
/// Under one pressure q along the normal, in two halves of a column with uGIMP and 2 x 2 particles per cell, the row of
/// particles on the soft side of the interface has 1.00, 0.95, 0.87, 0.73 of q for ratios of 3, 10, 30, 100, the two rows on
/// the stiff side 1.08 and 0.93, 1.40 and 0.69, 2.03 and 0.20, 3.17 and -0.70; h/2 gives the same rows. With mortar contact the
/// soft side has 1.00 and 0.99 at 10 and at 100 alike (`kernel/tests/plan/foreseen.rs` has such a column).
pub(super) fn stiff_beside_soft(scene: &Scene) -> Vec<String> {
    let axes = scene.dimension.axes();
    let stiffness = |body: &Body| {
        let material = scene.materials.get(body.material)?;
        let confined = material.density * material.law.wave_speed(material.density).powi(2);
        (!material.law.is_fluid()).then_some(confined)
    };
    let mortar = |a: &Body, b: &Body| {
        let pair =
            |master: i64, slave: i64| [(a.id, b.id), (b.id, a.id)].contains(&(master, slave));
        scene
            .mortar
            .contacts
            .iter()
            .any(|contact| pair(contact.master, contact.slave))
    };
    let mut all = vec![];
    for (i, a) in scene.bodies.iter().enumerate() {
        for b in &scene.bodies[i + 1..] {
            let (Some(box_a), Some(box_b)) = (free_box(a), free_box(b)) else {
                continue;
            };
            let near = (0..axes).all(|axis| gap(&box_a, &box_b, axis) < scene.mesh.cell[axis]);
            let (Some(of_a), Some(of_b)) = (stiffness(a), stiffness(b)) else {
                continue;
            };
            let ratio = (of_a / of_b).max(of_b / of_a);
            if !near || ratio < CONTRAST * (1.0 - 1e-9) || mortar(a, b) {
                continue;
            }
            let (stiff, soft) = if of_a > of_b { (a, b) } else { (b, a) };
            all.push(format!(
                "{} is {ratio:.3} times as stiff as {}, and both meet on common nodes: the rows of particles beside the interface \
                 carry a stress that is off, on smaller cells alike. Of one pressure the two rows on the stiff side have 1.40 \
                 and 0.69 at a ratio of 10, 3.17 and -0.70 at 100, the row on the soft side 0.95 and 0.73; two cells away it is \
                 right within 3 %. Mortar contact (\"method\": \"mortar\", \"boundary_follows\": \"material\") keeps the soft side \
                 within 1 %, whatever the ratio",
                name(stiff),
                name(soft)
            ));
        }
    }
    all
}
