//! The particles of a run at its start and at its end.

use proctor_scene::Vector;
use proctor_scene::simulation::Simulation;

/// A particle of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Particle {
    /// Identifier of its body.
    pub body: i64,
    /// Its own identifier.
    pub id: u64,
    /// Position at the start \[m\].
    pub start: Vector,
    /// Velocity at the start \[m/s\].
    pub start_velocity: Vector,
    /// Stress at the start: xx, yy, zz, yz, xz, xy \[Pa\].
    pub start_stress: [f64; 6],
    /// Mass at the start \[kg\].
    pub start_mass: f64,
    /// Position \[m\].
    pub position: Vector,
    /// Velocity \[m/s\].
    pub velocity: Vector,
    /// Cauchy stress: xx, yy, zz, yz, xz, xy \[Pa\].
    pub stress: [f64; 6],
    /// Mass \[kg\].
    pub mass: f64,
    /// Affine velocity, `[a][b]` = dv_a/dx_b \[1/s\]; zero where the transfer carries none.
    pub affine: [[f64; 3]; 3],
}

/// The particles and the end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct FinalState {
    /// Particles by body and identifier.
    pub particles: Vec<Particle>,
    /// Number of steps.
    pub steps: u64,
    /// Time of the end \[s\].
    pub time: f64,
    /// Kinds of cautions at the end of a run to rest, as words.
    pub cautions: Vec<&'static str>,
}

impl FinalState {
    /// The particles of a simulation that has not begun.
    #[must_use]
    pub fn start(simulation: &Simulation) -> Self {
        let mut particles = vec![];
        for (index, set) in simulation.sets().iter().enumerate() {
            let body = simulation.body(index).id;
            particles.extend((0..set.len()).map(|p| {
                let position = simulation.position(index, p);
                let mass = simulation.particle_mass(index, p);
                Particle {
                    body,
                    id: set.id[p],
                    start: position,
                    start_velocity: set.velocity(p),
                    start_stress: set.stress(p),
                    start_mass: mass,
                    position,
                    velocity: set.velocity(p),
                    stress: set.stress(p),
                    mass,
                    affine: [[0.0; 3]; 3],
                }
            }));
        }
        particles.sort_by_key(|particle| (particle.body, particle.id));
        Self {
            particles,
            steps: 0,
            time: 0.0,
            cautions: vec![],
        }
    }

    /// The same particles at the end of the run; those that left are not a number.
    #[must_use]
    pub fn end(mut self, simulation: &Simulation) -> Self {
        let mut now = Self::start(simulation).particles.into_iter().peekable();
        for particle in &mut self.particles {
            let own = (particle.body, particle.id);
            match now.next_if(|now| (now.body, now.id) == own) {
                Some(now) => {
                    particle.position = now.position;
                    particle.velocity = now.velocity;
                    particle.stress = now.stress;
                    particle.mass = now.mass;
                }
                None => particle.position = [f64::NAN; 3],
            }
        }
        self.steps = simulation.steps();
        self.time = simulation.time();
        self.affine(simulation);
        self
    }

    fn affine(&mut self, simulation: &Simulation) {
        for (index, set) in simulation.sets().iter().enumerate() {
            let Some(first) = set.layout.affine else {
                continue;
            };
            let (body, axes) = (simulation.body(index).id, set.layout.axes);
            for p in 0..set.len() {
                let own = (body, set.id[p]);
                let found = (self.particles).binary_search_by_key(&own, |q| (q.body, q.id));
                let Ok(found) = found else { continue };
                for a in 0..axes {
                    for b in 0..axes {
                        let column = &set.columns[first + a * axes + b];
                        self.particles[found].affine[a][b] = column[p];
                    }
                }
            }
        }
    }

    /// The particles of a body.
    pub fn of(&self, body: i64) -> impl Iterator<Item = &Particle> {
        self.particles.iter().filter(move |p| p.body == body)
    }

    /// Largest speed along an axis at the start or the end \[m/s\].
    #[must_use]
    pub fn fastest(&self) -> f64 {
        let both = |p: &Particle| largest(p.velocity.into_iter().chain(p.start_velocity));
        largest(self.particles.iter().map(both))
    }

    /// Sum of mass times speed over axes and particles, the scale of round-off of a momentum \[kg m/s\].
    #[must_use]
    pub fn momentum_scale(&self) -> f64 {
        let of = |p: &Particle| {
            let speed = |v: &Vector| v.iter().map(|c| c.abs()).sum::<f64>();
            p.mass * speed(&p.velocity).max(speed(&p.start_velocity))
        };
        self.particles.iter().map(of).sum()
    }
}

/// Largest magnitude; infinite where there is something that is not a number.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            value.abs().max(most)
        }
    })
}
