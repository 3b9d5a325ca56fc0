//! Options of a simulation beyond its scene.

use super::start_state::StartState;
use proctor_geometry::memory::Memory;
use proctor_geometry::team::Team;
use proctor_kernel::lanes::LaneChoice;
use proctor_kernel::laws::{Component, UNDEFORMED};
use proctor_kernel::model::Vector;
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::{BodyForce, Condition, Interaction};
use std::fmt;
use std::sync::Arc;

/// State of a particle at the start, by its position \[m\].
pub type InitialField = Arc<dyn Fn(&Vector) -> InitialState + Send + Sync>;

/// Quantity of an [`InitialField`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialState {
    /// Velocity \[m/s\].
    pub velocity: Vector,
    /// Velocity gradient \[1/s\], `[a][b]` = dv_a/dx_b: the affine velocity of APIC and TPIC at the start. Without
    /// it their first mapping loses what the velocity varies by within a cell, a body's spin for one. FLIP has no
    /// use for it.
    pub velocity_gradient: [[f64; 3]; 3],
    /// Cauchy stress \[Pa\]: xx, yy, zz, yz, xz, xy, each at the place of its
    /// [`Component`]. The neo-Hookean law computes it from F after the first
    /// step.
    pub stress: [f64; 6],
    /// Deformation gradient; the volume becomes V_0 det F.
    pub deformation: [[f64; 3]; 3],
}

impl InitialState {
    /// Sets this component of the stress \[Pa\].
    #[must_use]
    pub fn with_stress(mut self, component: Component, value: f64) -> Self {
        self.stress[component.place()] = value;
        self
    }
}

impl Default for InitialState {
    /// State at rest, without stress or deformation.
    fn default() -> Self {
        Self {
            velocity: [0.0; 3],
            velocity_gradient: [[0.0; 3]; 3],
            stress: [0.0; 6],
            deformation: UNDEFORMED,
        }
    }
}

/// Options of a run, and the conditions and interactions that a program adds to it.
///
/// ```
/// use proctor_scene::prelude::*;
///
/// let options = Options::default().with_threads(2).with_initial(|x| InitialState {
///     velocity: [0.1 * x[0], 0.0, 0.0],
///     ..InitialState::default()
/// });
/// assert_eq!(options.threads, Some(2));
/// ```
#[derive(Clone, Default)]
pub struct Options {
    /// Number of threads; else what the scene says, else one for every 8192 particles, at most all of the machine.
    pub threads: Option<usize>,
    /// Threads that are there already, those of another simulation ([`team`](proctor_kernel::simulation::Cycle::team)); `threads` is of no account then.
    pub team: Option<Arc<Team>>,
    /// Fewest particles that are worth a second thread in a step, where there are several; else 2048. No bit depends on it.
    pub least_share: Option<usize>,
    /// Lanes.
    pub lanes: LaneChoice,
    /// Keep displacements even where nothing is written.
    pub displacement: bool,
    /// Measure kinetic energy and residual at the nodes in every step.
    pub measure: bool,
    /// Body force, for manufactured solutions.
    pub body_force: Option<BodyForce>,
    /// Initial state, for manufactured solutions.
    pub initial: Option<InitialField>,
    /// Bodies as another run left them, in the place of those with which the scene fills them.
    pub start: Option<Arc<StartState>>,
    /// Conditions at the nodes beside those of the scene. They act after those.
    pub conditions: Vec<Arc<dyn Condition>>,
    /// Interactions of velocity fields beside those of the scene. They act after those.
    pub interactions: Vec<Box<dyn Interaction>>,
    /// Ranks that share the simulation: each fills its part of the bodies, and none has the whole. Where particles are given one by
    /// one, or begin as another run left them, each rank fills the whole, and whoever runs it shares it then
    /// ([`share_among`](proctor_kernel::simulation::Cycle::share_among)), as `proctor_files::run::Run` does.
    pub ranks: Option<Arc<dyn Ranks>>,
    /// Ranks that share each step, while every one of them has the whole simulation between two steps
    /// ([`share_steps_among`](proctor_kernel::simulation::Cycle::share_steps_among)).
    pub step_ranks: Option<Arc<dyn Ranks>>,
    /// True for frames in a piece of each rank, whatever their number of points; else those of more than ten million points are.
    pub in_pieces: bool,
    /// Memory that the scene may need; else all that the machine has free.
    pub memory: Option<Memory>,
}

impl Options {
    /// Sets this number of threads.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Sets these lanes.
    #[must_use]
    pub fn with_lanes(mut self, lanes: LaneChoice) -> Self {
        self.lanes = lanes;
        self
    }

    /// Sets this initial state of the particles, by their position \[m\].
    #[must_use]
    pub fn with_initial(
        mut self,
        initial: impl Fn(&Vector) -> InitialState + Send + Sync + 'static,
    ) -> Self {
        self.initial = Some(Arc::new(initial));
        self
    }

    /// Sets this body force per mass \[m/s²\]: see [`BodyForce`].
    #[must_use]
    pub fn with_body_force(
        mut self,
        force: impl Fn(&Vector, &Vector, f64) -> Vector + Send + Sync + 'static,
    ) -> Self {
        self.body_force = Some(Arc::new(force));
        self
    }

    /// Adds this condition at the nodes, after those of the scene and those that were given before.
    #[must_use]
    pub fn with_condition(mut self, condition: impl Condition + 'static) -> Self {
        self.conditions.push(Arc::new(condition));
        self
    }

    /// Adds this interaction of velocity fields, after those of the scene and those that were given before.
    #[must_use]
    pub fn with_interaction(mut self, interaction: impl Interaction + 'static) -> Self {
        self.interactions.push(Box::new(interaction));
        self
    }
}

impl fmt::Debug for Options {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Options")
            .field("threads", &self.threads)
            .field("team", &self.team.as_ref().map(|team| team.count()))
            .field("least_share", &self.least_share)
            .field("lanes", &self.lanes)
            .field("displacement", &self.displacement)
            .field("measure", &self.measure)
            .field("body_force", &self.body_force.is_some())
            .field("initial", &self.initial.is_some())
            .field("start", &self.start.as_ref().map(|start| &start.source))
            .field("conditions", &self.conditions.len())
            .field("interactions", &self.interactions.len())
            .field("ranks", &self.ranks.as_ref().map(|ranks| ranks.count()))
            .field(
                "step_ranks",
                &self.step_ranks.as_ref().map(|ranks| ranks.count()),
            )
            .field("in_pieces", &self.in_pieces)
            .field("memory", &self.memory)
            .finish()
    }
}
