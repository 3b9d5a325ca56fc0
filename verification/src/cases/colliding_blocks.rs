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

mod judge;
mod scenes;

use super::prelude::*;
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
.judge_by(judge::verdict)
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

/// Result of a collision.
#[derive(Clone, Copy, Debug, Default)]
struct Collision {
    impulse: f64,
    moment: f64,
    energy: f64,
    gained: f64,
    before: Option<(f64, f64)>,
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

fn collide(simulation: &mut Simulation, observer: &mut dyn Observer) -> Result<Collision, Failure> {
    let initial = simulation.kinetic_energy() + simulation.strain_energy();
    let mut seen = Collision::default();
    let mut kicked = simulation.velocity_time();
    let mut force_at = simulation.time();
    let end = simulation.scene().time;
    run_until(simulation, end, observer, |s| {
        // The force is that at the positions before the step; it kicks velocities from half step to half step.
        let kick = s.velocity_time() - kicked;
        let force = s.contact_force(1)[0];
        seen.impulse += force * kick;
        seen.moment += force * kick * force_at;
        (kicked, force_at) = (s.velocity_time(), s.time());
        let kinetic = s.kinetic_energy();
        if let Some((kinetic_before, strain_before)) = seen.before {
            seen.energy = 0.5 * (kinetic_before + kinetic) + strain_before;
            seen.gained = seen.gained.max(seen.energy / initial - 1.0);
        }
        seen.before = Some((kinetic, s.strain_energy()));
    })?;
    seen.energy /= initial;
    Ok(seen)
}

fn quantities(
    reference: Reference,
    variant: &Variant,
    simulation: &Simulation,
    seen: &Collision,
) -> Vec<Quantity> {
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
        Quantity::of_zero(ENERGY, seen.gained.max(0.0)),
        Quantity::figure(LOST, 1.0 - seen.energy, "1"),
    ];
    let exact = exact(reference, variant);
    let pressed = exact.and_then(|e| Some((e.press()?, e.restitution()?)));
    let Some((press, of_exact)) = pressed else {
        all.push(Quantity::figure(RESTITUTION, restitution, "1"));
        return all;
    };
    all.push(Quantity::compared(
        DURATION,
        2.0 * seen.moment / seen.impulse,
        press.duration,
        "s",
    ));
    all.push(Quantity::compared(
        IMPULSE,
        seen.impulse,
        reference.of(&WRONG_IMPULSE) * press.impulse * Variant::section(simulation.scene()),
        "N s",
    ));
    // Of the lighter bar, since the change of a velocity is known to round-off of the velocity.
    let taken = masses[0] * (before[0] - after[0]);
    all.push(Quantity::of_zero(BALANCE, 1.0 - taken / seen.impulse));
    all.push(Quantity::compared(RESTITUTION, restitution, of_exact, "1"));
    all
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

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, reference) = (run.rung, run.reference);
    let (simulation, observer) = (run.simulation, run.observer);
    let seen = collide(simulation, observer)?;
    let quantities = quantities(reference, &variant(rung), simulation, &seen);
    Ok(Measurements::of(quantities))
}

fn path(size: Size) -> Vec<Rung> {
    rungs_of(&VARIANTS[0], size)
}
