//! Nodes at which a plane with a given pressure of the pore water pushes, and the surface of the ground near such a plane.
//!
//! Water of the pressure p is at rest where the force of p inwards is sum V p grad S over the particles. With hats or domains that fill
//! the ground this is p times the area A of the surface, all of it at the node of the plane where the ground ends there or beyond;
//! ground that ends before the plane by a share u of a cell gives u of it to the next node inside. Both follow from the
//! volumes of the nodes: with h the cell along the axis, V_b that of the node beyond, V_0 that of the plane with what folds to it, and
//! V_1 that of the next one, full but for u,
//!
//! - V_b = A d²/2h and V_0 = A (h/2 + d) where the ground reaches beyond by d;
//! - V_0 = A h (1 - u)²/2 and V_1 = A h (1 - u²/2) where it ends before.
//!
//! Elsewhere, and for splines, whose domains overlap, the ground ends at the plane: V_0 = A h/2.

use super::phases::{constants, volume};
use crate::fields::{Slab, SlabField};
use crate::grid::Line;
use crate::simulation::context::StepContext;
use crate::stage::solve::plane_layers;

/// A node that a pressure pushes.
pub(super) struct PressedNode {
    /// Storage indices.
    pub at: [usize; 3],
    /// Axis of the force.
    pub axis: usize,
    /// Force along the axis \[N\].
    pub force: f64,
}

/// Calls `act` for each node at which a given pressure pushes, with the lines of skeleton and water there.
pub(super) fn each_pressed(
    slab: &mut Slab<'_>,
    context: &StepContext<'_>,
    mut act: impl FnMut(&PressedNode, &mut Line, &mut Line),
) {
    let Some(water) = constants(slab, context) else {
        return;
    };
    let last = slab.fields.len() - 1;
    let Ok([skeleton, flow]) = slab.fields.get_disjoint_mut([0, last]) else {
        return;
    };
    let shape = flow.planes.shape;
    let first = flow.planes.range.start * shape.plane_nodes();
    for plane in &context.nodal.water_pressures {
        let (beyond, layer, inside) = plane_layers(shape, plane.axis, plane.side);
        let h = shape.cell[plane.axis];
        let direction = shape.direction(plane.axis);
        let inwards = if plane.side == 0 { 1.0 } else { -1.0 };
        let SlabField { planes, .. } = flow;
        planes.for_pairs(plane.axis, layer, inside, |flow, node, next| {
            let skeleton = &mut skeleton.planes;
            if !(skeleton.nodes[node][0] > 0.0 && flow[node][0] > 0.0) {
                return;
            }
            let at = shape.indices(first + node);
            let mut at_beyond = at;
            at_beyond[direction] = beyond;
            let [row, k] = [at_beyond[1], at_beyond[2]];
            let is_there = skeleton.rows.span(at_beyond[0], row).contains(&k);
            let grains_beyond = if is_there && plane.finds_surface {
                skeleton.nodes[shape.index(at_beyond) - first][0] / water.grain_density
            } else {
                0.0
            };
            let of_plane = volume(&water, &skeleton.nodes[node], &flow[node]);
            let of_next = volume(&water, &skeleton.nodes[next], &flow[next]);
            let surface = if plane.finds_surface {
                let grains = skeleton.nodes[node][0] / water.grain_density;
                Surface::of([grains_beyond, grains], [of_plane, of_next], h)
            } else {
                Surface::at_plane(of_plane, h)
            };
            let force = inwards * plane.pressure.at(shape, at) * surface.area;
            let mut push = |node: usize, force: f64| {
                let pressed = PressedNode {
                    at: shape.indices(first + node),
                    axis: plane.axis,
                    force,
                };
                act(&pressed, &mut skeleton.nodes[node], &mut flow[node]);
            };
            push(node, (1.0 - surface.before) * force);
            if surface.before > 0.0 {
                push(next, surface.before * force);
            }
        });
    }
}

/// The surface of the ground around a node of a plane.
struct Surface {
    /// Area \[m²\].
    area: f64,
    /// Share of a cell by which it lies before the plane; zero where it lies in the plane or beyond.
    before: f64,
}

impl Surface {
    /// That of ground that ends at the plane.
    fn at_plane(volume: f64, h: f64) -> Self {
        Self {
            area: 2.0 * volume / h,
            before: 0.0,
        }
    }

    /// That of ground which fills the domains of its particles, from the grains at the node beyond and at that of the plane, and from the
    /// volumes of plane, with all water, and next node \[m³\].
    fn of([beyond, grains]: [f64; 2], [of_plane, of_next]: [f64; 2], h: f64) -> Self {
        if beyond > 0.0 {
            // The water of the node beyond is at that of the plane already.
            let all = of_plane + beyond;
            let beyond = all * (beyond / (beyond + grains));
            let root = (all + beyond).sqrt() - beyond.sqrt();
            return Self {
                area: 2.0 * root * root / h,
                before: 0.0,
            };
        }
        let ratio = of_plane / of_next;
        if ratio >= 0.5 {
            return Self::at_plane(of_plane, h);
        }
        let root = (1.0 - (1.0 + ratio) * (1.0 - 2.0 * ratio)).sqrt();
        let before = (1.0 - root) / (1.0 + ratio);
        Self {
            area: of_next / (h * (1.0 - 0.5 * before * before)),
            before,
        }
    }
}
