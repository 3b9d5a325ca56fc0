//! Soil with water in its pores.

use super::{Block, COURANT, H, Made, POISSON, STEPS, YOUNG};
use proctor_scene::{Permeability, PoreWater};
use serde_json::{Value, json};

/// Weight of the soil and the water over the modulus of the skeleton: a small strain.
const STRAIN: f64 = 1e-3;
const WATER: PoreWater = PoreWater {
    porosity: 0.4,
    grain_density: 2650.0,
    density: 1000.0,
    bulk: 2e7,
    conductivity: [1e-3; 3],
    permeability: Permeability::Constant,
    conductivity_gravity: 9.81,
};

/// A layer between sliding planes that settles under its weight; its water drains at the top.
pub(super) fn consolidation(block: &Block) -> Made {
    let up = block.axes - 1;
    let mut above = [0; 3];
    above[up] = 2;
    let mut scene = block.scene(&[0; 3], &above, 1, &vec![0.0; block.axes]);
    let confined = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    let height = block.cells[up] as f64 * H;
    let dry = WATER.dry_density();
    let wet = dry + WATER.porosity * WATER.density;
    let mut gravity = vec![0.0; block.axes];
    gravity[up] = -STRAIN * confined / (wet * height);
    scene["gravity"] = gravity.into();
    let dt = COURANT * H / WATER.fast_speed(confined / dry, WATER.porosity);
    scene["time_step"] = dt.into();
    scene["time"] = (STEPS * dt).into();
    scene["n_phases"] = 2.into();
    let plane = ["plane_Yn", "plane_Zn"][up - 1];
    let top = json!({ plane: "free" });
    scene["mesh"]["boundary_conditions"] = top.clone();
    scene["mesh"]["boundary_conditions_fluid"] = top;
    let material = &mut scene["material"][0];
    material["density"] = WATER.grain_density.into();
    material["porosity"] = WATER.porosity.into();
    material["density_fluid"] = WATER.density.into();
    material["bulk_fluid"] = WATER.bulk.into();
    material["hydraulic_conductivity"] = WATER.conductivity[..block.axes].into();
    Made { scene, exact: None }
}

/// The layer without its water: the soil alone, with the same steps.
pub(super) fn dry(block: &Block) -> Made {
    let mut scene = consolidation(block).scene;
    let drop = |of: &mut Value, keys: &[&str]| {
        if let Some(of) = of.as_object_mut() {
            of.retain(|key, _| !keys.contains(&key.as_str()));
        }
    };
    drop(&mut scene, &["n_phases"]);
    drop(&mut scene["mesh"], &["boundary_conditions_fluid"]);
    let of_water = [
        "porosity",
        "density_fluid",
        "bulk_fluid",
        "hydraulic_conductivity",
    ];
    drop(&mut scene["material"][0], &of_water);
    Made { scene, exact: None }
}
