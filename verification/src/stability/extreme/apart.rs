//! Bodies that are torn apart: what holds particles together is the grid between them.

use std::sync::Arc;

use proctor_scene::simulation::{EventKind, InitialField, InitialState, Simulation, StepErrorKind};
use proctor_scene::{
    DomainUpdate, PlaneCondition, Scene, Shape, StressScheme, TimeStep, Weighting,
};

use super::trial::{ROUND_OFF, elastic, open, run_steps, start, step, worst};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme {
    name: "torn-apart",
    what: "a bar whose ends fly apart at a hundred times its wave speed, until empty cells lie between all its particles",
    required: "no force between particles that no node joins; domains that follow say when they outgrow the stencil and stop at a cell",
    cause: None,
    judge: torn_apart,
}];

/// Rate at which the bar is stretched at the start \[1/s\]: ends at a hundred times the wave speed.
const RATE: f64 = 50.0;
/// Length of the bar in cells, and where it ends on the left; the middle stands.
const LENGTH: f64 = 4.0;
const MIDDLE: f64 = 30.0;
/// Distance from which no node is in reach of two particles: each reaches a cell and a quarter to either side \[m\].
const REACH: f64 = 2.5;
/// Growth of the length by which all must have parted, over the length.
const LONGEST: f64 = 10.0;

fn bar(weighting: Weighting) -> (Scene, InitialField) {
    let mut scene = open([60, 1]);
    scene.weighting = weighting;
    scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    // Equal steps, a hundred for each stretch by 1.
    scene.time_step = TimeStep::Fixed {
        dt: 0.01 / RATE,
        allow_unstable: false,
    };
    let material = scene.add_material(elastic(1.0, 0.0), 1.0);
    let half = 0.5 * LENGTH;
    let shape = Shape::rectangle([MIDDLE - half, 0.0], [MIDDLE + half, 1.0]);
    scene.add_body(shape, material);
    let stretched: InitialField = Arc::new(|x| InitialState {
        velocity: [RATE * (x[0] - MIDDLE), 0.0, 0.0],
        velocity_gradient: [[RATE, 0.0, 0.0], [0.0; 3], [0.0; 3]],
        ..AT_REST
    });
    (scene, stretched)
}

/// Places and velocities along the bar, from the left: one of each column of particles \[m, m/s\].
fn columns(simulation: &Simulation) -> Vec<[f64; 2]> {
    let set = &simulation.sets()[0];
    let row = (0..set.len()).filter(|&p| simulation.position(0, p)[1] < 0.5);
    let mut all: Vec<_> = row
        .map(|p| [simulation.position(0, p)[0], set.velocity(p)[0]])
        .collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

/// Change of velocity of the columns after none reaches a node of another, over that of the ends.
fn pull_after_parting(scheme: StressScheme) -> Result<f64, Unexpected> {
    let (mut scene, stretched) = bar(Weighting::UniformGimp);
    scene.scheme = scheme;
    let mut simulation = start(&scene, Some(stretched))?;
    let nearest = |simulation: &Simulation| {
        let all = columns(simulation);
        let gaps = all.windows(2).map(|pair| pair[1][0] - pair[0][0]);
        gaps.fold(f64::INFINITY, f64::min)
    };
    while nearest(&simulation) <= REACH {
        if simulation.time() * RATE > LONGEST {
            return Err(Unexpected(format!("{scheme:?}: the columns never part")));
        }
        step(&mut simulation, f64::INFINITY)?;
    }
    let before = columns(&simulation);
    run_steps(&mut simulation, 100, |_, _| ())?;
    let after = columns(&simulation);
    let changes = before.iter().zip(&after).map(|(a, b)| (a[1] - b[1]).abs());
    Ok(changes.fold(0.0, worst) / (0.5 * LENGTH * RATE))
}

fn torn_apart() -> Result<Finding, Unexpected> {
    let [mut pulled, mut late] = [0.0; 2];
    let mut finding = Finding::default();
    for scheme in SCHEMES {
        pulled = worst(pulled, pull_after_parting(scheme)?);

        let (mut scene, stretched) = bar(Weighting::ContiguousGimp(DomainUpdate::Stretch));
        scene.scheme = scheme;
        let mut simulation = start(&scene, Some(stretched))?;
        let stopped = loop {
            if simulation.time() * RATE > LONGEST {
                return Err(Unexpected(String::from("no domain ever outgrew a cell")));
            }
            match simulation.step(f64::INFINITY) {
                Ok(_) => {}
                Err(error) => break error,
            }
            let widened = simulation.events().iter();
            let widened = widened.filter(|e| e.kind == EventKind::WiderStencil);
            for event in widened {
                late = worst(late, (1.0 + RATE * event.time - 2.0).abs());
            }
        };
        let StepErrorKind::DomainTooLarge { half_length } = stopped.kind else {
            return Err(Unexpected(format!("{scheme:?}: {stopped}")));
        };
        if half_length < 1.0 {
            return Err(Unexpected(format!("{scheme:?}: {stopped}")));
        }
        late = worst(late, (1.0 + RATE * stopped.time - 4.0).abs());
        finding.refusals.push(format!("{scheme:?}: {stopped}"));
    }
    finding.gates = vec![
        Gate::at_most(
            String::from("uGIMP: change of velocity of what has parted, over that of the ends"),
            pulled,
            ROUND_OFF,
            "no node is in reach of two particles, and none acts on itself",
        ),
        Gate::at_most(
            String::from(
                "cpGIMP: stretches at which a wider stencil and the stop are told, less 2 and 4",
            ),
            late,
            0.1,
            "half-lengths of a quarter of a cell are half a cell at a stretch of 2 and a cell at 4; in the middle of the bar \
             velocities stay linear but for the noise of few particles in a cell",
        ),
    ];
    Ok(finding)
}
