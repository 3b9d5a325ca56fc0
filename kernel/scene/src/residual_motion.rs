//! Residual motion: kinetic energy that is left in damped bodies at the end of a run.
//!
//! Damping is for runs that end at rest. While bodies still swing, stresses swing with them, by about the square root of kinetic
//! over strain energy in the mean, and by more in single rows of particles. The kinetic energy is that at the time of the
//! positions: forces that are out of balance there count, also where each step takes back what they do. Where something is still
//! moved as prescribed, or still changes, no state of rest is due. Nor is one where motion has more energy than strain: such a
//! run is of the motion itself, with damping beside it.

use crate::running::Simulation;
use proctor_kernel::model::{Damping, History, StressScheme, TransferKind};
use proctor_kernel::simulation::{Energy, ResultQuality, history_value};
use std::fmt;

/// Least kinetic over strain energy of a caution: the mean stress is then off by a hundredth.
const LEAST: f64 = 1e-4;
/// The same for FLIP with MUSL or USF: damping takes velocities of nodes, and rows of particles swing that nodes hardly see. Of columns
/// of ground (`proctor verify --generated 10000`, question `ground`, seeds 1 and 2) the 227 with a smaller share keep their rows within
/// 0.8 of the bound, 38 with a larger one have rows off by up to 1.5 of it.
const LEAST_OF_FLIP: f64 = 5e-5;
/// The same where bodies touch at nodes with MUSL or USF. What is left of the motion stays there. Of columns between driven walls
/// (question `walls`, seed 2) the 212 with a smaller share keep their rows within 0.8 of the bound, 105 with a larger one have rows off
/// by up to 2.3 of it.
const LEAST_AT_CONTACT: f64 = 1e-6;
/// Kinetic over strain energy from which motion is the subject of a run.
const MOST: f64 = 1.0;

/// Residual motion of bodies that should be at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResidualMotion {
    /// Kinetic over strain energy.
    pub share: f64,
    /// True where the stress is updated last.
    pub usl: bool,
    /// True where the transfer is FLIP.
    pub flip: bool,
}

impl fmt::Display for ResidualMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { share, usl, flip } = self;
        write!(
            f,
            "the bodies are damped but not at rest: kinetic energy is {share:.1e} of the strain energy, so that stress is off by about \
             {:.1} % in the mean and by more in single rows; ",
            100.0 * share.sqrt()
        )?;
        let usl = if *usl { "" } else { "USL, " };
        let apic = if *flip { "\"APIC\" " } else { "" };
        write!(
            f,
            "give it more time, {usl}{apic}or a quarter of the time step"
        )
    }
}

/// The motion that damping has left, where a state of rest is due and motion has a share of the strain energy that matters.
pub(crate) fn residual_motion(
    simulation: &Simulation,
    energy: &Energy,
    quality: &ResultQuality,
) -> Option<ResidualMotion> {
    if !rest_is_due(simulation, quality) {
        return None;
    }
    let share = energy.kinetic / energy.strain;
    let usl = simulation.model().settings.scheme == StressScheme::Usl;
    let flip = simulation.model().settings.transfer.kind == TransferKind::Flip;
    let least = if usl {
        LEAST
    } else if quality.interactions.moves_damping {
        LEAST_AT_CONTACT
    } else if flip {
        LEAST_OF_FLIP
    } else {
        LEAST
    };
    (least..MOST)
        .contains(&share)
        .then_some(ResidualMotion { share, usl, flip })
}

/// True where damping slows solid bodies and nothing acts on them that still moves or changes.
fn rest_is_due(simulation: &Simulation, quality: &ResultQuality) -> bool {
    let (model, now) = (simulation.model(), simulation.time());
    let settings = &model.settings;
    let damped = settings.damping.slows() || settings.damping == Damping::Kinetic;
    let bodies = &model.bodies;
    let solid = bodies.iter().all(|body| !body.law.is_fluid());
    let stands = |motion: &History| {
        motion.is_zero() || (!motion.changes_from(now) && history_value(motion, now) == [0.0; 3])
    };
    damped
        && solid
        && settings.base_motion.is_none()
        && quality.knows_all_work
        && !quality.interactions.moves
        && bodies
            .iter()
            .filter_map(|body| body.motion.as_ref())
            .all(stands)
        && !settings
            .tractions
            .iter()
            .any(|load| load.traction.changes_from(now))
        && !settings
            .standing_waters
            .iter()
            .any(|water| water.level.changes_from(now))
}
