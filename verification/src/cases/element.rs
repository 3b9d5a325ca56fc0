//! Do the laws give their exact answers at a material point, whatever the state that they return?
//!
//! No grid takes part: the kernel's own law strains one point along a path whose answer has a
//! closed form (`exact/two_slopes.rs`, `exact/material_point.rs`). Where the direction of flow stays, an implicit return is
//! exact for any step; elsewhere it is of order 1. Beside the paths each law returns random states far outside its surface, and
//! those of a list of corners: the stress must lie on the surface, stay there when asked again, turn with the axes, dissipate, and
//! have the same bits on all lanes. `proctor verify element`; the verb `element` draws such paths of a user's materials.

mod clay;
mod returns;

use proctor_laws::{CamClay, Point};

use super::prelude::*;
use crate::exact::material_point::{ShearedSoil, bingham, held_dilation, to_and_fro, turned};
use crate::exact::two_slopes::TwoSlopes;

const DENSITY: f64 = 1.0; // Density [kg/m³]; stresses do not ask for it
/// Young's modulus of all solids \[Pa\], and Poisson's ratios of those without friction and with it.
const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.3;
const POISSON_OF_SOIL: f64 = 0.2;
/// Yield stress of von Mises, and the modulus by which it hardens \[Pa\].
const YIELD: f64 = 0.1;
const HARDENING: f64 = 10.0;
/// Friction \[°\], cohesion \[Pa\], dilation \[°\] of the soil that is pressed.
const SOIL: [f64; 3] = [20.0, 0.03, 5.0];
/// Constants of the soils that are sheared, without dilation and with it.
const FIRM: [f64; 3] = [30.0, 0.02, 0.0];
const DILATANT: [f64; 3] = [30.0, 0.02, 12.0];
/// Normal stresses in the plane of shear, and across, of the soil under weight \[Pa\].
const WEIGHT: [f64; 3] = [-0.6, -1.0, -0.75];
const PRESSURE: f64 = 1.0; // Pressure around the soil that dilates, and of the clay [Pa]
/// Shear modulus, viscosity and yield stress of Bingham's fluid \[Pa, Pa s, Pa\], and the rate of its shear \[1/s\].
const MUD: [f64; 3] = [500.0, 20.0, 2.0];
const RATE: f64 = 1.5;
const BULK: f64 = 1.0e4; // Bulk modulus of the fluid [Pa]
const BEYOND: f64 = 4.0; // Strain at the end of a path over that at which it first yields

const STRESS: &str = "difference of stress over the stress"; // Names of the quantities of paths
/// Steps of a path whose answer does not depend on them, and of one of order 1.
const ANY: &[u32] = &[1, 10, 100];
const LADDER: [&[u32]; 2] = [&[50, 100, 200], &[50, 100, 200, 400, 800]];
/// Random states that each law returns.
const STATES: [&[u32]; 2] = [&[500], &[5000]];
const RETURNS: &str = "returns"; // The variant of returns

/// A path of strain and its answer.
struct Path {
    name: &'static str,
    /// True if the answer does not depend on the number of steps.
    exact: bool,
    law: fn() -> AnyLaw,
    /// Stress at the start xx, yy, zz, yz, xz, xy \[Pa\].
    start: [f64; 6],
    /// Strains, one after the other, each reached in the steps of the rung but for the first, which is one step: it ends where
    /// the law first yields.
    parts: fn() -> Vec<[f64; 6]>,
    /// Seconds of the first part and of all others; what does not depend on them has a second each.
    times: fn() -> [f64; 2],
    /// Stress \[Pa\] after a way, given a factor on a modulus. The way is the sum of all strains or angles to and fro.
    answer: fn(f64, f64) -> [f64; 6],
}

/// Lamé's constants \[Pa\].
fn lame(poisson: f64) -> [f64; 2] {
    let shear = YOUNG / (2.0 * (1.0 + poisson));
    [2.0 * shear * poisson / (1.0 - 2.0 * poisson), shear]
}

const fn along(e: f64) -> [f64; 6] {
    [0.0, 0.0, e, 0.0, 0.0, 0.0]
}

/// The strain of an angle in x and y.
const fn sheared(angle: f64) -> [f64; 6] {
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * angle]
}

/// A second for each part.
fn any_time() -> [f64; 2] {
    [1.0, 1.0]
}

/// Compression to [`BEYOND`] times the strain at which it yields.
fn pressed(solid: &TwoSlopes) -> Vec<[f64; 6]> {
    let first = solid.limit / solid.confined_modulus();
    vec![along(-first), along(-(BEYOND - 1.0) * first)]
}

/// Stress after a compression. The reference is stiffer by a factor beyond the limit.
fn pressed_to(solid: &TwoSlopes, stiffer: f64, strain: f64) -> [f64; 6] {
    let first = solid.limit / solid.confined_modulus();
    let beyond = stiffer * solid.plastic_modulus * (strain - first).max(0.0);
    let q = solid.confined_modulus() * strain.min(first) + beyond;
    let across = solid.across(q);
    [-across, -across, -q, 0.0, 0.0, 0.0]
}

fn of_mises() -> TwoSlopes {
    TwoSlopes::von_mises(YOUNG, POISSON, YIELD, HARDENING)
}

fn of_tresca() -> TwoSlopes {
    TwoSlopes::mohr_coulomb(YOUNG, POISSON, [0.0, 0.5 * YIELD, 0.0])
}

fn of_soil() -> TwoSlopes {
    TwoSlopes::mohr_coulomb(YOUNG, POISSON_OF_SOIL, SOIL)
}

fn cone_of_soil() -> DruckerPrager {
    DruckerPrager::new(YOUNG, POISSON_OF_SOIL, SOIL, ConeMatch::PlaneStrain)
}

fn of_cone() -> TwoSlopes {
    TwoSlopes::drucker_prager(YOUNG, POISSON_OF_SOIL, cone_of_soil().cone())
}

/// Shear strength of von Mises, and the angle at which it yields.
fn shear_limit() -> [f64; 2] {
    let limit = YIELD / 3.0_f64.sqrt();
    [limit, limit / lame(POISSON)[1]]
}

/// The way back in shear over the angle at which it yields: all of the elastic way and as much again.
const BACK: f64 = 6.0;

fn soil_under_weight(stiffer: f64) -> ShearedSoil {
    let [x, y, _] = WEIGHT;
    ShearedSoil::new(stiffer * lame(POISSON)[1], [x, y], FIRM[0], FIRM[1])
}

/// Angle to which it is sheared.
fn angle_under_weight() -> f64 {
    let soil = soil_under_weight(1.0);
    soil.first() + 0.4 * soil.radius / soil.shear
}

/// The angle at which the soil that dilates yields.
fn first_of_dilatant() -> f64 {
    let (sine, cosine) = libm::sincos(DILATANT[0].to_radians());
    (DILATANT[1] * cosine + PRESSURE * sine) / lame(POISSON)[1]
}

/// Times at which the mud yields, and of its flow from there on.
fn times_of_mud() -> [f64; 2] {
    let [shear, viscosity, limit] = MUD;
    [limit / (shear * RATE), viscosity / shear]
}

/// A path from no stress whose answer depends neither on time nor on the number of steps.
const fn path(
    name: &'static str,
    law: fn() -> AnyLaw,
    parts: fn() -> Vec<[f64; 6]>,
    answer: fn(f64, f64) -> [f64; 6],
) -> Path {
    Path {
        name,
        exact: true,
        law,
        start: [0.0; 6],
        parts,
        times: any_time,
        answer,
    }
}

const PATHS: [Path; 11] = [
    path(
        "oedometer, von Mises",
        || VonMises::new(YOUNG, POISSON, YIELD, HARDENING).into(),
        || pressed(&of_mises()),
        |stiffer, strain| pressed_to(&of_mises(), stiffer, strain),
    ),
    path(
        "oedometer, Tresca",
        || Tresca::new(YOUNG, POISSON, 0.5 * YIELD).into(),
        || pressed(&of_tresca()),
        |stiffer, strain| pressed_to(&of_tresca(), stiffer, strain),
    ),
    path(
        "oedometer, Mohr-Coulomb",
        || MohrCoulomb::new(YOUNG, POISSON_OF_SOIL, SOIL).into(),
        || pressed(&of_soil()),
        |stiffer, strain| pressed_to(&of_soil(), stiffer, strain),
    ),
    path(
        "oedometer, Drucker-Prager",
        || cone_of_soil().into(),
        || pressed(&of_cone()),
        |stiffer, strain| pressed_to(&of_cone(), stiffer, strain),
    ),
    path(
        "shear to and fro, von Mises",
        || VonMises::new(YOUNG, POISSON, YIELD, HARDENING).into(),
        || {
            let [_, first] = shear_limit();
            let there = sheared((BEYOND - 1.0) * first);
            vec![sheared(first), there, sheared(-BACK * first)]
        },
        |stiffer, way| {
            let [limit, first] = shear_limit();
            let moduli = [lame(POISSON)[1], HARDENING * stiffer];
            let there = way.min(BEYOND * first);
            let shear = to_and_fro(moduli, limit, there, way - there);
            [0.0, 0.0, 0.0, 0.0, 0.0, shear]
        },
    ),
    Path {
        start: [-PRESSURE, -PRESSURE, -PRESSURE, 0.0, 0.0, 0.0],
        ..path(
            "shear, Mohr-Coulomb that dilates",
            || MohrCoulomb::new(YOUNG, POISSON, DILATANT).into(),
            || {
                let first = first_of_dilatant();
                vec![sheared(first), sheared((BEYOND - 1.0) * first)]
            },
            |stiffer, angle| {
                let [lambda, shear] = lame(POISSON);
                let moduli = [stiffer * lambda, shear];
                let [mean, tau] = held_dilation(moduli, -PRESSURE, DILATANT, angle);
                // Nothing says here what the stress across the plane is.
                [mean, mean, f64::NAN, 0.0, 0.0, tau]
            },
        )
    },
    Path {
        exact: false,
        // On the surface, without shear.
        start: [2.0 / 3.0 * YIELD, -YIELD / 3.0, -YIELD / 3.0, 0.0, 0.0, 0.0],
        ..path(
            "shear of a stressed von Mises",
            || VonMises::new(YOUNG, POISSON, YIELD, 0.0).into(),
            || vec![[0.0; 6], sheared(1.5 * shear_limit()[1])],
            |stiffer, angle| {
                let [limit, _] = shear_limit();
                let [tau, left] = turned(stiffer * lame(POISSON)[1], limit, angle);
                let across = -YIELD / 3.0 * left;
                [-2.0 * across, across, across, 0.0, 0.0, tau]
            },
        )
    },
    Path {
        exact: false,
        start: [WEIGHT[0], WEIGHT[1], WEIGHT[2], 0.0, 0.0, 0.0],
        ..path(
            "shear of soil under weight, Mohr-Coulomb",
            || MohrCoulomb::new(YOUNG, POISSON, FIRM).into(),
            || {
                let first = soil_under_weight(1.0).first();
                vec![sheared(first), sheared(angle_under_weight() - first)]
            },
            |stiffer, angle| {
                let [x, y, tau] = soil_under_weight(stiffer).at(angle);
                [x, y, WEIGHT[2], 0.0, 0.0, tau]
            },
        )
    },
    Path {
        exact: false,
        times: times_of_mud,
        ..path(
            "start of flow, Bingham",
            || Bingham::new(BULK, MUD[1], MUD[2], MUD[0]).into(),
            || times_of_mud().map(|time| sheared(RATE * time)).to_vec(),
            |stiffer, angle| {
                let [shear, viscosity, limit] = MUD;
                let tau = bingham([stiffer * shear, viscosity, limit], RATE, angle / RATE);
                [0.0, 0.0, 0.0, 0.0, 0.0, tau]
            },
        )
    },
    Path {
        exact: false,
        start: [-PRESSURE, -PRESSURE, -PRESSURE, 0.0, 0.0, 0.0],
        ..path(
            "undrained, Cam clay",
            || clay::law().into(),
            || vec![[0.0; 6], [0.01, 0.01, -0.02, 0.0, 0.0, 0.0]],
            clay::undrained,
        )
    },
    // At rest the stress ratio of first compression stays, and ln v is straight in ln p.
    Path {
        exact: false,
        start: clay::STRESS_AT_REST,
        ..path(
            "oedometer, Cam clay",
            || clay::law().into(),
            || vec![[0.0; 6], along(-0.02)],
            clay::at_rest,
        )
    },
];

const SHOWN: u32 = 100; // Most points of a curve

impl Path {
    /// The way and the stress at its beginning and after each step, in so many steps of all parts but the first.
    fn walk(&self, steps: u32) -> Result<Vec<(f64, [f64; 6])>, String> {
        let mut point = Point::new(&(self.law)(), DENSITY, self.start);
        let [first, others] = (self.times)();
        let mut done = 0.0;
        let mut states = vec![(done, self.start)];
        for (part, strain) in (self.parts)().iter().enumerate() {
            let (count, time) = [(1, first), (steps, others)][part.min(1)];
            let part = strain[2].abs() + 2.0 * strain[5].abs();
            let each = strain.map(|e| e / f64::from(count));
            for step in 1..=count {
                point
                    .strain(&each, time / f64::from(count))
                    .map_err(|fault| fault.to_string())?;
                let way = done + part * f64::from(step) / f64::from(count);
                states.push((way, point.stress()));
            }
            done += part;
        }
        Ok(states)
    }

    /// Component of a stress that is shown: the compression along the axis, or the shear.
    fn shown(&self, stress: &[f64; 6]) -> f64 {
        if self.is_pressed() {
            -stress[2]
        } else {
            stress[5]
        }
    }

    fn is_pressed(&self) -> bool {
        (self.parts)().iter().any(|part| part[2] != 0.0)
    }

    fn curve(&self, states: &[(f64, [f64; 6])], stiffer: f64) -> Curve {
        let every = (states.len() as u32).div_ceil(SHOWN) as usize;
        let point = |&(way, stress): &(f64, [f64; 6])| {
            let answer = (self.answer)(stiffer, way);
            CurvePoint::new(way, self.shown(&stress), self.shown(&answer))
        };
        let names = if self.is_pressed() {
            ["compression (1)", "stress along the axis (Pa)"]
        } else {
            ["angle, to and fro (1)", "shear stress (Pa)"]
        };
        let points = states.iter().step_by(every).map(point);
        Curve::new(self.name.to_owned(), names, points)
    }
}

const WRONG_STIFFNESS: Wrong = Wrong::factor("stiffness", 1.01)
    .breaks(|gate| !gate.contains("states of") && !gate.contains("one over"));
const WRONG_STRENGTH: Wrong =
    Wrong::factor("strength", 0.99).breaks(|gate| gate.contains("surface"));

/// Laws at a point.
pub static ELEMENT: Case = Case::new(
    "element",
    "Do the laws give their exact answers at a material point, whatever state they return?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.solve_by(solve)
.gates_of_variants(&[
    error(STRESS)
        .at_most(1e-14, "the direction of flow stays: exact for any step")
        .of_each()
        .on(|rung| path_of(rung).is_some_and(|path| path.exact)),
    order(STRESS).at_least(0.95, IMPLICIT).on(has_order),
    reciprocal_order(STRESS)
        .at_least(1.0 / 1.05, IMPLICIT)
        .on(has_order),
    returns::gate(returns::YIELD, 1e-14, returns::ROUND_OFF),
    returns::gate(returns::AGAIN, 1e-14, returns::ROUND_OFF),
    returns::gate(returns::TURNED, 1e-14, returns::ROUND_OFF),
    returns::gate(
        returns::WORK,
        1e-14,
        "plastic flow dissipates, to round-off",
    ),
    returns::gate(returns::LANES, 0.0, "one set of bits"),
    returns::gate(returns::CORNERS, 1e-14, returns::ROUND_OFF),
])
.tables(&[TableRule::new("{variant}", &[STRESS])
    .of(|variant| PATHS.iter().any(|path| path.name == variant && !path.exact))])
.wrong_references(&[WRONG_STIFFNESS, WRONG_STRENGTH])
.no_study("no grid takes part, so that weighting functions, schemes and transfers have no say")
.no_guest("no grid takes part: it is the law alone");

const IMPLICIT: &str = "an implicit return: order 1";

fn has_order(rung: &Rung) -> bool {
    path_of(rung).is_some_and(|path| !path.exact)
}

fn found(reference: Reference, path: &Path, steps: u32) -> Result<Measurements, String> {
    let states = path.walk(steps)?;
    let stiffer = reference.of(&WRONG_STIFFNESS);
    let (way, found) = states[states.len() - 1];
    let answer = (path.answer)(stiffer, way);
    let known = || found.iter().zip(&answer).filter(|(_, s)| !s.is_nan());
    let size = largest(known().map(|(_, s)| s.abs()));
    let off = largest(known().map(|(found, s)| (found - s).abs()));
    let quantities = vec![Quantity::of_zero(STRESS, off / size)];
    Ok(Measurements::of(quantities).drawn(path.curve(&states, stiffer)))
}

/// Steps, or states, of a rung.
fn count(rung: &Rung) -> u32 {
    (1.0 / rung.cell).round() as u32
}

fn path_of(rung: &Rung) -> Option<&'static Path> {
    PATHS.iter().find(|path| path.name == rung.variant)
}

fn rungs(size: Size) -> Vec<Rung> {
    let paths = PATHS.iter().flat_map(|path| {
        let ladder = LADDER[size as usize];
        let steps = if path.exact { ANY } else { ladder };
        Rung::counted(path.name, &format!("{}, steps", path.name), 1.0, steps)
    });
    let word = "states of each law";
    let states = Rung::counted(RETURNS, word, 1.0, STATES[size as usize]);
    paths.chain(states).collect()
}

/// The material of the path in a block that is never stepped: a point needs no mesh.
fn scene(rung: &Rung, _: &Settings) -> Scene {
    let mesh = Mesh::new(Dimension::Three, [0.0; 3], [1.0; 3], [3; 3]);
    let mut scene = bare_scene("element", Dimension::Three, mesh, 1.0);
    let law = path_of(rung).map_or(PATHS[0].law, |path| path.law);
    scene.materials = material("of the point", DENSITY, law());
    scene.bodies = vec![body("point", 1, cuboid([1.0; 3], [2.0; 3]))];
    if scene.materials[0].law.downcast::<CamClay>().is_some() {
        scene.bodies[0].initial_stress = InitialStress::Isotropic(-PRESSURE);
    }
    scene
}

fn solve(
    rung: &Rung,
    reference: Reference,
    _: &Options,
    observer: &mut dyn Observer,
) -> Result<RungResult, Failure> {
    let found = match path_of(rung) {
        Some(path) => found(reference, path, count(rung)),
        None => returns::quantities(count(rung), reference.of(&WRONG_STRENGTH), &mut |share| {
            observer.progress(share);
        })
        .map(Measurements::of),
    }?;
    Ok(RungResult {
        particles: 1,
        steps: u64::from(count(rung)),
        time: 1.0,
        quantities: found.quantities,
        drawings: vec![],
        curve: found.curve,
    })
}
