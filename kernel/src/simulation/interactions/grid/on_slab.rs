//! Contact on the grid in one slab.

use crate::simulation::interactions::grid::faces::{SlabFace, SlabFields};
use crate::simulation::interactions::grid::meeting::{Bodies, Meetings, On, States};
use super::{Met, State};
use crate::contact::{Pair, surface};
use crate::simulation::fields::{Grid, Slab};
use crate::simulation::interactions::{Again, Now, OnSlab, Visit};
use crate::stage::solve::{PlaneSums, Planes};
use std::sync::Arc;

impl State {
    /// What acts on each slab of a visit.
    pub(super) fn parts(&mut self, grid: &Grid, visit: Visit) -> Vec<Box<dyn OnSlab + '_>> {
        if self.faces.list.is_empty() {
            return vec![];
        }
        let known: Vec<Known<'_>> = match visit {
            Visit::Trial => {
                self.met.clear();
                self.met.resize(grid.slabs.len(), Met::default());
                self.met.iter_mut().map(Known::Nothing).collect()
            }
            Visit::Again(Again::OldPositions) => {
                let meetings = self.met.iter_mut().map(|met| &mut met.meetings);
                meetings.map(Known::Meetings).collect()
            }
            Visit::Again(Again::NewPositions) => {
                let before = self.met.iter().flat_map(|met| met.meetings.states());
                let states = Arc::new(before.collect());
                let of_slab = |_| Known::States(Arc::clone(&states));
                grid.slabs.iter().map(of_slab).collect()
            }
        };
        let faces = self.faces.split(grid);
        let (pairs, near) = (&self.pairs[..], &self.near[..]);
        let parts = faces.into_iter().zip(known).map(|(faces, known)| {
            let part: Box<dyn OnSlab + '_> = Box::new(SlabContact {
                pairs,
                near,
                faces,
                known,
            });
            part
        });
        parts.collect()
    }
}

/// What is known of this step's contact when a slab is visited.
enum Known<'a> {
    /// Nothing yet: the equation of motion finds where bodies meet, and leaves here what contact does.
    Nothing(&'a mut Met),
    /// Where bodies meet, and what contact did there: particles have not moved since.
    Meetings(&'a mut Meetings),
    /// What pairs did at the nodes of all slabs, before particles moved.
    States(Arc<States>),
}

/// Contact in one slab.
struct SlabContact<'a> {
    pairs: &'a [Pair],
    near: &'a [bool],
    faces: Vec<SlabFace<'a>>,
    known: Known<'a>,
}

impl SlabContact<'_> {
    /// What contact knows of the scene, with what it is to know of each body.
    fn bodies<'b>(
        pairs: &'b [Pair],
        near: &'b [bool],
        now: &'b Now<'_>,
        driven: &'b [bool],
    ) -> Bodies<'b> {
        Bodies {
            pairs,
            near,
            sets: now.mapping.sets,
            driven,
            walls: &now.walls,
            stencil: now.mapping.stencil,
        }
    }
}

/// By body: whether its motion is prescribed.
fn driven(now: &Now<'_>) -> Vec<bool> {
    now.prescribed.iter().map(Option::is_some).collect()
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
        let driven = driven(now);
        let bodies = Self::bodies(self.pairs, self.near, now, &driven);
        let mut fields = SlabFields::new(slab, &mut self.faces);
        let mut meetings = Meetings::find(&mut fields, &bodies);
        let damping = now.acting.local_damping;
        let on = On::Trial {
            kick: now.acting.kick,
            dt: now.acting.drift,
            damping,
        };
        let done = meetings.act(&mut fields, &bodies, on);
        if damping.is_some() {
            // Contact does not know what the planes hold, and damps it too.
            for planes in slab.planes() {
                planes.constrain(&now.walls, true);
            }
        }
        for (sums, done) in sums.iter_mut().zip(&done.sums) {
            *sums += done;
        }
        if let Known::Nothing(met) = &mut self.known {
            **met = Met { meetings, done };
        }
    }

    fn correct_again(&mut self, slab: &mut Slab<'_>, now: &Now<'_>) {
        let driven = driven(now);
        let bodies = Self::bodies(self.pairs, self.near, now, &driven);
        let mut fields = SlabFields::new(slab, &mut self.faces);
        match &mut self.known {
            Known::Nothing(_) => {}
            Known::Meetings(meetings) => {
                meetings.act(&mut fields, &bodies, On::Remapped);
            }
            Known::States(states) => {
                let mut meetings = Meetings::find(&mut fields, &bodies);
                meetings.recall(states);
                meetings.act(&mut fields, &bodies, On::Mapped);
            }
        }
    }
}
