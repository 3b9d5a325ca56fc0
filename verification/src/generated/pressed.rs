//! Layers under one pressure: every row of particles carries it, wherever faces lie in their cells.

use proctor_scene::{Contact, Dimension, History, Scene, Weighting};

use super::column::{self, Column, Layer};
use super::dice::Dice;
use super::seen::FinalState;
use super::{Deviation, Question, Run, Trial, crowd};

/// Layers that share one field.
pub static JOINED: Question = Question {
    name: "joined",
    holds: "joined layers under one pressure carry it in every row",
    because: "2 % of the pressure: a load on rows of particles is felt about two cells below them, which are left out",
    foreseen: &[],
    make: joined,
};

/// Layers in contact.
pub static CONTACT: Question = Question {
    name: "contact",
    holds: "layers in contact under one pressure carry it in every row, with each normal, at any place of their faces",
    because: "5 % in the cell beside an interface, whose nodes both layers reach, 2 % elsewhere",
    foreseen: &["beside the interface"],
    make: contact,
};

/// Layers on a body that is driven.
pub static DRIVEN: Question = Question {
    name: "driven",
    holds: "a layer that is pressed on a body whose velocity is prescribed carries the pressure in every row",
    because: "5 % in the cell beside the interface, 2 % elsewhere; the driven body acts where it is",
    foreseen: ON_DRIVEN,
    make: driven,
};

/// A block with free sides on a plate.
pub static PLATE: Question = Question {
    name: "plate",
    holds: "a block with free sides that is pressed on a smooth plate carries the pressure in every row and no other stress",
    because: "5 % in the cell beside the interface, 2 % elsewhere; corners do not turn the normal; a load on two rows, which widens \
              them, is felt as far below as the block is wide (Saint-Venant), and no row there is judged",
    foreseen: ON_DRIVEN,
    make: plate,
};

/// Warnings of layers on a driven body.
const ON_DRIVEN: &[&str] = &[
    ROWS_OF_SPLINES,
    "to and fro",
    "its nodes are light",
    "keep swinging",
];
/// Warning of rows of particles that are no whole number in a cell.
pub const ROWS_OF_SPLINES: &str = "no whole number in one";

/// Largest error of rows away from interfaces, over the pressure.
const ROWS: f64 = 0.02;
/// Largest error of the rows in the cell beside an interface.
const BESIDE: f64 = 0.05;
/// Least height of a driven body \[cells\]. What lies on a lower one feels the plane of the mesh below, with B-splines from one
/// and a half cells on.
const LEAST: f64 = 2.0;
/// Cells below the load in which it is felt as what it is.
const FELT: f64 = 2.5;

/// One or two layers that share a field.
fn joined(dice: &mut Dice) -> Trial {
    let dimension = crowd::dimension(dice);
    let count = dice.whole(1, 2);
    let mut layers = vec![layer(dice, dimension)];
    if count == 2 {
        layers.push(layer(dice, dimension));
        // A cell has one strain. Layers that differ meet at a line of the mesh, or the cell that both are in has not the
        // stress of either: `plan` warns of it.
        layers[0].height = layers[0].height.round();
        layers[1].stiffness = dice.decades(1.0, 20.0);
        if dice.chance(0.5) {
            layers.reverse();
            layers[0].height = layers[0].height.round();
        }
    }
    let mut column = Column::new(dice, dimension, 0.0, &layers, 0);
    // The gradient of B-splines has no jump at a line of the mesh either.
    if layers.len() == 2 && column.scene.weighting == Weighting::QuadraticBSpline {
        column.scene.weighting = Weighting::UniformGimp;
    }
    pressed(dice, column, &[], FELT)
}

/// A layer of a stack.
fn layer(dice: &mut Dice, dimension: Dimension) -> Layer {
    let most = if dimension == Dimension::Two {
        6.0
    } else {
        4.5
    };
    Layer {
        height: if dice.chance(0.3) {
            dice.whole(3, most as usize) as f64
        } else {
            dice.between(3.0, most)
        },
        stiffness: 1.0,
        density: 1.0,
    }
}

fn contact(dice: &mut Dice) -> Trial {
    let dimension = crowd::dimension(dice);
    let mut layers = vec![layer(dice, dimension), layer(dice, dimension)];
    let stiff = dice.whole(0, 1);
    layers[stiff].stiffness = dice.pick(&[1.0, 1.0, 3.0, 10.0, 30.0]);
    layers[stiff].density = dice.pick(&[1.0, 1.0, 2.0]);
    // The layer above is three cells and what the load takes, so that rows between are asked.
    layers[1].height += 1.5;
    let mut column = Column::new(dice, dimension, 0.0, &layers, 0);
    let friction = dice.pick(&[0.0, 0.3]);
    touch(dice, &mut column.scene, [1, 2], friction);
    pressed(dice, column, &[1], FELT)
}

fn driven(dice: &mut Dice) -> Trial {
    let dimension = crowd::dimension(dice);
    let mut layers = vec![layer(dice, dimension), layer(dice, dimension)];
    layers[0].height = LEAST + dice.place();
    layers[1].height += 1.5;
    let mut column = Column::new(dice, dimension, 0.0, &layers, 0);
    column.scene.bodies[0].motion = Some(History::from([0.0; 3]));
    let friction = dice.pick(&[0.0, 0.3]);
    if dice.chance(0.7) {
        touch(dice, &mut column.scene, [1, 2], friction);
    }
    pressed(dice, column, &[1], FELT)
}

fn plate(dice: &mut Dice) -> Trial {
    let dimension = crowd::dimension(dice);
    let mut layers = vec![layer(dice, dimension), layer(dice, dimension)];
    layers[0].height = LEAST + dice.place();
    // As wide as a block may be, so that rows are judged below those that feel the load.
    layers[1].height += 4.0;
    let free = 2;
    let mut column = Column::new(dice, dimension, 0.0, &layers, free);
    let axes = dimension.axes();
    // The plate reaches beyond the block; the block is of any width.
    let (h, up) = (column.h(), axes - 1);
    let mesh = column.scene.mesh.clone();
    if let proctor_scene::Shape::Cuboid { p1, p2 } = &mut column.scene.bodies[0].shape {
        for axis in 0..up {
            (p1[axis], p2[axis]) = (mesh.origin[axis], mesh.upper()[axis]);
        }
    }
    if let proctor_scene::Shape::Cuboid { p1, p2 } = &mut column.scene.bodies[1].shape {
        for axis in 0..up {
            p1[axis] -= dice.place() * h;
            p2[axis] += dice.place() * h;
        }
    }
    column.scene.bodies[0].motion = Some(History::from([0.0; 3]));
    touch(dice, &mut column.scene, [1, 2], 0.0);
    let (p1, p2) = crowd::corners(&column.scene.bodies[1]);
    let widest = (0..up)
        .map(|axis| (p2[axis] - p1[axis]) / h)
        .fold(FELT, f64::max);
    pressed(dice, column, &[1], widest)
}

/// Contact of two bodies, either of them the master.
fn touch(dice: &mut Dice, scene: &mut Scene, mut ends: [i64; 2], friction: f64) {
    if dice.chance(0.5) {
        ends.reverse();
    }
    scene.contacts.push(Contact {
        name: "contact".to_owned(),
        id: 1,
        friction,
        master: ends[0],
        slave: ends[1],
        normal: dice.pick(&crowd::NORMALS),
    });
}

/// The column under a pressure, with interfaces at these of its faces; so many cells below the load it is felt as what it is.
fn pressed(dice: &mut Dice, mut column: Column, interfaces: &[usize], felt: f64) -> Trial {
    let (pressure, load) = column.press(dice);
    let (h, up) = (column.h(), column.up());
    let frame = column.turn(dice);
    let asked_below = load - felt * h;
    let faces: Vec<f64> = interfaces.iter().map(|face| column.faces[*face]).collect();
    let driven: Vec<i64> = (column.scene.bodies.iter())
        .filter(|body| body.motion.is_some())
        .map(|body| body.id)
        .collect();
    let judge = Box::new(move |seen: &[FinalState]| {
        let [seen] = seen else { return vec![] };
        let rows = |beside: bool| {
            column::off(seen, &frame, up, |z, body| {
                let near = faces.iter().any(|face| (z - face).abs() < h);
                (z < asked_below && near == beside && !driven.contains(&body))
                    .then_some((-pressure, pressure))
            })
        };
        let mut all = vec![Deviation::new(
            "stress of a row over the pressure",
            rows(false),
            ROWS,
        )];
        if !faces.is_empty() {
            all.push(Deviation::new(
                "stress beside an interface over the pressure",
                rows(true),
                BESIDE,
            ));
        }
        all
    });
    Trial {
        runs: vec![Run::to_rest(column.scene)],
        judge,
    }
}
