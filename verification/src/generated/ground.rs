//! Ground under its weight: stress grows with depth.

use proctor_scene::{Contact, Dimension, History, InitialStress, Shape, Weighting};

use super::column::{self, Column, Layer};
use super::dice::Dice;
use super::seen::FinalState;
use super::{Deviation, Question, Run, Trial, crowd};
use crate::cases::{body, cuboid};

/// Ground that settles, or begins at rest.
pub static GROUND: Question = Question {
    name: "ground",
    holds: "ground between smooth sides carries the weight above each row, from a start without stress or at rest",
    because: "2 % of the stress at the base, and the weight of half a cell less a particle: a particle has the \
        strain of its cell",
    foreseen: &["keep swinging"],
    make: ground,
};

/// The same between walls that are bodies.
pub static WALLS: Question = Question {
    name: "walls",
    holds: "ground between smooth walls that are driven bodies carries the weight above each row, with each normal",
    because: "2 % of the stress at the base, and the weight of half a cell less a particle; two cells at the \
        surface and the base are left out, and as \
              many as the ground is wide where the walls begin a cell above its base, so that its foot bulges",
    foreseen: &["stands between driven bodies"],
    make: walls,
};

/// Largest error, over the stress at the base.
const ROWS: f64 = 0.02;

fn ground(dice: &mut Dice) -> Trial {
    let dimension = crowd::dimension(dice);
    let most = if dimension == Dimension::Two {
        12.0
    } else {
        7.0
    };
    let layers = [block(dice, most)];
    let mut column = Column::new(dice, dimension, 0.0, &layers, 0);
    let weight = weigh(dice, &mut column);
    if dice.chance(0.5) && !column.scene.materials[0].law.needs_deformation() {
        column.scene.bodies[0].initial_stress = InitialStress::AtRest {
            ratio: dice.between(0.2, 1.2),
            level: column.top(),
            surcharge: 0.0,
        };
    }
    judged(dice, column, weight, 0.0, 0.0)
}

fn walls(dice: &mut Dice) -> Trial {
    let dimension = Dimension::Two;
    // Walls of two cells, as wide as the margin; the mesh ends where they do.
    let layers = [block(dice, 14.0)];
    let mut column = Column::new(dice, dimension, 0.0, &layers, 2);
    let weight = weigh(dice, &mut column);
    let (h, mesh) = (column.h(), column.scene.mesh.clone());
    let (p1, p2) = crowd::corners(&column.scene.bodies[0]);
    let smooth = dice.pick(&crowd::NORMALS);
    let (wide, height) = ((p2[0] - p1[0]) / h, (p2[1] - p1[1]) / h);
    let begins = if height > wide + 6.0 {
        dice.pick(&[0.0, 1.0])
    } else {
        0.0
    };
    for (id, [low, high]) in [(2, [mesh.origin[0], p1[0]]), (3, [p2[0], mesh.upper()[0]])] {
        let shape = cuboid([low, p1[1] + h * begins, 0.0], [high, p2[1] + h, 0.0]);
        let mut wall = body(format!("wall {id}"), id, shape);
        wall.particles_per_cell = column.scene.bodies[0].particles_per_cell;
        wall.motion = Some(History::from([0.0; 3]));
        column.scene.bodies.push(wall);
        let mut ends = [id, 1];
        if dice.chance(0.3) {
            ends.reverse();
        }
        column.scene.contacts.push(Contact {
            name: format!("contact {id}"),
            id,
            friction: 0.0,
            master: ends[0],
            slave: ends[1],
            normal: smooth,
        });
    }
    // Faces of the ground off the lines of the mesh, and the walls with them.
    let moved = dice.place() * h;
    for body in &mut column.scene.bodies {
        if let Shape::Cuboid { p1, p2 } = &mut body.shape {
            match body.id {
                1 => (p1[0], p2[0]) = (p1[0] - moved, p2[0] - moved),
                2 => p2[0] -= moved,
                _ => p1[0] -= moved,
            }
        }
    }
    judged(dice, column, weight, 2.0, 2.0 + begins * wide)
}

/// Ground of one material.
fn block(dice: &mut Dice, most: f64) -> Layer {
    Layer {
        height: if dice.chance(0.3) {
            dice.whole(5, most as usize) as f64
        } else {
            dice.between(5.0, most)
        },
        stiffness: 1.0,
        density: 1.0,
    }
}

/// Gravity that strains the base a little; returns the weight per volume \[N/m³\].
fn weigh(dice: &mut Dice, column: &mut Column) -> f64 {
    let height = column.top() - column.faces[0];
    let weight = column.moduli[0] * dice.decades(2e-5, 2e-4) / height;
    let up = column.up();
    column.scene.gravity[up] = -weight / column.scene.materials[0].density;
    weight
}

/// The column under its weight; the given numbers of cells at the surface and at the base are left out.
fn judged(dice: &mut Dice, mut column: Column, weight: f64, surface: f64, base: f64) -> Trial {
    let (h, up) = (column.h(), column.up());
    let (bottom, top) = (column.faces[0], column.top());
    let particles = column.scene.bodies[0].particles_per_cell[0] as f64;
    // The strain of linear gradients is that of the middle of the cell; B-splines have that of the place.
    let middle = if column.scene.weighting == Weighting::QuadraticBSpline {
        0.25
    } else {
        0.5 - 0.5 / particles
    };
    let bound = ROWS + middle * h / (top - bottom);
    let frame = column.turn(dice);
    let judge = Box::new(move |seen: &[FinalState]| {
        let [seen] = seen else { return vec![] };
        let scale = weight * (top - bottom);
        let off = column::off(seen, &frame, up, |z, body| {
            let asked = body == 1 && z < top - surface * h && z > bottom + base * h;
            asked.then_some((-weight * (top - z), scale))
        });
        vec![Deviation::new(
            "stress of a row over that of the base",
            off,
            bound,
        )]
    });
    Trial {
        runs: vec![Run::to_rest(column.scene)],
        judge,
    }
}
