//! Scenes on one process and on ranks that are threads, with what both find.

use super::threads::{self, Meddle};
use crate::common::{NEVER, body, cuboid, elastic, empty, material, options, rough_drift};
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::{Energy, MassCenter, ResultQuality, SavedState, StepError};
use proctor_laws::NeoHookean;
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{Dimension, PlaneCondition, Scene};
use std::sync::Arc;

/// A simulation at its end, and its measures.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct End {
    pub(super) state: SavedState,
    pub(super) energy: Energy,
    pub(super) hash: u64,
    pub(super) nodes: usize,
    /// Bits of force and gap of contact at the nodes where a force acts.
    pub(super) touching: Vec<[u64; 4]>,
    pub(super) sorts: usize,
    pub(super) error: Option<StepError>,
}

/// Measures of a simulation that ranks share, which each of them has.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measures {
    pub(super) energy: Energy,
    pub(super) quality: ResultQuality,
    /// Its bits.
    pub(super) unbalanced: Option<u64>,
    pub(super) hash: u64,
    pub(super) nodes: usize,
    pub(super) centers: Vec<MassCenter>,
}

/// Measures without the whole simulation: ranks take them together.
pub(super) fn measures(simulation: &mut Simulation, error: Option<&StepError>) -> Measures {
    let energy = simulation.energy();
    Measures {
        quality: simulation.result_quality(&energy),
        energy,
        // Particles that left the mesh cannot be mapped.
        unbalanced: (error.is_none())
            .then(|| simulation.unbalanced_share())
            .flatten()
            .map(f64::to_bits),
        hash: simulation.state_hash(),
        nodes: simulation.nodes_with_mass(),
        centers: (0..simulation.sets().len())
            .map(|body| simulation.center(body))
            .collect(),
    }
}

/// A long strip of two bodies that flies and breathes through many cells.
pub(super) fn strip(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [60, 7, 6], 0.1);
    scene.bodies = vec![
        body(1, cuboid([0.3, 0.21, 0.2], [2.03, 0.41, 0.4])),
        body(2, cuboid([2.03, 0.21, 0.2], [3.9, 0.41, 0.4])),
    ];
    scene.materials = vec![
        material(elastic(1.0e3, 0.3)),
        material(NeoHookean::new(1.0e3, 0.3)),
    ];
    scene.bodies[1].material = 1;
    scene.bodies[1].particles_per_cell = [2, 1, 1];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity = [3.0, -10.0, 0.0];
    scene
}

/// A plate of two bodies in space with few planes and many rows, along which it flies and breathes.
pub(super) fn plate() -> Scene {
    let mut scene = empty(Dimension::Three, [7, 22, 6], 0.1);
    scene.bodies = vec![
        body(1, cuboid([0.1, 0.3, 0.2], [0.6, 1.03, 0.4])),
        body(2, cuboid([0.1, 1.03, 0.2], [0.6, 1.9, 0.4])),
    ];
    scene.materials = vec![
        material(elastic(1.0e3, 0.3)),
        material(NeoHookean::new(1.0e3, 0.3)),
    ];
    scene.bodies[1].material = 1;
    scene.bodies[1].particles_per_cell = [1, 2, 1];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity = [-10.0, 3.0, 0.0];
    scene
}

/// Velocities and stresses that are rough, and a drift along the longest axis.
pub(super) fn drifting(scene: &Scene, drift: f64) -> InitialField {
    let along = if scene.mesh.cells[0] > scene.mesh.cells[1] {
        [drift, 1.0, 0.0]
    } else {
        [1.0, drift, 0.0]
    };
    rough_drift(scene.dimension, along, 0.1, 1.0, 3)
}

pub(super) fn start(scene: &Scene, threads: usize, initial: &InitialField) -> Simulation {
    start_on(None, scene, threads, initial)
}

/// The same; where ranks are given, each fills its part.
pub(super) fn start_on(
    ranks: Option<Arc<dyn Ranks>>,
    scene: &Scene,
    threads: usize,
    initial: &InitialField,
) -> Simulation {
    let options = Options {
        threads: Some(threads),
        ranks,
        least_share: Some(1),
        initial: Some(Arc::clone(initial)),
        ..options()
    };
    Simulation::new(scene, &options).expect("the scene is sound")
}

/// Steps, up to an error; the number of sorts.
pub(super) fn step(simulation: &mut Simulation, steps: usize) -> (usize, Option<StepError>) {
    let mut sorts = 0;
    for _ in 0..steps {
        let before = simulation.view().travel;
        if let Err(error) = simulation.step(NEVER) {
            return (sorts, Some(error));
        }
        sorts += usize::from(simulation.view().travel < before);
    }
    (sorts, None)
}

pub(super) fn end(simulation: &mut Simulation, (sorts, error): (usize, Option<StepError>)) -> End {
    let energy = simulation.energy();
    simulation.note_extremes();
    End {
        state: simulation.save(),
        energy,
        hash: simulation.state_hash(),
        nodes: simulation.nodes_with_mass(),
        touching: touching(simulation),
        sorts,
        error,
    }
}

pub(super) fn touching(simulation: &Simulation) -> Vec<[u64; 4]> {
    let nodes = simulation.node_values().into_iter();
    let touched = nodes.filter(|node| node.contact_force != [0.0; 3]);
    let numbers = touched.map(|node| {
        let [x, y, z] = node.contact_force;
        [x, y, z, node.contact_gap].map(f64::to_bits)
    });
    numbers.collect()
}

/// The end of a scene on one process.
pub(super) fn alone(scene: &Scene, steps: usize, initial: &InitialField) -> (End, Measures) {
    let mut simulation = start(scene, 1, initial);
    let stepped = step(&mut simulation, steps);
    let measures = measures(&mut simulation, stepped.1.as_ref());
    (end(&mut simulation, stepped), measures)
}

/// Measures and error of a rank, and what acts at its own nodes.
pub(super) type OfRank = (Measures, Option<StepError>, Vec<[u64; 4]>);

/// The end of a scene on some ranks as the first one has it, and the error of each rank.
pub(super) fn shared(
    scene: &Scene,
    (count, threads): (usize, usize),
    steps: usize,
    initial: &InitialField,
    meddle: Option<Meddle>,
) -> (End, Vec<OfRank>) {
    let ranks = threads::ranks(count, meddle);
    let ends: Vec<(Option<End>, OfRank)> = std::thread::scope(|scope| {
        let run = |rank| {
            move || {
                let rank: Arc<dyn Ranks> = Arc::new(rank);
                let mut simulation = if FILL_PARTS.contains(&(count, threads)) {
                    start_on(Some(rank), scene, threads, initial)
                } else {
                    let mut simulation = start(scene, threads, initial);
                    let shared = simulation.share_among(rank);
                    shared.expect("the scene can be shared");
                    simulation
                };
                assert!(count == 1 || simulation.sets()[0].len() < simulation.particles());
                // The whole in the middle changes nothing.
                let (sorts, error) = step(&mut simulation, steps / 2);
                let _ = measures(&mut simulation, error.as_ref());
                if let Some(part) = simulation.gather() {
                    let _ = simulation.energy();
                    simulation.put_back(part);
                }
                let (more, error) = match error {
                    Some(error) => (0, Some(error)),
                    None => step(&mut simulation, steps - steps / 2),
                };
                let measured = measures(&mut simulation, error.as_ref());
                let here = (measured, error.clone(), touching(&simulation));
                let whole = simulation.gather();
                let end = whole.map(|_| end(&mut simulation, (sorts + more, error)));
                (end, here)
            }
        };
        let ranks: Vec<_> = ranks
            .into_iter()
            .map(|rank| scope.spawn(run(rank)))
            .collect();
        let joined = ranks.into_iter().map(std::thread::ScopedJoinHandle::join);
        joined.map(|end| end.expect("no rank panics")).collect()
    });
    let here = ends.iter().map(|(_, here)| here.clone()).collect();
    let first = ends.into_iter().find_map(|(end, _)| end);
    (first.expect("the first rank has the whole"), here)
}

/// Ranks and threads of each.
pub(super) const TEAMS: [(usize, usize); 6] = [(1, 2), (2, 1), (2, 2), (3, 1), (4, 1), (4, 2)];

/// Those of which each rank fills its part; of the others each fills the whole and keeps its part.
pub(super) const FILL_PARTS: [(usize, usize); 4] = [(2, 2), (3, 1), (4, 2), (6, 1)];

/// Compares one process with ranks; the end.
pub(super) fn compare(scene: &Scene, steps: usize, drift: f64) -> End {
    compare_from(scene, steps, &drifting(scene, drift))
}

/// The same from another start.
pub(super) fn compare_from(scene: &Scene, steps: usize, initial: &InitialField) -> End {
    compare_teams(scene, steps, initial, &TEAMS)
}

/// The same on some teams.
pub(super) fn compare_teams(
    scene: &Scene,
    steps: usize,
    initial: &InitialField,
    teams: &[(usize, usize)],
) -> End {
    let (expected, expected_measures) = alone(scene, steps, initial);
    for &team in teams {
        let (found, of_ranks) = shared(scene, team, steps, initial, None);
        assert_eq!(found.error, expected.error, "{team:?}");
        let mut touched: Vec<[u64; 4]> = vec![];
        for (measures, error, touching) in &of_ranks {
            touched.extend(touching);
            assert_eq!(*error, expected.error, "{team:?}");
            assert_eq!(*measures, expected_measures, "{team:?} {scene:?}");
        }
        let mut expected_touched = expected.touching.clone();
        touched.sort_unstable();
        expected_touched.sort_unstable();
        assert_eq!(touched, expected_touched, "{team:?}");
        assert_eq!(found.hash, expected.hash, "{team:?} {scene:?}");
        assert_eq!(found.energy, expected.energy, "{team:?}");
        assert_eq!(found.nodes, expected.nodes, "{team:?}");
        assert_eq!(found.touching, expected.touching, "{team:?}");
        assert!(found == expected, "{team:?} {scene:?}");
    }
    expected
}
