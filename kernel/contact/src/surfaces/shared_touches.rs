//! Touches of all ranks: sweeps go over all particles that touch, so each rank has them all and finds the same impulses.

use super::pushed_particle::TouchKey;
use super::touch_fault::TouchFault;
use crate::surfaces::touch::{SurfaceTouch, SurfaceTouches, TouchedNode};
use proctor_kernel::ranks::{Ranks, Words};
use proctor_kernel::simulation::ParticleAt;
use std::collections::HashMap;

/// Puts the touches of all ranks in the place of those of this one, in the order in which one process has them; the first fault of
/// any rank, in the same order.
pub(super) fn share(
    ranks: &dyn Ranks,
    (keys, touches): (&mut Vec<TouchKey>, &mut SurfaceTouches),
    fault: Option<&(TouchKey, TouchFault)>,
) -> Option<(TouchKey, TouchFault)> {
    let mut words = vec![];
    pack_fault(fault, &mut words);
    pack(keys, touches, &mut words);
    let all = ranks.all_gather(&words);
    let mut first: Option<(TouchKey, TouchFault)> = None;
    let mut found = vec![];
    for words in &all {
        let mut words = Words::of(words);
        let fault = unpack_fault(&mut words);
        if let Some((key, fault)) = fault
            && first.as_ref().is_none_or(|(before, _)| key < *before)
        {
            first = Some((key, fault));
        }
        unpack(&mut words, &mut found);
    }
    found.sort_by_key(|touch| touch.key);
    keys.clear();
    touches.clear();
    let mut places = HashMap::new();
    for PackedTouch {
        key,
        mut touch,
        nodes,
    } in found
    {
        let start = touches.weights.len();
        for (node, weight) in nodes {
            let place = *places.entry(node.identity()).or_insert_with(|| {
                let others = touches.others.len();
                touches.others.extend(&node.others);
                let others = others..touches.others.len();
                touches.nodes.push(TouchedNode {
                    others,
                    ..node.values
                });
                touches.nodes.len() - 1
            });
            touches.weights.push((place, weight));
        }
        touch.weights = start..touches.weights.len();
        touches.list.push(touch);
        keys.push(key);
    }
    first
}

/// A touch with its nodes.
struct PackedTouch {
    key: TouchKey,
    touch: SurfaceTouch,
    nodes: Vec<(PackedNode, [f64; 4])>,
}

/// A touched node with its further fields.
struct PackedNode {
    values: TouchedNode,
    others: Vec<usize>,
}

impl PackedNode {
    /// Fields and index, by which two nodes are the same.
    fn identity(&self) -> (usize, usize, Vec<usize>) {
        (self.values.field, self.values.node, self.others.clone())
    }
}

/// Touches as words: their number, then each with its key, its numbers, and its nodes.
fn pack(keys: &[TouchKey], touches: &SurfaceTouches, words: &mut Vec<u64>) {
    words.push(keys.len() as u64);
    for (key, touch) in keys.iter().zip(&touches.list) {
        pack_key(*key, words);
        let SurfaceTouch {
            weights,
            normal: [n0, n1, n2],
            relative: [r0, r1, r2],
            gap,
            bound,
            floor,
            penalty,
            friction,
            ..
        } = touch.clone();
        let numbers = [n0, n1, n2, r0, r1, r2, gap, bound, floor, penalty, friction];
        words.extend(numbers.map(f64::to_bits));
        words.push(weights.len() as u64);
        for (place, weight) in &touches.weights[weights] {
            words.extend(weight.map(f64::to_bits));
            pack_node(&touches.nodes[*place], touches, words);
        }
    }
}

fn pack_node(node: &TouchedNode, touches: &SurfaceTouches, words: &mut Vec<u64>) {
    let others = &touches.others[node.others.clone()];
    words.extend([node.node, node.field, others.len()].map(|word| word as u64));
    words.extend(others.iter().map(|field| *field as u64));
    words.extend(node.mobility.map(f64::to_bits));
    words.extend(node.velocity.map(f64::to_bits));
    words.extend(node.increment.map(f64::to_bits));
}

fn unpack(words: &mut Words<'_>, found: &mut Vec<PackedTouch>) {
    for _ in 0..words.count() {
        let key = unpack_key(words);
        let vector = |words: &mut Words<'_>| [(); 3].map(|()| words.number());
        let (normal, relative) = (vector(words), vector(words));
        let [gap, bound, floor, penalty, friction] = [(); 5].map(|()| words.number());
        let touch = SurfaceTouch {
            weights: 0..0,
            normal,
            relative,
            gap,
            bound,
            floor,
            penalty,
            friction,
            normal_impulse: 0.0,
            tangential_impulse: [0.0; 3],
        };
        let count = words.count();
        let nodes = (0..count).map(|_| {
            let weight = [(); 4].map(|()| words.number());
            (unpack_node(words), weight)
        });
        let nodes = nodes.collect();
        found.push(PackedTouch { key, touch, nodes });
    }
}

fn unpack_node(words: &mut Words<'_>) -> PackedNode {
    let [node, field, others] = [(); 3].map(|()| words.count());
    let others = words.take(others).iter().map(|field| *field as usize);
    let others = others.collect();
    let mobility = [(); 4].map(|()| words.number());
    let [velocity, increment] = [(); 2].map(|()| [(); 3].map(|()| words.number()));
    let values = TouchedNode {
        node,
        field,
        others: 0..0,
        mobility,
        velocity,
        increment,
        change: [0.0; 4],
    };
    PackedNode { values, others }
}

fn pack_key(key: TouchKey, words: &mut Vec<u64>) {
    words.extend([key.surface as u64, key.set as u64, key.id]);
}

fn unpack_key(words: &mut Words<'_>) -> TouchKey {
    TouchKey {
        surface: words.count(),
        set: words.count(),
        id: words.word(),
    }
}

/// A fault as words: whether there is one, its key, the particle, and its numbers.
fn pack_fault(fault: Option<&(TouchKey, TouchFault)>, words: &mut Vec<u64>) {
    let Some((key, fault)) = fault else {
        words.push(0);
        return;
    };
    words.push(1);
    pack_key(*key, words);
    let TouchFault {
        particle: at,
        point: [p0, p1, p2],
        approach,
        distance,
    } = fault;
    let [x, y, z] = at.position;
    words.extend([
        at.id,
        at.body.cast_unsigned(),
        u64::from(approach.is_some()),
    ]);
    let approach = approach.unwrap_or(0.0);
    let numbers = [
        x, y, z, at.volume, at.mass, *p0, *p1, *p2, approach, *distance,
    ];
    words.extend(numbers.map(f64::to_bits));
}

fn unpack_fault(words: &mut Words<'_>) -> Option<(TouchKey, TouchFault)> {
    if words.word() == 0 {
        return None;
    }
    let key = unpack_key(words);
    let (id, body, moves) = (words.word(), words.word().cast_signed(), words.word() != 0);
    let [x, y, z, volume, mass] = [(); 5].map(|()| words.number());
    let point = [(); 3].map(|()| words.number());
    let approach = words.number();
    let particle = ParticleAt {
        id,
        body,
        position: [x, y, z],
        volume,
        mass,
    };
    Some((
        key,
        TouchFault {
            particle,
            point,
            approach: moves.then_some(approach),
            distance: words.number(),
        },
    ))
}
