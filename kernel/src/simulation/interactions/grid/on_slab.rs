//! Contact on the grid in one slab.

use super::{Met, State};
use crate::contact::{Pair, surface};
use crate::simulation::fields::{Grid, Slab};
use crate::simulation::interactions::grid::faces::{SlabFace, SlabFields};
use crate::simulation::interactions::grid::meeting::{Bodies, On, States};
use crate::simulation::interactions::{Again, Now, OnSlab, Visit};
use crate::simulation::interactions::{OfSlab, SlabPart};
use crate::stage::solve::{PlaneSums, Planes};
use smallvec::SmallVec;

impl State {
    /// Gives what acts on each slab of a visit.
    pub(super) fn parts<'a>(
        &'a mut self,
        grid: &Grid,
        visit: Visit,
        give: &mut dyn FnMut(SlabPart<'a>),
    ) {
        if self.faces.list.is_empty() {
            return;
        }
        match visit {
            Visit::Trial => self.met.resize_with(grid.slabs.len(), Met::default),
            Visit::Again(Again::OldPositions) => {}
            Visit::Again(Again::NewPositions) => {
                self.states.clear();
                for met in &self.met {
                    self.states.extend(met.meetings.states());
                }
                // Particles may have been sorted since.
                self.met.resize_with(grid.slabs.len(), Met::default);
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
    met: &'a mut Met,
    /// What pairs did at the nodes of all slabs, where particles have moved since.
    states: &'a States,
}

impl SlabContact<'_> {
    /// What contact knows of the scene.
    fn bodies<'b>(pairs: &'b [Pair], near: &'b [bool], now: &'b Now<'_>) -> Bodies<'b> {
        Bodies {
            pairs,
            near,
            sets: now.mapping.sets,
            prescribed: now.prescribed,
            walls: &now.walls,
            stencil: now.mapping.stencil,
            family: now.mapping.family,
        }
    }
}

impl OnSlab for SlabContact<'_> {
    /// Mass gradients of the surfaces, folded.
    fn mapped(&mut self, slab: &mut Slab<'_>, now: &Now<'_>) {
        for face in &mut self.faces {
            let mut planes = Planes {
                shape: slab.shape(),
                rows: &face.interface.rows,
                range: slab.range(),
                nodes: face.lines,
            };
            planes.clear();
            now.mapping
                .map_gradient(face.body, face.interface, &mut planes);
            surface::fold_gradient(&mut planes, &now.walls);
        }
    }

    fn correct(&mut self, slab: &mut Slab<'_>, now: &Now<'_>, sums: &mut [PlaneSums]) {
        let bodies = Self::bodies(self.pairs, self.near, now);
        let mut fields = SlabFields::new(slab, &mut self.faces);
        let Met {
            meetings,
            done,
            lists,
            ..
        } = &mut *self.met;
        meetings.find(&mut fields, &bodies, lists);
        let damping = now.acting.local_damping;
        let on = On::Trial {
            kick: now.acting.kick,
            dt: now.acting.drift,
            damping,
        };
        meetings.act(&mut fields, &bodies, on, lists, done);
        if damping.is_some() {
            // Contact does not know what the planes hold, and damps it too.
            for planes in slab.planes() {
                planes.constrain(&now.walls, true);
            }
        }
        for (sums, done) in sums.iter_mut().zip(&done.sums) {
            *sums += done;
        }
    }

    fn correct_again(&mut self, slab: &mut Slab<'_>, now: &Now<'_>) {
        let bodies = Self::bodies(self.pairs, self.near, now);
        let mut fields = SlabFields::new(slab, &mut self.faces);
        let Met {
            meetings,
            moved,
            unheeded,
            lists,
            ..
        } = &mut *self.met;
        match now.again {
            None => {}
            Some(Again::OldPositions) => {
                meetings.act(&mut fields, &bodies, On::Remapped, lists, unheeded);
            }
            Some(Again::NewPositions) => {
                moved.find(&mut fields, &bodies, lists);
                moved.recall(self.states);
                moved.act(&mut fields, &bodies, On::Mapped, lists, unheeded);
            }
        }
    }
}
