//! The manual's own check: the particles at the base of its shaken block follow the record.

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
        let mut scene = bare_scene(
            "base_acceleration",
            Dimension::Three,
            mesh,
            record.intervals as f64 * record.interval,
        );
        scene.time_step = TimeStep::Fixed {
            dt: self.dt,
            allow_unstable: false,
        };
        scene.materials = material("elastic_1", 2500.0, elastic_law(self.young, 0.25));
        let far = self.corner + WIDTH;
        scene.bodies = vec![body(
            "columns_1",
            1,
            cuboid([self.corner, self.corner, 0.0], [far, far, self.height]),
        )];
        let motion = Motion::Acceleration(accelerogram(&record));
        scene.base_motion = Some(BaseMotion {
            axis: 2,
            side: 0,
            motion,
        });
        scene
    }
}

/// Deviation of the velocities at the base from the record, over its amplitude, at the worst time of the worst axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distance {
    /// Velocity of the field at the base plane: extrapolated from the means of the two lowest layers.
    pub plane: f64,
    /// Velocity of the mean of the lowest particles, h/4 above the base.
    pub lowest: f64,
}

/// Runs the whole record; `frequency` times that of the record is the reference (1 for the right one).
///
/// # Errors
/// If a step fails.
pub fn run(
    simulation: &mut Simulation,
    frequency: f64,
    observer: &mut dyn Observer,
) -> Result<Distance, Failure> {
    let record = Harmonic::of_the_manual();
    let end = simulation.scene().time;
    let mut worst = Distance::default();
    while simulation.velocity_time() + 1e-9 < end {
        observer.phase(Phase::Stepping);
        step(simulation, end, observer)?;
        observer.phase(Phase::Comparing);
        let t = simulation.velocity_time();
        if t > end {
            break;
        }
        let (first, second) = layers(simulation)?;
        for axis in 0..2 {
            let exact = SineRecord {
                amplitude: record.amplitude,
                frequency: frequency * record.frequency[axis],
                phase: record.phase,
            }
            .velocity(t);
            let plane = first[axis] - 0.5 * (second[axis] - first[axis]);
            let off = |v: f64| (v - exact).abs() / record.amplitude;
            worst.plane = worst.plane.max(off(plane));
            worst.lowest = worst.lowest.max(off(first[axis]));
        }
        if simulation.steps().is_multiple_of(100) {
            observer.progress((t / end).min(1.0));
        }
    }
    Ok(worst)
}

/// Mean velocities (m/s) of the lowest layer of particles and of the one above.
fn layers(simulation: &Simulation) -> Result<([f64; 3], [f64; 3]), Failure> {
    let set = &simulation.sets()[0];
    let mut sums = [[0.0; 4]; 2];
    for p in 0..set.len() {
        let z = simulation
            .initial_position(0, p)
            .ok_or("the simulation kept no initial positions")?[2];
        let layer = (z / (0.5 * CELL)).floor() as usize;
        if let Some(sum) = sums.get_mut(layer) {
            let v = set.velocity(p);
            for axis in 0..3 {
                sum[axis] += v[axis];
            }
            sum[3] += 1.0;
        }
    }
    let [first, second] = sums.map(|s| [s[0] / s[3], s[1] / s[3], s[2] / s[3]]);
    Ok((first, second))
}
