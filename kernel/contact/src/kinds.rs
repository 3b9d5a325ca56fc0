//! A kind of contact, as it stands in the list of all.

use crate::values::{ContactValues, PlannedBody};
use proctor_geometry::memory::Memory;
use proctor_kernel::model::CycleSettings;
use proctor_kernel::plan::PlanEntries;
use proctor_kernel::simulation::{BodyRun, Interaction, SetupError};

/// An interaction, or why there cannot be one.
pub(crate) type InteractionResult = Result<Box<dyn Interaction>, SetupError>;

/// Builds the interaction of a kind, where a model has any.
type Builder =
    fn(&ContactValues, &CycleSettings, &[BodyRun], &mut Memory) -> Option<InteractionResult>;

/// A kind of contact.
pub(crate) struct ContactType {
    /// Its entries of the plan.
    pub(crate) plan_entries:
        fn(&ContactValues, &CycleSettings, &[PlannedBody<'_>], &mut PlanEntries),
    /// Makes it.
    pub(crate) make: Builder,
}
