//! Does the stress follow shear and ten turns as its objective rate says?
//!
//! All nodes move as the exact motion does, so that particles cross cells,
//! velocity gradients are those of the motion, and what is left is the law: simple shear to gamma = 3 from a state
//! without stress, and ten turns of a stressed block, in the plane and in space.
//!
//! The result of an update in equal steps has a closed form, of Hughes and Winget's and of the manuals' forward Jaumann rate
//! (`exact/objective_rate.rs`): the kernel must give it to round-off. Against the exact stress both are of order 1 in shear. In
//! a turn of N steps the first keeps the deviator, the second makes it grow by exp(8 pi²/N), and takes chords of circles for a
//! compression, (lambda + G) 4 pi²/N. Cells shrink with the step. `proctor verify shear-and-turn`.

use super::prelude::*;
use crate::exact::objective_rate::{
    PlaneStress, Update, deviator, growth_per_turn, sheared, sheared_by, turned_by,
};

const LAW: LinearElastic = LinearElastic::new(1.0, 0.3); // Law with a rate; waves run at 1.2 m/s
const DENSITY: f64 = 1.0; // Density [kg/m³]
/// Cells are so many times as large as a wave runs in a step, about.
const CELLS_PER_STEP: f64 = 10.0;
const WIDE: f64 = 2.0; // Cells along the body
const SHEAR: f64 = 3.0; // Amount of shear at the end
const TURNS: u32 = 10; // Turns of the block
const STRESSED: PlaneStress = [3e-3, -2e-3, 1e-3]; // Stress at the start of the turns [Pa]
/// Steps until all of the shear, and in a turn.
const STEPS: [&[u32]; 2] = [&[250, 500], &[250, 500, 1000]];

/// Names of the quantities.
const OFF: &str = "difference of stress over G";
const PREDICTED: &str = "difference from the closed form over the stress";
const GROWTH: &str = "growth of the deviator per turn, logarithm";
const PRESSURE: &str = "pressure per turn, over lambda + G";

/// Problem of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Variant {
    name: &'static str,
    turns: bool,
    update: Update,
    dimension: Dimension,
}

const fn variant(name: &'static str, turns: bool, update: Update, dimension: Dimension) -> Variant {
    Variant {
        name,
        turns,
        update,
        dimension,
    }
}

const VARIANTS: [Variant; 8] = [
    variant(
        "shear, Hughes-Winget",
        false,
        Update::HughesWinget,
        Dimension::Two,
    ),
    variant("shear, Jaumann", false, Update::Forward, Dimension::Two),
    variant(
        "turns, Hughes-Winget",
        true,
        Update::HughesWinget,
        Dimension::Two,
    ),
    variant("turns, Jaumann", true, Update::Forward, Dimension::Two),
    variant(
        "shear, Hughes-Winget 3D",
        false,
        Update::HughesWinget,
        Dimension::Three,
    ),
    variant(
        "shear, Jaumann 3D",
        false,
        Update::Forward,
        Dimension::Three,
    ),
    variant(
        "turns, Hughes-Winget 3D",
        true,
        Update::HughesWinget,
        Dimension::Three,
    ),
    variant("turns, Jaumann 3D", true, Update::Forward, Dimension::Three),
];

impl Variant {
    /// Steps until all of the shear, or in a turn; cells of a rung are as large as one of them.
    fn steps_per(rung: &Rung) -> u32 {
        (CELLS_PER_STEP / rung.cell).round() as u32
    }

    /// Steps of a run.
    fn steps(self, rung: &Rung) -> u32 {
        Self::steps_per(rung) * if self.turns { TURNS } else { 1 }
    }

    fn rate(self) -> ObjectiveRate {
        match self.update {
            Update::HughesWinget => ObjectiveRate::HughesWinget,
            Update::Forward => ObjectiveRate::JaumannForward,
        }
    }

    /// Empty cells below and above the body along an axis: shear moves it along x by as many times its height.
    fn margins(self, axis: usize) -> [usize; 2] {
        let swept = if !self.turns && axis == 0 {
            (WIDE * SHEAR) as usize
        } else {
            0
        };
        [2, 2 + swept]
    }

    /// Lower corner of the body \[m\].
    fn lower(self, cell: f64) -> [f64; 3] {
        std::array::from_fn(|axis| {
            if axis < self.dimension.axes() {
                self.margins(axis)[0] as f64 * cell
            } else {
                0.0
            }
        })
    }

    /// Motion of all nodes.
    fn motion(self, rung: &Rung, dt: f64) -> NodeMotion {
        let lower = self.lower(rung.cell);
        if self.turns {
            let (sin, cos) = libm::sincos(TAU / f64::from(Self::steps_per(rung)));
            let half = 0.5 * WIDE * rung.cell;
            return NodeMotion {
                about: [lower[0] + half, lower[1] + half],
                gradient: [[(cos - 1.0) / dt, -sin / dt], [sin / dt, (cos - 1.0) / dt]],
            };
        }
        let rate = SHEAR / (f64::from(Self::steps_per(rung)) * dt);
        NodeMotion {
            about: [lower[0], lower[1]],
            gradient: [[0.0, rate], [0.0, 0.0]],
        }
    }
}

/// All nodes move by one velocity gradient \[1/s\] about a point \[m\].
#[derive(Clone, Copy, Debug)]
struct NodeMotion {
    about: [f64; 2],
    gradient: [[f64; 2]; 2],
}

impl NodeMotion {
    fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let [a, b] = [x[0] - self.about[0], x[1] - self.about[1]];
        let [u, v] = self.gradient.map(|row| row[0] * a + row[1] * b);
        [u, v, 0.0]
    }
}

impl Condition for NodeMotion {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        field.for_each(|node| node.set_velocity(self.velocity(node.position())));
    }
}

const WRONG_STIFFNESS: Wrong = Wrong::factor("stiffness", 1.05).breaks(|gate| {
    gate.contains("shear,")
        && (gate.contains("difference of stress") || gate.contains("closed form"))
});
const WRONG_RATE: Wrong =
    Wrong::value("rate", 0.0, 1.0).breaks(|gate| gate.contains("closed form"));

/// Stress under prescribed motion.
pub static SHEAR_AND_TURN: Case = Case::new(
    "shear-and-turn",
    "Does the stress follow shear and ten turns as its objective rate says?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.options(options)
.compare(compare)
.judge_by(judge)
.wrong_references(&[WRONG_STIFFNESS, WRONG_RATE])
.no_study(
    "all nodes move as prescribed, so that weighting functions, schemes and transfers have no say",
)
.no_guest("all nodes move as prescribed, and no scene file can say that");

fn update(reference: Reference, variant: Variant) -> Update {
    match (variant.update, reference.of(&WRONG_RATE) != 0.0) {
        (Update::HughesWinget, false) | (Update::Forward, true) => Update::HughesWinget,
        _ => Update::Forward,
    }
}

fn quantities(
    reference: Reference,
    variant: Variant,
    rung: &Rung,
    simulation: &Simulation,
) -> Vec<Quantity> {
    let elasticity = LAW.elasticity();
    let stiffness = reference.of(&WRONG_STIFFNESS);
    let constants = [stiffness * elasticity.lambda, stiffness * elasticity.shear];
    let (update, steps) = (update(reference, variant), variant.steps(rung));
    let per_turn = Variant::steps_per(rung);
    let predicted = if variant.turns {
        turned_by(update, STRESSED, constants, per_turn, steps)
    } else {
        sheared_by(update, SHEAR, steps).map(|s| constants[1] * s)
    };
    // The particle that is farthest off; all have the same history.
    let largest = |of: &dyn Fn(PlaneStress) -> f64| {
        let set = &simulation.sets()[0];
        (0..set.len())
            .map(|p| set.stress(p))
            .map(|s| of([s[0], s[1], s[5]]))
            .fold(
                0.0,
                |worst: f64, x| if x > worst || x.is_nan() { x } else { worst },
            )
    };
    let apart = |a: PlaneStress, b: PlaneStress| {
        libm::hypot(libm::hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2])
    };
    let size = libm::hypot(deviator(predicted), predicted[0] + predicted[1]);
    let off = largest(&|s| apart(s, predicted) / size);
    let mut all = vec![Quantity::of_zero(PREDICTED, off)];
    if !variant.turns {
        let exact = sheared(SHEAR).map(|s| constants[1] * s);
        let off = largest(&|s| libm::hypot(s[0] - exact[0], s[2] - exact[2]));
        all.push(Quantity::of_zero(OFF, off / elasticity.shear));
        return all;
    }
    let grown = largest(&|s| deviator(s) / deviator(STRESSED));
    let grown = libm::log(grown) / f64::from(TURNS);
    let pressure = largest(&|s| 0.5 * (STRESSED[0] + STRESSED[1] - s[0] - s[1]));
    let pressure = pressure / (f64::from(TURNS) * (elasticity.lambda + elasticity.shear));
    match variant.update {
        Update::HughesWinget => {
            all.push(Quantity::of_zero(GROWTH, grown));
            all.push(Quantity::of_zero(PRESSURE, pressure));
        }
        Update::Forward => {
            let growth = growth_per_turn(Update::Forward, per_turn);
            all.push(Quantity::compared(GROWTH, grown, growth, "1"));
            // Half of it, since the stress grows by (1 - cos) twice.
            all.push(Quantity::compared(PRESSURE, pressure, 0.5 * growth, "1"));
        }
    }
    all
}

fn rungs(size: Size) -> Vec<Rung> {
    VARIANTS
        .iter()
        .flat_map(|variant| {
            let steps = match (size, variant.dimension) {
                (Size::Quick, Dimension::Three) => &STEPS[0][..1],
                (Size::Quick, Dimension::Two) | (Size::Full, Dimension::Three) => STEPS[0],
                (Size::Full, Dimension::Two) => STEPS[1],
            };
            let word = format!("{}, steps", variant.name);
            let rungs = Rung::counted(variant.name, &word, CELLS_PER_STEP, steps);
            rungs.into_iter().map(|rung| rung.with(*variant))
        })
        .collect()
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for variant in VARIANTS {
        let own: Vec<Rung> = runs
            .rungs
            .iter()
            .filter(|rung| rung.variant == variant.name)
            .cloned()
            .collect();
        for rung in &own {
            let mut gate = |name, bound, reason| {
                let gate = runs.error_at_most(&rung.label, name, bound, reason);
                verdict.gates.push(gate);
            };
            gate(
                PREDICTED,
                1e-9,
                "the closed form of the update; round-off of some thousand steps is left",
            );
            let n = f64::from(Variant::steps_per(rung));
            match (variant.turns, variant.update) {
                (false, _) => {}
                (true, Update::HughesWinget) => {
                    let why = "turned by the midpoint rule a stress keeps its size";
                    gate(GROWTH, 1e-10, why);
                    gate(PRESSURE, 1e-10, why);
                }
                (true, Update::Forward) => {
                    let why = "the next term is 92/N² of exp(8 pi²/N)";
                    gate(GROWTH, 100.0 / (n * n), why);
                    gate(PRESSURE, 100.0 / (n * n), "chords for strain, 1 - cos");
                }
            }
        }
        if variant.turns {
            let line = own.iter().map(|rung| {
                let growth = runs.value(&rung.label, GROWTH) * f64::from(TURNS);
                format!("{}: deviator times {:.6}", rung.label, libm::exp(growth))
            });
            verdict.for_the_record.extend(line);
            continue;
        }
        let Some(finest) = own.last() else {
            continue;
        };
        let increment = SHEAR / f64::from(Variant::steps_per(finest));
        let (bound, reason) = match variant.update {
            Update::HughesWinget => (increment, "the strain of a step is not turned by half"),
            Update::Forward => (
                (1.0 + SHEAR) * increment,
                "the strain of a step is not turned by half, and the stress grows by half of its square",
            ),
        };
        let mut rules = vec![error(OFF).at_most(bound, reason)];
        if own.len() > 1 {
            rules.push(order(OFF).at_least(0.95, "order 1: the strain is not turned"));
        }
        let gates = rules.iter().map(|rule| runs.gate_of(variant.name, rule));
        verdict.gates.extend(gates);
        let table = runs.table(Some(variant.name), &[OFF]);
        verdict
            .tables
            .push((format!("{} to 3", variant.name), table));
    }
    verdict
}

/// End of the run \[s\].
fn end(rung: &Rung) -> f64 {
    let dt = 1.0 / f64::from(Variant::steps_per(rung));
    f64::from(rung.problem::<Variant>().steps(rung)) * dt
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, variant) = (rung.cell, *rung.problem::<Variant>());
    let axes = variant.dimension.axes();
    let cells = std::array::from_fn(|axis| {
        let [below, above] = variant.margins(axis);
        if axis < axes {
            below + WIDE as usize + above
        } else {
            1
        }
    });
    let mut mesh = Mesh::new(variant.dimension, [0.0; 3], [h; 3], cells);
    mesh.planes[..axes].fill([PlaneCondition::Free; 2]);
    // A step is as long as a shear, or a turn, of one second asks for.
    let dt = 1.0 / f64::from(Variant::steps_per(rung));
    let mut scene = bare_scene("shear_and_turn", variant.dimension, mesh, end(rung));
    scene.time_step = TimeStep::Fixed {
        dt,
        allow_unstable: false,
    };
    let elasticity = LAW.elasticity();
    let law = LinearElastic::with_rate(elasticity.young, elasticity.poisson, variant.rate());
    scene.materials = material("elastic", DENSITY, law);
    let lower = variant.lower(h);
    let mut upper = lower;
    for x in &mut upper[..axes] {
        *x += WIDE * h;
    }
    let mut block = body("block", 1, cuboid(lower, upper));
    block.particles_per_cell[..axes].fill(2);
    scene.bodies = vec![block];
    scene
}

fn options(rung: &Rung, _: Reference, mut options: Options) -> Options {
    let variant = *rung.problem::<Variant>();
    let motion = variant.motion(rung, end(rung) / f64::from(variant.steps(rung)));
    let [xx, yy, xy] = if variant.turns { STRESSED } else { [0.0; 3] };
    options.initial = Some(Arc::new(move |x| InitialState {
        velocity: motion.velocity(*x),
        stress: [xx, yy, 0.0, 0.0, 0.0, xy],
        ..AT_REST
    }));
    options.conditions.push(Arc::new(motion));
    options
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation) = (run.rung, &*run.simulation);
    let quantities = quantities(run.reference, *rung.problem::<Variant>(), rung, simulation);
    Ok(Measurements::of(quantities))
}
