//! Scenes of nothing, or of nearly nothing: no body, no particle, a mesh of empty cells.

use std::sync::Arc;

use proctor_kernel::memory::Memory;
use proctor_scene::simulation::{EventKind, Options, SetupError, StartError};
use proctor_scene::{Dimension, Outside, Scene, Shape};

use super::input::{full, refused_for};
use super::runs::{
    block, filled, methods, open, options, soft, start, steps, to_time, unexpected, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::cuboid;

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "no-particles",
        what: "no body, an empty list of particles, a body without extent, a body all of which has left",
        required: "refused with a reason; what has left is booked, and the empty run goes on",
        cause: None,
        judge: no_particles,
    },
    Extreme {
        name: "empty-mesh",
        what: "1e8 empty cells and four particles, in memory that does not hold them, and in that of the machine",
        required: "refused with how much there is; what fits runs, and the body falls as it must",
        cause: None,
        judge: empty_mesh,
    },
];

fn no_particles() -> Result<Finding, Unexpected> {
    let mut finding = Finding::default();
    let none = Scene {
        bodies: vec![],
        contacts: vec![],
        ..full()
    };
    refused_for(&none, "bodies", &mut finding.refusals)?;
    let mut empty = full();
    empty.bodies[2].shape = Shape::Particles(Arc::new(vec![]));
    refused_for(&empty, "bodies[2].particles", &mut finding.refusals)?;
    // A disc that holds no centre of a sub-cell.
    let mut small = block([8, 8], [2.0, 2.0], [4.0, 4.0], soft());
    small.bodies[0].shape = Shape::disc([3.0, 3.0], 1e-6);
    match small.simulate(&options()) {
        Err(StartError::Setup(SetupError::Body { body, reason })) => {
            finding.refusals.push(format!("{body}: {reason}"));
        }
        Err(error) => {
            return Err(Unexpected(format!(
                "a body without particles is called {error}"
            )));
        }
        Ok(_) => return Err(Unexpected("a body without particles was taken".to_owned())),
    }
    // A body that flies out, particle by particle.
    let (mut off, mut ran) = (0.0_f64, 0);
    for method in methods() {
        let what = method.to_string();
        let mut scene = with(&block([8, 8], [5.0, 3.0], [7.0, 5.0], soft()), method);
        scene.outside = Outside::Remove;
        scene.bodies[0].velocity = [1.0, 0.0, 0.0];
        let mut simulation = start(&what, &scene, &options())?;
        let mass = simulation.mass();
        to_time(&what, &mut simulation, 4.0)?;
        let removed: f64 = simulation
            .events()
            .iter()
            .filter_map(|event| match &event.kind {
                EventKind::Removed(at) => Some(at.mass),
                _ => None,
            })
            .sum();
        off = off.max((removed + simulation.mass() - mass).abs() / mass);
        if simulation.particles() == 0 {
            to_time(&what, &mut simulation, 5.0)?;
            ran += 1;
        }
    }
    finding.gates = vec![
        Gate::at_most(
            "mass that is neither left nor booked, over all".to_owned(),
            off,
            1e-15,
            "sixteen masses of a quarter are summed without round-off",
        ),
        Gate::at_least(
            "methods with which a run goes on without particles".to_owned(),
            f64::from(ran),
            methods().len() as f64,
            "the body needs 3 s to leave at 1 m/s, and 4 s are run",
        ),
    ];
    Ok(finding)
}

fn empty_mesh() -> Result<Finding, Unexpected> {
    let small = |cells: usize| {
        let mut scene = open(Dimension::Two, [cells, cells, 1], soft());
        let middle = 0.5 * cells as f64;
        let shape = cuboid([middle, middle, 0.0], [middle + 1.0, middle + 1.0, 0.0]);
        scene.bodies = vec![filled(Dimension::Two, 1, shape)];
        scene.gravity = [0.0, -0.01, 0.0];
        scene
    };
    let mut finding = Finding::default();
    let limited = Options {
        memory: Some(Memory::of(1 << 30)),
        ..options()
    };
    match small(10_000).simulate(&limited) {
        Err(StartError::Setup(SetupError::Memory { path, error }))
            if path == "mesh.cells_number" =>
        {
            finding.refusals.push(format!("{path}: {error}"));
        }
        Err(error) => return Err(Unexpected(format!("1e8 cells in 1 GiB are called {error}"))),
        Ok(_) => return Err(Unexpected("1e8 cells were taken into 1 GiB".to_owned())),
    }
    for cells in [1000, 10_000] {
        let what = format!("four particles in {cells} by {cells} cells");
        let mut simulation = match small(cells).simulate(&options()) {
            Ok(simulation) => simulation,
            // A machine may have less.
            Err(StartError::Setup(SetupError::Memory { path, error })) if cells == 10_000 => {
                finding.refusals.push(format!("{path}: {error}"));
                continue;
            }
            Err(error) => return Err(unexpected(what, error)),
        };
        let before = simulation.center(0).position;
        steps(&what, &mut simulation, 100)?;
        let after = simulation.center(0).position;
        let t = simulation.time();
        finding.gates.extend([
            Gate::at_most(
                format!("{what}: height after a fall [m]"),
                (after[1] - before[1] + 0.005 * t * t).abs(),
                1e-10,
                "the fall is exact; 100 steps at a height of 5000 m, whose last digit is 9e-13 m",
            ),
            Gate::at_most(
                format!("{what}: nodes in use"),
                simulation.nodes_active() as f64,
                64.0,
                "two cells with three nodes per axis and a cell of travel on each side are no more than eight nodes per axis",
            ),
        ]);
    }
    Ok(finding)
}
