//! A manufactured problem: a motion, a law, a method; its scene and the references that drive and judge it.

use proctor_scene::{
    Body, Contact, ContactNormal, Dimension, InitialStress, Mesh, OnImbalance, PlaneCondition,
    Results, Scene, Shape, TimeStep,
};

use super::material::Material;
use super::motion::{Motion, Vector};
use crate::settings::{Method, Settings};

/// The support of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// A motion on the whole mesh between fixed planes.
    Box,
    /// Free on all sides, with a field that leaves the faces without stress; it shifts and turns.
    Floating,
    /// A motion in a frame of prescribed nodes that stretches, shears and turns.
    Frame,
    /// The same without a field: the stress is uniform.
    Affine,
    /// A frame under pressure, cut on a plane of the mesh into two bodies in contact, which must move as one.
    Cut,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Box,
        Self::Floating,
        Self::Frame,
        Self::Affine,
        Self::Cut,
    ];

    /// Name in tables and files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Floating => "floating",
            Self::Frame => "frame",
            Self::Affine => "affine",
            Self::Cut => "cut",
        }
    }

    /// True where nodes around the body are prescribed.
    #[must_use]
    pub fn has_frame(self) -> bool {
        matches!(self, Self::Frame | Self::Affine | Self::Cut)
    }

    /// Half the edge of the body \[m\].
    #[must_use]
    pub fn half(self) -> f64 {
        if self.has_frame() { 0.75 } else { 0.5 }
    }
}

/// Cells per metre that divide the edges of all meshes: bodies and meshes end on lines.
pub const COARSEST: usize = 8;
/// Cells between the body and the boundary of its mesh, of the coarsest.
const MARGIN: f64 = 3.0;
/// Share of the largest stable step of problems that are drawn; waves and particles are counted as they become.
pub const SHARE_OF_STEP: f64 = 0.6;
/// Particles per cell and axis of problems that are drawn.
pub const PARTICLES_PER_CELL: usize = 2;

/// A problem that a mill made.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Name: that of the family, the seed and the number.
    pub name: String,
    /// The support of the body.
    pub family: Family,
    /// Motion.
    pub motion: Motion,
    /// Law.
    pub material: Material,
    /// Coefficient of friction between the two bodies of a cut one.
    pub friction: f64,
    /// End \[s\].
    pub end: f64,
    /// Weighting function, scheme and transfer.
    pub method: Method,
    /// Particles per cell and axis.
    pub particles_per_cell: usize,
    /// Share of the largest stable step that a run takes.
    pub share_of_step: f64,
    /// Cells per metre, coarse to fine.
    pub ladder: Vec<usize>,
    /// Cells on each axis for one of the ladder: 1, or 2 where cells are oblong.
    pub parts: [usize; 3],
    /// Fastest wave of the moved body and fastest particle together \[m/s\].
    pub fastest: f64,
}

impl Problem {
    /// Number of axes.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.motion.axes()
    }

    fn dimension(&self) -> Dimension {
        if self.axes() == 2 {
            Dimension::Two
        } else {
            Dimension::Three
        }
    }

    /// Places of the body on a grid, `count` along each axis, with both faces \[m\].
    #[must_use]
    pub fn samples(&self, count: usize) -> Vec<Vector> {
        let half = self.family.half();
        let axes = self.axes();
        let all = count.pow(axes as u32);
        let along = |k: usize| half * (2.0 * k as f64 / (count - 1) as f64 - 1.0);
        (0..all)
            .map(|index| {
                std::array::from_fn(|axis| {
                    let k = index / count.pow(axis as u32) % count;
                    let from_center = if axis < axes { along(k) } else { 0.0 };
                    self.motion.center[axis] + from_center
                })
            })
            .collect()
    }

    /// Times from the start to the end \[s\].
    pub fn times(&self, count: usize) -> impl Iterator<Item = f64> + '_ {
        (0..count).map(move |k| self.end * k as f64 / (count - 1) as f64)
    }

    /// Lower and upper corner of all that the body passes \[m\].
    fn reach(&self) -> [Vector; 2] {
        let places: Vec<_> = (self.samples(9).iter().map(|x| self.motion.of(x))).collect();
        let mut reach = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for time in self.times(17) {
            let moment = self.motion.at(time);
            for place in &places {
                let [x, ..] = moment.motion(place);
                for axis in 0..3 {
                    let x = self.motion.center[axis] + x[axis];
                    reach[0][axis] = reach[0][axis].min(x);
                    reach[1][axis] = reach[1][axis].max(x);
                }
            }
        }
        reach
    }

    fn mesh(&self, cells: usize) -> Mesh {
        let dimension = self.dimension();
        let counts = self.parts.map(|parts| parts * cells);
        let h = counts.map(|count| 1.0 / count as f64);
        if self.family == Family::Box {
            let mut mesh = Mesh::new(dimension, [0.0; 3], h, counts);
            for planes in &mut mesh.planes[..self.axes()] {
                *planes = [PlaneCondition::Fixed; 2];
            }
            return mesh;
        }
        let coarse = COARSEST as f64;
        let [low, high] = self.reach();
        let origin = low.map(|x| ((x * coarse).floor() - MARGIN) / coarse);
        let count = std::array::from_fn(|axis| {
            let upper = ((high[axis] * coarse).ceil() + MARGIN) / coarse;
            ((upper - origin[axis]) * counts[axis] as f64).round() as usize
        });
        let mut mesh = Mesh::new(dimension, origin, h, count);
        for planes in &mut mesh.planes[..self.axes()] {
            *planes = [PlaneCondition::Free; 2];
        }
        mesh
    }

    fn settings(&self) -> Settings {
        Settings {
            particles_per_cell: self.particles_per_cell,
            ..Settings::new(self.method)
        }
    }

    /// Cells per metre along the axis that has the most, on the rung with `cells`.
    fn most(&self, cells: usize) -> f64 {
        (self.parts.into_iter().max().unwrap_or(1) * cells) as f64
    }

    /// The way that the fastest wave goes in the largest stable step on cells of one part in `cells` of a metre \[m\].
    #[must_use]
    pub fn way(&self, cells: usize) -> f64 {
        self.method.stability_number(self.particles_per_cell) / self.most(cells)
    }

    /// Equal steps in cells of one part in `cells` of a metre: their length \[s\] and number.
    #[must_use]
    pub fn steps(&self, cells: usize) -> (f64, usize) {
        let settings = self.settings();
        // Laws that return to a yield surface are of first order in the step: with dt like h² they do not hide the order in h.
        let share = if self.material.kind.yields() {
            self.share_of_step * self.ladder[0] as f64 / cells as f64
        } else {
            self.share_of_step
        };
        let courant = share * self.method.stability_number(settings.particles_per_cell);
        let (_, steps) =
            (settings.courant(courant)).equal_steps(self.end, 1.0 / self.most(cells), self.fastest);
        (self.end / steps as f64, steps as usize)
    }

    /// The scene of a rung, without what drives it.
    #[must_use]
    pub fn scene(&self, cells: usize) -> Scene {
        let mut scene = Scene::new(self.dimension(), self.mesh(cells), self.end);
        scene.name.clone_from(&self.name);
        scene.time_step = TimeStep::Fixed {
            dt: self.steps(cells).0,
            allow_unstable: false,
        };
        scene.results = Results::NONE;
        // With an affine transfer nodes that are prescribed give particles a momentum that the watch takes for lost.
        scene.on_imbalance = if self.family.has_frame() {
            OnImbalance::Tell
        } else {
            OnImbalance::Stop
        };
        let material = scene.add_material(self.material.law(), self.material.density);
        let (half, center, axes) = (self.family.half(), self.motion.center, self.axes());
        // The cut lies across the first axis.
        let corner = |along: f64, sign: f64| -> Vector {
            let from_center = [along, sign * half, sign * half];
            std::array::from_fn(|axis| {
                center[axis] + if axis < axes { from_center[axis] } else { 0.0 }
            })
        };
        let cuts: &[f64] = if self.family == Family::Cut {
            &[-half, 0.0, half]
        } else {
            &[-half, half]
        };
        for (number, ends) in cuts.windows(2).enumerate() {
            scene.bodies.push(Body {
                name: format!("body {}", number + 1),
                id: number as i64 + 1,
                material,
                shape: Shape::Cuboid {
                    p1: corner(ends[0], -1.0),
                    p2: corner(ends[1], 1.0),
                },
                particles_per_cell: [1; 3],
                velocity: [0.0; 3],
                motion: None,
                initial_stress: InitialStress::None,
            });
        }
        if self.family == Family::Cut {
            scene.contacts.push(Contact {
                name: "cut".to_owned(),
                id: 1,
                friction: self.friction,
                master: 1,
                slave: 2,
                normal: ContactNormal::Collinear,
            });
        }
        self.settings().apply(&mut scene);
        scene
    }
}
