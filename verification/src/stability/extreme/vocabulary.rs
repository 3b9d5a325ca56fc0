//! Vocabulary of the rows: open scenes, methods, runs in which any error is one that should not come, and readings.
//!
//! A [`RowFault`] of a run is its first error, with the method; of a refusal it is a scene that is taken, or refused for
//! something else.
//!
//! Cells are 1 m and densities 1 kg/m³ where a row does not say otherwise.

use super::prelude::*;
use crate::case::{Case, Size};
use crate::cases::{NO_RESULTS, contact};
use crate::stability::map::LEAST_SQUARES;
use proctor_scene::BodyEntry;
use proctor_scene::simulation::{ParticleAt, StepInfo, TimeStepAboveCritical};
use std::fmt;

/// Round-off of some thousand steps, over what it is compared with.
pub const ROUND_OFF: f64 = 1e-12;
/// Reason for which a value that should not change may change by [`ROUND_OFF`].
pub const ONLY_ROUND_OFF: &str = "exact but for the round-off of some thousand steps";
/// Reason for which the kernel's critical step must be that of the formula.
pub const STEP_OF_FASTEST: &str =
    "the critical step is C h/(c + |v|) with the fastest wave of any particle";
/// Energy over that at the start from which a run is unstable.
pub const GROWN: f64 = 2.0;
/// Reason for which energy may not double.
pub const NO_GROWTH: &str = "energy may swing, as speeds and forces lie half a step apart; an unstable run \
     doubles it again and again";

/// No end of a run that is left after so many steps, but a time to which the kernel counts its steps.
pub const NEVER: f64 = 1e30;

/// Young's modulus \[Pa\] and Poisson's ratio of what is soft, and its confined modulus over density: waves of 1 m/s.
pub const YOUNG: f64 = 0.75;
pub const POISSON: f64 = 0.3;

/// A confined modulus of 1 Pa within a per cent.
pub fn soft() -> AnyLaw {
    elastic(YOUNG, POISSON)
}

/// An open mesh of the plane with nothing in it, which writes nothing.
pub fn open(cells: [usize; 2]) -> Scene {
    quiet(Scene::plane(cells, 1.0).with_planes(PlaneCondition::Free))
}

/// The same in space.
pub fn open_space(cells: [usize; 3]) -> Scene {
    quiet(Scene::space(cells, 1.0).with_planes(PlaneCondition::Free))
}

/// A scene that writes nothing and has no end.
pub fn quiet(mut scene: Scene) -> Scene {
    scene.results = NO_RESULTS;
    // Rows end a run where they like; no step is shortened for it.
    scene.time = 1e9;
    scene
}

/// A body in an open mesh of the plane, two particles per cell and axis.
pub fn alone(cells: [usize; 2], shape: Shape, law: impl Into<AnyLaw>) -> Scene {
    let mut scene = open(cells);
    scene.body(shape, law.into(), 1.0);
    scene
}

/// Parts of scenes beyond the words of their builder.
pub trait SceneParts: Sized {
    /// Sliding planes on both sides along an axis.
    fn between(self, axis: usize) -> Self;
    /// Adds a body of a material of its own: its law, and its density \[kg/m³\].
    fn body(&mut self, shape: Shape, law: AnyLaw, density: f64) -> BodyEntry<'_>;
}

impl SceneParts for Scene {
    fn between(mut self, axis: usize) -> Self {
        self.mesh.planes[axis] = [PlaneCondition::Sliding; 2];
        self
    }

    fn body(&mut self, shape: Shape, law: AnyLaw, density: f64) -> BodyEntry<'_> {
        let material = self.add_material(law, density);
        self.add_body(shape, material)
    }
}

/// A bar one cell wide that fills a mesh of so many cells between sliding planes; Poisson's ratio is zero.
pub fn bar(cells: usize) -> Scene {
    let scene = block([cells, 1], [0.0; 2], [cells as f64, 1.0], elastic(1.0, 0.0));
    scene.with_planes(PlaneCondition::Sliding)
}

/// A block of the plane between two corners.
pub fn block(cells: [usize; 2], low: [f64; 2], high: [f64; 2], law: impl Into<AnyLaw>) -> Scene {
    alone(cells, rectangle(low, high), law)
}

/// Particles by their places and volumes \[m, m³\].
pub fn listed(places: impl IntoIterator<Item = (Vector, f64)>) -> Shape {
    let seeds = places.into_iter();
    let seeds = seeds.map(|(position, volume)| ParticleSeed { position, volume });
    Shape::Particles(Arc::new(seeds.collect()))
}

/// A scene with another method; particles stay as they are.
pub fn with(scene: &Scene, method: Method) -> Scene {
    let scene = scene.clone().with_weighting(method.weighting);
    let transfer = Transfer::new(method.transfer);
    scene.with_scheme(method.scheme).with_transfer(transfer)
}

/// All combinations of weighting function, scheme and transfer.
pub fn methods() -> Vec<Method> {
    let schemes = |method: Method| SCHEMES.map(|scheme| method.with_scheme(scheme));
    let transfers = |method: Method| TRANSFERS.map(|transfer| method.with_transfer(transfer));
    let of = |weighting| Method::DEFAULT.with_weighting(weighting);
    let all = WEIGHTINGS.into_iter().map(of).flat_map(schemes);
    let (weighting, transfer) = LEAST_SQUARES;
    let last = schemes(of(weighting).with_transfer(transfer));
    all.flat_map(transfers).chain(last).collect()
}

/// A scene with each scheme.
pub fn with_schemes(scene: &Scene) -> [Scene; 3] {
    SCHEMES.map(|scheme| scene.clone().with_scheme(scheme))
}

/// A scene with each combination of some weighting functions with a scheme.
pub fn each_scheme(scene: &Scene, weightings: &[Weighting]) -> Vec<Scene> {
    let of = |weighting: &Weighting| with_schemes(&scene.clone().with_weighting(*weighting));
    weightings.iter().flat_map(of).collect()
}

/// GIMP whose domains follow the stretch.
pub const CONTIGUOUS: Weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
/// Weighting functions with which particles that fill their cells carry a linear stress exactly.
pub const FILLING: [Weighting; 3] = [Weighting::Linear, Weighting::UniformGimp, CONTIGUOUS];
/// Weighting functions with a stable step for every body.
pub const SAFE: [Weighting; 3] = [
    Weighting::UniformGimp,
    CONTIGUOUS,
    Weighting::QuadraticBSpline,
];

/// Steps of a multiple of h/(c + |v|), refused where they are not stable.
pub fn multiple(multiplier: f64) -> TimeStep {
    TimeStep::Multiplier {
        multiplier,
        allow_unstable: false,
    }
}

/// The same steps, stable or not.
pub fn unstable(mut time_step: TimeStep) -> TimeStep {
    if let TimeStep::Fixed { allow_unstable, .. } | TimeStep::Multiplier { allow_unstable, .. } =
        &mut time_step
    {
        *allow_unstable = true;
    }
    time_step
}

/// So many steps with a method that has a safe step, and two with one of which the kernel says that it has none.
pub fn count_of(method: Method, count: u64) -> u64 {
    if method.has_safe_step() { count } else { 2 }
}

/// The only contact of a scene, with the normal of its first body, the master, on its grid.
pub fn pair(bodies: [i64; 2], friction: f64) -> Vec<Contact> {
    contact("contact 1", bodies, friction, ContactNormal::Master)
}

/// An error where none should be.
pub fn unexpected(what: impl fmt::Display, error: impl fmt::Display) -> RowFault {
    RowFault(format!("{what}: {error}"))
}

/// The method of a scene in words.
pub fn method(scene: &Scene) -> String {
    method_of(scene).to_string()
}

/// Checks a scene and sets it in motion.
pub fn start(scene: &Scene, options: &Options) -> Result<Simulation> {
    let refused = |error| unexpected(method(scene) + ": refused", error);
    scene.simulate(options).map_err(refused)
}

/// A step that must not fail.
pub fn step(simulation: &mut Simulation, stop: f64) -> Result<StepInfo> {
    let stepped = simulation.step(stop);
    stepped.map_err(|error| unexpected(method(simulation.scene()), error))
}

/// Runs so many steps.
pub fn steps(simulation: &mut Simulation, count: u64) -> Result<()> {
    for _ in 0..count {
        step(simulation, NEVER)?;
    }
    Ok(())
}

/// A scene after so many steps.
pub fn after(scene: &Scene, options: &Options, count: u64) -> Result<Simulation> {
    let mut simulation = start(scene, options)?;
    steps(&mut simulation, count)?;
    Ok(simulation)
}

/// A scene at a time \[s\].
pub fn at_time(scene: &Scene, options: &Options, time: f64) -> Result<Simulation> {
    let mut simulation = start(scene, options)?;
    to_time(&mut simulation, time)?;
    Ok(simulation)
}

/// A scene at a time \[s\], and its particles where x + v t + g t²/2 has brought those of the start.
pub fn fallen(scene: &Scene, time: f64) -> Result<(Simulation, Vec<ParticleState>)> {
    let mut simulation = start(scene, &options())?;
    let mut exact = particles(&simulation);
    to_time(&mut simulation, time)?;
    let (t, g) = (simulation.time(), scene.gravity);
    for seen in &mut exact {
        let (x, v) = (seen.position, seen.velocity);
        seen.position = std::array::from_fn(|k| x[k] + v[k] * t + 0.5 * g[k] * t * t);
    }
    Ok((simulation, exact))
}

/// Runs so many steps and looks at those whose number `every` divides.
pub fn each_of(
    simulation: &mut Simulation,
    [count, every]: [u64; 2],
    mut look: impl FnMut(&Simulation),
) -> Result<()> {
    for _ in 0..count {
        let info = step(simulation, f64::INFINITY)?;
        if info.step.is_multiple_of(every) {
            look(simulation);
        }
    }
    Ok(())
}

/// Runs to a time \[s\].
pub fn to_time(simulation: &mut Simulation, time: f64) -> Result<()> {
    run_to(simulation, time, |_, _| ())
}

/// Runs to a time \[s\] and looks at every step.
pub fn run_to(
    simulation: &mut Simulation,
    time: f64,
    mut look: impl FnMut(&Simulation, &StepInfo),
) -> Result<()> {
    while simulation.time() < time {
        let info = step(simulation, time)?;
        look(simulation, &info);
    }
    Ok(())
}

/// Checks that the kernel does not doubt a sound run.
///
/// # Errors
/// The balance that is off.
pub fn trusted(simulation: &Simulation) -> Result<()> {
    let what = || method(simulation.scene()) + ": a sound run is doubted";
    let doubt = simulation.invariants().violation;
    doubt.map_or(Ok(()), |violation| Err(unexpected(what(), violation)))
}

/// The error of a run that must end within so many steps; `look` sees all steps before it.
///
/// # Errors
/// A run that goes on.
pub fn stopped(
    simulation: &mut Simulation,
    most: u64,
    mut look: impl FnMut(&Simulation),
) -> Result<StepError> {
    for _ in 0..most {
        match simulation.step(NEVER) {
            Err(error) => return Ok(error),
            Ok(_) => look(simulation),
        }
    }
    let otherwise = format!("goes on after {most} steps");
    Err(unexpected(method(simulation.scene()), otherwise))
}

/// The message of a scene that is refused, as `known` tells it of the error.
pub fn refused(
    what: impl fmt::Display,
    scene: &Scene,
    options: &Options,
    known: impl Fn(&StartError) -> Option<String>,
) -> Result<String> {
    match scene.simulate(options) {
        Err(error) => known(&error).ok_or_else(|| unexpected(what, format!("is called {error}"))),
        Ok(_) => Err(unexpected(what, "was taken")),
    }
}

/// The message of a scene that is refused for its step, of which `right` holds.
pub fn refused_step(
    what: impl fmt::Display,
    scene: &Scene,
    options: &Options,
    right: impl Fn(&TimeStepAboveCritical) -> bool,
) -> Result<String> {
    refused(what, scene, options, |error| match error {
        StartError::Setup(SetupError::UnstableTimeStep(at)) => right(at).then(|| at.to_string()),
        _ => None,
    })
}

/// Particles that have left the mesh, as they were booked.
pub fn removed(simulation: &Simulation) -> impl Iterator<Item = &ParticleAt> {
    let events = simulation.events().iter();
    events.filter_map(|event| match &event.kind {
        EventKind::Removed(at) => Some(at),
        _ => None,
    })
}

/// A scene at a time \[s\], out of which particles are taken as they leave, and the share of its mass that is neither left nor
/// booked as removed.
pub fn emptied(scene: &Scene, time: f64) -> Result<(Simulation, f64)> {
    let mut scene = scene.clone();
    scene.outside = Outside::Remove;
    let mut simulation = start(&scene, &options())?;
    let mass = simulation.mass();
    to_time(&mut simulation, time)?;
    let booked: f64 = removed(&simulation).map(|at| at.mass).sum();
    let unbooked = (booked + simulation.mass() - mass).abs() / mass;
    Ok((simulation, unbooked))
}

/// The gates of a verification case with its short ladder.
pub fn of_case(case: &Case) -> Result<Vec<Gate>> {
    let mut solved = vec![];
    for rung in case.rungs(Size::Quick) {
        let found = case.solve(&rung, &options(), &mut |_| ());
        solved.push((rung, found.map_err(|error| unexpected(case.name(), error))?));
    }
    let mut gates = case.judge(Size::Quick, &solved).gates;
    for gate in &mut gates {
        gate.name = format!("{}: {}", case.name(), gate.name);
    }
    Ok(gates)
}
