//! Contact between bodies, and of bodies with rigid surfaces: on the grid, by mortar, and on triangulated surfaces.
//!
//! Each kind is an [`Interaction`](proctor_kernel::simulation::Interaction) of the kernel, and does what any program's own can do:
//! it sees views of a step, and has errors, words of the plan and saved arrays of its own. The kernel names none of them.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod geometry;
pub(crate) mod grid;
mod kinds;
pub mod mortar;
#[doc(hidden)]
pub mod pairs;
pub mod queries;
pub mod surfaces;
mod values;

pub use grid::GridContact;
pub use mortar::{
    BoundaryDrift, BoundaryMesh, BoundaryVertex, MortarError, MortarState, VertexState,
};
pub use pairs::Tunnelling;
pub use surfaces::{SurfaceContact, SurfaceContactError};
pub use values::{
    BodyBoundary, BoundaryHandle, Contact, ContactHandle, ContactNormal, ContactValues,
    Enforcement, Mortar, MortarContact, PairValues, PlannedBody, RigidFacets, RigidLine,
    RigidSurface, SurfaceHandle, Vertices,
};

use kinds::ContactType;
use proctor_geometry::memory::Memory;
use proctor_kernel::model::CycleSettings;
use proctor_kernel::plan::PlanEntries;
use proctor_kernel::simulation::{BodyRun, Interactions, SetupError};

/// Kinds of contact that ranks do not share ([`Interaction::not_local`](proctor_kernel::simulation::Interaction::not_local)).
pub const NOT_LOCAL: [&str; 1] = ["mortar contact"];

/// Kinds of contact, in the order in which they act.
const ALL: &[ContactType] = &[grid::GRID, mortar::MORTAR, surfaces::SURFACES];

/// Adds the entries of contact to a plan.
pub fn describe(
    values: &ContactValues,
    settings: &CycleSettings,
    bodies: &[PlannedBody<'_>],
    list: &mut PlanEntries,
) {
    for kind in ALL {
        (kind.plan_entries)(values, settings, bodies, list);
    }
}

/// The interactions of a model.
///
/// # Errors
/// A boundary that is none, or surfaces that overlap.
pub fn interactions(
    values: &ContactValues,
    settings: &CycleSettings,
    bodies: &[BodyRun],
    memory: &mut Memory,
) -> Result<Interactions, SetupError> {
    let made = ALL
        .iter()
        .filter_map(|kind| (kind.make)(values, settings, bodies, memory));
    made.collect()
}
