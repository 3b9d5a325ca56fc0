//! Ranks that share a simulation: state, sums, events and errors are those of one process, bit by bit.

mod contact;
mod surfaces;
mod threads;
mod water;

use crate::common::{
    APIC, DIMENSIONS, FLIP, MLS, NEVER, SCHEMES, body, cuboid, elastic, empty, material, options,
    rough_drift,
};
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::{
    Energy, MassCenter, ResultQuality, SavedState, SharingRefusal, StepError, StepErrorKind,
};
use proctor_laws::{NeoHookean, Newtonian, VonMises};
use proctor_scene::simulation::{InitialField, InitialState, Options, Simulation};
use proctor_scene::{
    BaseMotion, BoxLoad, Damping, Dimension, DomainUpdate, History, Motion, Outside,
    PlaneCondition, Scene, StressScheme, Traction, Weighting,
};
use std::sync::Arc;
use threads::Meddle;

/// A simulation at its end, and its measures.
#[derive(Clone, Debug, PartialEq)]
struct End {
    state: SavedState,
    energy: Energy,
    hash: u64,
    nodes: usize,
    /// Bits of force and gap of contact at the nodes where a force acts.
    touching: Vec<[u64; 4]>,
    sorts: usize,
    error: Option<StepError>,
}

/// Measures of a simulation that ranks share, which each of them has.
#[derive(Clone, Debug, PartialEq)]
struct Measures {
    energy: Energy,
    quality: ResultQuality,
    /// Its bits.
    unbalanced: Option<u64>,
    hash: u64,
    nodes: usize,
    centers: Vec<MassCenter>,
}

/// Measures without the whole simulation: ranks take them together.
fn measures(simulation: &mut Simulation, error: Option<&StepError>) -> Measures {
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
fn strip(dimension: Dimension) -> Scene {
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

/// Velocities and stresses that are rough, and a drift along the strip.
fn drifting(scene: &Scene, drift: f64) -> InitialField {
    rough_drift(scene.dimension, [drift, 1.0, 0.0], 0.1, 1.0, 3)
}

fn start(scene: &Scene, threads: usize, initial: &InitialField) -> Simulation {
    start_on(None, scene, threads, initial)
}

/// The same; where ranks are given, each fills its part.
fn start_on(
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
fn step(simulation: &mut Simulation, steps: usize) -> (usize, Option<StepError>) {
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

fn end(simulation: &mut Simulation, (sorts, error): (usize, Option<StepError>)) -> End {
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

fn touching(simulation: &Simulation) -> Vec<[u64; 4]> {
    let nodes = simulation.node_values().into_iter();
    let touched = nodes.filter(|node| node.contact_force != [0.0; 3]);
    let numbers = touched.map(|node| {
        let [x, y, z] = node.contact_force;
        [x, y, z, node.contact_gap].map(f64::to_bits)
    });
    numbers.collect()
}

/// The end of a scene on one process.
fn alone(scene: &Scene, steps: usize, initial: &InitialField) -> (End, Measures) {
    let mut simulation = start(scene, 1, initial);
    let stepped = step(&mut simulation, steps);
    let measures = measures(&mut simulation, stepped.1.as_ref());
    (end(&mut simulation, stepped), measures)
}

/// Measures and error of a rank.
type OfRank = (Measures, Option<StepError>);

/// The end of a scene on some ranks as the first one has it, and the error of each rank.
fn shared(
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
                let here = (measures(&mut simulation, error.as_ref()), error.clone());
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
const TEAMS: [(usize, usize); 6] = [(1, 2), (2, 1), (2, 2), (3, 1), (4, 1), (4, 2)];

/// Those of which each rank fills its part; of the others each fills the whole and keeps its part.
const FILL_PARTS: [(usize, usize); 3] = [(2, 2), (3, 1), (4, 2)];

/// Compares one process with ranks; the end.
fn compare(scene: &Scene, steps: usize, drift: f64) -> End {
    compare_from(scene, steps, &drifting(scene, drift))
}

/// The same from another start.
fn compare_from(scene: &Scene, steps: usize, initial: &InitialField) -> End {
    let (expected, expected_measures) = alone(scene, steps, initial);
    for team in TEAMS {
        let (found, of_ranks) = shared(scene, team, steps, initial, None);
        assert_eq!(found.error, expected.error, "{team:?}");
        for (measures, error) in &of_ranks {
            assert_eq!(*error, expected.error, "{team:?}");
            assert_eq!(*measures, expected_measures, "{team:?} {scene:?}");
        }
        assert_eq!(found.hash, expected.hash, "{team:?} {scene:?}");
        assert_eq!(found.energy, expected.energy, "{team:?}");
        assert_eq!(found.nodes, expected.nodes, "{team:?}");
        assert_eq!(found.touching, expected.touching, "{team:?}");
        assert!(found == expected, "{team:?} {scene:?}");
    }
    expected
}

#[test]
fn ranks_change_no_bit() {
    let gimp = Weighting::UniformGimp;
    let stretch = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let determinant = Weighting::ContiguousGimp(DomainUpdate::Determinant);
    let spline = Weighting::QuadraticBSpline;
    let methods = [
        (gimp, FLIP),
        (gimp, APIC),
        (stretch, FLIP),
        (determinant, APIC),
        (spline, MLS),
    ];
    let mut index = 0;
    for dimension in DIMENSIONS {
        for (weighting, transfer) in methods {
            for scheme in SCHEMES {
                index += 1;
                let mut scene = strip(dimension);
                (scene.weighting, scene.transfer, scene.scheme) = (weighting, transfer, scheme);
                scene.damping = match index % 4 {
                    0 => Damping::Local { alpha: 0.2 },
                    1 => Damping::Viscous { alpha: 0.1 },
                    2 => Damping::Kinetic,
                    _ => Damping::None,
                };
                if index % 2 == 0 {
                    scene.box_loads = vec![BoxLoad {
                        p1: [0.0; 3],
                        p2: [1.0; 3],
                        force: [0.0, 5.0, 0.0],
                    }];
                }
                let end = compare(&scene, 80, 8.0);
                assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
            }
        }
    }
}

/// One body moves as prescribed, and takes the nodes along that it reaches.
#[test]
fn ranks_drive_a_body_together() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = strip(dimension);
            scene.scheme = scheme;
            scene.bodies[1].motion = Some(History {
                times: vec![0.0, 0.1],
                values: vec![[8.0, 0.0, 0.0], [4.0, 0.5, 0.0]],
            });
            let end = compare(&scene, 60, 8.0);
            assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
        }
    }
}

/// Tractions look at the masses of the nodes around theirs, and bodies leave some of these behind.
#[test]
fn ranks_bear_tractions_together() {
    for dimension in DIMENSIONS {
        let mut scene = strip(dimension);
        let depth = if dimension == Dimension::Three {
            0.4
        } else {
            0.0
        };
        scene.gravity = [0.0; 3];
        scene.tractions = vec![Traction {
            p1: [0.3, 0.4, 0.5 * depth],
            p2: [3.9, 0.4, depth],
            traction: History {
                times: vec![0.0, 0.05],
                values: vec![[0.0, -4.0, 0.0], [1.0, -8.0, 0.0]],
            },
        }];
        let end = compare(&scene, 60, 8.0);
        assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
    }
}

/// A base that moves along its normal takes the mesh along.
#[test]
fn ranks_move_with_the_base() {
    let mut scene = strip(Dimension::Two);
    scene.base_motion = Some(BaseMotion {
        axis: 1,
        side: 0,
        motion: Motion::Velocity(History {
            times: vec![0.0, 0.1],
            values: vec![[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
        }),
    });
    let end = compare(&scene, 80, 8.0);
    assert!(
        end.error.is_none() && end.sorts >= 10,
        "{} sorts",
        end.sorts
    );
}

/// With MUSL, FLIP does not hold tension: each rank stops for the same particle. The growth of a particle goes with it.
#[test]
fn ranks_stop_for_the_same_tension() {
    let mut scene = empty(Dimension::Two, [24, 3, 3], 0.1);
    scene.materials = vec![material(NeoHookean::new(1.0e5, 0.3))];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[0] = [PlaneCondition::Fixed, PlaneCondition::Free];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [1.0, 0.3, 0.0]))];
    scene.scheme = StressScheme::Musl;
    scene.damping = Damping::Viscous { alpha: 0.05 };
    scene.box_loads = vec![BoxLoad {
        p1: [0.9, 0.0, 0.0],
        p2: [1.0, 0.3, 0.3],
        force: [6.0e3, 0.0, 0.0],
    }];
    let rest: InitialField = Arc::new(|_| InitialState::default());
    let end = compare_from(&scene, 4000, &rest);
    let error = end.error.expect("tension tears the bar");
    assert!(matches!(error.kind, StepErrorKind::Tension(_)), "{error}");
}

/// Laws with memory, and one whose viscosity bounds the step.
#[test]
fn ranks_change_no_bit_of_laws_with_memory() {
    for dimension in DIMENSIONS {
        let mut scene = strip(dimension);
        scene.materials = vec![
            material(VonMises::new(1.0e3, 0.3, 5.0, 10.0)),
            material(Newtonian::new(2.0e3, 40.0)),
        ];
        let end = compare(&scene, 80, 8.0);
        assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
    }
}

/// Particles leave through the end of the mesh and are removed, on ranks that own them and as ghosts.
#[test]
fn particles_leave_on_all_ranks() {
    for dimension in DIMENSIONS {
        let mut scene = strip(dimension);
        scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
        scene.outside = Outside::Remove;
        scene.gravity = [0.0, 8.0, 0.0];
        let end = compare(&scene, 300, 20.0);
        assert!(
            end.state.state.events.len() > 20,
            "{}",
            end.state.state.events.len()
        );
    }
}

/// Domains of particles grow beyond half a cell, so that the stencil has four nodes.
#[test]
fn a_wider_stencil_has_wider_ghosts() {
    let mut scene = strip(Dimension::Two);
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    scene.bodies.truncate(1);
    scene.bodies[0].particles_per_cell = [1, 1, 1];
    let end = compare(&scene, 200, 8.0);
    assert_eq!(end.state.state.stencil, 4);
}

/// The error of a particle is the same on every rank.
#[test]
fn ranks_stop_for_the_same_particle() {
    let mut scene = strip(Dimension::Two);
    scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
    let end = compare(&scene, 400, 30.0);
    let error = end.error.expect("the strip leaves the mesh");
    assert!(matches!(error.kind, StepErrorKind::Outside(_)), "{error}");
}

/// The bytes that travel in a step are those that the plan counts.
#[test]
fn a_step_sends_what_the_plan_counts() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = strip(dimension);
            scene.scheme = scheme;
            let initial = drifting(&scene, 0.5);
            let forecast = start(&scene, 1, &initial).forecast_ranks(3);
            let forecast = forecast.expect("the scene can be shared");
            let particles: usize = forecast.iter().map(|share| share.particles).sum();
            assert_eq!(particles, start(&scene, 1, &initial).particles());
            let ranks = threads::ranks(3, None);
            let sent: Vec<usize> = std::thread::scope(|scope| {
                let step = |rank: threads::Thread| {
                    let (scene, initial) = (&scene, &initial);
                    move || {
                        let sent = rank.sent();
                        let mut simulation = start(scene, 1, initial);
                        let shared = simulation.share_among(Arc::new(rank));
                        shared.expect("the scene can be shared");
                        simulation.step(NEVER).expect("a sound step");
                        sent.load(std::sync::atomic::Ordering::Relaxed)
                    }
                };
                let all: Vec<_> = ranks
                    .into_iter()
                    .map(|rank| scope.spawn(step(rank)))
                    .collect();
                let joined = all.into_iter().map(std::thread::ScopedJoinHandle::join);
                joined.map(|sent| sent.expect("no rank panics")).collect()
            });
            let foretold: Vec<usize> = forecast.iter().map(|share| share.sent).collect();
            assert_eq!(sent, foretold, "{scheme:?}");
        }
    }
}

/// Of all cuts the one that is taken leaves the rank with most particles, ghosts among them, the fewest.
#[test]
fn the_fullest_rank_has_as_few_particles_as_can_be() {
    for ppc in [1, 2] {
        let mut scene = strip(Dimension::Two);
        // Domains of a whole cell reach a fourth node.
        scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
        scene.bodies[0].particles_per_cell = [ppc, 1, 1];
        let simulation = start(&scene, 1, &drifting(&scene, 0.0));
        let stencil = simulation.view().stencil;
        let planes = simulation.view().grid.shape.nodes[0];
        let held = |from: usize, to: usize| -> usize {
            let layers = from.saturating_sub(stencil)..(to + 1).min(planes);
            let sets = simulation.sets().iter();
            sets.map(|set| set.in_layers(layers.clone()).len()).sum()
        };
        let mut best = usize::MAX;
        for a in 5..=planes - 10 {
            for b in a + 5..=planes - 5 {
                best = best.min(held(0, a).max(held(a, b)).max(held(b, planes)));
            }
        }
        let forecast = simulation.forecast_ranks(3).expect("it can be shared");
        let found = forecast.iter().map(|rank| rank.particles + rank.ghosts);
        assert_eq!(found.max(), Some(best), "stencil {stencil}");
        assert!(forecast.iter().all(|rank| rank.planes.len() >= 5));
    }
}

/// One number of a ghost that changes on its way is found when ghosts are compared with their owners.
#[test]
fn a_changed_ghost_is_found() {
    let scene = strip(Dimension::Two);
    let meddle: Meddle = |from, to, words| {
        // The last word is the last column of the last particle: a ghost on the rank below.
        if from == 1 && to == 0 && words.len() > 8 {
            *words.last_mut().expect("not empty") ^= 1;
        }
    };
    let (_, of_ranks) = shared(&scene, (2, 1), 300, &drifting(&scene, 2.0), Some(meddle));
    for (_, error) in of_ranks {
        let error = error.expect("ranks disagree");
        assert!(
            matches!(error.kind, StepErrorKind::RanksDisagree { .. }),
            "{error}"
        );
        assert_eq!(error.step, 257, "{error}");
    }
}

#[test]
fn what_is_not_local_is_refused() {
    let refused = |scene: &Scene, count: usize| {
        let rank = threads::ranks(count, None).swap_remove(0);
        let mut simulation = start(scene, 1, &drifting(scene, 1.0));
        simulation
            .share_among(Arc::new(rank))
            .expect_err("not local")
    };
    let part = |scene: &Scene| match refused(scene, 2) {
        SharingRefusal::Part { part } => part,
        other => panic!("{other}"),
    };
    let mut scene = strip(Dimension::Two);
    scene.mesh.planes[0][1] = PlaneCondition::Absorbing;
    assert_eq!(part(&scene), "absorbing planes");
    let scene = strip(Dimension::Two);
    let error = refused(&scene, 13);
    assert_eq!(
        error,
        SharingRefusal::TooMany {
            ranks: 13,
            most: 12
        }
    );
    assert!(error.to_string().contains("at most 12"), "{error}");
}
