//! Bodies that overlap at the start, by their particles.

use super::Pair;
use proctor_kernel::model::Vector;
use proctor_kernel::particles::ParticleSet;
use std::collections::HashMap;

/// Share of the half-lengths of two particles by which they may overlap: the surface of a round body is a staircase of
/// particles, of which the highest steps stand out by half a particle.
const STAIRCASE: f64 = 0.5;

/// Two bodies that overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyOverlap {
    /// Depth of the deepest overlap of two particles \[m\].
    pub depth: f64,
    /// Between them, relative to the mesh origin \[m\].
    pub at: Vector,
}

/// The deepest overlap of the particles of a pair beyond the steps of their surfaces. `half_lengths` are those of the
/// particles of all bodies \[m\].
#[must_use]
pub fn overlap(pair: &Pair, sets: &[ParticleSet], half_lengths: &[Vector]) -> Option<BodyOverlap> {
    let (master, slave) = (&sets[pair.master], &sets[pair.slave]);
    let axes = master.layout.axes;
    let reach: Vector = std::array::from_fn(|axis| {
        half_lengths[pair.master][axis] + half_lengths[pair.slave][axis]
    });
    let cell = |x: &Vector| -> [i64; 3] {
        std::array::from_fn(|axis| {
            if axis < axes {
                (x[axis] / reach[axis]).floor() as i64
            } else {
                0
            }
        })
    };
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for p in 0..master.len() {
        cells.entry(cell(&master.position(p))).or_default().push(p);
    }
    let mut deepest: Option<BodyOverlap> = None;
    for q in 0..slave.len() {
        let x = slave.position(q);
        let here = cell(&x);
        for offset in 0..27 {
            let step = [offset / 9 - 1, offset / 3 % 3 - 1, offset % 3 - 1];
            let near = cells.get(&std::array::from_fn(|k| here[k] + step[k]));
            for &p in near.into_iter().flatten() {
                let y = master.position(p);
                let depth = |axis: usize| reach[axis] - (x[axis] - y[axis]).abs();
                let over = (0..axes).all(|axis| depth(axis) > STAIRCASE * reach[axis]);
                let depth = (0..axes).map(depth).fold(f64::INFINITY, f64::min);
                if over && deepest.is_none_or(|d| d.depth < depth) {
                    deepest = Some(BodyOverlap {
                        depth,
                        at: std::array::from_fn(|axis| 0.5 * (x[axis] + y[axis])),
                    });
                }
            }
        }
    }
    deepest
}
