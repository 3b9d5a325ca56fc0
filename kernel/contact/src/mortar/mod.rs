//! Mortar contact in the cycle: boundaries that move with bodies and rigid lines, and the part of a step in which
//! contact is found before its time step is chosen.
//!
//! Each body with a boundary has a velocity field to itself. A step goes: mapping to the nodes, places of the vertices on
//! their particles or their augmented weights on the nodes, gaps and forces of the pairs, time step, forces to the nodes, equation of motion, vertices.

mod boundaries;
mod change;
mod error;
mod faces;
mod interaction;
mod memory;
mod mirrors;
mod neighbours;
mod pair;
mod patch;
mod plan_entries;
mod saved_arrays;
mod setup;
mod stencil_reach;
mod stiffness;
mod surface;
mod tied_boundaries;
mod tied_particles;
mod vertex_ties;
mod vertex_weights;
mod vertices;
#[doc(hidden)]
pub mod weighting;

/// Mortar contact.
pub(crate) const MORTAR: ContactType = ContactType {
    plan_entries: plan_entries::plan_entries,
    make: MortarState::of,
};

pub use error::MortarError;
pub use vertices::{BoundaryDrift, BoundaryMesh, BoundaryVertex, VertexState};

use crate::geometry::mortar::bound::NodalStiffness;
use crate::geometry::mortar::boundary::Boundary;
use crate::geometry::mortar::space::facets::Facets;
use crate::kinds::ContactType;
use crate::values::Mortar;
use boundaries::Boundaries;
use proctor_kernel::simulation::StepView;

/// State of mortar contact from step to step. Of the two dimensions one is empty.
#[derive(Clone, Debug)]
pub struct MortarState {
    /// Mortar contact of the model.
    pub(super) given: Mortar,
    /// Polylines, in two dimensions.
    pub(crate) plane: Boundaries<Boundary, 2, 9, 1>,
    /// Triangles, in three.
    pub(crate) space: Boundaries<Facets, 3, 27, 2>,
    /// Largest time step that the contact allows now \[s\].
    pub(super) time_step: f64,
    /// Largest time step in which no gap closes too far \[s\].
    pub(super) closing_step: f64,
    stiffness: NodalStiffness,
}

impl Default for MortarState {
    fn default() -> Self {
        Self {
            given: Mortar::default(),
            plane: Boundaries::default(),
            space: Boundaries::default(),
            time_step: f64::INFINITY,
            closing_step: f64::INFINITY,
            stiffness: NodalStiffness::default(),
        }
    }
}

impl MortarState {
    /// Weights of the vertices, gaps and forces of the pairs, and the time steps that they allow.
    fn meet(&mut self, view: &StepView<'_>, ahead: f64) -> Result<(), MortarError> {
        let origin = view.origin();
        self.plane.weigh(view, ahead)?;
        self.space.weigh(view, ahead)?;
        let team = &view.grid.team;
        self.plane.meet_all(ahead, &origin, team)?;
        self.space.meet_all(ahead, &origin, team)?;
        self.plane.press(view);
        self.space.press(view);
        let nodes = &mut self.stiffness;
        let plane = self.plane.time_step(nodes, view);
        self.time_step = plane.min(self.space.time_step(nodes, view));
        self.closing_step = self.plane.closing_step().min(self.space.closing_step());
        Ok(())
    }
}
