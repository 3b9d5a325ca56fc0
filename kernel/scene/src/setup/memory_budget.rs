//! Memory budget: parts of a simulation take their share of the free memory before they are allocated.
//!
//! Estimates, on the high side: what an array holds, and a copy where a checkpoint makes one. The grid is counted as
//! far as bodies reach at the start, since the system commits the rest when it is first written; a step asks for what they
//! reach later, as they travel.

use crate::values::{Body, Field, Scene};
use proctor_geometry::bodies::{self, FILLED, FillError, MemoryRoom};
use proctor_geometry::memory::{Memory, OutOfMemory, in_one_piece};
use proctor_kernel::grid::{GridShape, Line};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::plan::{Plan, loses_tension};
use proctor_kernel::simulation::{MESH, SetupError};
use proctor_kernel::stage::solve::{DrivenNode, NodeForce};

/// Bytes of a row of the grid beside its nodes: what is occupied, the span in use, and a copy of both.
const ROW: f64 = 40.0;
/// Bytes of a page, the least that the system hands out.
const PAGE: f64 = 4096.0;
/// Nodes on each side of a body that its particles reach until the next sort, and one more for round-off.
const REACH: f64 = 5.0;
/// Bytes of the lists of frames and history for each output: names and times of three series.
const OUTPUT: f64 = 512.0;
/// Takes the memory of the grid, of which this process holds a share, and asks for that of one velocity field for a body with its own.
///
/// # Errors
/// [`SetupError::Memory`].
pub(super) fn grid(
    scene: &Scene,
    (shape, share): (&GridShape, f64),
    memory: &mut Memory,
) -> Result<(), SetupError> {
    let (nodes, reached) = (nodes(shape), share * reached(scene, shape));
    let rows = shape.nodes[0] as f64 * shape.nodes[1] as f64;
    let fields = 1.0 + bodies_with_fields(scene).len() as f64;
    // Which fields move together, and forces of pairs in each plane.
    let pairs = scene.contacts.len() as f64 * shape.nodes[0] as f64 * size_of::<[f64; 4]>() as f64;
    let needed = reached * size_of::<Line>() as f64 + fields * rows * ROW + fields * fields + pairs;
    let what = format!("a grid of {nodes} nodes, those around the mesh included,");
    memory
        .take(format!("{what} of which bodies reach {reached}"), needed)
        .and_then(|()| handed_out(what, nodes * size_of::<Line>() as f64))
        .map_err(|error| at(MESH, error))
}

/// Nodes that bodies reach at the start: those in the boxes around them, all where a body has none.
pub(super) fn reached(scene: &Scene, shape: &GridShape) -> f64 {
    let of_body = |body: &Body| {
        (body.shape.bounds()).map_or(f64::INFINITY, |[low, high]| in_box(shape, low, high))
    };
    let bodies: f64 = scene.bodies.iter().map(of_body).sum();
    bodies.min(nodes(shape))
}

/// Nodes that particles between two corners \[m\] reach until the next sort, in whole pages.
fn in_box(shape: &GridShape, low: [f64; 3], high: [f64; 3]) -> f64 {
    let mut length = [1.0; 3];
    for axis in 0..shape.axes {
        let direction = shape.direction(axis);
        let cells = (high[axis] - low[axis]).max(0.0) / shape.cell[axis];
        length[direction] = (cells.ceil() + 1.0 + 2.0 * REACH).min(shape.nodes[direction] as f64);
    }
    let in_row = length[2] + PAGE / size_of::<Line>() as f64;
    length[0] * length[1] * in_row
}

/// Checks that the system gives so many bytes in one piece.
fn handed_out(what: String, needed: f64) -> Result<(), OutOfMemory> {
    let piece = in_one_piece(needed);
    if piece < needed {
        return Err(OutOfMemory {
            what,
            needed,
            there_is: piece as u64,
        });
    }
    Ok(())
}

/// Asks for the memory of the particles of all bodies together, before the first is filled.
///
/// # Errors
/// [`SetupError::Body`], with the body that needs most.
pub(super) fn bodies(scene: &Scene, plan: &Plan, memory: Memory) -> Result<(), SetupError> {
    let each = expected(scene, plan);
    let (count, bytes) = (each.iter()).fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
    let most = (0..each.len()).max_by(|a, b| each[*a].1.total_cmp(&each[*b].1));
    let Some(most) = most else { return Ok(()) };
    let what = match each.len() {
        1 => format!("{count:.4e} particles"),
        bodies => {
            let own = each[most].0;
            format!("{count:.4e} particles of {bodies} bodies, {own:.4e} of this one,")
        }
    };
    memory
        .require(what, bytes)
        .map_err(|error| SetupError::Body {
            body: scene.bodies[most].name.clone(),
            reason: FillError::Memory(error).to_string(),
        })
}

/// Takes the memory of the velocity fields of bodies in contact: those parts of the grid that they touch.
///
/// # Errors
/// [`SetupError::Memory`].
pub(super) fn layers(
    scene: &Scene,
    shape: &GridShape,
    sets: &[ParticleSet],
    memory: &mut Memory,
) -> Result<(), SetupError> {
    let line = size_of::<Line>() as f64;
    for body in bodies_with_fields(scene) {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for axis in 0..shape.axes {
            for x in &sets[body].columns[Layout::POSITION + axis] {
                (low[axis], high[axis]) = (low[axis].min(*x), high[axis].max(*x));
            }
        }
        let touched = in_box(shape, low, high).min(nodes(shape));
        let name = &scene.bodies[body].name;
        // Two lines per node, each in an array that is asked for whole.
        handed_out(
            format!("a velocity field of \"{name}\""),
            nodes(shape) * line,
        )
        .and_then(|()| {
            let what = format!("the velocity field of \"{name}\"");
            memory.take(what, 2.0 * touched * line)
        })
        .map_err(|error| at(MESH, error))?;
    }
    Ok(())
}

/// Takes the memory of the lists that grow with each output.
///
/// # Errors
/// [`SetupError::Memory`].
pub(super) fn frames(scene: &Scene, memory: &mut Memory) -> Result<(), SetupError> {
    let print = scene.results.print;
    memory
        .take(
            format!("the lists of {print} outputs"),
            print as f64 * OUTPUT,
        )
        .map_err(|error| at("results.print", error))
}

/// Takes the memory of held nodes and of nodes that tractions act on.
///
/// # Errors
/// [`SetupError::Memory`].
pub(super) fn loads(
    scene: &Scene,
    shape: &GridShape,
    memory: &mut Memory,
) -> Result<(), SetupError> {
    let mut held = 0.0;
    for (i, given) in scene.held_boxes.iter().enumerate() {
        held += (0..shape.axes)
            .map(|axis| given.nodes_along(&scene.mesh, axis).len() as f64)
            .product::<f64>();
        let each = (size_of::<DrivenNode>() + size_of::<usize>()) as f64;
        memory
            .require(format!("{held} held nodes"), held * each)
            .map_err(|error| at(&format!("held_box[{i}]"), error))?;
    }
    let mut loaded = 0.0;
    for (i, traction) in scene.tractions.iter().enumerate() {
        loaded += (0..shape.axes)
            .map(|axis| {
                let cells = (traction.p2[axis] - traction.p1[axis]) / scene.mesh.cell[axis];
                cells.clamp(0.0, scene.mesh.cells[axis] as f64) + 2.0
            })
            .product::<f64>();
        memory
            .require(
                format!("{loaded:.0} nodes with tractions"),
                2.0 * loaded * size_of::<NodeForce>() as f64,
            )
            .map_err(|error| at(&format!("traction[{i}]"), error))?;
    }
    Ok(())
}

/// Bytes that one particle needs: its state, a copy of it while it is saved, what fills and sorts it, and what is written
/// of it.
pub(super) fn per_particle(scene: &Scene, layout: &Layout) -> f64 {
    let numbers = |field: &Field| match field {
        Field::DeformationGradient => 9.0,
        Field::Stress => 6.0,
        Field::Displacement | Field::Velocity | Field::ExternalForce => 3.0,
        Field::InternalVariables => layout.components().count() as f64,
        _ => 1.0,
    };
    let written: f64 = if scene.results.print > 0 {
        // Its place in the order of the file, and its position.
        5.0 + scene.results.fields.iter().map(numbers).sum::<f64>()
    } else {
        0.0
    };
    // Its growth in tension.
    let growth = if loses_tension(scene.transfer, scene.scheme) {
        8.0
    } else {
        0.0
    };
    2.0 * layout.bytes_per_particle() as f64 + FILLED + 8.0 * written + growth
}

/// Takes the memory of the particles of a body.
///
/// # Errors
/// [`FillError::Memory`].
pub(super) fn particles(
    count: usize,
    room: &MemoryRoom,
    memory: &mut Memory,
) -> Result<(), FillError> {
    memory
        .take(
            format!("{count} particles"),
            count as f64 * room.per_particle,
        )
        .map_err(FillError::Memory)
}

/// The error of a body that cannot be filled.
pub(super) fn of_body(body: &Body) -> impl Fn(FillError) -> SetupError {
    |error| SetupError::Body {
        body: body.name.clone(),
        reason: error.to_string(),
    }
}

/// About how many particles each body gets, and the bytes that they need.
pub(super) fn expected(scene: &Scene, plan: &Plan) -> Vec<(f64, f64)> {
    let axes = scene.dimension.axes();
    let bodies = scene.bodies.iter().zip(&plan.layouts);
    let of_body = bodies.map(|(body, layout)| {
        let count = bodies::expected(&body.shape, body.particles_per_cell, &scene.mesh, axes);
        (count, count * per_particle(scene, layout))
    });
    of_body.collect()
}

/// Number of nodes, ghosts included.
pub(super) fn nodes(shape: &GridShape) -> f64 {
    shape.nodes.iter().map(|&n| n as f64).product()
}

/// Indices of the bodies that can have a velocity field of their own.
fn bodies_with_fields(scene: &Scene) -> Vec<usize> {
    let has = |id: i64| {
        scene
            .contacts
            .iter()
            .any(|c| c.master == id || c.slave == id)
            || scene.mortar.boundaries.iter().any(|b| b.body == id)
    };
    (0..scene.bodies.len())
        .filter(|&i| has(scene.bodies[i].id))
        .collect()
}

fn at(path: &str, error: proctor_geometry::memory::OutOfMemory) -> SetupError {
    SetupError::Memory {
        path: path.to_owned(),
        error,
    }
}
