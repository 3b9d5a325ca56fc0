//! Soil and water that run away: how far they come, and the books that must close whatever they do.
//!
//! Nothing exact is known of a heap that has run out, so that these cases are judged by what holds whatever the law: no
//! mass is lost, there is no more energy than what fell has given, no plastic work is given back, the centre of mass goes
//! where its momentum carries it, and what has friction or cohesion comes to rest.

use std::collections::{BTreeMap, BTreeSet};

use proctor_scene::simulation::Simulation;
use proctor_scene::{Mesh, Vector};

use super::parts::larger;
use super::stepping::step;
use crate::case::gates::{GateRule, value};
use crate::case::{Drawing, Quantity, Rung, RungResult};
use crate::study::{Failure, Observer, Phase};

const SAMPLES: u32 = 64; // Samples of a run
/// Samples of which pictures are kept: at the start, early on, and at the end.
const PICTURED: [u32; 5] = [0, 8, 16, 32, 64];
const SHEARED: f64 = 0.5; // Plastic strain beyond which a cell is drawn as part of a band

/// Names of the quantities.
pub const LOST: &str = "mass lost over the initial mass";
pub const GAINED: &str = "largest energy gained over the potential energy lost";
pub const BACK: &str = "plastic work returned over the potential energy lost";
pub const ASTRAY: &str =
    "distance of the centre of mass from the path of its momentum over its fall";
pub const MOVING: &str = "final kinetic energy over the potential energy lost";
pub const UNBOOKED: &str =
    "taken at planes and between particles and nodes, over the energy of the fall";
pub const FRONT: &str = "front at the end";
pub const TOP: &str = "highest point at the end";

/// State of a run at a time.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Time \[s\].
    pub time: f64,
    /// Reach of the heap \[m\].
    pub front: f64,
    /// Its highest point \[m\].
    pub top: f64,
}

/// Observations of a run of something that falls.
pub struct RunOut {
    /// Places at equal times, the start among them.
    pub places: Vec<Place>,
    /// Frames at five times below each other.
    pub drawing: Drawing,
    /// Books, front and top.
    pub quantities: Vec<Quantity>,
}

impl RunOut {
    /// Reach of the heap and its highest point at the end \[m\].
    pub fn at_last(&self) -> [f64; 2] {
        let last = self.places.last();
        last.map_or([f64::NAN; 2], |place| [place.front, place.top])
    }
}

/// Runs a scene to its end. The first body is what falls, from a plane on its left and on one below it. The books count
/// `work` times what gravity did: anything but 1 is a wrong reference.
///
/// # Errors
/// As [`step`].
pub fn run(
    simulation: &mut Simulation,
    work: f64,
    observer: &mut dyn Observer,
) -> Result<RunOut, Failure> {
    let end = simulation.scene().time;
    let (mass, start) = (simulation.mass(), simulation.center(0).position);
    let mut ledger = EnergyLedger::default();
    let mut run = RunOut {
        places: vec![place(simulation)],
        drawing: Drawing {
            title: String::new(),
            bodies: vec![],
            lines: vec![],
        },
        quantities: vec![],
    };
    let mut times = vec![];
    draw(simulation, &mut run.drawing, &mut times);
    let mut carried = [0.0; 2];
    observer.phase(Phase::Stepping);
    for sample in 1..=SAMPLES {
        let stop = end * f64::from(sample) / f64::from(SAMPLES);
        while simulation.time() < stop {
            let info = step(simulation, stop, observer)?;
            let momentum = simulation.momentum();
            for axis in 0..2 {
                carried[axis] += info.dt * momentum[axis];
            }
        }
        ledger.look(simulation, work);
        run.places.push(place(simulation));
        if PICTURED.contains(&sample) {
            draw(simulation, &mut run.drawing, &mut times);
        }
        observer.progress(f64::from(sample) / f64::from(SAMPLES));
    }
    observer.phase(Phase::Comparing);
    let centre = simulation.center(0).position;
    let [x, y] = [0, 1].map(|axis| centre[axis] - start[axis] - carried[axis] / mass);
    let astray = libm::hypot(x, y) / (start[1] - centre[1]).abs();
    let lost = (mass - simulation.mass()).abs() / mass;
    let [front, top] = run.at_last();
    run.quantities = ledger.quantities(simulation);
    run.quantities.extend([
        Quantity::balance(ASTRAY, astray, "1"),
        Quantity::balance(LOST, lost, "1"),
        Quantity::figure(FRONT, front, "m"),
        Quantity::figure(TOP, top, "m"),
    ]);
    Ok(run)
}

/// Energies of the samples so far.
#[derive(Default)]
struct EnergyLedger {
    /// Most energy from nowhere of any sample \[J\].
    gained: f64,
    /// Most plastic work that was lost between two samples \[J\].
    back: f64,
    plastic: f64,
    fell: f64,
    moving: f64,
    unbooked: f64,
}

impl EnergyLedger {
    fn look(&mut self, simulation: &mut Simulation, work: f64) {
        let energy = simulation.energy();
        let unbooked = energy.remainder - (1.0 - work) * energy.external_work;
        self.gained = larger(self.gained, -unbooked);
        self.back = larger(self.back, self.plastic - energy.plastic);
        self.plastic = energy.plastic;
        self.fell = energy.external_work;
        self.moving = energy.kinetic;
        self.unbooked = unbooked;
    }

    fn quantities(&self, simulation: &Simulation) -> Vec<Quantity> {
        let share = |energy: f64| energy / self.fell;
        // What has no strength does not come to rest.
        let rests = simulation.sets()[0].column(STRAIN).is_some();
        let moving = if rests {
            Quantity::balance
        } else {
            Quantity::figure
        };
        vec![
            Quantity::balance(GAINED, share(self.gained), "1"),
            Quantity::balance(BACK, share(self.back), "1"),
            Quantity::figure(UNBOOKED, share(self.unbooked), "1"),
            moving(MOVING, share(self.moving), "1"),
        ]
    }
}

const STRAIN: &str = "plastic strain"; // Name of the variable of laws that yield

/// Particles of the first body of a simulation, as [`columns_of`].
fn columns(simulation: &Simulation) -> Vec<[f64; 2]> {
    let mesh = &simulation.scene().mesh;
    let half = 0.5 * mesh.cell[0] / simulation.scene().bodies[0].particles_per_cell[0] as f64;
    let places = (0..simulation.sets()[0].len()).map(|p| simulation.position(0, p));
    columns_of(mesh, half, places)
}

/// Particles at some places as squares of sides of twice `half` \[m\], by columns of cells from the left up to the first that
/// is empty: right end and top of each column \[m\].
pub fn columns_of(mesh: &Mesh, half: f64, places: impl Iterator<Item = Vector>) -> Vec<[f64; 2]> {
    let mut columns = vec![[f64::NEG_INFINITY; 2]; mesh.cells[0]];
    for x in places {
        let at = ((x[0] - mesh.origin[0]) / mesh.cell[0]) as usize;
        if let Some(column) = columns.get_mut(at) {
            column[0] = column[0].max(x[0] + half);
            column[1] = column[1].max(x[1] + half);
        }
    }
    let full = columns.iter().take_while(|column| column[0].is_finite());
    full.copied().collect()
}

fn place(simulation: &Simulation) -> Place {
    let columns = columns(simulation);
    Place {
        time: simulation.time(),
        front: columns.last().map_or(f64::NAN, |column| column[0]),
        top: columns
            .iter()
            .map(|column| column[1])
            .fold(f64::NAN, f64::max),
    }
}

/// Adds the heap as it is now, and where it is sheared, below the frames that are drawn.
fn draw(simulation: &Simulation, drawing: &mut Drawing, times: &mut Vec<String>) {
    let mesh = &simulation.scene().mesh;
    let ([left, below], upper) = ([mesh.origin[0], mesh.origin[1]], mesh.upper());
    let columns = columns(simulation);
    let mut outline = vec![[left, below]];
    let middle = |i: usize| left + (i as f64 + 0.5) * mesh.cell[0];
    if let Some(first) = columns.first() {
        outline.push([left, first[1]]);
    }
    outline.extend(columns.iter().enumerate().map(|(i, c)| [middle(i), c[1]]));
    if let Some(last) = columns.last() {
        outline.push([last[0], below]);
    }
    let down = 1.2 * (upper[1] - below) * times.len() as f64;
    let moved = |line: Vec<[f64; 2]>| line.into_iter().map(|[x, y]| [x, y - down]).collect();
    let bodies = std::iter::once(outline).chain(sheared(simulation));
    drawing.bodies.extend(bodies.map(moved));
    let planes = vec![[left, upper[1]], [left, below], [upper[0], below]];
    drawing.lines.push(moved(planes));
    times.push(format!("{:.2}", simulation.time()));
    drawing.title = format!(
        "{}: downwards t = {} s",
        simulation.scene().name,
        times.join(", ")
    );
}

/// Outlines of the cells whose particles are sheared in the mean.
fn sheared(simulation: &Simulation) -> Vec<Vec<[f64; 2]>> {
    let (mesh, set) = (&simulation.scene().mesh, &simulation.sets()[0]);
    let Some(strain) = set.column(STRAIN) else {
        return vec![];
    };
    let mut sums: BTreeMap<[i64; 2], (f64, f64)> = BTreeMap::new();
    for (p, strain) in strain.iter().enumerate() {
        let x = set.position(p);
        let at = [0, 1].map(|axis| (x[axis] / mesh.cell[axis]).floor() as i64);
        let sum = sums.entry(at).or_default();
        *sum = (sum.0 + strain, sum.1 + 1.0);
    }
    let cells = sums.into_iter();
    let cells = cells.filter_map(|(at, (sum, count))| (sum > SHEARED * count).then_some(at));
    let place = |[i, j]: [i64; 2]| {
        [
            mesh.origin[0] + i as f64 * mesh.cell[0],
            mesh.origin[1] + j as f64 * mesh.cell[1],
        ]
    };
    outlines(&cells.collect())
        .into_iter()
        .map(|outline| outline.into_iter().map(place).collect())
        .collect()
}

/// Closed lines of corners around cells of a square mesh, with the cells on their left.
#[must_use]
pub fn outlines(cells: &BTreeSet<[i64; 2]>) -> Vec<Vec<[i64; 2]>> {
    let mut edges: BTreeMap<[i64; 2], Vec<[i64; 2]>> = BTreeMap::new();
    for &[i, j] in cells {
        let sides = [
            ([i, j - 1], [i, j], [i + 1, j]),
            ([i + 1, j], [i + 1, j], [i + 1, j + 1]),
            ([i, j + 1], [i + 1, j + 1], [i, j + 1]),
            ([i - 1, j], [i, j + 1], [i, j]),
        ];
        for (beside, from, to) in sides {
            if !cells.contains(&beside) {
                edges.entry(from).or_default().push(to);
            }
        }
    }
    let mut closed = vec![];
    while let Some(&start) = edges.keys().next() {
        let (mut line, mut at) = (vec![], start);
        while let Some(to) = edges.get_mut(&at).and_then(Vec::pop) {
            if edges.get(&at).is_some_and(Vec::is_empty) {
                edges.remove(&at);
            }
            line.push(at);
            at = to;
        }
        if line.is_empty() {
            break;
        }
        closed.push(line);
    }
    closed
}

/// Words on a run, after the ending `what`, which judge nothing.
pub fn said(rung: &Rung, run: &RungResult, what: &str) -> String {
    let taken = 100.0 * run.value(UNBOOKED);
    let label = &rung.label;
    format!("{label}: {what}; planes and the transfer took {taken:.0} % of the energy of the fall")
}

/// No mass is lost.
pub const LOSES_NOTHING: GateRule = value(LOST).at_most(0.0, "no particle leaves");
/// No energy comes from nowhere.
pub const GAINS_NOTHING: GateRule = value(GAINED).at_most(
    1e-2,
    "only the fall gives energy; cells that are crossed ring by a share of it",
);
/// No plastic work is given back.
pub const GIVES_NOTHING_BACK: GateRule =
    value(BACK).at_most(1e-12, "flow dissipates; round-off of a sum over particles");
/// The centre of mass goes where its momentum carries it.
pub const STAYS_ON_ITS_PATH: GateRule = value(ASTRAY).at_most(
    1e-9,
    "the motion of the particles is that of their momentum; round-off of some thousand steps",
);
/// A heap with strength comes to rest.
pub const RESTS: GateRule = value(MOVING).at_most(1e-3, "elastic ringing within the heap remains");
