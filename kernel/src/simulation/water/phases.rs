//! Water and grains of a node: their volumes, and the constants that all waters of a scene share.

use crate::fields::{Owner, Slab};
use crate::grid::Line;
use crate::model::PoreWater;
use crate::simulation::context::StepContext;

/// Volume of water and grains around a node \[m³\].
pub(super) fn volume(water: &PoreWater, skeleton: &Line, flow: &Line) -> f64 {
    flow[0] / water.density + skeleton[0] / water.grain_density
}

/// Porosity of a node, from the masses of water and grains there: a mean over its particles.
pub(super) fn porosity(water: &PoreWater, skeleton: &Line, flow: &Line) -> f64 {
    let pores = flow[0] / water.density;
    pores / (pores + skeleton[0] / water.grain_density)
}

/// The constants that all waters of a scene share, where the slab has water: densities and ratios of conductivity.
pub(super) fn constants(slab: &Slab<'_>, context: &StepContext<'_>) -> Option<PoreWater> {
    let water = slab
        .fields
        .last()
        .filter(|field| field.owner == Owner::Water);
    water?;
    context.mapping.bodies.iter().find_map(|body| body.water)
}
