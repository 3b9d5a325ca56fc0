//! Light nodes behind a surface: nodes that a touching body reaches with hardly any of its mass.
//!
//! A domain may reach a little way delta beyond a line of the mesh. The mass that it gives to the node behind falls with delta², its
//! force there and the derivative of its weights with delta. The acceleration of the node is then of the order 1/delta, and its part
//! in the strain of the particle does not fall with delta, though no particle feels the node. Under USL, which strains with
//! velocities of nodes, the first row of particles then carries up to 1.7 times the pressure on it.
//!
//! So a light node follows: along the normal it moves with the surface, along the surface with the other nodes of the particle.
//! What this neglects is the momentum of the node, at most [`LIGHT`] of that of the heaviest node beside it.

use crate::scene::Vector;
use crate::stage::touch::{SurfaceTouches, TouchedNode};

/// Mass over that of the heaviest node of the same particle below which a node is light.
const LIGHT: f64 = 1e-6;

/// Lets light nodes follow: their velocity is given, and no impulse moves them. `velocity` is that of a node before contact \[m/s\],
/// `surfaces` has that of the surface of each touch \[m/s\].
pub(super) fn follow(
    touches: &mut SurfaceTouches,
    velocity: impl Fn(&TouchedNode) -> Vector,
    surfaces: impl Iterator<Item = Vector>,
) {
    let SurfaceTouches {
        list,
        weights,
        nodes,
        ..
    } = touches;
    // The fourth entry of a change sums the weights, and is zero again at the end.
    const SUM: usize = 3;
    let mut any = false;
    for (touch, v_s) in list.iter().zip(surfaces) {
        let own = &weights[touch.weights.clone()];
        let free = own.iter().map(|(n, _)| mobility(&nodes[*n]));
        let heaviest = free.filter(|m| *m > 0.0).fold(f64::INFINITY, f64::min);
        let limit = heaviest / LIGHT;
        if !own.iter().any(|(n, _)| mobility(&nodes[*n]) > limit) {
            continue;
        }
        any = true;
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        for (n, w) in own {
            if mobility(&nodes[*n]) <= limit {
                let v = velocity(&nodes[*n]);
                for axis in 0..3 {
                    sum[axis] += w[axis] * v[axis];
                }
                total += size(w);
            }
        }
        let beside = sum.map(|s| s / total);
        let normal = touch.normal;
        let across: f64 = (0..3)
            .map(|axis| normal[axis] * (v_s[axis] - beside[axis]))
            .sum();
        for (n, w) in own {
            let node = &mut nodes[*n];
            if mobility(node) > limit {
                for axis in 0..3 {
                    node.change[axis] += size(w) * (beside[axis] + across * normal[axis]);
                }
                node.change[SUM] += size(w);
            }
        }
    }
    if !any {
        return;
    }
    for node in nodes.iter_mut().filter(|node| node.change[SUM] > 0.0) {
        let v = velocity(node);
        for axis in 0..3 {
            let wanted = node.change[axis] / node.change[SUM];
            // A boundary gives a velocity of its own.
            let free = node.mobility[axis] > 0.0;
            node.change[axis] = if free { wanted - v[axis] } else { 0.0 };
        }
        node.change[SUM] = 0.0;
        node.mobility = [0.0; 4];
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
