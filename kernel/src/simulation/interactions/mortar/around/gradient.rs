//! Velocity gradients of particles, L_p = sum_I v_I grad S_Ip, and their means at nodes (eq. 28), in lanes: a velocity is half
//! a line.

use super::{Around, Columns, reflected};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes};
use crate::simulation::interactions::mortar::reach::{Reach, StencilNode};

/// The gradients of some particles.
pub(super) struct OfParticles<'a, const D: usize> {
    /// The particles.
    pub(super) reaches: &'a [Reach<D>],
    /// Rows of their stencils, and the number of nodes in each.
    pub(super) rows: &'a [StencilNode<D>],
    pub(super) row_length: usize,
    /// All nodes, with their velocities.
    pub(super) lines: &'a [Line],
    /// One for each particle, to be written \[1/s\].
    pub(super) gradients: &'a mut [Columns<D>],
}

impl<const D: usize> Kernel for OfParticles<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        if self.row_length == 3 {
            self.write::<B::Half, 3>();
        } else {
            self.write::<B::Half, 4>();
        }
    }
}

impl<const D: usize> OfParticles<'_, D> {
    #[inline(always)]
    fn write<H: Lanes, const N: usize>(self) {
        let zero = H::splat(0.0);
        for (reach, gradient) in self.reaches.iter().zip(self.gradients) {
            let (w, g) = reach.along_row();
            let mut columns = [zero; D];
            for row in self.rows {
                let first = reach.node(row);
                let nodes = &self.lines[first..first + N];
                let (mut v, mut slope) = (zero, zero);
                for k in 0..N {
                    // The fourth lane is no velocity, and what comes of it is no part of the gradient.
                    let v_k = H::load(&nodes[k][1..5]);
                    v = H::splat(w[k]).mul_add(v_k, v);
                    slope = H::splat(g[k]).mul_add(v_k, slope);
                }
                let (weight, slopes) = reach.across_row(row);
                for axis in 0..D - 1 {
                    columns[axis] = H::splat(slopes[axis]).mul_add(v, columns[axis]);
                }
                columns[D - 1] = H::splat(weight).mul_add(slope, columns[D - 1]);
            }
            for axis in 0..D {
                columns[axis].store(&mut gradient[axis]);
            }
        }
    }
}

/// Sums over the particles around each host, weighted by what they give to it, in the order of the particles.
pub(super) struct Gathered<'a, const D: usize> {
    /// Particles and hosts.
    pub(super) around: &'a Around<D>,
    /// Gradients of the particles \[1/s\].
    pub(super) of_particles: &'a [Columns<D>],
    /// Sums, to be added to \[kg/s\].
    pub(super) of_hosts: &'a mut [Columns<D>],
}

impl<const D: usize> Kernel for Gathered<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        for (gradient, shares) in self.of_particles.iter().zip(self.around.shares()) {
            for share in shares {
                let mass = B::Half::splat(share.mass);
                let image;
                let mut from = gradient;
                if share.image != 0 {
                    image = reflected(gradient, share.image);
                    from = &image;
                }
                for (column, sum) in from.iter().zip(&mut self.of_hosts[share.host as usize]) {
                    let more = mass.mul_add(B::Half::load(column), B::Half::load(sum));
                    more.store(sum);
                }
            }
        }
    }
}
