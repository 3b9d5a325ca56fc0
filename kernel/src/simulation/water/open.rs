//! Planes of the mesh that the pore water flows through freely.
//!
//! Domains of particles end there: what reaches beyond such a plane belongs to its nodes. A node of its own beyond the plane would
//! have a mass that falls with the square of what reaches so far, and a force of the pressure that falls with it alone. With the
//! share d of a cell that a domain is beyond, the pressure p, two particles per cell and the step dt it would accelerate by
//! 2 p/(`rho_w` h d), so that the particle loses 4 `K_w`/`rho_w` (dt/h)² of its pressure in a step, less by drag, however small d is.
//! Pressure and flux are transposes of each other here too: the mean velocity goes on beyond the plane as it is there.

use crate::fields::{Owner, Slab, SlabField};
use crate::grid::GridShape;
use crate::stage::solve::{Wall, plane_layers};
use std::ops::Range;

/// Gives the nodes of the planes that water flows through these lanes of the nodes beyond, which hold nothing then.
pub(in crate::simulation) fn fold_open(
    field: &mut SlabField<'_>,
    walls: &[Wall],
    lanes: Range<usize>,
) {
    if field.owner != Owner::Water {
        return;
    }
    let is_open = |axis: usize, side: usize| {
        !(walls.iter()).any(|wall| wall.axis == axis && wall.side == side)
    };
    each_open(field, is_open, |from, to| {
        for lane in lanes.clone() {
            to[lane] += std::mem::take(&mut from[lane]);
        }
    });
}

/// Gives the nodes beyond the planes that water flows through what particles gather from the nodes of the planes.
pub(super) fn reach_beyond(slab: &mut Slab<'_>, is_open: impl Fn(usize, usize) -> bool) {
    if let Some(field) = slab.fields.last_mut() {
        each_open(field, is_open, |beyond, plane| {
            beyond[1..].copy_from_slice(&plane[1..]);
        });
    }
}

/// Calls `act` with each node beyond an open plane and that of the plane, one axis after the other.
fn each_open(
    field: &mut SlabField<'_>,
    is_open: impl Fn(usize, usize) -> bool,
    mut act: impl FnMut(&mut [f64; 8], &mut [f64; 8]),
) {
    let shape: &GridShape = field.planes.shape;
    for axis in 0..shape.axes {
        for side in (0..2).filter(|side| is_open(axis, *side)) {
            let (beyond, plane, _) = plane_layers(shape, axis, side);
            field
                .planes
                .for_pairs(axis, beyond, plane, |nodes, beyond, plane| {
                    if let Ok([beyond, plane]) = nodes.get_disjoint_mut([beyond, plane]) {
                        act(beyond, plane);
                    }
                });
        }
    }
}
