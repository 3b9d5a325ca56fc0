//! Values of a scene that a restart may change and a checkpoint keeps: gravity and local damping.

use crate::output::{Checkpoint, CheckpointError};
use proctor_scene::{Damping, Scene, Vector};

/// Sections of gravity \[m/s²\], and of the factor of local damping.
const GRAVITY: &str = "restart/gravity";
const LOCAL_DAMPING: &str = "restart/local-damping";

/// The scene without what a restart may change and a checkpoint keeps.
pub(super) fn without(scene: &Scene) -> Scene {
    Scene {
        gravity: [0.0; 3],
        damping: match scene.damping {
            Damping::Local { .. } => Damping::None,
            other => other,
        },
        ..scene.clone()
    }
}

/// Keeps it in a checkpoint.
pub(super) fn save(scene: &Scene, checkpoint: &mut Checkpoint) {
    checkpoint.push::<f64>(GRAVITY, scene.gravity.to_vec());
    let factor = local(scene.damping).unwrap_or(0.0);
    checkpoint.push::<f64>(LOCAL_DAMPING, vec![factor]);
}

/// Factor of local damping, where it acts.
pub(super) fn local(damping: Damping) -> Option<f64> {
    match damping {
        Damping::Local { alpha } if alpha != 0.0 => Some(alpha),
        _ => None,
    }
}

/// Gravity and the factor of local damping of a checkpoint.
pub(super) fn values(checkpoint: &Checkpoint) -> Result<(Vector, Option<f64>), CheckpointError> {
    let gravity = checkpoint.array::<f64>(GRAVITY, 3)?;
    let factor = checkpoint.array::<f64>(LOCAL_DAMPING, 1)?[0];
    let gravity = std::array::from_fn(|axis| gravity[axis]);
    Ok((gravity, Some(factor).filter(|factor| *factor != 0.0)))
}
