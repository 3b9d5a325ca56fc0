//! The transpose of the gradients: moments at hosts as forces on all nodes that the particles around them reach, in lanes.

use super::{Around, Columns, as_matrix, reflected};
use crate::grid::{GridShape, Line};
use crate::lanes::{Backend, Kernel, Lanes};
use crate::simulation::interactions::mortar::mirrors::Mirrors;
use crate::simulation::interactions::mortar::reach::Reach;

/// Spreads moments over the nodes, particle by particle.
pub(super) struct Spread<'a, const D: usize> {
    /// Particles and hosts.
    pub(super) around: &'a Around<D>,
    /// Moments per mass of the hosts \[N m/kg\].
    pub(super) moments: &'a [Columns<D>],
    /// Which of them are not zero.
    pub(super) is_turned: &'a [bool],
    /// All nodes, to whose forces is added.
    pub(super) lines: &'a mut [Line],
    /// The grid, and what lies beyond it.
    pub(super) shape: &'a GridShape,
    pub(super) mirrors: &'a Mirrors,
}

impl<const D: usize> Kernel for Spread<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        if self.around.stencil.len() == 3 * self.around.rows.len() {
            self.spread::<B::Half, 3>();
        } else {
            self.spread::<B::Half, 4>();
        }
    }
}

impl<const D: usize> Spread<'_, D> {
    #[inline(always)]
    fn spread<H: Lanes, const N: usize>(self) {
        let Self {
            around,
            moments,
            is_turned,
            lines,
            shape,
            mirrors,
        } = self;
        for (reach, shares) in around.reaches.iter().zip(around.shares()) {
            let mut any = false;
            for share in shares {
                any |= is_turned[share.host as usize];
            }
            if !any {
                continue;
            }
            let mut sum = [H::splat(0.0); D];
            for share in shares {
                let moment = &moments[share.host as usize];
                let image;
                let mut from = moment;
                if share.image != 0 {
                    image = reflected(moment, share.image);
                    from = &image;
                }
                for axis in 0..D {
                    sum[axis] = H::splat(share.mass).mul_add(H::load(&from[axis]), sum[axis]);
                }
            }
            if reach.mirrored {
                let mut columns = [[0.0; 4]; D];
                for axis in 0..D {
                    sum[axis].store(&mut columns[axis]);
                }
                to_images(around, reach, &columns, lines, (shape, mirrors));
                continue;
            }
            let (w, g) = reach.along_row();
            for row in &around.rows {
                let first = reach.node(row);
                let nodes = &mut lines[first..first + N];
                let (weight, slopes) = reach.across_row(row);
                let mut across = H::splat(slopes[0]) * sum[0];
                for axis in 1..D - 1 {
                    across = H::splat(slopes[axis]).mul_add(sum[axis], across);
                }
                let along = H::splat(weight) * sum[D - 1];
                for k in 0..N {
                    let force = &mut nodes[k][4..8];
                    let by_weight = H::splat(w[k]).mul_add(across, H::load(force));
                    H::splat(g[k]).mul_add(along, by_weight).store(force);
                }
            }
        }
    }
}

/// The same for one particle some of whose nodes are ghosts, with the sum of its moments.
fn to_images<const D: usize>(
    around: &Around<D>,
    reach: &Reach<D>,
    sum: &Columns<D>,
    lines: &mut [Line],
    (shape, mirrors): (&GridShape, &Mirrors),
) {
    let moment = as_matrix(sum);
    for node in &around.stencil {
        let mut force = moment * reach.slope(node);
        force.component_mul_assign(&reach.prescribed(node, shape, mirrors));
        let (inside, _) = reach.inside(node, shape, mirrors);
        for axis in 0..D {
            lines[inside][4 + axis] += force[axis];
        }
    }
}
