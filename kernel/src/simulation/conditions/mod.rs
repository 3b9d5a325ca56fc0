//! Conditions on the nodes of a velocity field: what acts on it from outside.
//!
//! Each kind stands in one list, under the file that it is in: a scene that has none of a kind has no element of it in its
//! list, and nothing in the cycle asks for it. What a library user adds ([`Options::conditions`](super::Options)) comes
//! after those of the scene, by the same trait.
//!
//! Gravity and local damping are numbers in [`NodalConditions`], since they lie in the loop of the acceleration, where a sweep of
//! their own over the nodes would cost more than they do. Viscous damping acts while forces are mapped (`stage/p2g`),
//! kinetic damping on all particles at once (`relaxation.rs`), box loads and body forces on particles: none of these is a
//! condition on nodes.

mod light;
mod nodes;

pub(super) use loads::{areas as nodes_of_traction, load_on};
pub use nodes::{FieldNodes, Node};

use super::error::SetupError;
use super::{Simulation, history_value};
use crate::grid::GridShape;
use crate::plan::PlanEntries;
use crate::scene::{Scene, Vector};
use crate::stage::solve::{DrivenNode, EmptyNode, NodeForce, Wall};
use smallvec::SmallVec;
use std::sync::Arc;

/// A condition on the nodes of velocity fields.
///
/// A step asks it in this order: [`Condition::prescribe`] once its length is known; then for each field, on each slab of
/// planes that a thread owns, [`Condition::before`] and [`Condition::after`] the acceleration, [`Condition::settled`] when
/// contact has acted, and [`Condition::remap`] on velocities that are mapped a second time. Slabs and fields are visited at
/// once by several threads, and their number must not change a result: what is done at a node may depend on that node
/// alone. A body whose motion is prescribed has no equation of motion, and no condition is asked about its field.
pub trait Condition: Send + Sync {
    /// Whether [`Condition::prescribe`] looks at the masses of the nodes: mapping and equation of motion take two visits of the
    /// slabs then.
    fn finds(&self) -> bool {
        false
    }

    /// Adds what it prescribes in a step to what others do.
    fn prescribe(&self, _simulation: &Simulation, _acting: &mut NodalConditions) {}

    /// Adds forces at the nodes; mass, velocity and force of the particles are there.
    ///
    /// # Errors
    /// A node that a force acts on has no mass.
    fn before(&self, _field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        Ok(())
    }

    /// Changes velocities after the acceleration, before contact.
    fn after(&self, _field: &mut FieldNodes<'_, '_>) {}

    /// Adds the power of its forces \[W\], with the velocities after contact.
    fn settled(&self, _field: &mut FieldNodes<'_, '_>) {}

    /// Changes velocities that were mapped a second time, from which strain is taken (MUSL, USF). What was done to the
    /// velocities before is in the particles, and so in these; what must hold exactly is prescribed once more.
    fn remap(&self, _field: &mut FieldNodes<'_, '_>) {}
}

/// The nodal conditions of one step: walls, prescribed velocities, loads, gravity and times.
#[derive(Clone, Debug, Default)]
pub struct NodalConditions {
    /// Boundary planes with a condition, by axis and side, with their velocities.
    pub walls: Walls,
    /// Velocities half a step before and after of each body whose motion is prescribed \[m/s\], by its place in the scene.
    pub prescribed: Vec<Option<[Vector; 2]>>,
    /// Forces of loads on nodes that change with time, with those that do not, in order of the nodes \[N\].
    pub loads: Vec<NodeForce>,
    /// Whether those are all that act in this step, in place of those that stay what they are.
    pub(super) spread: bool,
    /// Nodes of the common field that move with driven bodies, each once, increasing; none that is held.
    pub driven: Vec<DrivenNode>,
    /// Nodes while they are sought.
    pub(super) nodes: Vec<usize>,
    /// Nodes of all fields that stand still, each once, increasing.
    pub held: Arc<[DrivenNode]>,
    /// Acceleration of gravity \[m/s²\].
    pub gravity: Vector,
    /// Factor of local damping.
    pub local_damping: Option<f64>,
    /// Time over which velocities change \[s\].
    pub kick: f64,
    /// Times of the velocities before and after \[s\], half a step before and half a step after the positions.
    pub half_steps: [f64; 2],
    /// Time over which positions move \[s\].
    pub drift: f64,
}

impl NodalConditions {
    /// Nothing acts yet in a step of these times.
    fn begin(&mut self, kick: f64, half_steps: [f64; 2], drift: f64) {
        let Self {
            mut prescribed,
            mut loads,
            mut driven,
            nodes,
            ..
        } = std::mem::take(self);
        prescribed.clear();
        loads.clear();
        driven.clear();
        *self = Self {
            prescribed,
            loads,
            driven,
            nodes,
            kick,
            half_steps,
            drift,
            ..Self::default()
        };
    }
}

/// Boundary planes: six at most.
pub type Walls = SmallVec<[Wall; 6]>;

/// A condition, or why there cannot be one.
type ConditionResult = Result<Arc<dyn Condition>, SetupError>;

/// Builds the condition of a type, where a scene has any.
type ConditionBuilder = fn(&Scene, &GridShape) -> Option<ConditionResult>;

/// A type of condition, as it stands in a list.
struct ConditionType {
    /// What the plan says of it.
    plan_entries: fn(&Scene, &mut PlanEntries),
    /// How it is made, if it is one on nodes.
    make: Option<ConditionBuilder>,
    /// Whether it is one of the boundary planes, which have the last word at a node.
    planes: bool,
}

/// Kinds of conditions by the file that they are in, as the plan lists them. Where one needs what another prescribes, it
/// comes after it.
macro_rules! list {
    ($($file:ident: [$($kind:ident),*],)*) => {
        $(mod $file;)*

        const ALL: &[ConditionType] = &[$($($file::$kind),*),*];
    };
}

list! {
    gravity: [GRAVITY],
    walls: [PLANES],
    damping: [LOCAL_DAMPING, KINETIC_DAMPING, VISCOUS_DAMPING],
    base: [MOVING_BASE],
    held: [HELD_NODES],
    loads: [NODAL_LOADS],
    driven: [DRIVEN_BODIES],
}

/// What the plan says of conditions.
pub(crate) fn describe(scene: &Scene, list: &mut PlanEntries) {
    for kind in ALL {
        (kind.plan_entries)(scene, list);
    }
}

/// The conditions of a scene, those of the user after them.
///
/// # Errors
/// A load that has no place on the grid.
pub(super) fn of(
    scene: &Scene,
    shape: &GridShape,
    own: &[Arc<dyn Condition>],
) -> Result<Vec<Arc<dyn Condition>>, SetupError> {
    let made = |planes| {
        let kinds = ALL.iter().filter(move |kind| kind.planes == planes);
        kinds.filter_map(|kind| kind.make?(scene, shape))
    };
    let all = made(false).chain(made(true));
    all.chain(own.iter().cloned().map(Ok)).collect()
}

impl Simulation {
    /// Makes the conditions of the scene anew, after it has changed.
    pub(super) fn set_conditions(&mut self) -> Result<(), SetupError> {
        self.model.conditions = of(
            &self.model.scene,
            &self.work.grid.shape,
            &self.model.own_conditions,
        )?;
        Ok(())
    }

    /// The nodal conditions of a step of length `dt` \[s\], in the lists of [`WorkState::nodal`](super::WorkState), to which they may be given back.
    pub(super) fn nodal_conditions(&mut self, dt: f64) -> NodalConditions {
        let kick = 0.5 * (self.state.clock.dt_before + dt);
        let half_steps = [self.velocity_time(), self.state.clock.time + 0.5 * dt];
        self.nodal_conditions_over(kick, half_steps, dt)
    }

    /// The nodal conditions over `kick` \[s\], between these times of the velocities \[s\], where positions move over `drift` \[s\].
    pub(super) fn nodal_conditions_over(
        &mut self,
        kick: f64,
        half_steps: [f64; 2],
        drift: f64,
    ) -> NodalConditions {
        let mut nodal = std::mem::take(&mut self.work.nodal);
        nodal.begin(kick, half_steps, drift);
        let bodies = self.model.bodies.iter();
        nodal.prescribed.extend(bodies.map(|body| {
            let motion = body.motion.as_ref()?;
            Some(half_steps.map(|time| history_value(motion, time)))
        }));
        for condition in &self.model.conditions {
            condition.prescribe(self, &mut nodal);
        }
        nodal
    }
}
