//! The velocity fields of the grid as surfaces see them.
//!
//! A body near a partner of contact has a field of its own, which a surface pushes alone. Where a body without a pair
//! has one too, or lies in the field of the phase, both share their velocity, before and after the surface. Contact between
//! bodies acts first: at a node that both reach the surface has the last word, and what it brings partners closer by is
//! left to their contact in the next step.

use crate::surfaces::touch::SurfaceTouches;
use proctor_kernel::grid::Line;
use proctor_kernel::simulation::{BodyRun, Grid, StepView};

/// All velocity fields, known by their numbers.
pub(super) struct Fields<'a> {
    grid: &'a Grid,
    bodies: &'a [BodyRun],
}

impl<'a> Fields<'a> {
    /// The field of a body.
    pub(super) fn of(&self, body: usize) -> usize {
        self.grid.number_of(body)
    }

    /// Nodes of a field.
    pub(super) fn lines(&self, field: usize) -> &'a [Line] {
        self.grid.fields[field].nodes.lines()
    }

    /// Mass of a field at a node \[kg\].
    pub(super) fn mass(&self, field: usize, node: usize) -> f64 {
        self.grid.fields[field].mass(&self.grid.shape, node)
    }

    /// True if the motion of the body of a field is prescribed.
    pub(super) fn is_driven(&self, field: usize) -> bool {
        let body = self.grid.fields[field].owner.body();
        body.is_some_and(|body| self.bodies[body].motion.is_some())
    }

    /// The lowest of the fields that share their velocity with `field` at a node, it among them; the others, increasing, are
    /// added to a list.
    pub(super) fn sharing(&self, [field, node]: [usize; 2], others: &mut Vec<usize>) -> usize {
        let count = self.grid.fields.len();
        if count == 1 {
            return 0;
        }
        let start = others.len();
        others.push(field);
        let mut looked = start;
        while let Some(&from) = others.get(looked) {
            for other in 0..count {
                if self.grid.joined[from * count + other]
                    && self.mass(other, node) > 0.0
                    && !others[start..].contains(&other)
                {
                    others.push(other);
                }
            }
            looked += 1;
        }
        others[start..].sort_unstable();
        others.remove(start)
    }
}

impl<'a> Fields<'a> {
    /// Fields of a step.
    pub(super) fn of_step(view: &StepView<'a>) -> Self {
        Self {
            grid: view.grid,
            bodies: view.bodies,
        }
    }
}

/// Adds the changes of touched nodes to the velocities of all their fields, in the lanes from `lane` on, and where
/// asked for to their increments.
pub(super) fn change_velocities(
    grid: &mut Grid,
    touches: &SurfaceTouches,
    lane: usize,
    increments: bool,
) {
    for (number, field) in grid.fields.iter_mut().enumerate() {
        touches.apply(number, field.nodes.lines_mut(), lane, increments);
    }
}
