//! Changes of a restart: gravity, local damping, planes and box loads may be others than before, and the run goes on with its
//! displacements and its balance of energy.

use super::changeable::Changeable;
use super::shared_state::SharedState;
use super::{RunError, state};
use crate::output::{Checkpoint, CheckpointError};
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{BoxLoad, Damping, PlaneCondition, Problem, Scene};
use std::path::Path;

/// Keys of the planes, by axis and side.
const PLANES: [[&str; 2]; 3] = [
    ["plane_X0", "plane_Xn"],
    ["plane_Y0", "plane_Yn"],
    ["plane_Z0", "plane_Zn"],
];

/// A simulation that goes on from a checkpoint, and in words what it changes.
///
/// # Errors
/// A checkpoint that cannot be read, or that is one of another scene; a change that needs a stage of its own.
pub(super) fn restarted(
    scene: &Scene,
    options: &Options,
    path: &Path,
) -> Result<(Simulation, Vec<String>), RunError> {
    let ranks = options.ranks.as_deref().filter(|ranks| ranks.count() > 1);
    let file = ranks.map(|ranks| SharedState::open(path, ranks));
    let file = file.transpose()?;
    let mut checkpoint = match &file {
        None => Checkpoint::read(path)?,
        Some(file) => file.short_sections()?,
    };
    checkpoint.check_fingerprint(state::fingerprint(scene))?;
    let (was, now) = (Changeable::read(&checkpoint)?, Changeable::of(scene));
    if let Some(problem) = refused_planes(scene, &was, &now) {
        return Err(RunError::Refused(Box::new(problem)));
    }
    // Particles bear the new loads from the start: forces are spread over bodies as they are filled.
    let mut before = scene.clone();
    before.gravity = was.gravity;
    before.mesh.planes = was.planes;
    if was.local_damping != now.local_damping {
        before.damping = was
            .local_damping
            .map_or(Damping::None, |alpha| Damping::Local { alpha });
    }
    let new_loads = was.box_loads != now.box_loads;
    // Loads find their particles by identifiers, wherever those are by now.
    let ranks = options.ranks.clone().filter(|_| !new_loads);
    let options = Options {
        ranks,
        ..options.clone()
    };
    let mut simulation = Simulation::new(&before, &options)?;
    if let Some(file) = file {
        if simulation.ranks().is_some() {
            file.read_part(&mut simulation, &mut checkpoint)?;
        } else {
            checkpoint = Checkpoint::read(path)?;
        }
    }
    if new_loads && let Some(problem) = refused_loads(&simulation, &checkpoint)? {
        return Err(RunError::Refused(Box::new(problem)));
    }
    state::restore(&mut simulation, &checkpoint, new_loads)?;
    let axes = scene.dimension.axes();
    let mut changes = vec![];
    if was.gravity != now.gravity {
        simulation.set_gravity(now.gravity)?;
        let [old, new] = [was.gravity, now.gravity].map(|g| format!("{:?}", &g[..axes]));
        changes.push(format!("gravity {new} m/s², {old} m/s² until then"));
    }
    if was.local_damping != now.local_damping {
        simulation.set_local_damping(now.local_damping)?;
        let [old, new] = [was.local_damping, now.local_damping].map(|factor| factor.unwrap_or(0.0));
        changes.push(format!("local damping {new}, {old} until then"));
    }
    if was.planes != now.planes {
        simulation.set_planes(now.planes)?;
        for (axis, side) in changed_planes(&was, &now) {
            let [old, new] = [&was, &now].map(|one| one.planes[axis][side].word());
            let plane = PLANES[axis][side];
            changes.push(format!("{plane} {new}, {old} until then"));
        }
    }
    if new_loads {
        let [old, new] = [&was, &now].map(|one| sum_in_words(&one.box_loads, axes));
        changes.push(format!("{new}, {old} until then"));
    }
    Ok((simulation, changes))
}

/// Planes whose condition changes, by axis and side.
fn changed_planes(was: &Changeable, now: &Changeable) -> Vec<(usize, usize)> {
    let all = (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]);
    let changed = |at: &(usize, usize)| was.planes[at.0][at.1] != now.planes[at.0][at.1];
    all.filter(changed).collect()
}

/// The reason why planes cannot change here, if there is one.
fn refused_planes(scene: &Scene, was: &Changeable, now: &Changeable) -> Option<Problem> {
    let changed = changed_planes(was, now);
    let &(axis, side) = changed.first()?;
    let path =
        |(axis, side): (usize, usize)| format!("mesh.boundary_conditions.{}", PLANES[axis][side]);
    let found = |(axis, side): (usize, usize)| {
        let [old, new] = [was, now].map(|one| one.planes[axis][side].word());
        format!("\"{new}\" after \"{old}\"")
    };
    if !scene.mortar.boundaries.is_empty() {
        return Some(Problem::new(
            path((axis, side)),
            format!(
                "{}, beside mortar contact, whose boundaries are cut by the planes of the start",
                found((axis, side))
            ),
            "the same planes; others in a scene without mortar contact",
        ));
    }
    let bears = |plane: &PlaneCondition| plane.bears_at_start();
    let all = [was, now].map(|one| one.planes.as_flattened().iter().any(bears));
    if !all[0] && !all[1] {
        return None;
    }
    let own = |at: &&(usize, usize)| {
        let planes = [was, now].map(|one| one.planes[at.0][at.1]);
        planes.iter().any(bears)
    };
    let at = changed.iter().find(own).copied().unwrap_or((axis, side));
    Some(Problem::new(
        path(at),
        format!("{} in a restart", found(at)),
        "free, sliding and fixed planes alone; what \"absorbing\" and \"antisymmetric\" planes bear is found at the start of a stage \
         (`stages`) or of a scene that begins from the checkpoint (`initial_state`)",
    ))
}

/// The reason why box loads cannot change here, if there is one. Forces find their particles by their numbers, which are new where a
/// scene begins from another run.
fn refused_loads(
    simulation: &Simulation,
    checkpoint: &Checkpoint,
) -> Result<Option<Problem>, CheckpointError> {
    if simulation.scene().initial_state.is_none() {
        return Ok(None);
    }
    for (body, set) in simulation.sets().iter().enumerate() {
        let count = checkpoint.values::<u64>(&format!("set{body}/id"))?.len();
        if count != set.len() {
            return Ok(Some(Problem::new(
                "box_load",
                format!(
                    "other loads in a restart, where a body has {count} particles of the {} with which it was filled",
                    set.len()
                ),
                "the same loads, or bodies that have all their particles",
            )));
        }
    }
    Ok(None)
}

/// The sum of loads in words.
fn sum_in_words(loads: &[BoxLoad], axes: usize) -> String {
    if loads.is_empty() {
        return "no box load".to_owned();
    }
    let mut sum = [0.0; 3];
    for load in loads {
        for axis in 0..3 {
            sum[axis] += load.force[axis];
        }
    }
    format!("box loads of {:?} N in all", &sum[..axes])
}
