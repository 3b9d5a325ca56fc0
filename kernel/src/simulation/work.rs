//! What a step works with.

use super::error::StepError;
use super::fields::Grid;
use super::interactions::Interactions;
use super::trust::Momentum;
use crate::stage::solve::PlaneSums;

/// What a step works with: the grid, which holds nothing between two steps, and what acts between its fields.
pub(crate) struct Work {
    pub(crate) grid: Grid,
    /// Whether each body has a velocity field of its own, as of the last sort.
    pub(crate) own_field: Vec<bool>,
    /// What acts between velocity fields; those of the user come last. What they remember is saved with the state.
    pub(crate) interactions: Interactions,
    /// Groups of the first mapping of this step, where it is done already.
    pub(crate) mapped: Option<usize>,
    /// Sums over the nodes of the last step.
    pub(crate) sums: PlaneSums,
    /// Why a step left particles where no step can go on.
    pub(crate) failed: Option<StepError>,
    /// Momentum in the middle of a step, where it is looked at.
    pub(crate) momentum: Option<Momentum>,
}

impl Work {
    /// An empty grid.
    pub(super) fn new(grid: Grid, interactions: Interactions, bodies: usize) -> Self {
        Self {
            grid,
            own_field: vec![false; bodies],
            interactions,
            mapped: None,
            sums: PlaneSums::default(),
            failed: None,
            momentum: None,
        }
    }
}
