//! A problem of a case as any other solver can run it: a scene that a scene file can say, and the exact solution that
//! its frames are compared with.
//!
//! Solvers get the language of the manuals: three dimensions, one velocity for a body, loads on nodes. Plane strain becomes
//! a slab one cell thick between rollers, a traction the nodal loads that it is integrated to, and a velocity that differs from
//! place to place many small bodies. All are exact.

mod plane;
mod reading;
pub(crate) mod start;
mod stress;

pub use reading::{ReadValue, Reading};
pub use stress::ExactStress;

use proctor_scene::{
    Dimension, Field, Mesh, PlaneCondition, PointLoad, Results, Scene, Shape, TimeStep, Traction,
    Vector,
};

use crate::settings::{Method, Settings};

/// `c dt/h` of all scenes, that of the manual's box: below the bound of every stress scheme.
pub(crate) const COURANT: f64 = 0.3;
/// Frames of a motion that is compared all along.
pub(crate) const FRAMES: usize = 20;
/// Times that a wave goes through a body before it is taken to be at rest under kinetic damping: a third more than a
/// relaxation to 1e-8 of the load takes.
pub(crate) const RELAXATION: f64 = 16.0;

/// Default settings of the manuals' program, with [`COURANT`].
pub(crate) fn settings() -> Settings {
    Settings::new(Method::DEFAULT).courant(COURANT)
}

/// Field of a particle that is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComparedField {
    /// Displacement \[m\].
    Displacement,
    /// Velocity \[m/s\].
    Velocity,
    /// Normal components of the Cauchy stress, tension positive \[Pa\].
    Stress,
}

/// Norm that makes one error of the differences of all particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Norm {
    /// sqrt(sum |f - f_exact|² / sum |f_exact|²) over particles and frames; particles have equal masses.
    L2,
    /// Mean over the particles along an axis, against the exact one: the way of a centre of mass.
    Mean(usize),
}

/// Exact values at where particles began \[m\] and at a time \[s\].
pub type ExactField = Box<dyn Fn(&[Vector], f64) -> Vec<Vector> + Send + Sync>;

/// A problem that other solvers run.
pub struct Guest {
    /// The scene, with one constant step.
    pub scene: Scene,
    /// Field that is compared.
    pub compared: ComparedField,
    /// Norm of the errors.
    pub norm: Norm,
    /// True if the last frame alone counts, rather than all after the first.
    pub last_alone: bool,
    /// True for a place (m) whose particle counts.
    pub counts: Box<dyn Fn(&Vector) -> bool + Send + Sync>,
    /// The exact field.
    pub exact: ExactField,
    /// The tractions that the loads on nodes are integrated from, for a solver whose functions are not one at their node.
    pub tractions: Vec<Traction>,
    /// The number that is reported instead of an error, where no field of particles is exact.
    pub reading: Option<Reading>,
    /// The exact stress, where frames that hold stresses have a second error.
    pub stress: Option<ExactStress>,
}

/// A frame of a solver, as far as it is compared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Time of the field \[s\].
    pub time: f64,
    /// Places of the particles at the start \[m\].
    pub starts: Vec<Vector>,
    /// The field that is compared.
    pub values: Vec<Vector>,
    /// Displacements \[m\].
    pub displacements: Vec<Vector>,
    /// Cauchy stresses, tension positive \[Pa\]: xx, yy, zz, yz, xz, xy; NaN where a frame lacks a component. None
    /// where it holds no stresses.
    pub stresses: Vec<[f64; 6]>,
}

impl Guest {
    /// The displacement of all particles in all frames, in the norm of L2.
    #[must_use]
    pub fn new(
        scene: Scene,
        exact: impl Fn(&Vector, f64) -> Vector + Send + Sync + 'static,
    ) -> Self {
        Self {
            scene,
            compared: ComparedField::Displacement,
            norm: Norm::L2,
            last_alone: false,
            counts: Box::new(|_| true),
            exact: Box::new(move |starts, t| starts.iter().map(|x| exact(x, t)).collect()),
            tractions: vec![],
            reading: None,
            stress: None,
        }
    }

    /// The same by the last frame alone.
    #[must_use]
    pub fn at_the_end(mut self) -> Self {
        self.last_alone = true;
        self
    }

    /// Relative error of the frames of a solver; of a reading, its share beyond or below the reference.
    ///
    /// # Errors
    /// If there is no frame, no particle that counts, or no exact value to be relative to.
    pub fn error(&self, frames: &[Snapshot]) -> Result<f64, String> {
        if let Some(reading) = &self.reading {
            return reading.of(frames).map(|reported| reported.off());
        }
        let first = if self.last_alone {
            frames.len().saturating_sub(1)
        } else {
            0
        };
        let (mut wrong, mut right) = (0.0, 0.0);
        let mut particles = 0;
        for frame in &frames[first..] {
            let counts = |(start, _): &(&Vector, &Vector)| (self.counts)(start);
            let (starts, values): (Vec<Vector>, Vec<Vector>) = frame
                .starts
                .iter()
                .zip(&frame.values)
                .filter(counts)
                .unzip();
            let exact = (self.exact)(&starts, frame.time);
            particles += starts.len();
            match self.norm {
                Norm::L2 => {
                    for (value, exact) in values.iter().zip(&exact) {
                        for axis in 0..3 {
                            wrong += (value[axis] - exact[axis]).powi(2);
                            right += exact[axis].powi(2);
                        }
                    }
                }
                Norm::Mean(axis) => {
                    let sum = |values: &[Vector]| values.iter().map(|v| v[axis]).sum::<f64>();
                    let count = starts.len().max(1) as f64;
                    let (value, exact) = (sum(&values) / count, sum(&exact) / count);
                    wrong += (value - exact).powi(2);
                    right += exact.powi(2);
                }
            }
        }
        if particles == 0 {
            return Err("no particle began where any is compared".to_owned());
        }
        let error = (wrong / right).sqrt();
        if error.is_finite() {
            Ok(error)
        } else {
            Err("a field that is not finite, or nothing exact to be relative to".to_owned())
        }
    }
}

/// Preparation that every scene for other solvers has in common: `frames` frames with displacements and velocities, and equal
/// steps of at most `step` (s), a whole number of them between two frames.
pub(crate) fn prepared(mut scene: Scene, frames: usize, step: f64) -> Scene {
    let between = scene.time / frames as f64;
    let steps = (between / step * (1.0 - 1e-12)).ceil().max(1.0);
    scene.time_step = TimeStep::Fixed {
        dt: between / steps,
        allow_unstable: false,
    };
    scene.results = Results {
        print: frames,
        history_interval: None,
        fields: vec![Field::Id, Field::Displacement, Field::Velocity],
        nodal_fields: vec![],
        checkpoint: false,
    };
    scene
}

/// A scene in plane strain as a slab one cell thick between rollers. Bodies must be rectangles.
pub(crate) fn slab(mut scene: Scene) -> Scene {
    let thick = scene.mesh.cell[0];
    let flat = &scene.mesh;
    let mut mesh = Mesh::new(
        Dimension::Three,
        flat.origin,
        [flat.cell[0], flat.cell[1], thick],
        [flat.cells[0], flat.cells[1], 1],
    );
    mesh.planes = flat.planes;
    mesh.planes[2] = [PlaneCondition::Sliding; 2];
    scene.mesh = mesh;
    scene.dimension = Dimension::Three;
    for body in &mut scene.bodies {
        if let Shape::Cuboid { p2, .. } = &mut body.shape {
            p2[2] = thick;
        }
        body.particles_per_cell[2] = body.particles_per_cell[0];
    }
    for traction in &mut scene.tractions {
        traction.p2[2] = thick;
    }
    scene
}

/// A scene with its tractions as the nodal loads that they are integrated to, and the tractions. Their corners must be
/// nodes.
pub(crate) fn with_nodal_loads(mut scene: Scene) -> (Scene, Vec<Traction>) {
    let tractions = std::mem::take(&mut scene.tractions);
    for traction in &tractions {
        let loads = nodal_loads(traction, &scene.mesh);
        scene.point_loads.extend(loads);
    }
    (scene, tractions)
}

/// Each node of a rectangle has the share of its hat: a cell within, half of one at a side.
fn nodal_loads(traction: &Traction, mesh: &Mesh) -> Vec<PointLoad> {
    let cells: [usize; 3] = std::array::from_fn(|axis| {
        ((traction.p2[axis] - traction.p1[axis]) / mesh.cell[axis]).round() as usize
    });
    let share = |axis: usize, i: usize| match cells[axis] {
        0 => 1.0,
        last if i == 0 || i == last => 0.5 * mesh.cell[axis],
        _ => mesh.cell[axis],
    };
    // No case hands over a traction that changes in time.
    let constant = traction.traction.constant().unwrap_or_default();
    let mut loads = vec![];
    for i in 0..=cells[0] {
        for j in 0..=cells[1] {
            for k in 0..=cells[2] {
                let at = [i, j, k];
                let area = share(0, i) * share(1, j) * share(2, k);
                loads.push(PointLoad {
                    position: std::array::from_fn(|axis| {
                        traction.p1[axis] + at[axis] as f64 * mesh.cell[axis]
                    }),
                    force: constant.map(|t| t * area),
                });
            }
        }
    }
    loads
}
