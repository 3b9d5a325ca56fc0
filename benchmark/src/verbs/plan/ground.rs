//! Ground in a plan: volumes by material, and how far it is from equilibrium at the start.

use crate::show::{Table, grouped};
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{
    Damping, InitialStress, Scene, Shape, TimeStep, Transfer, TransferKind, Vector,
};

/// Time step over that of the scene in which forces do not change and velocities are accelerations.
const INSTANT: f64 = 1e-9;
/// Acceleration over gravity below which the start is in equilibrium to round-off.
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

/// A line on how far ground at rest below a surface is from equilibrium at the start; `None` where there is none.
///
/// # Errors
/// A simulation that cannot be set up, or a first step that fails.
pub(super) fn imbalance(scene: &Scene) -> Result<Option<String>, String> {
    let rests = |stress: &InitialStress| matches!(stress, InitialStress::Overburden(_));
    if !scene.bodies.iter().any(|body| rests(&body.initial_stress)) {
        return Ok(None);
    }
    let axes = scene.dimension.axes();
    let mut still = scene.clone();
    still.damping = Damping::None;
    still.base_motion = None;
    still.transfer = Transfer::new(TransferKind::Flip);
    for body in &mut still.bodies {
        body.velocity = [0.0; 3];
    }
    let dt = INSTANT * scene.time;
    still.time_step = TimeStep::Fixed {
        dt,
        allow_unstable: true,
    };
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&still, &options).map_err(|e| e.to_string())?;
    simulation.step(dt).map_err(|e| e.to_string())?;
    let gravity = scene.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let (mut most, mut place) = (0.0, [0.0; 3]);
    let (mut squares, mut mass) = (0.0, 0.0);
    for set in simulation.sets() {
        for p in 0..set.len() {
            let velocity = (0..axes).map(|axis| set.columns[Layout::velocity(axes) + axis][p]);
            let square = velocity.map(|v| (v / dt).powi(2)).sum::<f64>();
            squares += set.columns[Layout::MASS][p] * square;
            mass += set.columns[Layout::MASS][p];
            if square > most {
                let local = set.position(p);
                let at: Vector = std::array::from_fn(|axis| local[axis] + scene.mesh.origin[axis]);
                (most, place) = (square, at);
            }
        }
    }
    let [most, mean] = [most, squares / mass].map(|square: f64| square.sqrt() / gravity);
    if most < BALANCED {
        return Ok(Some(
            "The ground starts in equilibrium: no particle is accelerated by more than a millionth of gravity.".to_owned(),
        ));
    }
    let place: Vec<String> = place[..axes].iter().map(|x| format!("{x:.3}")).collect();
    Ok(Some(format!(
        "The ground does not start in equilibrium: particles are accelerated by {most:.3} times gravity at most, at ({}) m, and by \
         {mean:.3} in the mean (root of the mean square by mass). Let it settle before anything else happens.",
        place.join(", ")
    )))
}
