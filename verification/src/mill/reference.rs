//! Load and reference of a run: start, body force and exact values of each particle.

use std::collections::HashMap;
use std::sync::Arc;

use proctor_laws::Law;
use proctor_scene::simulation::{InitialState, Options, SetupError, Simulation};

use super::material::{Kind, divergence};
use super::motion::{Moment, Place, Vector, apply, determinant};
use super::path::{PathEnd, Start, follow};
use super::problem::{Family, Problem};
use crate::exact::jet::Jet;

/// The exact solution at the particles of a rung.
pub struct Reference {
    problem: Problem,
    /// Number of each particle by the bits of its place at the start.
    numbers: HashMap<[u64; 3], usize>,
    places: Vec<Place>,
    /// Moments of the steps; the last is the end.
    moments: Vec<Moment>,
    /// Paths of laws with a memory: Div P \[N/m³\] in each step of each particle, and what they end with.
    followed: Option<(Vec<Vector>, Vec<PathEnd>)>,
    dt: f64,
}

/// Exact values of a particle at the end.
#[derive(Clone, Debug)]
pub struct Exact {
    /// Displacement less that of the centre \[m\].
    pub displacement: Vector,
    /// The part of the displacement that the field makes \[m\].
    pub field: Vector,
    /// Cauchy stress xx, yy, zz, yz, xz, xy \[Pa\].
    pub stress: [f64; 6],
    /// Internal variables.
    pub variables: Vec<f64>,
}

fn bits(x: &Vector) -> [u64; 3] {
    x.map(f64::to_bits)
}

impl Reference {
    /// Reference of a rung with that many cells per metre.
    ///
    /// # Errors
    /// The scene is refused.
    pub fn new(problem: &Problem, cells: usize) -> Result<Self, SetupError> {
        let options = Options {
            displacement: true,
            threads: Some(1),
            ..Options::default()
        };
        let simulation = Simulation::new(&problem.scene(cells), &options)?;
        let sets = simulation.sets().iter().enumerate();
        let starts: Vec<Vector> = sets
            .flat_map(|(s, set)| (0..set.len()).map(move |p| (s, p)))
            .filter_map(|(s, p)| simulation.initial_position(s, p))
            .collect();
        let (dt, steps) = problem.steps(cells);
        let places = starts.iter().map(|x| problem.motion.of(x)).collect();
        Ok(Self::at(problem, &starts, places, dt, steps))
    }

    /// Reference of particles that begin there \[m\], with steps of `dt` \[s\].
    #[must_use]
    pub fn at(
        problem: &Problem,
        starts: &[Vector],
        places: Vec<Place>,
        dt: f64,
        steps: usize,
    ) -> Self {
        let moments = |parts: usize| -> Vec<Moment> {
            let all = 0..=parts * steps;
            all.map(|k| problem.motion.at(k as f64 * dt / parts as f64))
                .collect()
        };
        let remembers = problem.material.kind.remembers();
        let followed = remembers.then(|| follow_all(problem, &places, &moments(2), dt));
        let numbered = starts.iter().enumerate();
        Self {
            problem: problem.clone(),
            numbers: numbered.map(|(number, x)| (bits(x), number)).collect(),
            places,
            moments: moments(1),
            followed,
            dt,
        }
    }

    /// The reason for which a law that yields has no smooth body force here.
    #[must_use]
    pub fn refused(&self) -> Option<&'static str> {
        let (_, ended) = self.followed.as_ref()?;
        let kind = self.problem.material.kind;
        let stops = ended.iter().any(|ended| ended.least_growth <= 0.0);
        let leaves = ended.iter().any(|ended| ended.least_margin <= 0.0);
        if kind.yields() && stops {
            Some("a point stops to yield, so that the body force jumps")
        } else if kind.has_edges() && leaves {
            Some("a stress reaches an edge of the yield surface, so that the body force jumps")
        } else {
            None
        }
    }

    /// Adds start, body force and the displacements that a comparison needs.
    #[must_use]
    pub fn options(self: &Arc<Self>, options: Options) -> Options {
        let (start, force) = (Arc::clone(self), Arc::clone(self));
        Options {
            displacement: true,
            initial: Some(Arc::new(move |x| start.start(x))),
            body_force: Some(Arc::new(move |x0, _, t| force.force(x0, t))),
            ..options
        }
    }

    fn start(&self, x: &Vector) -> InitialState {
        let place = self.problem.motion.of(x);
        let moment = &self.moments[0];
        let axes = self.problem.axes();
        let [_, mut velocity, _] = moment.motion(&place);
        let mut rate = moment.rate(&place);
        let stress = if self.followed.is_some() {
            self.problem.material.stress
        } else {
            self.stress(&place, moment)
        };
        for i in axes..3 {
            velocity[i] = 0.0;
            rate[i] = [0.0; 3];
        }
        InitialState {
            velocity,
            velocity_gradient: rate,
            stress,
            ..InitialState::default()
        }
    }

    /// b = x'' - Div P/rho_0 \[m/s²\] of the particle that began at `x0`; not a number for another place or another time.
    fn force(&self, x0: &Vector, t: f64) -> Vector {
        let step = (t / self.dt).round() as usize;
        let (Some(&number), Some(moment)) = (self.numbers.get(&bits(x0)), self.moments.get(step))
        else {
            return [f64::NAN; 3];
        };
        let [_, _, acceleration] = moment.motion(&self.places[number]);
        let force = self.stress_force(number, step);
        let axes = self.problem.axes();
        std::array::from_fn(|i| {
            if i < axes {
                acceleration[i] - force[i] / self.problem.material.density
            } else {
                0.0
            }
        })
    }

    /// Div P of a particle in a step \[N/m³\].
    #[must_use]
    pub fn stress_force(&self, number: usize, step: usize) -> Vector {
        let (place, moment) = (&self.places[number], &self.moments[step]);
        match &self.followed {
            Some((forces, _)) => forces[number * self.moments.len() + step],
            None if self.problem.axes() == 2 => self.force_of::<2>(place, moment),
            None => self.force_of::<3>(place, moment),
        }
    }

    /// Div P of a law without memory \[N/m³\].
    fn force_of<const D: usize>(&self, place: &Place, moment: &Moment) -> Vector {
        let f = moment.deformation_jet::<D>(place);
        let rate = moment.rate_jet::<D>(place);
        let kirchhoff = self.problem.material.kirchhoff::<Jet<D>, D>(&f, &rate);
        divergence::<D>(&kirchhoff, &f)
    }

    /// Cauchy stress xx, yy, zz, yz, xz, xy \[Pa\] of a law without memory.
    fn stress(&self, place: &Place, moment: &Moment) -> [f64; 6] {
        let (f, rate) = (moment.deformation(place), moment.rate(place));
        let tau = self.problem.material.kirchhoff::<f64, 3>(&f, &rate);
        let jacobian = determinant(&f);
        let of = |i: usize, j: usize| tau[i][j] / jacobian;
        [of(0, 0), of(1, 1), of(2, 2), of(1, 2), of(0, 2), of(0, 1)]
    }

    /// Exact values at the end of the particle that began there.
    #[must_use]
    pub fn end(&self, x0: &Vector) -> Option<Exact> {
        let number = *self.numbers.get(&bits(x0))?;
        let (place, moment) = (&self.places[number], self.moments.last()?);
        let [x, ..] = moment.motion(place);
        let field = apply(&moment.frame[0], &place.field).map(|w| moment.pulse[0] * w);
        let (stress, variables) = if let Some((_, ended)) = &self.followed {
            (ended[number].stress, ended[number].variables.clone())
        } else {
            (self.stress(place, moment), vec![])
        };
        Some(Exact {
            displacement: std::array::from_fn(|i| x[i] - place.from_center[i]),
            field,
            stress,
            variables,
        })
    }
}

/// Follows all particles of a law with a memory.
fn follow_all(
    problem: &Problem,
    places: &[Place],
    moments: &[Moment],
    dt: f64,
) -> (Vec<Vector>, Vec<PathEnd>) {
    let material = &problem.material;
    match material.kind {
        Kind::VonMises => of_law(problem, &material.von_mises(), 1, places, moments, dt),
        Kind::DruckerPrager => of_law(problem, &material.drucker_prager(), 1, places, moments, dt),
        Kind::Tresca => of_law(problem, &material.tresca(), 1, places, moments, dt),
        Kind::MohrCoulomb => of_law(problem, &material.mohr_coulomb(), 1, places, moments, dt),
        Kind::Bingham => of_law(problem, &material.bingham(), 1, places, moments, dt),
        _ => {
            let law = proctor_laws::LinearElastic::new(material.young, material.poisson);
            of_law(problem, &law, 2, places, moments, dt)
        }
    }
}

fn of_law<M: Law>(
    problem: &Problem,
    law: &M,
    order: u32,
    places: &[Place],
    moments: &[Moment],
    dt: f64,
) -> (Vec<Vector>, Vec<PathEnd>) {
    let start = Start {
        law,
        order,
        density: problem.material.density,
        stress: problem.material.stress,
    };
    let each = moments.len() / 2 + 1;
    if problem.family == Family::Affine {
        return of_uniform(&start, problem.axes(), places, moments, dt);
    }
    let mut forces = vec![[0.0; 3]; each * places.len()];
    let ended = (places.iter().zip(forces.chunks_mut(each)))
        .map(|(place, forces)| {
            let at = |step: usize, force| forces[step] = force;
            if problem.axes() == 2 {
                follow::<M, 2>(&start, place, moments, dt, at)
            } else {
                follow::<M, 3>(&start, place, moments, dt, at)
            }
        })
        .collect();
    (forces, ended)
}

/// The same where all places have one deformation: no stress has a force.
fn of_uniform<M: Law>(
    start: &Start<'_, M>,
    axes: usize,
    places: &[Place],
    moments: &[Moment],
    dt: f64,
) -> (Vec<Vector>, Vec<PathEnd>) {
    let each = moments.len() / 2 + 1;
    let ended = if axes == 2 {
        follow::<M, 2>(start, &places[0], moments, dt, |_, _| ())
    } else {
        follow::<M, 3>(start, &places[0], moments, dt, |_, _| ())
    };
    (
        vec![[0.0; 3]; each * places.len()],
        vec![ended; places.len()],
    )
}
