//! A case of one's own, outside this crate: a question, a ladder, a scene, a comparison and gates, in one value.
//!
//! A block is thrown and falls freely. Gravity is the same everywhere, so the block moves as a rigid body on a parabola, and the
//! leapfrog has that motion to round-off. `cargo run --release --example own_case`.

use proctor_laws::LinearElastic;
use proctor_scene::simulation::Options;
use proctor_scene::{PlaneCondition, Scene, Shape};
use proctor_verification::case::gates::{TableRule, error};
use proctor_verification::case::ladder::Ladder;
use proctor_verification::case::wrong::Wrong;
use proctor_verification::case::{Case, Measurements, Quantity, Run, Rung, Size};
use proctor_verification::check;
use proctor_verification::settings::Settings;

const SIDE: f64 = 1.0; // [m]
const GRAVITY: f64 = 10.0; // [m/s²]
const UP: f64 = 2.0; // velocity at the start [m/s]
const END: f64 = 0.3; // [s]
const WAVE_SPEED: f64 = 40.0; // [m/s]
const HEIGHT: &str = "height gained";
const WRONG_GRAVITY: Wrong = Wrong::factor("gravity", 1.01);

/// The thrown block.
static THROWN_BLOCK: Case = Case::new("thrown-block", "Does a thrown block fly on its parabola?")
    .ladder(Ladder::cells("block", "side/h", SIDE, &[4, 8], &[4, 8, 16]))
    .scene(scene)
    .compare(|run| Ok(compare(run)))
    .gates(&[error(HEIGHT).at_most(1e-10, "gravity is the same everywhere: round-off is left")])
    .tables(&[TableRule::new("thrown-block, uGIMP, USL, FLIP", &[HEIGHT])])
    .wrong_references(&[WRONG_GRAVITY])
    .no_study("every method has the parabola to round-off")
    .no_guest("every solver has the parabola to round-off");

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let count = (3.0 * SIDE / h).round() as usize;
    let mut scene = Scene::plane([count, count], h)
        .with_planes(PlaneCondition::Free)
        .with_gravity([0.0, -GRAVITY, 0.0])
        .with_end(END);
    scene.time_step = settings.equal_steps(END, h, WAVE_SPEED).0;
    let rubber = scene.add_material(LinearElastic::new(1e6, 0.3), 1e3);
    let block = Shape::Cuboid {
        p1: [SIDE, SIDE, 0.0],
        p2: [2.0 * SIDE, 2.0 * SIDE, 0.0],
    };
    scene.add_body(block, rubber).velocity[1] = UP;
    settings.applied(scene)
}

fn compare(run: &mut Run<'_>) -> Measurements {
    let (gravity, t) = (run.reference.of(&WRONG_GRAVITY) * GRAVITY, run.time());
    let [_, y, _] = run.simulation.center(0).position;
    let gained = Quantity::compared(HEIGHT, y - 1.5 * SIDE, UP * t - 0.5 * gravity * t * t, "m");
    Measurements::new(vec![gained], None)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ladders = check::ladders(&THROWN_BLOCK, &Options::default())?;
    for gate in THROWN_BLOCK.judge(Size::Quick, &ladders[0]).gates {
        let words = gate.relation.words();
        println!(
            "{}: {:.1e}, {words} {:.1e}: {}",
            gate.name, gate.value, gate.bound, gate.reason
        );
    }
    let faults = check::faults(&THROWN_BLOCK, &ladders, &[]);
    println!("{} faults {faults:?}", faults.len());
    Ok(())
}

#[test]
fn the_case_has_no_fault() {
    let ladders = check::ladders(&THROWN_BLOCK, &Options::default()).expect("it runs");
    assert_eq!(
        check::faults(&THROWN_BLOCK, &ladders, &[]),
        Vec::<String>::new()
    );
}
