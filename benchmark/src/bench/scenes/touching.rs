//! Bodies that touch each other or a surface.

use super::{Block, H, MARGIN, Made, YOUNG};
use serde_json::{Value, json};

/// Coefficient of friction between bodies, and the speed of what slides \[m/s\].
const FRICTION: f64 = 0.3;
const SLIDE: f64 = 2.0;
/// Gravity \[m/s²\].
const GRAVITY: f64 = 10.0;
/// Gap at which mortar contact begins, of a cell, and that of the beginning, of the former: it carries the weight of the
/// upper block after a few steps.
const CRITICAL: f64 = 0.2;
const FIRST: f64 = 0.6;
/// Normal stiffness of mortar contact over Young's modulus per cell.
const STIFFNESS: f64 = 0.02;
/// Time steps of it in one of the others: its stiffness bounds them.
const SLOWER: f64 = 4.5;
/// Segments of the boundary per cell.
const SEGMENTS: f64 = 2.0;
/// Cells along an edge of the squares of which a surface is made, each of two triangles.
const SQUARE: f64 = 4.0;

/// A block in two, each of whole cells: the lower on a fixed base, the upper `gap` cells above it and sliding.
fn stacked(block: &Block, gap: f64) -> Value {
    let up = block.axes - 1;
    let mut cells = block.cells.clone();
    // Each of the two is one cell high at least.
    cells[up] = cells[up].max(2);
    let block = &Block {
        axes: block.axes,
        cells,
    };
    let (mut below, above) = ([MARGIN; 3], [MARGIN; 3]);
    below[up] = 0;
    let mut slide = vec![0.0; block.axes];
    slide[0] = SLIDE;
    let mut scene = block.scene(&below, &above, 1, &slide);
    let mut gravity = vec![0.0; block.axes];
    gravity[up] = -GRAVITY;
    scene["gravity"] = gravity.into();
    let plane = ["plane_Y0", "plane_Z0"][up - 1];
    scene["mesh"]["boundary_conditions"] = json!({ plane: "fixed" });
    let middle = (block.cells[up] / 2) as f64 * H;
    let mut upper = scene["body"][0].clone();
    upper["id"] = 2.into();
    upper["point_p1"][up] = (middle + gap * H).into();
    upper["point_p2"][up] = ((block.cells[up] as f64 + gap) * H).into();
    let lower = &mut scene["body"][0];
    lower["point_p2"][up] = middle.into();
    lower["initial_velocity"] = vec![0.0; block.axes].into();
    if let Some(bodies) = scene["body"].as_array_mut() {
        bodies.push(upper);
    }
    scene
}

/// A contact between two bodies on the grid.
fn on_grid(id: usize, master: usize, slave: usize) -> Value {
    json!({
        "id": id, "friction": FRICTION, "master_id": master, "slave_id": slave, "normal_type": "collinear",
    })
}

/// Two blocks in contact on the grid.
pub(super) fn contact(block: &Block) -> Made {
    let mut scene = stacked(block, 0.0);
    scene["contact"] = json!([on_grid(1, 1, 2)]);
    Made { scene, exact: None }
}

/// Three blocks in contact on the grid: the upper one of two is in two halves, one slower than the other.
pub(super) fn mixed(block: &Block) -> Made {
    let mut cells = block.cells.clone();
    cells[0] = cells[0].max(2);
    let wide = Block {
        axes: block.axes,
        cells,
    };
    let mut scene = stacked(&wide, 0.0);
    let middle = (MARGIN + wide.cells[0] / 2) as f64 * H;
    let left = &mut scene["body"][1];
    let mut right = left.clone();
    left["point_p2"][0] = middle.into();
    right["point_p1"][0] = middle.into();
    right["id"] = 3.into();
    right["initial_velocity"][0] = (SLIDE / 2.0).into();
    if let Some(bodies) = scene["body"].as_array_mut() {
        bodies.push(right);
    }
    scene["contact"] = json!([on_grid(1, 1, 2), on_grid(2, 1, 3), on_grid(3, 2, 3)]);
    Made { scene, exact: None }
}

/// Two blocks in mortar contact.
pub(super) fn mortar(block: &Block) -> Made {
    let mut scene = stacked(block, CRITICAL * FIRST);
    for key in ["time", "time_step"] {
        scene[key] = scene[key].as_f64().map(|time| time / SLOWER).into();
    }
    if let Some(bodies) = scene["body"].as_array_mut() {
        for body in bodies {
            body["boundary_segment"] = (H / SEGMENTS).into();
        }
    }
    scene["contact"] = json!([{
        "id": 1, "method": "mortar", "friction": FRICTION, "master_id": 1, "slave_id": 2,
        "critical_gap": CRITICAL * H, "normal_stiffness": STIFFNESS * YOUNG / H,
    }]);
    Made { scene, exact: None }
}

/// A block on a rigid plane of triangles, which lies within the mesh.
pub(super) fn stl(block: &Block) -> Made {
    let margin = [MARGIN; 3];
    let mut scene = block.scene(&margin, &margin, 1, &[SLIDE, 0.0, 0.0]);
    scene["gravity"] = json!([0.0, 0.0, -GRAVITY]);
    let height = MARGIN as f64 * H;
    let room = |axis: usize| (block.cells[axis] + 2 * MARGIN) as f64 * H;
    let squares = [0, 1].map(|axis| (room(axis) / (SQUARE * H)).ceil() as usize);
    let mut triangles = vec![];
    for square in 0..squares[0] * squares[1] {
        let at = |right: usize, back: usize| {
            let x = room(0) * (square % squares[0] + right) as f64 / squares[0] as f64;
            let y = room(1) * (square / squares[0] + back) as f64 / squares[1] as f64;
            json!([x, y, height])
        };
        triangles.push(json!([at(0, 0), at(1, 0), at(1, 1)]));
        triangles.push(json!([at(0, 0), at(1, 1), at(0, 1)]));
    }
    scene["terrain_contact"] = json!({
        "active": true, "triangles": triangles, "friction": FRICTION,
    });
    Made { scene, exact: None }
}
