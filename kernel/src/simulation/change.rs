//! Changes between two stages of one simulation, such as settling and release.
//!
//! A block that is to slide from rest, for example: run with `set_motion` holding the base, gravity normal to it and
//! local damping until the block is at rest, then `set_local_damping(None)`, `set_gravity` to the inclined one and go
//! on.

use super::Cycle;
use crate::model::{Damping, History, PlaneCondition, Vector};
use crate::simulation::values::{BodyHandle, SetupError};

impl Cycle {
    /// Sets the acceleration of gravity \[m/s²\] from here on. The energy balance goes on: the potential of the old
    /// gravity is booked as work done.
    ///
    /// # Errors
    /// A component that is not finite, or one along an axis that does not exist.
    pub fn set_gravity(&mut self, gravity: Vector) -> Result<(), SetupError> {
        let flat = gravity[self.model.plan.axes..].iter().all(|g| *g == 0.0);
        if !flat || gravity.iter().any(|g| !g.is_finite()) {
            return Err(refused(
                "gravity",
                &format!("{gravity:?}, not a finite vector of the scene"),
            ));
        }
        let before = self.dead_load_potential();
        self.state.ledger.external_work += before - self.state.ledger.dead_load_origin;
        self.model.settings.gravity = gravity;
        self.set_conditions()?;
        self.state.ledger.dead_load_origin = self.dead_load_potential();
        Ok(())
    }

    /// Sets the conditions of the boundary planes of the mesh from here on: free, sliding or fixed.
    ///
    /// # Errors
    /// A plane that is absorbing or antisymmetric, before or then: such planes take over forces that stand at the start, and their
    /// edges depend on the planes beside them.
    pub fn set_planes(&mut self, planes: [[PlaneCondition; 2]; 3]) -> Result<(), SetupError> {
        let all = [self.model.settings.mesh.planes, planes];
        let bearing = all.as_flattened().as_flattened().iter();
        if let Some(plane) = bearing.copied().find(|plane| plane.bears_at_start()) {
            return Err(refused(
                "a boundary plane",
                &format!("{}; accepted: free, sliding and fixed planes", plane.word()),
            ));
        }
        self.model.settings.mesh.planes = planes;
        self.state.start_spin = None;
        self.set_conditions()
    }

    /// Prescribes the velocity of a body from here on, or with `None` releases it: it goes on with the velocity and the stress
    /// that it has.
    ///
    /// # Errors
    /// No such body, or a history that is empty or not finite or whose times do not increase.
    pub fn set_motion(
        &mut self,
        body: BodyHandle,
        motion: Option<History>,
    ) -> Result<(), SetupError> {
        let (index, count) = (body.place(), self.model.bodies.len());
        if index >= count {
            return Err(refused(
                "body",
                &format!("{index}; accepted: below {count}, the number of bodies"),
            ));
        }
        if let Some(history) = &motion {
            let sound = !history.times.is_empty()
                && history.times.len() == history.values.len()
                && history.times.windows(2).all(|t| t[0] < t[1])
                && history.times.iter().all(|t| t.is_finite())
                && history.values.iter().flatten().all(|v| v.is_finite());
            if !sound {
                return Err(refused(
                    "motion",
                    "not a history of increasing times and finite velocities",
                ));
            }
        }
        self.model.bodies[index].keeps_shape &= motion.is_some();
        self.model.bodies[index].motion = motion;
        self.state.start_spin = None;
        self.model.settings.drives_bodies = self.model.bodies.iter().any(|b| b.motion.is_some());
        let found = &mut self.state.found[index];
        let fastest = self.model.bodies[index].fastest();
        found.speed_squared = found.speed_squared.max(fastest);
        self.each(|one, view| one.motion_changed(view, index));
        self.sorted();
        self.set_conditions()
    }

    /// Sets the factor of local damping from here on; `None` for no damping.
    ///
    /// # Errors
    /// A factor outside 0 to 1, or a scene with another kind of damping.
    pub fn set_local_damping(&mut self, alpha: Option<f64>) -> Result<(), SetupError> {
        if matches!(
            self.model.settings.damping,
            Damping::Kinetic | Damping::Viscous { .. }
        ) {
            return Err(refused("damping", "the scene has another kind of damping"));
        }
        if alpha.is_some_and(|alpha| !(0.0..=1.0).contains(&alpha)) {
            return Err(refused(
                "damping",
                &format!("{alpha:?}; accepted: a number from 0 to 1"),
            ));
        }
        self.state.start_spin = None;
        self.model.settings.damping = alpha.map_or(Damping::None, |alpha| Damping::Local { alpha });
        self.set_conditions()
    }
}

fn refused(what: &str, reason: &str) -> SetupError {
    SetupError::Change {
        what: what.into(),
        reason: reason.into(),
    }
}
