//! Velocity gradients of particles, L_p = sum_I v_I grad S_Ip, and their means at nodes (eq. 28), in lanes: a velocity is half
//! a line.

use super::{HalfLineColumns, NeighbourParticles, reflected};
use crate::mortar::mirrors::Mirrors;
use crate::mortar::stencil_reach::{StencilNode, StencilReach};
use proctor_kernel::grid::{GridShape, Line};
use proctor_kernel::lanes::{Backend, Kernel, Lanes};

/// The gradients of some particles, times their masses.
pub(super) struct ParticleGradients<'a, const D: usize> {
    /// The particles, and their masses \[kg\].
    pub(super) reaches: &'a [StencilReach<D>],
    pub(super) masses: &'a [f64],
    /// Rows of their stencils, and the number of nodes in each.
    pub(super) rows: &'a [StencilNode<D>],
    pub(super) row_length: usize,
    /// All nodes, with their velocities.
    pub(super) lines: &'a [Line],
    /// One for each particle, to be written \[kg/s\].
    pub(super) gradients: &'a mut [HalfLineColumns<D>],
}

impl<const D: usize> Kernel for ParticleGradients<'_, D> {
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

impl<const D: usize> ParticleGradients<'_, D> {
    #[inline(always)]
    fn write<H: Lanes, const N: usize>(self) {
        let zero = H::splat(0.0);
        let all = self.reaches.iter().zip(self.masses);
        for ((reach, mass), gradient) in all.zip(self.gradients) {
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
            let m_p = H::splat(*mass);
            for axis in 0..D {
                (m_p * columns[axis]).store(&mut gradient[axis]);
            }
        }
    }
}

/// Sums over the particles around the nodes of some planes, in the order of the particles.
pub(super) struct GradientSums<'a, const D: usize> {
    /// Particles and hosts.
    pub(super) around: &'a NeighbourParticles<D>,
    /// Gradients of the particles, times their masses \[kg/s\].
    pub(super) of_particles: &'a [HalfLineColumns<D>],
    /// The first node, and sums to be added to \[kg/s\].
    pub(super) first: usize,
    pub(super) sums: &'a mut [HalfLineColumns<D>],
    /// The grid, and what lies beyond it.
    pub(super) shape: &'a GridShape,
    pub(super) mirrors: &'a Mirrors,
}

impl<const D: usize> Kernel for GradientSums<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        // In the plane both columns are one line.
        match (D, self.around.stencil.len() / self.around.rows.len()) {
            (2, 3) => self.add::<B::Line, 3, 1>(),
            (2, _) => self.add::<B::Line, 4, 1>(),
            (_, 3) => self.add::<B::Half, 3, 3>(),
            (_, _) => self.add::<B::Half, 4, 3>(),
        }
    }
}

impl<const D: usize> GradientSums<'_, D> {
    /// Adds runs of particles with the same base, whose sums at a row of nodes are in `N` times `PARTS` registers.
    #[inline(always)]
    fn add<L: Lanes, const N: usize, const PARTS: usize>(self) {
        let Self {
            around,
            of_particles,
            first: own,
            sums,
            shape,
            mirrors,
        } = self;
        let reaches = &around.reaches;
        let mut p = 0;
        while p < reaches.len() {
            let reach = &reaches[p];
            let begin = p;
            p += 1;
            if reach.mirrored {
                to_images(
                    around,
                    reach,
                    &of_particles[begin],
                    (own, &mut *sums),
                    (shape, mirrors),
                );
                continue;
            }
            while p < reaches.len() && reaches[p].base() == reach.base() {
                p += 1;
            }
            for row in &around.rows {
                let first = reach.node(row);
                let slots = &around.slots[first..first + N];
                let Some(nodes) = first
                    .checked_sub(own)
                    .and_then(|at| sums.get_mut(at..at + N))
                else {
                    continue;
                };
                let mut hosts = 0;
                for k in 0..N {
                    hosts |= slots[k];
                }
                if hosts == 0 {
                    continue;
                }
                let mut row_sums = [[L::splat(0.0); PARTS]; N];
                for k in 0..N {
                    for part in 0..PARTS {
                        row_sums[k][part] = L::load(&nodes[k].as_flattened()[part * L::WIDTH..]);
                    }
                }
                for q in begin..p {
                    let (across, _) = reaches[q].across_row(row);
                    let (w, _) = reaches[q].along_row();
                    let mut columns = [L::splat(0.0); PARTS];
                    for part in 0..PARTS {
                        let column = L::load(&of_particles[q].as_flattened()[part * L::WIDTH..]);
                        columns[part] = L::splat(across) * column;
                    }
                    for k in 0..N {
                        for part in 0..PARTS {
                            row_sums[k][part] =
                                L::splat(w[k]).mul_add(columns[part], row_sums[k][part]);
                        }
                    }
                }
                for k in 0..N {
                    for part in 0..PARTS {
                        row_sums[k][part]
                            .store(&mut nodes[k].as_flattened_mut()[part * L::WIDTH..]);
                    }
                }
            }
        }
    }
}

/// Adds one particle some of whose nodes are ghosts, which its images give to.
fn to_images<const D: usize>(
    around: &NeighbourParticles<D>,
    reach: &StencilReach<D>,
    gradient: &HalfLineColumns<D>,
    (own, sums): (usize, &mut [HalfLineColumns<D>]),
    (shape, mirrors): (&GridShape, &Mirrors),
) {
    for node in &around.stencil {
        let (inside, sides) = reach.inside(node, shape, mirrors);
        let Some(sum) = inside.checked_sub(own).and_then(|at| sums.get_mut(at)) else {
            continue;
        };
        let weight = reach.weight(node);
        let columns = reflected(gradient, &sides);
        for (sum, x) in sum
            .as_flattened_mut()
            .iter_mut()
            .zip(columns.as_flattened())
        {
            *sum += weight * x;
        }
    }
}
