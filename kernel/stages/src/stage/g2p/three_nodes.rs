//! Interpolated values of a group of particles that reach three nodes along each axis.
//!
//! Where the particles have one or two base nodes, lanes are particles, and a nodal number is taken once for all that have the
//! base node. In space, where they have more, lanes are the numbers of a node, and one particle comes after the other: then the
//! cost does not depend on their order. Where eight lanes are added as fast as four, groups stay together. A value has the same
//! operations either way.

use super::differences::{Differences, Field, Nodes};
use super::reach::{BlockReach, Rows};
use super::values::{Column, InterpolatedValues, keep};
use crate::grid::Line;
use crate::lanes::{Lanes, Quad};
use crate::laws::{BLOCK, HOOP};
use crate::stage::{Block, Mapping, index_of};

/// The rows that a group of particles reaches.
struct RowsOfGroup<'a, L: Lanes, const R: usize> {
    rows: [[Rows<'a, 3, R>; 3]; 3],
    reach: &'a BlockReach<'a, L, R>,
}

impl<L: Lanes, const R: usize> Nodes<L> for RowsOfGroup<'_, L, R> {
    #[inline(always)]
    fn row(&self, plane: usize, row: usize, number: usize) -> [L; 3] {
        let row = &self.rows[plane][row];
        [
            self.reach.value(row, 0, number),
            self.reach.value(row, 1, number),
            self.reach.value(row, 2, number),
        ]
    }
}

/// Interpolates to a group of particles with few base nodes; lanes = particles.
#[inline(always)]
pub(super) fn interpolate_group<
    L: Lanes,
    const D: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
    const MOVE: bool,
    const RADIAL: bool,
    const R: usize,
>(
    mapping: &Mapping,
    reach: &BlockReach<'_, L, R>,
    differences: &Differences<L>,
    to: usize,
    values: &mut InterpolatedValues,
) {
    let mut nodes = RowsOfGroup {
        rows: [[reach.rows(0); 3]; 3],
        reach,
    };
    let plane = mapping.nodes[1] * mapping.nodes[2];
    for i in 0..3 {
        for j in 0..if D == 3 { 3 } else { 1 } {
            nodes.rows[i][j] = reach.rows(i * plane + j * mapping.nodes[2]);
        }
    }
    // One component after the other: its sums fit the registers.
    for c in 0..D {
        let mut field = Field::zero();
        if MOVE || GRADIENT && !UPPER {
            field = differences.field::<D, APIC>(&nodes, 1 + c);
        }
        if MOVE {
            keep(field.value, &mut values.velocity[c], to);
        }
        if UPPER {
            field = differences.field::<D, APIC>(&nodes, 4 + c);
        }
        if GRADIENT {
            let gradient = differences.gradient::<D, APIC>(&field);
            for axis in 0..D {
                keep(gradient[axis], &mut values.gradient.0[D * c + axis], to);
            }
        }
        if RADIAL && GRADIENT && c == 0 {
            keep(field.value, &mut values.gradient.0[HOOP], to);
        }
        if APIC {
            let affine = differences.affine::<D>(&field);
            for axis in 0..D {
                keep(affine[axis], &mut values.affine[D * c + axis], to);
            }
        }
        if KICK {
            let increment = differences.mean::<D>(&nodes, 4 + c);
            keep(increment, &mut values.increment[c], to);
        }
    }
}

/// The stencil of one particle.
struct StencilOfParticle<'a> {
    nodes: &'a [Line],
    /// Index of its base node.
    first: usize,
    /// Nodes from one plane to the next, and from one row to the next.
    plane: usize,
    row: usize,
}

impl<Q: Lanes> Nodes<Q> for StencilOfParticle<'_> {
    /// `number` is the first of four.
    #[inline(always)]
    fn row(&self, plane: usize, row: usize, number: usize) -> [Q; 3] {
        let row = &self.nodes[self.first + plane * self.plane + row * self.row..][..3];
        [
            Q::load(&row[0][number..number + 4]),
            Q::load(&row[1][number..number + 4]),
            Q::load(&row[2][number..number + 4]),
        ]
    }
}

/// Factors of the differences of a group, `[particle]`.
#[repr(align(64))]
pub(super) struct FactorsOfGroup {
    factors: Differences<[f64; 8]>,
    index: [f64; 8],
}

impl FactorsOfGroup {
    pub(super) fn new() -> Self {
        let zero = [[0.0; 8]; 3];
        Self {
            factors: Differences {
                w: [zero; 3],
                g: [[[0.0; 8]; 2]; 3],
                q: [[[0.0; 8]; 2]; 3],
            },
            index: [0.0; 8],
        }
    }

    #[inline(always)]
    fn set<L: Lanes, const D: usize, const APIC: bool>(
        &mut self,
        index: L,
        differences: &Differences<L>,
    ) {
        index.store(&mut self.index);
        let factors = &mut self.factors;
        for axis in 0..D {
            for n in 0..3 {
                differences.w[axis][n].store(&mut factors.w[axis][n]);
            }
            for end in 0..2 {
                differences.g[axis][end].store(&mut factors.g[axis][end]);
                if APIC {
                    differences.q[axis][end].store(&mut factors.q[axis][end]);
                }
            }
        }
    }

    /// The factors of a particle, in all lanes.
    #[inline(always)]
    fn of_particle<Q: Lanes, const D: usize, const APIC: bool>(&self, p: usize) -> Differences<Q> {
        let from = &self.factors;
        let mut of = Differences::zero();
        for axis in 0..D {
            for n in 0..3 {
                of.w[axis][n] = Q::splat(from.w[axis][n][p]);
            }
            for end in 0..2 {
                of.g[axis][end] = Q::splat(from.g[axis][end][p]);
                if APIC {
                    of.q[axis][end] = Q::splat(from.q[axis][end][p]);
                }
            }
        }
        of
    }

    /// Interpolates to each particle of a group; lanes = numbers of a node.
    #[inline(always)]
    pub(super) fn interpolate_each<
        L: Lanes,
        Q: Quad,
        const D: usize,
        const KICK: bool,
        const GRADIENT: bool,
        const APIC: bool,
        const UPPER: bool,
        const MOVE: bool,
    >(
        &mut self,
        mapping: &Mapping,
        nodes: &[Line],
        block: &Block<L>,
        differences: &Differences<L>,
        to: usize,
        values: &mut InterpolatedValues,
    ) {
        self.set::<L, D, APIC>(block.index::<D>(mapping), differences);
        let zero = Q::splat(0.0);
        let mut done = 0;
        while done < block.count {
            let mut velocity = [zero; 4];
            let mut increment = [zero; 4];
            let mut gradient = [[zero; 4]; 3];
            let mut affine = [[zero; 4]; 3];
            for n in 0..(block.count - done).min(4) {
                let p = done + n;
                let factors = self.of_particle::<Q, D, APIC>(p);
                let stencil = StencilOfParticle {
                    nodes,
                    first: index_of(self.index[p]),
                    plane: mapping.nodes[1] * mapping.nodes[2],
                    row: mapping.nodes[2],
                };
                let mut field = Field::zero();
                if MOVE || GRADIENT && !UPPER {
                    field = factors.field::<D, APIC>(&stencil, 0);
                }
                velocity[n] = field.value;
                if UPPER {
                    field = factors.field::<D, APIC>(&stencil, 4);
                }
                if GRADIENT {
                    let of = factors.gradient::<D, APIC>(&field);
                    for axis in 0..D {
                        gradient[axis][n] = of[axis];
                    }
                }
                if APIC {
                    let of = factors.affine::<D>(&field);
                    for axis in 0..D {
                        affine[axis][n] = of[axis];
                    }
                }
                if KICK {
                    increment[n] = factors.mean::<D>(&stencil, 4);
                }
            }
            let at = to + done;
            if MOVE {
                let of = Q::transpose(velocity);
                for c in 0..D {
                    keep_quad(of[1 + c], &mut values.velocity[c], at);
                }
            }
            if KICK {
                let of = Q::transpose(increment);
                for c in 0..D {
                    keep_quad(of[c], &mut values.increment[c], at);
                }
            }
            // Velocities are behind the mass, remapped ones where increments were.
            let first = usize::from(!UPPER);
            for axis in 0..D {
                if GRADIENT {
                    let of = Q::transpose(gradient[axis]);
                    for c in 0..D {
                        keep_quad(of[first + c], &mut values.gradient.0[D * c + axis], at);
                    }
                }
                if APIC {
                    let of = Q::transpose(affine[axis]);
                    for c in 0..D {
                        keep_quad(of[1 + c], &mut values.affine[D * c + axis], at);
                    }
                }
            }
            done += 4;
        }
    }
}

/// [`keep`] of four lanes, which may be the second half of a group.
#[inline(always)]
fn keep_quad<Q: Lanes>(value: Q, column: &mut Column, at: usize) {
    let at = at.min(BLOCK + 4);
    value.store(&mut column[at..at + 4]);
}
