//! The manual's own check: the particles at the base of its shaken block follow the record.

use super::{BASE, LOWEST, WRONG_FREQUENCY};
use crate::cases::prelude::*;
use crate::exact::base_column::SineRecord;
use proctor_files::records::{Harmonic, accelerogram};

/// Cell size \[m\].
pub const CELL: f64 = 0.1;
const WIDTH: f64 = 0.3; // Width of the block along x and y [m]
/// Empty cells on every side. The base travels 0.19 m and the top of the soft block further.
const AIR: usize = 5;

/// Reading where the manual's text and its input file differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Height \[m\].
    pub height: f64,
    /// Lower corner along x and y \[m\].
    pub corner: f64,
    /// Time step \[s\].
    pub dt: f64,
}

impl Block {
    /// The problem as written in the text.
    pub const TEXT: Self = Self {
        young: 100e6,
        height: 0.8,
        corner: 0.4,
        dt: 1e-4,
    };
    /// The problem as printed in the input file.
    pub const INPUT: Self = Self {
        young: 10e6,
        height: 1.0,
        corner: 0.2,
        dt: 5e-4,
    };

    /// The scene, on a mesh wide enough for the whole motion.
    pub fn scene(&self) -> Scene {
        let margin = AIR as f64 * CELL;
        let across = (WIDTH / CELL).round() as usize + 2 * AIR;
        let up = (self.height / CELL).round() as usize + AIR;
        let origin = [self.corner - margin, self.corner - margin, 0.0];
        let mesh = Mesh::new(Dimension::Three, origin, [CELL; 3], [across, across, up]);
        let record = Harmonic::of_the_manual();
        let end = record.intervals as f64 * record.interval;
        let mut scene = bare_scene("base_acceleration", Dimension::Three, mesh, end);
        scene.time_step = equal_steps_of(self.dt);
        scene.materials = material("elastic_1", 2500.0, elastic_law(self.young, 0.25));
        let [near, far] = [self.corner, self.corner + WIDTH];
        let block = cuboid([near, near, 0.0], [far, far, self.height]);
        scene.bodies = vec![body("columns_1", 1, block)];
        let motion = Motion::Acceleration(accelerogram(&record));
        scene.base_motion = Some(BaseMotion {
            axis: 2,
            side: 0,
            motion,
        });
        scene
    }
}

/// Runs the whole record: how far the velocities at the base are from it, over its amplitude, at the worst time of the worst axis.
/// At the plane they are extrapolated from the means of the two lowest layers; the lowest particles are h/4 above it.
///
/// # Errors
/// If a step fails.
pub fn run(run: Run<'_>) -> Result<Measurements, Failure> {
    let (simulation, observer) = (run.simulation, run.observer);
    let record = Harmonic::of_the_manual();
    let end = simulation.scene().time;
    let (mut at_plane, mut at_lowest) = (0.0_f64, 0.0_f64);
    while simulation.velocity_time() + 1e-9 < end {
        observer.phase(Phase::Stepping);
        step(simulation, end, observer)?;
        observer.phase(Phase::Comparing);
        let t = simulation.velocity_time();
        if t > end {
            break;
        }
        let [first, second] = layers(simulation)?;
        for axis in 0..2 {
            let exact = SineRecord {
                amplitude: record.amplitude,
                frequency: run.reference.of(&WRONG_FREQUENCY) * record.frequency[axis],
                phase: record.phase,
            }
            .velocity(t);
            let plane = first[axis] - 0.5 * (second[axis] - first[axis]);
            let off = |v: f64| (v - exact).abs() / record.amplitude;
            at_plane = at_plane.max(off(plane));
            at_lowest = at_lowest.max(off(first[axis]));
        }
        if simulation.steps().is_multiple_of(100) {
            observer.progress((t / end).min(1.0));
        }
    }
    Ok(Measurements::of([
        Quantity::of_zero(BASE, at_plane),
        Quantity::of_zero(LOWEST, at_lowest),
    ]))
}

/// Mean velocities (m/s) of the lowest layer of particles and of the one above.
fn layers(simulation: &Simulation) -> Result<[[f64; 3]; 2], Failure> {
    let set = &simulation.sets()[0];
    let mut sums = [[0.0; 4]; 2];
    for p in 0..set.len() {
        let start = simulation.initial_position(0, p);
        let z = start.ok_or("the simulation kept no initial positions")?[2];
        if let Some(sum) = sums.get_mut((z / (0.5 * CELL)).floor() as usize) {
            let [x, y, z] = set.velocity(p);
            let counted = [x, y, z, 1.0];
            *sum = std::array::from_fn(|i| sum[i] + counted[i]);
        }
    }
    Ok(sums.map(|s| [s[0] / s[3], s[1] / s[3], s[2] / s[3]]))
}
