//! The equation of motion at the nodes of one slab, the same for all velocity fields.

use crate::fields::{Grid, Owner, Slab};
use crate::grid::Line;
use crate::model::Vector;
use crate::simulation::context::{FieldNodes, Remap, StepContext, at_half_step_after};
use crate::simulation::interactions::{SlabInteraction, SlabPart};
use crate::simulation::phase::{Phase, PhaseTimer};
use crate::simulation::water;
use crate::stage::solve::{Acceleration, EmptyNode, ExactStepSums, Planes, Wall};

/// The interactions on one slab, with the timer of the phases where a visit is of one slab alone.
pub(crate) struct SlabInteractions<'v, 'a> {
    pub(crate) parts: &'v mut [SlabPart<'a>],
    pub(crate) timer: Option<&'v mut PhaseTimer>,
}

impl SlabInteractions<'_, '_> {
    /// Nothing acts.
    pub(crate) fn none() -> Self {
        Self {
            parts: &mut [],
            timer: None,
        }
    }

    /// Calls `act` for each of them, in a phase that goes on after it.
    fn act(&mut self, amid: Phase, mut act: impl FnMut(&mut dyn SlabInteraction)) {
        if self.parts.is_empty() {
            return;
        }
        self.end(amid);
        for part in &mut *self.parts {
            act(part.on_slab());
        }
        self.end(Phase::Contact);
    }

    fn end(&mut self, phase: Phase) {
        if let Some(timer) = &mut self.timer {
            timer.end(phase);
        }
    }
}

/// From mapped sums to velocities that keep to the conditions and to each other, with the sums over the nodes of the slab.
pub(crate) fn solve(
    slab: &mut Slab<'_>,
    mut interactions: SlabInteractions<'_, '_>,
    context: &StepContext<'_>,
    sums: &mut ExactStepSums,
) -> Result<(), EmptyNode> {
    let amid = Phase::P2gAndSolve;
    water::split(slab, context);
    interactions.act(amid, |part| part.mapped(slab, context));
    sums.clear();
    for number in 0..slab.fields.len() {
        equation_of_motion(&mut FieldNodes {
            slab,
            number,
            context,
            sums,
        })?;
    }
    interactions.act(amid, |part| {
        part.correct(slab, context, sums);
    });
    water::drag(slab, context, sums);
    unfold(slab, context, true);
    water::share_beyond(slab, context);
    if !context.settles {
        add_sums(slab, context, sums);
    }
    Ok(())
}

/// From the mapped sums of a field to trial velocities that keep to its conditions.
fn equation_of_motion(field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
    let context = field.context;
    if let Some(velocities) = context.prescribed(field.owner()) {
        prescribe(field.parts().0, velocities, &context.walls);
        return Ok(());
    }
    let owner = field.owner();
    for condition in context.conditions_of(owner) {
        condition.before(field)?;
    }
    let by = context.acceleration();
    let driven = match owner {
        Owner::Phase => &context.nodal.driven[..],
        Owner::Body(_) | Owner::Water => &[],
    };
    let (planes, _, sums) = field.parts();
    planes.leave_out_prescribed(
        &by,
        context.walls_of(owner),
        [&context.nodal.held, driven],
        sums,
    );
    planes.accelerate(&by, sums);
    for condition in context.conditions_of(owner) {
        condition.after(field);
    }
    Ok(())
}

/// Ghost nodes of all fields, and the sums with the velocities that they hold.
pub(crate) fn sums_after(slab: &mut Slab<'_>, context: &StepContext<'_>, sums: &mut ExactStepSums) {
    unfold(slab, context, true);
    sums.clear();
    add_sums(slab, context, sums);
}

/// After the first mapping of a step: what lies beyond the walls folded back, and velocities from momenta.
pub(crate) fn fold(slab: &mut Slab<'_>, context: &StepContext<'_>) {
    for field in &mut slab.fields {
        water::fold_open(field, context.walls_of(field.owner), 0..8);
        field.planes.fold(context.walls_of(field.owner), true, true);
        field.planes.velocities();
    }
}

/// Fills the ghost nodes of all fields.
fn unfold(slab: &mut Slab<'_>, context: &StepContext<'_>, increments: bool) {
    for field in &mut slab.fields {
        (field.planes).unfold(context.walls_of(field.owner), increments);
    }
}

/// Adds the sums of all fields whose motion is not prescribed.
fn add_sums(slab: &mut Slab<'_>, context: &StepContext<'_>, sums: &mut ExactStepSums) {
    for number in 0..slab.fields.len() {
        if context.prescribed(slab.fields[number].owner).is_some() {
            continue;
        }
        if context.measure {
            let planes = &slab.fields[number].planes;
            planes.measure(context.nodal.kick, sums);
        }
        for condition in context.conditions_of(slab.fields[number].owner) {
            condition.settled(&mut FieldNodes {
                slab,
                number,
                context,
                sums,
            });
        }
    }
}

/// From sums that were mapped again, to the upper lanes (MUSL), to velocities that keep to the conditions and to each
/// other.
pub(crate) fn solve_remapped(
    slab: &mut Slab<'_>,
    mut interactions: SlabInteractions<'_, '_>,
    context: &StepContext<'_>,
) {
    for number in 0..slab.fields.len() {
        let field = &mut slab.fields[number];
        field.planes.clear_upper();
        if let Some([_, after]) = context.prescribed(field.owner) {
            let planes = &mut field.planes;
            for_masses(planes, |line| line[4..7].copy_from_slice(after));
            planes.constrain_remapped(&context.walls);
        } else {
            context.mapping.run_field(field);
            water::fold_open(field, context.walls_of(field.owner), 4..7);
            field.planes.fold_remapped(context.walls_of(field.owner));
            field.planes.remapped_velocities();
            remap_conditions(slab, number, context);
        }
    }
    // Contact keeps to the planes once the fields do; the ghosts are filled after it.
    interactions.act(Phase::Remap, |part| {
        part.correct_remapped(slab, context);
        for field in &mut slab.fields {
            (field.planes).constrain_remapped(context.walls_of(field.owner));
        }
    });
}

/// The same for momentum that was mapped at new positions, to the lower lanes (USF).
pub(crate) fn solve_mapped(
    slab: &mut Slab<'_>,
    mut interactions: SlabInteractions<'_, '_>,
    context: &StepContext<'_>,
) {
    context.mapping.run(slab);
    for field in &mut slab.fields {
        (field.planes).fold(context.walls_of(field.owner), true, false);
        field.planes.velocities();
    }
    interactions.act(Phase::Remap, |part| part.mapped(slab, context));
    for number in 0..slab.fields.len() {
        let field = &mut slab.fields[number];
        if let Some(velocities) = context.prescribed(field.owner) {
            prescribe(&mut field.planes, velocities, &context.walls);
        } else {
            remap_conditions(slab, number, context);
        }
    }
    interactions.act(Phase::Remap, |part| {
        part.correct_remapped(slab, context);
    });
    unfold(slab, context, false);
}

/// Conditions on the velocities of a field that were mapped a second time.
fn remap_conditions(slab: &mut Slab<'_>, number: usize, context: &StepContext<'_>) {
    let owner = slab.fields[number].owner;
    for condition in context.conditions_of(owner) {
        condition.remap(&mut FieldNodes {
            slab,
            number,
            context,
            sums: &mut ExactStepSums::default(),
        });
    }
}

/// Gives the nodes of a driven body its velocity.
fn prescribe(planes: &mut Planes<'_>, [before, after]: &[Vector; 2], walls: &[Wall]) {
    for_masses(planes, |line| {
        for axis in 0..3 {
            line[1 + axis] = after[axis];
            line[4 + axis] = after[axis] - before[axis];
        }
    });
    planes.constrain(walls, true);
}

/// Calls `act` for every node in use that has mass.
fn for_masses(planes: &mut Planes<'_>, act: impl Fn(&mut Line)) {
    planes.for_rows(|row| row.iter_mut().filter(|line| line[0] > 0.0).for_each(&act));
}

impl StepContext<'_> {
    /// The first mapping of a step: mass, velocity and force of all fields; the number of groups in the layers of
    /// particles that the slab owns.
    pub(crate) fn map(&self, slab: &mut Slab<'_>) -> usize {
        let groups = self.mapping.run(slab);
        fold(slab, self);
        groups
    }

    /// Groups of the own particles of a rank that shares the rows of its planes; those of whole layers are counted in the mapping.
    pub(crate) fn groups_of_rows(&self, grid: &Grid) -> usize {
        if grid.shares_rows() {
            self.mapping.groups_of_rows(&grid.block(), &grid.shape)
        } else {
            0
        }
    }

    /// The same for a second mapping, of the velocities after the kick.
    pub(crate) fn remap(mut self, remap: Remap) -> Self {
        self.walls = at_half_step_after(&self.walls);
        self.remap = Some(remap);
        self
    }

    /// Terms of the acceleration beside stress.
    fn acceleration(&self) -> Acceleration {
        Acceleration {
            gravity: self.nodal.gravity,
            local_damping: self.nodal.local_damping,
            kick: self.nodal.kick,
        }
    }

    /// Velocities half a step before and after \[m/s\] where the motion of the whole field is prescribed.
    pub(crate) fn prescribed(&self, owner: Owner) -> Option<&[Vector; 2]> {
        self.prescribed[owner.body()?].as_ref()
    }
}
