//! The predicted limit: the step at which the linear step of the scene has the eigenvalue -1.
//!
//! Let w be the motion and s the stress of all particles, and write a step of tau as
//!
//!   w' = T w + F s,   s' = s + H w + J s.
//!
//! T does not depend on the step, F and H grow with it, J with its square. A step of dt = a tau has the eigenvalue -1 where
//! -w = T w + a F s and -2 s = a H w + a² J s (the a of F and H taken together in both places), which is
//!
//!   K s = (2/a²) s   with   K = H (1 + T)^-1 F - J.
//!
//! So the largest eigenvalue k of K gives dt = tau sqrt(2/k). With FLIP T = 1; then k = w²/2 for USF and MUSL, which is
//! dt = 2/w with the frequency of the projected motion, and k = (2 w_g² - w_s²)/2 for USL, with that of the grid and the
//! projected one. APIC, TPIC and a share of PIC have a T with eigenvalues from 0 to 1. Nothing else is unstable before: a
//! pair of complex eigenvalues leaves the unit circle at -1, as long as T and the stiffness are symmetric in mass and
//! energy, and `tests/stability` asks each method whether that is so.

use proctor_scene::{Scene, Vector};

use super::StabilityError;
use super::arnoldi::{dot, largest};
use super::frozen::{LinearMotion, State};

/// Vectors that are kept at most in the search for the eigenvalue.
const MOST_VECTORS: usize = 120;
/// Memory that these vectors may take \[B\].
const MEMORY: usize = 1 << 30;
/// Eigenvalue, for steps of a Courant number of one, that is nothing but round-off.
const ROUND_OFF: f64 = 1e-10;
/// Residual of a system that counts as solved, relative.
const SOLVED: f64 = 1e-7;
/// Iterations after which a system that is not solved will never be: each leaves 0.17 of the error.
const MOST_ITERATIONS: usize = 60;

/// The largest stable step of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Time step \[s\].
    pub dt: f64,
    /// c dt / min(h).
    pub courant: f64,
    /// Part that becomes unstable first.
    pub ruler: Ruler,
}

/// The particle that moves most, by its stress, in what becomes unstable first.
#[derive(Clone, Debug, PartialEq)]
pub struct Ruler {
    /// Identifier of its body.
    pub body: i64,
    /// Name of its body.
    pub name: String,
    /// Identifier of the particle.
    pub particle: u64,
    /// Place of it \[m\].
    pub position: Vector,
    /// The node next to it \[m\].
    pub node: Vector,
}

/// The predicted limit of a scene with its own method; `None` where nothing can move.
///
/// # Errors
/// A scene that is refused, or an iteration that does not come to an end.
pub fn predict(scene: &Scene) -> Result<Option<Limit>, StabilityError> {
    let mut frozen = LinearMotion::new(scene)?;
    let [motion, stress] = frozen.sizes();
    let most = (MEMORY / (8 * stress.max(1))).clamp(12, MOST_VECTORS);
    let found = largest(stress, most, |s| stiffness(&mut frozen, motion, s))?;
    Ok(found.and_then(|pair| {
        if pair.value <= ROUND_OFF {
            return None;
        }
        let courant = (2.0 / pair.value).sqrt();
        Some(Limit {
            dt: courant * frozen.unit(),
            courant,
            ruler: ruler(scene, &frozen, &pair.vector),
        })
    }))
}

/// The bound 2/w of the grid alone (c dt / min(h)), w its highest frequency, of a scene with USL: J is -dt² times the
/// square of it. With other schemes it is the bound of the projected motion. `None` where nothing can move.
///
/// # Errors
/// As [`predict`].
pub fn grid_bound(scene: &Scene) -> Result<Option<f64>, StabilityError> {
    let mut frozen = LinearMotion::new(scene)?;
    let [motion, stress] = frozen.sizes();
    let found = largest(stress, MOST_VECTORS, |s| {
        let after = frozen.step(
            &State {
                motion: vec![0.0; motion],
                stress: s.to_vec(),
            },
            1.0,
        )?;
        Ok(difference(s, &after.stress))
    })?;
    Ok(found.map(|pair| 2.0 / pair.value.sqrt()))
}

/// K s, with steps of one unit of time.
fn stiffness(
    frozen: &mut LinearMotion,
    motion: usize,
    s: &[f64],
) -> Result<Vec<f64>, StabilityError> {
    let pushed = frozen.step(
        &State {
            motion: vec![0.0; motion],
            stress: s.to_vec(),
        },
        1.0,
    )?;
    let mut result = difference(s, &pushed.stress);
    // (1 + T) w = F s by Chebyshev's iteration, from half of the right side, which is the answer for T = 1. The
    // eigenvalues of 1 + T are from 1 to 2.
    let (center, half) = (1.5, 0.5);
    let ratio = center / half;
    let wanted = SOLVED * dot(&pushed.motion, &pushed.motion).sqrt();
    let mut rest = pushed.motion.clone();
    let mut way: Vec<f64> = rest.iter().map(|r| 0.5 * r).collect();
    let mut rho = 1.0 / ratio;
    let mut left = f64::INFINITY;
    for iteration in 0..MOST_ITERATIONS {
        let after = frozen.step(
            &State {
                motion: way.clone(),
                stress: vec![0.0; s.len()],
            },
            1.0,
        )?;
        for (slot, strained) in result.iter_mut().zip(&after.stress) {
            *slot += strained;
        }
        for ((r, d), t) in rest.iter_mut().zip(&way).zip(&after.motion) {
            *r -= d + t;
        }
        left = dot(&rest, &rest).sqrt();
        if left <= wanted {
            return Ok(result);
        }
        if iteration == 0 {
            way = rest.iter().map(|r| r / center).collect();
        } else {
            let next = 1.0 / (2.0 * ratio - rho);
            for (d, r) in way.iter_mut().zip(&rest) {
                *d = next * rho * *d + 2.0 * next / half * r;
            }
            rho = next;
        }
    }
    Err(StabilityError::NoConvergence {
        what: "the motion that belongs to a stress",
        residual: left / wanted * SOLVED,
    })
}

/// a - b.
fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// The particle with the largest stress of an eigenvector.
fn ruler(scene: &Scene, frozen: &LinearMotion, vector: &[f64]) -> Ruler {
    let size = |value: &f64| value.abs();
    let largest = frozen
        .particles_of_stress()
        .zip(vector)
        .max_by(|(_, a), (_, b)| size(a).total_cmp(&size(b)));
    let (body, p) = largest.map_or((0, 0), |(particle, _)| particle);
    let simulation = frozen.simulation();
    let position = simulation.position(body, p);
    let mesh = &scene.mesh;
    Ruler {
        body: scene.bodies[body].id,
        name: scene.bodies[body].name.clone(),
        particle: simulation.sets()[body].id[p],
        position,
        node: std::array::from_fn(|axis| {
            let cells = ((position[axis] - mesh.origin[axis]) / mesh.cell[axis]).round();
            mesh.origin[axis] + cells * mesh.cell[axis]
        }),
    }
}

/// Growth per step of the state that grows most in steps of a Courant number, particles frozen: the spectral radius of the
/// linear step, by as many steps as asked for. One, but for what slow modes still tell, where all is stable.
///
/// # Errors
/// As [`predict`].
pub fn growth(scene: &Scene, courant: f64, steps: usize) -> Result<f64, StabilityError> {
    let mut frozen = LinearMotion::new(scene)?;
    let [motion, stress] = frozen.sizes();
    let values = |size: usize, seed: u64| -> Vec<f64> {
        (0..size as u64)
            .map(|i| super::arnoldi::uniform(seed + i))
            .collect()
    };
    let mut state = State {
        motion: values(motion, 0),
        stress: values(stress, motion as u64),
    };
    let mut logarithm = 0.0;
    for step in 0..steps {
        state = frozen.step(&state, courant)?;
        let squares = dot(&state.motion, &state.motion) + dot(&state.stress, &state.stress);
        let length = squares.sqrt();
        // The first half lets what does not grow die away.
        if 2 * step >= steps {
            logarithm += libm::log(length);
        }
        for value in state.motion.iter_mut().chain(&mut state.stress) {
            *value /= length;
        }
    }
    Ok(libm::exp(logarithm / steps.div_ceil(2) as f64))
}
