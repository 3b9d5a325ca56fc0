//! Clay footing: the load that wet clay bears under a strip footing, undrained and drained.
//!
//! Exact loads stand in `exact/bearing.rs`. Half of a rough footing of the width B stands on ground of two phases without weight,
//! as in *footing*: nodes press from rest to rest, soil and water alike, since the footing is shut, and their force is its load. The
//! surface beside it is drained.
//!
//! - *undrained*: a skeleton that has a cohesion c alone, under water a hundred times as stiff that cannot leave: 2 + pi times c.
//!   The pressure of the water is in the load, and no part of the strength.
//! - *drained*: a skeleton of 20° and the same cohesion, whose pores drain in a hundredth of the time of the footing: N_c c by the
//!   strength of the effective stress. Flow normal to the surface of Mohr and Coulomb widens the ground, which takes up water.
//!
//! Loads come from above, for the reasons that *footing* has, and strengths are 1e-6 of Young's modulus, so that nothing moves by more
//! than a thousandth of a cell. `proctor verify clay-footing`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use super::vocabulary::press::Press;
use crate::exact::bearing::Ground;

const WIDTH: f64 = 2.0; // Width of the footing, B [m]
const YOUNG: f64 = 1e6; // Young's modulus of the skeleton [Pa]
const POISSON: f64 = 0.3;
const STRENGTH: f64 = 1.0; // Cohesion [Pa]
/// Looks at the load on the way; it is judged over the last of these intervals.
const LOOKS: u32 = 40;

const UNDRAINED: &str = "undrained";
const DRAINED: &str = "drained";

const LOAD: &str = "load of the footing";
const PRESSURE: &str = "mean pressure of the water over the load";

const WRONG_STRENGTH: Wrong =
    Wrong::factor("strength", 0.75).breaks(|gate| gate.ends_with(LOAD) && !gate.contains("order"));
const STRONGER: Wrong =
    Wrong::factor("strength", 1.4).breaks(|gate| gate.contains("footing over the exact one"));

/// The footing on wet clay.
pub static CLAY_FOOTING: Case = Case::new(
    "clay-footing",
    "What does wet clay carry below a strip footing that comes faster than its pores drain, and what one that comes slowly?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.solve_by(solve)
.judge_by(judge)
.wrong_references(&[WRONG_STRENGTH, STRONGER])
.no_study("its load is a limit that means over cells decide, which are no setting of a study")
.no_guest("no other solver of the protocol knows pore water");

fn rungs(size: Size) -> Vec<Rung> {
    let cells: &[u32] = match size {
        Size::Quick => &[4, 8],
        Size::Full => &[4, 8, 16],
    };
    let of =
        |variant: &'static str| Rung::counted(variant, &format!("{variant}, B/h"), WIDTH, cells);
    [UNDRAINED, DRAINED].into_iter().flat_map(of).collect()
}

fn is_drained(rung: &Rung) -> bool {
    rung.variant == DRAINED
}

fn ground(rung: &Rung) -> Ground {
    Ground {
        friction: if is_drained(rung) { 20.0 } else { 0.0 },
        cohesion: STRENGTH,
        surcharge: 0.0,
    }
}

/// The exact pressure at which the ground gives way \[Pa\], as the case refers to it.
fn exact_load(reference: Reference, rung: &Rung) -> f64 {
    let factor = reference.of(&WRONG_STRENGTH) * reference.of(&STRONGER);
    factor * ground(rung).bearing()
}

/// Width of the half and depth of the ground \[m\], in halves of B: what moves, a tenth more aside and a half below.
fn extent(rung: &Rung) -> [f64; 2] {
    let [aside, deep] = ground(rung).reach();
    [1.1 * aside, 1.5 * deep].map(|reach| 0.5 * WIDTH * (2.0 * reach).ceil())
}

/// Distance that the footing goes \[m\]: three to four times what elastic ground would let it sink at the exact load.
fn way(rung: &Rung) -> f64 {
    let times = if is_drained(rung) { 4.0 } else { 3.0 };
    times * ground(rung).bearing() * WIDTH * (1.0 - POISSON * POISSON) / YOUNG
}

/// Confined modulus of the skeleton \[Pa\].
fn confined() -> f64 {
    YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
}

fn water(rung: &Rung) -> PoreWater {
    // Water that leaves need not be stiff, and in a hundredth of the time its way is as long as the ground is deep: the coefficient
    // of consolidation, k E_c/(rho g), is 130 m²/s.
    let (stiff, conductivity) = if is_drained(rung) {
        (5.0, 1.0)
    } else {
        (100.0, 1e-10)
    };
    PoreWater {
        bulk: stiff * POROSITY * confined(),
        ..pore_water(POROSITY, conductivity)
    }
}

/// Time that it takes \[s\], in which a wave of shear runs so many times over its width, as in *footing*.
fn time(rung: &Rung) -> f64 {
    let times = if is_drained(rung) { 150.0 } else { 60.0 };
    let saturated = (1.0 - POROSITY) * GRAINS + POROSITY * WATER;
    times * WIDTH / (YOUNG / (2.0 * (1.0 + POISSON)) / saturated).sqrt()
}

fn press(rung: &Rung) -> Press {
    let (way, time) = (way(rung), time(rung));
    let down = move |at: f64| -way / time * smooth(at / time)[1];
    Press::smooth(extent(rung)[1], rung.cell, down)
        .up_to(0.5 * WIDTH)
        .rough(true)
        .on_water()
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let [wide, deep] = extent(rung);
    let mut mesh = strip(h, [cells(wide, h), cells(deep, h) + 1]);
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = plane_scene("clay_footing", mesh, time(rung));
    scene.water_planes[1][1] = PlaneCondition::Free;
    let law: AnyLaw = if is_drained(rung) {
        let friction = ground(rung).friction;
        MohrCoulomb::new(YOUNG, POISSON, [friction, STRENGTH, friction]).into()
    } else {
        Tresca::new(YOUNG, POISSON, STRENGTH).into()
    };
    scene.materials = material(rung.variant, GRAINS, law);
    scene.pore_water = vec![Some(water(rung))];
    scene.bodies = vec![body("ground", 1, rectangle([0.0; 2], [wide, deep]))];
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    Settings::new(Method::DEFAULT).apply(&mut scene);
    scene
}

fn solve(
    rung: &Rung,
    reference: Reference,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<RungResult, Failure> {
    let press = Arc::new(press(rung));
    let mut options = options.clone();
    options.conditions.push(press.clone());
    simulate(
        scene(rung, &Settings::new(Method::DEFAULT)),
        &options,
        |simulation| sink(reference, rung, &press, simulation, observer),
    )
}

/// Presses the footing down and reads its load.
fn sink(
    reference: Reference,
    rung: &Rung,
    press: &Press,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
) -> Result<Measurements, Failure> {
    let exact = exact_load(reference, rung);
    let (mut points, mut load, mut given) = (vec![], f64::NAN, 0.0);
    let mut from = 0.0;
    for look in 1..=LOOKS {
        let share = f64::from(look) / f64::from(LOOKS);
        run_until(simulation, share * time(rung), observer, |_| {})?;
        // Velocities, and so impulses, are half a step behind.
        let until = simulation.velocity_time();
        let impulse = press.impulse();
        load = (impulse - given) / (until - from) / (0.5 * WIDTH);
        (given, from) = (impulse, until);
        points.push(CurvePoint::new(
            way(rung) / WIDTH * YOUNG / STRENGTH * smooth(share - 0.5 / f64::from(LOOKS))[0],
            load / STRENGTH,
            exact / STRENGTH,
        ));
    }
    let count = simulation.sets()[0].len();
    let all = (0..count).map(|p| pore_pressure(simulation, 0, p));
    let mean = all.sum::<f64>() / count as f64;
    let curve = Curve::new(
        format!("load over settlement, {}", rung.label),
        [
            "settlement over B, times Young's modulus over strength",
            "mean pressure over strength",
        ],
        points,
    );
    Ok(Measurements::of([
        Quantity::compared(LOAD, load, exact, "Pa"),
        Quantity::figure(PRESSURE, mean / load, "1"),
    ])
    .drawn(curve))
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for variant in [UNDRAINED, DRAINED] {
        let own = runs.rungs.iter().filter(|rung| rung.variant == variant);
        for rung in own.clone() {
            let load = runs.run(&rung.label).and_then(|run| run.quantity(LOAD));
            let over = load.and_then(|load| Some(load.value / load.exact?));
            let over = over.unwrap_or(f64::NAN);
            let cell = (rung.cell / WIDTH).max(1.0 / 16.0);
            let (bound, reason) = if is_drained(rung) {
                (
                    2.0 * cell,
                    "as in *footing*: the moving part is at most as wide as the footing and a cell on either side",
                )
            } else {
                (
                    0.8 * cell,
                    "as in *footing*: five percent at h = B/16, and as much more in larger cells",
                )
            };
            let below = "loads come from above, less two percent for water that is not yet at rest";
            verdict.gates.extend([
                Gate::at_most(format!("{}: {LOAD}", rung.label), over - 1.0, bound, reason),
                Gate::at_least(
                    format!("{}: {LOAD} over the exact one", rung.label),
                    over,
                    0.98,
                    below,
                ),
            ]);
        }
        if own.count() > 1 {
            let reason = "falls with h: the edge of the footing is a share of a cell";
            let rule = order(LOAD).at_least(0.7, reason);
            verdict.gates.push(runs.gate_of(variant, &rule));
        }
        let table = runs.table(Some(variant), &[LOAD]);
        let title = format!("clay-footing, {variant}, uGIMP, USL, FLIP");
        verdict.tables.push((title, table));
    }
    verdict
}
