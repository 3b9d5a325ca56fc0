//! Contact on the grid in one slab.

use super::{GridContact, SlabContactState};
use crate::grid::contact_nodes::{Bodies, ContactStatuses, ContactVelocities};
use crate::grid::faces::SlabFields;
use crate::pairs::interface::Interface;
use crate::pairs::{Pair, surface};
use proctor_kernel::simulation::{
    Grid, Remap, SharedSlabInteraction, Slab, SlabMemory, SlabPart, StepContext, VelocityMapping,
};
use proctor_kernel::stage::solve::{ExactStepSums, Planes};
use std::any::Any;

impl GridContact {
    /// Gives what acts on each slab of a visit.
    pub(super) fn parts<'a>(
        &'a mut self,
        grid: &Grid,
        visit: VelocityMapping,
        give: &mut dyn FnMut(SlabPart<'a>),
    ) {
        if self.faces.list.is_empty() {
            return;
        }
        match visit {
            VelocityMapping::Trial => {
                self.carried = None;
                self.met
                    .resize_with(grid.slabs.len(), SlabContactState::default);
            }
            VelocityMapping::Remap(Remap::OldPositions) => {}
            VelocityMapping::Remap(Remap::NewPositions) => {
                self.shared.states.clear();
                if let Some(carried) = self.carried.take() {
                    self.shared.states = carried;
                } else {
                    let met = self.met.iter();
                    let states = met.flat_map(|met| met.meetings.states());
                    self.shared.states.extend(states);
                }
                // Particles may have been sorted since, and the planes cut into other slabs. What contact did in this step lies in
                // the old ones until the next.
                let slabs = self.met.len().max(grid.slabs.len());
                self.met.resize_with(slabs, SlabContactState::default);
            }
        }
        for (lines, met) in self.faces.in_slabs(grid).zip(&mut self.met) {
            let own = SlabMemory { state: met, lines };
            give(SlabPart::shared(&self.shared, own));
        }
    }
}

/// Data that all slabs share.
#[derive(Clone, Debug, Default)]
pub(crate) struct SharedContact {
    /// All pairs, in order of the identifiers of their bodies.
    pub pairs: Vec<Pair>,
    /// True for those of them that are near, as of the last sort.
    pub near: Vec<bool>,
    /// Particles that can reach a node of a partner, for each surface.
    pub interfaces: Vec<Interface>,
    /// Results of pairs at the nodes of all slabs, where particles have moved since.
    pub states: ContactStatuses,
}

impl SharedContact {
    /// The model as contact reads it.
    fn bodies<'b>(&'b self, context: &'b StepContext<'_>) -> Bodies<'b> {
        Bodies {
            pairs: &self.pairs,
            near: &self.near,
            interfaces: &self.interfaces,
            sets: context.particles(),
            prescribed: context.prescribed,
            walls: &context.walls,
            stencil: context.stencil(),
            family: context.family(),
        }
    }
}

/// The state of a slab, which [`GridContact`] lent to it.
fn state_of(state: &mut (dyn Any + Send)) -> &mut SlabContactState {
    state
        .downcast_mut()
        .expect("a slab of grid contact has its state")
}

impl SharedSlabInteraction for SharedContact {
    /// Mass gradients of the surfaces, folded.
    fn mapped(&self, own: &mut SlabMemory<'_>, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        for (face, interface) in own.lines.iter_mut().zip(&self.interfaces) {
            let mut planes = Planes {
                shape: slab.shape(),
                rows: &interface.rows,
                range: slab.range(),
                nodes: face.lines,
            };
            planes.clear();
            let runs = |layers| interface.in_layers(layers);
            context.map_gradient(face.body, runs, &mut planes);
            surface::fold_gradient(&mut planes, &context.walls);
        }
    }

    fn correct(
        &self,
        own: &mut SlabMemory<'_>,
        slab: &mut Slab<'_>,
        context: &StepContext<'_>,
        sums: &mut ExactStepSums,
    ) {
        let bodies = self.bodies(context);
        let mut fields = SlabFields::new(slab, &mut own.lines);
        let SlabContactState {
            meetings,
            done,
            lists,
            ..
        } = state_of(&mut *own.state);
        meetings.find(&mut fields, &bodies, lists);
        let damping = context.nodal().local_damping;
        let on = ContactVelocities::Trial {
            kick: context.nodal().kick,
            dt: context.nodal().drift,
            damping,
        };
        meetings.act(&mut fields, &bodies, on, lists, done);
        if damping.is_some() {
            // Contact does not know what the planes hold, and damps it too.
            for planes in slab.planes() {
                planes.constrain(&context.walls, true);
            }
        }
        sums.merge(&done.sums);
    }

    fn correct_remapped(
        &self,
        own: &mut SlabMemory<'_>,
        slab: &mut Slab<'_>,
        context: &StepContext<'_>,
    ) {
        let bodies = self.bodies(context);
        let mut fields = SlabFields::new(slab, &mut own.lines);
        let SlabContactState {
            meetings,
            moved,
            unheeded,
            lists,
            ..
        } = state_of(&mut *own.state);
        match context.remap {
            None => {}
            Some(Remap::OldPositions) => {
                meetings.act(
                    &mut fields,
                    &bodies,
                    ContactVelocities::Remapped,
                    lists,
                    unheeded,
                );
            }
            Some(Remap::NewPositions) => {
                moved.find(&mut fields, &bodies, lists);
                moved.recall(&self.states);
                moved.act(
                    &mut fields,
                    &bodies,
                    ContactVelocities::Mapped,
                    lists,
                    unheeded,
                );
            }
        }
    }
}
