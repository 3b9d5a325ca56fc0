//! A body of finite elements in motion.

use super::barrier::Barrier;
use super::indenter::Indenter;
use super::material::NeoHookean;
use super::mesh::Mesh;
use thiserror::Error;

/// Share of the critical time step that is taken. The step is bounded from the sizes of the elements as they are
/// when it is chosen; the rest is for what they may shrink before it is chosen again.
const SAFETY: f64 = 0.6;
/// Abscissa of the Gauss points on (-1, 1), 1/sqrt 3.
pub(super) const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Gradients of the shape functions at a Gauss point in the initial configuration, and its initial volume per thickness.
#[derive(Clone, Copy, Debug)]
struct GaussPoint {
    gradients: [[f64; 2]; 4],
    volume: f64,
}

/// Reason for which a body could not be moved on.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("element {element} turned inside out at {time} s")]
pub struct Failure {
    /// The element that turned inside out.
    pub element: usize,
    /// Time \[s\].
    pub time: f64,
}

/// A body, of 1 m thickness, with the loads of the problems that it serves: gravity, viscous damping, and a barrier against
/// its own mirror image behind the plane x = 0 or against an indenter.
#[derive(Clone, Debug)]
pub struct Model {
    /// The mesh as it was.
    pub mesh: Mesh,
    /// Positions of the nodes \[m\].
    pub positions: Vec<[f64; 2]>,
    /// Velocities of the nodes, half a step before the positions once it moves \[m/s\].
    pub velocities: Vec<[f64; 2]>,
    /// Masses of the nodes \[kg\].
    pub masses: Vec<f64>,
    /// True for components of the positions that are held.
    pub held: Vec<[bool; 2]>,
    /// Acceleration of gravity \[m/s²\].
    pub gravity: [f64; 2],
    /// Barrier against the mirror image, which lies at positive x, from the outer edges; the gap is twice the distance
    /// from the plane.
    pub mirror: Option<Barrier>,
    /// Indenter that presses on the outer edges.
    pub indenter: Option<Indenter>,
    /// Rate of viscous damping, a force of -rate m v \[1/s\].
    pub damping: f64,
    material: NeoHookean,
    points: Vec<[GaussPoint; 4]>,
    forces: Vec<[f64; 2]>,
    time: f64,
    /// The step that led to the present positions; 0 at the start.
    before: f64,
    strain_energy: f64,
    barrier_energy: f64,
    barrier_force: f64,
    indenter_force: [f64; 2],
}

impl Model {
    /// A body at rest and free.
    ///
    /// # Errors
    /// [`Failure`] if an element of the mesh is inside out.
    pub fn new(mesh: Mesh, material: NeoHookean) -> Result<Self, Failure> {
        let count = mesh.nodes.len();
        let mut masses = vec![0.0; count];
        let mut points = vec![];
        for (element, nodes) in mesh.elements.iter().enumerate() {
            let corners = nodes.map(|n| mesh.nodes[n]);
            let own = gauss_points(corners).ok_or(Failure { element, time: 0.0 })?;
            for (point, shape) in own.iter().zip(shapes()) {
                for (n, share) in nodes.iter().zip(shape) {
                    masses[*n] += material.density * point.volume * share;
                }
            }
            points.push(own);
        }
        let mut model = Self {
            positions: mesh.nodes.clone(),
            velocities: vec![[0.0; 2]; count],
            masses,
            held: vec![[false; 2]; count],
            gravity: [0.0; 2],
            mirror: None,
            indenter: None,
            damping: 0.0,
            material,
            points,
            forces: vec![[0.0; 2]; count],
            time: 0.0,
            before: 0.0,
            strain_energy: 0.0,
            barrier_energy: 0.0,
            barrier_force: 0.0,
            indenter_force: [0.0; 2],
            mesh,
        };
        model.compute_forces()?;
        Ok(model)
    }

    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Stored energy of the material \[J\].
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        self.strain_energy
    }

    /// This body's half of the energy of the barrier \[J\].
    #[must_use]
    pub fn barrier_energy(&self) -> f64 {
        self.barrier_energy
    }

    /// Force with which the mirror image pushes, along -x \[N\].
    #[must_use]
    pub fn barrier_force(&self) -> f64 {
        self.barrier_force
    }

    /// Force of the body on the indenter \[N\].
    #[must_use]
    pub fn indenter_force(&self) -> [f64; 2] {
        self.indenter_force
    }

    /// Forces on the nodes from stress, gravity and contact at the present positions \[N\].
    #[must_use]
    pub fn forces(&self) -> &[[f64; 2]] {
        &self.forces
    }

    /// Kinetic energy at the time of the positions \[J\], of a body without damping.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        let half = 0.5 * self.before;
        let mut sum = 0.0;
        for n in 0..self.masses.len() {
            let m = self.masses[n];
            for axis in 0..2 {
                if !self.held[n][axis] {
                    let v = self.velocities[n][axis] + half * self.forces[n][axis] / m;
                    sum += 0.5 * m * v * v;
                }
            }
        }
        sum
    }

    /// Potential energy of gravity \[J\], zero at the initial positions.
    #[must_use]
    pub fn weight_energy(&self) -> f64 {
        let mut sum = 0.0;
        for (n, m) in self.masses.iter().enumerate() {
            for axis in 0..2 {
                sum -=
                    m * self.gravity[axis] * (self.positions[n][axis] - self.mesh.nodes[n][axis]);
            }
        }
        sum
    }

    /// Moves on to a time \[s\] in equal steps no longer than the elements and the barrier allow now.
    ///
    /// # Errors
    /// [`Failure`] if an element turns inside out.
    pub fn advance_to(&mut self, time: f64) -> Result<(), Failure> {
        if self.before == 0.0 {
            // Loads and velocities were set since the body was made.
            self.compute_forces()?;
        }
        let left = time - self.time;
        let steps = (left / self.time_step() * (1.0 - 1e-12)).ceil().max(1.0);
        let dt = left / steps;
        for _ in 0..steps as u64 {
            let kick = 0.5 * (self.before + dt);
            // The velocity that damping acts on is the mean of those half a step before and after.
            let lost = 0.5 * kick * self.damping;
            for n in 0..self.masses.len() {
                let inverse = kick / self.masses[n];
                for axis in 0..2 {
                    if !self.held[n][axis] {
                        let pushed = inverse * self.forces[n][axis];
                        let velocity = &mut self.velocities[n][axis];
                        *velocity = (*velocity * (1.0 - lost) + pushed) / (1.0 + lost);
                        self.positions[n][axis] += dt * self.velocities[n][axis];
                    }
                }
            }
            self.time += dt;
            self.before = dt;
            self.compute_forces()?;
        }
        self.time = time;
        Ok(())
    }

    /// Time step \[s\] from the elements, SAFETY times the transit time of the smallest height, and from the barrier,
    /// SAFETY times 2/omega of the lightest node against its stiffest state.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        let at = |n: usize| self.positions[n];
        let mut smallest = f64::INFINITY;
        for nodes in &self.mesh.elements {
            let [a, b, c, d] = nodes.map(at);
            let area = 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]));
            let longest = [(a, b), (b, c), (c, d), (d, a)]
                .map(|(p, q)| libm::hypot(q[0] - p[0], q[1] - p[1]))
                .into_iter()
                .fold(0.0, f64::max);
            smallest = smallest.min(area.max(0.0) / longest);
        }
        // A square element with lumped mass has omega = 2 sqrt(2) c/h at most.
        let mut dt = std::f64::consts::FRAC_1_SQRT_2 * smallest / self.material.wave_speed();
        // The floor bounds the slope; the gap to the mirror image closes twice as fast as the body moves.
        let mirror = self.mirror.map_or(0.0, |barrier| 2.0 * barrier.at(0.0).2);
        let indenter = self.indenter.map_or(0.0, |i| i.barrier.at(0.0).2);
        let slope = mirror.max(indenter);
        if slope > 0.0 {
            for [a, b] in &self.mesh.outer {
                let (p, q) = (at(*a), at(*b));
                let length = libm::hypot(q[0] - p[0], q[1] - p[1]);
                let lightest = self.masses[*a].min(self.masses[*b]);
                dt = dt.min(2.0 * (lightest / (slope * length)).sqrt());
            }
        }
        SAFETY * dt
    }

    /// Forces and stored energies at the present positions.
    fn compute_forces(&mut self) -> Result<(), Failure> {
        for (force, m) in self.forces.iter_mut().zip(&self.masses) {
            *force = self.gravity.map(|g| m * g);
        }
        self.strain_energy = 0.0;
        for (element, (nodes, points)) in self.mesh.elements.iter().zip(&self.points).enumerate() {
            let x = nodes.map(|n| self.positions[n]);
            let mut own = [[0.0; 2]; 4];
            for point in points {
                let mut f = [[0.0; 2]; 2];
                for (x_a, gradient) in x.iter().zip(&point.gradients) {
                    for i in 0..2 {
                        for j in 0..2 {
                            f[i][j] += x_a[i] * gradient[j];
                        }
                    }
                }
                let Some((stress, energy)) = self.material.stress_and_energy(f) else {
                    return Err(Failure {
                        element,
                        time: self.time,
                    });
                };
                self.strain_energy += energy * point.volume;
                for (force, gradient) in own.iter_mut().zip(&point.gradients) {
                    for i in 0..2 {
                        force[i] -= point.volume
                            * (stress[i][0] * gradient[0] + stress[i][1] * gradient[1]);
                    }
                }
            }
            for (n, force) in nodes.iter().zip(own) {
                self.forces[*n][0] += force[0];
                self.forces[*n][1] += force[1];
            }
        }
        self.push_from_mirror();
        self.push_from_indenter();
        Ok(())
    }

    fn push_from_indenter(&mut self) {
        self.indenter_force = [0.0; 2];
        let Some(indenter) = self.indenter else {
            return;
        };
        for &ends in &self.mesh.outer {
            let forces = indenter.push(self.time, ends.map(|n| self.positions[n]));
            for (n, force) in ends.iter().zip(forces) {
                for axis in 0..2 {
                    self.forces[*n][axis] += force[axis];
                    self.indenter_force[axis] -= force[axis];
                }
            }
        }
    }

    /// Adds the barrier: its energy is half the integral of B(-2 x) dy over the outer edges, the other half being the
    /// mirror image's. The derivative of that sum, with Gauss points on the edges, is a pressure on the surface as it
    /// stands; so energy is kept whatever the mesh.
    fn push_from_mirror(&mut self) {
        self.barrier_energy = 0.0;
        self.barrier_force = 0.0;
        let Some(barrier) = self.mirror else { return };
        for &[a, b] in &self.mesh.outer {
            let (p, q) = (self.positions[a], self.positions[b]);
            if -2.0 * p[0].max(q[0]) >= barrier.critical_gap {
                continue;
            }
            let rise = q[1] - p[1];
            for s in [0.5 - 0.5 * GAUSS, 0.5 + 0.5 * GAUSS] {
                let x = p[0] + s * (q[0] - p[0]);
                let (energy, pressure, _) = barrier.at(-2.0 * x);
                let (push, lift) = (0.5 * pressure * rise, 0.25 * energy);
                self.barrier_energy += lift * rise;
                self.barrier_force += push;
                self.forces[a][0] -= (1.0 - s) * push;
                self.forces[b][0] -= s * push;
                self.forces[a][1] += lift;
                self.forces[b][1] -= lift;
            }
        }
    }
}

/// Values of the shape functions at the Gauss points.
fn shapes() -> [[f64; 4]; 4] {
    corners().map(|[xi, eta]| {
        corners()
            .map(|[s, t]| 0.25 * (1.0 + GAUSS * xi.signum() * s) * (1.0 + GAUSS * eta.signum() * t))
    })
}

/// Corners of the square (-1, 1)², counter-clockwise.
fn corners() -> [[f64; 2]; 4] {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
}

/// Gauss points of an element, or `None` if it is inside out.
fn gauss_points(x: [[f64; 2]; 4]) -> Option<[GaussPoint; 4]> {
    let mut points = [GaussPoint {
        gradients: [[0.0; 2]; 4],
        volume: 0.0,
    }; 4];
    for (point, at) in points.iter_mut().zip(corners()) {
        let [xi, eta] = at.map(|c| c * GAUSS);
        let local = corners().map(|[s, t]| [0.25 * s * (1.0 + eta * t), 0.25 * t * (1.0 + xi * s)]);
        let mut jacobian = [[0.0; 2]; 2];
        for (x_a, derivative) in x.iter().zip(&local) {
            for i in 0..2 {
                for j in 0..2 {
                    jacobian[i][j] += x_a[i] * derivative[j];
                }
            }
        }
        let [[a, b], [c, d]] = jacobian;
        let determinant = a * d - b * c;
        if determinant.is_nan() || determinant <= 0.0 {
            return None;
        }
        point.volume = determinant;
        point.gradients =
            local.map(|[s, t]| [(s * d - t * c) / determinant, (t * a - s * b) / determinant]);
    }
    Some(points)
}
