//! Bodies that are faster than their waves, and what such a piston does to a body.

use proctor_laws::{AnyLaw, NeoHookean};
use proctor_scene::simulation::{SetupError, Simulation, StartError, StepErrorKind};
use proctor_scene::{PlaneCondition, Scene, Shape, StressScheme, TimeStep};

use super::trial::{ROUND_OFF, always, elastic, open, options, run_to, start, worst};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "cells-per-step",
        what: "a block that crosses five cells in a millisecond, and a step in which it would cross ten",
        required: "no step moves anything by more than half a cell; the step of ten cells is refused with its numbers",
        cause: None,
        judge: cells_per_step,
    },
    Extreme {
        name: "fast-piston",
        what: "a piston at twice the wave speed presses a block to a tenth of its length and less",
        required: "volumes stay positive and the stress is the logarithm of the stretch, or the particle is named",
        cause: None,
        judge: fast_piston,
    },
];

/// Cells per millisecond.
const SPEED: f64 = 5e3;

fn flying() -> Scene {
    let mut scene = open([40, 8]);
    let material = scene.add_material(elastic(1e6, 0.3), 1e3);
    scene
        .add_body(Shape::rectangle([2.2, 2.2], [4.2, 4.2]), material)
        .velocity = [SPEED, 0.0, 0.0];
    scene
}

fn cells_per_step() -> Result<Finding, Unexpected> {
    let [mut moved, mut off, mut stress] = [0.0; 3];
    for scheme in SCHEMES {
        let mut scene = flying();
        scene.scheme = scheme;
        let mut simulation = start(&scene, None)?;
        let from = simulation.center(0).position[0];
        run_to(&mut simulation, 30.0 / SPEED, |s, info| {
            moved = worst(moved, SPEED * info.dt);
            let exact = from + SPEED * s.time();
            off = worst(off, (s.center(0).position[0] / exact - 1.0).abs());
            let set = &s.sets()[0];
            for p in 0..set.len() {
                stress = set.stress(p).iter().map(|c| c.abs()).fold(stress, worst);
            }
        })?;
    }
    let mut finding = Finding {
        gates: vec![
            Gate::at_most(
                String::from("cells that are crossed in a step"),
                moved,
                0.5,
                "what crosses more than half a cell in a step has skipped nodes that it should have met",
            ),
            Gate::at_most(
                String::from("place against x_0 + v t"),
                off,
                ROUND_OFF,
                "nothing acts on a block that flies",
            ),
            Gate::at_most(
                String::from("stress over rho v²"),
                stress / (1e3 * SPEED * SPEED),
                ROUND_OFF,
                "a uniform velocity strains nothing but by its round-off",
            ),
        ],
        refusals: vec![],
    };
    let ten = 10.0 / SPEED;
    let mut scene = flying();
    scene.time_step = TimeStep::Fixed {
        dt: ten,
        allow_unstable: false,
    };
    match scene.simulate(&options(None)) {
        Err(StartError::Setup(SetupError::UnstableTimeStep(unstable)))
            if unstable.dt == ten
                && unstable.particle_speed == SPEED
                && unstable.critical * SPEED <= 0.5 =>
        {
            finding.refusals.push(unstable.to_string());
        }
        Err(other) => return Err(Unexpected(format!("refused for another reason: {other}"))),
        Ok(_) => return Err(Unexpected(String::from("a step of ten cells was taken"))),
    }
    Ok(finding)
}

/// A block between sliding sides, a wall on its right and a piston on its left that comes at a multiple of the wave
/// speed; Poisson's ratio is zero.
fn pressed(law: impl Into<AnyLaw>, speed: f64) -> Scene {
    let mut scene = open([14, 2]);
    scene.mesh.planes[0][1] = PlaneCondition::Sliding;
    scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    let material = scene.add_material(law, 1.0);
    scene.add_body(Shape::rectangle([6.0, 0.0], [14.0, 2.0]), material);
    scene
        .add_body(Shape::rectangle([1.0, 0.0], [6.0, 2.0]), material)
        .motion = Some(always([speed, 0.0, 0.0]));
    scene
}

/// Smallest volume over that at the start, of the first body.
fn smallest_volume(simulation: &Simulation, start: &[f64]) -> f64 {
    let all = 0..simulation.sets()[0].len();
    let shares = all.map(|p| {
        let id = simulation.sets()[0].id[p] as usize;
        simulation.particle_volume(0, p) / start[id]
    });
    shares.fold(
        f64::INFINITY,
        |a, b| if b < a || b.is_nan() { b } else { a },
    )
}

/// Volumes of the first body by identifier \[m³\].
fn volumes(simulation: &Simulation) -> Vec<f64> {
    let set = &simulation.sets()[0];
    let mut all = vec![f64::NAN; set.len()];
    for p in 0..set.len() {
        all[set.id[p] as usize] = simulation.particle_volume(0, p);
    }
    all
}

fn fast_piston() -> Result<Finding, Unexpected> {
    const SPEED_OVER_WAVES: f64 = 2.0;
    let [mut off, mut allowed] = [0.0_f64; 2];
    let mut least = f64::INFINITY;
    let mut finding = Finding::default();
    for scheme in SCHEMES {
        for (name, law) in [
            ("elastic", AnyLaw::from(elastic(1.0, 0.0))),
            ("neo-Hookean", NeoHookean::new(1.0, 0.0).into()),
        ] {
            let mut scene = pressed(law, SPEED_OVER_WAVES);
            scene.scheme = scheme;
            let mut simulation = start(&scene, None)?;
            let before = volumes(&simulation);
            // Until a tenth of the block is left.
            let end = 0.9 * 8.0 / SPEED_OVER_WAVES;
            while simulation.time() < end {
                if let Err(error) = simulation.step(end) {
                    let StepErrorKind::Inverted(at) = &error.kind else {
                        return Err(Unexpected(format!("{name} {scheme:?}: {error}")));
                    };
                    if at.volume > 0.0 || at.body != 1 {
                        return Err(Unexpected(format!("{name} {scheme:?}: {error}")));
                    }
                    finding.refusals.push(format!("{name} {scheme:?}: {error}"));
                    break;
                }
                let smallest = smallest_volume(&simulation, &before);
                least = if smallest < least || smallest.is_nan() {
                    smallest
                } else {
                    least
                };
            }
            if name == "elastic" {
                let set = &simulation.sets()[0];
                for p in 0..set.len() {
                    let share = simulation.particle_volume(0, p) / before[set.id[p] as usize];
                    let exact = libm::log(share);
                    // Particles that have hardly been strained say nothing.
                    if exact < -0.1 {
                        off = worst(off, (set.stress(p)[0] / exact - 1.0).abs());
                    }
                }
                allowed = allowed.max(simulation.invariants().increment);
            }
        }
    }
    name_inverted(&mut finding)?;
    finding.gates = vec![
        Gate::at_least(
            String::from("smallest volume over that at the start"),
            least,
            f64::MIN_POSITIVE,
            "a volume that is not positive has no density; the step that makes one must fail",
        ),
        Gate::at_most(
            String::from("elastic: stress over that of the logarithmic strain, less one"),
            off,
            allowed * allowed / 12.0 / (1.0 - allowed),
            "the midpoint strain of an increment e is 2 tanh(e/2), short of e by e²/12, and e is at most the largest strain \
             increment over what it leaves",
        ),
    ];
    Ok(finding)
}

/// A step in which the piston goes through the first particles must name one of them. USF is left out: its strain is how
/// the particles really moved, and they do not pass each other here.
fn name_inverted(finding: &mut Finding) -> Result<(), Unexpected> {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        for law in [
            AnyLaw::from(elastic(1.0, 0.0)),
            NeoHookean::new(1.0, 0.0).into(),
        ] {
            let mut scene = pressed(law, 2.0);
            scene.scheme = scheme;
            scene.time_step = TimeStep::Fixed {
                dt: 0.8,
                allow_unstable: true,
            };
            let mut simulation = start(&scene, None)?;
            let Some(error) = (0..3).find_map(|_| simulation.step(f64::INFINITY).err()) else {
                return Err(Unexpected(format!("{scheme:?}: nobody was inverted")));
            };
            match &error.kind {
                StepErrorKind::Inverted(at) if at.volume <= 0.0 => {
                    finding.refusals.push(format!("{scheme:?}: {error}"));
                }
                _ => return Err(Unexpected(format!("{scheme:?}: {error}"))),
            }
        }
    }
    Ok(())
}
