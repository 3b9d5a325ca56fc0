//! Scenes by hand: the usual choices in few words. Every field stays open for other choices.

use crate::values::{Body, InitialStress, Material, Scene};
use proctor_contact::{Contact, ContactHandle, ContactNormal};
use proctor_kernel::laws::AnyLaw;
use proctor_kernel::model::{
    Damping, Dimension, History, Mesh, PlaneCondition, Shape, StressScheme, TimeStep, Transfer,
    Vector, Weighting,
};
use proctor_kernel::simulation::BodyHandle;
use std::ops::{Deref, DerefMut};

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

    /// An axisymmetric scene: radius and height, with a mesh of square cells of edge `h` \[m\] from the axis on, all of whose boundary
    /// planes slide; one second long. Masses and forces are those of the full circle.
    #[must_use]
    pub fn revolution(cells: [usize; 2], h: f64) -> Self {
        let mut scene = Self::plane(cells, h);
        scene.mesh.axisymmetric = true;
        scene
    }

    /// Sets this condition on all boundary planes of the mesh.
    #[must_use]
    pub fn with_planes(mut self, condition: PlaneCondition) -> Self {
        for planes in &mut self.mesh.planes[..self.dimension.axes()] {
            *planes = [condition; 2];
        }
        self
    }

    /// Sets this condition on the lower (`side` 0) or upper (1) boundary plane along `axis`.
    #[must_use]
    pub fn with_plane(mut self, axis: usize, side: usize, condition: PlaneCondition) -> Self {
        self.mesh.planes[axis][side] = condition;
        self
    }

    /// Sets this acceleration of gravity \[m/s²\]: two numbers in the plane, three in space.
    #[must_use]
    pub fn with_gravity<const D: usize>(mut self, gravity: [f64; D]) -> Self {
        self.gravity = in_space(gravity);
        self
    }

    /// Sets this end \[s\].
    #[must_use]
    pub fn with_end(mut self, time: f64) -> Self {
        self.time = time;
        self
    }

    /// Sets this choice of the time step.
    #[must_use]
    pub fn with_time_step(mut self, time_step: TimeStep) -> Self {
        self.time_step = time_step;
        self
    }

    /// Sets this weighting function.
    #[must_use]
    pub fn with_weighting(mut self, weighting: Weighting) -> Self {
        self.weighting = weighting;
        self
    }

    /// Sets this stress scheme.
    #[must_use]
    pub fn with_scheme(mut self, scheme: StressScheme) -> Self {
        self.scheme = scheme;
        self
    }

    /// Sets this transfer of velocity.
    #[must_use]
    pub fn with_transfer(mut self, transfer: Transfer) -> Self {
        self.transfer = transfer;
        self
    }

    /// Sets this damping.
    #[must_use]
    pub fn with_damping(mut self, damping: Damping) -> Self {
        self.damping = damping;
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

    /// Adds a body at rest, with two particles per cell and axis. Its identifier is one more than the largest so far.
    pub fn add_body(&mut self, shape: Shape, material: usize) -> BodyEntry<'_> {
        let id = 1 + self.bodies.iter().map(|b| b.id).max().unwrap_or(0);
        let flat = self.dimension == Dimension::Two;
        let place = self.bodies.len();
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
        BodyEntry {
            handle: place.into(),
            body: &mut self.bodies[place],
        }
    }

    /// Adds contact with Coulomb friction between a master and a slave body, along the mean of their normals. Its identifier
    /// is one more than the largest of all contacts so far.
    pub fn add_contact(
        &mut self,
        [master, slave]: [BodyHandle; 2],
        friction: f64,
    ) -> ContactHandle {
        let mortar = self.mortar.contacts.iter().map(|contact| contact.id);
        let all = self.contacts.iter().map(|contact| contact.id).chain(mortar);
        let id = 1 + all.max().unwrap_or(0);
        self.contacts.push(Contact {
            name: format!("contact {id}"),
            id,
            friction,
            master: self.bodies[master.place()].id,
            slave: self.bodies[slave.place()].id,
            normal: ContactNormal::Collinear,
        });
        id.into()
    }

    /// The body with this identifier.
    #[must_use]
    pub fn body_with_id(&self, id: i64) -> Option<BodyHandle> {
        let place = self.bodies.iter().position(|body| body.id == id);
        place.map(BodyHandle::from)
    }
}

/// A body that was added to a scene, to be given what it has beyond its shape and material.
#[derive(Debug)]
pub struct BodyEntry<'a> {
    handle: BodyHandle,
    body: &'a mut Body,
}

// A call changes the body in its scene; the value is there for the next call.
#[allow(clippy::must_use_candidate)]
impl BodyEntry<'_> {
    /// Gives it this velocity at the start \[m/s\]: two numbers in the plane, three in space.
    pub fn with_velocity<const D: usize>(self, velocity: [f64; D]) -> Self {
        self.body.velocity = in_space(velocity);
        self
    }

    /// Prescribes its velocity.
    pub fn with_motion(self, motion: impl Into<History>) -> Self {
        self.body.motion = Some(motion.into());
        self
    }

    /// Fills it with this number of particles per cell and axis: two numbers in the plane, three in space.
    pub fn with_particles_per_cell<const D: usize>(self, particles: [usize; D]) -> Self {
        const { assert!(D == 2 || D == 3, "two axes or three") };
        self.body.particles_per_cell =
            std::array::from_fn(|axis| particles.get(axis).copied().unwrap_or(1));
        self
    }

    /// Gives it this stress at the start.
    pub fn with_initial_stress(self, stress: InitialStress) -> Self {
        self.body.initial_stress = stress;
        self
    }

    /// Handle of the body, in the scene and in its simulation.
    #[must_use]
    pub fn handle(&self) -> BodyHandle {
        self.handle
    }
}

impl Deref for BodyEntry<'_> {
    type Target = Body;

    fn deref(&self) -> &Body {
        self.body
    }
}

impl DerefMut for BodyEntry<'_> {
    fn deref_mut(&mut self) -> &mut Body {
        self.body
    }
}

/// A vector of the plane or of space, whose missing third component is zero.
fn in_space<const D: usize>(vector: [f64; D]) -> Vector {
    const { assert!(D == 2 || D == 3, "two components or three") };
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}
