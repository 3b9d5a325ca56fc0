//! Set-up: from a scene to a simulation at time zero.

mod domain;
mod fill;
mod initial_stress;
mod memory_budget;
mod memory_estimate;
mod options;
mod pressure;
mod rank_part;
mod start_state;
mod traction_cover;

pub use memory_estimate::{MemoryEstimate, estimate_memory};
pub use options::{InitialField, InitialState, Options};
pub use start_state::{StartBody, StartState, missing_column};

use crate::plan::{PlanOptions, plan};
use crate::values::Scene;
use domain::start_domain;
use fill::{FilledBodies, fill_bodies};
use proctor_geometry::bodies::EVERYWHERE;
use proctor_geometry::memory::Memory;
use proctor_geometry::team::Team;
use proctor_kernel::grid::GridShape;
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::laws::Particle;
use proctor_kernel::layout::Layout;
use proctor_kernel::model::BoxLoad;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::conditions;
use proctor_kernel::simulation::{BaseVelocity, BodyRun, Cycle, Model, SetupError, Start};
use proctor_kernel::stage::g2p::ParticleMaxima;
use rank_part::RankPart;
use std::sync::Arc;

/// Fewest particles that are worth a thread where none are asked for: with fewer its share of a step takes no longer than
/// the threads wait for each other.
const PARTICLES_PER_THREAD: usize = 8192;

/// Fills the bodies of a scene that was checked with particles, and makes everything that the plan keeps.
///
/// # Errors
/// Input that shows its fault only here: see [`SetupError`].
pub(crate) fn set_up(scene: &Scene, options: &Options) -> Result<Cycle, SetupError> {
    let demands = PlanOptions {
        displacement: options.displacement,
        measure: options.measure,
        body_force: options.body_force.is_some(),
    };
    let plan = plan(scene, demands);
    let settings = scene.settings();
    let lanes = SelectedLanes::new(options.lanes).map_err(SetupError::Lanes)?;
    let shape = GridShape::new(&scene.mesh, scene.dimension);
    let mut memory = options.memory.unwrap_or_else(Memory::of_machine);
    let bases: u128 = shape.bases().iter().map(|&n| n as u128).product();
    if bases > u128::from(u32::MAX) {
        return Err(SetupError::TooLarge {
            what: format!("the mesh has {bases} cells; accepted: at most {}", u32::MAX),
        });
    }
    let part = RankPart::of(scene, options)?;
    let part = part.as_ref();
    let share = part.map_or(1.0, |part| part.share_of_nodes(shape.nodes[0]));
    memory_budget::grid(scene, (&shape, share), &mut memory)?;
    memory_budget::frames(scene, &mut memory)?;
    memory_budget::loads(scene, &shape, &mut memory)?;
    if part.is_none() {
        memory_budget::bodies(scene, &plan, memory)?;
    }
    let conditions = conditions(&settings, &shape, &options.conditions)?;
    let range = part.map_or(EVERYWHERE, |part| part.range);
    let filled = fill_bodies(scene, (&plan, &shape), options, range, &mut memory);
    let FilledBodies {
        mut sets,
        bodies,
        found: mut all_found,
    } = RankPart::agree(part, filled)?;
    if options.body_force.is_some() && !scene.box_loads.is_empty() {
        return Err(SetupError::Load {
            path: "box_load[0]".into(),
            reason:
                "a body force is given as a function, which takes its place; accepted: one of them"
                    .into(),
        });
    }
    for (i, load) in scene.box_loads.iter().enumerate() {
        spread(load, scene, &mut sets, part).map_err(|reason| SetupError::Load {
            path: format!("box_load[{i}]"),
            reason,
        })?;
    }
    for (i, held) in scene.held_pressures.iter().enumerate() {
        pressure::hold(held, scene, &mut sets, part).map_err(|reason| SetupError::Load {
            path: format!("held_pressures[{i}]"),
            reason,
        })?;
    }
    if let Some(start) = &options.start {
        start_state::take_all(&mut sets, &mut all_found, scene, start)?;
    }
    let particles = sets.iter().map(ParticleSet::len).sum();
    let team = memory_budget::layers(scene, &shape, &sets, &mut memory)
        .and_then(|()| team(scene, options, particles));
    let team = RankPart::agree(part, team)?;
    let interactions =
        proctor_contact::interactions(&scene.contact_values(), &settings, &bodies, &mut memory);
    let mut interactions = RankPart::agree(part, interactions)?;
    interactions.extend(options.interactions.iter().cloned());
    let model = Model {
        settings,
        plan,
        lanes,
        bodies,
        conditions,
        own_conditions: options.conditions.clone(),
        has_own: !(options.conditions.is_empty() && options.interactions.is_empty()),
        base: (scene.base_motion.as_ref()).map(|base| BaseVelocity::new(&base.motion)),
        incoming: (scene.ground_beyond.incoming.as_ref())
            .map(|wave| BaseVelocity::new(&wave.motion)),
        body_force: options.body_force.clone(),
    };
    let start = Start {
        sets,
        maxima: all_found,
        interactions,
        team,
        least_share: options.least_share,
        is_undeformed: options.initial.is_none() && options.start.is_none(),
        ranks: part.map(|part| Arc::clone(&part.ranks)),
    };
    let mut cycle = Cycle::new(model, start)?;
    traction_cover::require_carried(&cycle.view())?;
    if let Some(ranks) = &options.step_ranks {
        let shared = cycle.share_steps_among(Arc::clone(ranks));
        shared.map_err(SetupError::Ranks)?;
    }
    Ok(cycle)
}

/// The threads that were asked for, else as many of the machine as there is work for.
fn team(scene: &Scene, options: &Options, particles: usize) -> Result<Arc<Team>, SetupError> {
    if let Some(team) = &options.team {
        return Ok(Arc::clone(team));
    }
    let count = match options.threads.or(scene.threads) {
        Some(0) => {
            return Err(SetupError::Threads(
                "0 threads; accepted: at least 1".into(),
            ));
        }
        Some(count) if count > Team::most() => {
            return Err(SetupError::Threads(format!(
                "{count} threads; accepted: at most {}",
                Team::most()
            )));
        }
        Some(count) => count,
        None => std::thread::available_parallelism()
            .map_or(1, std::num::NonZero::get)
            .min(particles / PARTICLES_PER_THREAD)
            .max(1),
    };
    let team = Team::new(count).map_err(|e| SetupError::Threads(e.to_string()))?;
    Ok(Arc::new(team))
}

/// Sets velocity, stress and deformation from a function of position, and what the first time step depends on.
fn start_from(
    set: &mut ParticleSet,
    scene: &Scene,
    run: &BodyRun,
    found: &mut ParticleMaxima,
    initial: &(dyn Fn(&[f64; 3]) -> InitialState + Send + Sync),
) {
    let axes = set.layout.axes;
    for p in 0..set.len() {
        let local = set.position(p);
        let state = initial(&std::array::from_fn(|axis| {
            local[axis] + scene.mesh.origin[axis]
        }));
        for axis in 0..axes {
            set.columns[Layout::velocity(axes) + axis][p] = state.velocity[axis];
            // Water begins with the body that it is in.
            if let Some(first) = set.layout.water {
                set.columns[first + axis][p] = state.velocity[axis];
            }
        }
        if let Some(first) = set.layout.affine {
            for a in 0..axes {
                for b in 0..axes {
                    set.columns[first + a * axes + b][p] = state.velocity_gradient[a][b];
                }
            }
        }
        let square: f64 = state.velocity[..axes].iter().map(|v| v * v).sum();
        found.speed_squared = found.speed_squared.max(square);
        let s = state.stress;
        let components: &[f64] = if axes == 2 {
            &[s[0], s[1], s[2], s[5]]
        } else {
            &s
        };
        for (i, value) in components.iter().enumerate() {
            set.columns[Layout::stress(axes) + i][p] = *value;
        }
        let f = nalgebra::Matrix3::from_fn(|a, b| state.deformation[a][b]);
        if f != nalgebra::Matrix3::identity() {
            let volume = set.columns[Layout::MASS][p] * (1.0 / run.density) * f.determinant();
            set.columns[Layout::VOLUME][p] = volume;
            let square = run.law.speed_squared(&Particle {
                mass: set.columns[Layout::MASS][p],
                volume,
                density: run.density,
                stress: state.stress,
                deformation: state.deformation,
                variables: &set.variables(p),
            });
            found.wave_speed_squared = found.wave_speed_squared.max(square);
            let widest = start_domain(set, run.domain_update, &f, p);
            found.half_length = found.half_length.max(widest);
        }
        if let Some(first) = set.layout.deformation {
            for a in 0..axes {
                for b in 0..axes {
                    set.columns[first + a * axes + b][p] = state.deformation[a][b];
                }
            }
        }
        if let Some(hoop) = set.layout.hoop_stretch() {
            set.columns[hoop][p] = state.deformation[2][2];
        }
    }
}

/// Spreads a box load by volume over the particles in the box.
fn spread(
    load: &BoxLoad,
    scene: &Scene,
    sets: &mut [ParticleSet],
    part: Option<&RankPart>,
) -> Result<(), String> {
    let corners = [&load.p1, &load.p2];
    let inside = |set: &ParticleSet, p: usize| pressure::lies_in(set, p, scene, corners);
    let mut volume = 0.0;
    for set in &*sets {
        let add = |volume: f64| {
            let inside = (0..set.len()).filter(|&p| inside(set, p));
            inside.fold(volume, |sum, p| sum + set.columns[Layout::VOLUME][p])
        };
        volume = match part {
            None => add(volume),
            Some(part) => part.in_turn(volume, add),
        };
    }
    if volume <= 0.0 {
        return Err(pressure::no_particle(corners));
    }
    for set in sets {
        let Some(first) = set.layout.force else {
            continue;
        };
        for p in 0..set.len() {
            if inside(set, p) {
                let share = set.columns[Layout::VOLUME][p] / volume;
                for axis in 0..set.layout.axes {
                    set.columns[first + axis][p] += load.force[axis] * share;
                }
            }
        }
    }
    Ok(())
}
