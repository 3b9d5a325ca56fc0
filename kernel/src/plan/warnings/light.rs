//! Light nodes: those that only the edge of a body reaches, at its surface and where it rests on a support.

use super::places::{from_plane, name};
use super::resting::{Rest, Support, all};
use super::{HARDLY_PIC, poisson};
use crate::scene::{
    Body, Damping, InitialStress, Scene, Shape, StressScheme, TransferKind, Weighting,
};

/// Poisson's ratio from which what goes on at free sides is felt along the body, under viscous damping.
const SPREADS: f64 = 0.2;
/// The same for B-splines under local damping.
const SPREADS_SPLINES: f64 = 0.38;
/// Cells that a surface reaches beyond a line of the mesh, at most, where its nodes are light.
const SURFACE: f64 = 0.2;
/// Cells behind a line of the mesh where a face is as good as on it.
const BEHIND: f64 = 0.06;

/// Bodies in mortar contact with a rigid line whose face lies on a line of the mesh, under USL, or a little behind one with FLIP and
/// MUSL.
///
/// What is left of the motion decides whether domains that end at the face reach the nodes behind. A node that is reached by nothing
/// but that is as light as one likes, and a force there strains the first row nevertheless: its acceleration is that over the mass,
/// which falls with the square of the way, the derivative of its weights with the way. Of 96 columns with domains that stretch 32
/// had more than 5 to 10 % of the pressure too much or too little in the first rows, up to 1.7 times of it; with uGIMP 2 of 100, up to
/// 0.8 of it. FLIP with MUSL swings there: 4 of 7 with a face up to 0.06 of a cell behind a line. Surfaces and driven bodies let such
/// nodes follow (`simulation/interactions/surfaces/light_nodes.rs`).
pub(super) fn on_lines(scene: &Scene) -> Vec<String> {
    let gimp = matches!(
        scene.weighting,
        Weighting::ContiguousGimp(_) | Weighting::UniformGimp
    );
    let usl = gimp && scene.scheme == StressScheme::Usl;
    let flip = gimp
        && scene.transfer.kind == TransferKind::Flip
        && scene.transfer.pic_fraction < HARDLY_PIC
        && scene.scheme == StressScheme::Musl;
    let of = |rest: &Rest<'_>| {
        let beyond = rest.beyond(scene, rest.axis, rest.side);
        let behind = flip && beyond > 1e-6 && beyond < BEHIND;
        let on_line = usl && rest.on_a_line(scene);
        (rest.on == Support::Line && (on_line || behind)).then(|| {
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

/// Bodies with free sides, or a free surface, whose rows do not come to rest with FLIP and a second mapping.
///
/// Damping takes velocities of nodes. What particles have against each other within a cell no node has, and it stays: under
/// viscous damping the rows swing by 2 to 15 % of the pressure after 14 periods of damping, and by half of that after four times
/// as long, whatever the step. Of 91 blocks with a Poisson's ratio from 0.2 on 54 were off by more than 2 % so; with local damping
/// 6 of 34 with domains, all with light sides, and 9 of 16 with B-splines from 0.38 on; of ground under its weight 6 of 11 whose surface ends less than 0.2 of
/// a cell beyond a line. In three of these blocks with an affine transfer or USL what was left at rest was 0.3 to 1.3 %.
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
             of nodes alone: what has free sides hardly comes to rest, and its rows keep swinging by 2 to 15 % of the pressure on \
             it; \"APIC\" or \"TPIC\" and USL come to rest within 2 %",
            name(body)
        )
    };
    let of = |rest: &Rest<'_>| {
        let material = scene.materials.get(rest.body.material)?;
        let confined = material.law.wave_speed(1.0).powi(2);
        let spreads = poisson(confined / material.law.young()) >= least;
        let stands_alone = rest.along(scene).any(|axis| is_free(rest, scene, axis));
        (spreads && stands_alone).then(|| message(rest.body))
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
