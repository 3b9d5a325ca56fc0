//! Stiff bodies beside soft ones on common nodes.

use super::places::{free_box, gap, name};
use crate::values::{Body, Scene};
use proctor_kernel::model::{Shape, Vector, Weighting};

/// Ratio of confined moduli from which the stress of the rows at an interface is far off.
const CONTRAST: f64 = 10.0;

/// Pairs of bodies that meet on common nodes, in contact on the grid or without any, of which one is much stiffer.
///
/// Under one pressure q along the normal, in two halves of a column with uGIMP and 2 x 2 particles per cell, the row of
/// particles on the soft side of the interface has 1.00, 0.95, 0.87, 0.73 of q for ratios of 3, 10, 30, 100, the two rows on
/// the stiff side 1.08 and 0.93, 1.40 and 0.69, 2.03 and 0.20, 3.17 and -0.70; h/2 gives the same rows. With mortar contact the
/// rows of both sides have 0.98 to 1.02 at 100, wherever the interface lies (`kernel/tests/physics/mortar_layer.rs`).
pub(super) fn stiff_beside_soft(scene: &Scene) -> Vec<String> {
    let mortar = |a: &Body, b: &Body| {
        let mut contacts = scene.mortar.contacts.iter();
        contacts.any(|contact| is_of(contact.master, contact.slave, a, b))
    };
    let of = |(a, b): (&Body, &Body)| {
        let ratio = contrast(scene, a, b)?;
        if ratio.max(1.0 / ratio) < CONTRAST * (1.0 - 1e-9) || mortar(a, b) {
            return None;
        }
        let (stiff, soft, ratio) = if ratio > 1.0 {
            (a, b, ratio)
        } else {
            (b, a, 1.0 / ratio)
        };
        Some(format!(
            "{} is {ratio:.3} times as stiff as {}, and both meet on common nodes: the rows of particles beside the interface \
             carry a stress that is off, on smaller cells alike. Of one pressure the two rows on the stiff side have 1.40 \
             and 0.69 at a ratio of 10, 3.17 and -0.70 at 100, the row on the soft side 0.95 and 0.73; two cells away it is \
             right within 3 %. Mortar contact (\"method\": \"mortar\") keeps the rows on both sides within 2 %, whatever the \
             ratio",
            name(stiff),
            name(soft)
        ))
    };
    near(scene).filter_map(of).collect()
}

/// Pairs in contact on the grid whose interface lies within cells, or that have B-splines, which reach beyond any line.
///
/// Both bodies then share nodes on either side of the interface, and each has forces of its own there that contact does not know
/// apart. The figures are those of `proctor verify --generated 3000`, question `contact`.
pub(super) fn inside_cells(scene: &Scene) -> Vec<String> {
    let of = |(a, b): (&Body, &Body)| {
        let mut contacts = scene.contacts.iter();
        let contact = contacts.find(|contact| is_of(contact.master, contact.slave, a, b))?;
        let splines = scene.weighting == Weighting::QuadraticBSpline;
        // A warning of the contrast says more.
        let contrast = contrast(scene, a, b)?;
        if contrast.max(1.0 / contrast) >= CONTRAST || (!splines && meet_on_a_line(scene, a, b)) {
            return None;
        }
        Some(format!(
            "{}: {} and {} meet {}: under a pressure the rows of particles in the cell beside the interface carry between minus \
             one and three times of it; the force between the bodies and the stress two cells away are right within 5 %. \
             Faces on lines of the mesh with uGIMP or cpGIMP, and mortar contact, have the pressure in these rows too",
            contact.name,
            name(a),
            name(b),
            if splines {
                "on nodes that B-splines of both reach"
            } else {
                "within cells, on common nodes"
            },
        ))
    };
    near(scene).filter_map(of).collect()
}

/// True where identifiers are those of two bodies, in any order.
fn is_of(master: i64, slave: i64, a: &Body, b: &Body) -> bool {
    [(a.id, b.id), (b.id, a.id)].contains(&(master, slave))
}

/// Pairs of bodies that are not driven, less than a cell apart at the start.
fn near(scene: &Scene) -> impl Iterator<Item = (&Body, &Body)> {
    let axes = scene.dimension.axes();
    let bodies = scene.bodies.iter().enumerate();
    let pairs = bodies.flat_map(|(i, a)| scene.bodies[i + 1..].iter().map(move |b| (a, b)));
    pairs.filter(move |(a, b)| {
        let (Some(box_a), Some(box_b)) = (free_box(a), free_box(b)) else {
            return false;
        };
        (0..axes).all(|axis| gap(&box_a, &box_b, axis) < scene.mesh.cell[axis])
    })
}

/// Confined modulus of one body over that of another; `None` where one is a fluid.
fn contrast(scene: &Scene, a: &Body, b: &Body) -> Option<f64> {
    let stiffness = |body: &Body| {
        let material = scene.materials.get(body.material)?;
        let confined = material.density * material.law.wave_speed(material.density).powi(2);
        (!material.law.is_fluid()).then_some(confined)
    };
    Some(stiffness(a)? / stiffness(b)?)
}

/// True for two cuboids that meet on a line of the mesh.
fn meet_on_a_line(scene: &Scene, a: &Body, b: &Body) -> bool {
    let (Shape::Cuboid { p1: a1, p2: a2 }, Shape::Cuboid { p1: b1, p2: b2 }) = (&a.shape, &b.shape)
    else {
        return false;
    };
    let mesh = &scene.mesh;
    let on_line = |axis: usize, x: &Vector| {
        let xi = (x[axis] - mesh.origin[axis]) / mesh.cell[axis];
        (xi - xi.round()).abs() * mesh.cell[axis] < mesh.tolerance(axis)
    };
    let same =
        |axis: usize, x: &Vector, y: &Vector| (x[axis] - y[axis]).abs() < mesh.tolerance(axis);
    (0..scene.dimension.axes()).any(|axis| {
        (same(axis, a2, b1) && on_line(axis, a2)) || (same(axis, b2, a1) && on_line(axis, b2))
    })
}
