//! Ground between sides that hold what should move: under a shaken base, and under its own weight.

use super::places::{at_plane, free_box, from_plane, name, plane};
use crate::values::{Body, InitialStress, Scene};
use proctor_kernel::model::{Motion, PlaneCondition};

/// Tractions on planes that hold what is there: the load moves nothing.
pub(super) fn pressed(scene: &Scene) -> Vec<String> {
    let axes = scene.dimension.axes();
    let mut all = vec![];
    for (i, load) in scene.tractions.iter().enumerate() {
        for axis in (0..axes).filter(|axis| load.p1[*axis] == load.p2[*axis]) {
            let bounds = [load.p1, load.p2];
            let lies_in = |side: &usize| {
                from_plane(scene, &bounds, axis, *side).abs() <= scene.mesh.tolerance(axis)
            };
            let Some(side) = (0..2).find(lies_in) else {
                continue;
            };
            let condition = scene.mesh.planes[axis][side];
            let values = &load.traction.values;
            let held = |along: &usize| {
                condition.prescribes(*along, axis) && values.iter().any(|v| v[*along] != 0.0)
            };
            if let Some(along) = (0..axes).find(held) {
                let plane = plane(axis, side);
                all.push(format!(
                    "traction[{i}]: it acts along {} on {plane} of the mesh, which is `{}` and holds what is there: the load moves \
                     nothing; `boundary_conditions` with {plane} `free` lets it",
                    ["x", "y", "z"][along],
                    condition.word(),
                ));
            }
        }
    }
    all
}

/// Bodies on a base that moves along planes which stand still: the planes hold them.
pub(super) fn held_by_sides(scene: &Scene) -> Vec<String> {
    let incoming = scene.ground_beyond.incoming.as_ref();
    let Some(base) = scene.base_motion.as_ref().or(incoming) else {
        return vec![];
    };
    let (Motion::Acceleration(history) | Motion::Velocity(history)) = &base.motion;
    let axes = scene.dimension.axes();
    let mut all = vec![];
    // Along its normal the base takes all planes with it.
    let across = (0..axes).filter(|axis| *axis != base.axis);
    for along in across.filter(|along| history.values.iter().any(|v| v[*along] != 0.0)) {
        for body in &scene.bodies {
            let Some(bounds) = free_box(body) else {
                continue;
            };
            let holds = |(axis, side): &(usize, usize)| {
                let is_base = (*axis, *side) == (base.axis, base.side);
                let condition = scene.mesh.planes[*axis][*side];
                !is_base
                    && condition.prescribes(along, *axis)
                    && at_plane(scene, &bounds, *axis, *side)
            };
            let planes = (0..axes).flat_map(|axis| [(axis, 0), (axis, 1)]);
            let holding: Vec<(usize, usize)> = planes.filter(holds).collect();
            if holding.is_empty() {
                continue;
            }
            let names: Vec<String> = holding
                .iter()
                .map(|(axis, side)| plane(*axis, *side))
                .collect();
            let word = ["x", "y", "z"][along];
            let normal = holding.iter().any(|(axis, _)| *axis == along);
            let instead = if normal {
                "\"absorbing\" sides move with free ground and let waves out; \"antisymmetric\" sides let a level layer shear as \
                 one without end does (they hold its vertical motion: begin with its stress at rest); \"free\" sides, a \
                 cell or more away, leave a body that stands alone to itself"
            } else {
                "\"sliding\" planes leave it free along themselves"
            };
            all.push(format!(
                "{}: the base moves along {word}, where {} {} still: {} the body, whose surface hardly follows \
                 the base, and the motion of the base is lost there; {instead}",
                name(body),
                names.join(", "),
                if names.len() == 1 { "stands" } else { "stand" },
                if names.len() == 1 { "it holds" } else { "they hold" },
            ));
        }
    }
    all
}

/// Bodies with weight but without stress on a plane that absorbs: nothing holds them, and they sink at a speed of g L/c.
pub(super) fn sink_through_dashpots(scene: &Scene) -> Vec<String> {
    let axes = scene.dimension.axes();
    let Some(down) = (0..axes).find(|axis| scene.gravity[*axis] != 0.0) else {
        return vec![];
    };
    let bottom = usize::from(scene.gravity[down] > 0.0);
    // A state of another run has its stress.
    if scene.initial_state.is_some() || scene.mesh.planes[down][bottom] != PlaneCondition::Absorbing
    {
        return vec![];
    }
    let sinks = |body: &&Body| {
        body.initial_stress == InitialStress::None
            && free_box(body).is_some_and(|bounds| at_plane(scene, &bounds, down, bottom))
    };
    let of = |body: &Body| {
        format!(
            "{}: has weight but no stress at the start on {}, whose dashpots hold no load that stays: it sinks; give it \
             `initial_stress` \"at_rest\", or springs (`absorbing_springs`)",
            name(body),
            plane(down, bottom)
        )
    };
    scene.bodies.iter().filter(sinks).map(of).collect()
}

/// Bodies whose weight comes on at the start between two sides that hold them upright: part of it hangs on the sides.
pub(super) fn carried_by_sides(scene: &Scene) -> Vec<String> {
    let axes = scene.dimension.axes();
    let Some(down) = (0..axes).find(|axis| scene.gravity[*axis] != 0.0) else {
        return vec![];
    };
    let bottom = usize::from(scene.gravity[down] > 0.0);
    let holds = |axis: usize, side: usize| scene.mesh.planes[axis][side].prescribes(down, axis);
    let of = |body: &Body| {
        let bounds = free_box(body)?;
        let law = &scene.materials.get(body.material)?.law;
        // The stress of ground at rest needs no sides; a fluid sticks to its walls.
        let comes_on = body.initial_stress == InitialStress::None
            && scene.initial_state.is_none()
            && !law.is_fluid();
        let rests = scene.mesh.planes[down][bottom] != PlaneCondition::Free
            && holds(down, bottom)
            && at_plane(scene, &bounds, down, bottom);
        if !(comes_on && rests) {
            return None;
        }
        let between = |axis: &usize| {
            *axis != down
                && [0, 1]
                    .iter()
                    .all(|side| holds(*axis, *side) && at_plane(scene, &bounds, *axis, *side))
        };
        let axis = (0..axes).find(between)?;
        Some(format!(
            "{}: {} and {} hold the body upright along its weight, part of which hangs on them and never comes down; \"sliding\" \
             sides let ground settle",
            name(body),
            plane(axis, 0),
            plane(axis, 1)
        ))
    };
    scene.bodies.iter().filter_map(of).collect()
}
