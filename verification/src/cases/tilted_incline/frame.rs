//! The tilted plane as an STL text, and the block on it as particles.

use super::{HEIGHT, LENGTH, TILT};
use crate::cases::prelude::*;
use libm::{cos, sin};
use std::fmt::Write as _;

const TURN: f64 = 33.0; // Angle between its fall and the x axis where it is turned [degrees]
const WIDTH: f64 = 1.0; // Width of the block where the plane is turned [m]; else one cell
const ROOM: f64 = 10.6; // Way that the mesh leaves [m]; without friction it is 10 m

/// The plane with the block on it: directions and where they begin.
pub struct Frame {
    /// Unit vectors down the plane, across it and out of it.
    pub down: Vector,
    pub across: Vector,
    pub out: Vector,
    /// Lower rear corner of the block.
    pub corner: Vector,
    /// Width of the block.
    pub width: f64,
    /// Cells of the mesh.
    pub cells: [usize; 3],
}

impl Frame {
    /// Frame for cells of `h` (m).
    pub fn new(h: f64, turned: bool) -> Self {
        let tilt = TILT.to_radians();
        let turn = if turned { TURN.to_radians() } else { 0.0 };
        let mut frame = Self {
            down: [cos(tilt) * cos(turn), cos(tilt) * sin(turn), -sin(tilt)],
            across: [-sin(turn), cos(turn), 0.0],
            out: [sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt)],
            corner: [0.0; 3],
            width: if turned { WIDTH } else { h },
            cells: [1; 3],
        };
        let ways = [-0.5, ROOM + LENGTH];
        let outs = [0.0, HEIGHT + 2.0 * h];
        let corners: Vec<Vector> = ways
            .iter()
            .flat_map(|&way| [0.0, frame.width].map(|side| (way, side)))
            .flat_map(|(way, side)| outs.map(|out| frame.at(way, side, out)))
            .collect();
        for axis in 0..3 {
            let along = || corners.iter().map(|x| x[axis]);
            let low = along().fold(f64::INFINITY, f64::min);
            let high = along().fold(f64::NEG_INFINITY, f64::max);
            if axis == 1 && !turned {
                continue;
            }
            // Off the nodes, by numbers that no cell size divides.
            let room = 2.0 * h + [0.0137, 0.0071, 0.0113][axis];
            frame.corner[axis] = room - low;
            frame.cells[axis] = ((high - low + 2.0 * room) / h).ceil() as usize;
        }
        frame
    }

    /// A point by its way down the plane, its way across and its height over the plane \[m\].
    fn at(&self, way: f64, side: f64, height: f64) -> Vector {
        std::array::from_fn(|axis| {
            self.corner[axis]
                + way * self.down[axis]
                + side * self.across[axis]
                + height * self.out[axis]
        })
    }

    /// The plane as an STL text, cut into triangles of different shapes.
    pub fn stl(&self) -> String {
        let ways = [-1.0, 0.7, 2.9, 3.3, 7.1, ROOM + LENGTH + 1.0];
        let sides = [-1.0, 0.4 * self.width, self.width + 1.0];
        let mut text = String::from("solid incline\n");
        let mut facet = |corners: [Vector; 3]| {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in corners {
                // Writing to a String cannot fail.
                let _ = writeln!(text, "vertex {x:e} {y:e} {z:e}");
            }
            text.push_str("endloop\nendfacet\n");
        };
        for way in ways.windows(2) {
            for side in sides.windows(2) {
                let [a, b] =
                    [side[0], side[1]].map(|s| [way[0], way[1]].map(|w| self.at(w, s, 0.0)));
                facet([a[0], a[1], b[1]]);
                facet([a[0], b[1], b[0]]);
            }
        }
        text.push_str("endsolid incline\n");
        text
    }

    /// Particles of the block, two per cell and axis, in rows parallel to the plane.
    pub fn seeds(&self, h: f64, per_cell: usize) -> Vec<ParticleSeed> {
        let step = h / per_cell as f64;
        let count = |length: f64| (length / step).round() as usize;
        let center = |i: usize| (i as f64 + 0.5) * step;
        let mut seeds = vec![];
        for i in 0..count(LENGTH) {
            for j in 0..count(self.width) {
                for k in 0..count(HEIGHT) {
                    seeds.push(ParticleSeed {
                        position: self.at(center(i), center(j), center(k)),
                        volume: step.powi(3),
                    });
                }
            }
        }
        seeds
    }
}
