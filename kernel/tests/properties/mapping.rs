//! Particles to nodes: the nodes hold what the particles hold.

use crate::common::{WEIGHTINGS, mesh};
use proctor_kernel::grid::{ActiveRows, GridShape, Nodes};
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::Sorter;
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::p2g::{self, Carry, P2g};
use proctor_kernel::team::Team;
use proctor_kernel::weights::Family;
use proctor_scene::{Dimension, Weighting};
use proptest::prelude::*;

const CELLS: [usize; 3] = [6, 5, 4];
const H: f64 = 0.1;

/// One particle of the test: position in shares of the mesh, mass, velocity, stress, affine rate and force from one list of
/// numbers in [-1, 1].
type Draw = ([f64; 3], f64, [f64; 27]);

fn particles_of(axes: usize, draws: &[Draw], full: bool, l: Option<f64>) -> ParticleSet {
    let layout = Layout::new(
        axes,
        Optional {
            affine: full,
            force: full,
            half_length: l.is_some(),
            ..Optional::default()
        },
        &[],
    );
    let mut set = ParticleSet::zeros(layout, 0, draws.len());
    for (p, (x, mass, values)) in draws.iter().enumerate() {
        set.columns[Layout::MASS][p] = *mass;
        set.columns[Layout::VOLUME][p] = 1.0e-3 * mass;
        for axis in 0..axes {
            set.columns[Layout::POSITION + axis][p] = x[axis] * CELLS[axis] as f64 * H;
        }
        let mut next = values.iter();
        let mut fill = |first: usize, count: usize, set: &mut ParticleSet| {
            for column in first..first + count {
                set.columns[column][p] = *next.next().expect("enough numbers");
            }
        };
        fill(Layout::velocity(axes), axes, &mut set);
        fill(Layout::stress(axes), layout.stress_components(), &mut set);
        if let (Some(affine), Some(force)) = (layout.affine, layout.force) {
            fill(affine, axes * axes, &mut set);
            fill(force, axes, &mut set);
        }
        if let Some(first) = layout.half_length {
            for axis in 0..axes {
                set.columns[first + axis][p] = l.expect("given") * (1.0 - 0.5 * values[axis].abs());
            }
        }
    }
    set
}

/// Sums over the nodes of mass, momentum and force, and of the moment of mass.
fn nodal_sums(shape: &GridShape, nodes: &Nodes) -> ([f64; 8], [f64; 3]) {
    let (mut sums, mut moment) = ([0.0; 8], [0.0; 3]);
    for (node, line) in nodes.lines().iter().enumerate() {
        for c in 0..8 {
            sums[c] += line[c];
        }
        for axis in 0..3 {
            moment[axis] += line[0] * shape.position(node)[axis];
        }
    }
    (sums, moment)
}

fn check(
    dimension: Dimension,
    weighting: Weighting,
    draws: &[Draw],
    wide: bool,
    full: bool,
) -> Result<(), TestCaseError> {
    let axes = dimension.axes();
    let shape = GridShape::new(&mesh(dimension, CELLS, H), dimension);
    let (family, half_length, own) = match weighting {
        Weighting::Linear => (Family::Hat, 0.25, None),
        Weighting::QuadraticBSpline => (Family::Gimp, 0.5, None),
        Weighting::UniformGimp => (Family::Gimp, 0.25, None),
        Weighting::ContiguousGimp(_) => (Family::Gimp, 0.25, Some(if wide { 0.9 } else { 0.5 })),
    };
    let stencil = if own.is_some() && wide { 4 } else { 3 };
    let mut set = particles_of(axes, draws, full, own);
    Sorter::default().sort(
        std::slice::from_mut(&mut set),
        &shape,
        (family, stencil),
        SelectedLanes::any(),
        &Team::ALONE,
        &mut ActiveRows::default(),
    );
    let mapping = Mapping::new(&shape, family, [half_length; 3], set.layout.half_length);
    let mut nodes = Nodes::new(shape.nodes.iter().product());
    let layers = shape.bases()[0];
    let viscous_rate = if full { 0.5 } else { 0.0 };
    p2g::instance(axes, false, family.stage_nodes(stencil), full, Carry::All)(
        SelectedLanes::any(),
        P2g {
            columns: &set.columns,
            layout: &set.layout,
            mapping: &mapping,
            layers: &mut (0..layers).map(|layer| (set.in_layers(layer..layer + 1), true)),
            planes: 0..shape.nodes[0],
            nodes: nodes.lines_mut(),
            carry: Carry::All,
            viscous_rate,
        },
    );
    if axes == 2 {
        nodes.lines_mut().iter_mut().for_each(p2g::join);
    }
    let (sums, moment) = nodal_sums(&shape, &nodes);

    let n = draws.len() as f64;
    let sum = |term: &dyn Fn(usize) -> f64| (0..set.len()).map(term).sum::<f64>();
    let size = |term: &dyn Fn(usize) -> f64| (0..set.len()).map(|p| term(p).abs()).sum::<f64>();
    let m = |p: usize| set.columns[Layout::MASS][p];
    // A sum of n terms, each of up to 64 products of three rounded factors.
    let round_off = (n + 64.0) * f64::EPSILON;
    let mass = sum(&m);
    prop_assert!(
        (sums[0] - mass).abs() <= round_off * mass,
        "mass {} {mass}",
        sums[0]
    );
    for axis in 0..axes {
        let v = |p: usize| set.velocity(p)[axis];
        // The affine part adds C (x_I - x_p), which sums to zero; |C| is at most 1 per second and a stencil
        // reaches three cells.
        let scale = size(&|p| m(p) * v(p)) + if full { mass * 3.0 * 3.0 * H } else { 0.0 };
        let momentum = sum(&|p| m(p) * v(p));
        prop_assert!(
            (sums[1 + axis] - momentum).abs() <= round_off * scale,
            "momentum {axis}"
        );
        // Internal forces sum to zero: what is left is what acts on the particles from outside. The scale is
        // V |sigma| |grad S|, with derivatives of at most 1/h at four nodes per axis.
        let outer = |p: usize| {
            set.layout
                .force
                .map_or(0.0, |first| set.columns[first + axis][p])
                - viscous_rate * m(p) * v(p)
        };
        let scale = size(&outer) + size(&|p| set.columns[Layout::VOLUME][p]) * 3.0 * 64.0 / H;
        prop_assert!(
            (sums[4 + axis] - sum(&outer)).abs() <= round_off * scale,
            "force {axis}"
        );
        let x = sum(&|p| m(p) * set.position(p)[axis]);
        let scale = mass * (CELLS[axis] as f64 + 3.0) * H;
        prop_assert!(
            (moment[axis] - x).abs() <= round_off * scale,
            "moment of mass {axis}"
        );
    }
    Ok(())
}

fn draws() -> impl Strategy<Value = Vec<Draw>> {
    let place = prop_oneof![0.0..=1.0, (0_u32..=12).prop_map(|k| f64::from(k) / 12.0)];
    let one = (
        prop::array::uniform3(place),
        // Masses over twelve decades: no cut-off may lose any.
        (-9.0..3.0).prop_map(|e: f64| 10.0_f64.powf(e)),
        prop::collection::vec(-1.0..1.0, 27).prop_map(|v| v.try_into().expect("27 numbers")),
    );
    prop::collection::vec(one, 1..60)
}

proptest! {
    #![proptest_config(crate::common::cases(150))]

    #[test]
    fn nodes_hold_mass_momentum_and_force_of_the_particles(draws in draws(), wide: bool, full: bool) {
        for weighting in WEIGHTINGS {
            for dimension in crate::common::DIMENSIONS {
                check(dimension, weighting, &draws, wide, full)?;
            }
        }
    }
}
