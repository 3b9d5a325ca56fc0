//! The particles of bodies at the start: from shapes to sets with the state of the start.

use super::{Options, initial_stress, memory_budget, pressure, start_from};
use crate::values::Scene;
use proctor_geometry::bodies::{EVERYWHERE, FilledBody, HalfLength, MemoryRoom, fill_within};
use proctor_geometry::memory::Memory;
use proctor_kernel::grid::GridShape;
use proctor_kernel::layout::Layout;
use proctor_kernel::model::{Shape, Weighting};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::plan::Plan;
use proctor_kernel::simulation::{BodyRun, SetupError};
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::g2p::ParticleMaxima;
use std::iter::repeat_n;

/// The bodies of a scene, filled.
pub(super) struct FilledBodies {
    pub(super) sets: Vec<ParticleSet>,
    pub(super) bodies: Vec<BodyRun>,
    pub(super) found: Vec<ParticleMaxima>,
}

/// Fills all bodies in a range of the first coordinate, and gives them the state of the start.
pub(super) fn fill_bodies(
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
    let count = filled.volume.len();
    let mass: Vec<f64> = filled.volume.iter().map(|v| v * density).collect();
    let mut volume = filled.volume;
    if law.needs_deformation() || plan.domain_update.is_some() {
        // As the cycle will form it from F = 1, so that a body at rest keeps its bits.
        for (volume, m) in volume.iter_mut().zip(&mass) {
            *volume = m * (1.0 / density);
        }
    }
    // What was filled becomes the columns: a copy would be a quarter of all memory at the start.
    let mut columns = vec![mass, volume];
    columns.extend(filled.x.into_iter().take(axes));
    columns.extend((body.velocity[..axes].iter()).map(|v| repeat_n(*v, count).collect()));
    let mut set = ParticleSet::of_columns(layout, first_id, count, columns);
    for axis in 0..axes {
        if let Some(first) = layout.water {
            set.columns[first + axis].fill(body.velocity[axis]);
        }
        if let Some(first) = layout.displacement_origin {
            let (before, origin) = set.columns.split_at_mut(first);
            origin[axis].copy_from_slice(&before[Layout::POSITION + axis]);
        }
        if let Some(first) = layout.deformation {
            set.columns[first + axis * axes + axis].fill(1.0);
        }
    }
    for column in [layout.hoop_stretch(), layout.held_pressure]
        .into_iter()
        .flatten()
    {
        set.columns[column].fill(1.0);
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
