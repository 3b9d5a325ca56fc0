//! A block on a rigid line, by mortar contact in the plane.

use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::law::NormalLaw;
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::{
    BodyBoundary, Damping, Dimension, Enforcement, MortarContact, RigidLine, StressScheme, Vertices,
};

use super::change::Frame;
use super::column::{self, Column, Layer};
use super::dice::Dice;
use super::seen::FinalState;
use super::{Deviation, Question, Run, Trial, pressed};

/// A block on a line.
pub static LINE: Question = Question {
    name: "line",
    holds: "a block that is pressed on a rigid line by mortar contact carries the pressure in every row",
    because: "10 % in the first three rows at the line, 2 % elsewhere, wherever the line lies in its cell",
    foreseen: &[pressed::ROWS_OF_SPLINES, "to and fro"],
    make: line,
};

/// Critical gap over a cell.
const GAP: f64 = 0.1;
/// Gap at which the barrier has the pressure, over the critical one: the block begins where it rests.
const RESTS: f64 = 0.6;
/// Largest error of rows away from the line, over the pressure.
const ROWS: f64 = 0.02;
/// Largest error of the first three rows.
const FIRST: f64 = 0.1;
/// Cells below the load in which it is felt as what it is.
const FELT: f64 = 2.5;

/// Vertices that go by nodes. A plan warns of the other ways, whose rows at the line are off.
const FOLLOWS: [FollowMode; 3] = [FollowMode::Spin, FollowMode::Velocity, FollowMode::Gradient];

fn line(dice: &mut Dice) -> Trial {
    let layer = Layer {
        height: dice.between(6.5, 9.0),
        stiffness: 1.0,
        density: 1.0,
    };
    let below = 2.0 + dice.place();
    let mut column = Column::new(dice, Dimension::Two, below, &[layer], 0);
    let scene = &mut column.scene;
    // Mortar contact with USF is refused.
    if scene.scheme == StressScheme::Usf {
        scene.scheme = StressScheme::Musl;
    }
    let (pressure, load) = column.press(dice);
    let (h, face) = (column.h(), column.faces[0]);
    let critical = GAP * h;
    let stiffness = pressure / NormalLaw::barrier(1.0, critical).pressure(RESTS * critical);
    // The barrier is a spring below the block: the time to rest is that of both.
    let barrier = NormalLaw::barrier(stiffness, critical);
    let (near, far) = (0.99 * RESTS * critical, 1.01 * RESTS * critical);
    let spring = (barrier.pressure(near) - barrier.pressure(far)) / (far - near);
    let mass = column.scene.materials[0].density * (column.top() - face);
    let slowest = (1.0 / (column.frequency * column.frequency) + mass / spring).sqrt();
    column.scene.damping = Damping::Local { alpha: 0.7 };
    column.scene.time = 40.0 * slowest;
    let mesh = column.scene.mesh.clone();
    let (left, right) = (mesh.origin[0] - h, mesh.upper()[0] + h);
    let level = face - RESTS * critical;
    let mortar = &mut column.scene.mortar;
    mortar.lines.push(RigidLine {
        name: "line".to_owned(),
        id: 9,
        chains: vec![Chain {
            points: vec![Point::new(right, level), Point::new(left, level)],
            side: BoundarySide::Open,
        }],
        motion: None,
    });
    mortar.boundaries.push(BodyBoundary {
        body: 1,
        vertices: Vertices::Spacing(dice.pick(&[0.5, 0.3, 1.0]) * h),
        follow: dice.pick(&FOLLOWS),
    });
    mortar.contacts.push(MortarContact {
        name: "contact".to_owned(),
        id: 1,
        master: 9,
        slave: 1,
        friction: 0.0,
        critical_gap: critical,
        normal_stiffness: stiffness,
        tangential_stiffness: 0.0,
        enforcement: Enforcement::Barrier,
        detection: Detection::Mortar,
    });
    // The lines of its particles are no wider than the layer over their count.
    let particles = column.scene.bodies[0].particles_per_cell[1] as f64;
    let row = h / particles;
    let judge = Box::new(move |seen: &[FinalState]| {
        let [seen] = seen else { return vec![] };
        let rows = |first: bool| {
            column::off(seen, &Frame::SAME, 1, |z, _| {
                (z < load - FELT * h && (z < face + 3.0 * row) == first)
                    .then_some((-pressure, pressure))
            })
        };
        vec![
            Deviation::new("stress of a row over the pressure", rows(false), ROWS),
            Deviation::new(
                "stress of the first rows over the pressure",
                rows(true),
                FIRST,
            ),
        ]
    });
    Trial {
        runs: vec![Run::to_rest(column.scene)],
        judge,
    }
}
