//! Run-out and height of bodies that flow: where all but a small part of the mass lies.

use super::run::LETTERS;
use proctor_scene::simulation::Simulation;

/// Part of the mass that lies within an extent. The last particles are drops and grains that follow chance.
const PART: f64 = 0.995;

/// Bodies that flow, and the axis along which they fall.
pub struct Extents {
    /// Bodies by their place, with their identifiers.
    bodies: Vec<(usize, i64)>,
    /// Axis of gravity and the side to which it points, -1 or 1.
    down: Option<(usize, f64)>,
    axes: usize,
}

impl Extents {
    /// Extent of the bodies of a simulation whose law yields or is a fluid, where there is gravity.
    #[must_use]
    pub fn new(simulation: &Simulation) -> Self {
        let scene = simulation.scene();
        let axes = scene.dimension.axes();
        let strongest = (0..axes).max_by(|a, b| {
            let [a, b] = [a, b].map(|axis| scene.gravity[*axis].abs());
            a.total_cmp(&b)
        });
        let down = strongest
            .map(|axis| (axis, scene.gravity[axis].signum()))
            .filter(|(axis, _)| scene.gravity[*axis] != 0.0);
        let flows = |place: &usize| {
            let body = &scene.bodies[*place];
            let law = &scene.materials[body.material].law;
            body.motion.is_none() && (law.yields() || law.is_fluid())
        };
        let bodies = (0..scene.bodies.len()).filter(flows);
        Self {
            bodies: bodies
                .filter(|_| down.is_some())
                .map(|place| (place, simulation.body(place).id))
                .collect(),
            down,
            axes,
        }
    }

    /// Axes and sides of the extents of a body: both sides of each axis across gravity, and the upper one along it.
    fn sides(&self) -> impl Iterator<Item = (usize, f64)> {
        let down = self.down;
        (0..self.axes).flat_map(move |axis| match down {
            Some((vertical, sign)) if axis == vertical => vec![(axis, -sign)],
            _ => vec![(axis, 1.0), (axis, -1.0)],
        })
    }

    /// Names of the columns: `body1_front_x` and `body1_back_x` across gravity, `body1_height` along it.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let of = |id: i64| {
            self.sides().map(move |(axis, side)| match self.down {
                Some((vertical, _)) if axis == vertical => format!("body{id}_height"),
                _ if side > 0.0 => format!("body{id}_front_{}", LETTERS[axis]),
                _ => format!("body{id}_back_{}", LETTERS[axis]),
            })
        };
        self.bodies.iter().flat_map(|(_, id)| of(*id)).collect()
    }

    /// Coordinates \[m\] within which 99.5 % of the mass of a body lies, seen from the other side.
    #[must_use]
    pub fn values(&self, simulation: &Simulation) -> Vec<f64> {
        let of = |set: usize| {
            self.sides().map(move |(axis, side)| {
                let particles = 0..simulation.sets()[set].len();
                let masses = particles.map(|p| {
                    let mass = simulation.particle_mass(set, p);
                    (side * simulation.position(set, p)[axis], mass)
                });
                side * within(masses.collect(), PART)
            })
        };
        self.bodies.iter().flat_map(|(set, _)| of(*set)).collect()
    }
}

/// The coordinate \[m\] below which this part of the mass lies, linear between the middles of particles, each a coordinate
/// \[m\] and a mass \[kg\]; not a number where there is none.
#[must_use]
pub fn within(mut masses: Vec<(f64, f64)>, part: f64) -> f64 {
    masses.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let wanted = part * masses.iter().map(|(_, mass)| mass).sum::<f64>();
    let mut sum = 0.0;
    let mut before: Option<(f64, f64)> = None;
    for (x, mass) in masses {
        let middle = sum + 0.5 * mass;
        if middle >= wanted {
            return match before {
                Some((x_0, m_0)) => x_0 + (x - x_0) * (wanted - m_0) / (middle - m_0),
                None => x,
            };
        }
        sum += mass;
        before = Some((x, middle));
    }
    before.map_or(f64::NAN, |(x, _)| x)
}
