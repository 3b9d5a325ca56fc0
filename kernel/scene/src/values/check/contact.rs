//! Contact: bodies that exist, friction, each pair once, and no overlap at the start.

use super::collector::Collector;
use crate::values::Scene;
use proctor_contact::Contact;
use proctor_geometry::number::Number;
use proctor_kernel::model::{Shape, Vector};

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    if let Some(lambda) = scene.contact_distance {
        problems.not_negative(
            "contact_manager.real_distance_correction_coefficient",
            lambda,
        );
    }
    for (i, contact) in scene.contacts.iter().enumerate() {
        let path = format!("contact[{i}]");
        // Infinite friction is contact that never slips.
        if contact.friction.is_nan() || contact.friction < 0.0 {
            problems.add(
                format!("{path}.friction"),
                Number(contact.friction).to_string(),
                "a number, 0 or greater",
            );
        }
        if let Some(first) = scene.contacts[..i].iter().find(|c| c.id == contact.id) {
            problems.add(
                format!("{path}.id"),
                format!("{}, the id of {} too", contact.id, first.name),
                "an id that no other contact has",
            );
        }
        let known = check_bodies(scene, contact, &path, problems);
        let same = |c: &&Contact| {
            (c.master, c.slave) == (contact.master, contact.slave)
                || (c.slave, c.master) == (contact.master, contact.slave)
        };
        if contact.master == contact.slave {
            problems.add(
                format!("{path}.slave_id"),
                format!("{}, the master itself", contact.slave),
                "the id of another body",
            );
        } else if let Some(first) = scene.contacts[..i].iter().find(same) {
            problems.add(
                path,
                format!(
                    "the bodies {} and {}, the pair of {} too",
                    contact.master, contact.slave, first.name
                ),
                "each pair of bodies once, whichever is the master",
            );
        } else if known {
            check_overlap(scene, contact, &path, problems);
        }
    }
}

/// Checks that both bodies exist.
fn check_bodies(scene: &Scene, contact: &Contact, path: &str, problems: &mut Collector) -> bool {
    let mut known = true;
    for (key, id) in [("master_id", contact.master), ("slave_id", contact.slave)] {
        let rigid = (scene
            .mortar
            .lines
            .iter()
            .map(|line| (line.id, "a rigid line")))
        .chain((scene.mortar.facets.iter()).map(|facets| (facets.id, "a rigid surface")))
        .find(|(own, _)| *own == id);
        if let Some((_, what)) = rigid {
            problems.add(
                format!("{path}.{key}"),
                format!("{id}, {what}, in a contact on the grid, which only bodies have"),
                "`\"method\": \"mortar\"` beside it, with `critical_gap` and `normal_stiffness`; or the id of a body",
            );
            known = false;
        } else if !scene.bodies.iter().any(|b| b.id == id) {
            let ids: Vec<String> = scene.bodies.iter().map(|b| b.id.to_string()).collect();
            problems.add(
                format!("{path}.{key}"),
                format!("{id}, which no body has"),
                format!("the id of a body: {}", ids.join(", ")),
            );
            known = false;
        }
    }
    known
}

/// Overlap of boxes and balls, exactly; that of other shapes is looked for among the particles at set-up.
fn check_overlap(scene: &Scene, contact: &Contact, path: &str, problems: &mut Collector) {
    let shape = |id: i64| scene.bodies.iter().find(|b| b.id == id).map(|b| &b.shape);
    let (Some(a), Some(b)) = (shape(contact.master), shape(contact.slave)) else {
        return;
    };
    let axes = scene.dimension.axes();
    let Some((depth, at)) = overlap(a, b, axes) else {
        return;
    };
    let size = (0..axes)
        .map(|axis| scene.mesh.cell[axis])
        .fold(f64::INFINITY, f64::min);
    // Round-off of coordinates is no overlap.
    if depth > 1e-9 * size {
        problems.add(
            path,
            format!(
                "the bodies {} and {}, which overlap by {} m at {:?} m",
                contact.master,
                contact.slave,
                Number(depth),
                &at[..axes]
            ),
            "bodies that touch at most",
        );
    }
}

/// Depth of the overlap of two shapes and a point in it, where that is known in closed form.
fn overlap(a: &Shape, b: &Shape, axes: usize) -> Option<(f64, Vector)> {
    match (a, b) {
        (Shape::Cuboid { p1: a1, p2: a2 }, Shape::Cuboid { p1: b1, p2: b2 }) => {
            let mut depth = f64::INFINITY;
            let mut at = [0.0; 3];
            for axis in 0..axes {
                let (low, high) = (a1[axis].max(b1[axis]), a2[axis].min(b2[axis]));
                depth = depth.min(high - low);
                at[axis] = 0.5 * (low + high);
            }
            Some((depth, at))
        }
        (Shape::Cuboid { p1, p2 }, Shape::Sphere { center, radius })
        | (Shape::Sphere { center, radius }, Shape::Cuboid { p1, p2 }) => {
            let mut at = [0.0; 3];
            for axis in 0..axes {
                // A corner that is missing is not a number, which `clamp` does not take.
                at[axis] = center[axis].max(p1[axis]).min(p2[axis].max(p1[axis]));
            }
            Some((radius - distance(&at, center), at))
        }
        (
            Shape::Sphere {
                center: a,
                radius: r,
            },
            Shape::Sphere {
                center: b,
                radius: s,
            },
        ) => {
            let between = distance(a, b);
            let share = if between > 0.0 { r / between } else { 0.0 };
            let at = std::array::from_fn(|axis| a[axis] + share * (b[axis] - a[axis]));
            Some((r + s - between, at))
        }
        _ => None,
    }
}

fn distance(a: &Vector, b: &Vector) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}
