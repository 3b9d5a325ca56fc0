//! Order: neither that of bodies in the file, nor that of threads, nor that of particles in bodies changes a result.

use proctor_scene::{Scene, Shape};

use super::change::Frame;
use super::dice::Dice;
use super::units::{ROUND_OFF, Units};
use super::{Question, Run, Trial, compare, crowd};

/// Bodies in another order.
pub static BODIES: Question = Question {
    name: "order",
    holds: "bodies, contacts and loads in another order give the same result",
    because: "round-off: bodies that share a field are summed in another order",
    foreseen: &[],
    make: bodies,
};

/// Another number of threads.
pub static THREADS: Question = Question {
    name: "threads",
    holds: "any number of threads gives the same bits",
    because: "the order of every sum depends on the scene alone",
    foreseen: &[],
    make: threads,
};

/// A body in two parts.
pub static CUT: Question = Question {
    name: "cut",
    holds: "a body that is cut in two along a line of its particles, without contact, moves as one",
    because: "round-off: the same particles share one field, in another order",
    foreseen: &[],
    make: cut,
};

fn bodies(dice: &mut Dice) -> Trial {
    let allowed = crowd::CrowdChoices {
        jumps: false,
        ..crowd::ALL
    };
    let scene = crowd::scene(dice, allowed);
    let mut other = scene.clone();
    let turn = dice.whole(0, scene.bodies.len() - 1);
    other.bodies.rotate_left(turn);
    if dice.chance(0.5) {
        other.bodies.reverse();
    }
    other.contacts.reverse();
    other.materials.reverse();
    for body in &mut other.bodies {
        body.material = scene.materials.len() - 1 - body.material;
    }
    Trial {
        judge: compare::same(&scene, Frame::SAME, Units::SAME, ROUND_OFF),
        runs: vec![scene.into(), other.into()],
    }
}

fn threads(dice: &mut Dice) -> Trial {
    let threads = dice.pick(&[2, 3, 5]);
    let scene = crowd::scene(dice, crowd::ALL);
    let again = Run {
        scene: scene.clone(),
        threads,
        to_rest: false,
    };
    Trial {
        runs: vec![scene.into(), again],
        judge: compare::equal(),
    }
}

fn cut(dice: &mut Dice) -> Trial {
    let allowed = crowd::CrowdChoices {
        jumps: false,
        ..crowd::ALL
    };
    let mut scene = crowd::scene(dice, allowed);
    // Parts share a field with each other and with all others.
    scene.contacts.clear();
    let index = dice.whole(0, scene.bodies.len() - 1);
    let axis = dice.whole(0, scene.dimension.axes() - 1);
    // A body that begins on a line of sub-cells and is whole numbers of them long is filled as its parts are.
    let particles = scene.bodies[index].particles_per_cell[axis] as f64;
    let spacing = scene.mesh.cell[axis] / particles;
    let origin = scene.mesh.origin[axis];
    let line = |x: f64| origin + ((x - origin) / spacing).round() * spacing;
    let Shape::Cuboid { p1, p2 } = &mut scene.bodies[index].shape else {
        unreachable!("a cuboid")
    };
    // At least two rows, however the ends are rounded.
    let rows = ((p2[axis] - p1[axis]) / spacing).round().max(2.0);
    p1[axis] = line(p1[axis]);
    p2[axis] = line(p1[axis] + rows * spacing);
    let rows = rows as usize;
    let at = line(p1[axis] + dice.whole(1, rows - 1) as f64 * spacing);
    let other = parted(&scene, index, axis, at);
    Trial {
        judge: compare::same(&scene, Frame::SAME, Units::SAME, ROUND_OFF),
        runs: vec![scene.into(), other.into()],
    }
}

/// The scene with one of its bodies in two parts, before and beyond a coordinate \[m\].
fn parted(scene: &Scene, index: usize, axis: usize, at: f64) -> Scene {
    let mut other = scene.clone();
    let mut part = other.bodies[index].clone();
    part.id = 1 + scene.bodies.iter().map(|b| b.id).max().unwrap_or(0);
    if let Shape::Cuboid { p1, .. } = &mut part.shape {
        p1[axis] = at;
    }
    if let Shape::Cuboid { p2, .. } = &mut other.bodies[index].shape {
        p2[axis] = at;
    }
    other.bodies.push(part);
    other
}
