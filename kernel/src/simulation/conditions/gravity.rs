//! Gravity: a number of the acceleration.

use super::{Acting, Condition, Kind, Made};
use crate::grid::GridShape;
use crate::scene::{Scene, Vector};
use crate::simulation::Simulation;
use std::sync::Arc;

struct Gravity(Vector);

/// Gravity.
pub(super) const GRAVITY: Kind = Kind {
    words: |scene, list| {
        let acts = scene.gravity != [0.0; 3];
        list.choose("stage", "gravity", acts, "it is not zero", "it is zero");
    },
    make: Some(of),
    planes: false,
};

fn of(scene: &Scene, _: &GridShape) -> Option<Made> {
    let acts = scene.gravity != [0.0; 3];
    acts.then(|| Ok(Arc::new(Gravity(scene.gravity)) as _))
}

impl Condition for Gravity {
    fn prescribe(&self, _: &Simulation, acting: &mut Acting) {
        acting.gravity = self.0;
    }
}
