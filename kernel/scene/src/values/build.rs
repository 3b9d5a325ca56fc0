//! Scenes by hand: the usual choices in few words. Every field stays open to who wants another.

use crate::values::{Body, InitialStress, Material, Scene};
use proctor_kernel::laws::AnyLaw;
use proctor_kernel::model::{Dimension, Mesh, PlaneCondition, Shape, Vector};

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

    /// Adds a material of this law, one of `proctor-laws` or one's own, and density \[kg/m³\]; its index, for [`Scene::add_body`].
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
            initial_stress: InitialStress::None,
        });
        let last = self.bodies.len() - 1;
        &mut self.bodies[last]
    }
}
