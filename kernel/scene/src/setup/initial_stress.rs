//! The stress that bodies have at the start.

use crate::values::{InitialPressure, InitialStress, Scene};
use proctor_geometry::number::Number;
use proctor_kernel::laws::{AnyLaw, Particle, UNDEFORMED, UNPRESSED};
use proctor_kernel::layout::Layout;
use proctor_kernel::model::Vector;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::{BodyRun, SetupError};
use proctor_kernel::stage::g2p::ParticleMaxima;
use proctor_laws::{PRECONSOLIDATION, Point};

/// Sets the stress of a body, by its index, at the start, what its law remembers of it, and what the first time step depends on.
///
/// # Errors
/// If the law of the body does not bear the stress, with the particle that is farthest from the yield surface.
pub(super) fn set(
    set: &mut ParticleSet,
    scene: &Scene,
    index: usize,
    run: &BodyRun,
    found: &mut ParticleMaxima,
) -> Result<(), SetupError> {
    let body = &scene.bodies[index];
    if body.initial_stress == InitialStress::None {
        return Ok(());
    }
    let material = &scene.materials[body.material];
    let axes = set.layout.axes;
    // Where each particle of a fluid remembers its volume without pressure.
    let unpressed = (set.layout.components())
        .find(|(variable, ..)| **variable == UNPRESSED)
        .map(|(_, _, column)| column);
    let remembers = remembers_pressure(&material.law);
    let mut point = Point::new(&material.law, material.density, [0.0; 6]);
    let mut worst: Option<YieldExcess> = None;
    for p in 0..set.len() {
        let local = set.position(p);
        let x: Vector = std::array::from_fn(|axis| local[axis] + scene.mesh.origin[axis]);
        let stress = stress_at(scene, index, &x, axes);
        let beyond = beyond(&mut point, &stress);
        if beyond > worst.as_ref().map_or(0.0, |worst| worst.by) {
            worst = Some(YieldExcess {
                by: beyond,
                x,
                stress,
            });
        }
        for (i, value) in stress[..set.layout.stress_components()].iter().enumerate() {
            set.columns[Layout::stress(axes) + i][p] = *value;
        }
        let mean = (stress[0] + stress[1] + stress[2]) / 3.0;
        let ratio = material.law.initial_volume_ratio(mean);
        if let Some(column) = unpressed {
            set.columns[column][p] = 1.0 / ratio;
            let square = run.law.speed_squared(&Particle {
                mass: set.columns[Layout::MASS][p],
                volume: set.columns[Layout::VOLUME][p],
                density: run.density,
                stress,
                deformation: UNDEFORMED,
                variables: &set.variables(p),
            });
            found.wave_speed_squared = found.wave_speed_squared.max(square);
        } else if remembers {
            let first = set.layout.variables;
            for (i, value) in point.variables().into_iter().enumerate() {
                set.columns[first + i][p] = value;
            }
            let square = run.law.speed_squared(&Particle {
                mass: set.columns[Layout::MASS][p],
                volume: set.columns[Layout::VOLUME][p],
                density: run.density,
                stress,
                deformation: UNDEFORMED,
                variables: &set.variables(p),
            });
            found.wave_speed_squared = found.wave_speed_squared.max(square);
        } else {
            compress(set, p, ratio);
        }
    }
    let Some(YieldExcess { by, x, stress }) = worst else {
        return Ok(());
    };
    let number = |x: f64| Number(x).to_string();
    Err(SetupError::Load {
        path: format!("bodies[{index}].initial_stress"),
        reason: format!(
            "at ({}) m the stress of {} Pa lies {} Pa beyond the yield surface of {}; accepted: a stress that the material \
             bears",
            x[..axes]
                .iter()
                .copied()
                .map(number)
                .collect::<Vec<_>>()
                .join(", "),
            stress[..3]
                .iter()
                .copied()
                .map(number)
                .collect::<Vec<_>>()
                .join(", "),
            number(by),
            material.name
        ),
    })
}

/// The stress that a body, by its index, begins with at a point \[Pa\]. Soil at rest with water in its pores has the weight of
/// both above it, and that of the water which stands on its surface, less the pressure of the pores: that of its water table.
fn stress_at(scene: &Scene, index: usize, x: &Vector, axes: usize) -> [f64; 6] {
    let body = &scene.bodies[index];
    let grains = scene.materials[body.material].density;
    let stress = (body.initial_stress).at(x, &scene.gravity, grains, axes);
    let Some(water) = scene.water_of(body.material) else {
        return stress;
    };
    let Some(axis) = (0..axes).find(|axis| scene.gravity[*axis] != 0.0) else {
        return stress;
    };
    let (ratio, surcharge, level) = match &body.initial_stress {
        InitialStress::None | InitialStress::Isotropic(_) => return stress,
        InitialStress::AtRest {
            ratio,
            level,
            surcharge,
        } => (*ratio, *surcharge, Some(*level)),
        InitialStress::Overburden(ground) => {
            let at = if axes == 2 { [x[0], 0.5] } else { [x[0], x[1]] };
            (ground.ratio, ground.surcharge, ground.surface.height(at))
        }
    };
    // Above the surface there is no stress.
    let Some(level) = level.filter(|level| (x[axis] - level) * scene.gravity[axis] >= 0.0) else {
        return stress;
    };
    let saturated = water.dry_density() + water.porosity * water.density;
    let weight = (-stress[axis] - surcharge) * saturated / grains;
    let table = scene
        .initial_pressures
        .iter()
        .rev()
        .find_map(|given| match given {
            InitialPressure::Table { level } => Some(*level),
            _ => None,
        });
    let pressure = |at: f64| {
        table.map_or(0.0, |table| {
            (water.density * scene.gravity[axis] * (at - table)).max(0.0)
        })
    };
    let along = -surcharge - weight + (pressure(x[axis]) - pressure(level));
    let mut stress = [ratio * along, ratio * along, ratio * along, 0.0, 0.0, 0.0];
    stress[axis] = along;
    stress
}

/// Refuses a body, by its index, that begins without a stress although its law has no stiffness there.
///
/// # Errors
/// As said.
pub(super) fn refuse_none(scene: &Scene, index: usize) -> Result<(), SetupError> {
    let body = &scene.bodies[index];
    let material = &scene.materials[body.material];
    if body.initial_stress != InitialStress::None || !remembers_pressure(&material.law) {
        return Ok(());
    }
    Err(SetupError::Load {
        path: format!("bodies[{index}].initial_stress"),
        reason: format!(
            "none, where {} has neither stiffness nor strength without a pressure; accepted: `initial_stress`, or an \
             `initial_state` of another run",
            material.name
        ),
    })
}

/// True for a law that remembers the largest pressure that it has borne.
fn remembers_pressure(law: &AnyLaw) -> bool {
    law.variables().contains(&PRECONSOLIDATION)
}

/// Gives a particle whose law does not remember a volume without pressure the mass of what was pressed into its own: `ratio`
/// is that volume over the one without stress.
fn compress(set: &mut ParticleSet, p: usize, ratio: f64) {
    if ratio == 1.0 {
        return;
    }
    set.columns[Layout::MASS][p] /= ratio;
    let axes = set.layout.axes;
    let directions = if set.layout.axisymmetric { 3 } else { axes };
    let stretch = libm::pow(ratio, 1.0 / directions as f64);
    if let Some(hoop) = set.layout.hoop_stretch() {
        set.columns[hoop][p] = stretch;
    }
    for axis in 0..axes {
        if let Some(first) = set.layout.deformation {
            set.columns[first + axis * axes + axis][p] = stretch;
        }
        if let Some(first) = set.layout.initial_half_length {
            set.columns[first + axis][p] /= stretch;
        }
    }
}

/// A particle whose stress its law does not bear.
struct YieldExcess {
    by: f64,
    x: Vector,
    stress: [f64; 6],
}

/// Change that the law of a point makes to a stress without strain \[Pa\]: 0 where it bears the stress.
fn beyond(point: &mut Point, stress: &[f64; 6]) -> f64 {
    // Round-off of the return to a yield surface that a stress lies on.
    const NEARLY: f64 = 1e-9;
    point.begin(*stress);
    let Ok(()) = point.step(&[[0.0; 3]; 3], 1.0) else {
        return f64::INFINITY;
    };
    let way = |(a, b): (&f64, &f64)| (a - b).abs();
    let after = point.stress();
    let moved = after.iter().zip(stress).map(way).fold(0.0, f64::max);
    let size = stress.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
    if moved <= NEARLY * size { 0.0 } else { moved }
}
