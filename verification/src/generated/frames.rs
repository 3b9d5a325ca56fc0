//! Frames: a scene that is mirrored, turned or shifted gives the mirrored, turned or shifted result.

use super::change::Frame;
use super::dice::Dice;
use super::units::{ROUND_OFF, Units};
use super::{Question, Trial, compare, crowd};

/// A mirror image.
pub static MIRROR: Question = Question {
    name: "mirror",
    holds: "a scene that is mirrored gives the mirrored result",
    because: "round-off of some tens of steps: sums over nodes are formed in another order",
    foreseen: &[],
    make: mirror,
};

/// Axes that are exchanged.
pub static TURN: Question = Question {
    name: "turn",
    holds: "a scene whose axes are turned by a right angle, or exchanged in turn, gives the turned result",
    because: "round-off of some tens of steps: sums over nodes are formed in another order",
    foreseen: &[],
    make: turn,
};

/// A mesh elsewhere.
pub static SHIFT: Question = Question {
    name: "shift",
    holds: "a scene that is shifted with its mesh gives the shifted result",
    because: "round-off of coordinates that are a hundred cells from zero at most",
    foreseen: &[],
    make: shift,
};

fn mirror(dice: &mut Dice) -> Trial {
    asked(dice, |dice, axes| {
        let mut frame = Frame::SAME;
        frame.sign[dice.whole(0, axes - 1)] = -1.0;
        frame
    })
}

fn turn(dice: &mut Dice) -> Trial {
    asked(dice, |dice, axes| {
        let mut frame = Frame::SAME;
        if axes == 3 && dice.chance(0.5) {
            frame.to = dice.pick(&[[1, 2, 0], [2, 0, 1]]);
        } else {
            // A quarter of a turn about an axis: two axes change places, one of them its direction.
            let about = if axes == 2 { 2 } else { dice.whole(0, 2) };
            let (a, b) = ((about + 1) % 3, (about + 2) % 3);
            frame.to[a] = b;
            frame.to[b] = a;
            frame.sign[dice.pick(&[a, b])] = -1.0;
        }
        frame
    })
}

fn shift(dice: &mut Dice) -> Trial {
    asked(dice, |dice, axes| {
        let mut frame = Frame::SAME;
        for axis in 0..axes {
            frame.shift[axis] = dice.between(-1.0, 1.0);
        }
        frame
    })
}

/// A crowd, and the same in a frame whose shift is in units of a hundred cells.
fn asked(dice: &mut Dice, frame: impl Fn(&mut Dice, usize) -> Frame) -> Trial {
    let allowed = crowd::CrowdChoices {
        jumps: false,
        ..crowd::ALL
    };
    let scene = crowd::scene(dice, allowed);
    let mut frame = frame(dice, scene.dimension.axes());
    for axis in 0..3 {
        frame.shift[axis] *= 100.0 * scene.mesh.cell[axis];
    }
    let other = frame.scene(&scene);
    Trial {
        judge: compare::same(&scene, frame, Units::SAME, ROUND_OFF),
        runs: vec![scene.into(), other.into()],
    }
}
