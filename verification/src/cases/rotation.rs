//! Does a spinning block turn as a rigid body?
//!
//! An elastic square spins
//! about its centre for half a turn, free of everything, its edges and particles crossing the mesh in all directions.
//! A rigid motion is exact but for the centrifugal stretch, of order (w R/c)²: corners at 1 % of the wave speed keep
//! it at 1e-4.
//!
//! Expected: APIC carries the spin in its affine velocity and keeps angular momentum (Jiang et al. 2015); FLIP keeps
//! it up to what lumping the mass loses. `proctor verify rotation`.

use std::f64::consts::SQRT_2;

use super::prelude::*;

const MESH: f64 = 1.0; // Side of the mesh [m]
const MIDDLE: f64 = 0.5; // Middle of the mesh and of the block [m]
const HALF: f64 = 0.25; // Half the side of the block [m]
/// Young's modulus \[Pa\], Poisson's ratio and density \[kg/m³\].
const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0;
const SPEED: f64 = 1e-2; // Speed of the corners over the wave speed
/// Name of the error of the velocity among the quantities.
const VELOCITY: &str = "L2(v)";
const WRONG_SPIN: Wrong = Wrong::factor("spin", 1.02);

/// The spinning block.
pub static ROTATION: Case = Case::new("rotation", "Does a spinning block turn as a rigid body?")
    .ladder(cells_along(&[4, 8], &[4, 8, 16]))
    .method(|_| {
        Settings::new(Method {
            transfer: TransferKind::Apic,
            scheme: StressScheme::Musl,
            ..Method::DEFAULT
        })
    })
    .scene(scene)
    .displacements()
    .options(start)
    .compare(compare)
    .gates(&[
        error(DISPLACEMENT).at_most(1e-2, "one percent of the path of half a turn"),
        error(VELOCITY).at_most(1e-2, "one percent of the path of half a turn"),
    ])
    .tables(&[TableRule::new(
        "rotation, uGIMP, MUSL, APIC",
        &[DISPLACEMENT, VELOCITY],
    )])
    .wrong_references(&[WRONG_SPIN])
    .studies(&[Plan::new(
        cells_along(&[4, 8], &[4, 8, 16, 32]),
        &[
            Measure::new("displacement", DISPLACEMENT),
            Measure::new("velocity", VELOCITY),
        ],
        2,
    )])
    .guest(|rung| {
        let fastest = (1.0 + SPEED) * p_wave_speed(YOUNG, POISSON, DENSITY);
        let moved = move |x: &Vector, t| {
            let turned = turned(*x, spin() * t);
            std::array::from_fn(|axis| turned[axis] - x[axis])
        };
        Ok(guest::start::moving(
            rung,
            scene,
            2,
            fastest,
            |x| velocity(*x, spin()),
            moved,
        ))
    });

const fn cells_along(short: &'static [u32], full: &'static [u32]) -> Ladder {
    Ladder::cells("half turn", "side/h", 2.0 * HALF, short, full)
}

/// Angular velocity \[rad/s\].
fn spin() -> f64 {
    SPEED * p_wave_speed(YOUNG, POISSON, DENSITY) / (HALF * SQRT_2)
}

/// Velocity (m/s) of a point of a body that spins with `spin` (rad/s).
fn velocity(x: [f64; 3], spin: f64) -> [f64; 3] {
    [-spin * (x[1] - MIDDLE), spin * (x[0] - MIDDLE), 0.0]
}

/// Place of the point `x` (m) after a turn by `angle` (rad).
fn turned(x: [f64; 3], angle: f64) -> [f64; 3] {
    let (sin, cos) = libm::sincos(angle);
    let (a, b) = (x[0] - MIDDLE, x[1] - MIDDLE);
    [MIDDLE + cos * a - sin * b, MIDDLE + sin * a + cos * b, x[2]]
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let mesh = open_plane(h, [0.0; 2], [MESH; 2]);
    let end = PI / spin();
    // The critical step counts the speed of the corners with that of waves.
    let fastest = (1.0 + SPEED) * p_wave_speed(YOUNG, POISSON, DENSITY);
    let block = rectangle([MIDDLE - HALF; 2], [MIDDLE + HALF; 2]);
    settings.applied(Scene {
        time_step: settings.equal_steps(end, h, fastest).0,
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("block", 1, block)],
        ..plane_scene("rotation", mesh, end)
    })
}

fn start(_: &Rung, _: Reference, options: Options) -> Options {
    let gradient = [[0.0, -spin(), 0.0], [spin(), 0.0, 0.0], [0.0; 3]];
    starting(options, move |x| moving(velocity(*x, spin()), gradient))
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let spin = run.reference.of(&WRONG_SPIN) * spin();
    let simulation = &*run.simulation;
    let (t, before) = (simulation.time(), simulation.velocity_time());
    let displacement = l2(simulation, |p, x| {
        let turned = turned(x, spin * t);
        let exact = std::array::from_fn(|axis| turned[axis] - x[axis]);
        Some((simulation.displacement(0, p)?, exact))
    });
    let velocity = l2(simulation, |p, x| {
        let exact = velocity(turned(x, spin * before), spin);
        Some((simulation.sets()[0].velocity(p), exact))
    });
    let quantities = vec![ratio(DISPLACEMENT, displacement), ratio(VELOCITY, velocity)];
    Ok(Measurements::of(quantities))
}
