//! Interpolation by differences, where particles reach three nodes along each axis.
//!
//! Three weights that sum to one and reproduce linear fields leave two numbers per axis: u = `w_2` - `w_0`, the distance from
//! the middle node in cells, and s = `w_0` + `w_2`. With the differences b = (`v_2` - `v_0`)/2 and c = (`v_0` - 2 `v_1` + `v_2`)/2 of
//! three nodal values,
//!
//! - the value is `v_1` + u b + s c,
//! - the derivative is (b + s' c)/h with s' = `g_0` + `g_2`,
//! - the affine velocity `B_p` `D_p`^-1 of APIC is (b + e c)/h with e = u (1 - s)/(s - u²), as `D_p` = h² (s - u²).
//!
//! All three share their differences, which are additions. They hold for hats, GIMP and B-splines. A value has the same
//! operations in the same order whether lanes are particles or numbers of a node, and so the same bits.

use crate::lanes::Lanes;
use crate::stage::Mapping;
use crate::weights::Family;

/// Factors of the differences per axis, and the weights.
#[derive(Clone, Copy)]
pub(super) struct Differences<L> {
    /// Weights.
    pub w: [[L; 3]; 3],
    /// u/2 and s/2, for twice the differences.
    pub u: [L; 3],
    pub s: [L; 3],
    /// s' of the derivative, and e of the affine velocity.
    pub slope: [L; 3],
    pub affine: [L; 3],
    /// 1/(2 h) \[1/m\].
    pub scale: [L; 3],
}

/// A nodal quantity at particles.
#[derive(Clone, Copy)]
pub(super) struct Field<L> {
    /// The quantity.
    pub value: L,
    /// Twice its derivative times h per axis; with APIC twice its first difference, of which two derivatives are formed.
    pub first: [L; 3],
    /// With APIC, twice its second difference per axis.
    pub second: [L; 3],
}

/// Nodal values in lanes.
pub(super) trait Nodes<L> {
    /// A number of the three nodes of a row, which stands in a plane.
    fn row(&self, plane: usize, row: usize, number: usize) -> [L; 3];
}

impl<L: Lanes> Differences<L> {
    /// Those of weights and their derivatives times h.
    #[inline(always)]
    pub(super) fn new<const D: usize, const N: usize, const APIC: bool>(
        mapping: &Mapping,
        w: &[[L; N]; 3],
        g: &[[L; N]; 3],
    ) -> Self {
        let (half, one) = (L::splat(0.5), L::splat(1.0));
        let mut of = Self::zero();
        for axis in 0..D {
            let (u, s) = (w[axis][2] - w[axis][0], w[axis][0] + w[axis][2]);
            of.w[axis] = [w[axis][0], w[axis][1], w[axis][2]];
            of.u[axis] = half * u;
            of.s[axis] = half * s;
            of.slope[axis] = g[axis][0] + g[axis][2];
            of.scale[axis] = L::splat(0.5 * mapping.inverse_cell[axis]);
            if APIC {
                // The affine velocity of hats is their derivative, also where D_p is zero.
                of.affine[axis] = if mapping.family == Family::Hat {
                    of.slope[axis]
                } else {
                    u * (one - s) / (-u).mul_add(u, s)
                };
            }
        }
        of
    }

    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = [L::splat(0.0); 3];
        Self {
            w: [zero; 3],
            u: zero,
            s: zero,
            slope: zero,
            affine: zero,
            scale: zero,
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
            let firsts = [of[0].first[other], of[1].first[other], of[2].first[other]];
            field.first[other] = self.weighted(firsts, axis);
            if APIC {
                let seconds = [
                    of[0].second[other],
                    of[1].second[other],
                    of[2].second[other],
                ];
                field.second[other] = self.weighted(seconds, axis);
            }
        }
        field
    }

    /// Value and differences of three values along an axis.
    #[inline(always)]
    fn differ<const APIC: bool>(&self, values: [L; 3], axis: usize, field: &mut Field<L>) {
        let (below, above) = (values[1] - values[0], values[2] - values[1]);
        let (first, second) = (below + above, above - below);
        let linear = self.u[axis].mul_add(first, values[1]);
        field.value = self.s[axis].mul_add(second, linear);
        if APIC {
            (field.first[axis], field.second[axis]) = (first, second);
        } else {
            field.first[axis] = self.slope[axis].mul_add(second, first);
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
        let mut gradient = field.first;
        for axis in 0..D {
            if APIC {
                gradient[axis] = self.slope[axis].mul_add(field.second[axis], field.first[axis]);
            }
            gradient[axis] = self.scale[axis] * gradient[axis];
        }
        gradient
    }

    /// The affine part \[1/m\].
    #[inline(always)]
    pub(super) fn affine<const D: usize>(&self, field: &Field<L>) -> [L; 3] {
        let mut affine = field.first;
        for axis in 0..D {
            affine[axis] = self.affine[axis].mul_add(field.second[axis], field.first[axis]);
            affine[axis] = self.scale[axis] * affine[axis];
        }
        affine
    }
}

impl<L: Lanes> Field<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = L::splat(0.0);
        Self {
            value: zero,
            first: [zero; 3],
            second: [zero; 3],
        }
    }
}
