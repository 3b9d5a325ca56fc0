//! Is the pressure between an elastic half disk and a rigid plane that of Hertz?
//!
//! Source: Liang et al. 2024, section 4.2: R = 8 m, E = 200 Pa, nu = 0.3, a load of 10 N/m on the flat top, initial gap
//! and critical gap 0.05 m, no friction. The paper gives no density; it is 1 kg/m³ here, with which the printed viscous
//! damping of 0.01 damps the bounce on the contact to nothing in the 13 s that are run. Pressures are averaged over the
//! last 2 s.
//!
//! A barrier carries pressure across a gap, which is an error of the model: `paper` has the paper's kappa = 1500 Pa/m,
//! with which the exact solution of the layer is 12 % from Hertz, and is judged against that solution; its distance from
//! Hertz is shown. `hertz` has kappa = 1.5e4 Pa/m (a layer 6 % off) and is judged against Hertz. Stiffer layers than
//! kappa h/E of about 10 make the pressure oscillate, because several vertices share each node.
//!
//! Expected with h = 0.1 m: force 0.4 %, peak 0.2 %, half-width 0.7 %, pressure 3 % in L2. `proctor verify hertz`.

use super::prelude::*;
use super::vocabulary::pressures::Pressures;
use crate::exact::hertz::{Hertz as Exact, contact_modulus};
use crate::exact::hertz_layer::{LayerContact, barrier};

const RADIUS: f64 = 8.0;
const LOAD: f64 = 10.0;
const YOUNG: f64 = 200.0;
const POISSON: f64 = 0.3;
const GAP: f64 = 0.05;
/// Time at which averaging begins, and at which it ends \[s\].
const AVERAGED: [f64; 2] = [11.0, 13.0];
const PIC: f64 = 0.1; // Share of PIC, with any transfer
/// The bottom of the disk within this distance of the middle has fine segments \[m\].
const FINE: f64 = 1.6;

pub(super) const FORCE: &str = "contact force";
pub(super) const PEAK: &str = "peak pressure";
pub(super) const WIDTH: &str = "half-width";
pub(super) const L2_HERTZ: &str = "L2(p) against Hertz";
/// Errors that are studied, of a slab too.
pub(super) const MEASURES: &[Measure] = &[
    Measure::new("pressure", L2_LAYER),
    Measure::new("peak", PEAK),
];
const L2_LAYER: &str = "L2(p) against the barrier layer";
const HERTZ_VARIANT: &str = "hertz"; // The disk of the manual
const PAPER_VARIANT: &str = "paper"; // That of the paper
const STRESS: &str = "L2(stress) on the axis";
const DEEP: &str = "5 % of the pressure, and 10 % at the depth b where the disk is no half space: P/(pi R) over P/(pi b)";
const LAYER: &str = "the layer's own L2 distance from Hertz";

const WRONG_LOAD: Wrong = Wrong::factor("load", 1.03).breaks_only(|gate| gate.contains(FORCE));

/// The half disk on a rigid plane.
pub static HERTZ: Case = Case::new(
    "hertz",
    "Is the pressure between an elastic half disk and a rigid plane that of Hertz?",
)
.ladder(Ladder::sizes(
    &[(HERTZ_VARIANT, &[0.2])],
    &[(HERTZ_VARIANT, &[0.2, 0.1]), (PAPER_VARIANT, &[0.2, 0.1])],
))
.method(method)
.displacements()
.scene(scene)
.run(compare_disk)
.gates_of_variants(&[
    error(FORCE)
        .at_most(0.015, "the load must arrive; half settled at 13 s")
        .short_alone()
        .by_rung(),
    error(WIDTH)
        .at_most(0.04, "3.4 cells over the half-width")
        .short_alone()
        .by_rung(),
    error(L2_HERTZ)
        .at_most(
            0.1,
            "a layer 6 % off on a mesh twice as coarse as judged in full",
        )
        .short_alone()
        .by_rung(),
    error(STRESS).at_most(0.15, DEEP).short_alone().by_rung(),
    of_hertz(FORCE, 0.01, "the load must arrive"),
    of_hertz(PEAK, 0.02, "the method's reference figures: 0.2 %"),
    of_hertz(WIDTH, 0.02, "the method's reference figures: 0.7 %"),
    of_hertz(L2_HERTZ, 0.05, "the method's reference figures: 3.3 %"),
    of_hertz(STRESS, 0.15, DEEP),
    error(L2_LAYER)
        .at_most(0.05, "the method's reference figures: 3.1 %")
        .full_alone()
        .by_rung()
        .of(PAPER_VARIANT),
])
.tables(&[TableRule::new(
    "{variant}",
    &[FORCE, PEAK, WIDTH, L2_HERTZ, L2_LAYER, STRESS],
)])
.line_of_each(line)
.wrong_references(&[WRONG_LOAD])
.studies(&[Plan::new(
    Ladder::sizes(
        &[(HERTZ_VARIANT, &[0.8, 0.4])],
        &[(HERTZ_VARIANT, &[0.4, 0.2, 0.1])],
    ),
    MEASURES,
    2,
)])
.no_guest("only the pressure of the contact is known exactly, and frames of particles hold none");

/// A gate of the full ladder on the stiff layer.
const fn of_hertz(quantity: &'static str, bound: f64, reason: &'static str) -> GateRule {
    error(quantity)
        .at_most(bound, reason)
        .full_alone()
        .by_rung()
        .of(HERTZ_VARIANT)
}

fn exact(reference: Reference) -> Exact {
    Exact {
        radius: RADIUS,
        load: LOAD * reference.of(&WRONG_LOAD),
        modulus: contact_modulus([YOUNG, f64::INFINITY], [POISSON, 0.0]),
    }
}

fn kappa(variant: &str) -> f64 {
    if variant == PAPER_VARIANT {
        1.5e3
    } else {
        1.5e4
    }
}

/// Point of the disk's circle at a length along it from the bottom.
fn on_circle(s: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(s / RADIUS);
    [RADIUS * sin, GAP + RADIUS * (1.0 - cos)]
}

/// The boundary: fine segments at the bottom, coarse ones up the sides, one across the top.
fn boundary(h: f64) -> Chain {
    let count = (FINE / (0.4 * h)).round() as i32;
    let fine = (-count..=count).map(|k| FINE * f64::from(k) / f64::from(count));
    let rest = 0.5 * PI * RADIUS - FINE;
    let coarse = (rest / (4.0 * h)).ceil() as i32;
    let side = |k: i32| FINE + rest * f64::from(k) / f64::from(coarse);
    let left = (1..=coarse).rev().map(|k| -side(k));
    let right = (1..=coarse).map(side);
    let around = left.chain(fine).chain(right);
    Chain {
        points: around.map(|s| Point::from(on_circle(s))).collect(),
        side: BoundarySide::Outer,
    }
}

/// The shape, as a polygon so fine that its area is that of the half disk to 1e-5.
fn shape() -> Shape {
    let points = (0..=400)
        .map(|k| {
            let [x, y] = on_circle(PI * RADIUS * (f64::from(k) / 400.0 - 0.5));
            [x, y, 0.0]
        })
        .collect();
    Shape::Polygon { points }
}

/// The distance of the layer from Hertz, for the record.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    let [layer, from_layer, from_hertz] =
        [LAYER, L2_LAYER, L2_HERTZ].map(|name| 100.0 * run.value(name));
    Some(format!(
        "{}: the barrier layer itself is {layer:.1} % from Hertz; computed {from_layer:.1} % from the layer, {from_hertz:.1} % from \
         Hertz",
        rung.label
    ))
}

pub(super) fn method(_: &Rung) -> Settings {
    Settings::new(Method::DEFAULT.with_transfer(TransferKind::Apic))
}

pub(super) fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let (left, right) = (-8.6, 8.6);
    let mesh = open_plane(h, [left, -0.6], [right, 8.6]);
    let kappa = kappa(rung.variant);
    let top = GAP + RADIUS;
    // Vertices of the plane every 0.1 m, none of them under the middle.
    let points = (0..=40).map(|k| Point::new(2.03 - 0.1 * f64::from(k), 0.0));
    let plane = open_line("plane", 2, points, None);
    let mut scene = Scene {
        name: rung.label.clone(),
        time_step: settings.multiplier(),
        materials: elastic(1.0, YOUNG, POISSON),
        bodies: vec![body("half disk", 1, shape())],
        damping: Damping::Viscous { alpha: 0.01 },
        box_loads: vec![BoxLoad {
            p1: [left, top - h, 0.0],
            p2: [right, top + h, 0.0],
            force: [0.0, -LOAD, 0.0],
        }],
        mortar: Mortar {
            boundaries: vec![mortar::boundary(1, Vertices::Given(vec![boundary(h)]))],
            lines: vec![plane],
            contacts: vec![mortar::barrier("half disk on plane", [2, 1], GAP, kappa)],
            ..Mortar::default()
        },
        ..Scene::new(Dimension::Two, mesh, AVERAGED[1])
    };
    settings.apply(&mut scene);
    scene.transfer.pic_fraction = PIC;
    scene
}

/// L2 error of the stresses along and across the axis, at the particles beside it down to the half-width, against those of a half
/// space (`exact::hertz`, Johnson, eq. 4.46).
fn stress_on_axis(simulation: &Simulation, exact: &Exact) -> Option<f64> {
    let set = &simulation.sets()[0];
    let h = simulation.scene().mesh.cell[0];
    let beside = |p: usize| {
        let [x, y, _] = simulation.initial_position(0, p)?;
        let depth = y - GAP;
        let near = x.abs() < 0.5 * h && (h..exact.half_width()).contains(&depth);
        near.then(|| {
            let [xx, yy, ..] = set.stress(p);
            (1.0, [xx, yy], exact.stress_on_axis(depth))
        })
    };
    relative_l2((0..set.len()).filter_map(beside))
}

/// The comparison of the contact, and the stresses in the disk.
fn compare_disk(mut run: Run<'_>) -> Result<Measurements, Failure> {
    let rung = run.rung;
    let mut found = compare(run.as_rung(rung))?;
    let stress = stress_on_axis(run.simulation, &exact(run.reference));
    let stress = stress.map(|error| Quantity::of_zero(STRESS, error));
    found.quantities.extend(stress);
    Ok(found)
}

/// The comparison of the contact, of a slab too.
pub(super) fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation) = (run.rung, run.simulation);
    // A slab is as thick as its one layer of cells, the plane 1 m.
    let thickness = simulation.scene().mesh.cell[2];
    let found = Pressures::averaged(simulation, AVERAGED[0], FINE, |x| x[0], run.observer)?;
    let exact = exact(run.reference);
    let kappa = kappa(rung.variant);
    let layer = LayerContact::solve(&exact, &|g| barrier(kappa, GAP, g), 160, FINE, 0.5 * GAP)
        .map_err(|e| format!("no reference: residual {} m", e.residual))?;
    let peak = found.vertices.iter().map(|p| p[1]).fold(0.0, f64::max);
    // Of the Hertz pressure with the same second moment.
    let half_width = 2.0 * (found.moment(2) / found.moment(0)).sqrt();
    let quantities = vec![
        Quantity::compared(FORCE, found.force[1] / thickness, exact.load, "N/m"),
        Quantity::compared(PEAK, peak, exact.peak(), "Pa"),
        Quantity::compared(WIDTH, half_width, exact.half_width(), "m"),
        Quantity::of_zero(L2_HERTZ, found.distance(|x| exact.pressure(x))),
        Quantity::of_zero(L2_LAYER, found.distance(|x| layer.pressure_at(x))),
        Quantity::of_zero(LAYER, layer.distance_from_hertz(&exact)),
    ];
    let curve = found.curve(rung, "x in m", 1.0, |x| exact.pressure(x));
    Ok(Measurements::of(quantities).drawn(curve))
}
