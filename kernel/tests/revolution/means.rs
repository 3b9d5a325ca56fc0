//! Means over cells: what they do to linear fields, and forces that are the transpose of strains.

use super::patch::{CELLS, H, columns, edges_of};
use crate::common::mesh;
use proctor_kernel::grid::{ActiveRows, GHOSTS_BELOW, GridShape, Nodes};
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::Sorter;
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::g2p::dilation;
use proctor_kernel::stage::p2g::{self, Carry, P2g};
use proctor_kernel::team::Team;
use proctor_kernel::weights::Family;
use proctor_scene::Dimension;
use proptest::prelude::*;

/// Sorted particles in random columns, and how they see the grid.
struct Rings {
    set: ParticleSet,
    shape: GridShape,
    mapping: Mapping,
    stencil: usize,
}

impl Rings {
    fn new(widths: &[f64], stencil: usize) -> Self {
        let mut set = columns(&edges_of(widths), [0.0; 4], false);
        let shape = GridShape::new(
            &mesh(Dimension::Two, [CELLS[0], CELLS[1], 1], H),
            Dimension::Two,
        );
        Sorter::default().sort(
            std::slice::from_mut(&mut set),
            &shape,
            (Family::Gimp, stencil),
            SelectedLanes::any(),
            &Team::ALONE,
            &mut ActiveRows::default(),
        );
        let mapping = Mapping::new(&shape, Family::Gimp, [0.25; 3], set.layout.half_length)
            .with_radius(0.0, true);
        Self {
            set,
            shape,
            mapping,
            stencil,
        }
    }

    /// Nodes with a velocity, by their radius and height in cells.
    fn moving(&self, velocity: impl Fn(f64, f64) -> [f64; 2]) -> Nodes {
        let mut nodes = Nodes::new(self.shape.nodes.iter().product());
        for i in 0..self.shape.nodes[0] {
            for k in 0..self.shape.nodes[2] {
                let at = |index: usize| index as f64 - GHOSTS_BELOW as f64;
                let [along, up] = velocity(at(i), at(k));
                let line = &mut nodes.lines_mut()[self.shape.index([i, 0, k])];
                (line[1], line[2]) = (along, up);
            }
        }
        nodes
    }

    fn excess(&mut self, nodes: &Nodes) -> Vec<f64> {
        let columns: Vec<&mut [f64]> = { self.set.columns.iter_mut() }
            .map(Vec::as_mut_slice)
            .collect();
        let mut found = vec![];
        dilation::excess(
            SelectedLanes::any(),
            self.stencil,
            &columns,
            &self.set.layout,
            &self.mapping,
            nodes.lines(),
            false,
            &mut found,
        );
        found
    }

    /// Nodes with the force of the mean stress by means over cells, less that by the usual operator.
    fn forced(&self) -> Nodes {
        let mut nodes = Nodes::new(self.shape.nodes.iter().product());
        let layers = self.shape.bases()[0];
        for averaged in [false, true] {
            let carry = Carry::MeanStress { averaged };
            p2g::instance(2, true, self.stencil, false, carry)(
                SelectedLanes::any(),
                P2g {
                    columns: &self.set.columns,
                    layout: &self.set.layout,
                    mapping: &self.mapping,
                    layers: &mut (0..layers)
                        .map(|layer| (self.set.in_layers(layer..layer + 1), true)),
                    planes: 0..self.shape.nodes[0],
                    nodes: nodes.lines_mut(),
                    carry,
                    viscous_rate: 0.0,
                },
            );
        }
        nodes.lines_mut().iter_mut().for_each(p2g::join);
        nodes
    }
}

/// A number from -1 to 1 that belongs to two others.
fn noise(a: f64, b: f64) -> f64 {
    let x = (12.9898 * a + 78.233 * b).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

proptest! {
    #![proptest_config(crate::common::cases(40))]

    /// An expansion along the radius and one along the axis are their own means, up to the axis and across nodes.
    #[test]
    fn a_uniform_strain_is_its_own_mean(widths in prop::collection::vec(0.15..0.99, 40)) {
        for stencil in [3, 4] {
            let mut rings = Rings::new(&widths, stencil);
            let nodes = rings.moving(|r, z| [0.7 * r, 0.3 - 0.4 * z]);
            for excess in rings.excess(&nodes) {
                prop_assert!((excess * H).abs() < 1e-12, "{excess:e}");
            }
        }
    }

    /// The power of the forces on any motion of the nodes is that of the mean stress on what the strain loses.
    #[test]
    fn forces_are_the_transpose_of_strains(widths in prop::collection::vec(0.15..0.99, 40)) {
        for stencil in [3, 4] {
            let mut rings = Rings::new(&widths, stencil);
            let first = Layout::stress(2);
            for p in 0..rings.set.len() {
                for component in 0..3 {
                    rings.set.columns[first + component][p] = noise(p as f64, component as f64);
                }
            }
            let moving = rings.moving(|r, z| [noise(r, z), noise(z, r + 0.5)]);
            let forced = rings.forced();
            let lines = forced.lines().iter().zip(moving.lines());
            let (mut power, mut scale) = (0.0, 0.0);
            for (force, velocity) in lines {
                for c in 0..2 {
                    let term = force[4 + c] * velocity[1 + c];
                    (power, scale) = (power + term, scale + f64::abs(term));
                }
            }
            let excess = rings.excess(&moving);
            let of = |column: usize, p: usize| rings.set.columns[column][p];
            let work = |(p, excess): (usize, &f64)| {
                let trace: f64 = (0..3).map(|c| of(first + c, p)).sum();
                of(Layout::VOLUME, p) * trace * excess
            };
            let lost: f64 = excess.iter().enumerate().map(work).sum();
            prop_assert!(scale > 0.0);
            prop_assert!((power - lost).abs() < 1e-12 * scale, "{power:e} against {lost:e}");
        }
    }
}
