//! Weights of vertices on the nodes of their bodies.
//!
//! The stress of a body that ends at a face gives a node the weight of the face itself, so a traction has to give it that weight,
//! too, or the rows of particles behind the face do not have its pressure. Augmented weights (eq. 27) go by the mass: they give a
//! node beyond the face, which a face at d of a cell reaches with the weight d and the mass d²/2, a share of d³ and not of d.
//! Their reason is the acceleration of such a node. But the spring of the contact adds w²/m to the square of a frequency, not w/m,
//! and d²/(d²/2) is no large number. So a node has the weight of the face where its mass bears it, up to w²/m = `BEARS` over the
//! mass of a full cell: 2 at a face, 4 at an edge. What is more, where the boundary is off the particles by drift, goes by
//! augmented weights. So does all of it on round and oblique faces ([`faces`](super::faces)).
//!
//! Where d is as small as what a vertex is off the end of the particles, by drift or by a strain of uGIMP's domains that stay as
//! they are, the place of the vertex does not know d. A vertex above that node would leave it without a force against the stress
//! behind it, which goes to zero with the first row's, and all of the pressure to the second; the mass knows d.
//!
//! Vertices that nothing presses on keep augmented weights. With MUSL the force that is left at a light node strains nothing, since
//! particles are strained by velocities that are mapped once more, and a vertex on a free face would go away with that node; one
//! that is pressed goes until its pressure balances the node.

use super::mirrors::Mirrors;
use super::patch::{Patch, nodes_of_patch};
use super::weighting::{face_weights, vertex_weights};
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::motion::FollowMode;
use crate::geometry::mortar::weights::LostVertex;
use proctor_kernel::grid::{ActiveRows, GridShape, Line};
use proctor_kernel::simulation::StepView;
use proctor_kernel::weights::Family;
use std::array;

/// Most of the square of a weight over the mass of its node, times the mass of a full cell.
const BEARS: f64 = 4.0;

/// Conditions on which the weights of the vertices of one body depend.
pub(super) struct VertexWeighting<'a, const D: usize> {
    pub(super) shape: &'a GridShape,
    pub(super) mirrors: Mirrors,
    /// Nodes of the body's field.
    pub(super) lines: &'a [Line],
    rows: &'a ActiveRows,
    family: Family,
    inverse_cell: [f64; 3],
    /// Half-length of the domain of a vertex in cells, for augmented weights.
    half_length: f64,
    /// Along each axis, how many particles a domain is long, and how far apart their middles are in cells.
    parts: [(usize, f64); D],
    /// Most of the square of a weight over the mass of its node \[1/kg\].
    bears: f64,
    /// Along each axis, the mass of a full cell times how many particles a domain is long \[kg\].
    full: [f64; D],
}

impl<'a, const D: usize> VertexWeighting<'a, D> {
    /// Weights of a body; `None` where it has no field of its own.
    pub(super) fn of(view: &StepView<'a>, index: usize) -> Option<Self> {
        let field = view.grid.own_field(index)?;
        let body = &view.bodies[index];
        let (mapping, shape) = (&body.mapping, &view.grid.shape);
        let cell: f64 = mapping.cell[..D].iter().product();
        let parts = array::from_fn(|axis| {
            let particle = body.particle_half_length[axis] * mapping.inverse_cell[axis];
            let domain = mapping.half_length[axis];
            let count = ((domain / particle + 0.5) as usize).max(1);
            (count, 2.0 * domain / count as f64)
        });
        let full = body.density * cell;
        Some(Self {
            shape,
            mirrors: Mirrors::of(view.settings),
            lines: field.nodes.lines(),
            rows: &field.rows,
            family: mapping.family,
            inverse_cell: mapping.inverse_cell,
            half_length: mapping.half_length[..D].iter().copied().fold(0.5, f64::min),
            parts,
            bears: BEARS / full,
            full: parts.map(|(count, _)| full * count as f64),
        })
    }

    fn in_cells(&self, x: &PointIn<D>) -> PointIn<D> {
        PointIn::from_fn(|axis, _| x[axis] * self.inverse_cell[axis])
    }

    /// Finds the nodes of a vertex at a place, and its weights on them.
    ///
    /// # Errors
    /// [`LostVertex`] where no node near it has mass.
    #[inline]
    pub(super) fn weigh<const N: usize>(
        &self,
        x: &PointIn<D>,
        follow: FollowMode,
        patch: &mut Patch<D, N>,
    ) -> Result<(), LostVertex> {
        let xi = self.in_cells(x);
        let raw = vertex_weights::<D, N>(self.family, &xi, self.half_length);
        let raw = self.mirrors.fold(raw);
        nodes_of_patch::<D, N>(raw.base, self.shape, self.rows, self.lines, patch);
        patch.off = None;
        patch.weights = if follow == FollowMode::Unaugmented {
            raw.on_mass(&patch.masses)
        } else {
            let masses = self.mirrors.with_images(raw.base, patch.masses);
            raw.augmented(&masses)?
        };
        Ok(())
    }

    /// Gives a vertex that contact presses on a share of the weights of the face where its nodes bear them; the rest keeps the
    /// augmented ones that it has.
    pub(super) fn press<const N: usize>(
        &self,
        x: &PointIn<D>,
        share: f64,
        patch: &mut Patch<D, N>,
    ) {
        let at_face = face_weights::<D, N>(&self.in_cells(x), &self.parts);
        let at_face = self.mirrors.fold(at_face);
        let masses = self.mirrors.with_images(at_face.base, patch.masses);
        let reached = at_face.as_reached(&masses, &self.full);
        let mut weights = reached.borne(&masses, self.bears, &patch.weights);
        if share < 1.0 {
            for (w, augmented) in weights.weights.iter_mut().zip(patch.weights.weights) {
                *w = share * *w + (1.0 - share) * augmented;
            }
        }
        let off = weights.distance(&at_face);
        patch.weights = weights;
        patch.off = Some(PointIn::from_fn(|axis, _| {
            off[axis] * self.shape.cell[axis]
        }));
    }
}
