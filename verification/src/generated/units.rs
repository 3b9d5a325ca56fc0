//! Units of length, mass and time: the same scene told in others gives the same result.

use proctor_scene::{InitialStress, Scene, Shape, Vector};

use super::change::Frame;
use super::dice::Dice;
use super::seen::FinalState;
use super::{Deviation, Judge, Question, Trial, compare, crowd, law};

/// Units that are powers of two.
pub static POWERS: Question = Question {
    name: "units-two",
    holds: "in units that are powers of two of the first a scene gives the same bits",
    because: "a power of two changes exponents alone, so that an absolute threshold anywhere would show",
    foreseen: &[],
    make: powers,
};

/// Units by odd factors.
pub static ODD: Question = Question {
    name: "units-odd",
    holds: "in any other units a scene gives the same but for round-off",
    because: "round-off of some tens of steps; a threshold that decides on the last bit would show at 1e-6 and more",
    foreseen: &[],
    make: odd,
};

/// Largest difference of two runs that differ by round-off in their input.
pub const ROUND_OFF: f64 = 1e-9;

/// Units of length, mass and time over those of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Length.
    pub length: f64,
    /// Mass.
    pub mass: f64,
    /// Time.
    pub time: f64,
}

impl Units {
    /// The same units.
    pub const SAME: Self = Self {
        length: 1.0,
        mass: 1.0,
        time: 1.0,
    };

    /// Unit of velocity.
    #[must_use]
    pub fn velocity(&self) -> f64 {
        self.length / self.time
    }

    /// Unit of stress.
    #[must_use]
    pub fn stress(&self) -> f64 {
        self.mass / (self.length * self.time * self.time)
    }

    /// Unit of density.
    #[must_use]
    pub fn density(&self) -> f64 {
        self.mass / (self.length * self.length * self.length)
    }

    /// A position; in the plane the thickness stays 1 m.
    #[must_use]
    pub fn point(&self, x: &Vector, axes: usize) -> Vector {
        std::array::from_fn(|a| if a < axes { x[a] * self.length } else { x[a] })
    }

    /// The scene in these units.
    #[must_use]
    pub fn scene(&self, scene: &Scene) -> Scene {
        let axes = scene.dimension.axes();
        let mut new = scene.clone();
        new.time *= self.time;
        new.mesh.origin = self.point(&scene.mesh.origin, axes);
        new.mesh.cell = self.point(&scene.mesh.cell, axes);
        new.gravity = scene.gravity.map(|g| g * self.velocity() / self.time);
        for material in &mut new.materials {
            material.density *= self.density();
            material.law = law::scaled(&material.law, self);
        }
        for body in &mut new.bodies {
            if let Shape::Cuboid { p1, p2 } = &mut body.shape {
                *p1 = self.point(p1, axes);
                *p2 = self.point(p2, axes);
            }
            body.velocity = body.velocity.map(|v| v * self.velocity());
            if let Some(motion) = &mut body.motion {
                for time in &mut motion.times {
                    *time *= self.time;
                }
                for value in &mut motion.values {
                    *value = value.map(|v| v * self.velocity());
                }
            }
            match &mut body.initial_stress {
                // No generated scene has ground below a surface.
                InitialStress::None | InitialStress::Overburden(_) => {}
                InitialStress::Isotropic(value) => *value *= self.stress(),
                InitialStress::AtRest {
                    level, surcharge, ..
                } => {
                    *level *= self.length;
                    *surcharge *= self.stress();
                }
            }
        }
        for load in &mut new.box_loads {
            load.p1 = self.point(&load.p1, axes);
            load.p2 = self.point(&load.p2, axes);
            let area = (1..axes).fold(1.0, |area, _| area * self.length);
            load.force = load.force.map(|f| f * self.stress() * area);
        }
        new
    }
}

fn powers(dice: &mut Dice) -> Trial {
    let units = Units {
        length: dice.power(8),
        mass: dice.power(8),
        time: dice.power(8),
    };
    let scene = crowd::scene(dice, crowd::ALL);
    let other = units.scene(&scene);
    let axes = scene.dimension.axes();
    let judge: Judge = Box::new(move |seen| {
        let [one, two] = seen else { return vec![] };
        vec![
            Deviation::new(
                "particles with other bits",
                differing(one, two, &units, axes) as f64,
                0.0,
            ),
            Deviation::new(
                "other times of the end",
                (one.time * units.time - two.time).abs() / two.time,
                0.0,
            ),
        ]
    });
    Trial {
        runs: vec![scene.into(), other.into()],
        judge,
    }
}

/// Number of particles that are not the same bits in the other units.
fn differing(one: &FinalState, two: &FinalState, units: &Units, axes: usize) -> usize {
    if one.particles.len() != two.particles.len() {
        return usize::MAX;
    }
    let pairs = one.particles.iter().zip(&two.particles);
    let differs = pairs.filter(|(a, b)| {
        units.point(&a.position, axes) != b.position
            || a.velocity.map(|v| v * units.velocity()) != b.velocity
            || a.stress.map(|s| s * units.stress()) != b.stress
    });
    differs.count()
}

fn odd(dice: &mut Dice) -> Trial {
    let units = Units {
        length: dice.pick(&[3.0, 0.1, 0.7, 1.0 / 3.0, 1e3]),
        mass: dice.pick(&[3.0, 0.1, 7.0, 1.0]),
        time: dice.pick(&[3.0, 0.1, 0.7, 1.0]),
    };
    let allowed = crowd::CrowdChoices {
        jumps: false,
        ..crowd::ALL
    };
    let scene = crowd::scene(dice, allowed);
    let other = units.scene(&scene);
    Trial {
        judge: compare::same(&scene, Frame::SAME, units, ROUND_OFF),
        runs: vec![scene.into(), other.into()],
    }
}
