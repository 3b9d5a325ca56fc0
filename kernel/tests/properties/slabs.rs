//! The division of planes and particles among threads.

use crate::common::{DIMENSIONS, body, cuboid, empty, options, run};
use proctor_kernel::team::Team;
use proctor_scene::Dimension;
use proctor_scene::prelude::*;
use std::ops::Range;
use std::sync::{Arc, Mutex};

/// Record of a visit: the slabs, and their particles.
type SlabLog = Arc<Mutex<Vec<Range<usize>>>>;

/// Interaction that only looks at the slabs.
#[derive(Clone)]
struct Looks(SlabLog);

impl Interaction for Looks {
    fn owners(&self) -> BodyList {
        BodyList::new()
    }

    fn on_slabs<'a>(
        &'a mut self,
        grid: &Grid,
        _: VelocityMapping,
        give: &mut dyn FnMut(SlabPart<'a>),
    ) {
        self.0.lock().expect("no panic").clone_from(&grid.slabs);
        for _ in &grid.slabs {
            give(SlabPart::own(NoCorrection));
        }
    }
}

struct NoCorrection;

impl SlabInteraction for NoCorrection {
    fn correct(&mut self, _: &mut Slab<'_>, _: &StepContext<'_>, _: &mut ExactStepSums) {}
}

/// The slabs of a block of so many cells per axis, its particles two per cell and axis, and how many particles begin in each.
fn slabs(
    dimension: Dimension,
    cells: usize,
    threads: usize,
    least_share: Option<usize>,
) -> Vec<(Range<usize>, usize)> {
    let mut scene = empty(dimension, [cells + 6; 3], 0.1);
    let (from, to) = (0.3, 0.3 + 0.1 * cells as f64);
    scene.bodies = vec![body(1, cuboid([from; 3], [to; 3]))];
    let seen = SlabLog::default();
    let all = Options {
        threads: Some(threads),
        least_share,
        interactions: vec![Box::new(Looks(Arc::clone(&seen)))],
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &all).expect("a sound scene");
    run(&mut simulation, 1);
    let slabs = seen.lock().expect("no panic").clone();
    let particles = |slab: &Range<usize>| simulation.sets()[0].in_layers(slab.clone()).len();
    slabs
        .iter()
        .map(|slab| (slab.clone(), particles(slab)))
        .collect()
}

#[test]
fn slabs_are_all_planes_one_after_the_other() {
    for dimension in DIMENSIONS {
        for cells in [1, 4, 9, 15] {
            for threads in [1, 2, 3, 5] {
                let slabs = slabs(dimension, cells, threads, Some(1));
                // A ghost below, and above the last node two.
                let planes = cells + 6 + 4;
                assert_eq!(slabs[0].0.start, 0);
                assert_eq!(slabs.last().map(|(slab, _)| slab.end), Some(planes));
                assert!(slabs.windows(2).all(|two| two[0].0.end == two[1].0.start));
                assert!(slabs.len() <= threads, "{slabs:?}");
                // Ghosts, the plane of the wall and that of their images are in one slab.
                let ends = [&slabs[0].0, &slabs[slabs.len() - 1].0];
                assert!(ends.iter().all(|slab| slab.len() >= 5), "{slabs:?}");
            }
        }
    }
}

#[test]
fn work_is_shared_evenly() {
    for (dimension, cells) in [(Dimension::Two, 60), (Dimension::Three, 20)] {
        for threads in [2, 3, 4] {
            let slabs = slabs(dimension, cells, threads, None);
            assert_eq!(slabs.len(), threads, "{slabs:?}");
            let particles: usize = slabs.iter().map(|(_, particles)| particles).sum();
            let most = slabs.iter().map(|(_, particles)| *particles).max();
            // One layer more than their share: planes are not cut.
            let layer = particles / cells;
            let share = particles.div_ceil(threads);
            assert!(most.is_some_and(|most| most <= share + layer), "{slabs:?}");
        }
    }
}

#[test]
fn few_particles_have_one_thread() {
    assert_eq!(slabs(Dimension::Two, 15, 4, None).len(), 1);
    assert_eq!(slabs(Dimension::Two, 15, 4, Some(1)).len(), 4);
}

#[test]
fn a_simulation_takes_the_threads_of_another() {
    let mut scene = empty(Dimension::Two, [16; 3], 0.1);
    scene.bodies = vec![body(1, cuboid([0.3; 3], [1.2; 3]))];
    let new = |team: Option<Arc<Team>>, threads: usize| {
        let all = Options {
            threads: Some(threads),
            least_share: Some(1),
            team,
            ..options()
        };
        let mut simulation = Simulation::new(&scene, &all).expect("a sound scene");
        run(&mut simulation, 3);
        simulation
    };
    let first = new(None, 3);
    let second = new(Some(first.team()), 1);
    assert!(Arc::ptr_eq(&first.team(), &second.team()));
    assert_eq!(second.threads(), 3);
    let hash = first.state_hash();
    // Threads live as long as a simulation that has them.
    drop(first);
    assert_eq!(new(Some(second.team()), 1).state_hash(), hash);
}
