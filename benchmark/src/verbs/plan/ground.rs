//! Ground in a plan: volumes by material, and how far it is from equilibrium at the start.

use crate::show::{Table, grouped};
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::Simulation;
use proctor_scene::{InitialStress, Scene, Shape};

/// Unbalanced forces over the weight below which the start is in equilibrium to round-off.
const BALANCED: f64 = 1e-6;

/// Volumes and masses by material, where a body is ground below a surface or a solid from a file.
pub(super) fn volumes(scene: &Scene, simulation: &Simulation) -> Option<Table> {
    let is_ground = |shape: &Shape| matches!(shape, Shape::Stratum(_) | Shape::Enclosed(_));
    if !scene.bodies.iter().any(|body| is_ground(&body.shape)) {
        return None;
    }
    let mut table = Table::new(["material", "particles", "volume", "mass"]);
    for (index, material) in scene.materials.iter().enumerate() {
        let sets = scene.bodies.iter().zip(simulation.sets());
        let own = sets.filter(|(body, _)| body.material == index);
        let (mut count, mut volume, mut mass) = (0, 0.0, 0.0);
        for (_, set) in own {
            count += set.len();
            volume += set.columns[Layout::VOLUME].iter().sum::<f64>();
            mass += set.columns[Layout::MASS].iter().sum::<f64>();
        }
        table.push([
            material.name.clone(),
            grouped(count as u64),
            format!("{volume:.6} m³"),
            format!("{mass:.6e} kg"),
        ]);
    }
    Some(table)
}

/// A line on how far ground at rest below a surface is from equilibrium at the start; `None` where there is none, or where its
/// forces cannot be measured.
pub(super) fn imbalance(scene: &Scene, simulation: &mut Simulation) -> Option<String> {
    let rests = |stress: &InitialStress| matches!(stress, InitialStress::Overburden(_));
    if !scene.bodies.iter().any(|body| rests(&body.initial_stress)) {
        return None;
    }
    let share = simulation.unbalanced_share()?;
    if share < BALANCED {
        return Some(
            "The ground starts in equilibrium: unbalanced forces at the nodes are less\n\
             than a millionth of the weight."
                .to_owned(),
        );
    }
    Some(format!(
        "The ground does not start in equilibrium: unbalanced forces at the nodes add\n\
         up to {:.2} % of the weight. Let it settle before anything else happens.",
        100.0 * share
    ))
}
