//! Ranks that share a simulation: state, sums, events and errors are those of one process, bit by bit.

mod threads;

use crate::common::{
    APIC, DIMENSIONS, FLIP, MLS, NEVER, body, cuboid, elastic, empty, material, options,
    rough_drift,
};
use proctor_kernel::simulation::{Energy, NotShared, SavedState, StepError, StepErrorKind};
use proctor_laws::{NeoHookean, Newtonian, VonMises};
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{
    BoxLoad, Contact, ContactNormal, Damping, Dimension, DomainUpdate, Outside, PlaneCondition,
    Scene, StressScheme, Weighting,
};
use std::sync::Arc;
use threads::Meddle;

/// What is known of a simulation at its end.
#[derive(Clone, Debug, PartialEq)]
struct End {
    state: SavedState,
    energy: Energy,
    hash: u64,
    nodes: usize,
    sorts: usize,
    error: Option<StepError>,
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

fn start(scene: &Scene, threads: usize, drift: f64) -> Simulation {
    let initial: InitialField = rough_drift(scene.dimension, [drift, 1.0, 0.0], 0.1, 1.0, 3);
    let options = Options {
        threads: Some(threads),
        least_share: Some(1),
        initial: Some(initial),
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
        sorts,
        error,
    }
}

/// The end of a scene on one process.
fn alone(scene: &Scene, steps: usize, drift: f64) -> End {
    let mut simulation = start(scene, 1, drift);
    let stepped = step(&mut simulation, steps);
    end(&mut simulation, stepped)
}

/// The end of a scene on some ranks as the first one has it, and the error of each rank.
fn shared(
    scene: &Scene,
    (count, threads): (usize, usize),
    steps: usize,
    drift: f64,
    meddle: Option<Meddle>,
) -> (End, Vec<Option<StepError>>) {
    let ranks = threads::ranks(count, meddle);
    let ends: Vec<(Option<End>, Option<StepError>)> = std::thread::scope(|scope| {
        let run = |rank| {
            move || {
                let mut simulation = start(scene, threads, drift);
                let shared = simulation.share_among(Arc::new(rank));
                shared.expect("the scene can be shared");
                // The whole in the middle changes nothing.
                let (sorts, error) = step(&mut simulation, steps / 2);
                if let Some(part) = simulation.gather() {
                    let _ = simulation.energy();
                    simulation.put_back(part);
                }
                let (more, error) = match error {
                    Some(error) => (0, Some(error)),
                    None => step(&mut simulation, steps - steps / 2),
                };
                let whole = simulation.gather();
                let error_here = error.clone();
                let end = whole.map(|_| end(&mut simulation, (sorts + more, error)));
                (end, error_here)
            }
        };
        let ranks: Vec<_> = ranks
            .into_iter()
            .map(|rank| scope.spawn(run(rank)))
            .collect();
        let joined = ranks.into_iter().map(|rank| rank.join());
        joined.map(|end| end.expect("no rank panics")).collect()
    });
    let errors = ends.iter().map(|(_, error)| error.clone()).collect();
    let first = ends.into_iter().find_map(|(end, _)| end);
    (first.expect("the first rank has the whole"), errors)
}

/// Ranks and threads of each.
const TEAMS: [(usize, usize); 6] = [(1, 2), (2, 1), (2, 2), (3, 1), (4, 1), (4, 2)];

/// Compares one process with ranks; the end.
fn compare(scene: &Scene, steps: usize, drift: f64) -> End {
    let expected = alone(scene, steps, drift);
    for team in TEAMS {
        let (found, errors) = shared(scene, team, steps, drift, None);
        assert_eq!(found.error, expected.error, "{team:?}");
        assert!(
            errors.iter().all(|error| *error == expected.error),
            "{team:?} {errors:?}"
        );
        assert_eq!(found.hash, expected.hash, "{team:?} {scene:?}");
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
    for dimension in DIMENSIONS {
        for (index, (weighting, transfer)) in methods.into_iter().enumerate() {
            let mut scene = strip(dimension);
            (scene.weighting, scene.transfer) = (weighting, transfer);
            scene.damping = match index {
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
    let (_, errors) = shared(&scene, (2, 1), 300, 2.0, Some(meddle));
    for error in errors {
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
        let mut simulation = start(scene, 1, 1.0);
        simulation
            .share_among(Arc::new(rank))
            .expect_err("not local")
    };
    let part = |scene: &Scene| match refused(scene, 2) {
        NotShared::Part { part } => part,
        other => panic!("{other}"),
    };
    let mut scene = strip(Dimension::Two);
    scene.scheme = StressScheme::Musl;
    assert!(part(&scene).contains("scheme"));
    let mut scene = strip(Dimension::Two);
    scene.contacts = vec![Contact {
        name: "pair".into(),
        id: 1,
        friction: 0.3,
        master: 1,
        slave: 2,
        normal: ContactNormal::Collinear,
    }];
    assert!(part(&scene).contains("contact"));
    let scene = strip(Dimension::Two);
    let error = refused(&scene, 13);
    assert_eq!(
        error,
        NotShared::TooMany {
            ranks: 13,
            most: 12
        }
    );
    assert!(error.to_string().contains("at most 12"), "{error}");
}
