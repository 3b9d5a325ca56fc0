//! Surfaces of the bodies near a contact partner, at the nodes beside their velocity fields.
//!
//! A second line per node holds the mass gradient, and the interface the particles that can share a node with a partner.
//! Both are there for exactly the bodies that have a field because of this contact.

use crate::pairs::Pair;
use crate::pairs::broad::BodyReach;
use crate::pairs::interface::Interface;
use proctor_kernel::grid::{GridShape, Line, Nodes};
use proctor_kernel::simulation::{Grid, OwnLines, Owner, Slab, StepView};
use proctor_kernel::stage::solve::Planes;
use smallvec::SmallVec;
use std::ops::Range;

/// The surface of one body.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    /// Index of the body.
    pub body: usize,
    /// Second lines of the nodes.
    pub lines: Nodes,
}

/// The surfaces of all bodies near a partner, in order of the identifier of the body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Faces {
    /// The surfaces.
    pub list: Vec<Face>,
}

/// A slab with the surfaces of its bodies. A field is known by its number in the slab.
pub(crate) struct SlabFields<'s, 'a, 'b> {
    /// The fields.
    pub slab: &'s mut Slab<'a>,
    /// The surfaces.
    pub faces: &'s mut [OwnLines<'b>],
    /// Place of the surface of each field.
    places: SmallVec<[Option<usize>; 4]>,
}

impl<'s, 'a, 'b> SlabFields<'s, 'a, 'b> {
    /// Brings fields and surfaces together.
    pub(crate) fn new(slab: &'s mut Slab<'a>, faces: &'s mut [OwnLines<'b>]) -> Self {
        let place = |owner: Owner| faces.iter().position(|f| owner == Owner::Body(f.body));
        let places = slab.fields.iter().map(|f| place(f.owner)).collect();
        Self {
            slab,
            faces,
            places,
        }
    }

    /// Number of fields.
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.slab.fields.len()
    }

    /// Shape of the grid.
    #[must_use]
    pub(crate) fn shape(&self) -> &'a GridShape {
        self.slab.shape()
    }

    /// Indices of the planes.
    #[must_use]
    pub(crate) fn range(&self) -> Range<usize> {
        self.slab.range()
    }

    /// Planes of a field.
    #[must_use]
    pub(crate) fn planes(&self, number: usize) -> &Planes<'a> {
        &self.slab.fields[number].planes
    }

    /// Nodes of a field.
    pub(crate) fn nodes_mut(&mut self, number: usize) -> &mut [Line] {
        self.slab.fields[number].planes.nodes
    }

    /// Place among the surfaces of that of a field, if contact keeps one.
    #[must_use]
    pub(crate) fn place_of(&self, number: usize) -> Option<usize> {
        self.places[number]
    }
}

impl Faces {
    /// Makes surfaces for exactly these bodies of near pairs (indices in order of the identifier).
    pub(crate) fn set(
        &mut self,
        bodies: &[usize],
        pairs: &[Pair],
        near: &[bool],
        view: &StepView<'_>,
        interfaces: &mut Vec<Interface>,
    ) {
        let known = self.list.iter().map(|face| face.body);
        if !known.eq(bodies.iter().copied()) {
            let mut old: Vec<(Face, Interface)> = std::mem::take(&mut self.list)
                .into_iter()
                .zip(interfaces.drain(..))
                .collect();
            for &body in bodies {
                let known = old.iter().position(|(face, _)| face.body == body);
                let (face, interface) = known.map_or_else(
                    || {
                        let lines = Nodes::new(view.grid.shape.nodes.iter().product());
                        (Face { body, lines }, Interface::default())
                    },
                    |at| old.swap_remove(at),
                );
                self.list.push(face);
                interfaces.push(interface);
            }
        }
        let mut reach = BodyReach::new(view);
        for (face, interface) in self.list.iter().zip(interfaces) {
            interface.find(face.body, pairs, near, (view, &mut reach));
        }
    }

    /// The surfaces in one slab after the other.
    pub(crate) fn in_slabs<'a>(
        &'a mut self,
        grid: &Grid,
    ) -> impl Iterator<Item = SmallVec<[OwnLines<'a>; 4]>> {
        let per_plane = grid.shape.plane_nodes();
        let list = self.list.iter_mut();
        let mut rest: SmallVec<[_; 4]> = list
            .map(|face| {
                let before = grid.slabs[0].start * per_plane;
                (face.body, &mut face.lines.lines_mut()[before..])
            })
            .collect();
        grid.slabs.iter().map(move |range| {
            let faces = rest.iter_mut().map(|(body, rest)| OwnLines {
                body: *body,
                lines: rest
                    .split_off_mut(..range.len() * per_plane)
                    .unwrap_or_default(),
            });
            faces.collect()
        })
    }
}
