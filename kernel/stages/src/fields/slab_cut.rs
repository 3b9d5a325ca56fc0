//! The cut of planes into slabs of about the same work.

use std::ops::Range;

/// Fewest planes of a slab: it makes the weights of three layers that begin before it once more.
const THINNEST_SLAB: usize = 4;
/// Fewest planes of the slabs at the ends: two of ghosts, that of the mesh, and that of the images of the ghosts.
const THINNEST_END: usize = 5;
/// Work in each plane, from the numbers of particles that begin there: they reach two more planes, and their weights are made
/// once.
pub(super) fn work_of_planes(particles: &[usize]) -> impl Iterator<Item = usize> {
    let from = |plane: usize, back: usize| -> usize {
        plane.checked_sub(back).map_or(0, |plane| particles[plane])
    };
    let planes = 0..particles.len();
    planes.map(move |plane| 2 * from(plane, 0) + from(plane, 1) + from(plane, 2))
}

/// Adds at most `most` ranges of planes, the most work of one as small as their thickness allows.
pub(super) fn cut_into(work: &[usize], most: usize, slabs: &mut Vec<Range<usize>>) {
    let (mut low, mut high) = (0, work.iter().sum());
    while low < high {
        let limit = usize::midpoint(low, high);
        let mut count = 0;
        fill(work, limit, |_| count += 1);
        if count <= most {
            high = limit;
        } else {
            low = limit + 1;
        }
    }
    fill(work, low, |slab| slabs.push(slab));
}

/// Gives the planes in slabs of at most `limit` work each, where they are as thick as slabs must be.
fn fill(work: &[usize], limit: usize, mut give: impl FnMut(Range<usize>)) {
    let (mut start, mut sum) = (0, 0);
    for (plane, &count) in work.iter().enumerate() {
        let thinnest = if start == 0 {
            THINNEST_END
        } else {
            THINNEST_SLAB
        };
        let thick = plane - start >= thinnest && work.len() - plane >= THINNEST_END;
        if thick && sum + count > limit {
            give(start..plane);
            (start, sum) = (plane, 0);
        }
        sum += count;
    }
    give(start..work.len());
}
