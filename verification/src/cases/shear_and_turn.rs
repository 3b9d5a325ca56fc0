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
use super::vocabulary::moved::SetVelocity;
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

const fn shear(name: &'static str, update: Update, dimension: Dimension) -> Variant {
    Variant {
        name,
        turns: false,
        update,
        dimension,
    }
}

const fn turns(name: &'static str, update: Update, dimension: Dimension) -> Variant {
    Variant {
        turns: true,
        ..shear(name, update, dimension)
    }
}

const VARIANTS: [Variant; 8] = {
    use Dimension::{Three, Two};
    use Update::{Forward, HughesWinget};
    [
        shear("shear, Hughes-Winget", HughesWinget, Two),
        shear("shear, Jaumann", Forward, Two),
        turns("turns, Hughes-Winget", HughesWinget, Two),
        turns("turns, Jaumann", Forward, Two),
        shear("shear, Hughes-Winget 3D", HughesWinget, Three),
        shear("shear, Jaumann 3D", Forward, Three),
        turns("turns, Hughes-Winget 3D", HughesWinget, Three),
        turns("turns, Jaumann 3D", Forward, Three),
    ]
};

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

    /// Velocity of all nodes by place: one gradient \[1/s\] about a point, at steps of a length \[s\].
    fn motion(self, rung: &Rung, dt: f64) -> impl Fn(Vector) -> Vector + Copy + use<> {
        let lower = self.lower(rung.cell);
        let per = f64::from(Self::steps_per(rung));
        let (about, gradient) = if self.turns {
            let (sin, cos) = libm::sincos(TAU / per);
            let half = 0.5 * WIDE * rung.cell;
            let gradient = [[(cos - 1.0) / dt, -sin / dt], [sin / dt, (cos - 1.0) / dt]];
            ([lower[0] + half, lower[1] + half], gradient)
        } else {
            let rate = SHEAR / (per * dt);
            ([lower[0], lower[1]], [[0.0, rate], [0.0, 0.0]])
        };
        move |x| {
            let [a, b] = [x[0] - about[0], x[1] - about[1]];
            let [u, v] = gradient.map(|row| row[0] * a + row[1] * b);
            [u, v, 0.0]
        }
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
.gates_of_variants(&[
    error(PREDICTED)
        .at_most(1e-9, "the closed form of the update; round-off of some thousand steps is left")
        .of_each(),
    turned(error(GROWTH).at_most(1e-10, KEPT)),
    turned(error(PRESSURE).at_most(1e-10, KEPT)),
    grown(GROWTH, "the next term is 92/N² of exp(8 pi²/N)"),
    grown(PRESSURE, "chords for strain, 1 - cos"),
    error(OFF)
        .at_most_by(|rung| SHEAR / steps(rung), "the strain of a step is not turned by half")
        .on(|rung| kind(rung) == (false, Update::HughesWinget)),
    error(OFF)
        .at_most_by(
            |rung| (1.0 + SHEAR) * (SHEAR / steps(rung)),
            "the strain of a step is not turned by half, and the stress grows by half of its square",
        )
        .on(|rung| kind(rung) == (false, Update::Forward)),
    order(OFF)
        .at_least(0.95, "order 1: the strain is not turned")
        .on(|rung| !kind(rung).0)
        .of_several(),
])
.tables(&[TableRule::new("{variant} to 3", &[OFF]).of(|variant| variant.starts_with("shear"))])
.line_of_each(line)
.wrong_references(&[WRONG_STIFFNESS, WRONG_RATE])
.no_study(
    "all nodes move as prescribed, so that weighting functions, schemes and transfers have no say",
)
.no_guest("all nodes move as prescribed, and no scene file can say that");

const KEPT: &str = "turned by the midpoint rule a stress keeps its size";

/// Gate on turns by the midpoint rule.
const fn turned(gate: GateRule) -> GateRule {
    gate.of_each()
        .on(|rung| kind(rung) == (true, Update::HughesWinget))
}

/// Gate on what grows in turns by the forward rate.
const fn grown(quantity: &'static str, reason: &'static str) -> GateRule {
    error(quantity)
        .at_most_by(|rung| 100.0 / (steps(rung) * steps(rung)), reason)
        .of_each()
        .on(|rung| kind(rung) == (true, Update::Forward))
}

fn update(reference: Reference, variant: Variant) -> Update {
    match (variant.update, reference.of(&WRONG_RATE) != 0.0) {
        (Update::HughesWinget, false) | (Update::Forward, true) => Update::HughesWinget,
        _ => Update::Forward,
    }
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let (rung, reference) = (run.rung, run.reference);
    let variant = *rung.problem::<Variant>();
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
    let farthest = |of: &dyn Fn(PlaneStress) -> f64| {
        let stresses = (0..run.simulation.particles()).map(|p| run.stress(p));
        largest(stresses.map(|s| of([s[0], s[1], s[5]])))
    };
    let apart = |a: PlaneStress, b: PlaneStress| {
        libm::hypot(libm::hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2])
    };
    let size = libm::hypot(deviator(predicted), predicted[0] + predicted[1]);
    let off = farthest(&|s| apart(s, predicted) / size);
    let mut all = vec![Quantity::of_zero(PREDICTED, off)];
    if !variant.turns {
        let exact = sheared(SHEAR).map(|s| constants[1] * s);
        let off = farthest(&|s| libm::hypot(s[0] - exact[0], s[2] - exact[2]));
        all.push(Quantity::of_zero(OFF, off / elasticity.shear));
        return Ok(Measurements::of(all));
    }
    let grown = farthest(&|s| deviator(s) / deviator(STRESSED));
    let grown = libm::log(grown) / f64::from(TURNS);
    let pressure = farthest(&|s| 0.5 * (STRESSED[0] + STRESSED[1] - s[0] - s[1]));
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
    Ok(Measurements::of(all))
}

fn rungs(size: Size) -> Vec<Rung> {
    let steps = |variant: &Variant| match (size, variant.dimension) {
        (Size::Quick, Dimension::Three) => &STEPS[0][..1],
        (Size::Quick, Dimension::Two) | (Size::Full, Dimension::Three) => STEPS[0],
        (Size::Full, Dimension::Two) => STEPS[1],
    };
    Rung::of_problems(&VARIANTS, |v| v.name, "steps", CELLS_PER_STEP, steps)
}

/// Steps until all of the shear, or in a turn.
fn steps(rung: &Rung) -> f64 {
    f64::from(Variant::steps_per(rung))
}

/// True for turns, and the update.
fn kind(rung: &Rung) -> (bool, Update) {
    let variant = rung.problem::<Variant>();
    (variant.turns, variant.update)
}

/// The factor of the deviator in all turns.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    kind(rung).0.then(|| {
        let growth = run.value(GROWTH) * f64::from(TURNS);
        format!("{}: deviator times {:.6}", rung.label, libm::exp(growth))
    })
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
    scene.time_step = equal_steps_of(dt);
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
        velocity: motion(*x),
        stress: [xx, yy, 0.0, 0.0, 0.0, xy],
        ..AT_REST
    }));
    let nodes = SetVelocity::by(move |x, _| motion(x));
    options.conditions.push(Arc::new(nodes));
    options
}
