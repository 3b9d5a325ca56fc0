//! Scenes of nothing, or of nearly nothing: no body, no particle, a mesh of empty cells.

use super::input::{full, refused_for};
use super::prelude::*;
use proctor_kernel::memory::Memory;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("no-particles", no_particles)
        .with("no body, an empty list of particles, a body without extent, a body all of which has left")
        .must("refused with a reason; lost particles are booked, and the empty run goes on"),
    Extreme::of("empty-mesh", empty_mesh)
        .with("1e8 empty cells and four particles: in its corners, in memory that does not hold the nodes between them; and together")
        .must("refused with the free memory; a scene that fits runs, and the body falls as it must"),
];

fn no_particles() -> RowVerdict {
    let none = Scene {
        bodies: vec![],
        contacts: vec![],
        ..full()
    };
    let mut empty = full();
    empty.bodies[2].shape = listed([]);
    // A disc that holds no centre of a sub-cell.
    let small = alone([8, 8], Shape::disc([3.0, 3.0], 1e-6), soft());
    let of_body = |error: &StartError| match error {
        StartError::Setup(SetupError::Body { body, reason }) => Some(format!("{body}: {reason}")),
        _ => None,
    };
    let refusals = vec![
        refused_for("bodies", &none)?,
        refused_for("bodies[2].particles", &empty)?,
        refused("a body without particles", &small, &options(), of_body)?,
    ];
    // A body that flies out, particle by particle.
    let mut off = gate("mass that is neither left nor booked, over all").at_most(
        1e-15,
        "sixteen masses of a quarter are summed without round-off",
    );
    let mut ran = gate("methods with which a run goes on without particles")
        .at_least(
            methods().len() as f64,
            "the body needs 3 s to leave at 1 m/s, and 4 s are run",
        )
        .found(0.0);
    for method in methods() {
        let mut scene = with(&block([8, 8], [5.0, 3.0], [7.0, 5.0], soft()), method);
        scene.bodies[0].velocity = [1.0, 0.0, 0.0];
        let (mut simulation, unbooked) = emptied(&scene, 4.0)?;
        off.see(unbooked);
        if simulation.particles() == 0 {
            to_time(&mut simulation, 5.0)?;
            ran.count(true);
        }
    }
    Ok(Finding::of([off, ran]).refusing(refusals))
}

fn empty_mesh() -> RowVerdict {
    let small = |cells: usize| {
        let middle = 0.5 * cells as f64;
        block([cells; 2], [middle; 2], [middle + 1.0; 2], soft()).with_gravity([0.0, -0.01])
    };
    let mut limited = options();
    limited.memory = Some(Memory::of(1 << 30));
    let too_large = |error: &StartError| match error {
        StartError::Setup(SetupError::Memory { path, error }) if path == "mesh.cells_number" => {
            Some(format!("{path}: {error}"))
        }
        _ => None,
    };
    // The grid is counted as far as a body reaches.
    let mut apart = small(10_000);
    let ends = [1.0, 9_999.0];
    let corners = ends.map(|x| ends.map(|y| ([x, y, 0.0], 1.0)));
    apart.bodies[0].shape = listed(corners.concat());
    let in_little = refused("1e8 cells in 1 GiB", &apart, &limited, too_large)?;
    let mut refusals = vec![in_little];
    let mut gates = vec![];
    for cells in [1000, 10_000] {
        let what = format!("four particles in {cells} by {cells} cells");
        let mut simulation = match small(cells).simulate(&options()) {
            Ok(simulation) => simulation,
            // A machine may have less.
            Err(StartError::Setup(SetupError::Memory { path, error })) if cells == 10_000 => {
                refusals.push(format!("{path}: {error}"));
                continue;
            }
            Err(error) => return Err(unexpected(what, error)),
        };
        let before = simulation.center(0).position;
        steps(&mut simulation, 100)?;
        let after = simulation.center(0).position;
        let t = simulation.time();
        gates.extend([
            gate(format!("{what}: height after a fall [m]"))
                .at_most(1e-10, "the fall is exact; 100 steps at a height of 5000 m, whose last digit is 9e-13 m")
                .found((after[1] - before[1] + 0.005 * t * t).abs()),
            gate(format!("{what}: nodes in use"))
                .at_most(64.0, "two cells with three nodes per axis and a cell of travel on each side are no more than eight nodes per axis")
                .found(simulation.nodes_active() as f64),
        ]);
    }
    Ok(Finding::of(gates).refusing(refusals))
}
