//! Absorbing planes: waves leave through them, ground at rest stays at rest on them, waves come in through them.

use crate::common::{
    APIC, DENSITY, FLIP, SCHEMES, body, cuboid, elastic, empty, material, simulation,
};
use crate::physics::contact::pair;
use crate::physics::mortar;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{
    BaseMotion, Damping, Dimension, History, InitialStress, Motion, PlaneCondition, Scene,
    StressScheme, Traction, Transfer, Weighting,
};
use std::f64::consts::PI;

const YOUNG: f64 = 1.0e6;
const POISSON: f64 = 0.25;
const CELL: f64 = 0.1;
/// Largest displacement of a pulse in cells: its plane is to stay where the dashpots are.
const AMPLITUDE: f64 = 1e-6;

/// Speeds of compression and of shear \[m/s\].
fn speeds() -> [f64; 2] {
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let lambda = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    [(lambda + 2.0 * shear) / DENSITY, shear / DENSITY].map(f64::sqrt)
}

/// The Ricker wavelet of wavelength 1 about 0, from its second derivative.
fn ricker(x: f64) -> f64 {
    let a = (PI * x).powi(2);
    (1.0 - 2.0 * a) * (-a).exp()
}

/// A strip of so many cells along x, two cells wide, between absorbing planes, that moves along one axis.
fn strip(cells: usize, along: usize, scheme: StressScheme, transfer: Transfer) -> Scene {
    let mut scene = empty(Dimension::Two, [cells, 2, 1], CELL);
    (scene.scheme, scene.transfer) = (scheme, transfer);
    let sides = [PlaneCondition::Sliding, PlaneCondition::Antisymmetric][along];
    scene.mesh.planes[0] = [PlaneCondition::Absorbing; 2];
    scene.mesh.planes[1] = [sides; 2];
    let upper = [cells as f64 * CELL, 2.0 * CELL, 0.0];
    scene.bodies = vec![body(1, cuboid([0.0; 3], upper))];
    scene.bodies[0].particles_per_cell[2] = 1;
    scene.materials = vec![material(elastic(YOUNG, POISSON))];
    scene
}

/// Energies of a strip that a pulse of so many cells enters through the lower plane, when it has gone to the upper one and would
/// have come back. (A pulse of stress that is given to the particles leaves a part behind that no node feels.)
fn after_pulse(cells: usize, along: usize, scheme: StressScheme, transfer: Transfer) -> Pulse {
    let scene = strip(3 * cells, along, scheme, transfer);
    pulse_through(scene, cells as f64 * CELL / speeds()[along], along)
}

/// The same of a strip that is three times as long as the pulse, for a pulse of that period \[s\].
fn pulse_through(mut scene: Scene, period: f64, along: usize) -> Pulse {
    scene.ground_beyond.incoming = Some(BaseMotion {
        axis: 0,
        side: 0,
        motion: Motion::Velocity(wave(period, along)),
    });
    scene.check().expect("the scene is sound");
    let mut simulation = simulation(&scene);
    simulation.run_until(3.0 * period).expect("all steps");
    let before = simulation.energy();
    simulation.run_until(6.0 * period).expect("all steps");
    let after = simulation.energy();
    let incident = before.kinetic + before.strain;
    Pulse {
        reflected: (after.kinetic + after.strain) / incident,
        absorbed: (after.absorbed - before.absorbed) / incident,
        remainder: (after.remainder - before.remainder) / incident,
    }
}

/// Shares of the energy of a pulse.
#[derive(Debug)]
struct Pulse {
    reflected: f64,
    absorbed: f64,
    remainder: f64,
}

/// Pulses of 20 cells; the bounds are those of `absorbing.md`'s prototype with a margin of about five.
#[test]
fn pulses_leave() {
    for along in [0, 1] {
        for (scheme, transfer, most) in [
            (StressScheme::Usl, FLIP, 2e-4),
            (StressScheme::Usl, APIC, 1e-3),
            (StressScheme::Musl, FLIP, 2e-3),
            (StressScheme::Usf, FLIP, 2e-3),
        ] {
            let pulse = after_pulse(20, along, scheme, transfer);
            assert!(
                pulse.reflected < most,
                "{along} {scheme:?} {:?}: {pulse:?}",
                transfer.kind
            );
        }
    }
}

/// A strip that is half as wide as the mesh: its upper node has half a cell of ground beside it, and half a dashpot.
#[test]
fn a_dashpot_covers_the_ground_that_is_there() {
    let mut scene = strip(60, 0, StressScheme::Usl, FLIP);
    scene.mesh.cells[1] = 4;
    scene.mesh.planes[1][1] = PlaneCondition::Free;
    // Without lateral strain the upper side is free of stress.
    scene.materials = vec![material(elastic(YOUNG, 0.0))];
    let pulse = pulse_through(scene, 20.0 * CELL / (YOUNG / DENSITY).sqrt(), 0);
    assert!(pulse.reflected < 2e-4, "{pulse:?}");
}

/// Two bodies that lie beside each other share the dashpots of the nodes that both touch: they let a pulse out as one body does,
/// by the bound of *pulses_leave*. Whole dashpots for each would add half of the impedance and send back a twenty-fifth.
#[test]
fn bodies_in_contact_share_a_dashpot() {
    let mut scene = strip(60, 0, StressScheme::Usl, FLIP);
    let right = 60.0 * CELL;
    let (below, above) = ([right, CELL, 0.0], [right, 2.0 * CELL, 0.0]);
    scene.bodies = vec![
        body(1, cuboid([0.0; 3], below)),
        body(2, cuboid([0.0, CELL, 0.0], above)),
    ];
    for one in &mut scene.bodies {
        one.particles_per_cell[2] = 1;
    }
    scene.contacts = vec![pair(1, 1, 2, 0.3)];
    // Without lateral strain neither presses the other.
    scene.materials = vec![material(elastic(YOUNG, 0.0))];
    let pulse = pulse_through(scene, 20.0 * CELL / (YOUNG / DENSITY).sqrt(), 0);
    assert!(pulse.reflected < 2e-4, "{pulse:?}");
}

/// Beyond an absorbing plane functions go on linearly: nodes have the mass of a body that reaches beyond, and its mass times
/// place. Mirrored as at a plane that holds it, its part beyond would have a place within.
#[test]
fn nodes_have_the_mass_of_a_body_beyond_the_plane_at_its_place() {
    for planes in [
        [PlaneCondition::Absorbing, PlaneCondition::Free],
        [PlaneCondition::Free, PlaneCondition::Absorbing],
    ] {
        let mut scene = strip(4, 0, StressScheme::Usl, FLIP);
        scene.weighting = Weighting::QuadraticBSpline;
        scene.mesh.planes[0] = planes;
        // Splines of particles a quarter of a cell off the plane reach a quarter of a cell beyond the next node.
        let left = if planes[0] == PlaneCondition::Absorbing {
            0.0
        } else {
            2.0 * CELL
        };
        let [lower, upper] = [[left, 0.0, 0.0], [left + 2.0 * CELL, 2.0 * CELL, 0.0]];
        scene.bodies[0].shape = cuboid(lower, upper);
        scene.check().expect("the scene is sound");
        let mut simulation = simulation(&scene);
        simulation.step(f64::INFINITY).expect("a step");
        let nodes = simulation.node_values();
        let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
            nodes
                .iter()
                .map(|node| node.mass * of(node.position[0]))
                .sum()
        };
        let (mass, center) = (simulation.mass(), simulation.center(0).position[0]);
        assert!((sum(&|_| 1.0) / mass - 1.0).abs() < 1e-14, "{planes:?}");
        let off = (sum(&|x| x) / mass - center) / CELL;
        assert!(off.abs() < 1e-13, "{planes:?}: {off} cells");
    }
}

/// A load that stays moves the plane by what it presses the ground beyond together, p delta/(rho c²).
#[test]
fn springs_hold_a_load_that_stays() {
    const THICKNESS: f64 = 3.0;
    const PRESSURE: f64 = 1.0;
    let mut scene = strip(20, 0, StressScheme::Usl, FLIP);
    scene.mesh.planes[0][0] = PlaneCondition::Free;
    scene.ground_beyond.thickness = Some(THICKNESS);
    scene.tractions = vec![Traction {
        p1: [0.0; 3],
        p2: [0.0, 2.0 * CELL, 0.0],
        traction: [PRESSURE, 0.0, 0.0].into(),
    }];
    scene.check().expect("the scene is sound");
    let c = speeds()[0];
    let mut simulation = simulation(&scene);
    simulation
        .run_until(20.0 * THICKNESS / c)
        .expect("all steps");
    let exact = PRESSURE * THICKNESS / (DENSITY * c * c);
    for node in simulation.save().state.absorbing {
        let off = node.displacement[0] / exact - 1.0;
        assert!(off.abs() < 1e-3, "{node:?}, not {exact} m");
    }
}

/// The energy that comes back falls with the fourth power of the size of a cell.
#[test]
fn reflections_converge() {
    for (scheme, transfer) in [(StressScheme::Usl, FLIP), (StressScheme::Musl, FLIP)] {
        let [coarse, fine] = [16, 32].map(|cells| after_pulse(cells, 0, scheme, transfer));
        let order = (coarse.reflected / fine.reflected).log2();
        assert!(
            order > 3.0,
            "{scheme:?}: {coarse:?}, {fine:?}, order {order}"
        );
    }
}

/// The energy that came in left through the plane, but for the part that the transfer takes.
#[test]
fn the_balance_has_what_left() {
    let pulse = after_pulse(40, 0, StressScheme::Musl, FLIP);
    assert!(pulse.remainder.abs() < 1e-2, "{pulse:?}");
    assert!((pulse.absorbed - 1.0).abs() < 1e-2, "{pulse:?}");
}

/// A column under its weight, with the stress of ground at rest, or without.
fn column(at_rest: bool, scheme: StressScheme) -> Scene {
    let mut scene = empty(Dimension::Two, [2, 42, 1], CELL);
    scene.scheme = scheme;
    scene.gravity = [0.0, -9.81, 0.0];
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1] = [PlaneCondition::Absorbing, PlaneCondition::Free];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [2.0 * CELL, 40.0 * CELL, 0.0]))];
    scene.bodies[0].particles_per_cell[2] = 1;
    if at_rest {
        scene.bodies[0].initial_stress = InitialStress::AtRest {
            level: 40.0 * CELL,
            ratio: POISSON / (1.0 - POISSON),
            surcharge: 0.0,
        };
    }
    scene.materials = vec![material(elastic(1e3 * YOUNG, POISSON))];
    scene
}

/// Ten crossings of a column: with its stress it stays, without it it ends at the speed g L/c.
#[test]
fn ground_at_rest_stays_and_ground_without_stress_sinks() {
    let (c, length) = (speeds()[0] * 1e3_f64.sqrt(), 40.0 * CELL);
    let falling = 9.81 * length / c;
    for scheme in SCHEMES {
        let speed = |at_rest: bool| {
            let mut simulation = simulation(&column(at_rest, scheme));
            simulation.run_until(10.0 * length / c).expect("all steps");
            simulation.center(0).velocity[1]
        };
        let (held, lost) = (speed(true) / falling, speed(false) / falling);
        assert!(held.abs() < 1e-3, "{scheme:?}: {held}");
        assert!((lost + 1.0).abs() < 0.03, "{scheme:?}: {lost}");
    }
}

/// Velocity along an axis of a wave of so long a period \[s\] that comes in within three of them \[m/s\].
fn wave(period: f64, along: usize) -> History {
    let count = 4000;
    let times: Vec<f64> = (0..=count)
        .map(|i| 3.0 * period * f64::from(i) / f64::from(count))
        .collect();
    let speed = AMPLITUDE * CELL / period;
    let values = times.iter().map(|t| {
        let mut v = [0.0; 3];
        v[along] = speed * ricker(t / period - 1.5);
        v
    });
    History {
        values: values.collect(),
        times,
    }
}

/// Level ground between antisymmetric sides on a compliant base, with the weight that is given and its stress.
fn shaken_ground(scheme: StressScheme, gravity: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [2, HIGH + 2, 1], CELL);
    scene.scheme = scheme;
    scene.mesh.planes[0] = [PlaneCondition::Antisymmetric; 2];
    scene.mesh.planes[1] = [PlaneCondition::Absorbing, PlaneCondition::Free];
    let top = HIGH as f64 * CELL;
    scene.bodies = vec![body(1, cuboid([0.0; 3], [2.0 * CELL, top, 0.0]))];
    scene.bodies[0].particles_per_cell[2] = 1;
    scene.gravity = [0.0, -gravity, 0.0];
    if gravity > 0.0 {
        scene.bodies[0].initial_stress = InitialStress::AtRest {
            level: top,
            ratio: POISSON / (1.0 - POISSON),
            surcharge: 0.0,
        };
    }
    scene.materials = vec![material(elastic(YOUNG, POISSON))];
    scene.ground_beyond.incoming = Some(BaseMotion {
        axis: 1,
        side: 0,
        motion: Motion::Velocity(wave(40.0 * CELL / speeds()[1], 0)),
    });
    scene
}

/// Height of the shaken ground in cells.
const HIGH: usize = 80;

/// A wave of shear that comes in from below, doubles at the surface, goes down and leaves; the sides bear the stress of ground
/// that weighs.
#[test]
fn a_wave_comes_in_and_leaves() {
    let period = 40.0 * CELL / speeds()[1];
    for (scheme, gravity) in SCHEMES.into_iter().flat_map(|s| [(s, 0.0), (s, 1e-3)]) {
        let scene = shaken_ground(scheme, gravity);
        scene.check().expect("the scene is sound");
        let mut simulation = simulation(&scene);
        let set = &simulation.sets()[0];
        let at = |y: f64| {
            let near = |p: usize| (set.position(p)[1] - y).abs();
            let nearest = (0..set.len()).min_by(|a, b| near(*a).total_cmp(&near(*b)));
            set.id[nearest.expect("particles")]
        };
        let (top, bottom) = (at(HIGH as f64 * CELL), at(0.0));
        let speed = AMPLITUDE * CELL / period;
        let mut peak = 0.0_f64;
        let of = |simulation: &Simulation, id: u64| {
            let set = &simulation.sets()[0];
            let p = set.id.iter().position(|one| *one == id).expect("is there");
            set.velocity(p)[0]
        };
        // The middle of the wave reaches the top after 1.5 periods and 80 cells, and has left after 160.
        let end = (3.0 + 2.0 * HIGH as f64 / 40.0) * period;
        while simulation.time() < end {
            simulation.step(end).expect("a step");
            peak = peak.max(of(&simulation, top));
        }
        let (peak, left) = (peak / speed / 2.0, of(&simulation, bottom) / speed);
        assert!((peak - 1.0).abs() < 0.02, "{scheme:?} {gravity}: {peak}");
        assert!(left.abs() < 5e-3, "{scheme:?} {gravity}: {left}");
    }
}

/// A block between four absorbing planes, of two bodies in contact, that is hit.
fn hit_block(transfer: Transfer, scheme: StressScheme) -> Scene {
    let mut scene = empty(Dimension::Two, [12, 10, 1], CELL);
    (scene.scheme, scene.transfer) = (scheme, transfer);
    scene.mesh.planes[0] = [PlaneCondition::Absorbing; 2];
    scene.mesh.planes[1] = [PlaneCondition::Absorbing; 2];
    scene.ground_beyond.thickness = Some(1.0);
    let mut left = body(1, cuboid([0.0; 3], [0.6, 1.0, 0.0]));
    let mut right = body(2, cuboid([0.6, 0.0, 0.0], [1.2, 1.0, 0.0]));
    for one in [&mut left, &mut right] {
        one.particles_per_cell[2] = 1;
    }
    left.velocity = [0.1, 0.02, 0.0];
    scene.bodies = vec![left, right];
    scene.contacts = vec![pair(1, 1, 2, 0.3)];
    scene.materials = vec![material(elastic(YOUNG, POISSON))];
    scene
}

#[test]
fn bits_depend_neither_on_threads_nor_on_where_a_run_was_cut() {
    for (transfer, scheme) in [(FLIP, StressScheme::Usl), (APIC, StressScheme::Musl)] {
        let scene = hit_block(transfer, scheme);
        scene.check().expect("the scene is sound");
        let with = |threads: usize| {
            let options = Options {
                threads: Some(threads),
                least_share: Some(1),
                ..Options::default()
            };
            Simulation::new(&scene, &options).expect("the scene is sound")
        };
        let run = |mut simulation: Simulation, steps: usize| {
            for _ in 0..steps {
                simulation.step(f64::INFINITY).expect("a step");
            }
            simulation
        };
        let whole = run(with(1), 120);
        let energy = absorbed(&whole);
        assert!(energy > 0.0, "nothing left: {energy}");
        for threads in [2, 3] {
            let other = run(with(threads), 120);
            assert_eq!(whole.state_hash(), other.state_hash(), "{threads} threads");
            assert_eq!(energy.to_bits(), absorbed(&other).to_bits());
        }
        let first = run(with(1), 50);
        let mut second = with(2);
        second.restore(first.save()).expect("the same scene");
        let second = run(second, 70);
        assert_eq!(whole.state_hash(), second.state_hash(), "in two parts");
        assert_eq!(energy.to_bits(), absorbed(&second).to_bits());
    }
}

/// Energy that left so far \[J\].
fn absorbed(simulation: &Simulation) -> f64 {
    simulation.save().state.ledger.absorbed
}

/// Damping that stops waves at their peaks, contact on mirror images, bodies without an equation of motion.
#[test]
fn what_does_not_go_with_absorbing_planes_is_refused() {
    let refused = |change: &dyn Fn(&mut Scene), words: &str| {
        let mut scene = hit_block(FLIP, StressScheme::Usl);
        change(&mut scene);
        let error = scene.check().expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&|scene| scene.damping = Damping::Kinetic, "kinetic damping");
    refused(
        &|scene| scene.bodies[0].motion = Some([0.0; 3].into()),
        "prescribed_velocity",
    );
    refused(
        &|scene| scene.mortar = mortar::collision(0.4).mortar,
        "mortar contact",
    );
    refused(
        &|scene| {
            scene.base_motion = Some(BaseMotion {
                axis: 1,
                side: 0,
                motion: Motion::Velocity([0.0; 3].into()),
            });
        },
        "absorbs and moves",
    );
}
