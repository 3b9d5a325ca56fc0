//! A block all of which yields, and the same where nothing does, to measure what a yield surface costs.

use super::{Block, DENSITY, H, MARGIN, Made, POISSON, YOUNG};
use serde_json::{Value, json};

/// Strength that no particle reaches \[Pa\], and one that all are beyond after a step.
const HIGH: f64 = 1e9;
const LOW: f64 = 1.0;
/// Slope of the swelling of a clay and the pressure \[Pa\] on it at the start, whose ratio is the bulk modulus of all scenes.
const SWELLING: f64 = 0.02;
const PRESSURE: f64 = SWELLING * YOUNG / (3.0 * (1.0 - 2.0 * POISSON));

/// A block cut across the first axis into slabs a cell thick that move along the second, each faster than the one before:
/// without contact they share a velocity, and all of the block is sheared, by eight tenths of a thousandth in a step. Its
/// law is one of `law`.
pub(super) fn slabs(block: &Block, kind: &str, yields: bool) -> Made {
    let margin = [MARGIN; 3];
    let mut scene = block.scene(&margin, &margin, 1, &vec![0.0; block.axes]);
    let whole = scene["body"][0].clone();
    let count = block.cells[0];
    let slabs: Vec<Value> = (0..count)
        .map(|i| {
            let mut slab = whole.clone();
            let from = (MARGIN + i) as f64 * H;
            slab["id"] = (i + 1).into();
            slab["point_p1"][0] = from.into();
            slab["point_p2"][0] = (from + H).into();
            let mut velocity = vec![0.0; block.axes];
            velocity[1] = (i as f64 - 0.5 * count as f64) * H;
            slab["initial_velocity"] = velocity.into();
            if kind == "cam_clay" {
                slab["initial_stress"] = json!({ "type": "isotropic", "value": -PRESSURE });
            }
            slab
        })
        .collect();
    scene["body"] = slabs.into();
    scene["material"][0] = law(kind, yields);
    Made { scene, exact: None }
}

/// A material with the elasticity of all scenes, and the yield surface of a kind.
fn law(kind: &str, yields: bool) -> Value {
    let strength = if yields { LOW } else { HIGH };
    let mut law = json!({ "id": 1, "type": kind, "density": DENSITY, "poisson": POISSON });
    if kind != "cam_clay" {
        law["young"] = YOUNG.into();
    }
    let own = match kind {
        "von_mises" => json!({ "yield_stress": strength, "hardening": 1e4 }),
        "drucker_prager" | "mohr_coulomb" => {
            json!({ "friction": 30, "cohesion": strength, "dilation": 5 })
        }
        "cam_clay" => json!({
            "critical_ratio": 1, "reference_pressure": PRESSURE, "swelling": SWELLING, "compression": 5.0 * SWELLING,
            "overconsolidation": if yields { 1.0 } else { 100.0 },
        }),
        _ => json!({}),
    };
    for (key, value) in own.as_object().into_iter().flatten() {
        law[key] = value.clone();
    }
    law
}
