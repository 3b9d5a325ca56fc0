//! Conditions on the nodes of a velocity field: what acts on it from outside.
//!
//! Each kind stands in one list, under the file that it is in: a scene that has none of a kind has no element of it in its
//! list, and nothing in the cycle asks for it. What a program adds comes
//! after those of the scene, by the same trait.
//!
//! Gravity and local damping are numbers in [`NodalConditions`], since they lie in the loop of the acceleration, where a sweep of
//! their own over the nodes would cost more than they do. Viscous damping acts while forces are mapped (`stage/p2g`),
//! kinetic damping on all particles at once (`relaxation.rs`), box loads and body forces on particles: none of these is a
//! condition on nodes.

mod light;

pub use loads::areas as nodes_of_traction;
pub(super) use loads::{load_on, rings};

use super::{Cycle, history_value};
use crate::grid::GridShape;
use crate::model::CycleSettings;
use crate::plan::PlanEntries;
use crate::simulation::context::{Condition, NodalConditions};
use crate::simulation::values::SetupError;
use std::sync::Arc;

/// A condition, or why there cannot be one.
type ConditionResult = Result<Arc<dyn Condition>, SetupError>;

/// Builds the condition of a type, where a scene has any.
type ConditionBuilder = fn(&CycleSettings, &GridShape) -> Option<ConditionResult>;

/// A type of condition, as it stands in a list.
struct ConditionType {
    /// Entries of the plan for it.
    plan_entries: fn(&CycleSettings, &mut PlanEntries),
    /// Builder of the condition, if it is one on nodes.
    make: Option<ConditionBuilder>,
    /// True for the boundary planes, which have the last word at a node.
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
    absorbing: [ABSORBING_PLANES],
    standing: [STANDING_WATER],
}

/// Adds the entries of the plan for conditions.
pub fn describe(settings: &CycleSettings, list: &mut PlanEntries) {
    for kind in ALL {
        (kind.plan_entries)(settings, list);
    }
}

/// The conditions of a scene, those of the user after them.
///
/// # Errors
/// A load that has no place on the grid.
pub fn of(
    settings: &CycleSettings,
    shape: &GridShape,
    own: &[Arc<dyn Condition>],
) -> Result<Vec<Arc<dyn Condition>>, SetupError> {
    let made = |planes| {
        let kinds = ALL.iter().filter(move |kind| kind.planes == planes);
        kinds.filter_map(|kind| kind.make?(settings, shape))
    };
    let all = made(false).chain(made(true));
    all.chain(own.iter().cloned().map(Ok)).collect()
}

impl Cycle {
    /// Makes the conditions of the scene anew, after it has changed.
    pub(super) fn set_conditions(&mut self) -> Result<(), SetupError> {
        self.model.conditions = of(
            &self.model.settings,
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
        self.prescribe(&mut nodal);
        self.exchange_driven(&mut nodal);
        nodal
    }

    /// Adds what all conditions prescribe in a step of these times.
    #[inline]
    pub(super) fn prescribe(&self, nodal: &mut NodalConditions) {
        let half_steps = nodal.half_steps;
        let bodies = self.model.bodies.iter();
        nodal.prescribed.extend(bodies.map(|body| {
            let motion = body.motion.as_ref()?;
            Some(half_steps.map(|time| history_value(motion, time)))
        }));
        self.prescribe_absorbing(nodal);
        let view = self.view();
        for condition in &self.model.conditions {
            condition.prescribe(&view, nodal);
        }
    }
}
