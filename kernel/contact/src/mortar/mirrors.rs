//! Planes of the mesh that mirror bodies, as vertices see them.

use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::weights::{NODES, VertexWeights, in_patch};
use nalgebra::SMatrix;
use proctor_kernel::grid::{GHOSTS_BELOW, GridShape};
use proctor_kernel::model::{CycleSettings, PlaneCondition};
use std::array;
use std::ops::Range;

/// The planes of the mesh that mirror bodies: those that are not free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mirrors {
    /// The conditions of the lower and the upper plane along each axis.
    planes: [[PlaneCondition; 2]; 3],
    /// Cells of the mesh.
    cells: [usize; 3],
}

impl Mirrors {
    /// Mirrors of a mesh; a moving base is fixed to the plane that it moves.
    pub(super) fn of(settings: &CycleSettings) -> Self {
        let mut planes = settings.mesh.planes;
        if let Some(base) = &settings.base_motion {
            planes[base.axis][base.side] = PlaneCondition::Fixed;
        }
        Self {
            planes,
            cells: settings.mesh.cells,
        }
    }

    fn mirrors(&self, axis: usize) -> [bool; 2] {
        self.planes[axis].map(|condition| condition != PlaneCondition::Free)
    }

    /// The planes along an axis with cells of that size \[m\]: where they are, and how displacements beyond them are those
    /// on this side.
    pub(super) fn along<const D: usize>(
        &self,
        axis: usize,
        cell: f64,
    ) -> impl Iterator<Item = (f64, PointIn<D>)> {
        let places = [0.0, self.cells[axis] as f64 * cell];
        let planes = places.into_iter().zip(self.planes[axis]);
        planes
            .filter(|(_, condition)| *condition != PlaneCondition::Free)
            .map(move |(place, condition)| (place, signs(condition, axis)))
    }

    /// True if a node with the index `lower` along an axis lies on the lower one, and one with `upper` on the upper one.
    fn at(&self, axis: usize, lower: i64, upper: i64) -> [bool; 2] {
        let [below, above] = self.mirrors(axis);
        [
            below && lower == 0,
            above && upper == self.cells[axis] as i64,
        ]
    }

    /// Weights of a vertex in the body and its images, on nodes of the mesh alone.
    pub(super) fn fold<const D: usize, const N: usize>(
        &self,
        mut raw: VertexWeights<D, N>,
    ) -> VertexWeights<D, N> {
        let last = NODES as i64 - 1;
        for axis in 0..D {
            let base = raw.base[axis];
            let [below, above] = self.at(axis, base + 1, base + last - 1);
            if below {
                raw = raw.folded(axis, 0);
            }
            if above {
                raw = raw.folded(axis, NODES - 1);
            }
        }
        raw
    }

    /// Masses \[kg\] of the body and its images from those of the body on the nodes of a patch: twice on a plane.
    pub(super) fn with_images<const D: usize, const N: usize>(
        &self,
        base: [i64; D],
        masses: [f64; N],
    ) -> [f64; N] {
        let along: [[f64; NODES]; D] = array::from_fn(|axis| {
            array::from_fn(|place| {
                let node = base[axis] + place as i64;
                if self.at(axis, node, node).contains(&true) {
                    2.0
                } else {
                    1.0
                }
            })
        });
        if along.as_flattened().iter().all(|factor| *factor == 1.0) {
            return masses;
        }
        array::from_fn(|k| {
            let place = in_patch::<D>(k);
            (0..D).fold(masses[k], |mass, axis| mass * along[axis][place[axis]])
        })
    }

    /// Along an axis the plane that a node in storage lies beyond, if any: its side and the storage index of the mirror
    /// node.
    fn beyond(&self, axis: usize, index: usize) -> Option<(usize, usize)> {
        let [below, above] = self.mirrors(axis);
        let upper = GHOSTS_BELOW + self.cells[axis];
        if below && index < GHOSTS_BELOW {
            Some((0, 2 * GHOSTS_BELOW - index))
        } else if above && index > upper {
            Some((1, 2 * upper - index))
        } else {
            None
        }
    }

    /// The bases, along each direction of storage, from which a particle reaches no ghost that repeats a node.
    pub(super) fn inner(&self, shape: &GridShape, stencil: usize) -> [Range<usize>; 3] {
        let mut inner = [0, 1, 2].map(|_| 0..usize::MAX);
        for axis in 0..shape.axes {
            let [below, above] = self.mirrors(axis);
            let range = &mut inner[shape.direction(axis)];
            if below {
                range.start = GHOSTS_BELOW;
            }
            if above {
                range.end = (GHOSTS_BELOW + self.cells[axis] + 2).saturating_sub(stencil);
            }
        }
        inner
    }

    /// The node that a ghost repeats, by its storage indices, with -1 for each axis along which it is its mirror image;
    /// every other node is itself.
    pub(super) fn inside<const D: usize>(
        &self,
        shape: &GridShape,
        mut at: [usize; 3],
    ) -> ([usize; 3], PointIn<D>) {
        let mut sides = PointIn::repeat(1.0);
        for axis in 0..D {
            let index = &mut at[shape.direction(axis)];
            if let Some((_, mirror)) = self.beyond(axis, *index) {
                *index = mirror;
                sides[axis] = -1.0;
            }
        }
        (at, sides)
    }

    /// Per axis -1 where a ghost has the velocity of its mirror node the other way round, 1 where it has it as it is.
    pub(super) fn prescribed<const D: usize>(
        &self,
        shape: &GridShape,
        at: [usize; 3],
    ) -> PointIn<D> {
        let mut all = PointIn::<D>::repeat(1.0);
        for axis in 0..D {
            if let Some((side, _)) = self.beyond(axis, at[shape.direction(axis)]) {
                all.component_mul_assign(&signs(self.planes[axis][side], axis));
            }
        }
        all
    }

    /// 1 for the entries of the velocity gradient of a node that the body and its images have together: in a sliding plane
    /// nothing turns or shears out of it, and in an antisymmetric one nothing stretches.
    pub(super) fn kept<const D: usize>(
        &self,
        shape: &GridShape,
        at: [usize; 3],
    ) -> SMatrix<f64, D, D> {
        let lies_in = |axis: usize, condition: PlaneCondition| {
            let index = at[shape.direction(axis)];
            let upper = GHOSTS_BELOW + self.cells[axis];
            let [below, above] = self.planes[axis];
            (below == condition && index == GHOSTS_BELOW) || (above == condition && index == upper)
        };
        let slides: [bool; D] = array::from_fn(|axis| lies_in(axis, PlaneCondition::Sliding));
        let turns: [bool; D] = array::from_fn(|axis| lies_in(axis, PlaneCondition::Antisymmetric));
        SMatrix::from_fn(|i, j| {
            let is_lost = (i != j && slides[i] != slides[j])
                || (0..D).any(|axis| turns[axis] && (i == axis) == (j == axis));
            if is_lost { 0.0 } else { 1.0 }
        })
    }
}

/// Per axis -1 where what lies beyond a plane has the velocity of what lies inside the other way round, 1 where it has it as
/// it is.
fn signs<const D: usize>(condition: PlaneCondition, normal: usize) -> PointIn<D> {
    PointIn::from_fn(|along, _| {
        if condition.prescribes(along, normal) {
            -1.0
        } else {
            1.0
        }
    })
}
