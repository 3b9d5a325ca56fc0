//! Bodies on grids that are much larger than they are: memory, admission and bits.

use super::contact::pair;
use crate::common::{
    APIC, FLIP, SCHEMES, body, cuboid, elastic, empty, material, options, run, run_towards,
    simulation,
};
use proctor_kernel::layout::Layout;
use proctor_kernel::memory::Memory;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Dimension, Scene};

/// Edge of a cell \[m\].
const H: f64 = 0.05;
/// Cells of a grid whose nodes take 77 MiB, and of one of 0.9 MiB in which the bodies find the same nodes.
const LARGE: [usize; 3] = [2000, 600, 1];
const SMALL: [usize; 3] = [420, 30, 1];

/// Two blocks of 8 cells, in contact: the first, thrown at the second, pushes it along.
fn thrown(cells: [usize; 3]) -> Scene {
    let mut scene = empty(Dimension::Two, cells, H);
    scene.materials = vec![material(elastic(1.0e5, 0.3))];
    scene.bodies = vec![
        body(1, cuboid([0.5, 0.5, 0.0], [0.9, 0.9, 0.0])),
        body(2, cuboid([0.9, 0.5, 0.0], [1.3, 0.9, 0.0])),
    ];
    scene.contacts = vec![pair(3, 1, 2, 0.2)];
    scene.bodies[0].velocity = [25.0, 0.1, 0.0];
    scene.bodies[1].velocity = [24.0, 0.0, 0.0];
    scene
}

/// Mean place of the second body along its way \[m\].
fn place(simulation: &Simulation) -> f64 {
    let x = &simulation.sets()[1].columns[Layout::POSITION];
    x.iter().sum::<f64>() / x.len() as f64
}

/// On the large grid the memory of the nodes behind the bodies goes back to the system on the way.
#[test]
fn a_body_that_crosses_a_large_grid_moves_as_on_a_small_one() {
    for scheme in SCHEMES {
        for transfer in [FLIP, APIC] {
            let [large, small] = [LARGE, SMALL].map(|cells| {
                let mut scene = thrown(cells);
                (scene.scheme, scene.transfer) = (scheme, transfer);
                let mut simulation = simulation(&scene);
                while simulation.time() < 0.7 {
                    run_towards(&mut simulation, 1, 0.7);
                }
                simulation
            });
            // Both bodies reach 23 rows of 15 nodes; twice as many and 4096, the most that stays touched, are 320 rows.
            assert!(place(&large) > 350.0 * H, "{}", place(&large));
            assert_eq!(
                large.state_hash(),
                small.state_hash(),
                "{scheme:?} {transfer:?}"
            );
        }
    }
}

/// A mesh of 2000 m x 1500 m x 500 m in cells of 2 m, whose nodes would take 11.2 GiB.
#[test]
fn a_grid_is_admitted_by_the_nodes_that_bodies_reach() {
    let mut scene = empty(Dimension::Three, [1000, 750, 250], 2.0);
    scene.bodies = vec![body(1, cuboid([900.0, 700.0, 0.0], [940.0, 740.0, 20.0]))];
    let with = |bytes| Options {
        memory: Some(Memory::of(bytes)),
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &with(1 << 30)).expect("1 GiB is enough");
    run(&mut simulation, 3);
    let refused = Simulation::new(&scene, &with(16 << 20)).err();
    let text = refused.expect("16 MiB are not").to_string();
    assert!(text.contains("of which bodies reach"), "{text}");
    // A body that fills the mesh reaches all of it.
    scene.bodies = vec![body(1, cuboid([0.0; 3], [2000.0, 1500.0, 500.0]))];
    assert!(Simulation::new(&scene, &with(1 << 30)).is_err());
}
