//! Contact on the grid in one slab.

use super::{GridContact, SlabContactState};
use crate::contact::{Pair, surface};
use crate::simulation::context::{Remap, StepContext, VelocityMapping};
use crate::simulation::fields::{Grid, Slab};
use crate::simulation::interactions::grid::contact_nodes::{
    Bodies, ContactStatuses, ContactVelocities,
};
use crate::simulation::interactions::grid::faces::{SlabFace, SlabFields};
use crate::simulation::interactions::{OfSlab, SlabInteraction, SlabPart};
use crate::stage::solve::{PlaneSums, Planes};
use smallvec::SmallVec;

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
            VelocityMapping::Trial => self
                .met
                .resize_with(grid.slabs.len(), SlabContactState::default),
            VelocityMapping::Remap(Remap::OldPositions) => {}
            VelocityMapping::Remap(Remap::NewPositions) => {
                self.states.clear();
                for met in &self.met {
                    self.states.extend(met.meetings.states());
                }
                // Particles may have been sorted since.
                self.met
                    .resize_with(grid.slabs.len(), SlabContactState::default);
            }
        }
        for (faces, met) in self.faces.in_slabs(grid).zip(&mut self.met) {
            give(SlabPart(OfSlab::Grid(SlabContact {
                pairs: &self.pairs,
                near: &self.near,
                faces,
                met,
                states: &self.states,
            })));
        }
    }
}

/// Contact in one slab.
pub(in crate::simulation::interactions) struct SlabContact<'a> {
    pairs: &'a [Pair],
    near: &'a [bool],
    faces: SmallVec<[SlabFace<'a>; 4]>,
    /// Where bodies meet and what contact does there, which the equation of motion finds and leaves here.
    met: &'a mut SlabContactState,
    /// What pairs did at the nodes of all slabs, where particles have moved since.
    states: &'a ContactStatuses,
}

impl SlabContact<'_> {
    /// What contact knows of the scene.
    fn bodies<'b>(pairs: &'b [Pair], near: &'b [bool], context: &'b StepContext<'_>) -> Bodies<'b> {
        Bodies {
            pairs,
            near,
            sets: context.mapping.sets,
            prescribed: context.prescribed,
            walls: &context.walls,
            stencil: context.mapping.stencil,
            family: context.mapping.family,
        }
    }
}

impl SlabInteraction for SlabContact<'_> {
    /// Mass gradients of the surfaces, folded.
    fn mapped(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        for face in &mut self.faces {
            let mut planes = Planes {
                shape: slab.shape(),
                rows: &face.interface.rows,
                range: slab.range(),
                nodes: face.lines,
            };
            planes.clear();
            context
                .mapping
                .map_gradient(face.body, face.interface, &mut planes);
            surface::fold_gradient(&mut planes, &context.walls);
        }
    }

    fn correct(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>, sums: &mut [PlaneSums]) {
        let bodies = Self::bodies(self.pairs, self.near, context);
        let mut fields = SlabFields::new(slab, &mut self.faces);
        let SlabContactState {
            meetings,
            done,
            lists,
            ..
        } = &mut *self.met;
        meetings.find(&mut fields, &bodies, lists);
        let damping = context.nodal.local_damping;
        let on = ContactVelocities::Trial {
            kick: context.nodal.kick,
            dt: context.nodal.drift,
            damping,
        };
        meetings.act(&mut fields, &bodies, on, lists, done);
        if damping.is_some() {
            // Contact does not know what the planes hold, and damps it too.
            for planes in slab.planes() {
                planes.constrain(&context.walls, true);
            }
        }
        for (sums, done) in sums.iter_mut().zip(&done.sums) {
            *sums += done;
        }
    }

    fn correct_remapped(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        let bodies = Self::bodies(self.pairs, self.near, context);
        let mut fields = SlabFields::new(slab, &mut self.faces);
        let SlabContactState {
            meetings,
            moved,
            unheeded,
            lists,
            ..
        } = &mut *self.met;
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
                moved.recall(self.states);
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
