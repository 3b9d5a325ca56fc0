//! Bonds: driven bodies, of which no contact is given, hold the particles that touch them.
//!
//! Bodies without contact share one velocity where they share a node. A driven body that prescribes it at the nodes holds all
//! that lies up to a cell beyond its faces, unless they lie on lines of the mesh. The shape of one that stands still elsewhere
//! holds the particles that touch it, at the points where they touch, against pressure, tension and sliding: a pair whose
//! bound is an equation. One that moves acts at the nodes wherever it is: its shape would take energy from what it drags
//! along, with MUSL 9 % of the work on a bar.

use super::acts_by_shape;
use crate::pairs::Pair;
use crate::values::{ContactNormal, PairValues};
use proctor_kernel::model::{CycleSettings, Shape, Vector};
use proctor_kernel::simulation::BodyRun;
use proctor_kernel::weights::{Family, ROUND_OFF};

/// The bonds of a model.
pub(super) fn all<'a>(
    given: &'a PairValues,
    settings: &'a CycleSettings,
    bodies: &'a [BodyRun],
) -> impl Iterator<Item = Pair> + 'a {
    let driven = (0..bodies.len()).filter(|&b| bodies[b].motion.is_some());
    driven.flat_map(move |master| {
        let partners = (0..bodies.len())
            .filter(move |&slave| is_bonded(given, settings, bodies, [master, slave]));
        partners.map(move |slave| bond(bodies, [master, slave]))
    })
}

/// True where a driven body holds another by its shape.
fn is_bonded(
    given: &PairValues,
    settings: &CycleSettings,
    bodies: &[BodyRun],
    [driven, other]: [usize; 2],
) -> bool {
    if driven == other || bodies[other].motion.is_some() {
        return false;
    }
    let ids = [driven, other].map(|body| bodies[body].id);
    let meet = |master: i64, slave: i64| ids == [master, slave] || ids == [slave, master];
    let in_contact = given.contacts.iter().any(|c| meet(c.master, c.slave));
    // At the nodes such a body is joined with no other.
    let has_boundary =
        (given.in_mortar.iter()).any(|[master, slave]| ids.contains(master) || ids.contains(slave));
    !in_contact
        && !has_boundary
        && acts_by_shape(settings, bodies, [driven, other])
        && stands(bodies, driven)
        && ends_within_cells(settings, bodies, [driven, other])
}

/// True for a driven body that stands still.
pub(super) fn stands(bodies: &[BodyRun], driven: usize) -> bool {
    let mut motion = bodies[driven].motion.iter().flat_map(|m| &m.values);
    motion.all(|v| *v == [0.0; 3])
}

/// True where the nodes of a driven body reach beyond it at the start, towards another: its faces lie within cells, or the
/// domains of its particles are wider than they are.
pub(super) fn ends_within_cells(
    settings: &CycleSettings,
    bodies: &[BodyRun],
    [driven, other]: [usize; 2],
) -> bool {
    let (Shape::Cuboid { p1, p2 }, Some([low, high])) =
        (&bodies[driven].shape, bodies[other].shape.bounds())
    else {
        return true;
    };
    let (mesh, axes) = (&settings.mesh, settings.dimension.axes());
    let is_wide = |axis: usize| {
        let own = bodies[driven].particle_half_length[axis] / mesh.cell[axis];
        bodies[driven].mapping.half_length[axis] > own + ROUND_OFF
    };
    // As domains of B-splines are, where a cell has several particles.
    if bodies[driven].mapping.family == Family::Gimp && (0..axes).any(is_wide) {
        return true;
    }
    let off_line = |axis: usize, x: f64| {
        let xi = (x - mesh.origin[axis]) / mesh.cell[axis];
        (xi - xi.round()).abs() > ROUND_OFF
    };
    // Along all other axes less than a cell lies between the two.
    let beside = |axis: usize| {
        let mut others = (0..axes).filter(|a| *a != axis);
        others.all(|a| low[a] < p2[a] + mesh.cell[a] && high[a] > p1[a] - mesh.cell[a])
    };
    (0..axes).any(|axis| {
        let round_off = ROUND_OFF * mesh.cell[axis];
        let below = low[axis] < p1[axis] - round_off && off_line(axis, p1[axis]);
        let above = high[axis] > p2[axis] + round_off && off_line(axis, p2[axis]);
        (below || above) && beside(axis)
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
