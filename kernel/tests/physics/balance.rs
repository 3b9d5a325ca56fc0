//! The energy balance closes: at one time, with the work of whoever moves a body, and by channel.

use crate::common::{FLIP, SCHEMES, block, body, cuboid, empty, run_towards, simulation};
use crate::physics::mortar::collision;
use proctor_laws::VonMises;
use proctor_scene::simulation::{Energy, Simulation};
use proctor_scene::{
    BaseMotion, Contact, ContactNormal, Damping, Dimension, History, Motion, Outside,
    PlaneCondition, Scene, Weighting,
};

const G: f64 = 10.0;

/// A block in free fall.
fn falling() -> Scene {
    let mut scene = block(Dimension::Two);
    scene.gravity = [0.0, -G, 0.0];
    scene
}

/// The sum of the channels and the remainder is what is missing, and the balance is what it says.
fn adds_up(start: f64, energy: &Energy) {
    let size = energy.kinetic.abs() + energy.external_work.abs() + start.abs();
    let channels =
        energy.damping + energy.friction + energy.impact + energy.plastic + energy.removed;
    let all = channels + energy.remainder;
    assert!((all - energy.dissipated).abs() < 1e-12 * size, "{energy:?}");
    let present = energy.kinetic + energy.strain + energy.contact;
    let missing = start + energy.external_work - present;
    assert!(
        (missing - energy.dissipated).abs() < 1e-12 * size,
        "{energy:?}"
    );
}

/// Velocities are half a step behind; the balance is not: m (g t)²/2 after every step, and nothing is lost.
#[test]
fn free_fall_loses_nothing() {
    for scheme in SCHEMES {
        let mut scene = falling();
        scene.scheme = scheme;
        let mut simulation = simulation(&scene);
        for _ in 0..5 {
            run_towards(&mut simulation, 1, 1.0);
            let energy = simulation.energy();
            let exact = 0.5 * simulation.mass() * (G * simulation.time()).powi(2);
            assert!(
                (energy.kinetic / exact - 1.0).abs() < 1e-11,
                "{scheme:?} {energy:?} {exact}"
            );
            // The way of the leapfrog is not g t²/2 to the last bit, but its work is that of its own way.
            let own = simulation.mass() * G * 0.5 * G * simulation.time().powi(2);
            assert!(
                energy.dissipated.abs() < 1e-9 * own,
                "{scheme:?} {energy:?}"
            );
            adds_up(0.0, &energy);
        }
    }
}

/// Damping takes all the energy that a body that moves as a whole loses.
#[test]
fn damping_is_known_to_round_off() {
    for scheme in SCHEMES {
        for damping in [
            Damping::Viscous { alpha: 0.1 },
            Damping::Local { alpha: 0.3 },
        ] {
            let mut scene = falling();
            scene.scheme = scheme;
            scene.damping = damping;
            scene.bodies[0].velocity = [0.3, -0.5, 0.0];
            let mut simulation = simulation(&scene);
            let start = simulation.kinetic_energy();
            run_towards(&mut simulation, 12, 1.0);
            let energy = simulation.energy();
            adds_up(start, &energy);
            assert!(
                energy.damping > 0.01 * start,
                "{scheme:?} {damping:?} {energy:?}"
            );
            // Work of gravity is the weight times the way, that of damping impulse times mean velocity: they differ by what
            // the velocity changes in a step, squared.
            let tolerance = 2e-3 * energy.damping;
            assert!(
                energy.remainder.abs() < tolerance,
                "{scheme:?} {damping:?} {energy:?}"
            );
        }
    }
}

/// A fixed plane prescribes velocities, and damping takes nothing there: a column at rest under its weight on fixed planes
/// has a reaction that does no work.
#[test]
fn damping_takes_nothing_where_velocities_are_prescribed() {
    let mut scene = empty(Dimension::Two, [4, 12, 1], 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.4, 1.0, 0.0]))];
    scene.gravity = [0.0, -G, 0.0];
    scene.damping = Damping::Local { alpha: 0.5 };
    let mut simulation = simulation(&scene);
    run_towards(&mut simulation, 600, 1.0e3);
    let energy = simulation.energy();
    adds_up(0.0, &energy);
    assert!(energy.kinetic < 1e-3 * energy.strain, "at rest: {energy:?}");
    // A load that is put on at once does twice the work that the column stores.
    assert!(energy.damping > 0.5 * energy.strain, "{energy:?}");
    assert!(energy.remainder.abs() < 0.1 * energy.damping, "{energy:?}");
}

/// Whoever moves a body as prescribed speeds it up and bears its weight.
#[test]
fn a_driven_body_costs_the_work_that_speeds_it_up() {
    for scheme in SCHEMES {
        let mut scene = falling();
        scene.scheme = scheme;
        scene.bodies[0].motion = Some(History {
            times: vec![0.0, 0.1],
            values: vec![[0.0; 3], [2.0, 0.5, 0.0]],
        });
        let mut simulation = simulation(&scene);
        run_towards(&mut simulation, 20, 0.05);
        let energy = simulation.energy();
        let v = [20.0, 5.0].map(|a| a * simulation.time());
        let exact = 0.5 * simulation.mass() * (v[0] * v[0] + v[1] * v[1]);
        assert!(
            (energy.kinetic / exact - 1.0).abs() < 1e-12,
            "{energy:?} {exact}"
        );
        assert!(
            (energy.external_work / exact - 1.0).abs() < 1e-10,
            "{energy:?} {exact}"
        );
        adds_up(0.0, &energy);
    }
}

/// A piston that speeds up pushes a bar: what is not stored or in motion is small beside the work.
#[test]
fn the_work_of_a_piston_is_in_the_bar_and_in_the_piston() {
    for scheme in SCHEMES {
        let mut scene = empty(Dimension::Two, [30, 3, 1], 0.1);
        scene.scheme = scheme;
        scene.transfer = FLIP;
        for axis in [0, 1] {
            scene.mesh.planes[axis] = [PlaneCondition::Sliding; 2];
        }
        scene.mesh.planes[0][0] = PlaneCondition::Free;
        scene.bodies = vec![
            body(1, cuboid([0.2, 0.0, 0.0], [0.5, 0.3, 0.0])),
            body(2, cuboid([0.5, 0.0, 0.0], [3.0, 0.3, 0.0])),
        ];
        scene.bodies[0].motion = Some(History {
            times: vec![0.0, 0.05],
            values: vec![[0.0; 3], [1.0, 0.0, 0.0]],
        });
        let mut simulation = simulation(&scene);
        while simulation.time() < 0.03 {
            run_towards(&mut simulation, 1, 0.03);
        }
        let energy = simulation.energy();
        adds_up(0.0, &energy);
        assert!(energy.external_work > 0.0 && energy.strain > 0.0);
        let most = 0.05 * energy.external_work;
        assert!(energy.remainder.abs() < most, "{scheme:?} {energy:?}");
    }
}

/// A plane that pushes a bar does the work that is in the bar, also where nodes beyond it mirror the bar.
#[test]
fn the_work_of_a_moving_plane_is_in_the_bar() {
    for scheme in SCHEMES {
        for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
            let mut scene = empty(Dimension::Two, [40, 3, 1], 0.1);
            (scene.scheme, scene.weighting, scene.transfer) = (scheme, weighting, FLIP);
            for axis in [0, 1] {
                scene.mesh.planes[axis] = [PlaneCondition::Sliding; 2];
            }
            scene.bodies = vec![body(1, cuboid([0.0; 3], [4.0, 0.3, 0.0]))];
            scene.base_motion = Some(BaseMotion {
                axis: 0,
                side: 0,
                motion: Motion::Velocity(History {
                    times: vec![0.0, 0.1, 0.2],
                    values: vec![[0.0; 3], [0.05, 0.0, 0.0], [0.05, 0.0, 0.0]],
                }),
            });
            let mut simulation = simulation(&scene);
            while simulation.time() < 0.2 {
                run_towards(&mut simulation, 1, 0.2);
            }
            let energy = simulation.energy();
            adds_up(0.0, &energy);
            assert!(energy.external_work > 0.0 && energy.strain > 0.0);
            // The second mapping of MUSL takes 3.5 %.
            let most = 0.05 * energy.external_work;
            assert!(
                energy.remainder.abs() < most,
                "{scheme:?} {weighting:?} {energy:?}"
            );
        }
    }
}

/// Coefficient of friction of [`sliding`].
const FRICTION: f64 = 0.3;

/// Two blocks, the lower one driven to stand still; the upper one slides on it.
fn sliding() -> Scene {
    let mut scene = empty(Dimension::Two, [24, 8, 1], 0.1);
    scene.gravity = [0.0, -G, 0.0];
    scene.bodies = vec![
        body(1, cuboid([0.2, 0.2, 0.0], [2.2, 0.4, 0.0])),
        body(2, cuboid([0.4, 0.4, 0.0], [0.8, 0.6, 0.0])),
    ];
    scene.bodies[0].motion = Some(History {
        times: vec![0.0],
        values: vec![[0.0; 3]],
    });
    scene.bodies[1].velocity = [1.0, 0.0, 0.0];
    scene.contacts = vec![Contact {
        id: 1,
        name: "slide".into(),
        master: 1,
        slave: 2,
        friction: FRICTION,
        normal: ContactNormal::Master,
    }];
    scene
}

/// Friction takes mu m g times the way.
#[test]
fn friction_is_the_force_times_the_way() {
    let mut simulation = simulation(&sliding());
    let start = simulation.kinetic_energy();
    let from = simulation.center(1).position[0];
    while simulation.time() < 0.2 {
        run_towards(&mut simulation, 1, 0.2);
    }
    let energy = simulation.energy();
    adds_up(start, &energy);
    let center = simulation.center(1);
    let (mass, x) = (center.mass, center.position);
    let exact = FRICTION * mass * G * (x[0] - from);
    assert!(
        (energy.friction / exact - 1.0).abs() < 0.05,
        "{energy:?} {exact}"
    );
    assert!(energy.remainder.abs() < 0.1 * energy.friction, "{energy:?}");
}

/// Particles that leave the mesh take their energy along.
#[test]
fn removed_particles_take_their_energy_along() {
    let mut scene = block(Dimension::Two);
    scene.outside = Outside::Remove;
    scene.bodies[0].velocity = [4.0, 0.0, 0.0];
    let mut simulation = simulation(&scene);
    let (start, count) = (simulation.kinetic_energy(), simulation.particles());
    while simulation.particles() > count / 2 {
        run_towards(&mut simulation, 1, 1.0);
    }
    let energy = simulation.energy();
    adds_up(start, &energy);
    let gone = 1.0 - simulation.particles() as f64 / count as f64;
    assert!(
        (energy.removed / (gone * start) - 1.0).abs() < 1e-6,
        "{energy:?}"
    );
    assert!(energy.remainder.abs() < 1e-6 * start, "{energy:?}");
}

/// A program that reads the balance after each step changes no bit of the run, nor of the results of its last step.
#[test]
fn to_ask_changes_nothing() {
    let mut colliding = collision(0.3);
    colliding.gravity = [0.0, -G, 0.0];
    for scheme in SCHEMES {
        let mut falls = falling();
        falls.scheme = scheme;
        falls.damping = Damping::Local { alpha: 0.2 };
        same_with_and_without(&falls);
    }
    same_with_and_without(&colliding);
    same_with_and_without(&sliding());
}

fn same_with_and_without(scene: &Scene) {
    let (mut asked, mut left) = (simulation(scene), simulation(scene));
    for _ in 0..30 {
        run_towards(&mut asked, 1, 1.0);
        run_towards(&mut left, 1, 1.0);
        let first = asked.energy();
        assert_eq!(first, asked.energy());
        let values = |s: &Simulation| format!("{:?}", s.node_values());
        assert_eq!(values(&asked), values(&left));
        assert!(asked.save() == left.save());
        assert!(asked.mortar_energy().to_bits() == left.mortar_energy().to_bits());
    }
}

/// Velocities that kinetic damping stops are energy that it took.
#[test]
fn kinetic_damping_takes_what_it_stops() {
    let mut scene = empty(Dimension::Two, [4, 12, 1], 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[1][1] = PlaneCondition::Free;
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.4, 1.0, 0.0]))];
    scene.gravity = [0.0, -G, 0.0];
    scene.damping = Damping::Kinetic;
    let mut simulation = simulation(&scene);
    run_towards(&mut simulation, 400, 1.0e3);
    let energy = simulation.energy();
    adds_up(0.0, &energy);
    assert!(energy.damping > 0.5 * energy.strain, "{energy:?}");
    assert!(energy.remainder.abs() < 0.1 * energy.damping, "{energy:?}");
}

/// A body that yields says where the work of its strain went, and its channels are those of the whole; one that does not
/// has none.
#[test]
fn a_body_that_yields_says_where_its_work_went() {
    let mut scene = empty(Dimension::Two, [8, 4, 1], 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    let mut hard = scene.materials[0].clone();
    hard.id += 1;
    hard.law = VonMises::new(1e5, 0.3, 500.0, 2e4).into();
    scene.materials.push(hard);
    let mut flying = body(1, cuboid([0.0; 3], [0.6, 0.4, 0.0]));
    flying.material = 1;
    flying.velocity = [-1.0, 0.0, 0.0];
    scene.bodies = vec![flying, body(2, cuboid([0.7, 0.0, 0.0], [0.8, 0.4, 0.0]))];
    let mut simulation = simulation(&scene);
    run_towards(&mut simulation, 60, 1.0);
    let energy = simulation.energy();
    let bodies: Vec<_> = simulation.yielding().collect();
    let [(0, own)] = bodies[..] else {
        panic!("{bodies:?}")
    };
    assert_eq!(own.plastic.to_bits(), energy.plastic.to_bits());
    assert_eq!(own.algorithmic.to_bits(), energy.algorithmic.to_bits());
    assert!(own.plastic > 0.0 && own.stored > 0.0, "{own:?}");
    assert!(
        own.algorithmic < 0.0 && own.algorithmic > -0.1 * own.plastic,
        "{own:?}"
    );
    adds_up(0.5 * 1000.0 * 0.6 * 0.4, &energy);
}
