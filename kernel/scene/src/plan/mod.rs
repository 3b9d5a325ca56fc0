//! The plan of a scene: what it needs, and nothing else.
//!
//! It is decided once. What is left out is never called and its fields are never allocated.

mod entries;
mod tension;
mod warnings;

use crate::values::{Field, Scene};
use entries::is_list;
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::model::{Damping, VolumetricStrain, Weighting};
pub use proctor_kernel::plan::{AUTOMATIC_SHARE, Plan, PlanEntry, has_safe_step, stability_number};
use proctor_kernel::stage::g2p::Affine;
pub use tension::{ForeseenTension, foreseen_tension};

/// Options of a plan beyond the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlanOptions {
    /// Keep the initial positions, for displacements.
    pub displacement: bool,
    /// Measure kinetic energy and unbalanced force at the nodes in every step.
    pub measure: bool,
    /// A body force is given as a function.
    pub body_force: bool,
}

/// The columns of the particles of each body.
pub(crate) fn layouts(scene: &Scene, demands: PlanOptions) -> Vec<Layout> {
    let axes = scene.dimension.axes();
    let domain_update = scene.weighting.domain_update();
    let affine = scene.transfer.kind.kind().affine;
    let own_force = !scene.box_loads.is_empty() || demands.body_force;
    let written = |field: Field| scene.results.print > 0 && scene.results.fields.contains(&field);
    let displacement = demands.displacement
        || written(Field::Displacement)
        || (scene.results.writes_history() && !scene.probes.is_empty());
    scene
        .bodies
        .iter()
        .map(|body| {
            let law = scene.law_of(body);
            Layout::new(
                axes,
                Optional {
                    displacement_origin: displacement || demands.body_force,
                    deformation: law.needs_deformation()
                        || domain_update.is_some()
                        || written(Field::DeformationGradient),
                    affine: affine != Affine::Leave,
                    half_length: domain_update.is_some()
                        || (scene.weighting == Weighting::UniformGimp && is_list(body)),
                    initial_half_length: domain_update.is_some(),
                    force: own_force,
                    axisymmetric: scene.mesh.axisymmetric,
                    water: scene.water_of(body.material).is_some(),
                    held_pressure: !scene.held_pressures.is_empty(),
                },
                law.variables(),
            )
        })
        .collect()
}

/// Decides what a scene needs, and nothing else.
#[must_use]
pub fn plan(scene: &Scene, demands: PlanOptions) -> Plan {
    let axes = scene.dimension.axes();
    let domain_update = scene.weighting.domain_update();
    let family = scene.weighting.kind().family;
    let affine = scene.transfer.kind.kind().affine;
    let viscous_damping = match scene.damping {
        Damping::Viscous { alpha } if alpha != 0.0 => Some(alpha),
        _ => None,
    };
    let kinetic_damping = scene.damping == Damping::Kinetic;
    let own_force = !scene.box_loads.is_empty() || demands.body_force;
    let layouts = layouts(scene, demands);
    let mut plan = Plan {
        axes,
        axisymmetric: scene.mesh.axisymmetric,
        family,
        domain_update,
        scheme: scene.scheme,
        affine,
        cell_average: scene.volumetric_strain == VolumetricStrain::CellAverage,
        full_mapping: affine != Affine::Leave || own_force || viscous_damping.is_some(),
        kinetic_damping,
        viscous_damping,
        measure: demands.measure || kinetic_damping,
        layouts,
        entries: vec![],
        warnings: warnings::warnings(scene),
    };
    plan.entries = entries::describe(&plan, scene, demands);
    plan
}
