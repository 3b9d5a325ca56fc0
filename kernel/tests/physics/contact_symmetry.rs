//! Halves of bodies beside a plane of symmetry, in contact on the grid.

use crate::common::elastic;
use proctor_kernel::scene::{
    Contact, ContactNormal, ParticleSeed, PlaneCondition, Scene, Shape, Vector, Weighting,
};
use proctor_kernel::simulation::{Options, Simulation};

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
