//! Does a sphere that falls on a terrain of triangles stay above it, at its own speed and at ten times that?
//!
//! The scene is `fixtures/scenes/sphere_on_terrain.json`: a soft sphere over a bowl with bumps, the terrain an STL
//! file, cells of 0.1 m on triangles of 0.15 m. There is no exact motion after the impact, but much else is known:
//!
//! - until its first particle touches, the sphere falls freely, and the first force acts in the step in which that
//!   particle would pass; both are computed here from the positions at the start and every triangle;
//! - no particle goes through. The case asks a height field made of the triangles rather than the kernel's search;
//! - momentum changes by weight and by the impulse of the terrain alone;
//! - a smooth terrain pushes along its normals, which all point up, and gives no energy. The kinetic energy is that of
//!   the leapfrog, half the product of the velocities half a step before and after.
//!
//! A smooth terrain takes no energy either, nor do waves in the sphere: what a bounce loses is the error of a computation,
//! and what `precision` studies. `proctor verify sphere-on-terrain`.

mod bounce;
mod height;

use super::prelude::*;
use super::vocabulary::incline::dot;
use height::HeightField;

/// The terrain of the fixtures.
const TERRAIN: &[u8] = include_bytes!("../../../fixtures/surfaces/terrain.stl");
const GRAVITY: f64 = 9.81; // Gravity [m/s²]
const VELOCITY: Vector = [0.3, 0.1, -1.0]; // Velocity at the start [m/s]
/// Centre and radius of the sphere \[m\].
const CENTER: Vector = [0.93, 1.02, 0.78];
const RADIUS: f64 = 0.3;
/// Time \[s\] at the speed of the scene, in which the sphere falls, bounces and rolls; at ten times that it has bounced
/// off in a seventh.
const TIME: f64 = 0.5;
const TIME_FAST: f64 = 0.07;
const TIME_BOUNCE: f64 = 0.12; // Time of the study [s]: it has bounced once
const STEP: f64 = 2.5e-3; // Time step over the cell where the terrain is smooth [s/m]
const FRICTION: f64 = 0.4; // Friction of the scene

/// Names of the quantities.
const DEPTH: &str = "deepest penetration over cell";
const BELOW: &str = "particles below the terrain";
const FREE_FALL: &str = "height of fall until contact";
const TOUCH: &str = "steps from contact to the first force";
const MOMENTUM: &str = "momentum lost over the momentum given";
const GAINED: &str = "energy gained, over the initial";
const DOWNWARD: &str = "largest pull, over weight";

/// Name of the energy of a bounce: that of the last step over that of the first.
const KEPT: &str = "energy after the bounce, over the initial";

const ROUND_OFF: f64 = 1e-11; // Round-off over some thousand steps

const WRONG_PULL: Wrong = Wrong::factor("pull", 1.01)
    .breaks(|gate| {
        ["height of fall until contact", "momentum", "energy"]
            .iter()
            .any(|name| gate.contains(name))
    })
    .on(|rung| rung.variant == "smooth USF");

/// A sphere on a terrain.
pub static SPHERE_ON_TERRAIN: Case = Case::new("sphere-on-terrain", "Does a sphere that falls on an STL terrain stay above it, at its own speed and at ten times that?")
    .ladder(Ladder::made(rungs))
    .method(|rung| Settings::new(Method::DEFAULT.with_scheme(variant(rung).1)))
    .scene_by(scene)
    .run(compare)
    .gates_of_rungs(&[
    error(DEPTH).at_most(0.5, "the project promises half a cell"),
    error(BELOW).at_most(0.0, "no particle passes the terrain unnoticed"),
    error(FREE_FALL).at_most(ROUND_OFF, "until it touches, the sphere falls freely"),
    error(TOUCH).at_most(1.0, "the force acts in the step in which a particle would pass"),
    error(MOMENTUM).at_most(ROUND_OFF, "weight and impulse are all that changes momentum"),
    error(GAINED).at_most(ROUND_OFF, "a smooth terrain gives no energy").on(is_smooth),
    error(DOWNWARD)
        .at_most(0.0, "the normals of a terrain point up, and contact never pulls")
        .on(is_smooth),
])
    .wrong_references(&[WRONG_PULL])
    .studies(&[Plan::new(Ladder::sizes(&[(BOUNCE.0, &[0.2, 0.1])], &[(BOUNCE.0, &[0.2, 0.1, 0.05])]), &[Measure::new("energy", KEPT)], 3).trying(few)])
    .guest(|rung| Ok(bounce::bounced(rung)));

/// A variant: its name, scheme, factor of the speed, and whether the terrain is smooth.
type Variant = (&'static str, StressScheme, f64, bool);

const VARIANTS: [Variant; 9] = [
    ("USL", StressScheme::Usl, 1.0, false),
    ("USF", StressScheme::Usf, 1.0, false),
    ("MUSL", StressScheme::Musl, 1.0, false),
    ("ten times the speed USL", StressScheme::Usl, 10.0, false),
    ("ten times the speed USF", StressScheme::Usf, 10.0, false),
    ("ten times the speed MUSL", StressScheme::Musl, 10.0, false),
    ("smooth USL", StressScheme::Usl, 1.0, true),
    ("smooth USF", StressScheme::Usf, 1.0, true),
    ("smooth MUSL", StressScheme::Musl, 1.0, true),
];

/// The variant of the study, which is no rung of the ladder.
const BOUNCE: Variant = ("bounce", StressScheme::Usl, 1.0, true);

/// Observations of a run.
#[derive(Default)]
struct Observations {
    deepest: f64,
    below: usize,
    /// Time at the end of the step with the first force, and that step \[s\].
    touched: Option<(f64, f64)>,
    /// Error of the centre of mass before the touch over the radius.
    fall: f64,
    /// Total energy at the end of the first step and of the last but one \[J\], and the largest gain over the first.
    first: Option<f64>,
    last: f64,
    gained: f64,
    /// Mass and velocity of the particles, strain and potential energy \[J\] in the step before.
    before: Option<(Vec<(f64, Vector)>, f64)>,
    pull: f64,
    /// Time before the step \[s\].
    time: f64,
}

/// Centre and velocity of the sphere at the start.
struct Start {
    center: Vector,
    velocity: Vector,
}

/// Place at a time \[s\] of what falls freely from a place \[m\] with a velocity \[m/s\].
fn fallen(from: &Vector, velocity: &Vector, t: f64) -> Vector {
    std::array::from_fn(|axis| {
        let g = if axis == 2 { GRAVITY } else { 0.0 };
        from[axis] + velocity[axis] * t - 0.5 * g * t * t
    })
}

fn variant(rung: &Rung) -> Variant {
    let known = VARIANTS.into_iter().chain([BOUNCE]);
    let mut found = known.filter(|v| v.0 == rung.variant);
    found.next().unwrap_or(VARIANTS[0])
}

/// Time (s) at which the first particle of the sphere at rest touches, from the positions of the centres of its
/// particles, their half-length (m) and the fall that they have in common.
fn touch(terrain: &Surface, seeds: &[Vector], half: f64, velocity: &Vector) -> f64 {
    let touches = |t: f64| {
        seeds.iter().any(|x| {
            let nearest = terrain.nearest_of_all(&fallen(x, velocity, t), half);
            nearest.is_some_and(|n| !n.on_rim)
        })
    };
    // The sphere is closest after a way of 0.5 m at most, and touches for longer than a hundredth of that time.
    let most = 0.5 / velocity[2].abs();
    let steps = 100;
    let Some(first) = (1..=steps).find(|&i| touches(most * f64::from(i) / f64::from(steps))) else {
        return f64::NAN;
    };
    let mut low = most * f64::from(first - 1) / f64::from(steps);
    let mut high = most * f64::from(first) / f64::from(steps);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if touches(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Looks at the state after a step.
fn look(simulation: &Simulation, terrain: &HeightField, start: &Start, seen: &mut Observations) {
    let h = simulation.scene().mesh.cell[0];
    let center = simulation.center(0);
    let (m, x) = (center.mass, center.position);
    let t = simulation.time();
    let force = simulation.contact_force(0);
    let weight = m * GRAVITY;
    seen.pull = seen.pull.max(-force[2] / weight);
    if force != [0.0; 3] && seen.touched.is_none() {
        seen.touched = Some((t, t - seen.time));
    }
    seen.time = t;
    if seen.touched.is_none() {
        let exact = fallen(&start.center, &start.velocity, t);
        let squares = (0..3).map(|a| (x[a] - exact[a]).powi(2));
        seen.fall = seen.fall.max(squares.sum::<f64>().sqrt() / RADIUS);
    }
    let velocities = velocities(simulation);
    if let Some((before, rest)) = seen.before.take() {
        let pairs = before.iter().zip(&velocities);
        let kinetic = pairs.map(|((m, v), (_, w))| 0.5 * m * dot(v, w));
        let energy = kinetic.sum::<f64>() + rest;
        let first = *seen.first.get_or_insert(energy);
        seen.last = energy;
        seen.gained = seen.gained.max(energy / first - 1.0);
    }
    seen.before = Some((velocities, simulation.strain_energy() + weight * x[2]));
    if seen.touched.is_none() {
        return;
    }
    for p in 0..simulation.particles() {
        let position = simulation.position(0, p);
        if position[2] > terrain.highest() + h {
            continue;
        }
        if let Some((gap, _)) = simulation.surface_gap(0, 0, p, 0.0) {
            seen.deepest = seen.deepest.max(-gap / h);
        }
        // Heights of triangles are 32-bit numbers, planes between them are not.
        let height = terrain.height(&position);
        seen.below += usize::from(height.is_some_and(|z| position[2] < z - 1e-9));
    }
}

fn quantities(
    rung: &Rung,
    simulation: &Simulation,
    seen: &Observations,
    start: &Start,
    touch: Option<f64>,
) -> Vec<Quantity> {
    let m = simulation.center(0).mass;
    let momentum = simulation.momentum();
    let impulse = simulation.surface_impulse(0, 0);
    let t = simulation.velocity_time();
    let given = m * (start.velocity[2].abs() + GRAVITY * t);
    let lost = (0..3)
        .map(|axis| {
            let weight = if axis == 2 { -m * GRAVITY * t } else { 0.0 };
            momentum[axis] - m * start.velocity[axis] - weight - impulse[axis]
        })
        .fold(0.0_f64, |worst, lost| worst.max(lost.abs()));
    let (touched, dt) = seen.touched.unwrap_or((f64::NAN, f64::NAN));
    let mut all = vec![
        Quantity::of_zero(DEPTH, seen.deepest),
        Quantity::of_zero(BELOW, seen.below as f64),
        Quantity::of_zero(FREE_FALL, seen.fall),
    ];
    all.extend(touch.map(|touch| Quantity::of_zero(TOUCH, (touched - touch) / dt)));
    all.extend([
        Quantity::of_zero(MOMENTUM, lost / given),
        Quantity::of_zero(GAINED, seen.gained),
        Quantity::of_zero(DOWNWARD, seen.pull.max(0.0)),
    ]);
    if rung.variant == BOUNCE.0 {
        let kept = seen.last / seen.first.unwrap_or(f64::NAN);
        all.push(Quantity::compared(KEPT, kept, 1.0, "1"));
    }
    all
}

/// Mass and velocity of all particles, in order of their identifiers.
fn velocities(simulation: &Simulation) -> Vec<(f64, Vector)> {
    let set = &simulation.sets()[0];
    let mut all: Vec<_> = (0..set.len())
        .map(|p| (set.id[p], simulation.particle_mass(0, p), set.velocity(p)))
        .collect();
    all.sort_unstable_by_key(|particle| particle.0);
    all.into_iter().map(|(_, m, v)| (m, v)).collect()
}

fn rungs(size: Size) -> Vec<Rung> {
    let cells: &[f64] = size.pick(&[0.1], &[0.1, 0.05]);
    Rung::ladders(&VARIANTS.map(|(variant, ..)| (variant, cells)))
}

fn is_smooth(rung: &Rung) -> bool {
    variant(rung).3
}

/// Density \[kg/m³\], Young's modulus \[Pa\] and Poisson's ratio of the scene.
const MATERIAL: [f64; 3] = [1000.0, 1e7, 0.3];

/// Speed of pressure waves \[m/s\].
fn wave_speed() -> f64 {
    let [density, young, poisson] = MATERIAL;
    p_wave_speed(young, poisson, density)
}

fn scene(rung: &Rung, settings: &Settings, reference: Reference) -> Scene {
    let (_, _, factor, smooth) = variant(rung);
    let h = rung.cell;
    let counts = [2.0, 2.0, 1.6].map(|length| cells(length, h));
    let mesh = Mesh::new(Dimension::Three, [0.0; 3], [h; 3], counts);
    let time = if rung.variant == BOUNCE.0 {
        TIME_BOUNCE
    } else if factor > 1.0 {
        TIME_FAST
    } else {
        TIME
    };
    let mut scene = bare_scene("sphere_on_terrain", Dimension::Three, mesh, time);
    scene.gravity = [0.0, 0.0, -reference.of(&WRONG_PULL) * GRAVITY];
    scene.time_step = match settings.courant {
        // The energy of the leapfrog is that of equal steps.
        None if smooth => equal_steps_of(STEP * h),
        None => TimeStep::Automatic,
        Some(_) => settings.equal_steps(time, h, wave_speed()).0,
    };
    scene.materials = elastic(MATERIAL[0], MATERIAL[1], MATERIAL[2]);
    scene.bodies.push(Body {
        velocity: VELOCITY.map(|v| factor * v),
        ..body("sphere", 1, ball(CENTER, RADIUS))
    });
    let friction = if smooth { 0.0 } else { FRICTION };
    scene
        .surfaces
        .extend(stl_surface("terrain", TERRAIN, friction, h));
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation) = (run.rung, run.simulation);
    let rigid = simulation.scene().surfaces.first();
    let surface = rigid.ok_or("there is no terrain")?.surface.clone();
    let start = Start {
        center: simulation.center(0).position,
        velocity: simulation.scene().bodies[0].velocity,
    };
    let seeds = (0..simulation.particles()).map(|p| simulation.position(0, p));
    let seeds: Vec<Vector> = seeds.collect();
    let half = 0.5 * rung.cell / run.settings.particles_per_cell as f64;
    // The study does not ask for it, and it takes longer than a short run.
    let is_asked = rung.variant != BOUNCE.0;
    let touch = is_asked.then(|| touch(&surface, &seeds, half, &start.velocity));
    let terrain = HeightField::new(&surface);
    let mut seen = Observations::default();
    let end = simulation.scene().time;
    run_until(simulation, end, run.observer, |simulation| {
        look(simulation, &terrain, &start, &mut seen);
    })?;
    let quantities = quantities(rung, simulation, &seen, &start, touch);
    Ok(Measurements::of(quantities))
}
