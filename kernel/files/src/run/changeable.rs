//! Values of a scene that a restart may change and a checkpoint keeps: gravity, local damping, planes and box loads.

use crate::output::{Checkpoint, CheckpointError};
use proctor_scene::{BoxLoad, Damping, Mesh, PlaneCondition, Scene, Vector};

/// Sections of gravity \[m/s²\], of the factor of local damping, of the conditions of planes by their place among all, and of box
/// loads: two corners \[m\] and a force \[N\] each.
const GRAVITY: &str = "restart/gravity";
const LOCAL_DAMPING: &str = "restart/local-damping";
const PLANES: &str = "restart/planes";
const BOX_LOADS: &str = "restart/box-loads";

/// Numbers of a box load.
const OF_LOAD: usize = 9;

/// All conditions of planes; their places are in checkpoints.
const CONDITIONS: [PlaneCondition; 5] = [
    PlaneCondition::Free,
    PlaneCondition::Sliding,
    PlaneCondition::Fixed,
    PlaneCondition::Antisymmetric,
    PlaneCondition::Absorbing,
];

/// The parts of a scene that a restart may change.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Changeable {
    /// Acceleration of gravity \[m/s²\].
    pub gravity: Vector,
    /// Factor of local damping, where it acts.
    pub local_damping: Option<f64>,
    /// Conditions of the boundary planes.
    pub planes: [[PlaneCondition; 2]; 3],
    /// Forces on the particles in boxes.
    pub box_loads: Vec<BoxLoad>,
}

impl Changeable {
    /// Those of a scene.
    pub(super) fn of(scene: &Scene) -> Self {
        Self {
            gravity: scene.gravity,
            local_damping: match scene.damping {
                Damping::Local { alpha } if alpha != 0.0 => Some(alpha),
                _ => None,
            },
            planes: scene.mesh.planes,
            box_loads: scene.box_loads.clone(),
        }
    }

    /// Keeps them in a checkpoint.
    pub(super) fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.push::<f64>(GRAVITY, self.gravity.to_vec());
        let factor = self.local_damping.unwrap_or(0.0);
        checkpoint.push::<f64>(LOCAL_DAMPING, vec![factor]);
        let place = |plane: &PlaneCondition| CONDITIONS.iter().position(|one| one == plane);
        let places = self.planes.as_flattened().iter().filter_map(place);
        checkpoint.push::<u64>(PLANES, places.map(|place| place as u64).collect());
        let numbers = |load: &BoxLoad| [load.p1, load.p2, load.force].concat();
        let loads = self.box_loads.iter().flat_map(numbers);
        checkpoint.push::<f64>(BOX_LOADS, loads.collect());
    }

    /// Those of a checkpoint.
    pub(super) fn read(checkpoint: &Checkpoint) -> Result<Self, CheckpointError> {
        let gravity = checkpoint.array::<f64>(GRAVITY, 3)?;
        let factor = checkpoint.array::<f64>(LOCAL_DAMPING, 1)?[0];
        let places = checkpoint.array::<u64>(PLANES, 6)?;
        let plane = |place: u64| CONDITIONS.get(place as usize).copied();
        let loads = checkpoint.values::<f64>(BOX_LOADS)?;
        let (loads, _) = loads.as_chunks::<OF_LOAD>();
        let vector = |numbers: &[f64]| std::array::from_fn(|axis| numbers[axis]);
        Ok(Self {
            gravity: vector(gravity),
            local_damping: Some(factor).filter(|factor| *factor != 0.0),
            planes: std::array::from_fn(|axis| {
                std::array::from_fn(|side| {
                    plane(places[2 * axis + side]).unwrap_or(PlaneCondition::Sliding)
                })
            }),
            box_loads: (loads.iter())
                .map(|load| BoxLoad {
                    p1: vector(&load[..3]),
                    p2: vector(&load[3..6]),
                    force: vector(&load[6..]),
                })
                .collect(),
        })
    }
}

/// The scene without what a restart may change and a checkpoint keeps.
pub(super) fn without(scene: &Scene) -> Scene {
    Scene {
        gravity: [0.0; 3],
        damping: match scene.damping {
            Damping::Local { .. } => Damping::None,
            other => other,
        },
        mesh: Mesh {
            planes: [[PlaneCondition::Sliding; 2]; 3],
            ..scene.mesh.clone()
        },
        box_loads: vec![],
        ..scene.clone()
    }
}
