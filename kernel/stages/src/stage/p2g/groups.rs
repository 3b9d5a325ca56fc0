//! Groups of particles where ranks share the rows of a layer.
//!
//! P2G counts the groups of whole layers as it goes. A rank that owns some rows of a layer counts those of its own particles apart:
//! a run belongs to the rank that owns its first particle.

use crate::layout::Layout;
use crate::stage::Mapping;
use crate::weights::base_offset;
use std::ops::Range;

/// Most particles of a group.
const MOST: usize = 8;

/// Number of groups in the runs of a layer that begin at some of its particles, for functions of so many nodes per axis.
#[must_use]
pub fn groups_from(
    columns: &[Vec<f64>],
    mapping: &Mapping,
    (axes, nodes): (usize, usize),
    layer: Range<usize>,
    own: &Range<usize>,
) -> usize {
    let base = |p: usize| -> [f64; 3] {
        std::array::from_fn(|axis| {
            if axis < axes {
                let xi = columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis];
                (xi - base_offset(nodes)).floor()
            } else {
                0.0
            }
        })
    };
    let (mut groups, mut length) = (0, 0_usize);
    // What is not a number equals nothing.
    let mut last = [f64::NAN; 3];
    for p in layer {
        let base = base(p);
        if base == last {
            length += usize::from(length > 0);
            continue;
        }
        groups += length.div_ceil(MOST);
        length = usize::from(own.contains(&p));
        last = base;
    }
    groups + length.div_ceil(MOST)
}
