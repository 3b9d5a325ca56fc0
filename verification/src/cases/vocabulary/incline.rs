//! Blocks on a held base under inclined gravity: settled without friction, then released.
//!
//! The time before the release is not judged: gravity acts normal to the base, nothing rubs, local damping takes the motion out
//! of the blocks, which start with the stress of their weight. At the release damping ends and gravity and friction are those
//! of the scene, so that the force on the base is the weight from the first step on and what is left to judge is friction. An
//! incline may be tilted before: friction acts and gravity along it grows, so slowly that the blocks do not swing.

use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{
    Contact, ContactNormal, Damping, Dimension, Mesh, PlaneCondition, Scene, Vector,
};

use super::parts::{AT_REST, bare_scene, body, cuboid, elastic, s_wave_speed, starting};
use super::stepping::run_until;
use crate::case::{Curve, CurvePoint, Quantity};
use crate::exact::sliding::Slope;
use crate::study::{Failure, Observer};

/// Young's modulus of the manual \[Pa\]; Poisson's ratio is [`POISSON`].
pub const YOUNG: f64 = 100e6;
/// Poisson's ratio.
pub const POISSON: f64 = 0.3;
/// Density \[kg/m³\].
pub const DENSITY: f64 = 2500.0;
/// Gravity of the manual along and into the incline \[m/s²\].
pub const GRAVITY: f64 = 7.07;
const WIDTH: f64 = 14.0; // Width of the base of the manual, along the third axis [m]
/// Range of a block along that axis \[m\].
const ACROSS: [f64; 2] = [2.0, 12.0];
const DAMPING: f64 = 0.6; // Factor of local damping before the release
/// Periods of vertical motion before the release. Damping takes `exp(-2 * 0.6)` of the motion in each.
const PERIODS: f64 = 8.0;
/// `c dt/h` of the settled scenes, inside the bound of every stress scheme. Near its bound FLIP keeps more of the
/// vibration of the light nodes at the edges, which rubs.
pub const COURANT: f64 = 0.3;
const TILTS: u32 = 200; // Steps of gravity while an incline is tilted
const POINTS: usize = 40; // Points of a picture
const BASE: i64 = 1; // Identifier of the base

/// Name of the displacement among the quantities.
pub const WAY: &str = "displacement at 2 s";
/// Name of the fitted acceleration.
pub const ACCELERATION: &str = "acceleration";
/// Name of the creep.
pub const CREEP: &str = "creep velocity over free velocity";

/// A block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Range along the incline at the start \[m\].
    pub along: [f64; 2],
    /// Coefficient of friction.
    pub friction: f64,
}

/// A base with blocks of the manual's material.
#[derive(Clone, Debug, PartialEq)]
pub struct Incline {
    /// Two dimensions: x along the incline, y out of it. Three: x along it, z out of it.
    pub dimension: Dimension,
    /// Cell size \[m\].
    pub cell: f64,
    /// Length of base and mesh \[m\].
    pub length: f64,
    /// Thickness of the base \[m\].
    pub base: f64,
    /// Height of the blocks \[m\].
    pub height: f64,
    /// Height of the mesh above the blocks \[m\].
    pub air: f64,
    /// The blocks.
    pub blocks: Vec<Block>,
    /// Gravity along the incline and into it \[m/s²\].
    pub gravity: [f64; 2],
    /// True if the base is held; else it slides between its rollers, as in the manual.
    pub held: bool,
    /// Factor of local damping after the release.
    pub damping: Option<f64>,
    /// Time over which the incline is tilted, gravity along it growing at a constant rate, before the release \[s\].
    /// `None`: it acts at once, at the release.
    pub tilting: Option<f64>,
}

impl Incline {
    /// Axis out of the incline.
    pub fn up(&self) -> usize {
        self.dimension.axes() - 1
    }

    /// A point by its coordinates along, across and out of the incline.
    fn point(&self, along: f64, across: f64, out: f64) -> Vector {
        match self.dimension {
            Dimension::Two => [along, out, 0.0],
            Dimension::Three => [along, across, out],
        }
    }

    /// Gravity with the components along the incline and into it.
    fn inclined(&self, [along, into]: [f64; 2]) -> Vector {
        self.point(along, 0.0, -into)
    }

    /// Time for which the blocks settle \[s\].
    fn settling(&self) -> f64 {
        PERIODS * 4.0 * self.height / (YOUNG / DENSITY).sqrt()
    }

    /// The scene, as it is from the release on; it lasts for settling, tilting and `time` (s) more.
    pub fn scene(&self, name: &str, time: f64) -> Scene {
        let h = self.cell;
        let cells = |length: f64| (length / h - 1e-9).ceil() as usize;
        let long = cells(self.length);
        let high = cells(self.base + self.height + self.air);
        let counts = match self.dimension {
            Dimension::Two => [long, high, 1],
            Dimension::Three => [long, cells(WIDTH), high],
        };
        let mut mesh = Mesh::new(self.dimension, [0.0; 3], [h; 3], counts);
        mesh.planes[self.up()][1] = PlaneCondition::Free;
        let settled = self.settling() + self.tilting.unwrap_or(0.0);
        let settling = if self.held { settled } else { 0.0 };
        let mut scene = bare_scene(name, self.dimension, mesh, settling + time);
        scene.gravity = self.inclined(self.gravity);
        let damped = |alpha| Damping::Local { alpha };
        scene.damping = self.damping.map_or(Damping::None, damped);
        scene.materials = elastic(DENSITY, YOUNG, POISSON);
        let far = self.point(self.length, WIDTH, self.base);
        let mut base = body("base", BASE, cuboid([0.0; 3], far));
        if self.held {
            base.motion = Some([0.0; 3].into());
        }
        scene.bodies.push(base);
        for (i, block) in self.blocks.iter().enumerate() {
            let id = BASE + 1 + i as i64;
            let [near, far] = block.along;
            let shape = cuboid(
                self.point(near, ACROSS[0], self.base),
                self.point(far, ACROSS[1], self.base + self.height),
            );
            let name = format!("block {}", i + 1);
            scene.bodies.push(body(name, id, shape));
            scene.contacts.push(Contact {
                name: format!("block {} on base", i + 1),
                id: i as i64 + 1,
                friction: block.friction,
                master: BASE,
                slave: id,
                normal: ContactNormal::Master,
            });
        }
        scene
    }

    /// Options of a simulation that settles: the stress of the weight above, where the base is held.
    pub fn options(&self, options: Options) -> Options {
        if !self.held {
            return options;
        }
        let (up, base, top) = (self.up(), self.base, self.base + self.height);
        let into = self.gravity[1].abs();
        starting(options, move |x| {
            let mut state = AT_REST;
            if x[up] > base {
                state.stress[up] = -DENSITY * into * (top - x[up]);
            }
            state
        })
    }

    /// Settles the blocks of a simulation of this incline where the base is held, and releases them.
    ///
    /// # Errors
    /// If a step fails.
    pub fn release(
        &self,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<(), Failure> {
        if !self.held {
            return Ok(());
        }
        // As it is to be from the release on.
        let scene = simulation.scene().clone();
        let into = self.gravity[1].abs();
        simulation.set_gravity(self.inclined([0.0, into]))?;
        simulation.set_local_damping(Some(DAMPING))?;
        for contact in &scene.contacts {
            simulation.set_friction(contact.id, 0.0)?;
        }
        let settled = self.settling();
        run_until(simulation, settled, observer, |_| ())?;
        for contact in &scene.contacts {
            simulation.set_friction(contact.id, contact.friction)?;
        }
        if let Some(tilting) = self.tilting {
            // By steps that are small beside the periods of the blocks.
            for stage in 1..=TILTS {
                let share = f64::from(stage) / f64::from(TILTS);
                simulation.set_gravity(self.inclined([share * self.gravity[0], into]))?;
                run_until(simulation, settled + share * tilting, observer, |_| ())?;
            }
        }
        simulation.set_local_damping(self.damping)?;
        simulation.set_gravity(scene.gravity)?;
        Ok(())
    }
}

/// Shear wave speed of the manual's material \[m/s\].
pub fn shear_wave_speed() -> f64 {
    s_wave_speed(YOUNG, POISSON, DENSITY)
}

/// The way of a block after its release.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// Time since the release \[s\] and displacement of the centre of mass along the incline \[m\].
    pub way: Vec<[f64; 2]>,
    /// Time since the release \[s\] and velocity of the centre of mass along the incline \[m/s\].
    pub velocity: Vec<[f64; 2]>,
    /// Time since the release \[s\] and velocity of the centre of mass out of the incline \[m/s\].
    pub out: Vec<[f64; 2]>,
    /// Force out of the incline on the block \[N\], step by step.
    pub force: Vec<f64>,
    /// Weight: mass times gravity into the incline \[N\].
    pub weight: f64,
}

impl Track {
    /// Displacement at the end \[m\].
    pub fn end(&self) -> f64 {
        self.way.last().map_or(f64::NAN, |w| w[1])
    }

    /// Mean velocity over the last part of the way, from the share `from` of the time on \[m/s\].
    pub fn mean_velocity_from(&self, from: f64) -> f64 {
        let Some(last) = self.way.last() else {
            return f64::NAN;
        };
        let first = self.way.iter().find(|w| w[0] >= from * last[0]);
        first.map_or(f64::NAN, |w| (last[1] - w[1]) / (last[0] - w[0]))
    }
}

/// Follows the blocks of a released simulation until its end. Gravity acts from the time of the velocities on, so the
/// release is at that time. One track per block.
///
/// # Errors
/// If a step fails.
pub fn follow(
    incline: &Incline,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
) -> Result<Vec<Track>, Failure> {
    let mut directions = [[0.0; 3]; 2];
    directions[0][0] = 1.0;
    directions[1][incline.up()] = 1.0;
    let blocks: Vec<usize> = (1..=incline.blocks.len()).collect();
    let into = incline.gravity[1].abs();
    follow_along(directions, &blocks, into, simulation, observer, |_| ())
}

/// Follows as [`follow`] where the unit vectors `directions` point along the incline and out of it. `blocks` are indices of
/// bodies, `into` gravity into the incline (m/s²); `after` sees the simulation after each step.
///
/// # Errors
/// If a step fails.
pub fn follow_along(
    directions: [Vector; 2],
    blocks: &[usize],
    into: f64,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
    mut after: impl FnMut(&Simulation),
) -> Result<Vec<Track>, Failure> {
    let [along, out] = directions.map(|d| move |v: &Vector| dot(v, &d));
    let release = simulation.velocity_time();
    let end = simulation.scene().time;
    let start = blocks
        .iter()
        .map(|&body| along(&simulation.center(body).position));
    let start: Vec<f64> = start.collect();
    let mut tracks = vec![Track::default(); start.len()];
    run_until(simulation, end, observer, |simulation| {
        let [t, t_v] = [simulation.time(), simulation.velocity_time()].map(|t| t - release);
        for ((track, &body), start) in tracks.iter_mut().zip(blocks).zip(&start) {
            let center = simulation.center(body);
            let (m, x, v) = (center.mass, center.position, center.velocity);
            track.way.push([t, along(&x) - start]);
            track.velocity.push([t_v, along(&v)]);
            track.out.push([t_v, out(&v)]);
            track.force.push(out(&simulation.contact_force(body)));
            track.weight = m * into;
        }
        after(simulation);
    })?;
    Ok(tracks)
}

/// Acceleration along the incline against the exact one.
pub fn acceleration(track: &Track, exact: &Slope) -> Quantity {
    let fitted = fitted_slope(&track.velocity);
    Quantity::compared(ACCELERATION, fitted, exact.acceleration(), "m/s²")
}

/// Creep and displacement \[m\] of a block that sticks for a time \[s\], over what a free one would do.
pub fn stuck(track: &Track, moved: f64, exact: &Slope, time: f64) -> [Quantity; 2] {
    let free = Slope {
        friction: 0.0,
        ..*exact
    };
    let creep = track.mean_velocity_from(0.5) / (free.acceleration() * time);
    let way = Quantity {
        error: Some((moved / free.displacement(time)).abs()),
        ..Quantity::balance(WAY, moved, "m")
    };
    [Quantity::of_zero(CREEP, creep), way]
}

/// Displacement over time beside the exact one, for pictures.
pub fn sliding_curve(track: &Track, exact: &Slope, label: &str) -> Curve {
    let every = (track.way.len() / POINTS).max(1);
    let points = track.way.iter().skip(every - 1).step_by(every);
    let points = points.map(|&[t, d]| CurvePoint::new(t, d, exact.displacement(t)));
    let title = format!("displacement of the centre of mass, {label}");
    Curve::new(
        title,
        ["time since the release (s)", "displacement (m)"],
        points,
    )
}

/// Scalar product.
pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Slope of the line that fits points best in the least-squares sense.
pub fn fitted_slope(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let sum = |k: usize, m: f64| points.iter().map(|p| (p[0] - x) * (p[k] - m)).sum::<f64>();
    sum(1, y) / sum(0, x)
}
