//! Undrained clay: its strength is the share of the vertical stress at the start, and stays so.

use crate::common::{body, cuboid, empty, material};
use proctor_laws::{AnyLaw, Point, Tresca, UndrainedClay};
use proctor_scene::{Dimension, InitialStress, Scene};

const YOUNG: f64 = 1e7;
const POISSON: f64 = 0.3;
const RATIO: f64 = 0.22;
const DENSITY: f64 = 2000.0;

/// Shear stress xz after a shear that is ten times what makes it yield.
fn sheared(law: &AnyLaw, stress: [f64; 6], load: f64) -> f64 {
    let mut point = Point::new(law, DENSITY, stress);
    // Squeezed first: the strength does not follow.
    point
        .strain(&[-load, -load, -load, 0.0, 0.0, 0.0], 1e-3)
        .expect("a step");
    for _ in 0..2000 {
        let step = 2e-5;
        point
            .strain(&[0.0, 0.0, 0.0, 0.0, step, 0.0], 1e-3)
            .expect("a step");
    }
    point.stress()[4]
}

#[test]
fn strength_is_the_share_of_the_vertical_stress_at_the_start() {
    for vertical in [1e4, 5e4, 2e5] {
        let law = UndrainedClay::new(YOUNG, POISSON, RATIO);
        let exact = RATIO * vertical;
        assert_eq!(law.strength(-vertical), exact);
        // Equal stresses: s_1 - s_3 is twice the shear stress. The other components of the stress turn with the shear by little.
        for load in [0.0, 1e-3] {
            let found = sheared(
                &law.into(),
                [-vertical, -vertical, -vertical, 0.0, 0.0, 0.0],
                load,
            );
            assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
        }
    }
}

/// The horizontal stress has no part in it, and with the same strength it is Tresca's clay to the last bit.
#[test]
fn it_is_clay_of_tresca_with_that_strength() {
    let stress = [-3e4, -4e4, -5e4, 0.0, 0.0, 0.0];
    let clay = UndrainedClay::new(YOUNG, POISSON, RATIO).into();
    let tresca = Tresca::new(YOUNG, POISSON, RATIO * 5e4).into();
    let found = [&clay, &tresca].map(|law| sheared(law, stress, 1e-3));
    assert!((found[0] / found[1] - 1.0).abs() < 1e-12, "{found:?}");
}

#[test]
fn the_least_strength_holds_where_there_is_no_stress() {
    let law = UndrainedClay::new(YOUNG, POISSON, RATIO).no_weaker(1e3);
    let found = sheared(&law.into(), [0.0; 6], 0.0);
    assert!((found / 1e3 - 1.0).abs() < 1e-3, "{found}");
}

#[test]
fn a_scene_without_vertical_stress_is_refused_by_name() {
    let scene = |law: UndrainedClay, gravity: [f64; 3], initial_stress: InitialStress| -> Scene {
        let mut scene = empty(Dimension::Two, [4, 4, 1], 0.1);
        scene.materials = vec![material(law)];
        scene.gravity = gravity;
        let mut one = body(1, cuboid([0.0; 3], [0.4, 0.4, 0.0]));
        one.particles_per_cell[2] = 1;
        one.initial_stress = initial_stress;
        scene.bodies = vec![one];
        scene
    };
    let clay = UndrainedClay::new(YOUNG, POISSON, RATIO);
    let down = [0.0, -10.0, 0.0];
    let told = |scene: Scene| format!("{}", scene.check().expect_err("it is refused"));
    let none = told(scene(clay, down, InitialStress::None));
    assert!(none.contains("initial_stress"), "{none}");
    let aside = told(scene(
        clay,
        [10.0, 0.0, 0.0],
        InitialStress::Isotropic(-1e4),
    ));
    assert!(aside.contains("gravity"), "{aside}");
    for sound in [
        scene(clay.no_weaker(1.0), down, InitialStress::None),
        scene(clay, down, InitialStress::Isotropic(-1e4)),
    ] {
        sound.check().expect("the scene is sound");
    }
}
