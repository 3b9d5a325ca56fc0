//! Limits where a step is not linear: large strain, rotation, contact of every kind, a moving base, each law.
//!
//! Nothing is predicted here. The kernel's own step is held against a run with half of it, and the steps at which energy
//! begins to come from nowhere are closed in on.

pub mod scenes;

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{DomainUpdate, Scene, StressScheme, TimeStep, TransferKind, Weighting};

use super::StabilityError;
use super::measured::{MeasuredLimit, bisect, courant_one};
use crate::case::{Gate, Size};
use crate::settings::{Method, Settings};
use scenes::Set;

/// Energy over the highest of the reference from which a run is unstable.
const GROWN: f64 = 2.0;
/// Steps from one look at the energy to the next.
const LOOK_EVERY: u64 = 4;
/// Steps over the kernel's own between which a limit is sought.
pub const RANGE: [f64; 2] = [0.5, 8.0];
/// First guess: the kernel takes 0.8 of its bound.
const GUESS: f64 = 1.25;

/// Methods that are tried: the default, the two with the longest steps, and the smoothest.
pub const METHODS: [Method; 4] = [
    Method::DEFAULT,
    Method {
        weighting: Weighting::UniformGimp,
        scheme: StressScheme::Musl,
        transfer: TransferKind::Flip,
    },
    Method {
        weighting: Weighting::ContiguousGimp(DomainUpdate::Stretch),
        scheme: StressScheme::Usf,
        transfer: TransferKind::Flip,
    },
    Method {
        weighting: Weighting::QuadraticBSpline,
        scheme: StressScheme::Musl,
        transfer: TransferKind::Apic,
    },
];

/// Reason for which the kernel's own step must be stable.
const KERNEL_HOLDS: &str =
    "a run at the kernel's step may have no more energy than twice that of a run at half of it";

/// A scene that is not linear.
pub struct Nonlinear {
    /// Name on the command line: lower case, words joined by `-`.
    pub name: &'static str,
    /// Subject of the scene.
    pub what: &'static str,
    set: fn() -> Set,
    /// True if USF can run it.
    usf: bool,
    /// Number of its methods with which a quick run tries it.
    quick: usize,
}

/// All of them, in the order in which they are shown.
pub static ALL: &[Nonlinear] = &[
    Nonlinear {
        name: "large-strain",
        what: "a neo-Hookean block swings by 40 %",
        set: scenes::large_strain,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "hypoelastic",
        what: "the same with the rate of Hughes and Winget",
        set: scenes::hypoelastic,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "rotation",
        what: "a block spins, its corners at a tenth of the wave speed",
        set: scenes::rotation,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "rotation-jaumann",
        what: "the same with the Jaumann rate of the manuals",
        set: scenes::rotation_jaumann,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "von-mises",
        what: "a block is drawn and pressed beyond yield, then swings",
        set: scenes::von_mises,
        usf: true,
        quick: 2,
    },
    Nonlinear {
        name: "mohr-coulomb",
        what: "the same with friction, cohesion and dilation",
        set: scenes::mohr_coulomb,
        usf: true,
        quick: 2,
    },
    Nonlinear {
        name: "wet-open",
        what: "a block of two phases is sheared and swings, its water hardly held by the soil",
        set: scenes::wet_open,
        usf: false,
        quick: 2,
    },
    Nonlinear {
        name: "wet-tight",
        what: "the same with water that cannot flow",
        set: scenes::wet_tight,
        usf: false,
        quick: 2,
    },
    Nonlinear {
        name: "newtonian",
        what: "a block of a fluid so viscous that this bounds the step",
        set: scenes::newtonian,
        usf: true,
        quick: 2,
    },
    Nonlinear {
        name: "grid-contact",
        what: "two blocks collide with friction on the grid",
        set: scenes::grid_contact,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "mortar-barrier",
        what: "two blocks collide with friction by mortar contact",
        set: scenes::mortar_barrier,
        usf: false,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "mortar-penalty",
        what: "the same with a penalty",
        set: scenes::mortar_penalty,
        usf: false,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "mortar-line",
        what: "a block falls on a rigid line",
        set: scenes::mortar_line,
        usf: false,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "rigid-surface",
        what: "a block falls on triangles (3D)",
        set: scenes::rigid_surface,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "rigid-penalty",
        what: "the same with a stiff penalty beside",
        set: scenes::rigid_penalty,
        usf: true,
        quick: METHODS.len(),
    },
    Nonlinear {
        name: "moving-base",
        what: "a column on a base that shakes along its normal",
        set: scenes::moving_base,
        usf: true,
        quick: METHODS.len(),
    },
];

/// Findings of a scene with a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The kernel's smallest step as c dt / min(h), c the wave speed at rest.
    pub automatic: f64,
    /// Highest energy with the kernel's steps over that of the reference; infinite where a step failed.
    pub energy: f64,
    /// Steps over the kernel's.
    pub measured: MeasuredLimit,
    /// Error that ended the run at the kernel's steps, or else the one at [`MeasuredLimit::unstable`], if any.
    pub refusal: Option<String>,
}

impl Nonlinear {
    /// The methods that can run it, and that a run of this size tries.
    #[must_use]
    pub fn methods(&self, size: Size) -> Vec<Method> {
        let most = match size {
            Size::Quick => self.quick,
            Size::Full => METHODS.len(),
        };
        let wet = (self.set)().scene.has_water();
        let for_water = |method: &Method| {
            let flip = method.transfer == TransferKind::Flip;
            flip && method.weighting == Weighting::UniformGimp
        };
        let can = |method: &&Method| {
            (self.usf || method.scheme != StressScheme::Usf) && (!wet || for_water(method))
        };
        METHODS.iter().filter(can).take(most).copied().collect()
    }

    /// Finds the limit with a method.
    ///
    /// # Errors
    /// A scene that is refused, or a reference that fails.
    pub fn solve(&self, method: Method, size: Size) -> Result<Limit, StabilityError> {
        let Set {
            mut scene,
            initial,
            time,
        } = (self.set)();
        Settings::new(method).apply(&mut scene);
        scene.time = time
            * match size {
                Size::Quick => 0.3,
                Size::Full => 1.0,
            };
        let options = Options {
            threads: Some(1),
            initial,
            ..Options::default()
        };
        let own = run(&scene, &options, TimeStep::Automatic, f64::INFINITY)?;
        let with = |dt: f64| TimeStep::Fixed {
            dt,
            allow_unstable: true,
        };
        let reference = run(&scene, &options, with(0.5 * own.dt), f64::INFINITY)?;
        if let Some(error) = reference.failed {
            return Err(StabilityError::Step(error));
        }
        let most = GROWN * reference.energy;
        let mut refusal = (f64::INFINITY, None);
        let own_failure = own.failed.as_ref().map(ToString::to_string);
        let measured = bisect(GUESS, RANGE, |share| {
            let ran = run(&scene, &options, with(share * own.dt), most)?;
            let holds = ran.failed.is_none() && ran.energy <= most;
            if !holds && share < refusal.0 {
                refusal = (share, ran.failed.map(|error| error.to_string()));
            }
            Ok::<bool, StabilityError>(holds)
        })?;
        Ok(Limit {
            automatic: own.dt / courant_one(&scene),
            energy: match own.failed {
                Some(_) => f64::INFINITY,
                None => own.energy / reference.energy,
            },
            measured,
            refusal: own_failure.or(refusal.1),
        })
    }

    /// Gates of the scene.
    #[must_use]
    pub fn gate(&self, method: Method, limit: &Limit) -> Gate {
        let name = format!("{} {method}: energy at the kernel's step", self.name);
        Gate::at_most(name, limit.energy, GROWN, KERNEL_HOLDS)
    }
}

/// Growth of a run.
struct RunGrowth {
    /// Highest energy that was seen \[J\].
    energy: f64,
    /// Smallest step \[s\].
    dt: f64,
    failed: Option<proctor_scene::simulation::StepError>,
}

/// Runs a scene to its end, or until it has more energy than `most` \[J\].
fn run(
    scene: &Scene,
    options: &Options,
    time_step: TimeStep,
    most: f64,
) -> Result<RunGrowth, StabilityError> {
    let mut scene = scene.clone();
    scene.time_step = time_step;
    let mut simulation = scene.simulate(options)?;
    let begin = energy(&simulation);
    let mut ran = RunGrowth {
        energy: begin,
        dt: f64::INFINITY,
        failed: None,
    };
    while simulation.time() < scene.time {
        match simulation.step(scene.time) {
            Ok(info) => ran.dt = ran.dt.min(info.dt),
            Err(error) => {
                ran.failed = Some(error);
                return Ok(ran);
            }
        }
        if simulation.steps().is_multiple_of(LOOK_EVERY) {
            let now = energy(&simulation);
            // Not a number is more than anything.
            ran.energy = if now.is_nan() {
                f64::INFINITY
            } else {
                ran.energy.max(now)
            };
            if ran.energy > most {
                return Ok(ran);
            }
        }
    }
    Ok(ran)
}

/// Kinetic and strain energy, and what contact stores \[J\].
#[must_use]
pub fn energy(simulation: &Simulation) -> f64 {
    simulation.kinetic_energy() + simulation.strain_energy() + simulation.mortar_energy()
}
