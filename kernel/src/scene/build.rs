//! Scenes by hand: the usual choices in few words. Every field stays open to who wants another.

use super::{Body, Dimension, Material, Mesh, PlaneCondition, Scene, SceneError, Shape, Vector};
use crate::laws::AnyLaw;
use crate::simulation::{Options, SetupError, Simulation};
use std::fmt;

impl Scene {
    /// A scene in the plane (plane strain, unit thickness) with a mesh of square cells of edge `h` \[m\] from the origin
    /// on, all of whose boundary planes slide; one second long.
    #[must_use]
    pub fn plane([x, y]: [usize; 2], h: f64) -> Self {
        let mesh = Mesh::new(Dimension::Two, [0.0; 3], [h; 3], [x, y, 1]);
        Self::new(Dimension::Two, mesh, 1.0).with_planes(PlaneCondition::Sliding)
    }

    /// The same in space, with cubes.
    #[must_use]
    pub fn space(cells: [usize; 3], h: f64) -> Self {
        let mesh = Mesh::new(Dimension::Three, [0.0; 3], [h; 3], cells);
        Self::new(Dimension::Three, mesh, 1.0).with_planes(PlaneCondition::Sliding)
    }

    /// With this condition on all boundary planes of the mesh.
    #[must_use]
    pub fn with_planes(mut self, condition: PlaneCondition) -> Self {
        for planes in &mut self.mesh.planes[..self.dimension.axes()] {
            *planes = [condition; 2];
        }
        self
    }

    /// With this acceleration of gravity \[m/s²\].
    #[must_use]
    pub fn with_gravity(mut self, gravity: Vector) -> Self {
        self.gravity = gravity;
        self
    }

    /// With this end \[s\].
    #[must_use]
    pub fn lasting(mut self, time: f64) -> Self {
        self.time = time;
        self
    }

    /// Adds a material of this law, one of [`laws`](crate::laws) or one's own, and density \[kg/m³\]; its index, for [`Scene::add_body`].
    pub fn add_material(&mut self, law: impl Into<AnyLaw>, density: f64) -> usize {
        let index = self.materials.len();
        let id = 1 + self.materials.iter().map(|m| m.id).max().unwrap_or(0);
        self.materials.push(Material {
            name: format!("material {id}"),
            id,
            density,
            law: law.into(),
        });
        index
    }

    /// Adds a body at rest, with two particles per cell and axis; gives it back, so that it can be given a velocity, for
    /// instance. Its identifier is one more than the largest so far.
    pub fn add_body(&mut self, shape: Shape, material: usize) -> &mut Body {
        let id = 1 + self.bodies.iter().map(|b| b.id).max().unwrap_or(0);
        let flat = self.dimension == Dimension::Two;
        self.bodies.push(Body {
            name: format!("body {id}"),
            id,
            material,
            shape,
            particles_per_cell: [2, 2, if flat { 1 } else { 2 }],
            velocity: [0.0; 3],
            motion: None,
        });
        let last = self.bodies.len() - 1;
        &mut self.bodies[last]
    }

    /// Checks the scene and sets it in motion.
    ///
    /// # Errors
    /// What is wrong with the scene, every problem with the path of its value, or why it cannot be set up.
    pub fn simulate(&self, options: &Options) -> Result<Simulation, StartError> {
        self.check().map_err(StartError::Scene)?;
        Simulation::new(self, options).map_err(StartError::Setup)
    }
}

impl Shape {
    /// A rectangle of the plane between two corners \[m\].
    #[must_use]
    pub fn rectangle([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> Self {
        Self::Cuboid {
            p1: [x_1, y_1, 0.0],
            p2: [x_2, y_2, 0.0],
        }
    }

    /// A disc of the plane \[m\].
    #[must_use]
    pub fn disc([x, y]: [f64; 2], radius: f64) -> Self {
        Self::Sphere {
            center: [x, y, 0.0],
            radius,
        }
    }
}

/// Why a scene does not start.
#[derive(Debug)]
pub enum StartError {
    /// The scene is not sound.
    Scene(SceneError),
    /// It cannot be set up.
    Setup(SetupError),
}

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Setup(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for StartError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Scene(error) => Some(error),
            Self::Setup(error) => Some(error),
        }
    }
}
