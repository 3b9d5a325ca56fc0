//! What does ground carry below a strip footing, and does it lock without means over cells?
//!
//! Exact loads stand in `exact/bearing.rs`. Half of a footing of the width B in plane strain stands on
//! ground without weight, which is elastic and perfectly plastic with flow normal to its surface. Nodes at the surface up to
//! x = B/2 are pressed down and held across: the footing is rough (*smooth*: they slide; the exact load is the same). What
//! they need is its load. They go from rest to rest as 10 s³ - 15 s⁴ + 6 s⁵, and the load is read when they have come to
//! rest, so that neither inertia nor a rate is in it. There is no damping: with any, ground that is about to move pushes back
//! with more than its strength.
//!
//! - *Tresca*: 2 + pi times the strength, with means of the volumetric strain over cells.
//! - *locked*: the same with the strain of each particle. Cells have more conditions of constant volume than nodes can meet:
//!   the load has no limit. Shown, and gated from below.
//! - *20 deg*, *30 deg*: Mohr and Coulomb, once by cohesion alone (N_c) and once by a pressure on the surface beside the
//!   footing alone (N_q), which the ground has within from the start.
//!
//! Loads come from above: nodes carry the velocity of the footing one cell beyond its edge, so that what moves is up to
//! B + 2h wide. That is what bounds the error, and half of it is what is found; with friction some locking stays, since
//! flow widens every particle by its own shear and a cell has one volume.
//!
//! Strengths are 1e-6 of Young's modulus, so that nothing moves by more than a thousandth of a cell: the load is the same
//! for any modulus, and no change of shape is in it. Linear functions: a domain that reached past the surface would have
//! nodes there which nothing holds. `proctor verify footing`.

mod pressed;

use super::prelude::*;
use super::vocabulary::moved::smooth;
use super::vocabulary::press::Press;
use crate::exact::bearing::Ground;

const WIDTH: f64 = 2.0; // Width of the footing, B [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const DENSITY: f64 = 1.0; // Density [kg/m³]; it sets a time
/// Strength without friction, cohesion, and pressure beside the footing, where there is one \[Pa\].
const STRENGTH: f64 = 1.0;
/// Looks at the load on the way; it is judged over the last of these intervals, in which the footing goes a ten thousandth
/// of its way.
const LOOKS: u32 = 40;

/// Name of the load among the quantities, and of the same where it has no limit.
const LOAD: &str = "load of the footing";
const SHARE: &str = "load over the exact one";
/// The load as the pressure on B + h, half a cell more on each side.
const WIDER: &str = "load on B + h over the exact one";

/// Problem of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Variant {
    name: &'static str,
    /// Angle of friction \[°\].
    friction: f64,
    /// True if a pressure beside the footing carries it, and not cohesion.
    pressed: bool,
    rough: bool,
    volumes: VolumetricStrain,
    /// Cells over the width, coarse to fine, on the short ladder and on the whole one.
    cells: [&'static [u32]; 2],
}

const CLAY: Variant = Variant {
    name: "Tresca",
    friction: 0.0,
    pressed: false,
    rough: true,
    volumes: VolumetricStrain::CellAverage,
    cells: [&[4, 8], &[8, 16, 32]],
};
const SAND: Variant = Variant {
    name: "20 deg, cohesion",
    friction: 20.0,
    ..CLAY
};
static VARIANTS: [Variant; 7] = [
    CLAY,
    Variant {
        name: "smooth",
        rough: false,
        cells: [&[4], &[8, 16]],
        ..CLAY
    },
    Variant {
        name: "locked",
        volumes: VolumetricStrain::Particle,
        cells: [&[8], &[8, 16]],
        ..CLAY
    },
    SAND,
    Variant {
        name: "20 deg, surcharge",
        pressed: true,
        cells: [&[4], &[8, 16]],
        ..SAND
    },
    Variant {
        name: "30 deg, cohesion",
        friction: 30.0,
        cells: [&[4], &[8, 16, 32]],
        ..SAND
    },
    Variant {
        name: "30 deg, surcharge",
        friction: 30.0,
        pressed: true,
        cells: [&[4], &[8, 16]],
        ..SAND
    },
];

impl Variant {
    fn locks(&self) -> bool {
        self.volumes == VolumetricStrain::Particle
    }

    fn ground(&self) -> Ground {
        let (cohesion, surcharge) = if self.pressed {
            (0.0, STRENGTH)
        } else {
            (STRENGTH, 0.0)
        };
        Ground {
            friction: self.friction,
            cohesion,
            surcharge,
        }
    }

    /// Nearly incompressible clay, as it is when it is not drained.
    fn poisson(&self) -> f64 {
        if self.friction == 0.0 { 0.49 } else { 0.3 }
    }

    fn law(&self) -> AnyLaw {
        let Ground {
            friction, cohesion, ..
        } = self.ground();
        if friction == 0.0 {
            Tresca::new(YOUNG, self.poisson(), cohesion).into()
        } else {
            let strength = [friction, cohesion, friction];
            MohrCoulomb::new(YOUNG, self.poisson(), strength).into()
        }
    }

    /// Width of the half and depth of the ground \[m\], in halves of B: what moves, a tenth more aside and a half below.
    fn extent(&self) -> [f64; 2] {
        let [aside, deep] = self.ground().reach();
        [1.1 * aside, 1.5 * deep].map(|reach| 0.5 * WIDTH * (2.0 * reach).ceil())
    }

    /// Distance that the footing goes \[m\]: three to four times what elastic ground would let it sink at the exact load.
    fn way(&self) -> f64 {
        let ground = self.ground();
        let load = ground.bearing() - ground.surcharge;
        let times = if self.friction == 0.0 { 3.0 } else { 4.0 };
        times * load * WIDTH * (1.0 - self.poisson().powi(2)) / YOUNG
    }

    /// Time that it takes \[s\], in which a wave of shear runs so many times over its width: stresses by inertia are some
    /// thousandths of the load.
    fn time(&self) -> f64 {
        let times = match self.friction {
            0.0 => 60.0,
            f if f < 25.0 => 150.0,
            _ => 300.0,
        };
        let speed = (YOUNG / (2.0 * (1.0 + self.poisson())) / DENSITY).sqrt();
        times * WIDTH / speed
    }

    fn press(&self, cell: f64) -> Press {
        let (way, time) = (self.way(), self.time());
        let down = move |at: f64| -way / time * smooth(at / time)[1];
        Press::smooth(self.extent()[1], cell, down)
            .up_to(0.5 * WIDTH)
            .rough(self.rough)
    }
}

const WRONG_STRENGTH: Wrong =
    Wrong::factor("strength", 0.75).breaks(|gate| gate.ends_with(LOAD) && !gate.contains("order"));
const STRONGER: Wrong =
    Wrong::factor("strength", 1.4).breaks(|gate| gate.contains("footing over the exact one"));
const WRONG_FRICTION: Wrong = Wrong::factor("angle of friction", 0.8)
    .breaks(|gate| gate.contains("deg") && gate.ends_with(LOAD) && !gate.contains("order"))
    .spares(|gate| gate.contains("Tresca"));

/// The strip footing.
pub static FOOTING: Case = Case::new("footing", "What does ground carry below a strip footing, and does it lock without means over cells?")
    .ladder(Ladder::made(rungs))
    .scene(scene)
    .solve_by(solve)
    .judge_by(judge)
    .wrong_references(&[WRONG_STRENGTH, STRONGER, WRONG_FRICTION])
.refer_by(refer)
    .no_study("its load is a limit that means over cells decide, which are no setting of a study, and a run takes minutes")
    .guests_along(&pressed::PATH)
    .guest(|rung| Ok(pressed::pressed(rung)));

/// The exact pressure at which the ground of a rung gives way \[Pa\], as the case refers to it.
fn exact_load(reference: Reference, rung: &Rung) -> f64 {
    let ground = rung.problem::<Variant>().ground();
    Ground {
        friction: reference.of(&WRONG_FRICTION) * ground.friction,
        cohesion: reference.of(&WRONG_STRENGTH) * ground.cohesion,
        surcharge: reference.of(&WRONG_STRENGTH) * ground.surcharge,
    }
    .bearing()
}

/// Results do not depend on the reference, but for the exact value beside them.
fn refer(rung: &Rung, reference: Reference, solved: &mut RungResult) {
    for q in &mut solved.quantities {
        if let Some(exact) = q.exact.as_mut() {
            *exact = exact_load(reference, rung);
            q.error = Some((q.value / *exact - 1.0).abs());
        }
    }
}

/// Presses the footing down and reads its load.
fn sink(
    reference: Reference,
    rung: &Rung,
    press: &Press,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
) -> Result<Measurements, Failure> {
    let variant = *rung.problem::<Variant>();
    let exact = exact_load(reference, rung);
    let (mut points, mut pressure, mut given) = (vec![], f64::NAN, 0.0);
    let mut from = 0.0;
    for look in 1..=LOOKS {
        let share = f64::from(look) / f64::from(LOOKS);
        run_until(simulation, share * variant.time(), observer, |_| {})?;
        // Velocities, and so impulses, are half a step behind.
        let until = simulation.velocity_time();
        let impulse = press.impulse();
        pressure = (impulse - given) / (until - from) / (0.5 * WIDTH);
        (given, from) = (impulse, until);
        points.push(CurvePoint::new(
            variant.way() / WIDTH * YOUNG / STRENGTH * smooth(share - 0.5 / f64::from(LOOKS))[0],
            pressure / STRENGTH,
            exact / STRENGTH,
        ));
    }
    let wider = WIDTH / (WIDTH + rung.cell);
    let mut quantities = vec![if variant.locks() {
        Quantity::figure(SHARE, pressure / exact, "1")
    } else {
        Quantity::compared(LOAD, pressure, exact, "Pa")
    }];
    quantities.push(Quantity::figure(WIDER, wider * pressure / exact, "1"));
    let curve = Curve::new(
        format!("load over settlement, {}", rung.label),
        [
            "settlement over B, times Young's modulus over strength",
            "mean pressure over strength",
        ],
        points,
    );
    Ok(Measurements::of(quantities).drawn(curve))
}

fn rungs(size: Size) -> Vec<Rung> {
    let of = |variant: &'static Variant| {
        let cells = variant.cells[usize::from(size == Size::Full)];
        let word = format!("{}, B/h", variant.name);
        let rungs = Rung::counted(variant.name, &word, WIDTH, cells);
        rungs.into_iter().map(|rung| rung.with(*variant))
    };
    VARIANTS.iter().flat_map(of).collect()
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    let above = "loads come from above: the nodes have fewer ways to move than the ground";
    for variant in VARIANTS {
        let own = runs
            .rungs
            .iter()
            .filter(|rung| rung.variant == variant.name);
        for rung in own.clone() {
            if variant.locks() {
                let gate = Gate::at_least(
                    format!("{}: {SHARE}", rung.label),
                    runs.value(&rung.label, SHARE),
                    1.2,
                    "locked: ground that did not lock without means over cells would prove nothing of them",
                );
                verdict.gates.push(gate);
                continue;
            }
            let load = runs.run(&rung.label).and_then(|run| run.quantity(LOAD));
            let over = load.and_then(|load| Some(load.value / load.exact?));
            let over = over.unwrap_or(f64::NAN);
            // No finer than B/16: there the order says how the rest falls.
            let cell = (rung.cell / WIDTH).max(1.0 / 16.0);
            let (bound, reason) = if variant.friction == 0.0 {
                (
                    0.8 * cell,
                    "five percent at h = B/16, and as much more in larger cells",
                )
            } else {
                (
                    2.0 * cell,
                    "the moving part is at most as wide as the footing and a cell on either side",
                )
            };
            verdict.gates.extend([
                Gate::at_most(format!("{}: {LOAD}", rung.label), over - 1.0, bound, reason),
                Gate::at_least(
                    format!("{}: {LOAD} over the exact one", rung.label),
                    over,
                    1.0,
                    above,
                ),
            ]);
        }
        if variant.locks() {
            continue;
        }
        let table = runs.table(Some(variant.name), &[LOAD]);
        if own.count() > 1 {
            let reason = "falls with h: the edge of the footing is a share of a cell";
            let rule = order(LOAD).at_least(0.7, reason);
            verdict.gates.push(runs.gate_of(variant.name, &rule));
        }
        let title = format!("footing, {}, linear, USL, FLIP", variant.name);
        verdict.tables.push((title, table));
    }
    let locked = |rung: &&Rung| rung.problem::<Variant>().locks();
    verdict.for_the_record = runs
        .rungs
        .iter()
        .filter(locked)
        .map(|rung| {
            format!(
                "{}: locked, {:.2} times the exact load without means over cells, and no limit",
                rung.label,
                runs.value(&rung.label, SHARE)
            )
        })
        .collect();
    verdict
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, variant) = (rung.cell, *rung.problem::<Variant>());
    let [wide, deep] = variant.extent();
    let cells = |length: f64| (length / h).round() as usize;
    let mut mesh = Mesh::new(
        Dimension::Two,
        [0.0; 3],
        [h; 3],
        [cells(wide), cells(deep) + 1, 1],
    );
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = plane_scene("footing", mesh, variant.time());
    scene.volumetric_strain = variant.volumes;
    scene.materials = material(variant.name, DENSITY, variant.law());
    let mut ground = body("ground", 1, rectangle([0.0; 2], [wide, deep]));
    let surcharge = variant.ground().surcharge;
    if surcharge > 0.0 {
        ground.initial_stress = InitialStress::Isotropic(-surcharge);
        scene.tractions = vec![Traction {
            p1: [0.5 * WIDTH, deep, 0.0],
            p2: [wide, deep, 0.0],
            traction: [0.0, -surcharge, 0.0].into(),
        }];
    }
    scene.bodies = vec![ground];
    let method = Method::DEFAULT.with_weighting(Weighting::Linear);
    Settings::new(method).apply(&mut scene);
    scene
}

fn solve(
    rung: &Rung,
    reference: Reference,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<RungResult, Failure> {
    let press = Arc::new(rung.problem::<Variant>().press(rung.cell));
    let mut options = options.clone();
    options.conditions.push(press.clone());
    simulate(
        scene(rung, &Settings::new(Method::DEFAULT)),
        &options,
        |simulation| sink(reference, rung, &press, simulation, observer),
    )
}
