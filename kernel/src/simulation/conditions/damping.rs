//! Local damping: a number of the acceleration.

use super::{Acting, Condition, Made};
use crate::grid::GridShape;
use crate::scene::{Damping, Scene};
use crate::simulation::Simulation;
use std::sync::Arc;

struct LocalDamping(f64);

pub(super) fn of(scene: &Scene, _: &GridShape) -> Option<Made> {
    match scene.damping {
        Damping::Local { alpha } if alpha != 0.0 => Some(Ok(Arc::new(LocalDamping(alpha)))),
        _ => None,
    }
}

impl Condition for LocalDamping {
    fn prescribe(&self, _: &Simulation, acting: &mut Acting) {
        acting.local_damping = Some(self.0);
    }
}
