//! The plan: what this scene needs, and nothing else.
//!
//! It is decided once. What is left out is never called and its fields are never allocated.

mod entries;
mod stability;
mod tension;
mod warnings;

use crate::layout::{Layout, Optional};
use crate::scene::{
    Damping, DomainUpdate, Field, Scene, StressScheme, VolumetricStrain, Weighting,
};
use crate::stage::g2p::Affine;
use crate::weights::Family;
pub(crate) use entries::PlanEntries;
use entries::is_list;
pub use stability::{AUTOMATIC_SHARE, has_safe_step, stability_number};
use std::fmt;
pub use tension::{ForeseenTension, foreseen_tension};
pub(crate) use tension::{loses_tension, scheme_word};

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

/// Says what it makes of a scene.
pub(crate) type Feature = fn(&Scene, &mut PlanEntries);

/// Decisions for one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Number of axes, 2 or 3.
    pub axes: usize,
    /// Family of weighting functions.
    pub family: Family,
    /// How particle domains follow the deformation.
    pub domain_update: Option<DomainUpdate>,
    /// Stress scheme.
    pub scheme: StressScheme,
    /// Affine velocity.
    pub affine: Affine,
    /// Whether volumetric strain is a mean over cells.
    pub cell_average: bool,
    /// Whether the mapping carries affine velocity or forces of the particles.
    pub full_mapping: bool,
    /// Kinetic damping.
    pub kinetic_damping: bool,
    /// Factor of viscous damping.
    pub viscous_damping: Option<f64>,
    /// Whether kinetic energy and unbalanced force are measured at the nodes in every step.
    pub measure: bool,
    /// Columns of the particle sets, per body.
    pub layouts: Vec<Layout>,
    /// What was decided, in words.
    pub entries: Vec<PlanEntry>,
    /// What the scene may do, but not well, each with its reason.
    pub warnings: Vec<String>,
}

/// One decision in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanEntry {
    /// Group: stage, particle field, output, time step.
    pub group: &'static str,
    /// What is kept or left out.
    pub name: String,
    /// Whether it is kept.
    pub kept: bool,
    /// Why.
    pub because: String,
}

impl Plan {
    /// Decides what the scene needs; `features` say what they make of it, in their order.
    #[must_use]
    pub(crate) fn of(scene: &Scene, demands: PlanOptions, features: &[Feature]) -> Self {
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
        let written =
            |field: Field| scene.results.print > 0 && scene.results.fields.contains(&field);
        let displacement = demands.displacement
            || written(Field::Displacement)
            || (scene.results.print > 0 && !scene.probes.is_empty());
        let layouts = scene
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
                    },
                    law.variables(),
                )
            })
            .collect();
        let mut plan = Self {
            axes,
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
        plan.entries = plan.describe(scene, demands, features);
        plan
    }

    /// Bytes of state per particle, the largest over the bodies.
    #[must_use]
    pub fn bytes_per_particle(&self) -> usize {
        self.layouts
            .iter()
            .map(Layout::bytes_per_particle)
            .max()
            .unwrap_or(0)
    }

    /// Bytes per node that is in use.
    #[must_use]
    pub fn bytes_per_node(&self) -> usize {
        size_of::<crate::grid::Line>()
    }

    /// Bytes per node of the velocity field of a body near a partner of contact: its line, and a second one for normals
    /// and distances.
    #[must_use]
    pub fn bytes_per_node_of_layer(&self) -> usize {
        2 * size_of::<crate::grid::Line>()
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.entries.iter().map(|e| e.name.len()).max().unwrap_or(0);
        for kept in [true, false] {
            writeln!(f, "{}", if kept { "kept" } else { "left out" })?;
            for entry in self.entries.iter().filter(|e| e.kept == kept) {
                writeln!(
                    f,
                    "  {:<14}  {:<width$}  {}{}",
                    entry.group,
                    entry.name,
                    if kept { "" } else { "because " },
                    entry.because
                )?;
            }
        }
        for warning in &self.warnings {
            writeln!(f, "warning: {warning}")?;
        }
        writeln!(f, "bytes per particle  {}", self.bytes_per_particle())?;
        write!(f, "bytes per node      {}", self.bytes_per_node())
    }
}
