//! The column between rollers on a base that shakes along its axis: scene, run, comparison with the images.

use super::{AMPLITUDE, L2, TOP, UPPERMOST, WRONG_STIFFNESS};
use crate::cases::prelude::*;
use crate::exact::base_column::{BaseColumn, CubedSine, SineRecord};

const HEIGHT: f64 = 1.0; // Height of the column [m]
const YOUNG: f64 = 10e6; // Young's modulus [Pa] of the manual's input file
const POISSON: f64 = 0.25; // Poisson's ratio
const DENSITY: f64 = 2500.0; // Density [kg/m³]
/// End of the comparison \[s\].
pub const END: f64 = 0.2;
const WIDTH: usize = 2; // Cells across the column. The answer does not vary across it
const AIR: usize = 2; // Empty cells above the column
/// Interval of the record \[s\]; linear between rows, it is off by (2 pi f interval)²/8 = 4e-7 at 15 Hz.
const INTERVAL: f64 = 2e-5;
const SAMPLES: u64 = 400; // Number of times, about, at which velocities are compared

/// The manual's sine at 15 Hz, close enough to the first resonance (17.3 Hz) to amplify 4.8 times; its acceleration jumps at the
/// start.
const fn sine(amplitude: f64) -> SineRecord {
    SineRecord {
        amplitude,
        frequency: 15.0,
        phase: PI,
    }
}

/// A smooth start. Its two frequencies, 10 and 30 Hz, keep clear of the resonances 17.3 and 52 Hz.
const fn cubed_sine(amplitude: f64) -> CubedSine {
    CubedSine {
        amplitude,
        frequency: 10.0,
    }
}

/// Motion of the base along the column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaking {
    /// Amplitude \[m/s\].
    pub amplitude: f64,
    /// True for the start without a jump.
    pub smooth: bool,
}

impl Shaking {
    fn velocity(&self, t: f64) -> f64 {
        if self.smooth {
            cubed_sine(self.amplitude).velocity(t)
        } else {
            sine(self.amplitude).velocity(t)
        }
    }

    fn acceleration(&self, t: f64) -> f64 {
        if self.smooth {
            cubed_sine(self.amplitude).acceleration(t)
        } else {
            sine(self.amplitude).acceleration(t)
        }
    }
}

/// A column to be run.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Two (plane strain) or three dimensions; the answer is the same.
    pub dimension: Dimension,
    /// Cell size h \[m\].
    pub cell: f64,
    /// Motion of the base.
    pub shaking: Shaking,
    /// Method, time step and particles per cell.
    pub settings: Settings,
}

impl Column {
    /// Wave speed under confined compression \[m/s\], for the stiffness times `factor`.
    fn wave_speed(factor: f64) -> f64 {
        p_wave_speed(factor * YOUNG, POISSON, DENSITY)
    }

    /// The exact column, whose stiffness is `stiffness` times that of the scene.
    fn exact(stiffness: f64) -> BaseColumn {
        BaseColumn {
            height: HEIGHT,
            wave_speed: Self::wave_speed(stiffness),
            density: DENSITY,
        }
    }

    /// Axis of the column: the last one.
    fn axis(&self) -> usize {
        self.dimension.axes() - 1
    }

    /// Constant time step \[s\] with which a velocity, half a step before the positions, falls on [`END`].
    fn time_step(&self) -> (f64, u64) {
        let most = self.settings.courant_or_automatic() * self.cell / Self::wave_speed(1.0);
        let steps = (END / most + 0.5).ceil();
        (END / (steps - 0.5), steps as u64)
    }

    /// The scene.
    pub fn scene(&self) -> Scene {
        let (h, axis) = (self.cell, self.axis());
        let mut number = [WIDTH; 3];
        number[axis] = cells(HEIGHT, h) + AIR;
        let mut mesh = Mesh::new(self.dimension, [0.0; 3], [h; 3], number);
        mesh.planes[axis][1] = PlaneCondition::Free;
        let (dt, steps) = self.time_step();
        let mut scene = bare_scene("shaken_column", self.dimension, mesh, steps as f64 * dt);
        scene.time_step = TimeStep::Fixed {
            dt,
            allow_unstable: self.settings.allow_unstable,
        };
        scene.materials = elastic(DENSITY, YOUNG, POISSON);
        let mut upper = [WIDTH as f64 * h; 3];
        upper[axis] = HEIGHT;
        if self.dimension == Dimension::Two {
            upper[2] = 0.0;
        }
        scene.bodies = vec![body("column", 1, cuboid([0.0; 3], upper))];
        let rows = (scene.time / INTERVAL).ceil() as usize + 1;
        let times: Vec<f64> = (0..=rows).map(|row| row as f64 * INTERVAL).collect();
        let along = |&t: &f64| {
            let mut a = [0.0; 3];
            a[axis] = self.shaking.acceleration(t);
            a
        };
        let values = times.iter().map(along).collect();
        let motion = Motion::Acceleration(History { times, values });
        scene.base_motion = Some(BaseMotion {
            axis,
            side: 0,
            motion,
        });
        self.settings.apply(&mut scene);
        scene
    }

    /// The column in three dimensions as other solvers can run it, against a column whose stiffness is `stiffness` times
    /// that of the scene.
    pub fn guest(&self, stiffness: f64) -> Guest {
        let column = Self {
            dimension: Dimension::Three,
            ..*self
        };
        let mut scene = column.scene();
        scene.time = END;
        let step = guest::COURANT * self.cell / Self::wave_speed(1.0);
        let exact = Self::exact(stiffness);
        let shaking = self.shaking;
        let moved =
            move |x: &Vector, t| [0.0, 0.0, exact.velocity(x[2], t, |t| shaking.velocity(t))];
        Guest {
            compared: ComparedField::Velocity,
            ..Guest::new(guest::prepared(scene, guest::FRAMES, step), moved)
        }
    }

    /// Runs to [`END`] and compares with the exact response.
    ///
    /// # Errors
    /// If a step fails.
    pub fn run(&self, run: Run<'_>) -> Result<Measurements, Failure> {
        let (simulation, observer) = (run.simulation, run.observer);
        let (_, steps) = self.time_step();
        let every = (steps / SAMPLES).max(1);
        let exact = Self::exact(run.reference.of(&WRONG_STIFFNESS));
        let at = |z: f64, t: f64| exact.velocity(z, t, |t| self.shaking.velocity(t));
        let mut samples = vec![];
        observer.phase(Phase::Stepping);
        while simulation.steps() < steps {
            step(simulation, simulation.scene().time, observer)?;
            if (steps - simulation.steps()).is_multiple_of(every) {
                observer.phase(Phase::Comparing);
                let t = simulation.velocity_time();
                for [z, v, volume] in self.particles(simulation)? {
                    samples.push((volume, [v], [at(z, t)]));
                }
                observer.progress(simulation.steps() as f64 / steps as f64);
                observer.phase(Phase::Stepping);
            }
        }
        observer.phase(Phase::Comparing);
        let (t, a, particles) = (
            simulation.velocity_time(),
            self.shaking.amplitude,
            self.particles(simulation)?,
        );
        let layer = |depth: f64| {
            let near = |z: f64| (HEIGHT - z - depth).abs() < 0.1 * self.cell;
            let own = particles.iter().filter(|[z, ..]| near(*z));
            let (count, sum) = own.fold((0.0, 0.0), |(n, sum), [_, v, _]| (n + 1.0, sum + v));
            sum / count
        };
        let depth = 0.5 * self.cell / self.settings.particles_per_cell as f64;
        let (first, second) = (layer(depth), layer(3.0 * depth));
        // The stress at the top is zero, so v = v(H) - b (H - z)², and the second layer is three times as deep as the first.
        let top = first + (first - second) / 8.0;
        // Over the amplitude of the base, and scaled to that of the manual.
        let velocity = |name, found: f64, exact: f64| Quantity {
            value: AMPLITUDE * (found / a),
            exact: Some(AMPLITUDE * (exact / a)),
            ..Quantity::compared(name, found / a, exact / a, "m/s")
        };
        let quantities = [
            velocity(TOP, top, at(HEIGHT, t)),
            velocity(UPPERMOST, first, at(HEIGHT - depth, t)),
            ratio(L2, relative_l2(samples)),
            ratio(STRESS, self.stress_error(simulation, &exact)),
        ];
        let points = particles.iter();
        let points = points.map(|&[z, v, _]| CurvePoint::new(z, v / a, at(z, t) / a));
        let mut points: Vec<CurvePoint> = points.collect();
        CurvePoint::one_per_place(&mut points, 0.1 * self.cell);
        let title = format!("velocity over the column at {END} s, h = {} m", self.cell);
        Ok(Measurements::of(quantities).drawn(Curve::new(title, ["z (m)", "v / A"], points)))
    }

    /// Relative L2 error of the stress along the column now.
    fn stress_error(&self, simulation: &Simulation, exact: &BaseColumn) -> Option<f64> {
        let (axis, t) = (self.axis(), simulation.time());
        l2(simulation, |p, x| {
            let s = exact.stress(x[axis], t, |t| self.shaking.velocity(t));
            Some(([simulation.sets()[0].stress(p)[axis]], [s]))
        })
    }

    /// Initial height (m), velocity along the column (m/s) and volume (m³) of the particles.
    fn particles(&self, simulation: &Simulation) -> Result<Vec<[f64; 3]>, Failure> {
        let (set, axis) = (&simulation.sets()[0], self.axis());
        (0..set.len())
            .map(|p| {
                let z = simulation.initial_position(0, p)?[axis];
                Some([z, set.velocity(p)[axis], simulation.particle_volume(0, p)])
            })
            .collect::<Option<_>>()
            .ok_or_else(|| "the simulation kept no initial positions".into())
    }
}
