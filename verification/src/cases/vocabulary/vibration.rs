//! Vibration of a body in one of its modes: the frequency of its amplitude.

use crate::cases::prelude::*;

/// A mode in which a body was set in motion.
pub struct Vibration<'a> {
    /// Exact frequency \[Hz\].
    pub frequency: f64,
    /// Velocity of the mode at the start, where its shape is one \[m/s\].
    pub speed: f64,
    /// Shape of the mode at a place \[m\].
    pub shape: &'a dyn Fn(Vector) -> Vector,
}

impl Vibration<'_> {
    /// Runs to the end of the scene: the frequency under the name of the quantity, beside the exact one, and the amplitude in time.
    ///
    /// # Errors
    /// If a step fails, or the amplitude has not three zeros.
    pub fn compare(&self, run: Run<'_>, quantity: &'static str) -> Result<Measurements, Failure> {
        let end = run.simulation.scene().time;
        let mut samples: Vec<(f64, f64)> = vec![];
        let mut keep = |simulation: &Simulation| {
            samples.push((simulation.time(), self.amplitude(simulation)));
        };
        run_until(run.simulation, end, run.observer, &mut keep)?;
        // Velocities are half a step before the time, at each zero alike.
        let zeros: Vec<f64> = (samples.windows(2))
            .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
            .map(|pair| {
                let [(t, a), (u, b)] = [pair[0], pair[1]];
                t + (u - t) * a / (a - b)
            })
            .collect();
        let [first, _, third] = zeros[..] else {
            return Err(format!("{} zeros of the velocity, not three", zeros.len()).into());
        };
        let exact = |t: f64| libm::cos(TAU * self.frequency * t);
        let points = samples.iter();
        let points = points.map(|&(t, found)| CurvePoint::new(t, found, exact(t)));
        let curve = Curve::new(
            format!("amplitude of the mode, {}", run.rung.label),
            ["t (s)", "velocity over that at the start"],
            points,
        );
        let frequency = Quantity::compared(quantity, 1.0 / (third - first), self.frequency, "Hz");
        Ok(Measurements::of([frequency]).drawn(curve))
    }

    /// The share of the mode in the velocities, over that of the start.
    fn amplitude(&self, simulation: &Simulation) -> f64 {
        let set = &simulation.sets()[0];
        let (mut sum, mut norm) = (0.0, 0.0);
        for p in 0..set.len() {
            let shape = (self.shape)(simulation.position(0, p));
            let (mass, velocity) = (simulation.particle_mass(0, p), set.velocity(p));
            for axis in 0..2 {
                sum += mass * shape[axis] * velocity[axis];
                norm += mass * shape[axis] * shape[axis];
            }
        }
        sum / norm / self.speed
    }
}
