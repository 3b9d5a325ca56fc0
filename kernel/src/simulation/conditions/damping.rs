//! Damping. Local damping is a number of the acceleration; viscous damping acts while forces are mapped (`stage/p2g`), and
//! only what it takes is summed here; of kinetic damping only the plan speaks.

use super::{Acting, Condition, FieldNodes, Kind, Made};
use crate::grid::GridShape;
use crate::scene::{Damping, Scene};
use crate::simulation::Simulation;
use std::sync::Arc;

struct LocalDamping(f64);

struct ViscousDamping;

const NOT_ZERO: &str = "its factor is not zero";
const ZERO: &str = "not asked for, or its factor is zero";

/// Kinetic damping, which acts on all particles at once (`relaxation.rs`).
pub(super) const KINETIC_DAMPING: Kind = Kind {
    words: |scene, list| {
        let acts = scene.damping == Damping::Kinetic;
        let why = "asked for: velocities are set to zero at each peak of kinetic energy";
        list.choose("stage", "kinetic damping", acts, why, "not asked for");
    },
    make: None,
    planes: false,
};

/// Viscous damping, which acts while forces are mapped (`stage/p2g`).
pub(super) const VISCOUS_DAMPING: Kind = Kind {
    words: |scene, list| {
        let acts = matches!(scene.damping, Damping::Viscous { alpha } if alpha != 0.0);
        list.choose("stage", "viscous damping", acts, NOT_ZERO, ZERO);
    },
    make: Some(|scene, _| {
        let acts = matches!(scene.damping, Damping::Viscous { alpha } if alpha != 0.0);
        acts.then(|| Ok(Arc::new(ViscousDamping) as _))
    }),
    planes: false,
};

/// Local damping.
pub(super) const LOCAL_DAMPING: Kind = Kind {
    words: |scene, list| {
        let acts = matches!(scene.damping, Damping::Local { alpha } if alpha != 0.0);
        list.choose("stage", "local damping", acts, NOT_ZERO, ZERO);
    },
    make: Some(of),
    planes: false,
};

fn of(scene: &Scene, _: &GridShape) -> Option<Made> {
    match scene.damping {
        Damping::Local { alpha } if alpha != 0.0 => Some(Ok(Arc::new(LocalDamping(alpha)))),
        _ => None,
    }
}

impl Condition for ViscousDamping {
    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        if let Some(rate) = field.now.mapping.viscous_rate(field.owner()) {
            let (planes, now, sums) = field.parts();
            planes.add_viscous(rate, now.acting.kick, &now.walls, sums);
        }
    }
}

impl Condition for LocalDamping {
    fn prescribe(&self, _: &Simulation, acting: &mut Acting) {
        acting.local_damping = Some(self.0);
    }
}
