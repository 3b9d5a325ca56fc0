//! Light nodes behind a surface: nodes that a pushed body reaches with hardly any of its mass.
//!
//! A domain may reach a little way delta beyond a line of the mesh. The mass that it gives to the node behind falls with delta², its
//! force there and the derivative of its weights with delta. The acceleration of the node is then of the order 1/delta, and its part
//! in the strain of the particle does not fall with delta, though no particle feels the node. Under USL, which strains with
//! velocities of nodes, the first row of particles then carries up to 1.7 times the pressure on it.
//!
//! So a light node of a pushed particle follows: along the normal it moves with the surface, along the surface with the other nodes of
//! the particle. The momentum that this takes, at most [`LIGHT`] of that of the heaviest node beside it, is an impulse of the surface.
//! With friction nodes do not follow: a block that sticks to a slope crept 3.5e-4 of its free velocity by it.

use crate::surfaces::touch::{SurfaceTouches, TouchedNode};
use proctor_kernel::model::Vector;

/// Mass over that of the heaviest node of the same particle below which a node is light.
const LIGHT: f64 = 1e-6;

/// Light nodes that follow surfaces in a step. The lists are kept from step to step, so that a step takes no memory.
#[derive(Clone, Debug, Default)]
pub(super) struct LightNodes {
    list: Vec<LightNode>,
    /// Place in the list of each node of the touches, where any is light.
    places: Vec<Option<usize>>,
}

/// A light node that follows a surface.
#[derive(Clone, Copy, Debug)]
struct LightNode {
    /// Place in the nodes of the touches.
    node: usize,
    /// Place of a touch that pushes and reaches the node.
    touch: usize,
    /// Sum over such touches of the weight times the velocity wanted \[m/s\], and of the weights.
    wanted: Vector,
    weights: f64,
}

/// Impulse of a surface on a light node.
#[derive(Clone, Copy, Debug)]
pub(super) struct FollowingImpulse {
    /// Place of the touch whose surface gives it.
    pub(super) touch: usize,
    /// Impulse on the node \[N s\].
    pub(super) impulse: Vector,
    /// Mean velocity of the node over the step \[m/s\].
    pub(super) mean: Vector,
}

/// Lets the light nodes of pushed particles follow, after the impulses of all touches were found; `found` is scratch memory.
/// `velocity` is that of a node before contact and its increment in the step \[m/s\], `surfaces` has the velocity
/// of the surface of each touch \[m/s\], and `give` takes each impulse.
pub(super) fn follow(
    touches: &mut SurfaceTouches,
    found: &mut LightNodes,
    velocity: impl Fn(&TouchedNode) -> [Vector; 2],
    surfaces: impl Iterator<Item = Vector>,
    mut give: impl FnMut(FollowingImpulse),
) {
    let LightNodes { list, places } = found;
    list.clear();
    for (place, (touch, v_s)) in touches.list.iter().zip(surfaces).enumerate() {
        if !touch.pushes_and_holds().0 || touch.friction > 0.0 {
            continue;
        }
        let own = &touches.weights[touch.weights.clone()];
        let nodes = &touches.nodes;
        let free = own.iter().map(|(n, _)| mobility(&nodes[*n]));
        let heaviest = free.filter(|m| *m > 0.0).fold(f64::INFINITY, f64::min);
        let limit = heaviest / LIGHT;
        if !own.iter().any(|(n, _)| mobility(&nodes[*n]) > limit) {
            continue;
        }
        if list.is_empty() {
            places.clear();
            places.resize(nodes.len(), None);
        }
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        for (n, w) in own {
            let node = &nodes[*n];
            if mobility(node) <= limit {
                let [v, _] = velocity(node);
                for axis in 0..3 {
                    sum[axis] += w[axis] * (v[axis] + node.change[axis]);
                }
                total += size(w);
            }
        }
        let beside = sum.map(|s| s / total);
        let n = touch.normal;
        let across: f64 = (0..3)
            .map(|axis| n[axis] * (v_s[axis] - beside[axis]))
            .sum();
        for (node, w) in own {
            if mobility(&nodes[*node]) <= limit {
                continue;
            }
            let at = *places[*node].get_or_insert(list.len());
            if at == list.len() {
                list.push(LightNode {
                    node: *node,
                    touch: place,
                    wanted: [0.0; 3],
                    weights: 0.0,
                });
            }
            for axis in 0..3 {
                list[at].wanted[axis] += size(w) * (beside[axis] + across * n[axis]);
            }
            list[at].weights += size(w);
        }
    }
    for light in list {
        let node = &mut touches.nodes[light.node];
        let [v, dv] = velocity(node);
        let (mut impulse, mut mean) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            // A boundary gives a velocity of its own.
            if node.mobility[axis] > 0.0 {
                let change = light.wanted[axis] / light.weights - v[axis];
                impulse[axis] = (change - node.change[axis]) / node.mobility[axis];
                node.change[axis] = change;
            }
            mean[axis] = v[axis] + 0.5 * (node.change[axis] - dv[axis]);
        }
        give(FollowingImpulse {
            touch: light.touch,
            impulse,
            mean,
        });
    }
}

/// 1/m of a node along the axes in which it is free \[1/kg\].
fn mobility(node: &TouchedNode) -> f64 {
    let [x, y, z, _] = node.mobility;
    x.max(y).max(z)
}

/// Weight of a node; mirrored parts may have another sign along one axis.
fn size([x, y, z, _]: &[f64; 4]) -> f64 {
    x.abs().max(y.abs()).max(z.abs())
}
