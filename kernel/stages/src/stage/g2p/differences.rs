//! Interpolation by differences, where particles reach three nodes along each axis.
//!
//! Three weights sum to one and their derivatives to zero, so that with the differences a = `v_0` - `v_1` and b = `v_2` - `v_1` of
//! three nodal values
//!
//! - the value is `v_1` + `w_0` a + `w_2` b,
//! - the derivative is `g_0` a + `g_2` b,
//! - the affine velocity `B_p` `D_p`^-1 of APIC is `q_0` a + `q_2` b, with q = w (x_I - x_p)/`D_p`.
//!
//! All three share their differences, which are additions. What an almost empty node has, whose velocity may be as large as one
//! likes, is multiplied by its own small weight; sums in which it cancels would keep its round-off.
//!
//! A value has the same operations in the same order whether lanes are particles or numbers of a node, and so the same bits.

use crate::lanes::Lanes;

/// Factors of differences per axis, and the weights.
#[derive(Clone, Copy)]
pub(super) struct Differences<L> {
    /// Weights.
    pub w: [[L; 3]; 3],
    /// Derivatives at the outer nodes \[1/m\].
    pub g: [[L; 2]; 3],
    /// The factors of the affine velocity \[1/m\].
    pub q: [[L; 2]; 3],
}

/// A nodal quantity at particles.
#[derive(Clone, Copy)]
pub(super) struct Field<L> {
    /// The quantity.
    pub value: L,
    /// Its derivative per axis; with APIC its differences, of which two derivatives are formed.
    slope: [L; 3],
    below: [L; 3],
    above: [L; 3],
}

/// Nodal values in lanes.
pub(super) trait Nodes<L> {
    /// A number of the three nodes of a row, which stands in a plane.
    fn row(&self, plane: usize, row: usize, number: usize) -> [L; 3];
}

impl<L: Lanes> Differences<L> {
    /// Differences of weights, derivatives and affine factors.
    #[inline(always)]
    pub(super) fn new<const D: usize, const N: usize>(
        w: &[[L; N]; 3],
        g: &[[L; N]; 3],
        q: &[[L; N]; 3],
    ) -> Self {
        let mut of = Self::zero();
        for axis in 0..D {
            of.w[axis] = [w[axis][0], w[axis][1], w[axis][2]];
            of.g[axis] = [g[axis][0], g[axis][2]];
            of.q[axis] = [q[axis][0], q[axis][2]];
        }
        of
    }

    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = L::splat(0.0);
        Self {
            w: [[zero; 3]; 3],
            g: [[zero; 2]; 3],
            q: [[zero; 2]; 3],
        }
    }

    /// Value and derivatives of the `number`-th number of the nodes.
    #[inline(always)]
    pub(super) fn field<const D: usize, const APIC: bool>(
        &self,
        nodes: &impl Nodes<L>,
        number: usize,
    ) -> Field<L> {
        let mut planes = [Field::zero(); 3];
        for i in 0..3 {
            if D == 2 {
                self.differ::<APIC>(nodes.row(i, 0, number), 1, &mut planes[i]);
                continue;
            }
            let mut rows = [Field::zero(); 3];
            for j in 0..3 {
                self.differ::<APIC>(nodes.row(i, j, number), 2, &mut rows[j]);
            }
            planes[i] = self.across::<D, APIC>(&rows, 1);
        }
        self.across::<D, APIC>(&planes, 0)
    }

    /// The same from rows or planes that lie along an axis.
    #[inline(always)]
    fn across<const D: usize, const APIC: bool>(
        &self,
        of: &[Field<L>; 3],
        axis: usize,
    ) -> Field<L> {
        let mut field = Field::zero();
        self.differ::<APIC>([of[0].value, of[1].value, of[2].value], axis, &mut field);
        for other in axis + 1..D {
            if APIC {
                let below = [of[0].below[other], of[1].below[other], of[2].below[other]];
                let above = [of[0].above[other], of[1].above[other], of[2].above[other]];
                field.below[other] = self.weighted(below, axis);
                field.above[other] = self.weighted(above, axis);
            } else {
                let slopes = [of[0].slope[other], of[1].slope[other], of[2].slope[other]];
                field.slope[other] = self.weighted(slopes, axis);
            }
        }
        field
    }

    /// Value and differences of three values along an axis.
    #[inline(always)]
    fn differ<const APIC: bool>(&self, values: [L; 3], axis: usize, field: &mut Field<L>) {
        let (below, above) = (values[0] - values[1], values[2] - values[1]);
        let w = &self.w[axis];
        field.value = w[2].mul_add(above, w[0].mul_add(below, values[1]));
        if APIC {
            (field.below[axis], field.above[axis]) = (below, above);
        } else {
            let g = &self.g[axis];
            field.slope[axis] = g[1].mul_add(above, g[0] * below);
        }
    }

    /// The `number`-th number of the nodes as the sum of its products with the weights.
    #[inline(always)]
    pub(super) fn mean<const D: usize>(&self, nodes: &impl Nodes<L>, number: usize) -> L {
        let mut planes = [L::splat(0.0); 3];
        for i in 0..3 {
            if D == 2 {
                planes[i] = self.weighted(nodes.row(i, 0, number), 1);
                continue;
            }
            let mut rows = [L::splat(0.0); 3];
            for j in 0..3 {
                rows[j] = self.weighted(nodes.row(i, j, number), 2);
            }
            planes[i] = self.weighted(rows, 1);
        }
        self.weighted(planes, 0)
    }

    /// Sum of three values along an axis times their weights.
    #[inline(always)]
    fn weighted(&self, values: [L; 3], axis: usize) -> L {
        let w = &self.w[axis];
        w[2].mul_add(values[2], w[1].mul_add(values[1], w[0] * values[0]))
    }

    /// The gradient \[1/m\].
    #[inline(always)]
    pub(super) fn gradient<const D: usize, const APIC: bool>(&self, field: &Field<L>) -> [L; 3] {
        if APIC {
            combined::<L, D>(&self.g, field)
        } else {
            field.slope
        }
    }

    /// The affine part \[1/m\].
    #[inline(always)]
    pub(super) fn affine<const D: usize>(&self, field: &Field<L>) -> [L; 3] {
        combined::<L, D>(&self.q, field)
    }
}

/// Differences along each axis times their factors.
#[inline(always)]
fn combined<L: Lanes, const D: usize>(factors: &[[L; 2]; 3], field: &Field<L>) -> [L; 3] {
    let mut slope = field.slope;
    for axis in 0..D {
        let [below, above] = factors[axis];
        slope[axis] = above.mul_add(field.above[axis], below * field.below[axis]);
    }
    slope
}

impl<L: Lanes> Field<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = L::splat(0.0);
        Self {
            value: zero,
            slope: [zero; 3],
            below: [zero; 3],
            above: [zero; 3],
        }
    }
}
