//! The paths of AVX-512, eight particles at once and lines summed whole, have the bits of the lanes of this machine.

use proctor_kernel::grid::{GridShape, Line, Nodes};
use proctor_kernel::lanes::{Kernel, LaneChoice, Selected, WholeLines};
use proctor_kernel::laws::tensor::Configuration;
use proctor_kernel::laws::{AnyLaw, LinearElastic, NeoHookean};
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::scene::{Dimension, DomainUpdate, Mesh, PlaneCondition};
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::g2p::{self, Affine, FaultKind, G2p, Task};
use proctor_kernel::stage::p2g::{self, Carry, MASS_GRADIENT, NOTHING, P2g, SPIN};
use proctor_kernel::team::Team;
use proctor_kernel::weights::Family;

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
fn lanes() -> impl Iterator<Item = Selected> {
    [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar]
        .into_iter()
        .filter_map(|choice| Selected::new(choice).ok())
}

fn shape(axes: usize) -> GridShape {
    let (dimension, deep) = if axes == 2 {
        (Dimension::Two, 1)
    } else {
        (Dimension::Three, CELLS)
    };
    let mesh = Mesh {
        cells: [CELLS, CELLS, deep],
        cell: [1.0; 3],
        origin: [0.0; 3],
        planes: [[PlaneCondition::Free; 2]; 3],
    };
    GridShape::new(&mesh, dimension)
}

/// Sorted particles with numbers of all sizes, some of them without velocity or stress, and with zeros of both signs;
/// F is close to one.
fn particles(shape: &GridShape, stencil: usize, wanted: Optional) -> ParticleSet {
    let layout = Layout::new(shape.axes, wanted, &[]);
    let mut set = ParticleSet::zeros(layout, 0, PARTICLES);
    let mut numbers = Numbers(0x2545_f491_4f6c_dd1d);
    for (i, column) in set.columns.iter_mut().enumerate() {
        for (p, value) in column.iter_mut().enumerate() {
            let unit = numbers.unit();
            *value = if i < Layout::POSITION {
                0.1 + unit
            } else if i < Layout::POSITION + shape.axes {
                CELLS as f64 * unit
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
    let mut occupied = vec![None; shape.bases()[0] * shape.bases()[1]];
    set.sort(shape, stencil, &mut occupied, &Team::ALONE);
    set
}

/// Half-length of a domain in cells that asks for a stencil.
fn half_length(stencil: usize) -> f64 {
    if stencil == 4 { 0.9 } else { 0.3 }
}

fn mapping(shape: &GridShape, stencil: usize, set: &ParticleSet) -> Mapping {
    let half_length = [half_length(stencil); 3];
    Mapping::new(shape, Family::Gimp, half_length, set.layout.half_length)
}

/// The nodes after one mapping by `run`.
fn nodes_after(
    axes: usize,
    stencil: usize,
    (full, spin): (bool, bool),
    carry: Carry,
    run: &dyn Fn(P2g<'_>),
) -> Vec<Line> {
    let shape = shape(axes);
    let wanted = Optional {
        affine: full || spin,
        force: full,
        ..Optional::default()
    };
    let set = particles(&shape, stencil, wanted);
    let mut nodes = Nodes::new(shape.nodes.iter().product());
    run(P2g {
        columns: &set.columns,
        layout: &set.layout,
        mapping: &mapping(&shape, stencil, &set),
        layers: (0..shape.bases()[0])
            .map(|layer| (set.in_layers(layer..layer + 1), true))
            .collect(),
        planes: 0..shape.nodes[0],
        nodes: nodes.lines_mut(),
        carry,
        spin: set.layout.affine.filter(|_| spin),
        viscous_rate: if full { 0.5 } else { 0.0 },
    });
    nodes.lines().to_vec()
}

fn check_sums<
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const EXTRA: u8,
>(
    carry: Carry,
) {
    let kinds = (FULL, EXTRA == SPIN);
    let whole = nodes_after(D, N, kinds, carry, &|call| {
        p2g::Instance::<'_, D, N, FULL, GRADIENT, EXTRA>(call).run::<WholeLines>();
    });
    assert!(
        whole.iter().flatten().any(|value| *value != 0.0),
        "nothing was mapped"
    );
    for lanes in lanes() {
        let halves = nodes_after(D, N, kinds, carry, &|call| {
            lanes.run(p2g::Instance::<'_, D, N, FULL, GRADIENT, EXTRA>(call));
        });
        for (node, (found, expected)) in halves.iter().zip(&whole).enumerate() {
            assert_eq!(
                found.map(f64::to_bits),
                expected.map(f64::to_bits),
                "{} lanes, {carry:?} in {D}D with {N} nodes per axis, full {FULL}: {found:?} {expected:?} at {node}",
                lanes.name()
            );
        }
    }
}

fn check_all_sums<const D: usize, const N: usize>() {
    check_sums::<D, N, false, true, NOTHING>(Carry::All);
    check_sums::<D, N, false, true, NOTHING>(Carry::Force);
    check_sums::<D, N, false, false, NOTHING>(Carry::Momentum);
    check_sums::<D, N, false, false, NOTHING>(Carry::Remap);
    check_sums::<D, N, false, true, MASS_GRADIENT>(Carry::MassGradient);
    for carry in [Carry::All, Carry::Force, Carry::Momentum, Carry::Remap] {
        check_sums::<D, N, true, true, NOTHING>(carry);
    }
}

#[test]
fn a_line_has_the_same_bits_whole_and_by_halves_in_the_plane() {
    check_all_sums::<2, 3>();
    check_all_sums::<2, 4>();
    check_sums::<2, 3, true, true, SPIN>(Carry::AllAndSpin);
    check_sums::<2, 4, true, true, SPIN>(Carry::AllAndSpin);
}

#[test]
fn a_line_has_the_same_bits_whole_and_by_halves_in_space() {
    check_all_sums::<3, 3>();
    check_all_sums::<3, 4>();
}

/// The particles after one interpolation by `run` from nodes with numbers, and what went wrong.
fn particles_after(
    axes: usize,
    stencil: usize,
    wanted: Optional,
    law: &AnyLaw,
    task: Task,
    run: &dyn Fn(G2p<'_, '_>) -> g2p::Found,
) -> (Vec<Vec<u64>>, g2p::Found) {
    let shape = shape(axes);
    let mut set = particles(&shape, stencil, wanted);
    let mapping = mapping(&shape, stencil, &set);
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut nodes = Nodes::new(shape.nodes.iter().product());
    for line in nodes.lines_mut() {
        *line = std::array::from_fn(|_| numbers.unit() - 0.5);
    }
    let found = {
        let mut columns: Vec<&mut [f64]> = set.columns.iter_mut().map(Vec::as_mut_slice).collect();
        run(G2p {
            lanes: Selected::any(),
            columns: &mut columns,
            layout: &set.layout,
            mapping: &mapping,
            law: &**law,
            density: 2.0,
            domain_update: wanted.half_length.then_some(DomainUpdate::LeftStretch),
            nodes: nodes.lines(),
            beyond: [(CELLS as f64).next_up(); 3],
            task,
        })
    };
    let bits = |column: &Vec<f64>| column.iter().map(|value| value.to_bits()).collect();
    (set.columns.iter().map(bits).collect(), found)
}

fn check_particles<
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
>(
    law: impl Into<AnyLaw>,
    affine: Affine,
) {
    let law = law.into();
    let finite = law.needs_deformation();
    let wanted = Optional {
        deformation: finite,
        affine: affine != Affine::Leave,
        half_length: finite,
        initial_half_length: finite,
        ..Optional::default()
    };
    let task = Task {
        kick: KICK,
        pic_fraction: 0.25,
        drift: Some(0.01),
        mesh_shift: [0.001, 0.0, 0.0],
        strain: GRADIENT.then_some((0.01, Configuration::Beginning)),
        gradient_of_upper: UPPER,
        affine,
    };
    let after =
        |run: &dyn Fn(G2p<'_, '_>) -> g2p::Found| particles_after(D, N, wanted, &law, task, run);
    let (expected, all) = after(&|call| {
        g2p::Instance::<'_, '_, D, N, KICK, GRADIENT, APIC, UPPER>(call).run::<WholeLines>()
    });
    // Some particles lie close to the boundary and leave.
    assert!(matches!(all.fault, None | Some((_, FaultKind::Outside))));
    for lanes in lanes() {
        let (found, sums) = after(&|call| {
            lanes.run(g2p::Instance::<'_, '_, D, N, KICK, GRADIENT, APIC, UPPER>(
                call,
            ))
        });
        assert_eq!(
            sums,
            all,
            "{} lanes, {D}D, {N} nodes per axis",
            lanes.name()
        );
        for (column, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(
                found,
                expected,
                "{} lanes, {D}D, {N}: column {column}",
                lanes.name()
            );
        }
    }
}

fn check_all_particles<const D: usize, const N: usize>() {
    let elastic = LinearElastic::new(1e3, 0.3);
    let neo_hookean = NeoHookean::new(1e3, 0.3);
    check_particles::<D, N, true, true, false, false>(elastic, Affine::Leave);
    check_particles::<D, N, true, true, false, false>(neo_hookean, Affine::Tpic);
    check_particles::<D, N, true, true, true, false>(neo_hookean, Affine::Apic);
    check_particles::<D, N, true, false, false, false>(elastic, Affine::Leave);
    check_particles::<D, N, false, true, false, true>(elastic, Affine::Leave);
    check_particles::<D, N, false, true, false, false>(elastic, Affine::Leave);
}

#[test]
fn particles_have_the_same_bits_eight_at_once() {
    check_all_particles::<2, 3>();
    check_all_particles::<2, 4>();
    check_all_particles::<3, 3>();
    check_all_particles::<3, 4>();
}
