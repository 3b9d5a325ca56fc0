//! Bodies that are torn apart: what holds particles together is the grid between them.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme::of("torn-apart", torn_apart)
        .with("a bar whose ends fly apart at a hundred times its wave speed, until empty cells lie between all its particles")
        .must("no force between particles that no node joins; domains that follow say when they outgrow the stencil and stop at a cell"),];

/// Rate at which the bar is stretched at the start \[1/s\]: ends at a hundred times the wave speed.
const RATE: f64 = 50.0;
/// Length of the bar in cells, and where it ends on the left; the middle stands.
const LENGTH: f64 = 4.0;
const MIDDLE: f64 = 30.0;
/// Distance from which no node is in reach of two particles: each reaches a cell and a quarter to either side \[m\].
const REACH: f64 = 2.5;
/// Growth of the length by which all must have parted, over the length.
const LONGEST: f64 = 10.0;

/// The bar with a method, and its start.
fn bar(weighting: Weighting, scheme: StressScheme) -> Result<Simulation, RowFault> {
    let [left, right] = [-0.5, 0.5].map(|share| MIDDLE + share * LENGTH);
    // Equal steps, a hundred for each stretch by 1.
    let scene = block([60, 1], [left, 0.0], [right, 1.0], elastic(1.0, 0.0))
        .with_weighting(weighting)
        .with_scheme(scheme)
        .between(1)
        .with_time_step(fixed(0.01 / RATE));
    let stretched = from(|x| moving_along_x(RATE * (x[0] - MIDDLE), RATE));
    start(&scene, &stretched)
}

/// Places and velocities along the bar, from the left: one of each column of particles \[m, m/s\].
fn columns(simulation: &Simulation) -> Vec<[f64; 2]> {
    let row = of_body(simulation, 0).filter(|seen| seen.position[1] < 0.5);
    let mut all: Vec<_> = row
        .map(|seen| [seen.position[0], seen.velocity[0]])
        .collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

/// Change of velocity of the columns after none reaches a node of another, over that of the ends.
fn pull_after_parting(scheme: StressScheme) -> Result<f64, RowFault> {
    let mut simulation = bar(Weighting::UniformGimp, scheme)?;
    let nearest = |simulation: &Simulation| {
        let all = columns(simulation);
        let gaps = all.windows(2).map(|pair| pair[1][0] - pair[0][0]);
        gaps.fold(f64::INFINITY, f64::min)
    };
    while nearest(&simulation) <= REACH {
        if simulation.time() * RATE > LONGEST {
            return Err(RowFault(format!("{scheme:?}: the columns never part")));
        }
        step(&mut simulation, NEVER)?;
    }
    let before = columns(&simulation);
    steps(&mut simulation, 100)?;
    let after = columns(&simulation);
    let changes = before.iter().zip(&after).map(|(a, b)| (a[1] - b[1]).abs());
    Ok(changes.fold(0.0, worst) / (0.5 * LENGTH * RATE))
}

fn torn_apart() -> RowVerdict {
    let mut pulled = gate("uGIMP: change of velocity of what has parted, over that of the ends")
        .at_most(ROUND_OFF)
        .because("no node is in reach of two particles, and none acts on itself");
    let mut late = gate("cpGIMP: stretches at which a wider stencil and the stop are reported, less 2 and 4")
        .at_most(0.1)
        .because("half-lengths of a quarter of a cell are half a cell at a stretch of 2 and a cell at 4; in the middle of the bar \
             velocities stay linear but for the noise of few particles in a cell");
    let mut refusals = vec![];
    for scheme in SCHEMES {
        pulled.see(pull_after_parting(scheme)?);
        let mut simulation = bar(CONTIGUOUS, scheme)?;
        let stopped = loop {
            if simulation.time() * RATE > LONGEST {
                return Err(RowFault(String::from("no domain ever outgrew a cell")));
            }
            if let Err(error) = simulation.step(NEVER) {
                break error;
            }
            let events = simulation.events().iter();
            for event in events.filter(|e| e.kind == EventKind::WiderStencil) {
                late.see((1.0 + RATE * event.time - 2.0).abs());
            }
        };
        let StepErrorKind::DomainTooLarge { half_length: 1.0.. } = stopped.kind else {
            return Err(unexpected(format!("{scheme:?}"), stopped));
        };
        late.see((1.0 + RATE * stopped.time - 4.0).abs());
        refusals.push(format!("{scheme:?}: {stopped}"));
    }
    Ok(Finding::of([pulled, late]).refusing(refusals))
}
