//! Set-up: from a scene to a simulation at time zero.

mod domain;
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
use proctor_geometry::bodies::{EVERYWHERE, FilledBody, HalfLength, MemoryRoom, fill_within};
use proctor_geometry::memory::Memory;
use proctor_geometry::team::Team;
use proctor_kernel::grid::GridShape;
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::laws::Particle;
use proctor_kernel::layout::Layout;
use proctor_kernel::model::{BoxLoad, Shape, Weighting};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::plan::Plan;
use proctor_kernel::simulation::conditions;
use proctor_kernel::simulation::{BaseVelocity, BodyRun, Cycle, Model, SetupError, Start};
use proctor_kernel::stage::Mapping;
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

/// The bodies of a scene, filled.
struct FilledBodies {
    sets: Vec<ParticleSet>,
    bodies: Vec<BodyRun>,
    found: Vec<ParticleMaxima>,
}

/// Fills all bodies in a range of the first coordinate, and gives them the state of the start.
fn fill_bodies(
    scene: &Scene,
    (plan, shape): (&Plan, &GridShape),
    options: &Options,
    range: [f64; 2],
    memory: &mut Memory,
) -> Result<FilledBodies, SetupError> {
    let (mut sets, mut bodies, mut all_found) = (vec![], vec![], vec![]);
    let mut first_id = 0;
    for i in 0..scene.bodies.len() {
        let filled = fill_body(scene, plan, i, range, memory)?;
        let (before, all) = (before(&filled, range), filled.whole_count());
        let start = first_id + before;
        let (mut set, run, mut found) = particles_of_body(scene, (plan, shape), i, start, filled)?;
        first_id += all;
        if set.len() > u32::MAX as usize || (range == EVERYWHERE && first_id > u32::MAX.into()) {
            return Err(SetupError::TooLarge {
                what: format!("more than {} particles", u32::MAX),
            });
        }
        initial_stress::set(&mut set, scene, i, &run, &mut found)?;
        pressure::set(&mut set, scene, i);
        if options.start.is_none() {
            initial_stress::refuse_none(scene, i)?;
        }
        if let Some(initial) = &options.initial {
            start_from(&mut set, scene, &run, &mut found, initial.as_ref());
        }
        sets.push(set);
        bodies.push(run);
        all_found.push(found);
    }
    Ok(FilledBodies {
        sets,
        bodies,
        found: all_found,
    })
}

/// Particles of the whole body before those in a range.
fn before(filled: &FilledBody, range: [f64; 2]) -> u64 {
    let slices = filled.slices.iter();
    let before = slices.take_while(|slice| slice.x < range[0]);
    before.map(|slice| slice.count).sum()
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

/// The shape of a body filled in a range of the first coordinate; takes the memory of its particles.
fn fill_body(
    scene: &Scene,
    plan: &Plan,
    index: usize,
    range: [f64; 2],
    memory: &mut Memory,
) -> Result<FilledBody, SetupError> {
    let body = &scene.bodies[index];
    let room = MemoryRoom {
        memory: *memory,
        per_particle: memory_budget::per_particle(scene, &plan.layouts[index]),
    };
    let refused = memory_budget::of_body(body);
    let mesh = (&scene.mesh, scene.dimension);
    let filled = fill_within(&body.shape, body.particles_per_cell, mesh, range, &room);
    let filled = filled.map_err(&refused)?;
    memory_budget::particles(filled.count(), &room, memory).map_err(refused)?;
    Ok(revolved(filled, scene, &body.shape))
}

/// Particles of one body, with identifiers from a first one on, and what the cycle knows of it.
fn particles_of_body(
    scene: &Scene,
    (plan, shape): (&Plan, &GridShape),
    index: usize,
    first_id: u64,
    filled: FilledBody,
) -> Result<(ParticleSet, BodyRun, ParticleMaxima), SetupError> {
    let body = &scene.bodies[index];
    let material = &scene.materials[body.material];
    let law = scene.law_of(body);
    let law = law.in_cells(scene.size_of_cell()).unwrap_or(law);
    let layout = plan.layouts[index];
    let axes = plan.axes;
    let water = scene.water_of(body.material);
    let density = water.map_or(material.density, |water| water.dry_density());
    let mut set = ParticleSet::zeros(layout, first_id, filled.volume.len());
    set.columns[Layout::MASS] = filled.volume.iter().map(|v| v * density).collect();
    set.columns[Layout::VOLUME] = if law.needs_deformation() || plan.domain_update.is_some() {
        // As the cycle will form it from F = 1, so that a body at rest keeps its bits.
        set.columns[Layout::MASS]
            .iter()
            .map(|m| m * (1.0 / density))
            .collect()
    } else {
        filled.volume
    };
    for axis in 0..axes {
        set.columns[Layout::POSITION + axis].copy_from_slice(&filled.x[axis]);
        set.columns[Layout::velocity(axes) + axis].fill(body.velocity[axis]);
        if let Some(first) = layout.water {
            set.columns[first + axis].fill(body.velocity[axis]);
        }
        if let Some(first) = layout.displacement_origin {
            set.columns[first + axis].copy_from_slice(&filled.x[axis]);
        }
        if let Some(first) = layout.deformation {
            set.columns[first + axis * axes + axis].fill(1.0);
        }
    }
    if let Some(hoop) = layout.hoop_stretch() {
        set.columns[hoop].fill(1.0);
    }
    let half_length = half_lengths(scene, &filled.half_length);
    let widest = fill_half_lengths(&mut set, scene, &filled.half_length, &half_length);
    if widest > 1.0 {
        return Err(SetupError::Body {
            body: body.name.clone(),
            reason: format!(
                "a particle domain has a half-length of {widest} cells; accepted: at most 1 (smaller particles or \
                 larger cells)"
            ),
        });
    }
    let mapping = Mapping::new(shape, plan.family, half_length, layout.half_length)
        .with_least_squares(scene.transfer.kind.kind().least_squares)
        .with_radius(
            if scene.mesh.axisymmetric {
                scene.mesh.origin[0]
            } else {
                0.0
            },
            scene.mesh.axisymmetric && weighs_by_radius(scene.weighting),
        );
    let speed = body.velocity.iter().map(|v| v * v).sum::<f64>();
    let h = scene.mesh.cell[..axes]
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    let wave_speed_squared = law.wave_speed(density).powi(2);
    let young = law.young();
    let run = BodyRun {
        name: body.name.clone(),
        id: body.id,
        shape: body.shape.clone(),
        material_id: material.id,
        law,
        density,
        mapping,
        domain_update: plan.domain_update,
        motion: body.motion.clone(),
        keeps_shape: body.motion.is_some(),
        viscous_rate: plan
            .viscous_damping
            .map_or(0.0, |alpha| alpha / h * (young / density).sqrt()),
        particle_half_length: match &filled.half_length {
            HalfLength::Uniform(l) => *l,
            HalfLength::PerParticle(l) => {
                std::array::from_fn(|axis| l[axis].iter().sum::<f64>() / l[axis].len() as f64)
            }
        },
        reach: match filled.half_length {
            HalfLength::Uniform(l) if plan.domain_update.is_none() => Some(l),
            _ => None,
        },
        step_share: scene.step_share(body),
        water,
    };
    let found = ParticleMaxima {
        speed_squared: speed.max(run.fastest()),
        wave_speed_squared,
        increment_squared: 0.0,
        travel: 0.0,
        half_length: widest,
        fault: None,
    };
    Ok((set, run, found))
}

/// The particles of a body as rings about the axis, where the scene is axisymmetric: each has the volume of its rectangle, whose
/// centre is at its radius. Particles that are given one by one have volumes of rings, and squares for domains.
fn revolved(filled: FilledBody, scene: &Scene, shape: &Shape) -> FilledBody {
    if !scene.mesh.axisymmetric {
        return filled;
    }
    let around = |x: &f64| std::f64::consts::TAU * (x + scene.mesh.origin[0]);
    let radii = filled.x[0].iter().enumerate();
    if matches!(shape, Shape::Particles(_)) {
        let sides = radii.map(|(p, x)| 0.5 * (filled.volume[p] / around(x)).sqrt());
        let sides: Vec<f64> = sides.collect();
        let depth = vec![0.5; sides.len()];
        return FilledBody {
            half_length: HalfLength::PerParticle([sides.clone(), sides, depth]),
            ..filled
        };
    }
    let volume = radii.map(|(p, x)| {
        let [l, m, _] = filled.half_length.of(p);
        around(x) * (4.0 * l * m)
    });
    let volume: Vec<f64> = volume.collect();
    FilledBody {
        exact_volume: volume.iter().sum(),
        volume,
        ..filled
    }
}

/// True if derivatives along the radius are integrals over particle domains. B-splines are weights of a point, as hats are.
fn weighs_by_radius(weighting: Weighting) -> bool {
    matches!(
        weighting,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_)
    )
}

/// Half-lengths in cells where they are the same for all particles of the body.
fn half_lengths(scene: &Scene, filled: &HalfLength) -> [f64; 3] {
    if let Some(half_length) = scene.weighting.kind().half_length {
        return [half_length; 3];
    }
    match filled {
        HalfLength::Uniform(l) => std::array::from_fn(|axis| l[axis] / scene.mesh.cell[axis]),
        HalfLength::PerParticle(l) => std::array::from_fn(|axis| {
            l[axis].iter().copied().fold(f64::INFINITY, f64::min) / scene.mesh.cell[axis]
        }),
    }
}

/// Writes half-lengths per particle where the plan keeps them; returns the largest in cells.
fn fill_half_lengths(
    set: &mut ParticleSet,
    scene: &Scene,
    filled: &HalfLength,
    uniform: &[f64; 3],
) -> f64 {
    let axes = set.layout.axes;
    let Some(first) = set.layout.half_length else {
        return uniform[..axes].iter().copied().fold(0.0, f64::max);
    };
    let mut widest = 0.0_f64;
    for axis in 0..axes {
        let column: Vec<f64> = match filled {
            HalfLength::Uniform(_) => vec![uniform[axis]; set.len()],
            HalfLength::PerParticle(l) => {
                l[axis].iter().map(|l| l / scene.mesh.cell[axis]).collect()
            }
        };
        widest = column.iter().copied().fold(widest, f64::max);
        if let Some(initial) = set.layout.initial_half_length {
            set.columns[initial + axis].copy_from_slice(&column);
        }
        set.columns[first + axis] = column;
    }
    widest
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
    let inside = |set: &ParticleSet, p: usize| {
        let x = set.position(p);
        (0..set.layout.axes).all(|axis| {
            let x = x[axis] + scene.mesh.origin[axis];
            load.p1[axis] <= x && x <= load.p2[axis]
        })
    };
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
        return Err(format!(
            "no particle lies in the box {:?} to {:?} m",
            load.p1, load.p2
        ));
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
