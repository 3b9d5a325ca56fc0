//! Does the stress of a body that has yielded turn with it, without any more yielding?
//!
//! A block is strained until it has yielded, by a velocity gradient whose
//! principal axes are none of the mesh, and then spun as a rigid body: in the plane about z, in space about an axis that is
//! none of the mesh. All nodes move as prescribed, as in *shear-and-turn*; a body that spins freely would not be in
//! equilibrium with one stress.
//!
//! A state on a yield surface is the one that every error of a rotation brings beyond it: where a rate lets the stress
//! grow with the square of the step, or takes chords of circles for strain, the block flows in each step. The midpoint rule
//! of Hughes and Winget makes no strain of equal chords and turns by their angle, so that what is left is round-off: the
//! stress is `R sigma R^T`, its principal values stay, and so do plastic strain and plastic work. `proctor verify spin`.

use super::prelude::*;
use super::vocabulary::moved::SetVelocity;
use super::vocabulary::yielding::{DRUCKER_PRAGER, MOHR_COULOMB, PlasticSolid, TRESCA, VON_MISES};
use crate::exact::turned::{Matrix, Tensor, invariants, length, rotation, turn, turned};

/// Young's modulus \[Pa\] and density \[kg/m³\]: waves run at 1.1 m/s.
const YOUNG: f64 = 1.0;
const DENSITY: f64 = 1.0;
const STRENGTH: f64 = 2e-3; // Yield stress of von Mises [Pa]
/// Cells are so many times as large as a wave runs in a step, about.
const CELLS_PER_STEP: f64 = 10.0;
/// Cells along the body, and empty ones on each side of it.
const WIDE: usize = 2;
const MARGIN: usize = 2;
const STRAINING: u32 = 64; // Steps in which the body is strained
/// Strain before the spin, five times that at which it yields: compression with shear.
const STRAIN: [Matrix; 2] = [
    [[-1e-2, 3e-3, 0.0], [3e-3, 2e-3, 0.0], [0.0; 3]],
    [
        [-9e-3, 3e-3, 2e-3],
        [3e-3, 3e-3, -1e-3],
        [2e-3, -1e-3, -2e-3],
    ],
];
const LOOKS: u32 = 16; // The stress is compared so many times in a turn

/// Names of the quantities.
const TURNED: &str = "difference of the turned stress over the stress";
const PRINCIPAL: &str = "difference of principal stresses over the stress";
const MULTIPLIER: &str = "added plastic strain over the plastic strain";
const WORK: &str = "added plastic work over the plastic work";

/// Problem of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Variant {
    name: &'static str,
    law: &'static str,
    dimension: Dimension,
}

const fn variant(name: &'static str, law: &'static str, dimension: Dimension) -> Variant {
    Variant {
        name,
        law,
        dimension,
    }
}

const VARIANTS: [Variant; 8] = [
    variant("von Mises", VON_MISES, Dimension::Two),
    variant("Tresca", TRESCA, Dimension::Two),
    variant("Mohr-Coulomb", MOHR_COULOMB, Dimension::Two),
    variant("Drucker-Prager", DRUCKER_PRAGER, Dimension::Two),
    variant("von Mises 3D", VON_MISES, Dimension::Three),
    variant("Tresca 3D", TRESCA, Dimension::Three),
    variant("Mohr-Coulomb 3D", MOHR_COULOMB, Dimension::Three),
    variant("Drucker-Prager 3D", DRUCKER_PRAGER, Dimension::Three),
];

impl Variant {
    /// Axis of the spin.
    fn axis(self) -> [f64; 3] {
        match self.dimension {
            Dimension::Two => [0.0, 0.0, 1.0],
            Dimension::Three => [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0],
        }
    }

    fn strain(self) -> Matrix {
        match self.dimension {
            Dimension::Two => STRAIN[0],
            Dimension::Three => STRAIN[1],
        }
    }

    /// Corners of the body \[m\].
    fn corners(self, cell: f64) -> [[f64; 3]; 2] {
        [MARGIN, MARGIN + WIDE].map(|cells| {
            let mut corner = [0.0; 3];
            corner[..self.dimension.axes()].fill(cells as f64 * cell);
            corner
        })
    }
}

/// Steps in a turn; cells of a rung are as large as one of them.
fn steps_per_turn(rung: &Rung) -> u32 {
    (CELLS_PER_STEP / rung.cell).round() as u32
}

/// Length of a step \[s\]: a turn takes one second.
fn time_step(rung: &Rung) -> f64 {
    1.0 / f64::from(steps_per_turn(rung))
}

/// Number of looks at the body in its spin: ten turns, where the whole ladder is run.
fn looks(rung: &Rung) -> u32 {
    LOOKS * if steps_per_turn(rung) < 500 { 1 } else { 10 }
}

/// State of a particle when the spin begins.
#[derive(Clone, Copy, Debug)]
struct SpinStart {
    stress: Tensor,
    /// Plastic strain.
    strain: f64,
    /// Plastic work \[J/m³\].
    work: f64,
}

/// The states of all particles.
fn yielded(simulation: &Simulation) -> Result<Vec<SpinStart>, Failure> {
    let set = &simulation.sets()[0];
    let state = |p| match set.variables(p)[..] {
        [strain, work, ..] => Ok(SpinStart {
            stress: set.stress(p),
            strain,
            work,
        }),
        _ => Err("the law keeps no plastic strain and work".into()),
    };
    (0..set.len()).map(state).collect()
}

/// Deviations, in the order of the quantities.
type Off = [f64; 4];

/// Deviation of a particle that began to spin with a state.
fn off_by(start: &SpinStart, now: &SpinStart, rotation: &Matrix) -> Off {
    let size = length(start.stress);
    let exact = turned(start.stress, rotation);
    let apart = length(std::array::from_fn(|i| now.stress[i] - exact[i]));
    let [before, after] = [start, now].map(|state| invariants(state.stress));
    let principal = largest(before.iter().zip(after).map(|(a, b)| (a - b).abs()));
    [
        apart / size,
        principal / size,
        (now.strain / start.strain - 1.0).abs(),
        (now.work / start.work - 1.0).abs(),
    ]
}

const TURNS: &str = "turned by the midpoint rule; round-off of some thousand steps is left";
const FLOWS: &str = "no strain that would load it; round-off is left";
const WRONG_ANGLE: Wrong =
    Wrong::factor("angle", 1.001).breaks_only(|gate| gate.contains("turned"));
const WRONG_STRAIN: Wrong = Wrong::value("strain", 0.0, 1e-5);

/// A body that has yielded and spins.
pub static SPIN: Case = Case::new(
    "spin",
    "Does the stress of a body that has yielded turn with it, without any more yielding?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.options(options)
.run(compare)
.gates_of_rungs(&[
    error(TURNED).at_most(1e-10, TURNS),
    error(PRINCIPAL).at_most(1e-10, TURNS),
    error(MULTIPLIER).at_most(1e-10, FLOWS),
    error(WORK).at_most(1e-10, FLOWS),
])
.wrong_references(&[WRONG_ANGLE, WRONG_STRAIN])
.no_study(
    "all nodes move as prescribed, so that weighting functions, schemes and transfers have no say",
)
.no_guest("all nodes move as prescribed, and no scene file can say that; *rotation* spins freely");

/// Velocity of all nodes, by place and time: a gradient about the middle of the body, that of the straining and then that of the
/// spin.
fn motion(
    reference: Reference,
    rung: &Rung,
) -> impl Fn(Vector, f64) -> Vector + Clone + Send + Sync + 'static {
    let (variant, dt) = (*rung.problem::<Variant>(), time_step(rung));
    let [lower, upper] = variant.corners(rung.cell);
    let about: Vector = std::array::from_fn(|i| 0.5 * (lower[i] + upper[i]));
    let until = f64::from(STRAINING) * dt;
    let strains = variant.strain().map(|row| row.map(|e| e / until));
    let step = turn(variant.axis(), TAU / f64::from(steps_per_turn(rung)));
    let mut spins = step.map(|row| row.map(|x| x / dt));
    spins[0][0] -= reference.of(&WRONG_STRAIN);
    move |x, time| {
        let gradient = if time < until { strains } else { spins };
        gradient.map(|row| (0..3).map(|i| row[i] * (x[i] - about[i])).sum())
    }
}

/// Runs steps of the scene up to a number.
fn advance(
    simulation: &mut Simulation,
    steps: u64,
    observer: &dyn Observer,
) -> Result<(), Failure> {
    let end = simulation.scene().time;
    while simulation.steps() < steps {
        step(simulation, end, observer)?;
    }
    Ok(())
}

/// Strains and spins the body, and looks at it on the way.
fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    observer.phase(Phase::Stepping);
    let axis = rung.problem::<Variant>().axis();
    advance(simulation, u64::from(STRAINING), observer)?;
    let starts = yielded(simulation)?;
    let (all, mut off) = (looks(rung), [0.0; 4]);
    for look in 1..=all {
        let steps = look * steps_per_turn(rung) / LOOKS;
        advance(simulation, u64::from(STRAINING + steps), observer)?;
        observer.progress(f64::from(look) / f64::from(all));
        let turns = f64::from(steps) / f64::from(steps_per_turn(rung));
        let rotation = rotation(axis, run.reference.of(&WRONG_ANGLE) * turns.fract() * TAU);
        for (start, now) in starts.iter().zip(yielded(simulation)?) {
            let now = off_by(start, &now, &rotation);
            off = std::array::from_fn(|i| larger(off[i], now[i]));
        }
    }
    observer.phase(Phase::Comparing);
    let quantities = [TURNED, PRINCIPAL, MULTIPLIER, WORK].into_iter().zip(off);
    let quantities = quantities.map(|(name, off)| Quantity::of_zero(name, off));
    Ok(Measurements::of(quantities.collect::<Vec<_>>()))
}

fn rungs(size: Size) -> Vec<Rung> {
    let steps: &'static [u32] = size.pick(&[256], &[256, 1024]);
    Rung::of_problems(
        &VARIANTS,
        |v| v.name,
        "steps in a turn",
        CELLS_PER_STEP,
        |_| steps,
    )
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, variant) = (rung.cell, *rung.problem::<Variant>());
    let axes = variant.dimension.axes();
    let mut mesh = Mesh::new(variant.dimension, [0.0; 3], [h; 3], [1; 3]);
    mesh.cells[..axes].fill(WIDE + 2 * MARGIN);
    mesh.planes[..axes].fill([PlaneCondition::Free; 2]);
    let steps = STRAINING + looks(rung) * steps_per_turn(rung) / LOOKS;
    let end = f64::from(steps) * time_step(rung);
    let mut scene = bare_scene("spin", variant.dimension, mesh, end);
    scene.time_step = equal_steps_of(time_step(rung));
    let solid = PlasticSolid {
        variant: variant.law,
        young: YOUNG,
        strength: STRENGTH,
    };
    scene.materials = material(variant.law, DENSITY, solid.law());
    let [lower, upper] = variant.corners(h);
    let mut block = body("block", 1, cuboid(lower, upper));
    block.particles_per_cell[..axes].fill(2);
    scene.bodies = vec![block];
    scene
}

fn options(rung: &Rung, reference: Reference, mut options: Options) -> Options {
    let motion = motion(reference, rung);
    let nodes = motion.clone();
    options.initial = Some(Arc::new(move |x| moving(motion(*x, 0.0), [[0.0; 3]; 3])));
    options.conditions.push(Arc::new(SetVelocity::by(nodes)));
    options
}
