//! Bonds: driven bodies, of which no contact is given, hold the particles that touch them.
//!
//! Bodies without contact share one velocity where they share a node. A driven body that prescribes it at the nodes holds all
//! that lies up to a cell beyond its faces, unless they lie on lines of the mesh. Elsewhere its shape holds the particles that
//! touch it, at the points where they touch, against pressure, tension and sliding: a pair whose bound is an equation.

use super::acts_by_shape;
use crate::contact::Pair;
use crate::scene::{ContactNormal, Scene, Shape, Vector};
use crate::simulation::BodyRun;
use crate::weights::{Family, ROUND_OFF};

/// The bonds of a scene.
pub(super) fn all<'a>(scene: &'a Scene, bodies: &'a [BodyRun]) -> impl Iterator<Item = Pair> + 'a {
    let driven = (0..bodies.len())
        .filter(|&b| bodies[b].motion.is_some() && acts_by_shape(scene, bodies, b));
    driven.flat_map(move |master| {
        let partners =
            (0..bodies.len()).filter(move |&slave| is_bonded(scene, bodies, [master, slave]));
        partners.map(move |slave| bond(bodies, [master, slave]))
    })
}

/// Whether a driven body holds another by its shape.
fn is_bonded(scene: &Scene, bodies: &[BodyRun], [driven, other]: [usize; 2]) -> bool {
    if driven == other || bodies[other].motion.is_some() {
        return false;
    }
    let ids = [driven, other].map(|body| bodies[body].id);
    let meet = |master: i64, slave: i64| ids == [master, slave] || ids == [slave, master];
    let in_contact = scene.contacts.iter().any(|c| meet(c.master, c.slave));
    // At the nodes such a body is joined with no other.
    let has_boundary =
        (scene.mortar.contacts.iter()).any(|c| ids.contains(&c.master) || ids.contains(&c.slave));
    !in_contact && !has_boundary && !nodes_suffice(scene, bodies, [driven, other])
}

/// Whether the nodes that a driven body reaches end with it where it faces another: it stands still, and its faces lie on lines
/// of the mesh, beyond which its particles reach no node.
fn nodes_suffice(scene: &Scene, bodies: &[BodyRun], [driven, other]: [usize; 2]) -> bool {
    let stands =
        (bodies[driven].motion.iter()).all(|motion| motion.values.iter().all(|v| *v == [0.0; 3]));
    // Domains of B-splines are wider than the particles of which there are several in a cell.
    let reaches_beyond = bodies[driven].mapping.family == Family::Gimp
        && (0..scene.dimension.axes()).any(|axis| {
            let own = bodies[driven].particle_half_length[axis] / scene.mesh.cell[axis];
            bodies[driven].mapping.half_length[axis] > own + ROUND_OFF
        });
    let (Shape::Cuboid { p1, p2 }, Some([low, high])) = (
        &scene.bodies[driven].shape,
        scene.bodies[other].shape.bounds(),
    ) else {
        return false;
    };
    if !stands || reaches_beyond {
        return false;
    }
    let (mesh, axes) = (&scene.mesh, scene.dimension.axes());
    let on_line = |axis: usize, x: f64| {
        let xi = (x - mesh.origin[axis]) / mesh.cell[axis];
        (xi - xi.round()).abs() < ROUND_OFF
    };
    // Along all other axes less than a cell lies between the two.
    let beside = |axis: usize| {
        (0..axes)
            .filter(|a| *a != axis)
            .all(|a| low[a] < p2[a] + mesh.cell[a] && high[a] > p1[a] - mesh.cell[a])
    };
    (0..axes).all(|axis| {
        let round_off = ROUND_OFF * mesh.cell[axis];
        let faces = [
            (p1, low[axis] < p1[axis] - round_off),
            (p2, high[axis] > p2[axis] + round_off),
        ];
        let mut met = faces
            .into_iter()
            .filter(|(_, beyond)| *beyond && beside(axis));
        met.all(|(face, _)| on_line(axis, face[axis]))
    })
}

/// The pair of a bond.
fn bond(bodies: &[BodyRun], [master, slave]: [usize; 2]) -> Pair {
    let distance: Vector = std::array::from_fn(|axis| {
        bodies[master].particle_half_length[axis] + bodies[slave].particle_half_length[axis]
    });
    Pair {
        id: 0,
        master,
        slave,
        friction: f64::INFINITY,
        normal: ContactNormal::Master,
        distance,
        corrects_distance: true,
        by_shape: true,
        bonded: true,
    }
}
