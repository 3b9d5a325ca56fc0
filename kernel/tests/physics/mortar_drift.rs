//! Vertices of mortar contact stay on their body: a disc that a plane squeezes at once before it settles, and what drift is.

use crate::common::{APIC, FLIP, body, cuboid, empty, material, options, run_towards, simulation};
use crate::physics::mortar::{boundary, collision, contact, disc, line};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_laws::NeoHookean;
use proctor_scene::simulation::{SetupError, Simulation};
use proctor_scene::{Damping, Dimension, History, MortarContact, Scene, StressScheme, Vertices};
use std::f64::consts::PI;

const RADIUS: f64 = 1.5;
const CELL: f64 = 0.1;
const GAP: f64 = 0.05;
const YOUNG: f64 = 1.0e3;
const POISSON: f64 = 0.3;
/// Half-width of the contact, three cells.
const HALF_WIDTH: f64 = 0.3;
const CENTER: f64 = 1.8;

/// Weight of the disc with which Hertz's contact has that half-width \[N/m\], b² = 4 F R/(pi E*).
fn load() -> f64 {
    let modulus = YOUNG / (1.0 - POISSON * POISSON);
    HALF_WIDTH.powi(2) * PI * modulus / (4.0 * RADIUS)
}

/// A disc at rest at the critical gap over a plane, which comes up to 0.3 of the gap within a time \[s\]. A start there is
/// refused: the barrier presses with twelve times Young's modulus.
fn resting(follow: FollowMode, rise: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [36, 36, 1], CELL);
    let bottom = 0.25;
    scene.transfer = APIC;
    scene.transfer.pic_fraction = 0.1;
    let mut soft = material(NeoHookean::new(YOUNG, POISSON));
    soft.density = 1.0;
    scene.materials = vec![soft];
    scene.bodies = vec![body(1, disc([CENTER, bottom + GAP + RADIUS], RADIUS))];
    scene.gravity = [0.0, -load() / (PI * RADIUS * RADIUS), 0.0];
    scene.damping = Damping::Viscous { alpha: 0.03 };
    scene.mortar.boundaries = vec![boundary(1, follow)];
    scene.mortar.lines = vec![line(&[[3.4, bottom], [0.2, bottom]])];
    let speed = [0.0, 0.7 * GAP / rise, 0.0];
    scene.mortar.lines[0].motion = Some(History {
        times: vec![0.0, rise, 1.001 * rise],
        values: vec![speed, speed, [0.0; 3]],
    });
    scene.mortar.contacts = vec![MortarContact {
        critical_gap: GAP,
        normal_stiffness: 7.5e4,
        ..contact(9, 1, 0.0)
    }];
    scene
}

/// Numbers of a disc that has settled: force over weight, peak over that of Hertz, distance from Hertz in L2, drift in cells.
fn settled(follow: FollowMode, rise: f64) -> [f64; 4] {
    let mut simulation = simulation(&resting(follow, rise));
    let end = 2.5;
    while simulation.time() < end {
        run_towards(&mut simulation, 1, end);
    }
    let hertz = |x: f64| {
        let share = 1.0 - (x / HALF_WIDTH).powi(2);
        2.0 * load() / (PI * HALF_WIDTH) * share.max(0.0).sqrt()
    };
    let (mut peak, mut off, mut all) = (0.0_f64, 0.0, 0.0);
    for vertex in simulation.mortar_vertices(1).expect("a contact") {
        let expected = hertz(vertex.position[0] - CENTER);
        peak = peak.max(vertex.pressure);
        off += vertex.measure * (vertex.pressure - expected).powi(2);
        all += vertex.measure * expected.powi(2);
    }
    let force = simulation.mortar_force(1).expect("a boundary")[1];
    let drift = simulation.boundary_drift().expect("a boundary").in_cells;
    [force / load(), peak / hertz(0.0), (off / all).sqrt(), drift]
}

/// A plane that is at 0.3 of the critical gap at once drives vertices into the disc that are integrated; the force is right
/// all the same, the pressure is not.
#[test]
fn a_disc_that_was_squeezed_settles_with_the_pressure_of_hertz() {
    let at_once = 5.0e-4;
    let [force, peak, off, drift] = settled(FollowMode::Spin, at_once);
    assert!((force - 1.0).abs() < 1e-3, "{force}");
    assert!(
        peak > 1.5 && off > 0.5 && drift > 0.1,
        "{peak} {off} {drift}"
    );
    let [force, peak, off, drift] = settled(FollowMode::Material, at_once);
    assert!((force - 1.0).abs() < 1e-3, "{force}");
    assert!((peak - 1.0).abs() < 0.1 && off < 0.25, "{peak} {off}");
    assert!(drift < 1e-12, "{drift}");
}

/// Forces do the same work on nodes as on the vertices that go with these. What vertices are moved by beside that, to where
/// the particles are at the beginning of the next step, is round-off, and so is the work of contact on it.
#[test]
fn staying_on_the_body_does_no_work() {
    let mut scene = collision(0.4);
    (scene.scheme, scene.transfer) = (StressScheme::Musl, FLIP);
    for boundary in &mut scene.mortar.boundaries {
        boundary.follow = FollowMode::Material;
    }
    let mut simulation = simulation(&scene);
    let energy = simulation.kinetic_energy();
    let (mut work, mut pushed) = (0.0, 0.0_f64);
    while simulation.time() < 0.12 {
        run_towards(&mut simulation, 1, 0.12);
        let by = simulation.boundary_drift().expect("boundaries").distance;
        let vertices = simulation.boundaries().vertices;
        let sizes = vertices.iter().map(|v| v.force[0].hypot(v.force[1]));
        let force = sizes.sum::<f64>();
        pushed = pushed.max(force);
        work += by * force;
    }
    assert!(pushed > 100.0, "{pushed}");
    assert!(work < 1e-6 * energy, "{work} {energy}");
}

/// A vertex that goes with its body has no drift, however far; one that follows velocities alone is left behind by a turn.
#[test]
fn a_motion_without_strain_has_no_drift() {
    for follow in [
        FollowMode::Velocity,
        FollowMode::Spin,
        FollowMode::Gradient,
        FollowMode::Material,
    ] {
        let mut scene = collision(0.0);
        scene.bodies.truncate(1);
        scene.mortar.contacts.clear();
        scene.mortar.boundaries = vec![boundary(1, follow)];
        scene.bodies[0].velocity = [2.0, 0.5, 0.0];
        let mut simulation = simulation(&scene);
        assert_eq!(
            simulation.boundary_drift().expect("a boundary").distance,
            0.0
        );
        run_towards(&mut simulation, 100, 1.0);
        let drift = simulation.boundary_drift().expect("a boundary");
        assert!(drift.distance < 1e-12, "{follow:?} {drift:?}");
        assert!((drift.in_cells - drift.distance / CELL).abs() < 1e-15);
    }
    let mut without = collision(0.0);
    without.mortar = proctor_scene::Mortar::default();
    assert!(simulation(&without).boundary_drift().is_none());
}

/// A state that is taken up again has the vertices where they were, to the bit.
#[test]
fn a_saved_state_goes_on_with_the_same_bits() {
    let mut scene = collision(0.4);
    scene.bodies[0].velocity = [2.0, 0.3, 0.0];
    let mut whole = simulation(&scene);
    run_towards(&mut whole, 30, 1.0);
    let saved = whole.save();
    run_towards(&mut whole, 30, 1.0);
    let mut rest = Simulation::new(&scene, &options()).expect("sound");
    rest.restore(saved).expect("of the same scene");
    run_towards(&mut rest, 30, 1.0);
    assert!(whole.mortar_energy() > 0.0);
    assert_eq!(whole.state_hash(), rest.state_hash());
    assert_eq!(whole.boundary_vertices(2), rest.boundary_vertices(2));
    assert_eq!(whole.boundary_drift(), rest.boundary_drift());
}

/// A vertex far off its body is tied to nothing, nor is one of a body that is one particle thick, which turns unseen.
#[test]
fn a_vertex_that_cannot_stay_on_its_body_is_refused() {
    let mut scene = collision(0.0);
    let triangle = [[0.5, 0.3], [0.8, 0.3], [0.5, 1.35]];
    scene.mortar.boundaries.truncate(1);
    scene.mortar.contacts.clear();
    scene.mortar.boundaries[0].follow = FollowMode::Material;
    scene.mortar.boundaries[0].vertices = Vertices::Given(vec![Chain {
        points: triangle.iter().map(|p| Point::from(*p)).collect(),
        side: BoundarySide::Outer,
    }]);
    let refused = |scene: &Scene| match Simulation::new(scene, &options()) {
        Err(SetupError::Interaction { path, reason }) => format!("{path}: {reason}"),
        _ => panic!("is refused"),
    };
    let said = refused(&scene);
    assert!(
        said.contains("boundary of body 1: the particles around vertex 2"),
        "{said}"
    );
    scene.mortar.boundaries[0].vertices = Vertices::Spacing(0.05);
    scene.bodies[0].shape = cuboid([0.5, 0.5, 0.0], [1.0, 0.6, 0.0]);
    scene.bodies[0].particles_per_cell = [1, 1, 1];
    let said = refused(&scene);
    assert!(said.contains("gradient"), "{said}");
    scene.mortar.boundaries[0].follow = FollowMode::Gradient;
    assert!(Simulation::new(&scene, &options()).is_ok());
}
