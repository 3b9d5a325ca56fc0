//! One step of the kernel as a linear map of velocities and stresses, with particles that stay where they are.

use proctor_kernel::layout::Layout;
use proctor_scene::simulation::{Options, SavedState, Simulation};
use proctor_scene::{Damping, InitialStress, Mortar, PlaneCondition, Scene, TimeStep};

use super::StabilityError;
use crate::cases::{NO_RESULTS, elastic_law};

/// Size of the velocities over that of waves. So small that a position plus its way, and 1 plus a strain, are what they
/// were: a step is linear in the state bit by bit. Its square is far from the smallest number all the same.
const AMPLITUDE: f64 = 1e-20;

/// Memory of each particle from one step to the next, apart from its place: velocities with their affine part, and stresses.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Velocities over the wave speed, and affine velocities times cell over wave speed.
    pub motion: Vec<f64>,
    /// Stresses over density times the square of the wave speed.
    pub stress: Vec<f64>,
}

/// A body, or several, at rest and without stress, of which steps are taken as a linear map.
pub struct LinearMotion {
    simulation: Simulation,
    rest: SavedState,
    /// Cell over wave speed \[s\]: the unit of time.
    unit: f64,
    motion: Vec<Column>,
    stress: Vec<Column>,
}

/// A column of a body that is part of the state.
#[derive(Clone, Copy)]
struct Column {
    body: usize,
    index: usize,
    /// One unit of the state in the unit of the column.
    unit: f64,
}

impl LinearMotion {
    /// The linear part of a scene at its start: bodies at rest without stress, each of the linear elastic law that its
    /// own law is at rest; mesh, planes, held nodes and method as they are; no loads, no damping, no contact.
    ///
    /// # Errors
    /// A scene that is refused.
    pub fn new(scene: &Scene) -> Result<Self, StabilityError> {
        let scene = linear_part(scene);
        let options = Options {
            threads: Some(1),
            ..Options::default()
        };
        let simulation = scene.simulate(&options)?;
        let mut rest = simulation.save();
        let (cell, wave_speed) = (smallest_cell(&scene), fastest_wave(&scene));
        let unit = cell / wave_speed;
        rest.state.clock.step = 1;
        let (mut motion, mut stress) = (vec![], vec![]);
        for (body, (set, given)) in simulation.sets().iter().zip(&scene.bodies).enumerate() {
            let layout = &set.layout;
            let material = &scene.materials[given.material];
            let modulus = material.density * wave_speed * wave_speed;
            for axis in 0..layout.axes {
                motion.push(Column {
                    body,
                    index: Layout::velocity(layout.axes) + axis,
                    unit: AMPLITUDE * wave_speed,
                });
            }
            for i in 0..layout.affine.map_or(0, |_| layout.axes * layout.axes) {
                motion.push(Column {
                    body,
                    index: layout.affine.unwrap_or(0) + i,
                    unit: AMPLITUDE * wave_speed / cell,
                });
            }
            for i in 0..layout.stress_components() {
                stress.push(Column {
                    body,
                    index: Layout::stress(layout.axes) + i,
                    unit: AMPLITUDE * modulus,
                });
            }
        }
        for column in motion.iter().chain(&stress) {
            rest.state.sets[column.body].columns[column.index].fill(0.0);
        }
        Ok(Self {
            simulation,
            rest,
            unit,
            motion,
            stress,
        })
    }

    /// Cell over wave speed \[s\], in which steps are counted.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The simulation, for places and names of particles.
    #[must_use]
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Number of values of motion and of stress.
    #[must_use]
    pub fn sizes(&self) -> [usize; 2] {
        [&self.motion, &self.stress].map(|columns| {
            let of = |column: &Column| self.rest.state.sets[column.body].id.len();
            columns.iter().map(of).sum()
        })
    }

    /// The state after a step of so many units of time.
    ///
    /// # Errors
    /// A step that fails.
    pub fn step(&mut self, state: &State, units: f64) -> Result<State, StabilityError> {
        let mut before = self.rest.clone();
        let dt = units * self.unit;
        before.state.clock.dt_before = dt;
        write(&self.motion, &state.motion, &mut before);
        write(&self.stress, &state.stress, &mut before);
        self.simulation.restore(before)?;
        self.simulation.step(dt)?;
        Ok(State {
            motion: read(&self.motion, &self.simulation),
            stress: read(&self.stress, &self.simulation),
        })
    }

    /// The particle of each value of stress: its set, and its number there.
    pub fn particles_of_stress(&self) -> impl Iterator<Item = (usize, usize)> {
        let of = |column: &Column| {
            let body = column.body;
            (0..self.rest.state.sets[body].id.len()).map(move |p| (body, p))
        };
        self.stress.iter().flat_map(of)
    }
}

fn write(columns: &[Column], values: &[f64], saved: &mut SavedState) {
    let mut rest = values;
    for column in columns {
        let slots = &mut saved.state.sets[column.body].columns[column.index];
        let (own, others) = rest.split_at(slots.len());
        rest = others;
        for (slot, value) in slots.iter_mut().zip(own) {
            *slot = column.unit * value;
        }
    }
}

fn read(columns: &[Column], simulation: &Simulation) -> Vec<f64> {
    let mut values = vec![];
    for column in columns {
        let found = &simulation.sets()[column.body].columns[column.index];
        values.extend(found.iter().map(|value| value / column.unit));
    }
    values
}

/// Smallest edge of a cell \[m\].
#[must_use]
pub fn smallest_cell(scene: &Scene) -> f64 {
    let axes = scene.dimension.axes();
    scene.mesh.cell[..axes]
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min)
}

/// Speed of the fastest wave at rest in any body \[m/s\].
#[must_use]
pub fn fastest_wave(scene: &Scene) -> f64 {
    let of = |body: &proctor_scene::Body| {
        let material = &scene.materials[body.material];
        material.law.wave_speed(material.density)
    };
    scene.bodies.iter().map(of).fold(0.0, f64::max)
}

/// The scene that has the same linear step at rest, and nothing else.
fn linear_part(scene: &Scene) -> Scene {
    let mut part = scene.clone();
    for material in &mut part.materials {
        let (young, speed) = (
            material.law.young(),
            material.law.wave_speed(material.density),
        );
        let confined = material.density * speed * speed;
        material.law = elastic_law(young, poisson(young / confined));
    }
    for body in &mut part.bodies {
        body.velocity = [0.0; 3];
        // The stress of ground at rest refers to gravity, which is taken away below.
        body.initial_stress = InitialStress::None;
        if let Some(motion) = &mut body.motion {
            motion.values.fill([0.0; 3]);
        }
    }
    if let Some(base) = part.base_motion.take() {
        part.mesh.planes[base.axis][base.side] = PlaneCondition::Fixed;
    }
    part.gravity = [0.0; 3];
    part.damping = Damping::None;
    part.surfaces.clear();
    part.point_loads.clear();
    part.tractions.clear();
    part.box_loads.clear();
    part.standing_waters.clear();
    part.contacts.clear();
    part.mortar = Mortar::default();
    part.results = NO_RESULTS;
    part.probes.clear();
    // A step of any length can then be asked for by its end.
    part.time_step = TimeStep::Multiplier {
        multiplier: 1e6,
        allow_unstable: true,
    };
    part
}

/// Poisson's ratio of Young's modulus over that of confined compression, E/M = (1+nu)(1-2nu)/(1-nu).
#[must_use]
pub fn poisson(ratio: f64) -> f64 {
    // 2 nu² + (1 - r) nu + (r - 1) = 0; the root between -1 and 1/2 that is 0 for r = 1.
    let b = 1.0 - ratio;
    0.25 * ((b * b + 8.0 * b).max(0.0).sqrt() - b)
}
