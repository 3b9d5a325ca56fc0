//! Light nodes: those that only the edge of a body reaches, at its surface and where it rests on a support.

use super::places::{from_plane, name};
use super::resting::{Rest, Support, all};
use super::{HARDLY_PIC, poisson};
use crate::values::{Body, InitialStress, Scene};
use proctor_kernel::model::{Damping, Dimension, Shape, StressScheme, TransferKind, Weighting};

/// Cells that a side reaches beyond a line of the mesh, at most, where its nodes are light: with domains that stretch, and with USL.
const EDGE: [f64; 2] = [0.28, 0.25];
/// Cells that a wave crosses in a run from which the stress at a support has drifted: with domains that stretch, and with USL.
const LONG: [f64; 2] = [75.0, 140.0];
/// Poisson's ratio from which what goes on at free sides is felt along the body, under viscous damping.
const SPREADS: f64 = 0.2;
/// The same for B-splines under local damping.
const SPREADS_SPLINES: f64 = 0.38;
/// Width of a body whose cells all reach a side \[cells\].
const NARROW: f64 = 2.0;
/// Cells that a surface reaches beyond a line of the mesh, at most, where its nodes are light.
const SURFACE: f64 = 0.25;
/// Cells behind a line of the mesh where a face is as good as on it.
const BEHIND: f64 = 0.06;

/// Bodies that rest on a line of the mesh under USL, or on a rigid line in mortar contact a little behind one with FLIP and MUSL.
///
/// The remaining motion decides if domains that end at the face reach the nodes behind. A node that is reached by nothing but
/// that is as light as one likes, and a force there strains the first row nevertheless: its acceleration is that over the mass,
/// which falls with the square of the way, the derivative of its weights with the way. Of 96 columns on rigid lines and driven
/// bodies, with domains that stretch, 32 had more than 5 to 10 % of the pressure too much or too little in the first rows, up
/// to 1.7 times of it; with uGIMP 2 of 100, both on rigid lines, up to 0.8 of it. FLIP with MUSL swings there: 4 of 7 with a
/// face up to 0.06 of a cell behind a line.
pub(super) fn on_lines(scene: &Scene) -> Vec<String> {
    let stretches = matches!(scene.weighting, Weighting::ContiguousGimp(_));
    let gimp = stretches || scene.weighting == Weighting::UniformGimp;
    let usl = gimp && scene.scheme == StressScheme::Usl;
    let flip = gimp
        && scene.transfer.kind == TransferKind::Flip
        && scene.transfer.pic_fraction < HARDLY_PIC
        && scene.scheme == StressScheme::Musl;
    let of = |rest: &Rest<'_>| {
        let beyond = rest.beyond(scene, rest.axis, rest.side);
        let line = rest.on == Support::Line;
        let behind = flip && line && beyond > 1e-6 && beyond < BEHIND;
        let on_line = usl && (line || stretches) && rest.on_a_line(scene);
        (on_line || behind).then(|| {
            let (place, how) = if on_line {
                ("on a line", "with USL")
            } else {
                ("a little beyond a line", "with FLIP and MUSL")
            };
            format!(
                "{}: it rests {place} of the mesh, and the edges of its domains pass it to and fro: {how} nodes behind it that \
                 hardly anything else reaches strain the first rows of particles, which then may carry up to 1.7 times the \
                 pressure too much or too little; a face a tenth of a cell before the line keeps the rows within 2 %",
                name(rest.body)
            )
        })
    };
    if usl || flip {
        all(scene).iter().filter_map(of).collect()
    } else {
        vec![]
    }
}

/// Bodies on driven ones whose free sides end a little beyond a line of the mesh, in runs that are long.
///
/// In the columns of nodes beside such a side stress of the first row drifts: with USL and domains that keep their length for as
/// long as runs were taken, four times their own length, with MUSL and USF where domains stretch until it is off by some tenths of
/// the pressure. Of 240 blocks 92 were off by more than 5 % after 75 to 330 cells that a wave crosses, by up to 0.7 of the
/// pressure; of 431 with sides farther beyond a line 23. A
/// block in space that is less than two cells wide has such nodes in every cell with B-splines, which reach half a cell further: 23
/// of 54 were off, whatever their sides. Under USL and damping contact without friction goes on from the impulses of the last step, and none of these is off
/// any more.
pub(super) fn at_sides(scene: &Scene) -> Vec<String> {
    let usl = scene.scheme == StressScheme::Usl;
    let stretches = matches!(scene.weighting, Weighting::ContiguousGimp(_));
    let smooth = scene.contacts.iter().all(|contact| contact.friction == 0.0);
    let goes_on = usl && smooth && scene.damping.slows();
    if goes_on || usl == stretches || scene.weighting == Weighting::Linear {
        return vec![];
    }
    let wide = usl
        && scene.weighting == Weighting::QuadraticBSpline
        && scene.dimension == Dimension::Three;
    let of = |rest: &Rest<'_>| {
        let material = scene.materials.get(rest.body.material)?;
        let speed = material.law.wave_speed(material.density);
        let long = LONG[usize::from(usl)];
        let crossed = |axis: usize| scene.time * speed / scene.mesh.cell[axis];
        let is_edge = |axis: usize, side: usize| {
            let beyond = rest.beyond(scene, axis, side);
            rest.is_free(scene, axis, side)
                && beyond > 1e-6
                && beyond < EDGE[usize::from(usl)] + 1e-6
                && crossed(axis) > long
        };
        let narrow = |axis: usize| {
            wide && is_free(rest, scene, axis)
                && rest.length(scene, axis) < NARROW
                && crossed(axis) > LONG[0]
        };
        let edge = rest
            .along(scene)
            .find(|&axis| narrow(axis) || [0, 1].iter().any(|&side| is_edge(axis, side)))?;
        let crossed = crossed(edge);
        (rest.on == Support::Driven).then(|| {
            let (which, end) = match (usl, narrow(edge)) {
                (_, true) => ("USL and B-splines", "it is less than two cells wide, and"),
                (true, _) => ("USL", "a free side ends less than a quarter of a cell beyond a line of the mesh, and"),
                (false, _) => ("cpGIMP", "a free side ends less than a quarter of a cell beyond a line of the mesh, and"),
            };
            format!(
                "{}: {end} its nodes are light: with {which} the stress of the first row on the driven body drifts there from \
                 step to step, by 0.05 to 0.7 of the pressure after {crossed:.0} cells that a wave crosses; \"GIMP\" with MUSL or \
                 USF, and sides on a line of the mesh or half way between two, hardly drift",
                name(rest.body)
            )
        })
    };
    all(scene).iter().filter_map(of).collect()
}

/// Bodies with free sides, or a free surface, whose rows do not come to rest with FLIP and a second mapping.
///
/// Damping takes velocities of nodes. What particles have against each other within a cell no node has, and it stays: under
/// viscous damping the rows swing by 2 to 15 % of the pressure after 14 periods of damping, and by half of that after four times
/// as long, whatever the step. Of 91 blocks with a Poisson's ratio from 0.2 on 54 were off by more than 2 % so; with local damping
/// 6 of 34 with domains, all with light sides, and 9 of 16 with B-splines from 0.38 on; of ground under its weight 6 of 11 whose surface ends less than 0.2 of
/// a cell beyond a line, and one at 0.225. Blocks in space that are less than two cells wide have hardly another node: of 19 more of
/// them (seeds 1 and 2 of the generator) 4 were off and 16 had not come to rest after four times as long. In three of these blocks with an affine transfer or USL what was left at rest was 0.3 to 1.3 %.
pub(super) fn swings(scene: &Scene) -> Vec<String> {
    let viscous = matches!(scene.damping, Damping::Viscous { alpha } if alpha > 0.0);
    let local = matches!(scene.damping, Damping::Local { alpha } if alpha > 0.0);
    let flip =
        scene.transfer.kind == TransferKind::Flip && scene.transfer.pic_fraction < HARDLY_PIC;
    if !((viscous || local) && flip && scene.scheme != StressScheme::Usl) {
        return vec![];
    }
    let splines = scene.weighting == Weighting::QuadraticBSpline;
    let least = match (viscous, splines) {
        (true, _) => SPREADS,
        (false, true) => SPREADS_SPLINES,
        (false, false) => f64::INFINITY,
    };
    let message = |body: &Body| {
        format!(
            "{}: with FLIP and MUSL or USF particles keep velocities against each other that no node has, and damping takes those \
             of nodes alone: a body with free sides hardly comes to rest, and its rows keep swinging by 2 to 15 % of the pressure on \
             it; \"APIC\" or \"TPIC\" and USL come to rest within 2 %",
            name(body)
        )
    };
    let of = |rest: &Rest<'_>| {
        let material = scene.materials.get(rest.body.material)?;
        let confined = material.law.wave_speed(1.0).powi(2);
        let spreads = poisson(confined / material.law.young()) >= least;
        let mut free = rest.along(scene).filter(|axis| is_free(rest, scene, *axis));
        let in_space = scene.dimension == Dimension::Three;
        let narrow = |axis: usize| in_space && rest.length(scene, axis) < NARROW;
        let stands_alone = free.any(|axis| spreads || narrow(axis));
        stands_alone.then(|| message(rest.body))
    };
    let mut warned: Vec<String> = all(scene).iter().filter_map(of).collect();
    if viscous && !splines {
        warned.extend(light_surfaces(scene).into_iter().map(message));
    }
    warned
}

/// Boxes under gravity whose weight comes on at the start and whose surface ends a little beyond a line of the mesh.
fn light_surfaces(scene: &Scene) -> Vec<&Body> {
    let mut axes = 0..scene.dimension.axes();
    let Some(axis) = axes.find(|axis| scene.gravity[*axis] != 0.0) else {
        return vec![];
    };
    let side = usize::from(scene.gravity[axis] < 0.0);
    let is_light = |body: &&Body| {
        let is_box = matches!(body.shape, Shape::Cuboid { .. });
        let comes_on = body.motion.is_none() && body.initial_stress == InitialStress::None;
        let (true, true, Some(bounds)) = (is_box, comes_on, body.shape.bounds()) else {
            return false;
        };
        let rest = Rest {
            body,
            bounds,
            axis,
            side: 1 - side,
            on: Support::Plane,
        };
        let beyond = rest.beyond(scene, axis, side);
        let rests = scene.plane_acts(axis, 1 - side)
            && from_plane(scene, &bounds, axis, 1 - side) < scene.mesh.tolerance(axis);
        rests && rest.is_free(scene, axis, side) && beyond > 1e-6 && beyond < SURFACE
    };
    scene.bodies.iter().filter(is_light).collect()
}

/// True where a body is free on both sides of an axis.
fn is_free(rest: &Rest<'_>, scene: &Scene, axis: usize) -> bool {
    [0, 1].iter().all(|&side| rest.is_free(scene, axis, side))
}
