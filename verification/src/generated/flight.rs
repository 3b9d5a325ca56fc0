//! Free flight: what nothing touches moves as a point does.

use proctor_scene::PlaneCondition;

use super::dice::Dice;
use super::seen::largest;
use super::{Deviation, Question, Trial, crowd};

/// A free flight.
pub static FLIGHT: Question = Question {
    name: "flight",
    holds: "bodies of one velocity fly under gravity as points do, and no stress arises",
    because: "weights sum to one and gradients to zero, so that round-off of some tens of steps is left",
    foreseen: &[],
    make: flight,
};

/// Largest share of the way, the speed and the stress of a wave of that speed.
const BOUND: f64 = 1e-11;

fn flight(dice: &mut Dice) -> Trial {
    let mut scene = crowd::scene(
        dice,
        crowd::CrowdChoices {
            outside: false,
            meet: false,
            ..crowd::ALL
        },
    );
    for body in &mut scene.bodies {
        body.initial_stress = proctor_scene::InitialStress::None;
    }
    debug_assert_eq!(scene.mesh.planes[0][0], PlaneCondition::Free);
    let speed = largest(scene.bodies[0].velocity);
    let axes = scene.dimension.axes();
    if dice.chance(0.7) {
        for axis in 0..axes {
            scene.gravity[axis] = dice.between(-1.0, 1.0) * speed / scene.time;
        }
    }
    let (time, gravity) = (scene.time, scene.gravity);
    let impedance = (scene.materials.iter())
        .map(|m| m.density * m.law.wave_speed(m.density))
        .fold(0.0, f64::max);
    let length = largest(scene.mesh.cell[..axes].iter().copied());
    let judge = Box::new(move |seen: &[super::FinalState]| {
        let [seen] = seen else { return vec![] };
        let mut off = [0.0_f64; 3];
        for p in &seen.particles {
            for axis in 0..3 {
                let (v, g) = (p.start_velocity[axis], gravity[axis]);
                let x = p.start[axis] + v * time + 0.5 * g * time * time;
                off[0] = largest([off[0], (p.position[axis] - x) / length]);
                // Velocities are those half a step before the end: what is left of gravity there is one number for all.
                let first =
                    seen.particles[0].velocity[axis] - seen.particles[0].start_velocity[axis];
                off[1] = largest([off[1], (p.velocity[axis] - v - first) / speed]);
                let most = g * time;
                let between = first * most >= 0.0
                    && first.abs() <= most.abs() * (1.0 + BOUND) + BOUND * speed;
                off[1] = largest([off[1], if between { 0.0 } else { 1.0 }]);
            }
            off[2] = largest([off[2], largest(p.stress) / (impedance * speed)]);
        }
        vec![
            Deviation::new("way over a cell", off[0], BOUND),
            Deviation::new("velocity over the largest", off[1], BOUND),
            Deviation::new("stress over that of a wave", off[2], BOUND),
        ]
    });
    Trial {
        runs: vec![scene.into()],
        judge,
    }
}
