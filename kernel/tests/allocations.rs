//! What a step asks of the allocator once a run is warm.

#[path = "common/mod.rs"]
mod common;

use common::{DIMENSIONS, SCHEMES, body, cuboid, empty, run, simulation};
use proctor_kernel::layout::Layout;
use proctor_kernel::scene::{Dimension, Scene, StressScheme, TimeStep};
use proctor_kernel::simulation::Simulation;

/// A block that flies across cells, so that it is sorted again and again. Its length along y (2D) or z (3D), the axes along
/// which nodes follow each other in memory, is given: the planes and rows that it reaches are the same whatever it is.
fn flight(dimension: Dimension, scheme: StressScheme, cells: usize) -> Scene {
    let h = 0.1;
    let length = cells as f64 * h;
    let mut scene = match dimension {
        Dimension::Two => empty(dimension, [30, cells + 4, 1], h),
        Dimension::Three => empty(dimension, [30, 8, cells + 4], h),
    };
    let start = 0.21;
    let far = start + length;
    let corners = match dimension {
        Dimension::Two => cuboid([start, start, 0.0], [0.61, far, 1.0]),
        Dimension::Three => cuboid([start, start, start], [0.61, 0.52, far]),
    };
    scene.scheme = scheme;
    scene.bodies = vec![body(1, corners)];
    scene.bodies[0].velocity = [4.0, 0.0, 0.0];
    scene.time_step = TimeStep::Fixed {
        dt: 5.0e-4,
        allow_unstable: false,
    };
    scene
}

/// Mean place of the particles along x, in cells.
fn place(simulation: &Simulation) -> f64 {
    let x = &simulation.sets()[0].columns[Layout::POSITION];
    x.iter().sum::<f64>() / x.len() as f64 / simulation.scene().mesh.cell[0]
}

/// Requests and bytes of some steps after the first, which sort and fill what is kept from step to step.
fn of_steps(scene: &Scene, steps: usize) -> (u64, u64) {
    let mut simulation = simulation(scene);
    run(&mut simulation, 300);
    let before = place(&simulation);
    let info = allocation_counter::measure(|| run(&mut simulation, steps));
    let crossed = place(&simulation) - before;
    assert!(crossed > 1.0, "{crossed} cells, so that nothing was sorted");
    assert_eq!(info.count_current, 0, "what a step takes it gives back");
    (info.count_total, info.bytes_total)
}

/// A step takes a few short lists, one for each slab and field, and a sort one for the rows of nodes in use. Nothing is as
/// long as the particles or the nodes: with three times as many of both it takes not a byte more.
#[test]
fn no_step_takes_more_memory_for_more_particles() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let steps = 100;
            let few = of_steps(&flight(dimension, scheme, 6), steps);
            let many = of_steps(&flight(dimension, scheme, 18), steps);
            assert_eq!(few, many, "{dimension:?} {scheme:?}");
            assert!(
                few.0 <= 32 * steps as u64,
                "{dimension:?} {scheme:?}: {few:?}"
            );
        }
    }
}
