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
use super::vocabulary::footing::{self, Footing, LOAD, STRONGER, WRONG_STRENGTH};
use super::vocabulary::press::Press;
use crate::exact::bearing::Ground;

const WIDTH: f64 = 2.0; // Width of the footing, B [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const DENSITY: f64 = 1.0; // Density [kg/m³]; it sets a time
/// Strength without friction, cohesion, and pressure beside the footing, where there is one \[Pa\].
const STRENGTH: f64 = 1.0;

/// The load where it has no limit.
const SHARE: &str = "load over the exact one";
/// The load as the pressure on B + h, half a cell more on each side.
const WIDER: &str = "load on B + h over the exact one";

const LOCKED: &str = "locked"; // Ground without means over cells

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
        name: LOCKED,
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

    fn footing(&self) -> Footing {
        Footing {
            width: WIDTH,
            ground: self.ground(),
            young: YOUNG,
            poisson: self.poisson(),
            time: self.time(),
        }
    }

    /// Time that it takes \[s\], in which a wave of shear runs so many times over its width: stresses by inertia are some
    /// thousandths of the load.
    fn time(&self) -> f64 {
        let times = match self.friction {
            0.0 => 60.0,
            f if f < 25.0 => 150.0,
            _ => 300.0,
        };
        times * WIDTH / s_wave_speed(YOUNG, self.poisson(), DENSITY)
    }
}

const WRONG_FRICTION: Wrong = Wrong::factor("angle of friction", 0.8)
    .breaks(|gate| gate.contains("deg") && gate.ends_with(LOAD) && !gate.contains("order"))
    .spares(|gate| gate.contains("Tresca"));

/// The strip footing.
pub static FOOTING: Case = Case::new("footing", "What does ground carry below a strip footing, and does it lock without means over cells?")
    .ladder(Ladder::made(rungs))
    .scene(scene)
    .solve_by(solve)
    .gates_of_variants(&[
    value(SHARE)
        .at_least(
            1.2,
            "locked: ground that did not lock without means over cells would prove nothing of them",
        )
        .of_each()
        .on(locks),
    footing::above(
        |rung| 0.8 * footing::coarse(rung, WIDTH),
        "five percent at h = B/16, and as much more in larger cells",
    )
    .on(|rung| yields_with(rung, false)),
    footing::above(
        |rung| 2.0 * footing::coarse(rung, WIDTH),
        "the moving part is at most as wide as the footing and a cell on either side",
    )
    .on(|rung| yields_with(rung, true)),
    footing::below(1.0, "loads come from above: the nodes have fewer ways to move than the ground")
        .on(|rung| !locks(rung)),
    footing::ORDER.on(|rung| !locks(rung)),
])
    .tables(&[TableRule::new("footing, {variant}, linear, USL, FLIP", &[LOAD]).of(|name| name != LOCKED)])
    .line_of_each(|rung, run| locks(rung).then(|| format!(
        "{}: locked, {:.2} times the exact load without means over cells, and no limit",
        rung.label,
        run.value(SHARE)
    )))
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
    let beside = [exact, STRENGTH];
    let footing = variant.footing();
    let (pressure, curve) = footing.sink(press, simulation, observer, beside, &rung.label)?;
    let wider = WIDTH / (WIDTH + rung.cell);
    let mut quantities = vec![if variant.locks() {
        Quantity::figure(SHARE, pressure / exact, "1")
    } else {
        Quantity::compared(LOAD, pressure, exact, "Pa")
    }];
    quantities.push(Quantity::figure(WIDER, wider * pressure / exact, "1"));
    Ok(Measurements::of(quantities).drawn(curve))
}

fn rungs(size: Size) -> Vec<Rung> {
    let cells = |variant: &Variant| variant.cells[usize::from(size == Size::Full)];
    Rung::of_problems(&VARIANTS, |v| v.name, "B/h", WIDTH, cells)
}

fn locks(rung: &Rung) -> bool {
    rung.problem::<Variant>().locks()
}

/// True for the rungs of ground that does not lock, with friction or without.
fn yields_with(rung: &Rung, friction: bool) -> bool {
    !locks(rung) && (rung.problem::<Variant>().friction > 0.0) == friction
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, variant) = (rung.cell, *rung.problem::<Variant>());
    let [wide, deep] = variant.footing().extent();
    let mut mesh = strip(h, [cells(wide, h), cells(deep, h) + 1]);
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = plane_scene("footing", mesh, variant.time());
    scene.volumetric_strain = variant.volumes;
    scene.materials = material(variant.name, DENSITY, variant.law());
    let mut ground = body("ground", 1, rectangle([0.0; 2], [wide, deep]));
    let surcharge = variant.ground().surcharge;
    if surcharge > 0.0 {
        ground.initial_stress = InitialStress::Isotropic(-surcharge);
        let (edge, end) = ([0.5 * WIDTH, deep, 0.0], [wide, deep, 0.0]);
        scene.tractions = traction(edge, end, [0.0, -surcharge, 0.0]);
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
    let variant = rung.problem::<Variant>();
    let press = variant.footing().press(rung.cell).rough(variant.rough);
    let press = Arc::new(press);
    let mut options = options.clone();
    options.conditions.push(press.clone());
    simulate(
        scene(rung, &Settings::new(Method::DEFAULT)),
        &options,
        |simulation| sink(reference, rung, &press, simulation, observer),
    )
}
