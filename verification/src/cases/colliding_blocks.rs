//! Do bodies that collide keep their momentum, gain no energy and part as waves say?
//!
//! *Bars* collide end to end between rollers: Saint-Venant's solution (`exact::bar_impact`) gives how long they press on
//! each other and how fast they part. Bars of equal length and wave speed with masses 1 : 1, 1 : 1e3 and 1 : 1e6 part
//! with the speed of their approach; of two bars of one material, the second twice as long, the first stops; of bars with
//! masses 1 : 7 and stiffnesses 1 : 3 neither transits nor impedances are the same. The
//! duration is twice the centroid of the force, which the ringing behind the jump does not move. The impulse is the sum
//! of the contact forces over the steps; between rollers nothing else acts along the bars, so it is what the first bar
//! lost, to round-off.
//!
//! *Blocks* collide off centre with friction. There is no exact answer but momentum and energy; restitution is shown
//! for the record. Kinetic energy is that at the time of the stress, the mean of half a step before and after.
//!
//! Expected: order 2/3 in duration and restitution. The wave has a jump, which dispersion of second order spreads over
//! (h² L)^(1/3), so that the last of its impulse comes late or never. `precision` studies bars of equal masses.
//! `proctor verify colliding-blocks`.

mod scenes;

use super::prelude::*;
use super::vocabulary::impulse::Impulse;
use crate::exact::bar_impact::BarImpact;
use scenes::{VARIANTS, Variant};

/// Name of the change of momentum among the quantities.
const MOMENTUM: &str = "momentum lost over the momentum of both bodies";
const ENERGY: &str = "energy gained, over the initial"; // Name of the largest gain of energy
const LOST: &str = "energy dissipated, over the initial"; // Name of the energy at the end
const DURATION: &str = "duration"; // Name of the duration
const RESTITUTION: &str = "restitution"; // Name of the coefficient of restitution
const IMPULSE: &str = "impulse"; // Name of the impulse
/// Name of what the impulse differs by from the momentum that the first bar lost.
const BALANCE: &str = "impulse minus change of momentum over the impulse";

const WRONG_STIFFNESS: Wrong =
    Wrong::factor("stiffness", 0.7).breaks(|gate| gate.contains("duration"));
const WRONG_IMPULSE: Wrong =
    Wrong::factor("impulse", 1.1).breaks_only(|gate| gate.ends_with(": impulse"));

/// Colliding bodies.
pub static COLLIDING_BLOCKS: Case = Case::new(
    "colliding-blocks",
    "Do bodies that collide keep their momentum, gain no energy and part as waves say?",
)
.ladder(Ladder::made(rungs))
.method(method)
.scene(scene)
.run(compare)
.gates_of_variants(&[
    each(
        MOMENTUM,
        "contact forces are equal and opposite; round-off is left",
    ),
    each(ENERGY, "contact only takes energy"),
    each(
        BALANCE,
        "between rollers contact alone changes the momentum of a bar; round-off is left",
    )
    .on(is_bars),
    spread(DURATION, 0.5),
    spread(RESTITUTION, 1.0),
    // J = (1 + e) m_1 m_2 / (m_1 + m_2) (v_1 - v_2), so that dJ / J = de / (1 + e).
    error(IMPULSE)
        .at_most_by(
            |rung| {
                let exact = variant(rung)
                    .impact()
                    .and_then(|impact| impact.restitution());
                exact.map_or(f64::NAN, |exact| width(rung) * exact / (1.0 + exact))
            },
            "the impulse is off by de / (1 + e), where the front leaves de in the restitution e",
        )
        .on(is_bars)
        .by_rung(),
    order(DURATION)
        .at_least(0.6, "2/3, as the front spreads")
        .on(is_bars)
        .of_several(),
])
.tables(&[
    TableRule::new("{variant}", &[DURATION, IMPULSE, RESTITUTION])
        .of(|variant| variant.starts_with("bars")),
])
.judge_by(lines)
.wrong_references(&[WRONG_STIFFNESS, WRONG_IMPULSE])
.studies(&[Plan::new(
    Ladder::made(path),
    &[
        Measure::new("velocity", RESTITUTION),
        Measure::new("duration", DURATION),
    ],
    1,
)])
.guest(parted);

/// Gate on an error of every rung: at most round-off of some thousand steps.
const fn each(quantity: &'static str, reason: &'static str) -> GateRule {
    error(quantity).at_most(1e-12, reason).of_each()
}

/// Gate on an error of bars on their finest mesh: at most a share of the width of the front.
const fn spread(quantity: &'static str, share: f64) -> GateRule {
    let front = "dispersion spreads the front of the wave over (h² L)^(1/3)";
    let gate = error(quantity).at_most_spread(scenes::LENGTH, [share, 1.0], front);
    gate.on(is_bars).by_rung()
}

/// Width over which dispersion of second order spreads a jump on a way of 2 L, over L.
fn width(rung: &Rung) -> f64 {
    libm::pow(rung.cell / scenes::LENGTH, 2.0 / 3.0)
}

fn is_bars(rung: &Rung) -> bool {
    variant(rung).impact().is_some()
}

/// Blocks on their finest mesh.
fn lines(runs: &Runs<'_>) -> Verdict {
    let of = |variant| {
        let rung = runs.finest(Some(variant)).filter(|rung| !is_bars(rung))?;
        let (label, run) = (&rung.label, runs.run(&rung.label)?);
        let (restitution, lost) = (run.value(RESTITUTION), 100.0 * run.value(LOST));
        Some(format!(
            "{label}: restitution {restitution:.3}, energy dissipated {lost:.2} %"
        ))
    };
    Verdict {
        for_the_record: runs.variants().into_iter().filter_map(of).collect(),
        ..Verdict::default()
    }
}

/// Frames hold no forces of contact. The velocity of the second bar after both have parted is known too.
fn parted(rung: &Rung) -> Result<Guest, &'static str> {
    let variant = variant(rung);
    let impact = exact(Reference::CORRECT, &variant);
    let after = impact
        .and_then(|impact| impact.velocities())
        .ok_or("its bodies are no bars")?;
    let mut scene = variant.scene(rung.cell);
    guest::settings().apply(&mut scene);
    let speed = scene.materials[1]
        .law
        .wave_speed(scene.materials[1].density);
    let step = guest::COURANT * rung.cell / speed;
    let Shape::Cuboid { p1, .. } = scene.bodies[1].shape else {
        return Err("its bodies are no boxes");
    };
    let velocity = move |_: &Vector, _| [after[1], 0.0, 0.0];
    Ok(Guest {
        compared: ComparedField::Velocity,
        norm: Norm::Mean(0),
        counts: Box::new(move |x| x[0] > p1[0]),
        ..Guest::new(guest::prepared(guest::slab(scene), 1, step), velocity).at_the_end()
    })
}

/// Energy over that at the start: at the end, and the largest gain of any step.
#[derive(Clone, Copy, Debug, Default)]
struct Energy {
    last: f64,
    gained: f64,
}

fn rungs_of(variant: &Variant, size: Size) -> Vec<Rung> {
    let word = format!("{} L/h", variant.name);
    Rung::counted(variant.name, &word, scenes::LENGTH, variant.cells(size))
}

fn variant(rung: &Rung) -> Variant {
    let found = VARIANTS.into_iter().find(|v| v.name == rung.variant);
    found.unwrap_or(VARIANTS[0])
}

/// The exact impact of a variant, where there is one.
fn exact(reference: Reference, variant: &Variant) -> Option<BarImpact> {
    let mut impact = variant.impact()?;
    for bar in &mut impact.bars {
        bar.modulus *= reference.of(&WRONG_STIFFNESS);
    }
    Some(impact)
}

/// Runs the collision: the impulse on the second body, and the energy.
fn collide(run: &mut Run<'_>) -> Result<(Impulse, Energy), Failure> {
    let simulation = &mut *run.simulation;
    let initial = simulation.kinetic_energy() + simulation.strain_energy();
    let (mut energy, mut impulse) = (Energy::default(), Impulse::of(simulation));
    let mut before: Option<[f64; 2]> = None;
    let end = simulation.scene().time;
    run_until(simulation, end, run.observer, |s| {
        impulse.add(s, s.contact_force(1)[0]);
        let now = [s.kinetic_energy(), s.strain_energy()];
        if let Some([kinetic, strain]) = before {
            energy.last = 0.5 * (kinetic + now[0]) + strain;
            energy.gained = energy.gained.max(energy.last / initial - 1.0);
        }
        before = Some(now);
    })?;
    energy.last /= initial;
    Ok((impulse, energy))
}

fn compare(mut run: Run<'_>) -> Result<Measurements, Failure> {
    let (impulse, energy) = collide(&mut run)?;
    let (simulation, variant) = (&*run.simulation, variant(run.rung));
    let masses = [0, 1].map(|i| simulation.center(i).mass);
    let after = [0, 1].map(|i| simulation.center(i).velocity[0]);
    let before = variant.velocities();
    let scale: f64 = (0..2).map(|i| masses[i] * before[i].abs()).sum();
    let now = simulation.momentum();
    let start: f64 = (0..2).map(|i| masses[i] * before[i]).sum();
    let lost = ((now[0] - start).powi(2) + now[1].powi(2) + now[2].powi(2)).sqrt() / scale;
    let restitution = (after[1] - after[0]) / (before[0] - before[1]);
    let mut all = vec![
        Quantity::of_zero(MOMENTUM, lost),
        Quantity::of_zero(ENERGY, energy.gained.max(0.0)),
        Quantity::figure(LOST, 1.0 - energy.last, "1"),
    ];
    let exact = exact(run.reference, &variant);
    let pressed = exact.and_then(|e| Some((e.press()?, e.restitution()?)));
    let Some((press, of_exact)) = pressed else {
        all.push(Quantity::figure(RESTITUTION, restitution, "1"));
        return Ok(Measurements::of(all));
    };
    let of_press = run.reference.of(&WRONG_IMPULSE) * press.impulse;
    let given = of_press * Variant::section(simulation.scene());
    // Of the lighter bar, since the change of a velocity is known to round-off of the velocity.
    let taken = masses[0] * (before[0] - after[0]);
    all.extend([
        Quantity::compared(DURATION, impulse.duration(), press.duration, "s"),
        Quantity::compared(IMPULSE, impulse.total, given, "N s"),
        Quantity::of_zero(BALANCE, 1.0 - taken / impulse.total),
        Quantity::compared(RESTITUTION, restitution, of_exact, "1"),
    ]);
    Ok(Measurements::of(all))
}

fn rungs(size: Size) -> Vec<Rung> {
    let of = |variant| rungs_of(variant, size);
    VARIANTS.iter().flat_map(of).collect()
}

fn method(rung: &Rung) -> Settings {
    let variant = variant(rung);
    Settings::new(Method {
        scheme: variant.scheme,
        transfer: variant.transfer,
        ..Method::DEFAULT
    })
    .courant(scenes::COURANT)
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let mut scene = variant(rung).scene(rung.cell);
    scene.time_step = settings.multiplier();
    settings.apply(&mut scene);
    scene
}

fn path(size: Size) -> Vec<Rung> {
    rungs_of(&VARIANTS[0], size)
}
