//! The sums over a run of the grains, step by step.

use super::apart::{self, Polyline, Room};
use super::{FLOOR, GAP, PLATE, SPEED, WALLS};
use crate::cases::prelude::*;
use crate::cases::vocabulary::incline::fitted_slope;

const SAMPLES: usize = 245; // Samples of a run

pub(super) const INSIDE: &str = "largest number of vertices inside another grain";
pub(super) const BEYOND: &str = "largest number of vertices beyond plate, floor or wall";
pub(super) const SMALLEST: &str = "smallest distance between two, over the critical gap";
pub(super) const MOMENTUM: &str = "unaccounted momentum over the impulse of the plate";
pub(super) const BALANCE: &str =
    "force of plate minus floor and damping over that of the plate in the last tenth";
pub(super) const GAINED: &str = "largest energy beyond the plate's work, over that work";
pub(super) const FLOOR_SHARE: &str = "floor over plate, last tenth";
pub(super) const PHASES: &str = "slope of the plate's force in the last tenth over the first half";
pub(super) const LOADED: &str = "way of the plate when the floor is first loaded";
pub(super) const SIDEWAYS: &str =
    "mean horizontal force on the plate over the largest vertical one";
pub(super) const LARGEST: &str = "largest force on the plate";

/// Sums so far.
#[derive(Debug, Default)]
pub(super) struct Watch {
    /// Impulses of plate, floor and walls, and of the damping so far \[N s\].
    plate: [f64; 2],
    others: [f64; 2],
    damping: [f64; 2],
    /// Work of the plate \[J\], and the most energy that was there beyond it.
    work: f64,
    gained: f64,
    pub(super) samples: Vec<Sample>,
    /// Most vertices inside another grain, and beyond a side of the container, of any step.
    inside: usize,
    beyond: usize,
    /// Smallest distance of any sample \[m\].
    smallest: f64,
    /// Way of the plate at the first force on the floor \[m\].
    loaded: Option<f64>,
    /// Drawings of all bodies at the start, in the middle and at the end.
    pub(super) drawings: Vec<Drawing>,
}

/// Way of the plate \[m\], and means since the sample before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sample {
    pub(super) way: f64,
    /// Forces on the grains from plate, floor and damping \[N\].
    pub(super) plate: [f64; 2],
    floor: f64,
    damping: f64,
}

impl Watch {
    /// Runs to the end. `rate` is the damping force over the momentum \[1/s\].
    pub(super) fn run(
        simulation: &mut Simulation,
        rate: f64,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Self, String> {
        let mut watch = Self {
            smallest: f64::INFINITY,
            ..Self::default()
        };
        let end = simulation.scene().time;
        let mut dt_before = 0.0;
        watch.drawings.push(drawing(simulation));
        for k in 1..=SAMPLES {
            let time = end * k as f64 / SAMPLES as f64;
            let mut mean = Sample::default();
            let mut span = 0.0;
            while simulation.time() < time {
                let p = simulation.momentum();
                let info = simulation.step(time).map_err(|e| e.to_string())?;
                // A step changes velocities over the mean of the steps that it joins.
                let kick = 0.5 * (dt_before + info.dt);
                dt_before = info.dt;
                let force = |id| simulation.mortar_force(id).unwrap_or([f64::NAN; 3]);
                let (plate, floor) = (force(PLATE), force(FLOOR));
                let [left, right] = WALLS.map(force);
                for axis in 0..2 {
                    watch.plate[axis] -= kick * plate[axis];
                    watch.others[axis] -= kick * (floor[axis] + left[axis] + right[axis]);
                    watch.damping[axis] -= kick * rate * p[axis];
                    mean.plate[axis] -= kick * plate[axis];
                }
                mean.floor -= kick * floor[1];
                mean.damping -= kick * rate * p[1];
                span += kick;
                watch.work += info.dt * SPEED * plate[1];
                if floor[1] != 0.0 && watch.loaded.is_none() {
                    watch.loaded = Some(SPEED * simulation.time());
                }
                let (grains, room) = places(simulation)?;
                watch.inside = watch.inside.max(apart::inside(&grains));
                watch.beyond = watch.beyond.max(apart::beyond(&grains, &room));
            }
            progress(k as f64 / SAMPLES as f64);
            watch.samples.push(Sample {
                way: SPEED * simulation.time(),
                plate: mean.plate.map(|f| f / span),
                floor: mean.floor / span,
                damping: mean.damping / span,
            });
            let stored = simulation.strain_energy() + simulation.mortar_energy();
            let energy = simulation.kinetic_energy() + stored;
            watch.gained = watch.gained.max(energy - watch.work);
            let (grains, room) = places(simulation)?;
            watch.smallest = watch.smallest.min(apart::smallest(&grains, &room, GAP));
            if k == SAMPLES / 2 || k == SAMPLES {
                watch.drawings.push(drawing(simulation));
            }
        }
        Ok(watch)
    }

    /// Quantities that follow from the sums.
    pub(super) fn quantities(&self, simulation: &Simulation) -> Vec<Quantity> {
        let p = simulation.momentum();
        let left: [f64; 2] = std::array::from_fn(|axis| {
            p[axis] - self.plate[axis] - self.others[axis] - self.damping[axis]
        });
        let (all, tenth) = (&self.samples[..], self.samples.len() / 10);
        let (half, last) = (&all[..all.len() / 2], &all[all.len() - tenth..]);
        let mean = |of: fn(&Sample) -> f64| last.iter().map(of).sum::<f64>() / tenth as f64;
        // Forces on the grains: the plate pushes down, floor and damping up.
        let plate = -mean(|s| s.plate[1]);
        let (floor, damping) = (mean(|s| s.floor), mean(|s| s.damping));
        let largest = all.iter().map(|s| -s.plate[1]).fold(0.0, f64::max);
        let sideways = all.iter().map(|s| s.plate[0]).sum::<f64>() / all.len() as f64;
        let unaccounted = libm::hypot(left[0], left[1]) / self.plate[1].abs();
        let (balance, figure) = (Quantity::balance, Quantity::figure);
        vec![
            balance(INSIDE, self.inside as f64, "1"),
            balance(BEYOND, self.beyond as f64, "1"),
            balance(MOMENTUM, unaccounted, "1"),
            balance(BALANCE, (plate - floor - damping).abs() / plate, "1"),
            balance(GAINED, self.gained / self.work, "1"),
            figure(SMALLEST, self.smallest / GAP, "1"),
            figure(FLOOR_SHARE, floor / plate, "1"),
            figure(PHASES, slope(last) / slope(half), "1"),
            figure(LOADED, self.loaded.unwrap_or(f64::NAN), "m"),
            figure(SIDEWAYS, sideways.abs() / largest, "1"),
            figure(LARGEST, largest, "N"),
        ]
    }
}

/// Slope of the plate's force over its way \[N/m\], by least squares.
fn slope(samples: &[Sample]) -> f64 {
    let points = samples.iter().map(|s| [s.way, -s.plate[1]]);
    fitted_slope(&points.collect::<Vec<_>>())
}

/// Grains, and the room between the rigid lines, as they are now.
fn places(simulation: &Simulation) -> Result<(Vec<Polyline>, Room), String> {
    let of = |id| {
        let found = simulation.boundary_vertices(id);
        found.ok_or_else(|| format!("boundary {id} is lost"))
    };
    // All lines are straight and along an axis.
    let line = |id, axis: usize| Ok::<_, String>(of(id)?.first().map_or(f64::NAN, |x| x[axis]));
    let grains = (1..=simulation.sets().len() as i64).map(of);
    let room = Room {
        x: [line(WALLS[0], 0)?, line(WALLS[1], 0)?],
        y: [line(FLOOR, 1)?, line(PLATE, 1)?],
    };
    Ok((grains.collect::<Result<_, _>>()?, room))
}

/// Grains, plate, floor and walls as they are now.
fn drawing(simulation: &Simulation) -> Drawing {
    let of = |id| {
        let vertices = simulation.boundary_vertices(id)?;
        Some(vertices.iter().map(|x| [x[0], x[1]]).collect())
    };
    let (name, time) = (&simulation.scene().name, simulation.time());
    let grains = 1..=simulation.sets().len() as i64;
    let lines = [PLATE, FLOOR, WALLS[0], WALLS[1]].into_iter();
    Drawing {
        title: format!("{name}: grains at t = {time:.1} s"),
        bodies: grains.filter_map(of).collect(),
        lines: lines.filter_map(of).collect(),
    }
}
