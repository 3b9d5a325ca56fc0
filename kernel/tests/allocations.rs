//! Allocations of a step of a warm run.

#[path = "common/mod.rs"]
mod common;

use common::{
    DIMENSIONS, SCHEMES, TRANSFERS, WEIGHTINGS, body, calm, cuboid, empty, options, run, simulation,
};
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Dimension, Scene, StandingWater, StressScheme, TimeStep};

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

/// Requests of some steps after the first, which sort and fill what is kept from step to step; `threads` share them in as many
/// slabs as planes allow.
fn requests(scene: &Scene, steps: usize, threads: usize) -> u64 {
    let several = Options {
        threads: Some(threads),
        least_share: (threads > 1).then_some(1),
        ..options()
    };
    let mut simulation = Simulation::new(scene, &several).expect("a sound scene");
    run(&mut simulation, 300);
    let before = place(&simulation);
    // A step that is not led within hands itself over by a list of the threads.
    let team = simulation.team();
    let info = team.lead(|| allocation_counter::measure(|| run(&mut simulation, steps)));
    let crossed = place(&simulation) - before;
    assert!(crossed > 1.0, "{crossed} cells, so that nothing was sorted");
    info.count_total
}

/// A warm step takes nothing from the allocator, nor does a sort or a look at the balances, on the thread that leads it. Of the
/// threads that help it each does what the first does.
#[test]
fn no_step_takes_memory() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            for threads in [1, 2] {
                let count = requests(&flight(dimension, scheme, 12), 100, threads);
                assert_eq!(count, 0, "{dimension:?} {scheme:?}, {threads} threads");
            }
        }
    }
}

/// Nor where water stands beside the body.
#[test]
fn no_step_under_water_takes_memory() {
    for dimension in DIMENSIONS {
        for threads in [1, 2] {
            let mut scene = flight(dimension, StressScheme::Usl, 12);
            // As heavy as the water, so that it flies on.
            let density = scene.materials[0].density;
            scene.gravity[dimension.axes() - 1] = -0.1;
            scene.standing_waters = vec![StandingWater {
                level: [3.0, 0.0, 0.0].into(),
                density,
                bodies: vec![],
                shore: None,
            }];
            let count = requests(&scene, 100, threads);
            assert_eq!(count, 0, "{dimension:?}, {threads} threads");
        }
    }
}

/// Nor with other functions and transfers.
#[test]
fn no_step_takes_memory_whatever_the_method() {
    for weighting in WEIGHTINGS {
        for transfer in TRANSFERS {
            let mut scene = flight(Dimension::Two, StressScheme::Musl, 6);
            (scene.weighting, scene.transfer) = (weighting, transfer);
            calm(&mut scene);
            let mut simulation = simulation(&scene);
            run(&mut simulation, 100);
            let info = allocation_counter::measure(|| run(&mut simulation, 100));
            assert_eq!(info.count_total, 0, "{weighting:?} {transfer:?}");
        }
    }
}

/// A look at the energy balance has the memory of a sort for its copy of the nodes and gives it back: steps after it take none.
#[test]
fn energy_has_the_memory_of_a_sort() {
    let mut simulation = simulation(&flight(Dimension::Three, StressScheme::Usl, 12));
    run(&mut simulation, 300);
    let lists = 2 * size_of::<u32>() * simulation.sets()[0].len();
    let info = allocation_counter::measure(|| {
        assert!(simulation.energy().kinetic > 0.0);
    });
    assert_eq!(info.bytes_current, 0);
    // Freed before the copy is made, taken again after it.
    let (most, all) = (info.bytes_max, info.bytes_total);
    assert!(
        most + 2 * lists as u64 <= all,
        "{most} B at once, {all} in all, {lists} for a sort"
    );
    let info = allocation_counter::measure(|| run(&mut simulation, 100));
    assert_eq!(info.count_total, 0);
}
