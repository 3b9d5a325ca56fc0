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
use super::vocabulary::footing::{self, Footing, LOAD, STRONGER, WRONG_STRENGTH};
use super::vocabulary::press::Press;
use crate::exact::bearing::Ground;

const WIDTH: f64 = 2.0; // Width of the footing, B [m]
const YOUNG: f64 = 1e6; // Young's modulus of the skeleton [Pa]
const POISSON: f64 = 0.3;
const STRENGTH: f64 = 1.0; // Cohesion [Pa]

const UNDRAINED: &str = "undrained";
const DRAINED: &str = "drained";

const PRESSURE: &str = "mean pressure of the water over the load";

/// The footing on wet clay.
pub static CLAY_FOOTING: Case = Case::new(
    "clay-footing",
    "What does wet clay carry below a strip footing that comes faster than its pores drain, and what one that comes slowly?",
)
.ladder(Ladder::variants(
    &[UNDRAINED, DRAINED],
    ", ",
    "B/h",
    WIDTH,
    [&[4, 8], &[4, 8, 16]],
))
.scene(scene)
.solve_by(solve)
.gates_of_variants(&[
    footing::above(
        |rung| 0.8 * footing::coarse(rung, WIDTH),
        "as in *footing*: five percent at h = B/16, and as much more in larger cells",
    )
    .of(UNDRAINED),
    footing::above(
        |rung| 2.0 * footing::coarse(rung, WIDTH),
        "as in *footing*: the moving part is at most as wide as the footing and a cell on either side",
    )
    .of(DRAINED),
    footing::below(
        0.98,
        "loads come from above, less two percent for water that is not yet at rest",
    ),
    footing::ORDER,
])
.tables(&[TableRule::new("clay-footing, {variant}, uGIMP, USL, FLIP", &[LOAD])])
.wrong_references(&[WRONG_STRENGTH, STRONGER])
.no_study("its load is a limit that means over cells decide, which are no setting of a study")
.no_guest("no other solver of the protocol knows pore water");

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

fn footing(rung: &Rung) -> Footing {
    Footing {
        width: WIDTH,
        ground: ground(rung),
        young: YOUNG,
        poisson: POISSON,
        time: time(rung),
    }
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

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let [wide, deep] = footing(rung).extent();
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
    let press = footing(rung).press(rung.cell).rough(true).on_water();
    let press = Arc::new(press);
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
    let beside = [exact, STRENGTH];
    let (load, curve) = footing(rung).sink(press, simulation, observer, beside, &rung.label)?;
    let count = simulation.sets()[0].len();
    let all = (0..count).map(|p| pore_pressure(simulation, 0, p));
    let mean = all.sum::<f64>() / count as f64;
    Ok(Measurements::of([
        Quantity::compared(LOAD, load, exact, "Pa"),
        Quantity::figure(PRESSURE, mean / load, "1"),
    ])
    .drawn(curve))
}
