//! Particles are kept in order of their base cells, whatever the threads, the lanes and the share of empty cells.

use proctor_kernel::grid::{ActiveRows, GridShape};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::{Sorter, rows_of};
use proctor_kernel::team::Team;
use proctor_kernel::weights::Family;
use proctor_scene::{Dimension, Mesh, PlaneCondition};
use proptest::prelude::*;

const CELL: [f64; 3] = [0.25, 0.5, 0.125];

fn shape(dimension: Dimension, cells: [usize; 3]) -> GridShape {
    let mesh = Mesh {
        axisymmetric: false,
        cells,
        cell: CELL,
        origin: [0.0; 3],
        planes: [[PlaneCondition::Free; 2]; 3],
    };
    GridShape::new(&mesh, dimension)
}

/// Particles at these places, in shares of the mesh.
fn set(shape: &GridShape, places: &[[f64; 3]], first_id: u64) -> ParticleSet {
    let layout = Layout::new(shape.axes, Optional::default(), &[]);
    let mut set = ParticleSet::zeros(layout, first_id, places.len());
    for (p, place) in places.iter().enumerate() {
        for axis in 0..shape.axes {
            set.columns[Layout::POSITION + axis][p] =
                place[axis] * shape.cells[axis] as f64 * shape.cell[axis];
        }
        set.columns[Layout::MASS][p] = (first_id + p as u64) as f64;
    }
    set
}

/// Base cell along slow, middle and fast direction, straight from its definition.
fn cell(
    set: &ParticleSet,
    shape: &GridShape,
    family: Family,
    stencil: usize,
    p: usize,
) -> [i64; 3] {
    let offset = if stencil == 3 && family == Family::Gimp {
        0.5
    } else {
        1.0
    };
    let mut cell = [0; 3];
    for axis in 0..shape.axes {
        let xi = set.columns[Layout::POSITION + axis][p] / shape.cell[axis];
        cell[shape.direction(axis)] = (xi - offset).floor() as i64;
    }
    cell
}

fn dimension() -> impl Strategy<Value = Dimension> {
    prop_oneof![Just(Dimension::Two), Just(Dimension::Three)]
}

proptest! {
    /// The order is that of the cells, and within a cell the one before; layers and rows are those of the particles. It is
    /// the same for any number of threads and lanes, also in a second sort, which shares cells out by what the first found.
    #[test]
    fn particles_are_in_order_of_their_cells(
        dimension in dimension(),
        // Many particles in few cells are counted, few in many compared.
        edge in prop_oneof![Just(4_usize), Just(40)],
        (family, stencil) in prop_oneof![Just((Family::Gimp, 3_usize)), Just((Family::Gimp, 4)), Just((Family::Hat, 3))],
        counts in [0_usize..120, 0..90],
        draws in prop::collection::vec(prop::array::uniform3(0.0..1.0_f64), 210),
        moves in prop::collection::vec(prop::array::uniform3(-0.02..0.02_f64), 210),
    ) {
        let shape = shape(dimension, [edge, edge + 3, if dimension == Dimension::Two { 1 } else { edge + 1 }]);
        let split = [&draws[..counts[0]], &draws[120..120 + counts[1]]];
        let given = [set(&shape, split[0], 0), set(&shape, split[1], 1000)];
        let mut first: Option<Vec<ParticleSet>> = None;
        for (threads, lanes) in [(1, LaneChoice::Scalar), (1, LaneChoice::Auto), (2, LaneChoice::Auto), (3, LaneChoice::Auto)] {
            let team = Team::new(threads).expect("threads");
            let lanes = SelectedLanes::new(lanes).expect("lanes");
            let mut sorter = Sorter::default();
            let mut sets = given.to_vec();
            for remap in [false, true] {
                if remap {
                    for set in &mut sets {
                        for p in 0..set.len() {
                            for axis in 0..shape.axes {
                                let width = shape.cells[axis] as f64 * shape.cell[axis];
                                let x = &mut set.columns[Layout::POSITION + axis][p];
                                *x = (*x + moves[set.id[p] as usize % 210][axis] * width).clamp(0.0, width);
                            }
                        }
                    }
                }
                let before = sets.clone();
                let mut rows = ActiveRows::default();
                sorter.sort(&mut sets, &shape, (family, stencil), lanes, &team, &mut rows);
                for (set, before) in sets.iter().zip(&before) {
                    let mut order: Vec<usize> = (0..before.len()).collect();
                    order.sort_by_key(|&p| cell(before, &shape, family, stencil, p));
                    let ids: Vec<u64> = order.iter().map(|&p| before.id[p]).collect();
                    prop_assert_eq!(&set.id, &ids);
                    for (column, before) in set.columns.iter().zip(&before.columns) {
                        let moved: Vec<f64> = order.iter().map(|&p| before[p]).collect();
                        prop_assert_eq!(column, &moved);
                    }
                    prop_assert_eq!(set.layers.len(), shape.bases()[0] + 1);
                    for layer in 0..shape.bases()[0] {
                        for p in set.in_layers(layer..layer + 1) {
                            prop_assert_eq!(cell(set, &shape, family, stencil, p)[0], layer as i64 - 1);
                        }
                    }
                    prop_assert_eq!(set.in_layers(0..shape.bases()[0]), 0..set.len());
                }
                if family == Family::Hat {
                    // More rows than those of the nodes that have weight, which `rows_of` gives.
                    for set in &sets {
                        for p in 0..set.len() {
                            let first = cell(set, &shape, family, stencil, p).map(|base| (base + 1) as usize);
                            let last = first.map(|first| first + stencil - 1);
                            let middle = if shape.axes == 2 { 0 } else { last[1] };
                            let span = rows.span(last[0], middle);
                            prop_assert!(span.contains(&first[2]) && span.contains(&last[2]));
                        }
                    }
                    continue;
                }
                let mut expected = ActiveRows::default();
                rows_of(&sets, &shape, stencil, &mut expected);
                for plane in 0..shape.nodes[0] {
                    for row in 0..shape.nodes[1] {
                        prop_assert_eq!(rows.span(plane, row), expected.span(plane, row));
                    }
                }
            }
            match &first {
                None => first = Some(sets),
                Some(first) => prop_assert_eq!(first, &sets),
            }
        }
    }
}

/// A body many times longer than what a sort holds of a column at once: particles come to the places that a plain stable sort gives
/// them, where they hardly move, and where one layer comes from the other end.
#[test]
fn a_long_body_is_sorted_as_a_short_one() {
    const LAYERS: usize = 150;
    const IN_LAYER: usize = 120;
    let shape = shape(Dimension::Three, [LAYERS + 2, 6, 5]);
    let reach = (Family::Gimp, 3);
    // Two slices of twelve by five particles in each layer of cells, one after the other, as shapes are filled.
    let places: Vec<[f64; 3]> = (0..LAYERS * IN_LAYER)
        .map(|p| {
            let (slow, across) = (p / (IN_LAYER / 2), p % (IN_LAYER / 2));
            let share = |i: usize, of: usize| (i as f64 + 0.5) / of as f64;
            [
                (0.5 + 0.5 * slow as f64 + 0.25) / (LAYERS + 2) as f64,
                share(across / 5, 12),
                share(across % 5, 5),
            ]
        })
        .collect();
    for threads in [1, 2, 3] {
        let team = Team::new(threads).expect("threads");
        let lanes = SelectedLanes::new(LaneChoice::Auto).expect("lanes");
        let mut sorter = Sorter::default();
        let mut sets = [set(&shape, &places, 7)];
        for round in 0..3 {
            let [given] = &mut sets;
            let far = given.len() - IN_LAYER;
            let x = &mut given.columns[Layout::POSITION];
            for (p, x) in x.iter_mut().enumerate() {
                // By less than a cell, each by its own share of it.
                *x += CELL[0] * 0.2 * (p as f64).sin();
                // And in the end a layer by all of the body.
                if round == 2 && p >= far {
                    *x -= (LAYERS - 1) as f64 * CELL[0];
                }
            }
            let before = given.clone();
            sorter.sort(
                &mut sets,
                &shape,
                reach,
                lanes,
                &team,
                &mut ActiveRows::default(),
            );
            let mut order: Vec<usize> = (0..before.len()).collect();
            order.sort_by_key(|&p| cell(&before, &shape, reach.0, reach.1, p));
            let ids: Vec<u64> = order.iter().map(|&p| before.id[p]).collect();
            assert_eq!(sets[0].id, ids, "{threads} threads, round {round}");
            for (column, before) in sets[0].columns.iter().zip(&before.columns) {
                let moved: Vec<f64> = order.iter().map(|&p| before[p]).collect();
                assert_eq!(column, &moved, "{threads} threads, round {round}");
            }
        }
    }
}
