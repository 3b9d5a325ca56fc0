//! The transpose of the gradients: moments at hosts as forces on all nodes that the particles around them reach, in lanes.

use super::{HalfLineColumns, NeighbourParticles, as_matrix, reflected};
use crate::mortar::mirrors::Mirrors;
use crate::mortar::stencil_reach::StencilReach;
use proctor_kernel::grid::{GridShape, Line};
use proctor_kernel::lanes::{Backend, Kernel, Lanes};

/// Share of particles in the moments of the hosts that they reach.
pub(super) struct ParticleMoments<'a, const D: usize> {
    /// Particles and hosts.
    pub(super) around: &'a NeighbourParticles<D>,
    /// The particles, and their masses \[kg\].
    pub(super) reaches: &'a [StencilReach<D>],
    pub(super) masses: &'a [f64],
    /// Moments per mass of the hosts \[N m/kg\], and before them none.
    pub(super) moments: &'a [HalfLineColumns<D>],
    /// One for each particle that reaches one that is not zero, to be written \[N m\].
    pub(super) found: &'a mut [HalfLineColumns<D>],
    /// The grid, and what lies beyond it.
    pub(super) shape: &'a GridShape,
    pub(super) mirrors: &'a Mirrors,
}

impl<const D: usize> Kernel for ParticleMoments<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        if self.around.stencil.len() == 3 * self.around.rows.len() {
            self.write::<B::Half, 3>();
        } else {
            self.write::<B::Half, 4>();
        }
    }
}

impl<const D: usize> ParticleMoments<'_, D> {
    #[inline(always)]
    fn write<H: Lanes, const N: usize>(self) {
        let (around, moments) = (self.around, self.moments);
        let zero = H::splat(0.0);
        let all = self.reaches.iter().zip(self.masses);
        for ((reach, mass), found) in all.zip(self.found) {
            if !around.turned.has(reach.base()) {
                continue;
            }
            let mut sum = [zero; D];
            if reach.mirrored {
                for node in &around.stencil {
                    let (inside, sides) = reach.inside(node, self.shape, self.mirrors);
                    let moment = reflected(&moments[around.slots[inside] as usize], &sides);
                    let weight = H::splat(reach.weight(node));
                    for axis in 0..D {
                        sum[axis] = weight.mul_add(H::load(&moment[axis]), sum[axis]);
                    }
                }
            } else {
                let (w, _) = reach.along_row();
                for row in &around.rows {
                    let first = reach.node(row);
                    let slots = &around.slots[first..first + N];
                    let mut along = [zero; D];
                    for k in 0..N {
                        let moment = &moments[slots[k] as usize];
                        for axis in 0..D {
                            along[axis] =
                                H::splat(w[k]).mul_add(H::load(&moment[axis]), along[axis]);
                        }
                    }
                    let (across, _) = reach.across_row(row);
                    for axis in 0..D {
                        sum[axis] = H::splat(across).mul_add(along[axis], sum[axis]);
                    }
                }
            }
            for axis in 0..D {
                (H::splat(*mass) * sum[axis]).store(&mut found[axis]);
            }
        }
    }
}

/// Spreads what particles have over the nodes of some planes, particle by particle.
pub(super) struct MomentSpread<'a, const D: usize> {
    /// Particles and hosts.
    pub(super) around: &'a NeighbourParticles<D>,
    /// Moments of the particles \[N m\].
    pub(super) of_particles: &'a [HalfLineColumns<D>],
    /// The first node, and nodes to whose forces is added.
    pub(super) first: usize,
    pub(super) lines: &'a mut [Line],
    /// The grid, and what lies beyond it.
    pub(super) shape: &'a GridShape,
    pub(super) mirrors: &'a Mirrors,
}

impl<const D: usize> Kernel for MomentSpread<'_, D> {
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

impl<const D: usize> MomentSpread<'_, D> {
    #[inline(always)]
    fn spread<H: Lanes, const N: usize>(self) {
        let Self {
            around,
            of_particles,
            first: own,
            lines,
            shape,
            mirrors,
        } = self;
        for (reach, moment) in around.reaches.iter().zip(of_particles) {
            if !around.turned.has(reach.base()) {
                continue;
            }
            if reach.mirrored {
                to_images(around, reach, moment, (own, &mut *lines), (shape, mirrors));
                continue;
            }
            let mut sum = [H::splat(0.0); D];
            for axis in 0..D {
                sum[axis] = H::load(&moment[axis]);
            }
            let (w, g) = reach.along_row();
            for row in &around.rows {
                let first = reach.node(row);
                let Some(nodes) = first
                    .checked_sub(own)
                    .and_then(|at| lines.get_mut(at..at + N))
                else {
                    continue;
                };
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

/// The same for one particle some of whose nodes are ghosts.
fn to_images<const D: usize>(
    around: &NeighbourParticles<D>,
    reach: &StencilReach<D>,
    moment: &HalfLineColumns<D>,
    (own, lines): (usize, &mut [Line]),
    (shape, mirrors): (&GridShape, &Mirrors),
) {
    let moment = as_matrix(moment);
    for node in &around.stencil {
        let (inside, _) = reach.inside(node, shape, mirrors);
        let Some(line) = inside.checked_sub(own).and_then(|at| lines.get_mut(at)) else {
            continue;
        };
        let mut force = moment * reach.slope(node);
        force.component_mul_assign(&reach.prescribed(node, shape, mirrors));
        for axis in 0..D {
            line[4 + axis] += force[axis];
        }
    }
}
