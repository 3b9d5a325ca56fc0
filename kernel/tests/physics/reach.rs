//! Bodies that may meet before the next sort: the broad phase of contact on the grid.

use proctor_contact::pairs::Pair;
use proctor_contact::pairs::broad::{BodyReach, near};
use proctor_kernel::grid::{ActiveRows, GridShape};
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::Sorter;
use proctor_kernel::team::Team;
use proctor_kernel::weights::{Family, base_node};
use proctor_scene::{ContactNormal, Dimension, Mesh, PlaneCondition};
use proptest::prelude::*;

const CELLS: usize = 12;
const CELL: f64 = 0.25;

fn shape() -> GridShape {
    let mesh = Mesh {
        axisymmetric: false,
        cells: [CELLS; 3],
        cell: [CELL; 3],
        origin: [0.0; 3],
        planes: [[PlaneCondition::Free; 2]; 3],
    };
    GridShape::new(&mesh, Dimension::Three)
}

/// A body of one particle, sorted where it is, in cells.
fn body(at: [f64; 3], shape: &GridShape, stencil: usize) -> ParticleSet {
    let mut set = ParticleSet::zeros(Layout::new(3, Optional::default(), &[]), 0, 1);
    for (axis, x) in at.iter().enumerate() {
        set.columns[Layout::POSITION + axis][0] = x * CELL;
    }
    Sorter::default().sort(
        std::slice::from_mut(&mut set),
        shape,
        (Family::Gimp, stencil),
        SelectedLanes::any(),
        &Team::ALONE,
        &mut ActiveRows::default(),
    );
    set
}

fn inside(x: f64) -> f64 {
    x.clamp(0.0, CELLS as f64)
}

proptest! {
    /// All nodes of a particle that moved by less than a cell since the sort lie within what its body was said to reach.
    #[test]
    fn a_body_stays_within_its_reach_until_the_next_sort(
        at in prop::array::uniform3(0.0..CELLS as f64),
        way in prop::array::uniform3(-0.99_f64..0.99),
        stencil in 3_usize..=4,
    ) {
        let shape = shape();
        let sets = [body(at, &shape, stencil)];
        let mut reach = BodyReach::of_sets(&sets, &shape, stencil);
        for axis in 0..3 {
            let (first, last) = reach.of(0, axis);
            let base = base_node(inside(at[axis] + way[axis]), stencil);
            prop_assert!(first <= base, "axis {axis}: from {first}, moved to {base}");
            let end = base + stencil as f64 - 1.0;
            prop_assert!(end <= last, "axis {axis}: to {last}, moved to {end}");
        }
    }

    /// Bodies that share a node once each has moved by less than a cell were near at the sort; two whose nodes stay apart
    /// by two cells whatever they do were not.
    #[test]
    fn bodies_that_meet_before_the_next_sort_were_near(
        at in prop::array::uniform3(1.0..CELLS as f64 - 1.0),
        apart in prop::array::uniform3(-7.0_f64..7.0),
        ways in prop::array::uniform2(prop::array::uniform3(-0.99_f64..0.99)),
        stencil in 3_usize..=4,
    ) {
        let shape = shape();
        let places = [at, std::array::from_fn(|axis| inside(at[axis] + apart[axis]))];
        let sets = places.map(|place| body(place, &shape, stencil));
        let pair = Pair {
            by_shape: false,
            bonded: false,
            id: 1,
            master: 0,
            slave: 1,
            friction: 0.0,
            normal: ContactNormal::Collinear,
            distance: [CELL; 3],
            corrects_distance: true,
        };
        let mut found = vec![];
        near(&[pair], &mut BodyReach::of_sets(&sets, &shape, stencil), &mut found);
        let said = found[0];
        // Distance of the base nodes along each axis: they share nodes where it is less than the stencil everywhere.
        let between = |ways: [[f64; 3]; 2]| -> [f64; 3] {
            std::array::from_fn(|axis| {
                let [a, b] = [0, 1].map(|i| base_node(inside(places[i][axis] + ways[i][axis]), stencil));
                (a - b).abs()
            })
        };
        let meet = between(ways).iter().all(|distance| *distance < stencil as f64);
        prop_assert!(said || !meet);
        let far = between([[0.0; 3]; 2]).iter().any(|distance| *distance > stencil as f64 + 3.0);
        prop_assert!(!(said && far));
    }
}
