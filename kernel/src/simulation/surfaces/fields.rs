//! The velocity fields of the grid as surfaces see them.
//!
//! A body near a partner of contact has a layer of its own, which a surface pushes alone. Where a body without a pair
//! has a layer too, or lies in the common field, both share their velocity, before and after the surface. Contact between
//! bodies acts first: at a node that both reach the surface has the last word, and what it brings partners closer by is
//! left to their contact in the next step.

use crate::contact::Pair;
use crate::contact::layers::{Layers, joined};
use crate::grid::{ActiveRows, Line};
use crate::simulation::field::Field;
use crate::simulation::{BodyRun, Simulation};
use crate::stage::touch::{TouchedNode, apply};

/// All velocity fields, known by their numbers: 0 the common one, then the layers.
pub(super) struct Fields<'a> {
    common: &'a Field,
    layers: &'a Layers,
    bodies: &'a [BodyRun],
    /// Whether two fields share their velocity, row by row.
    joined: Vec<bool>,
}

impl<'a> Fields<'a> {
    pub(super) fn new(
        common: &'a Field,
        layers: &'a Layers,
        bodies: &'a [BodyRun],
        pairs: &[Pair],
    ) -> Self {
        let of_layers: Vec<usize> = layers.list.iter().map(|l| l.body).collect();
        Self {
            common,
            layers,
            bodies,
            joined: joined(&of_layers, pairs),
        }
    }

    /// The field of a body.
    pub(super) fn of(&self, body: usize) -> usize {
        let layer = self.layers.list.iter().position(|l| l.body == body);
        layer.map_or(0, |layer| layer + 1)
    }

    /// Nodes of a field.
    pub(super) fn lines(&self, field: usize) -> &'a [Line] {
        self.at(field).1
    }

    fn at(&self, field: usize) -> (&'a ActiveRows, &'a [Line]) {
        match field.checked_sub(1).map(|i| &self.layers.list[i]) {
            None => (&self.common.rows, self.common.nodes.lines()),
            Some(layer) => (&layer.rows, layer.nodes.lines()),
        }
    }

    /// Mass of a field at a node \[kg\]; zero outside the rows in use, where old values lie.
    pub(super) fn mass(&self, field: usize, node: usize) -> f64 {
        let [plane, row, k] = self.common.shape.indices(node);
        let (rows, lines) = self.at(field);
        if rows.span(plane, row).contains(&k) {
            lines[node][0]
        } else {
            0.0
        }
    }

    /// Whether the motion of the body of a layer is prescribed.
    pub(super) fn is_driven(&self, field: usize) -> bool {
        let layer = field.checked_sub(1).map(|i| &self.layers.list[i]);
        layer.is_some_and(|layer| self.bodies[layer.body].motion.is_some())
    }

    /// The fields that share their velocity with `field` at a node, it among them, increasing.
    pub(super) fn sharing(&self, field: usize, node: usize) -> Vec<usize> {
        let count = self.layers.list.len() + 1;
        if count == 1 {
            return vec![0];
        }
        let present: Vec<usize> = (0..count)
            .filter(|&f| f == field || self.mass(f, node) > 0.0)
            .collect();
        let mut found = vec![field];
        let mut looked = 0;
        while let Some(&from) = found.get(looked) {
            for &other in &present {
                if self.joined[from * count + other] && !found.contains(&other) {
                    found.push(other);
                }
            }
            looked += 1;
        }
        found.sort_unstable();
        found
    }
}

impl Simulation {
    pub(super) fn all_fields(&self) -> Fields<'_> {
        let contact = &self.contact;
        Fields::new(&self.field, &contact.layers, &self.bodies, &contact.pairs)
    }

    /// Adds the changes of touched nodes to the velocities of all their fields, in the lanes from `lane` on, and where
    /// asked for to their increments.
    pub(super) fn change_velocities(
        &mut self,
        nodes: &[TouchedNode],
        lane: usize,
        increments: bool,
    ) {
        apply(nodes, 0, self.field.nodes.lines_mut(), lane, increments);
        for (i, layer) in self.contact.layers.list.iter_mut().enumerate() {
            apply(nodes, i + 1, layer.nodes.lines_mut(), lane, increments);
        }
    }
}
