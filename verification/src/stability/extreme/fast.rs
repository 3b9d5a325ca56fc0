//! Bodies that are faster than their waves, such a piston, and bodies that are torn apart: what holds particles together is
//! the grid between them.

use super::prelude::*;
use proctor_scene::simulation::ParticleAt;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("cells-per-step", cells_per_step)
        .with("a block that crosses five cells in a millisecond, and a step in which it would cross ten")
        .must("no step moves anything by more than half a cell; the step of ten cells is refused with its numbers"),
    Extreme::of("fast-piston", fast_piston)
        .with("a piston at twice the wave speed presses a block to a tenth of its length and less")
        .must("volumes stay positive and the stress is the logarithm of the stretch, or the particle is named"),
    Extreme::of("torn-apart", torn_apart)
        .with("a bar whose ends fly apart at a hundred times its wave speed, until empty cells lie between all its particles")
        .must("no force between particles that no node joins; domains that follow say when they outgrow the stencil and stop at a cell"),
];

/// Cells per millisecond.
const SPEED: f64 = 5e3;

fn cells_per_step() -> RowVerdict {
    let mut moved = gate("cells that are crossed in a step")
        .at_most(0.5, "a particle that crosses more than half a cell in a step has skipped nodes that it should have met");
    let mut off =
        gate("place against x_0 + v t").at_most(ROUND_OFF, "nothing acts on a block that flies");
    let mut strained = gate("stress over rho v²").at_most(
        ROUND_OFF,
        "a uniform velocity strains nothing but by its round-off",
    );
    let mut scene = block([40, 8], [2.2, 2.2], [4.2, 4.2], elastic(1e6, 0.3));
    scene.materials[0].density = 1e3;
    scene.bodies[0].velocity = [SPEED, 0.0, 0.0];
    for scene in with_schemes(&scene) {
        let mut simulation = start(&scene, &options())?;
        let from = simulation.center(0).position[0];
        run_to(&mut simulation, 30.0 / SPEED, |s, info| {
            moved.see(SPEED * info.dt);
            let exact = from + SPEED * s.time();
            off.see((s.center(0).position[0] / exact - 1.0).abs());
            strained.see(largest_stress(s) / (1e3 * SPEED * SPEED));
        })?;
    }
    let ten = 10.0 / SPEED;
    let too_long = scene.with_time_step(fixed(ten));
    let refusal = refused_step("a step of ten cells", &too_long, &options(), |step| {
        step.dt == ten && step.particle_speed == SPEED && step.critical * SPEED <= 0.5
    })?;
    Ok(Finding::of([moved, off, strained]).refusing(vec![refusal]))
}

/// A block between sliding sides, a wall on its right and a piston on its left that comes at a multiple of the wave
/// speed; Poisson's ratio is zero.
fn pressed(law: impl Into<AnyLaw>, speed: f64) -> Scene {
    let mut scene = open([14, 2])
        .with_plane(0, 1, PlaneCondition::Sliding)
        .between(1);
    let material = scene.add_material(law, 1.0);
    scene.add_body(rectangle([6.0, 0.0], [14.0, 2.0]), material);
    let piston = rectangle([1.0, 0.0], [6.0, 2.0]);
    scene.add_body(piston, material).motion = Some([speed, 0.0, 0.0].into());
    scene
}

/// Laws of a block that is pressed to next to nothing.
fn laws() -> [(&'static str, AnyLaw); 2] {
    [
        ("elastic", elastic(1.0, 0.0)),
        ("neo-Hookean", NeoHookean::new(1.0, 0.0).into()),
    ]
}

/// Volumes of the particles of the first body over those at the start, with their stresses along x \[Pa\].
fn pressed_to(simulation: &Simulation, start: &[ParticleState]) -> Vec<[f64; 2]> {
    let share = |seen: &ParticleState| seen.volume / start[seen.id as usize].volume;
    let all = of_body(simulation, 0);
    all.map(|seen| [share(&seen), seen.stress[0]]).collect()
}

/// The message of an error that names a particle whose volume is not positive any more.
fn inverted(what: String, error: &StepError, right: fn(&ParticleAt) -> bool) -> Result<String> {
    match &error.kind {
        StepErrorKind::Inverted(at) if at.volume <= 0.0 && right(at) => {
            Ok(format!("{what}: {error}"))
        }
        _ => Err(unexpected(what, error)),
    }
}

fn fast_piston() -> RowVerdict {
    const SPEED_OVER_WAVES: f64 = 2.0;
    let mut off = gate("elastic: stress over that of the logarithmic strain, less one")
        .at_most(f64::NAN, "the midpoint strain of an increment e is 2 tanh(e/2), short of e by e²/12, and e is at most the largest strain \
             increment over what it leaves");
    let mut least = gate("smallest volume over that at the start").at_least(
        f64::MIN_POSITIVE,
        "a volume that is not positive has no density; the step that makes one must fail",
    );
    let mut allowed = 0.0_f64;
    let mut refusals = vec![];
    for scheme in SCHEMES {
        for (name, law) in laws() {
            let scene = pressed(law, SPEED_OVER_WAVES).with_scheme(scheme);
            let mut simulation = start(&scene, &options())?;
            let before = particles(&simulation);
            // Until a tenth of the block is left.
            let end = 0.9 * 8.0 / SPEED_OVER_WAVES;
            while simulation.time() < end {
                if let Err(error) = simulation.step(end) {
                    let what = format!("{name} {scheme:?}");
                    refusals.push(inverted(what, &error, |at| at.body == 1)?);
                    break;
                }
                for [share, _] in pressed_to(&simulation, &before) {
                    least.see(share);
                }
            }
            if name == "elastic" {
                for [share, stress] in pressed_to(&simulation, &before) {
                    let exact = libm::log(share);
                    // Particles that have hardly been strained say nothing.
                    if exact < -0.1 {
                        off.see((stress / exact - 1.0).abs());
                    }
                }
                allowed = allowed.max(simulation.invariants().increment);
            }
        }
    }
    // A step in which the piston goes through the first particles must name one of them. USF is left out: its strain is how
    // the particles really moved, and they do not pass each other here.
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        for (_, law) in laws() {
            let scene = pressed(law, 2.0).with_scheme(scheme);
            let scene = scene.with_time_step(unstable(fixed(0.8)));
            let error = stopped(&mut start(&scene, &options())?, 3, |_| ())?;
            refusals.push(inverted(format!("{scheme:?}"), &error, |_| true)?);
        }
    }
    off.bound = allowed * allowed / 12.0 / (1.0 - allowed);
    Ok(Finding::of([least, off]).refusing(refusals))
}

/// Rate at which the bar is stretched at the start \[1/s\]: ends at a hundred times the wave speed.
const RATE: f64 = 50.0;
/// Length of the bar in cells, and where it ends on the left; the middle stands.
const LENGTH: f64 = 4.0;
const MIDDLE: f64 = 30.0;
/// Distance from which no node is in reach of two particles: each reaches a cell and a quarter to either side \[m\].
const REACH: f64 = 2.5;
/// Steps in which the bar grows by ten of its lengths, by when all must have parted.
const MOST: u64 = 1000;

/// The bar with a method, and its start.
fn bar(weighting: Weighting, scheme: StressScheme) -> Result<Simulation> {
    let [left, right] = [-0.5, 0.5].map(|share| MIDDLE + share * LENGTH);
    // Equal steps, a hundred for each stretch by 1.
    let scene = block([60, 1], [left, 0.0], [right, 1.0], elastic(1.0, 0.0))
        .with_weighting(weighting)
        .with_scheme(scheme)
        .between(1)
        .with_time_step(fixed(0.01 / RATE));
    let stretched = from(|x| moving_along_x(RATE * (x[0] - MIDDLE), RATE));
    start(&scene, &stretched)
}

/// Places and velocities along the bar, from the left: one of each column of particles \[m, m/s\].
fn columns(simulation: &Simulation) -> Vec<[f64; 2]> {
    let row = of_body(simulation, 0).filter(|seen| seen.position[1] < 0.5);
    let along = |seen: ParticleState| [seen.position[0], seen.velocity[0]];
    let mut all: Vec<_> = row.map(along).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

/// Change of velocity of the columns after none reaches a node of another, over that of the ends.
fn pull_after_parting(scheme: StressScheme) -> Result<f64> {
    let mut simulation = bar(Weighting::UniformGimp, scheme)?;
    let nearest = |simulation: &Simulation| {
        let all = columns(simulation);
        let gaps = all.windows(2).map(|pair| pair[1][0] - pair[0][0]);
        gaps.fold(f64::INFINITY, f64::min)
    };
    while nearest(&simulation) <= REACH {
        if simulation.steps() > MOST {
            return Err(RowFault(format!("{scheme:?}: the columns never part")));
        }
        step(&mut simulation, NEVER)?;
    }
    let before = columns(&simulation);
    steps(&mut simulation, 100)?;
    let after = columns(&simulation);
    let changes = before.iter().zip(&after).map(|(a, b)| (a[1] - b[1]).abs());
    Ok(changes.fold(0.0, worst) / (0.5 * LENGTH * RATE))
}

fn torn_apart() -> RowVerdict {
    let mut pulled = gate("uGIMP: change of velocity of what has parted, over that of the ends")
        .at_most(
            ROUND_OFF,
            "no node is in reach of two particles, and none acts on itself",
        );
    let mut late = gate("cpGIMP: stretches at which a wider stencil and the stop are reported, less 2 and 4")
        .at_most(0.1, "half-lengths of a quarter of a cell are half a cell at a stretch of 2 and a cell at 4; in the middle of the bar \
             velocities stay linear but for the noise of few particles in a cell");
    let mut refusals = vec![];
    for scheme in SCHEMES {
        pulled.see(pull_after_parting(scheme)?);
        let mut simulation = bar(CONTIGUOUS, scheme)?;
        let stopped = stopped(&mut simulation, MOST, |s| {
            let events = s.events().iter();
            for event in events.filter(|e| e.kind == EventKind::WiderStencil) {
                late.see((1.0 + RATE * event.time - 2.0).abs());
            }
        })?;
        let StepErrorKind::DomainTooLarge { half_length: 1.0.. } = stopped.kind else {
            return Err(unexpected(format!("{scheme:?}"), stopped));
        };
        late.see((1.0 + RATE * stopped.time - 4.0).abs());
        refusals.push(format!("{scheme:?}: {stopped}"));
    }
    Ok(Finding::of([pulled, late]).refusing(refusals))
}
