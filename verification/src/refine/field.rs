//! Fields on several meshes: differences at the particles of the coarsest one, by where particles were at the start.

use super::point::{fit, reach};
use super::rule::{Estimate, Rule};
use proctor_scene::Vector;
use proctor_scene::simulation::Simulation;
use std::collections::HashMap;

/// A field that is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Displacement \[m\].
    Displacement,
    /// Velocity \[m/s\].
    Velocity,
    /// Stress \[Pa\]. Its bars hold too seldom to be claimed: of order 0.5 at fronts and point loads.
    Stress,
}

impl Field {
    /// Every field.
    pub const ALL: [Self; 3] = [Self::Displacement, Self::Velocity, Self::Stress];

    /// Its word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Velocity => "velocity",
            Self::Stress => "stress",
        }
    }

    /// Its unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Displacement => "m",
            Self::Velocity => "m/s",
            Self::Stress => "Pa",
        }
    }

    /// True where a bar of it is claimed.
    #[must_use]
    pub const fn claims(self) -> bool {
        !matches!(self, Self::Stress)
    }

    /// Place of its first component among those of a particle, and their number.
    const fn components(self) -> (usize, usize) {
        match self {
            Self::Displacement => (0, 3),
            Self::Velocity => (3, 3),
            Self::Stress => (6, 6),
        }
    }
}

/// Number of components of all fields of a particle.
const COMPONENTS: usize = 12;

/// The fields of a body at one time.
#[derive(Clone, Debug, PartialEq)]
struct OfBody {
    /// Distance within which particles count for a point \[m\].
    reach: Vector,
    /// Place at the start \[m\], and displacement, velocity and stress.
    particles: Vec<(Vector, [f64; COMPONENTS])>,
}

/// The fields of all bodies at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    axes: usize,
    bodies: Vec<OfBody>,
}

impl Snapshot {
    /// Field of a simulation that keeps its displacements, in order of the particles' identifiers.
    #[must_use]
    pub fn of(simulation: &Simulation) -> Self {
        let of = |index: usize| {
            let set = &simulation.sets()[index];
            let mut order: Vec<usize> = (0..set.len()).collect();
            order.sort_unstable_by_key(|p| set.id[*p]);
            let particles = order.into_iter().filter_map(|p| {
                let at = simulation.initial_position(index, p)?;
                let u = simulation.displacement(index, p)?;
                let (v, s) = (set.velocity(p), set.stress(p));
                Some((
                    at,
                    [
                        u[0], u[1], u[2], v[0], v[1], v[2], s[0], s[1], s[2], s[3], s[4], s[5],
                    ],
                ))
            });
            OfBody {
                reach: reach(simulation.scene(), index),
                particles: particles.collect(),
            }
        };
        Self {
            axes: simulation.plan().axes,
            bodies: (0..simulation.sets().len()).map(of).collect(),
        }
    }

    /// Values of a field at points of each body at the start: a linear fit through the particles around them.
    fn at(&self, points: &[Vec<Vector>]) -> Vec<Vec<Option<[f64; COMPONENTS]>>> {
        let of = |(body, points): (&OfBody, &Vec<Vector>)| {
            let bins = Bins::new(body);
            points
                .iter()
                .map(|x| {
                    let near = bins.near(body, x, self.axes);
                    let places: Vec<Vector> = near.iter().map(|p| body.particles[*p].0).collect();
                    let weights = fit(&places, x, &body.reach, self.axes)?;
                    let mut sum = [0.0; COMPONENTS];
                    for (p, weight) in near.iter().zip(weights) {
                        let values = &body.particles[*p].1;
                        for (sum, value) in sum.iter_mut().zip(values) {
                            *sum += weight * value;
                        }
                    }
                    Some(sum)
                })
                .collect()
        };
        self.bodies.iter().zip(points).map(of).collect()
    }
}

/// Particles of a body by the box of its reach in which they were at the start.
struct Bins {
    boxes: HashMap<[i64; 3], Vec<usize>>,
}

impl Bins {
    fn new(body: &OfBody) -> Self {
        let mut boxes: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        for (p, (at, _)) in body.particles.iter().enumerate() {
            boxes.entry(place(at, &body.reach)).or_default().push(p);
        }
        Self { boxes }
    }

    /// Particles within the reach of a point, in their order.
    fn near(&self, body: &OfBody, x: &Vector, axes: usize) -> Vec<usize> {
        let center = place(x, &body.reach);
        let side = |axis: usize| if axis < axes { -1..=1 } else { 0..=0 };
        let mut near = vec![];
        for i in side(0) {
            for j in side(1) {
                for k in side(2) {
                    let key = [center[0] + i, center[1] + j, center[2] + k];
                    let inside = self.boxes.get(&key).into_iter().flatten().filter(|p| {
                        let at = &body.particles[**p].0;
                        (0..axes).all(|axis| (at[axis] - x[axis]).abs() <= body.reach[axis])
                    });
                    near.extend(inside.copied());
                }
            }
        }
        near.sort_unstable();
        near
    }
}

fn place(x: &Vector, size: &Vector) -> [i64; 3] {
    std::array::from_fn(|axis| libm::floor(x[axis] / size[axis]) as i64)
}

/// Root mean square of a field on the finest of three meshes with cells `h` \[m\], and the bar of its error, over the
/// particles of the coarsest one; `None` where nothing can be compared.
#[must_use]
pub fn compared(field: Field, h: [f64; 3], meshes: [&Snapshot; 3]) -> Option<(f64, Estimate)> {
    let of_body = |body: &OfBody| body.particles.iter().map(|(at, _)| *at).collect();
    let points: Vec<Vec<Vector>> = meshes[0].bodies.iter().map(of_body).collect();
    let [a, b, c] = meshes.map(|mesh| mesh.at(&points));
    let (first, count) = field.components();
    let (mut sums, mut size, mut compared) = ([0.0; 2], 0.0, 0usize);
    let all = a
        .iter()
        .flatten()
        .zip(b.iter().flatten())
        .zip(c.iter().flatten());
    for ((a, b), c) in all {
        let (Some(a), Some(b), Some(c)) = (a, b, c) else {
            continue;
        };
        for k in first..first + count {
            sums[0] += (a[k] - b[k]).powi(2);
            sums[1] += (b[k] - c[k]).powi(2);
            size += c[k] * c[k];
        }
        compared += 1;
    }
    if compared == 0 {
        return None;
    }
    let mean = |sum: f64| (sum / compared as f64).sqrt();
    let size = mean(size);
    Some((size, Rule::NORM.estimate(h, sums.map(mean), size)))
}
