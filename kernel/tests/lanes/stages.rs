//! The paths of AVX-512, eight particles at once and lines summed whole, have the bits of the lanes of this machine.

use proctor_kernel::grid::{ActiveRows, GridShape, Line, Nodes};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::Sorter;
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::g2p::{self, Affine, FaultKind, G2p, Task, dilation};
use proctor_kernel::stage::p2g::{self, Carry, P2g};
use proctor_kernel::team::Team;
use proctor_kernel::weights::{Family, base_offset};
use proctor_laws::tensor::Configuration;
use proctor_laws::{AnyLaw, LinearElastic, NeoHookean};
use proctor_scene::{Dimension, DomainUpdate, Mesh, PlaneCondition};

const CELLS: usize = 4;
const PARTICLES: usize = 150;

/// Numbers in 0 to 1 (xorshift).
struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The lanes of this machine.
fn lanes() -> impl Iterator<Item = SelectedLanes> {
    [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar]
        .into_iter()
        .filter_map(|choice| SelectedLanes::new(choice).ok())
}

fn shape(axes: usize) -> GridShape {
    let (dimension, deep) = if axes == 2 {
        (Dimension::Two, 1)
    } else {
        (Dimension::Three, CELLS)
    };
    let mesh = Mesh {
        axisymmetric: false,
        cells: [CELLS, CELLS, deep],
        cell: [1.0; 3],
        origin: [0.0; 3],
        planes: [[PlaneCondition::Free; 2]; 3],
    };
    GridShape::new(&mesh, dimension)
}

/// Places of the particles.
#[derive(Clone, Copy, Debug)]
enum Order {
    /// Anywhere, sorted.
    Sorted,
    /// Sorted, as many at a base node as [`RUNS`] says, node by node: whole blocks of one base node behind others.
    Runs,
    /// Anywhere, up to a quarter of a cell from where they were sorted.
    Stale,
}

const ORDERS: [Order; 3] = [Order::Sorted, Order::Runs, Order::Stale];
const RUNS: [usize; 10] = [5, 8, 8, 3, 16, 1, 2, 4, 7, 9];

/// The base node along an axis of particle `p` of [`Order::Runs`], one of three.
fn base_of_run(p: usize, axis: usize) -> usize {
    let round: usize = RUNS.iter().sum();
    let mut last = 0;
    let run = RUNS.iter().position(|length| {
        last += length;
        p % round < last
    });
    let run = RUNS.len() * (p / round) + run.unwrap_or(0);
    run / 3_usize.pow(axis as u32) % 3
}

/// Particles with numbers of all sizes, some of them without velocity or stress, and with zeros of both signs; F is close to
/// one.
fn particles(shape: &GridShape, stencil: usize, wanted: Optional, order: Order) -> ParticleSet {
    let layout = Layout::new(shape.axes, wanted, &[]);
    let mut set = ParticleSet::zeros(layout, 0, PARTICLES);
    let mut numbers = Numbers(0x2545_f491_4f6c_dd1d);
    for (i, column) in set.columns.iter_mut().enumerate() {
        for (p, value) in column.iter_mut().enumerate() {
            let unit = numbers.unit();
            *value = if i < Layout::POSITION {
                0.1 + unit
            } else if i < Layout::POSITION + shape.axes {
                match order {
                    Order::Runs => {
                        let base = base_of_run(p, i - Layout::POSITION) as f64;
                        base + base_offset(stencil) + 0.4 * unit
                    }
                    // Hats have other nodes where a particle lies on one.
                    _ if stencil == 2 && (p + i) % 16 == 0 => (CELLS as f64 * unit).floor(),
                    _ => CELLS as f64 * unit,
                }
            } else if let Some(first) = layout.deformation.filter(|first| i >= *first) {
                let diagonal = i < first + shape.axes.pow(2) && (i - first) % (shape.axes + 1) == 0;
                f64::from(diagonal) + 0.1 * unit
            } else {
                match p % 5 {
                    0 => 0.0,
                    1 => -0.0,
                    _ => (unit - 0.5) * 10_f64.powi((p % 7) as i32),
                }
            };
        }
    }
    let lengths = [layout.half_length, layout.initial_half_length];
    for first in lengths.into_iter().flatten() {
        for column in &mut set.columns[first..first + shape.axes] {
            column.fill(half_length(stencil));
        }
    }
    Sorter::default().sort(
        std::slice::from_mut(&mut set),
        shape,
        (family(stencil), reach(stencil)),
        SelectedLanes::any(),
        &Team::ALONE,
        &mut ActiveRows::default(),
    );
    if matches!(order, Order::Stale) {
        for column in &mut set.columns[Layout::POSITION..Layout::POSITION + shape.axes] {
            for x in column {
                *x = (*x + 0.5 * (numbers.unit() - 0.5)).clamp(0.0, CELLS as f64);
            }
        }
    }
    set
}

/// Functions that map to so many nodes per axis: two are those of hats.
fn family(stencil: usize) -> Family {
    if stencil == 2 {
        Family::Hat
    } else {
        Family::Gimp
    }
}

/// Nodes per axis that they reach.
fn reach(stencil: usize) -> usize {
    stencil.max(3)
}

/// Half-length of a domain in cells that asks for a stencil.
fn half_length(stencil: usize) -> f64 {
    if stencil == 4 { 0.9 } else { 0.3 }
}

fn mapping(shape: &GridShape, stencil: usize, set: &ParticleSet) -> Mapping {
    let half_length = [half_length(stencil); 3];
    Mapping::new(shape, family(stencil), half_length, set.layout.half_length)
}

/// The nodes after one mapping, which says how many groups it met.
fn nodes_after(
    lanes: SelectedLanes,
    axes: usize,
    stencil: usize,
    full: bool,
    carry: Carry,
    order: Order,
) -> Vec<Line> {
    let shape = shape(axes);
    let wanted = Optional {
        affine: full,
        force: full,
        ..Optional::default()
    };
    let set = particles(&shape, stencil, wanted, order);
    let mut nodes = Nodes::new(shape.nodes.iter().product());
    let map = p2g::instance(axes, false, stencil, full, carry);
    let groups = map(
        lanes,
        P2g {
            columns: &set.columns,
            layout: &set.layout,
            mapping: &mapping(&shape, stencil, &set),
            layers: &mut (0..shape.bases()[0]).map(|layer| (set.in_layers(layer..layer + 1), true)),
            planes: 0..shape.nodes[0],
            nodes: nodes.lines_mut(),
            carry,
            viscous_rate: if full { 0.5 } else { 0.0 },
        },
    );
    // Other carriers take the three nodes of hats, and nobody asks how many groups they met.
    let counts = stencil > 2 || !matches!(carry, Carry::MassGradient | Carry::MeanStress { .. });
    if counts {
        assert_eq!(groups, groups_of(&set, stencil), "{} lanes", lanes.name());
    }
    nodes.lines().to_vec()
}

/// Number of groups of at most eight particles that follow each other and have one base node.
fn groups_of(set: &ParticleSet, stencil: usize) -> usize {
    let base = |p: usize| -> Vec<f64> {
        set.columns[Layout::POSITION..Layout::POSITION + set.layout.axes]
            .iter()
            .map(|x| (x[p] - base_offset(stencil)).floor())
            .collect()
    };
    let mut groups = 0;
    for layer in 0..set.layers.len() - 1 {
        let (mut last, mut length) = (vec![], 0);
        for p in set.in_layers(layer..layer + 1) {
            if base(p) != last || length == 8 {
                (last, length) = (base(p), 0);
                groups += 1;
            }
            length += 1;
        }
    }
    groups
}

fn check_sums(axes: usize, stencil: usize, full: bool, carry: Carry) {
    for order in ORDERS {
        check_order(axes, stencil, full, carry, order);
    }
}

fn check_order(axes: usize, stencil: usize, full: bool, carry: Carry, order: Order) {
    let after = |lanes| nodes_after(lanes, axes, stencil, full, carry, order);
    let whole = after(SelectedLanes::plain());
    assert!(
        whole.iter().flatten().any(|value| *value != 0.0),
        "nothing was mapped"
    );
    for lanes in lanes() {
        for (node, (found, expected)) in after(lanes).iter().zip(&whole).enumerate() {
            assert_eq!(
                found.map(f64::to_bits),
                expected.map(f64::to_bits),
                "{} lanes, {carry:?} {order:?} in {axes}D with {stencil} nodes per axis, full {full}: {found:?} {expected:?} at {node}",
                lanes.name()
            );
        }
    }
}

fn check_all_sums(axes: usize) {
    for stencil in [2, 3, 4] {
        for carry in [Carry::All, Carry::Force, Carry::Momentum, Carry::Remap] {
            check_sums(axes, stencil, false, carry);
            check_sums(axes, stencil, true, carry);
        }
        check_sums(axes, stencil, false, Carry::MassGradient);
        for averaged in [false, true] {
            check_sums(axes, stencil, false, Carry::MeanStress { averaged });
        }
    }
}

#[test]
fn a_line_has_the_same_bits_whole_and_by_halves_in_the_plane() {
    check_all_sums(2);
}

#[test]
fn a_line_has_the_same_bits_whole_and_by_halves_in_space() {
    check_all_sums(3);
}

/// The bits of the particles after one interpolation from nodes with numbers, and what went wrong.
fn particles_after(
    lanes: SelectedLanes,
    axes: usize,
    stencil: usize,
    law: &AnyLaw,
    task: Task,
    cell_average: bool,
    order: Order,
) -> (Vec<Vec<u64>>, g2p::ParticleMaxima) {
    let (columns, found) = gathered(lanes, axes, [stencil; 2], law, task, cell_average, order);
    let bits = |column: &Vec<f64>| column.iter().map(|value| value.to_bits()).collect();
    (columns.iter().map(bits).collect(), found)
}

/// The same as numbers, by a stage of so many nodes per axis.
fn gathered(
    lanes: SelectedLanes,
    axes: usize,
    [stencil, nodes_of_stage]: [usize; 2],
    law: &AnyLaw,
    task: Task,
    cell_average: bool,
    order: Order,
) -> (Vec<Vec<f64>>, g2p::ParticleMaxima) {
    let finite = law.needs_deformation();
    let wanted = Optional {
        deformation: finite,
        affine: task.affine != Affine::Leave,
        half_length: finite,
        initial_half_length: finite,
        ..Optional::default()
    };
    let shape = shape(axes);
    let mut set = particles(&shape, stencil, wanted, order);
    let mapping = mapping(&shape, stencil, &set);
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut nodes = Nodes::new(shape.nodes.iter().product());
    for line in nodes.lines_mut() {
        *line = std::array::from_fn(|_| numbers.unit() - 0.5);
    }
    let found = {
        let mut columns: Vec<&mut [f64]> = set.columns.iter_mut().map(Vec::as_mut_slice).collect();
        let mut excess = vec![];
        if cell_average {
            let upper = task.gradient_of_upper;
            dilation::excess(
                lanes,
                reach(stencil),
                &columns,
                &set.layout,
                &mapping,
                nodes.lines(),
                upper,
                &mut excess,
            );
        }
        let call = G2p {
            lanes,
            columns: &mut columns,
            layout: &set.layout,
            mapping: &mapping,
            law: &**law,
            density: 2.0,
            domain_update: wanted.half_length.then_some(DomainUpdate::LeftStretch),
            nodes: nodes.lines(),
            beyond: [(CELLS as f64).next_up(); 3],
            excess: &excess,
            task,
        };
        g2p::instance(axes, false, nodes_of_stage, &task)(lanes, call)
    };
    (set.columns, found)
}

/// Parts of a pass: kick, strain, gradients of the upper lanes.
type Pass = [bool; 3];

fn check_particles(
    axes: usize,
    stencil: usize,
    law: impl Into<AnyLaw>,
    affine: Affine,
    [kick, strain, gradient_of_upper]: Pass,
) {
    let law = law.into();
    let task = Task {
        kick,
        pic_fraction: 0.25,
        drift: Some(0.01),
        mesh_shift: [0.001, 0.0, 0.0],
        strain: strain.then_some((0.01, Configuration::Beginning)),
        gradient_of_upper,
        affine,
    };
    for cell_average in [false, true] {
        for order in ORDERS {
            check_pass(axes, stencil, &law, task, cell_average, order);
        }
    }
}

fn check_pass(
    axes: usize,
    stencil: usize,
    law: &AnyLaw,
    task: Task,
    cell_average: bool,
    order: Order,
) {
    let after = |lanes| particles_after(lanes, axes, stencil, law, task, cell_average, order);
    let (expected, all) = after(SelectedLanes::plain());
    // Some particles lie close to the boundary and leave.
    assert!(matches!(all.fault, None | Some((_, FaultKind::Outside))));
    let both = |lanes: SelectedLanes| [false, true].map(|whole| lanes.with_whole_groups(whole));
    for lanes in lanes().flat_map(both) {
        let name = lanes.name();
        let (found, sums) = after(lanes);
        assert_eq!(sums, all, "{name} lanes, {axes}D, {stencil} nodes per axis");
        for (column, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(
                found, expected,
                "{name} lanes, {axes}D, {stencil}, {order:?}: column {column}"
            );
        }
    }
}

#[test]
fn particles_have_the_same_bits_eight_at_once() {
    let elastic = LinearElastic::new(1e3, 0.3);
    let neo_hookean = NeoHookean::new(1e3, 0.3);
    for (axes, stencil) in [(2, 2), (2, 3), (2, 4), (3, 2), (3, 3), (3, 4)] {
        check_particles(axes, stencil, elastic, Affine::Leave, [true, true, false]);
        check_particles(
            axes,
            stencil,
            neo_hookean,
            Affine::Tpic,
            [true, true, false],
        );
        check_particles(
            axes,
            stencil,
            neo_hookean,
            Affine::Apic,
            [true, true, false],
        );
        check_particles(axes, stencil, elastic, Affine::Leave, [true, false, false]);
        check_particles(axes, stencil, elastic, Affine::Leave, [false, true, true]);
        check_particles(axes, stencil, elastic, Affine::Leave, [false, true, false]);
    }
}

/// Hats at the two nodes around a particle, and the three where it lies on one, have the numbers that three nodes have for all:
/// in sums of one particle per node to the last bit, as the third adds nothing.
#[test]
fn two_nodes_of_a_hat_have_the_numbers_of_three() {
    for axes in [2, 3] {
        let shape = shape(axes);
        let set = particles(&shape, 2, Optional::default(), Order::Sorted);
        let on_a_node = |p: usize| set.position(p)[..axes].iter().any(|x| x.fract() == 0.0);
        assert!((0..set.len()).any(on_a_node), "no particle lies on a node");
        let mapping = mapping(&shape, 2, &set);
        for full in [false, true] {
            let map = |nodes: usize, p: usize| {
                let mut lines = Nodes::new(shape.nodes.iter().product());
                p2g::instance(axes, false, nodes, full, Carry::All)(
                    SelectedLanes::any(),
                    P2g {
                        columns: &set.columns,
                        layout: &set.layout,
                        mapping: &mapping,
                        layers: &mut std::iter::once((p..p + 1, true)),
                        planes: 0..shape.nodes[0],
                        nodes: lines.lines_mut(),
                        carry: Carry::All,
                        viscous_rate: 0.0,
                    },
                );
                lines.lines().to_vec()
            };
            for p in 0..set.len() {
                for (node, (two, three)) in map(2, p).iter().zip(&map(3, p)).enumerate() {
                    assert_eq!(two, three, "{axes}D, particle {p} at node {node}");
                }
            }
        }
        for affine in [Affine::Leave, Affine::Apic] {
            let elastic: AnyLaw = LinearElastic::new(1e3, 0.3).into();
            let task = Task {
                kick: true,
                pic_fraction: 0.25,
                drift: Some(0.01),
                mesh_shift: [0.0; 3],
                strain: Some((0.01, Configuration::Beginning)),
                gradient_of_upper: false,
                affine,
            };
            let after = |nodes| {
                let (columns, _) = gathered(
                    SelectedLanes::any(),
                    axes,
                    [2, nodes],
                    &elastic,
                    task,
                    false,
                    Order::Sorted,
                );
                columns
            };
            let (two, three) = (after(2), after(3));
            for (column, (two, three)) in two.iter().zip(&three).enumerate() {
                let largest = three
                    .iter()
                    .fold(0.0_f64, |most, value| most.max(value.abs()));
                for (found, expected) in two.iter().zip(three) {
                    assert!(
                        (found - expected).abs() <= 8.0 * f64::EPSILON * largest,
                        "{axes}D, column {column}: {found} {expected}"
                    );
                }
            }
        }
    }
}
