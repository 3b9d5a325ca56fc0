//! Patch tests of the mapping: a stress that is at rest gives no node inside a force.

use crate::common::mesh;
use proctor_kernel::grid::{ActiveRows, GHOSTS_BELOW, GridShape, Nodes};
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::Sorter;
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::p2g::{self, Carry, P2g};
use proctor_kernel::team::Team;
use proctor_kernel::weights::Family;
use proctor_scene::Dimension;
use proptest::prelude::*;
use std::f64::consts::TAU;

pub const CELLS: [usize; 2] = [6, 4];
pub const H: f64 = 0.1;
/// Force over stress and cell that is round-off.
const ROUND_OFF: f64 = 1e-12;

/// Domains in columns with these radial edges, in cells, and rows of half a cell from the bottom to the top of the mesh.
pub fn columns(edges: &[f64], stress: [f64; 4], full: bool) -> ParticleSet {
    let wanted = Optional {
        half_length: true,
        affine: full,
        axisymmetric: true,
        ..Optional::default()
    };
    let layout = Layout::new(2, wanted, &[]);
    let rows = 2 * CELLS[1];
    let mut set = ParticleSet::zeros(layout, 0, rows * (edges.len() - 1));
    let first = layout.half_length.expect("wanted");
    let mut p = 0;
    for pair in edges.windows(2) {
        for row in 0..rows {
            let (r, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            set.columns[Layout::MASS][p] = 1.0;
            set.columns[Layout::POSITION][p] = r * H;
            set.columns[Layout::POSITION + 1][p] = (0.5 * row as f64 + 0.25) * H;
            // The volume of a ring with this rectangle.
            set.columns[Layout::VOLUME][p] = TAU * r * H * (2.0 * half * H) * (0.5 * H);
            for (component, value) in stress.into_iter().enumerate() {
                set.columns[Layout::stress(2) + component][p] = value;
            }
            set.columns[first][p] = half;
            set.columns[first + 1][p] = 0.25;
            p += 1;
        }
    }
    set
}

/// The nodes with the forces of particles, ghosts not folded, and their places.
fn forces(mut set: ParticleSet, stencil: usize, full: bool) -> (GridShape, Nodes) {
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
    let mut nodes = Nodes::new(shape.nodes.iter().product());
    let layers = shape.bases()[0];
    p2g::instance(2, true, stencil, full, Carry::All)(
        SelectedLanes::any(),
        P2g {
            columns: &set.columns,
            layout: &set.layout,
            mapping: &mapping,
            layers: &mut (0..layers).map(|layer| (set.in_layers(layer..layer + 1), true)),
            planes: 0..shape.nodes[0],
            nodes: nodes.lines_mut(),
            carry: Carry::All,
            viscous_rate: 0.0,
        },
    );
    nodes.lines_mut().iter_mut().for_each(p2g::join_with_hoop);
    (shape, nodes)
}

/// The largest force on a node inside, over stress and cell.
fn force_inside(set: ParticleSet, stencil: usize, full: bool) -> f64 {
    let (shape, nodes) = forces(set, stencil, full);
    let mut most = 0.0_f64;
    for plane in 0..CELLS[0] {
        // What a node beyond the axis has is folded: its radial force against that of its mirror image.
        for k in 1..CELLS[1] {
            let at = |plane: usize| shape.index([plane + GHOSTS_BELOW, 0, k + GHOSTS_BELOW]);
            let own = nodes.lines()[at(plane)];
            let mut force = [own[4], own[5]];
            if plane == 1 {
                let ghost = nodes.lines()[at(0) - shape.plane_nodes()];
                force = [force[0] - ghost[4], force[1] + ghost[5]];
            }
            // The axis takes the radial force on it.
            if plane > 0 {
                most = most.max(force[0].abs());
            }
            most = most.max(force[1].abs());
        }
    }
    most / (H * H)
}

pub fn edges_of(widths: &[f64]) -> Vec<f64> {
    let end = CELLS[0] as f64;
    let mut edges = vec![0.0];
    for width in widths {
        let next = edges[edges.len() - 1] + width;
        if next > end - 0.3 {
            break;
        }
        edges.push(next);
    }
    edges.push(end);
    // No domain is wider than the stencil allows.
    while edges[edges.len() - 1] - edges[edges.len() - 2] > 0.99 {
        let last = edges.len() - 1;
        let middle = 0.5 * (edges[last] + edges[last - 1]);
        edges.insert(last, middle);
    }
    edges
}

const PRESSURE: [f64; 4] = [-1.0, -1.0, -1.0, 0.0];
const ALONG_THE_AXIS: [f64; 4] = [0.0, 1.0, 0.0, 0.0];

proptest! {
    #![proptest_config(crate::common::cases(60))]

    #[test]
    fn random_columns_at_rest_stay_at_rest(widths in prop::collection::vec(0.15..0.99, 40), full: bool) {
        let edges = edges_of(&widths);
        for stress in [PRESSURE, ALONG_THE_AXIS] {
            for stencil in [3, 4] {
                let force = force_inside(columns(&edges, stress, full), stencil, full);
                prop_assert!(force < ROUND_OFF, "{stress:?} {stencil} nodes, {full}: {force:e}");
            }
        }
    }
}

#[test]
fn three_particles_on_two_cells_stay_at_rest() {
    let edges: Vec<f64> = (0..=9).map(|k| 2.0 / 3.0 * f64::from(k)).collect();
    for full in [false, true] {
        let force = force_inside(columns(&edges, PRESSURE, full), 3, full);
        assert!(force < ROUND_OFF, "{force:e}");
    }
}

/// Nothing of the test above holds for a stress that is not at rest.
#[test]
fn a_hoop_stress_alone_is_a_force() {
    let edges: Vec<f64> = (0..=12).map(|k| 0.5 * f64::from(k)).collect();
    let force = force_inside(columns(&edges, [0.0, 0.0, 1.0, 0.0], false), 3, false);
    // 2 pi sigma h per height and width of a cell.
    assert!((force / TAU - 1.0).abs() < 0.1, "{force}");
}

/// A domain that the motion takes across the axis goes on in its mirror image. Velocities along the axis are even in the radius:
/// with the slope s beside the axis the domain from r - l to r + l has (|r + l| - |r - l|)/(2 l) = r/l of it as shear strain rate.
/// A weight with the radius would give it a shear that grows like 1/r.
#[test]
fn a_domain_across_the_axis_has_the_shear_of_its_mirror_image() {
    let (r, half) = (0.1, 0.25);
    for full in [false, true] {
        for stencil in [3, 4] {
            let set = columns(&[r - half, r + half], [0.0, 0.0, 0.0, 1.0], full);
            let volume: f64 = set.columns[Layout::VOLUME].iter().sum();
            let (shape, nodes) = forces(set, stencil, full);
            // The node beside the axis and its mirror image move along the axis, by the slope 1/h.
            let mut force = 0.0;
            for plane in [GHOSTS_BELOW + 1, GHOSTS_BELOW - 1] {
                for k in 0..shape.nodes[2] {
                    force += nodes.lines()[plane * shape.plane_nodes() + k][5];
                }
            }
            let exact = -volume / H * r / half;
            assert!(
                (force / exact - 1.0).abs() < ROUND_OFF,
                "{stencil} nodes, {full}: {force} {exact}"
            );
        }
    }
}
