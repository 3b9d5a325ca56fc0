//! Flow between walls.

use super::{METHOD_ORDER, Problem, WRONG_FORCE, WRONG_VISCOSITY};
use crate::cases::prelude::*;
use crate::exact::channel::Channel;

const WIDTH: f64 = 1.0; // Distance of the walls [m]
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const VISCOSITY: f64 = 50.0; // Viscosity [Pa s]: a velocity crosses the channel in about 5 s
/// Bulk modulus \[Pa\], and the shear modulus of Bingham's fluid where it does not flow.
const BULK: f64 = 1.0e3;
const FORCE_ALONG: f64 = 5.0e-6; // Body force along the walls [m/s²]
const PLUG: f64 = 0.4; // Half-width of the plug over that of the channel
const SPEED: f64 = 1.0e-6; // Speed of the wall that moves [m/s]
const YIELD_OVER_DRAG: f64 = 0.5; // Yield stress over the viscous stress of the steady drag
/// Times over a²/nu: where the flow starts, and where it is nearly steady, but for exp(-pi² 0.5).
const TIMES: [f64; 2] = [0.05, 0.5];
const AT_END: f64 = 1.2; // Time over a²/nu at which the flow is steady, but for exp(-pi² 1.2)

/// Names of the quantities.
const STARTING: &str = "L2(velocity), starting";
const AT_LAST: &str = "L2(velocity), at last";
const STRESS: &str = "L2(shear stress), at last";

const PERCENT: &str = "one percent";

/// Newton's fluid that a force drives (Poiseuille).
pub(super) const FORCE: Problem = Problem {
    variant: "force",
    cells: &[10, 20],
    scene: |rung| scene(rung, newtonian(), FlowDrive::ByForce),
    run: |run| {
        let (exact, g) = (channel(&run, 0.0), FORCE_ALONG * driven(&run));
        flow(run, |y, time| exact.driven_by_force(g, y, time))
    },
    gates: &[
        error(STARTING).at_most(1e-2, PERCENT),
        error(AT_LAST).at_most(1e-2, PERCENT),
        order(STARTING).at_least(1.8, METHOD_ORDER),
        order(AT_LAST).at_least(1.8, METHOD_ORDER),
    ],
    names: &[STARTING, AT_LAST],
};

/// Newton's fluid that a wall drags (Couette).
pub(super) const DRAG: Problem = Problem {
    variant: "drag",
    cells: &[10, 20],
    scene: |rung| scene(rung, newtonian(), FlowDrive::ByWall),
    run: |run| {
        let (exact, speed) = (channel(&run, 0.0), SPEED * driven(&run));
        flow(run, |y, time| exact.dragged(speed, y, time))
    },
    gates: &[
        error(STARTING).at_most(1e-2, PERCENT),
        error(AT_LAST).at_most(1e-2, PERCENT),
        order(STARTING).at_least(1.8, METHOD_ORDER),
    ],
    names: &[STARTING, AT_LAST],
};

/// Bingham's fluid that a force drives, with a plug in the middle.
pub(super) const FORCE_OF_BINGHAM: Problem = Problem {
    variant: "Bingham force",
    cells: &[10, 20],
    scene: |rung| scene(rung, bingham(plug_stress()), FlowDrive::ByForce),
    run: |run| {
        let (exact, g) = (channel(&run, plug_stress()), FORCE_ALONG * driven(&run));
        at_last(run, |y| (exact.driven_by_force_at_last(g, y), f64::NAN))
    },
    gates: &[
        error(AT_LAST).at_most(1e-2, PERCENT),
        order(AT_LAST).at_least(0.9, METHOD_ORDER),
    ],
    names: &[AT_LAST],
};

/// Bingham's fluid that a wall drags.
pub(super) const DRAG_OF_BINGHAM: Problem = Problem {
    variant: "Bingham drag",
    cells: &[10, 20],
    scene: |rung| scene(rung, bingham(drag_stress()), FlowDrive::ByWall),
    run: |run| {
        let (exact, speed) = (channel(&run, drag_stress()), SPEED * driven(&run));
        at_last(run, |y| (speed * y / WIDTH, exact.dragging_stress(speed)))
    },
    gates: &[
        error(AT_LAST).at_most(1e-2, PERCENT),
        error(STRESS).at_most(1e-2, PERCENT),
    ],
    names: &[AT_LAST, STRESS],
};

/// Drive of a flow.
#[derive(Clone, Copy, PartialEq)]
enum FlowDrive {
    ByForce,
    ByWall,
}

fn newtonian() -> AnyLaw {
    Newtonian::new(BULK, VISCOSITY).into()
}

fn bingham(yield_stress: f64) -> AnyLaw {
    Bingham::new(BULK, VISCOSITY, yield_stress, BULK).into()
}

/// Yield stress with which the plug is as wide as [`PLUG`] \[Pa\].
fn plug_stress() -> f64 {
    PLUG * DENSITY * FORCE_ALONG * 0.5 * WIDTH
}

/// Yield stress of the drag \[Pa\].
fn drag_stress() -> f64 {
    YIELD_OVER_DRAG * VISCOSITY * SPEED / WIDTH
}

/// Factor of the drive of the reference.
fn driven(run: &Run<'_>) -> f64 {
    run.reference.of(&WRONG_FORCE)
}

fn channel(run: &Run<'_>, yield_stress: f64) -> Channel {
    Channel {
        width: WIDTH,
        viscosity: run.reference.of(&WRONG_VISCOSITY) * VISCOSITY,
        density: DENSITY,
        yield_stress,
    }
}

/// Time in which a velocity crosses the channel, a²/nu \[s\].
const CROSSING: f64 = WIDTH * WIDTH * DENSITY / VISCOSITY;

/// The velocity of the wall: at rest at time zero, so that the first step has its jump, of which FLIP hands increments on.
fn started() -> History {
    History {
        times: vec![0.0, 1e-9 * CROSSING],
        values: vec![[0.0; 3], [SPEED, 0.0, 0.0]],
    }
}

/// A layer across x, one cell long along it.
fn scene(rung: &Rung, law: AnyLaw, driven: FlowDrive) -> Scene {
    let h = rung.cell;
    let mut mesh = strip(h, [1, cells(WIDTH, h)]);
    mesh.planes[0] = [PlaneCondition::Antisymmetric; 2];
    mesh.planes[1] = [PlaneCondition::Fixed; 2];
    let mut scene = plane_scene("fluid_flow", mesh, AT_END * CROSSING);
    scene.materials = material("fluid", DENSITY, law);
    scene.bodies = vec![body("fluid", 1, rectangle([0.0; 2], [h, WIDTH]))];
    match driven {
        FlowDrive::ByForce => scene.gravity = [FORCE_ALONG, 0.0, 0.0],
        FlowDrive::ByWall => {
            scene.base_motion = Some(BaseMotion {
                axis: 1,
                side: 1,
                motion: Motion::Velocity(started()),
            });
        }
    }
    Settings::new(Method::DEFAULT).apply(&mut scene);
    scene
}

/// Relative error of the velocity along the walls, exact by the distance from the one at rest.
fn error_of_velocity(run: &Run<'_>, exact: impl Fn(f64) -> f64) -> Option<f64> {
    let set = &run.simulation.sets()[0];
    l2(run.simulation, |p, x| {
        Some(([set.velocity(p)[0]], [exact(x[1])]))
    })
}

/// Runs to both times; velocities are exact by the distance from the wall at rest and the time.
fn flow(run: Run<'_>, exact: impl Fn(f64, f64) -> f64) -> Result<Measurements, Failure> {
    let mut errors = [None; 2];
    for (error, time) in errors.iter_mut().zip(TIMES) {
        run_until(run.simulation, time * CROSSING, run.observer, |_| {})?;
        let time = run.simulation.velocity_time();
        *error = error_of_velocity(&run, |y| exact(y, time));
    }
    let quantities = [ratio(STARTING, errors[0]), ratio(AT_LAST, errors[1])];
    let time = run.simulation.velocity_time();
    Ok(Measurements::of(quantities).drawn(profile(&run, |y| exact(y, time))))
}

/// Runs to the end; velocity and shear stress are exact by the distance from the wall at rest.
fn at_last(run: Run<'_>, exact: impl Fn(f64) -> (f64, f64)) -> Result<Measurements, Failure> {
    run_until(run.simulation, AT_END * CROSSING, run.observer, |_| {})?;
    let velocity = error_of_velocity(&run, |y| exact(y).0);
    let mut quantities = vec![ratio(AT_LAST, velocity)];
    if exact(0.0).1.is_finite() {
        let shear = |p, x: [f64; 3]| Some(([run.stress(p)[5]], [exact(x[1]).1]));
        quantities.push(ratio(STRESS, l2(run.simulation, shear)));
    }
    Ok(Measurements::of(quantities).drawn(profile(&run, |y| exact(y).0)))
}

/// Velocity over the channel.
fn profile(run: &Run<'_>, exact: impl Fn(f64) -> f64) -> Option<Curve> {
    let set = &run.simulation.sets()[0];
    let points = run.along(1, |p, y| [1e6 * set.velocity(p)[0], 1e6 * exact(y)])?;
    let title = format!("velocity over the channel, {}", run.rung.label);
    let names = ["distance from the wall at rest (m)", "velocity (µm/s)"];
    Some(Curve::new(title, names, points))
}
