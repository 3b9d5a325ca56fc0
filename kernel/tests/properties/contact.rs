//! Contact: momentum, the friction cone, no pull, order, threads, mirrors.

use crate::common::{
    APIC, DIMENSIONS, FLIP, NEVER, SCHEMES, body, cases, cuboid, distance, elastic, empty,
    material, momentum_scale, observe, options, particles, rough_drift,
};
use nalgebra::DMatrix;
use proctor_contact::pairs::coulomb::{Coulomb, FieldTouch, FrictionLaw, Member};
use proctor_scene::simulation::{Options, Phase, Simulation};
use proctor_scene::{
    Contact, ContactNormal, Dimension, PlaneCondition, Scene, StressScheme, Vector,
};
use proptest::prelude::*;

const NORMALS: [ContactNormal; 3] = [
    ContactNormal::Master,
    ContactNormal::Slave,
    ContactNormal::Collinear,
];

fn unit(v: &Vector) -> Vector {
    let size = dot(v, v).sqrt();
    v.map(|c| c / size)
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// Up to four fields with masses over twelve decades, and one touch for some of their pairs.
fn node() -> impl Strategy<Value = (Vec<Member>, Vec<FieldTouch>)> {
    let vector = || prop::array::uniform3(-1.0..1.0_f64);
    let member =
        (-6.0..6.0_f64, vector(), vector()).prop_map(|(mass, velocity, increment)| Member {
            mass: 10.0_f64.powf(mass),
            velocity,
            increment,
        });
    let friction = prop_oneof![Just(0.0), 0.0..2.0_f64, Just(f64::INFINITY)];
    let touch = (vector(), friction, any::<bool>());
    (
        prop::collection::vec(member, 2..5),
        prop::collection::vec(touch, 6),
    )
        .prop_map(|(members, all)| {
            let mut touches = vec![];
            let mut next = all.into_iter();
            for master in 0..members.len() {
                for slave in master + 1..members.len() {
                    let (normal, friction, present) = next.next().expect("six pairs of four");
                    if (present || members.len() == 2) && dot(&normal, &normal) > 1e-2 {
                        touches.push(FieldTouch {
                            master,
                            slave,
                            normal: unit(&normal),
                            law: FrictionLaw::Coulomb(friction),
                        });
                    }
                }
            }
            (members, touches)
        })
}

/// Where touches are less independent than that, sweeps may end at their most: two thousand, each of which takes at least a third
/// of the independence from what is left of the approach where a body has three touches, leave exp(-33) of it here.
const WEDGED: f64 = 0.05;

/// Independence of the normals of touches, by the masses between which they act: the smallest eigenvalue of their response to
/// impulses along them, that of each to its own being 1.
fn independence(members: &[Member], touches: &[FieldTouch]) -> f64 {
    let response = |s: &FieldTouch, t: &FieldTouch| {
        let of = |body: usize| {
            let sign = |touch: &FieldTouch| {
                f64::from(i8::from(touch.master == body) - i8::from(touch.slave == body))
            };
            sign(s) * sign(t) / members[body].mass
        };
        (0..members.len()).map(of).sum::<f64>() * dot(&s.normal, &t.normal)
    };
    let own: Vec<f64> = touches.iter().map(|t| response(t, t).sqrt()).collect();
    let n = touches.len();
    if n == 0 {
        return 1.0;
    }
    let all = DMatrix::from_fn(n, n, |i, j| {
        response(&touches[i], &touches[j]) / (own[i] * own[j])
    });
    all.symmetric_eigenvalues()
        .iter()
        .copied()
        .fold(1.0, f64::min)
}

fn resolve(members: &[Member], touches: &[FieldTouch]) -> (Vec<Member>, Vec<Vector>) {
    let mut after = members.to_vec();
    let mut impulses = vec![];
    Coulomb::default().resolve(&mut after, |_, _| false, touches, &mut impulses);
    (after, impulses)
}

/// Four bodies whose five normals are nearly in one plane of impulses: met by chance, on it the sweeps end at their most.
#[test]
fn wedged_bodies_are_known_as_such() {
    let body = |mass, velocity| Member {
        mass,
        velocity,
        increment: [0.0; 3],
    };
    let members = [
        body(1.0, [0.0; 3]),
        body(1.0, [0.0, -0.321, 0.277]),
        body(0.9, [-0.968, 0.470, 0.0]),
        body(1.0, [0.0; 3]),
    ];
    let touch = |master, slave, normal: Vector| FieldTouch {
        master,
        slave,
        normal: unit(&normal),
        law: FrictionLaw::Coulomb(0.0),
    };
    let wedged = [
        touch(0, 2, [0.828, 0.561, 0.0]),
        touch(0, 3, [-0.813, -0.583, 0.0]),
        touch(1, 2, [0.731, 0.0, 0.682]),
        touch(1, 3, [-0.844, 0.0, -0.536]),
        touch(2, 3, [0.764, 0.461, 0.452]),
    ];
    assert!(independence(&members, &wedged) < WEDGED);
    assert!(independence(&members, &wedged[..3]) > 0.1);
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn impulses_keep_momentum_and_their_cone((members, touches) in node()) {
        let (after, impulses) = resolve(&members, &touches);
        for axis in 0..3 {
            let change: f64 = members
                .iter()
                .zip(&after)
                .map(|(a, b)| a.mass * (b.velocity[axis] - a.velocity[axis]))
                .sum();
            let scale: f64 = members.iter().map(|m| m.mass).fold(0.0, f64::max);
            prop_assert!(change.abs() <= 1e-13 * scale, "momentum changes by {change} of {scale}");
        }
        for (touch, impulse) in touches.iter().zip(&impulses) {
            let FrictionLaw::Coulomb(friction) = touch.law else { unreachable!("all are Coulomb") };
            let along = dot(impulse, &touch.normal);
            let size = dot(impulse, impulse).sqrt();
            prop_assert!(along >= 0.0, "pulls by {along}");
            let aside = impulse.iter().zip(&touch.normal).map(|(j, n)| (j - along * n).powi(2)).sum::<f64>().sqrt();
            prop_assert!(friction.is_infinite() || aside <= friction * along + 1e-13 * size, "{aside} over {friction} * {along}");
        }
        // Velocity and increment change alike.
        for (a, b) in members.iter().zip(&after) {
            for axis in 0..3 {
                let (v, dv) = (b.velocity[axis] - a.velocity[axis], b.increment[axis] - a.increment[axis]);
                prop_assert!((v - dv).abs() <= 1e-14);
            }
        }
    }

    #[test]
    fn two_bodies_follow_the_manual((members, touches) in node()) {
        prop_assume!(members.len() == 2 && touches.len() == 1);
        let (after, impulses) = resolve(&members, &touches);
        let (a, b, touch) = (&members[0], &members[1], &touches[0]);
        let FrictionLaw::Coulomb(friction) = touch.law else { unreachable!("all are Coulomb") };
        // The manual's f_c dt on the master, eq. (7) with the signs of the errata.
        let sticking: Vector = std::array::from_fn(|k| {
            (a.mass * (b.mass * b.velocity[k]) - b.mass * (a.mass * a.velocity[k])) / (a.mass + b.mass)
        });
        let normal = dot(&sticking, &touch.normal);
        let expected = if normal >= 0.0 {
            [0.0; 3]
        } else {
            let aside: Vector = std::array::from_fn(|k| sticking[k] - normal * touch.normal[k]);
            let size = dot(&aside, &aside).sqrt();
            let share = if friction.is_infinite() || size <= friction * normal.abs() { 1.0 } else { friction * normal.abs() / size };
            std::array::from_fn(|k| normal * touch.normal[k] + share * aside[k])
        };
        let scale = dot(&sticking, &sticking).sqrt();
        let opposite = impulses[0].map(|j| -j);
        prop_assert!(distance(&opposite, &expected) <= 1e-13 * scale, "{opposite:?} {expected:?}");
        if normal >= 0.0 {
            prop_assert_eq!(&after, &members);
        } else {
            let gap: Vector = std::array::from_fn(|k| after[0].velocity[k] - after[1].velocity[k]);
            prop_assert!(dot(&gap, &touch.normal).abs() <= 1e-13, "they still approach");
        }
    }

    /// Any order of fields and pairs gives the same to round-off, masses of three decades.
    #[test]
    fn order_matters_to_round_off_only((mut members, touches) in node(), turn in 1..4_usize) {
        for m in &mut members {
            m.mass = m.mass.powf(0.25);
        }
        let (after, _) = resolve(&members, &touches);
        let n = members.len();
        let place = |i: usize| (i + turn) % n;
        let mut turned = members.clone();
        for (i, m) in members.iter().enumerate() {
            turned[place(i)] = *m;
        }
        let mut moved: Vec<FieldTouch> = touches
            .iter()
            .map(|t| FieldTouch { master: place(t.master), slave: place(t.slave), ..*t })
            .collect();
        moved.reverse();
        let (remap, _) = resolve(&turned, &moved);
        for (i, m) in after.iter().enumerate() {
            prop_assert!(distance(&m.velocity, &remap[place(i)].velocity) <= 1e-12, "{i}: {m:?} {:?}", remap[place(i)]);
        }
    }

    /// Without friction nothing is left of the approach, and no pair gains energy. Sweeps are many, and not endless: bodies
    /// that are wedged, each normal between them all but made up of the others, want impulses without bound, and what is left
    /// of their approach is what the sweeps leave. They gain no energy either.
    #[test]
    fn smooth_bodies_do_not_approach((mut members, mut touches) in node()) {
        for m in &mut members {
            m.mass = m.mass.powf(0.1);
        }
        for t in &mut touches {
            t.law = FrictionLaw::Coulomb(0.0);
        }
        let (after, _) = resolve(&members, &touches);
        let wedged = independence(&members, &touches) < WEDGED;
        for t in &touches {
            let gap: Vector = std::array::from_fn(|k| after[t.master].velocity[k] - after[t.slave].velocity[k]);
            prop_assert!(wedged || dot(&gap, &t.normal) <= 1e-9, "they still approach");
        }
        let energy = |all: &[Member]| all.iter().map(|m| m.mass * dot(&m.velocity, &m.velocity)).sum::<f64>();
        prop_assert!(energy(&after) <= energy(&members) * (1.0 + 1e-9));
    }

    /// The mirrored node gives the mirrored bits.
    #[test]
    fn a_mirrored_node_is_mirrored((members, touches) in node(), axis in 0..3_usize) {
        let mirror = |v: &Vector| std::array::from_fn(|k| if k == axis { -v[k] } else { v[k] });
        let flipped: Vec<Member> = members
            .iter()
            .map(|m| Member { velocity: mirror(&m.velocity), increment: mirror(&m.increment), ..*m })
            .collect();
        let turned: Vec<FieldTouch> = touches.iter().map(|t| FieldTouch { normal: mirror(&t.normal), ..*t }).collect();
        let (after, _) = resolve(&members, &touches);
        let (remap, _) = resolve(&flipped, &turned);
        for (a, b) in after.iter().zip(&remap) {
            prop_assert_eq!(mirror(&a.velocity), b.velocity);
        }
    }
}

/// A field that has the prescribed velocity of its group, and others that are joined to it.
#[test]
fn joined_fields_share_velocity_and_increment() {
    let member = |mass: f64, v: f64| Member {
        mass,
        velocity: [v, 0.0, 0.0],
        increment: [0.1 * v, 0.0, 0.0],
    };
    let mut members = [member(1.0, 2.0), member(3.0, -2.0), member(1.0, 7.0)];
    let mut impulses = vec![];
    let mut coulomb = Coulomb::default();
    coulomb.resolve(&mut members, |i, j| (i, j) == (0, 1), &[], &mut impulses);
    assert_eq!(members[0].velocity, [-1.0, 0.0, 0.0]);
    assert_eq!(members[0].velocity, members[1].velocity);
    assert_eq!(members[0].increment, members[1].increment);
    assert_eq!(members[2], member(1.0, 7.0));
    members[2].mass = f64::INFINITY;
    coulomb.resolve(&mut members, |_, _| true, &[], &mut impulses);
    assert!(members.iter().all(|m| m.velocity == [7.0, 0.0, 0.0]));
}

/// Two blocks that overlap by their nodes and fly somewhere.
fn pair(
    dimension: Dimension,
    shift: f64,
    friction: f64,
    ratio: f64,
    normal: ContactNormal,
) -> Scene {
    let mut scene = empty(dimension, [20, 10, 10], 0.1);
    scene.materials.push(material(elastic(1.0e6 * ratio, 0.3)));
    scene.materials[1].density *= ratio;
    scene.bodies = vec![
        body(5, cuboid([0.4, 0.3, 0.3], [0.81, 0.62, 0.6])),
        body(
            2,
            cuboid([0.81, 0.3 + shift, 0.35], [1.2, 0.62 + shift, 0.65]),
        ),
    ];
    scene.bodies[1].material = 1;
    scene.contacts = vec![Contact {
        name: "pair".into(),
        id: 1,
        friction,
        master: 5,
        slave: 2,
        normal,
    }];
    scene
}

/// The first body, left of x = 0.81, flies at the second.
fn flying(scene: &Scene, threads: usize) -> Simulation {
    let rough = rough_drift(scene.dimension, [0.0; 3], 0.2, 0.0, 7);
    let initial = std::sync::Arc::new(move |x: &Vector| {
        let mut state = rough(x);
        if x[0] < 0.81 {
            state.velocity[0] += 1.0;
            state.velocity[1] += 0.3;
        }
        state
    });
    Simulation::new(
        scene,
        &Options {
            threads: Some(threads),
            least_share: Some(1),
            initial: Some(initial),
            ..options()
        },
    )
    .expect("the scene is sound")
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn a_pair_keeps_its_momentum(
        shift in -0.2..0.2_f64, friction in 0.0..1.5_f64, decades in -6..7_i32, which in 0..3_usize,
        scheme in 0..3_usize, affine in any::<bool>(), flat in any::<bool>(),
    ) {
        let dimension = DIMENSIONS[usize::from(!flat)];
        let mut scene = pair(dimension, shift, friction, 10.0_f64.powi(decades), NORMALS[which]);
        scene.scheme = SCHEMES[scheme];
        scene.transfer = if affine { APIC } else { FLIP };
        let mut simulation = flying(&scene, 1);
        let before = simulation.momentum();
        let mut touched = 0;
        for _ in 0..12 {
            touched += simulation.step(NEVER).expect("the step is sound").contact_nodes;
            let (a, b) = (simulation.contact_force(0), simulation.contact_force(1));
            prop_assert_eq!(a, b.map(|f| -f));
        }
        prop_assert!(touched > 0);
        let scale = momentum_scale(&simulation);
        let drift = distance(&before, &simulation.momentum());
        prop_assert!(drift <= 1e-13 * scale, "momentum off by {} of it", drift / scale);
    }

    #[test]
    fn threads_and_the_order_of_bodies_change_no_bit(
        shift in -0.2..0.2_f64, friction in 0.0..1.5_f64, which in 0..3_usize, scheme in 0..3_usize, flat in any::<bool>(),
    ) {
        let dimension = DIMENSIONS[usize::from(!flat)];
        let mut scene = pair(dimension, shift, friction, 10.0, NORMALS[which]);
        scene.mesh.cells[0] = 40;
        scene.scheme = SCHEMES[scheme];
        let state = |scene: &Scene, threads: usize| {
            let mut simulation = flying(scene, threads);
            crate::common::run(&mut simulation, 15);
            let mut bodies: Vec<_> = (0..2)
                .map(|set| {
                    let own = &simulation.sets()[set];
                    let all: Vec<_> = (0..own.len()).map(|p| (own.position(p), own.velocity(p), own.stress(p))).collect();
                    (simulation.body(set).id, all, simulation.contact_force(set))
                })
                .collect();
            bodies.sort_by_key(|b| b.0);
            bodies
        };
        let reference = state(&scene, 1);
        prop_assert!(state(&scene, 3) == reference, "threads change the bits");
        scene.bodies.reverse();
        prop_assert!(state(&scene, 1) == reference, "the order of the bodies changes the bits");
    }
}

/// Contact in the one slab of one thread is told apart, and amid the phase in which it acts; the slabs of several threads
/// are visited at once, and no phase of theirs is. Watching changes no bit.
#[test]
fn an_observer_gets_contact_apart() {
    for scheme in SCHEMES {
        let mut scene = pair(Dimension::Two, 0.1, 0.3, 10.0, ContactNormal::Master);
        scene.mesh.cells[0] = 40;
        scene.scheme = scheme;
        let mut alone = flying(&scene, 1);
        crate::common::run(&mut alone, 10);
        for threads in [1, 3] {
            let mut watched = flying(&scene, threads);
            let phases = observe(&mut watched);
            for _ in 0..10 {
                phases.lock().expect("no panic").clear();
                watched.step(NEVER).expect("a sound step");
            }
            let phases = phases.lock().expect("no panic").clone();
            assert_eq!(alone.state_hash(), watched.state_hash());
            let told = phases.contains(&Phase::Contact);
            assert_eq!(told, threads == 1, "{scheme:?}: {phases:?}");
            let after = phases.iter().rposition(|phase| *phase == Phase::Contact);
            let amid = after.map(|at| (phases[at - 1], phases[at + 1]));
            let expected = match scheme {
                StressScheme::Usl => Phase::P2gAndSolve,
                StressScheme::Musl | StressScheme::Usf => Phase::Remap,
            };
            assert!(
                amid.is_none_or(|amid| amid == (expected, expected)),
                "{scheme:?}: {phases:?}"
            );
        }
    }
}

/// A scene mirrored along x gives the mirrored motion, beside a wall too.
#[test]
fn a_mirrored_scene_is_mirrored() {
    for dimension in DIMENSIONS {
        for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
            for normal in NORMALS {
                let build = |mirrored: bool| {
                    let mut scene = empty(dimension, [16, 10, 10], 0.125);
                    scene.scheme = scheme;
                    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
                    let at = |a: f64, b: f64| if mirrored { [2.0 - b, 2.0 - a] } else { [a, b] };
                    let sign = if mirrored { -1.0 } else { 1.0 };
                    let [a, b] = at(0.0, 0.5);
                    let [c, d] = at(0.125, 0.75);
                    scene.bodies = vec![
                        body(1, cuboid([a, 0.125, 0.125], [b, 0.375, 0.5])),
                        body(2, cuboid([c, 0.375, 0.125], [d, 0.75, 0.5])),
                    ];
                    scene.bodies[1].velocity = [sign, -0.5, 0.0];
                    scene.contacts = pair(dimension, 0.0, 0.3, 1.0, normal).contacts;
                    scene.contacts[0].master = 1;
                    let mut simulation = crate::common::simulation(&scene);
                    let touched = (0..40)
                        .filter(|_| {
                            let info = simulation.step(NEVER).expect("the step is sound");
                            info.contact_nodes > 0
                        })
                        .count();
                    assert!(touched > 4, "{scheme:?} {normal:?}: {touched} steps");
                    simulation
                };
                let (plain, mirrored) = (build(false), build(true));
                for set in 0..2 {
                    let (a, b) = (plain.center(set), mirrored.center(set));
                    let flipped = [-b.velocity[0], b.velocity[1], b.velocity[2]];
                    assert!(
                        distance(&a.velocity, &flipped) < 1e-12,
                        "{scheme:?} {normal:?}: {a:?} {b:?}"
                    );
                }
                assert_eq!(particles(&plain).len(), particles(&mirrored).len());
            }
        }
    }
}
