//! Symmetries of contact on the grid: halves of bodies beside a plane, master and slave in each other's place,
//! and bodies beside which another one flies.

use crate::common::elastic;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{
    Contact, ContactNormal, ParticleSeed, PlaneCondition, Scene, Shape, Vector, Weighting,
};

/// Distance of particles \[m\]; cells of 1 m.
const STEP: f64 = 0.5;
/// Middle of both discs across their way \[m\].
const MIDDLE: f64 = 6.0;

/// Two discs that run into each other along x, whole or the half above their middle. Particles of B-splines reach beyond the
/// plane through it.
fn discs(half: bool, normal: ContactNormal) -> Simulation {
    let low = if half { MIDDLE } else { 0.0 };
    let mut scene =
        Scene::plane([16, if half { 6 } else { 12 }], 1.0).with_planes(PlaneCondition::Free);
    scene.mesh.origin[1] = low;
    scene.time = 1e9;
    scene.weighting = Weighting::QuadraticBSpline;
    if half {
        scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    }
    let material = scene.add_material(elastic(100.0, 0.3), 1.0);
    for (center, speed) in [(5.0, 0.5), (10.0, -0.5)] {
        let radius: f64 = 2.6;
        let mut seeds = vec![];
        for i in -6..6 {
            for j in -6..6 {
                let off = [i, j].map(|i: i32| (f64::from(i) + 0.5) * STEP);
                if off[0].hypot(off[1]) < radius && (!half || off[1] > 0.0) {
                    seeds.push(ParticleSeed {
                        position: [center + off[0], MIDDLE + off[1], 0.0],
                        volume: STEP * STEP,
                    });
                }
            }
        }
        scene
            .add_body(Shape::Particles(seeds.into()), material)
            .velocity = [speed, 0.0, 0.0];
    }
    scene.contacts = vec![Contact {
        name: String::from("contact"),
        id: 1,
        friction: 0.2,
        master: 1,
        slave: 2,
        normal,
    }];
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    scene.simulate(&options).expect("sound")
}

/// The image of a particle beyond the plane has its mass gradient turned round, so that the normals of the half are those of
/// the whole.
#[test]
fn half_of_two_discs_collides_as_the_whole_does() {
    for normal in [ContactNormal::Master, ContactNormal::Collinear] {
        let [mut whole, mut half] = [false, true].map(|half| discs(half, normal));
        let mut pushed = 0.0_f64;
        while whole.time() < 1.5 {
            whole.step(1e9).expect("a step");
            half.step(1e9).expect("a step");
            pushed = pushed.max(half.contact_force(0)[0].abs());
        }
        assert!(pushed > 1.0, "they touch");
        for set in 0..2 {
            let all: Vec<Vector> = (0..whole.sets()[set].len())
                .map(|p| whole.position(set, p))
                .collect();
            for p in 0..half.sets()[set].len() {
                let x = half.position(set, p);
                let off = |y: &Vector| (x[0] - y[0]).hypot(x[1] - y[1]);
                let nearest = all.iter().map(off).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-9, "{normal:?} {x:?} is {nearest} off");
            }
        }
    }
}

/// A disc on the corner of a block, far off its middle, with a contact between the two.
fn disc_on_a_corner(contact: (i64, i64, ContactNormal)) -> Simulation {
    let mut scene = Scene::plane([12, 12], 1.0).with_planes(PlaneCondition::Free);
    scene.time = 1e9;
    let material = scene.add_material(elastic(100.0, 0.3), 1.0);
    let seeds = |keep: &dyn Fn(&Vector) -> bool| -> Vec<ParticleSeed> {
        (0..24 * 24)
            .map(|k| [k % 24, k / 24, 0].map(|i| (f64::from(i) + 0.5) * STEP))
            .map(|[x, y, _]| [x, y, 0.0])
            .filter(|x| keep(x))
            .map(|position| ParticleSeed {
                position,
                volume: STEP * STEP,
            })
            .collect()
    };
    let block = seeds(&|x| x[0] > 2.0 && x[0] < 7.0 && x[1] > 2.0 && x[1] < 5.0);
    let disc = seeds(&|x| (x[0] - 7.5).hypot(x[1] - 7.0) < 2.1);
    for (particles, speed) in [(block, 0.0), (disc, -1.0)] {
        scene
            .add_body(Shape::Particles(particles.into()), material)
            .velocity = [0.0, speed, 0.0];
    }
    let (master, slave, normal) = contact;
    scene.contacts = vec![Contact {
        name: String::from("contact"),
        id: 1,
        friction: 0.2,
        master,
        slave,
        normal,
    }];
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = scene.simulate(&options).expect("sound");
    while simulation.time() < 1.0 {
        simulation.step(1e9).expect("a step");
    }
    simulation
}

/// The normal of a body is the same whether the body is called master or slave; that of the other body is another one.
#[test]
fn the_normal_of_the_slave_is_that_of_the_same_body_as_master() {
    use ContactNormal::{Collinear, Master, Slave};
    let block_and_disc = |normal| disc_on_a_corner((1, 2, normal));
    let disc_and_block = |normal| disc_on_a_corner((2, 1, normal));
    let off = |a: &Simulation, b: &Simulation| {
        (0..2)
            .flat_map(|set| {
                let (x, y) = (a.center(set).velocity, b.center(set).velocity);
                (0..2).map(move |axis| (x[axis] - y[axis]).abs())
            })
            .fold(0.0, f64::max)
    };
    for (one, other) in [(Slave, Master), (Master, Slave), (Collinear, Collinear)] {
        let off = off(&block_and_disc(one), &disc_and_block(other));
        assert!(off < 1e-9, "{one:?} {other:?}: {off} m/s");
    }
    let between = off(&block_and_disc(Slave), &block_and_disc(Master));
    assert!(between > 1e-3, "{between} m/s");
}
