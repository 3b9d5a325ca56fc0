//! A base that moves one plane of the mesh, and the mesh with it along the normal of that plane.

use super::{Acting, Condition, Kind, Made};
use crate::grid::GridShape;
use crate::scene::{PlaneCondition, Scene, Vector};
use crate::simulation::Simulation;
use crate::simulation::clock::StepInfo;
use crate::simulation::event::{Event, EventKind};
use crate::stage::solve::Wall;
use std::sync::Arc;

/// The plane that moves.
struct MovingBase {
    axis: usize,
    side: usize,
}

/// A moving base.
pub(super) const MOVING_BASE: Kind = Kind {
    words: |scene, list| {
        let acts = scene.base_motion.is_some();
        list.choose(
            "stage",
            "base motion",
            acts,
            "a record moves a plane, and the mesh with it along its normal",
            "no active record",
        );
    },
    make: Some(of),
    planes: true,
};

fn of(scene: &Scene, _: &GridShape) -> Option<Made> {
    let base = scene.base_motion.as_ref()?;
    Some(Ok(Arc::new(MovingBase {
        axis: base.axis,
        side: base.side,
    })))
}

impl Condition for MovingBase {
    /// The plane is fixed to the base; the others move with the mesh.
    fn prescribe(&self, simulation: &Simulation, acting: &mut Acting) {
        let Some(base) = &simulation.decided.base else {
            return;
        };
        let [before, after] = acting.half_steps.map(|time| base.at(time));
        for wall in &mut acting.walls {
            wall.before = simulation.mesh_part(before);
            wall.after = simulation.mesh_part(after);
        }
        let own = Wall {
            axis: self.axis,
            side: self.side,
            prescribed: PlaneCondition::Fixed.prescribed(self.axis),
            before,
            after,
        };
        let place = |wall: &Wall| (wall.axis, wall.side);
        match acting.walls.binary_search_by_key(&place(&own), place) {
            Ok(at) => acting.walls[at] = own,
            Err(at) => acting.walls.insert(at, own),
        }
    }
}

impl Simulation {
    /// The part of a velocity of the base that the mesh takes part in: that along the normal of the base, so that
    /// the base stays on its plane of nodes however far it moves, and the plane opposite moves with it.
    fn mesh_part(&self, v: Vector) -> Vector {
        let normal = self
            .decided
            .scene
            .base_motion
            .as_ref()
            .map(|base| base.axis);
        std::array::from_fn(|axis| if Some(axis) == normal { v[axis] } else { 0.0 })
    }

    /// Velocity of the mesh in the middle of the step \[m/s\].
    pub(in crate::simulation) fn mesh_velocity(&self, info: &StepInfo) -> Vector {
        let middle = self.state.clock.time + 0.5 * info.dt;
        let base = self.decided.base.as_ref();
        base.map_or([0.0; 3], |base| self.mesh_part(base.at(middle)))
    }

    /// Notes the end of a record of the base, if it lies in this step.
    pub(in crate::simulation) fn note_end_of_record(&mut self, info: &StepInfo) {
        if let Some(base) = &self.decided.base
            && self.state.clock.time < base.end()
            && info.time >= base.end()
        {
            self.state.events.push(Event {
                step: info.step,
                time: info.time,
                kind: EventKind::RecordEnded,
            });
        }
    }
}
